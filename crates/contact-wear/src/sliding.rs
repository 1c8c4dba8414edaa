//! Gross slip: the implicit jump of a stroke.
//!
//! With d_i the places of the stroke (an interval of shifts for each increment), s_i the slip distance at each
//! per cycle and p_i the pressure there, n cycles wear body b (k_b being the coefficient of its law in its own coordinates, S_bi
//! the shift of the grid against it, [`shift`](super::shift)) by
//!
//! ```text
//! w_b = n k_b sum_i s_i S_bi p_i                                             depth
//! g_i = h + C p_i + o sum_b S_bi^T (w_b0 + w_b) - delta_i >= 0,  p_i >= 0,  p_i g_i = 0
//! ```
//!
//! with the pressures at the end of the jump; o = 1 - kept is the growth of the gap over the worn
//! depth, the rest being debris. These are the conditions of the minimum of
//!
//! ```text
//! sum_i s_i [ 1/2 p_i.C p_i + p_i.(h + o S_bi^T w_b0) ] + 1/2 o n sum_b k_b |sum_i s_i S_bi p_i|^2
//! ```
//!
//! over p_i >= 0 of given sums: convex for any n, so that a solution exists for jumps of any
//! length. The places are solved one by one, each as if the pressure changed alike at all others:
//! by Cauchy's inequality `|sum s_i x_i|^2 <= s sum s_i x_i^2`, s being the sum of the s_i, this
//! majorises the energy, which therefore falls in every round (D. R. Hunter, K. Lange, Am. Stat. 58
//! (2004) 30-37). The normal problem of a place has the compliance `o n s sum_b S_bi^T k_b`. One
//! place needs one round; for more the rounds are accelerated (Y. Nesterov; A. Beck, M. Teboulle,
//! SIAM J. Imaging Sci. 2 (2009) 183-202), and restarted where a step reverses (B. O'Donoghue, E.
//! Candes, Found. Comput. Math. 15 (2015) 715-732).

mod friction;
mod third_body;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::plan::Plan;
use contact_core::scene::{FrictionHistory, Scene};

use super::course::{Coefficients, coefficients};
use super::law::CellCycle;
use super::loss::{Loss, Worn};
use super::on_grid;
use super::own_friction::OwnFriction;
use super::pressing::Pressing;
use super::settings::{Wear, thicknesses};
use super::shift::Shift;
use super::stroke::{Corner, Frame, Place, stroke};
use super::surface_friction::SurfaceFriction;
use super::third_body::{ThirdBody, ThirdFields};

/// Change of the pressures in a round that ends the rounds, over the pressures (root mean squares).
const LEAST_CHANGE: f64 = 1e-3;
/// Times the tolerance of the scene to which the pressures of a round are solved.
const ROUGH: f64 = 10.0;
/// Most corrections of a law that changes within a jump, and the relative change of the depth (root
/// mean squares) that ends them.
const CORRECTIONS: usize = 8;
const AGREES: f64 = 0.01;
/// Difference of two rates, over the largest one, up to which they are the same.
const ROUNDING: f64 = 1e-12;
/// Most rounds; a remaining error enters the estimate of the jump's error.
const MOST_ROUNDS: usize = 60;

/// The gross slip of a stroke.
pub(crate) struct Sliding {
    pub(crate) pressing: Pressing,
    pub(crate) places: Vec<Place>,
    pub(crate) corners: Vec<Corner>,
    /// Shift of the grid against body 1 and body 2 at each place.
    shifts: Vec<[Shift; 2]>,
    wear: Wear,
    coatings: [Vec<f64>; 2],
    /// Coefficient of friction, and its dependence on cycles.
    mu: f64,
    history: Option<FrictionHistory>,
    /// Its dependence on the exposed surface.
    surface: Option<SurfaceFriction>,
    /// Coefficient of the cells of the body whose layers count, before its dependence on cycles; empty
    /// where it is uniform.
    mu_of_cells: Vec<f64>,
    /// A law of the user, and its coefficients in the cells of the grid at the places of the settled contact.
    law: Option<OwnFriction>,
    mu_of_places: Vec<Vec<f64>>,
    /// Error of the mean coefficient by the cells, over it.
    pub(crate) mu_error: f64,
    /// Cycles done.
    cycles: f64,
    /// Gap between the unworn surfaces at the places \[m\].
    h: Vec<Arc<Vec<f64>>>,
    /// Pressures at the places \[Pa\].
    pub(crate) p: Vec<Vec<f64>>,
    /// Oxygen and debris in the contact.
    third_body: Option<ThirdBody>,
    /// Debris per area in the gap, in the cells of the grid \[m\]; empty without a bed.
    bed: Vec<f64>,
    /// Oxygen and debris of the settled contact.
    present: ThirdFields,
    /// The end of the last jump with a third body, and the fields that the next one tries first.
    end: Option<JumpEnd>,
    guess: Option<ThirdFields>,
}

/// Pressures and fields at the end of a jump.
pub(crate) struct JumpEnd {
    p: Vec<Vec<f64>>,
    fields: ThirdFields,
}

impl Sliding {
    /// Solves the pressures at all places of the stroke on the surfaces `worn` so far, or takes over the
    /// pressures of a state.
    pub(crate) fn new(
        scene: &Scene,
        wear: &Wear,
        state: Option<Vec<Vec<f64>>>,
        worn: &Worn,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let (places, corners) = stroke(scene, wear.first_branch(scene)?)?;
        let plan = Plan::new(scene);
        plan.check_memory(scene)?;
        let pressing = Pressing::new(scene, &plan, stop)?;
        let frame = Frame::new(scene);
        // A single place stands for a stroke that is short beside every spot.
        let smeared = |place: &Place| if places.len() > 1 { place.length } else { 0.0 };
        let shifts = |place: &Place| {
            let [cells, length] = [place.shift, smeared(place)].map(|way| way / scene.grid.dx);
            match frame {
                Frame::Body1 => [Shift::new(0.0), Shift::interval(cells, length)],
                Frame::Body2 => [Shift::interval(-cells, length), Shift::new(0.0)],
            }
        };
        let plain = Arc::new(plan.mirror.fold(&scene.h_init()));
        let stays = frame.moving_shape(scene).is_straight_along_x();
        let gap = |place: &Place| {
            if stays {
                return plain.clone();
            }
            Arc::new(
                plan.mirror
                    .fold(&frame.gap(scene, place.shift, smeared(place))),
            )
        };
        let h: Vec<Arc<Vec<f64>>> = places.iter().map(gap).collect();
        // Hertz's pressure at first, up to a factor.
        let approach = scene.reference_approach();
        let guess = |h: &Arc<Vec<f64>>| -> Vec<f64> {
            let lowest = h.iter().fold(f64::INFINITY, |m, h| m.min(*h));
            let pressure = |h: &f64| (1.0 - 2.0 * (h - lowest) / approach).max(0.0).sqrt();
            h.iter().map(pressure).collect()
        };
        let goes_on = state.is_some();
        let third_body = ThirdBody::new(wear, &pressing);
        let law = OwnFriction::new(scene, &pressing, frame.body());
        let mut sliding = Self {
            shifts: places.iter().map(shifts).collect(),
            p: state.unwrap_or_else(|| h.iter().map(guess).collect()),
            places,
            corners,
            pressing,
            wear: wear.clone(),
            coatings: [thicknesses(&scene.body1), thicknesses(&scene.body2)],
            mu: scene.friction.mu,
            history: scene.friction.history.clone(),
            surface: SurfaceFriction::new(scene),
            mu_of_cells: Vec::new(),
            law,
            mu_of_places: Vec::new(),
            mu_error: 0.0,
            cycles: worn.cycles,
            h,
            third_body,
            bed: Vec::new(),
            present: ThirdFields::default(),
            end: None,
            guess: None,
        };
        if goes_on {
            sliding.aerate(worn)?;
        } else {
            sliding.settle(worn)?;
        }
        Ok(sliding)
    }

    /// Solves the pressures at all places on the surfaces worn so far, so that the results belong to them.
    pub(crate) fn settle(&mut self, worn: &Worn) -> Result<(), Error> {
        self.cycles = worn.cycles;
        self.lay_bed(&worn.bed);
        self.pressing.begin();
        let none = vec![0.0; self.pressing.cells()];
        let mut h = none.clone();
        for i in 0..self.places.len() {
            self.gap(worn, i, &mut h);
            self.press(i, &h, &none, 1.0)?;
            let (grid, rows) = (&self.pressing.grid, self.pressing.rows());
            on_grid::check(grid, rows, &self.p[i], &self.shifts[i])?;
        }
        self.aerate(worn)
    }

    /// Goes back to pressures at the places.
    pub(crate) fn restore(&mut self, p: &[Vec<f64>]) {
        self.p.clone_from_slice(p);
        self.guess = None;
    }

    /// The loss of both bodies in n cycles; sets the pressures at its end. If `implicit`, it follows from
    /// these. Rates that change with the pressure are corrected until the depth settles.
    pub(crate) fn jump(&mut self, worn: &Worn, n: f64, implicit: bool) -> Result<Loss, Error> {
        self.cycles = worn.cycles;
        if let Some(third_body) = self.third_body.take() {
            let loss = self.jump_with_third_body(&third_body, worn, n, implicit);
            self.third_body = Some(third_body);
            return loss;
        }
        let mut rates = self.rates(worn, n, &ThirdFields::default())?;
        if !implicit {
            return Ok(self.loss(n, &rates, &self.integrate(&self.p)));
        }
        self.pressing.begin();
        let mut last: Option<Loss> = None;
        for correction in 0..=CORRECTIONS {
            self.iterate(worn, n, &rates, LEAST_CHANGE)?;
            let ways = self.integrate(&self.p);
            let loss = self.loss(n, &rates, &ways);
            let has_settled = |last: &Loss| {
                let cells = loss.depth.iter().flatten().zip(last.depth.iter().flatten());
                let (moved, size) = cells.fold((0.0, 0.0), |(moved, size), (now, last)| {
                    (moved + (now - last) * (now - last), size + now * now)
                });
                moved <= AGREES * AGREES * size
            };
            let ends = correction == CORRECTIONS || last.as_ref().is_some_and(has_settled);
            if ends && self.law.is_none() {
                return Ok(loss);
            }
            let corrected = self.rates(worn, n, &ThirdFields::default())?;
            if ends || corrected.agree_with(&rates, &ways) {
                // Energy by a law of the user follows from the last pressures.
                return Ok(match self.law {
                    Some(_) => self.loss(n, &corrected, &ways),
                    None => loss,
                });
            }
            last = Some(loss);
            rates = corrected;
        }
        unreachable!("the last correction returns")
    }

    /// Solves the pressures at all places at given rates, round by round, accelerated, until a round changes
    /// them by the part `least_change` (root mean squares).
    fn iterate(
        &mut self,
        worn: &Worn,
        n: f64,
        rates: &Rates,
        least_change: f64,
    ) -> Result<(), Error> {
        let mut momentum = 1.0_f64;
        let (mut around, mut last) = (self.p.clone(), self.p.clone());
        let mut buffers = Buffers::new(self.pressing.cells());
        for _ in 0..MOST_ROUNDS {
            last.clone_from(&self.p);
            self.one_round(worn, n, rates, &around, &mut buffers)?;
            let (mut change, mut size, mut turned) = (0.0, 0.0, 0.0);
            for i in 0..self.places.len() {
                for (c, p) in self.p[i].iter().enumerate() {
                    let step = p - around[i][c];
                    change += step * step;
                    size += p * p;
                    turned -= self.places[i].slip * step * (p - last[i][c]);
                }
            }
            if change <= least_change * least_change * size || self.places.len() == 1 {
                break;
            }
            let next_momentum = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
            let ahead = if turned > 0.0 {
                0.0
            } else {
                (momentum - 1.0) / next_momentum
            };
            momentum = if turned > 0.0 { 1.0 } else { next_momentum };
            for (around, (now, last)) in around.iter_mut().zip(self.p.iter().zip(&last)) {
                for (around, (now, last)) in around.iter_mut().zip(now.iter().zip(last)) {
                    *around = now + ahead * (now - last);
                }
            }
        }
        Ok(())
    }

    /// Solves the pressure at each place once, with the others kept: minimises the majorant of the energy at
    /// the pressures `around`.
    fn one_round(
        &mut self,
        worn: &Worn,
        n: f64,
        rates: &Rates,
        around: &[Vec<f64>],
        buffers: &mut Buffers,
    ) -> Result<(), Error> {
        let (s, opens) = (self.slip_distance(), self.wear.opens());
        let Buffers {
            ways,
            end,
            h,
            compliance,
        } = buffers;
        self.integrate_into(around, ways);
        for b in 0..2 {
            let cells = worn.depth[b].iter().zip(rates.depth(b, n, &ways[b]));
            for (end, (worn, lost)) in end.depth[b].iter_mut().zip(cells) {
                *end = worn + lost;
            }
        }
        for i in 0..self.places.len() {
            self.read(&rates.k, i, compliance);
            for d in compliance.iter_mut() {
                *d *= opens * n * s;
            }
            self.gap(end, i, h);
            for (h, (d, p)) in h.iter_mut().zip(compliance.iter().zip(&around[i])) {
                *h -= d * p;
            }
            self.press(i, h, compliance, ROUGH)?;
        }
        Ok(())
    }

    /// Index of the place next to the middle of the stroke.
    pub(crate) fn middle(&self) -> usize {
        let distance = |i: &usize| self.places[*i].shift.abs();
        (0..self.places.len())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(0)
    }

    /// Sum over places and cells of pressure times slip in a cycle \[Pa m\].
    fn slid_force(&self) -> f64 {
        let slid = |i: usize| self.places[i].slip * self.p[i].iter().sum::<f64>();
        (0..self.places.len()).map(slid).sum()
    }

    /// Integral of the pressure over the slip in a cycle \[N m\].
    fn loading_per_cycle(&self) -> f64 {
        self.slid_force() * self.pressing.cell_area()
    }

    /// The coefficient of friction after the cycles so far, of a fresh surface.
    fn mu(&self) -> f64 {
        let factor = self.history.as_ref().map_or(1.0, |h| h.factor(self.cycles));
        self.mu * factor
    }

    /// The loss of n cycles at given rates; `ways` are the integrals of p |ds| over a cycle, in the coordinates
    /// of each body.
    fn loss(&self, n: f64, rates: &Rates, ways: &[Vec<f64>; 2]) -> Loss {
        let depth = [0, 1].map(|b| rates.depth(b, n, &ways[b]).collect());
        let mu = self.mu();
        let energy = [0, 1].map(|b| match &rates.mu[b][..] {
            [] => ways[b].iter().map(|way| n * mu * way).collect::<Vec<f64>>(),
            of_cells => (ways[b].iter().zip(of_cells))
                .map(|(way, mu)| n * mu * way)
                .collect(),
        });
        let surface = self.surface.as_ref().map(|surface| surface.body);
        let dissipated = match surface.or(self.law.as_ref().map(|law| law.body)) {
            Some(body) => energy[body].iter().sum::<f64>() * self.pressing.cell_area(),
            None => n * self.dissipated_per_cycle(),
        };
        let slides = |p: &f64| {
            if *p > 0.0 {
                n * self.slip_distance()
            } else {
                0.0
            }
        };
        Loss {
            cycles: n,
            depth,
            slid: self.p[self.middle()].iter().map(slides).collect(),
            energy,
            dissipated,
            loading: n * self.loading_per_cycle(),
            debris: None,
        }
    }

    /// Slip distance in a cycle \[m\].
    fn slip_distance(&self) -> f64 {
        self.places.iter().map(|place| place.slip).sum()
    }

    /// The integral of a field over the slip in a cycle, in the coordinates of each body.
    fn integrate(&self, field: &[Vec<f64>]) -> [Vec<f64>; 2] {
        let mut sums = [0, 1].map(|_| vec![0.0; self.pressing.cells()]);
        self.integrate_into(field, &mut sums);
        sums
    }

    /// Computes the integral of [`Self::integrate`] into given buffers.
    fn integrate_into(&self, field: &[Vec<f64>], sums: &mut [Vec<f64>; 2]) {
        for sum in sums.iter_mut() {
            sum.fill(0.0);
        }
        for (i, place) in self.places.iter().enumerate() {
            for b in 0..2 {
                self.shifts[i][b].put(&field[i], place.slip, self.pressing.rows(), &mut sums[b]);
            }
        }
    }

    /// The rates of n cycles from worn surfaces on, at the present pressures.
    fn rates(&self, worn: &Worn, n: f64, fields: &ThirdFields) -> Result<Rates, Error> {
        let ways = self.integrate(&self.p);
        let touches = |p: &f64| f64::from(u8::from(*p > 0.0));
        let touched: Vec<Vec<f64>> = self
            .p
            .iter()
            .map(|p| p.iter().map(touches).collect())
            .collect();
        let (touched, s) = (self.integrate(&touched), self.slip_distance());
        let (mut k, mut above) = ([vec![], vec![]], [vec![], vec![]]);
        let aerated = self.carry(&fields.aerated, 1.0);
        let debris = self.carry(&fields.bed, 0.0);
        let protection = self.carry(&fields.protection, 1.0);
        let of_law = self.mu_of_law(worn, fields, &ways)?;
        let mut mu = [vec![], vec![]];
        // The body whose layers count comes first: the other one rubs against what it exposes.
        let order = if self.surface.as_ref().is_some_and(|s| s.body == 1) {
            [1, 0]
        } else {
            [0, 1]
        };
        for b in order {
            // Cells that come into contact within the jump need a coefficient, too: they get a
            // small pressed way.
            let least = 1e-9 * ways[b].iter().fold(0.0, |m: f64, w| m.max(*w));
            let pressure_times_slip: Vec<f64> = ways[b].iter().map(|w| w.max(least)).collect();
            let slip_distance: Vec<f64> = touched[b]
                .iter()
                .map(|w| if *w > 0.0 { *w } else { s })
                .collect();
            let of_cells = match &of_law {
                Some(of_law) => Some(of_law[b].clone()),
                None => self.mu_in_jump(b, worn, fields, &mu),
            };
            let level = self.mu();
            let dissipated: Vec<f64> = match &of_cells {
                None => pressure_times_slip.iter().map(|w| level * w).collect(),
                Some(mu) => (pressure_times_slip.iter().zip(mu))
                    .map(|(w, mu)| mu * w)
                    .collect(),
            };
            let friction = self.layer_factor(b, worn, (&aerated[b], &debris[b]));
            let cycle = CellCycle {
                pressure_times_slip: &pressure_times_slip,
                slip_distance: &slip_distance,
                dissipated: &dissipated,
                worn: &worn.depth[b],
                energy: &worn.energy[b],
                cycles: worn.cycles,
                frequency: self.wear.frequency.unwrap_or(f64::NAN),
                aerated: &aerated[b],
                debris: &debris[b],
                protection: &protection[b],
            };
            let Coefficients {
                mean,
                end,
                mu: in_jump,
            } = coefficients(
                &self.wear.bodies[b],
                &cycle,
                (&self.coatings[b], friction.as_deref()),
                n,
            )?;
            mu[b] = if in_jump.is_empty() {
                of_cells.unwrap_or_default()
            } else {
                in_jump
            };
            let means = mean.iter().zip(&end).zip(&ways[b]);
            above[b] = means
                .map(|((mean, end), slip_distance)| (mean - end) * slip_distance)
                .collect();
            k[b] = end;
        }
        Ok(Rates {
            k,
            excess: above,
            aerated,
            mu,
        })
    }

    /// The sum of fields of both bodies, shifted to the grid at a place.
    fn read(&self, fields: &[Vec<f64>; 2], i: usize, into: &mut [f64]) {
        into.fill(0.0);
        for (shift, field) in self.shifts[i].iter().zip(fields) {
            shift.read(field, self.pressing.rows(), into);
        }
    }

    /// Gap between the worn surfaces at a place, filled by debris \[m\].
    fn gap(&self, worn: &Worn, i: usize, into: &mut [f64]) {
        self.read(&worn.depth, i, into);
        let opens = self.wear.opens();
        into.iter_mut()
            .zip(self.h[i].iter())
            .for_each(|(gap, h)| *gap = opens * *gap + h);
        for (gap, bed) in into.iter_mut().zip(&self.bed) {
            *gap -= bed;
        }
    }

    /// Solves the pressure at a place to `times` the tolerance of the scene.
    fn press(&mut self, i: usize, h: &[f64], compliance: &[f64], times: f64) -> Result<(), Error> {
        let drive = self.pressing.drive(self.places[i].W);
        self.pressing
            .solve(h, compliance, drive, &mut self.p[i], times)?;
        Ok(())
    }
}

/// Rates of wear of both bodies in a jump.
struct Rates {
    /// Coefficient in the last cycle \[1/Pa\].
    k: [Vec<f64>; 2],
    /// Difference of the mean depth of a cycle and the depth of the last cycle \[m\].
    excess: [Vec<f64>; 2],
    /// Aerated share; empty without a model of the air.
    aerated: [Vec<f64>; 2],
    /// Mean coefficient of friction of the cells; empty where it is uniform.
    mu: [Vec<f64>; 2],
}

impl Rates {
    /// Checks that the rates agree with others to rounding; `ways` are the loadings `int p |ds|` of
    /// a cycle.
    fn agree_with(&self, other: &Self, ways: &[Vec<f64>; 2]) -> bool {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |size, a| size.max(a.abs()));
        let same = |one: &[f64], other: &[f64], size: f64| {
            let mut cells = one.iter().zip(other);
            cells.all(|(one, other)| (one - other).abs() <= ROUNDING * size)
        };
        (0..2).all(|b| {
            let k = largest(&self.k[b]);
            same(&self.k[b], &other.k[b], k)
                && same(&self.excess[b], &other.excess[b], k * largest(&ways[b]))
        })
    }

    /// Depth of body b in n cycles of these pressed ways \[m\].
    fn depth(&self, b: usize, n: f64, ways: &[f64]) -> impl Iterator<Item = f64> {
        let cells = self.k[b].iter().zip(&self.excess[b]).zip(ways);
        cells.map(move |((k, above), way)| (n * (k * way + above)).max(0.0))
    }
}

/// Buffers of the rounds of a jump.
struct Buffers {
    /// Integral of the pressure over the slip in a cycle, in the coordinates of each body \[Pa m\].
    ways: [Vec<f64>; 2],
    /// Worn depth at the end of the jump \[m\].
    end: Worn,
    /// Gap at a place \[m\].
    h: Vec<f64>,
    /// Compliance at a place \[m/Pa\].
    compliance: Vec<f64>,
}

impl Buffers {
    /// Allocates buffers for so many cells.
    fn new(cells: usize) -> Self {
        Self {
            ways: [vec![0.0; cells], vec![0.0; cells]],
            end: Worn::unworn(cells),
            h: vec![0.0; cells],
            compliance: vec![0.0; cells],
        }
    }
}
