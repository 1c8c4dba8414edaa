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

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::plan::Plan;
use contact_core::scene::{FrictionHistory, Scene};

use super::course::{Coefficients, LayerFactor, coefficients};
use super::fixed_point::{FixedPoint, MOST_EVALUATIONS, Step};
use super::law::CellCycle;
use super::loss::{Loss, Worn};
use super::on_grid;
use super::pressing::Pressing;
use super::settings::{Wear, thicknesses};
use super::shift::Shift;
use super::stroke::{Corner, Frame, Place, stroke};
use super::surface_friction::SurfaceFriction;
use super::third_body::{Meeting, ThirdBody, ThirdFields};

/// Change of the pressures in a round that ends the rounds, over the pressures (root mean squares).
const LEAST_CHANGE: f64 = 1e-3;
/// Times the tolerance of the scene to which the pressures of a round are solved.
const ROUGH: f64 = 10.0;
/// Most corrections of a law that changes within a jump, and the relative change of the depth (root
/// mean squares) that ends them.
const CORRECTIONS: usize = 8;
/// Evaluations of the oxygen under friction that depends on it.
const AERATIONS: usize = 8;
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
    /// Aerated share of the settled contact; empty without a model of the air.
    pub(crate) aerated: Vec<f64>,
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
            mu_error: 0.0,
            cycles: worn.cycles,
            h,
            third_body,
            bed: Vec::new(),
            aerated: Vec::new(),
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

    /// Computes the aerated share and the coefficients of friction for the present pressures.
    fn aerate(&mut self, worn: &Worn) -> Result<(), Error> {
        self.aerated.clear();
        if let Some(third_body) = self.third_body.take() {
            self.lay_bed(&worn.bed);
            // Friction that depends on the oxygen heats the contact that consumes it.
            let coupled = self
                .surface
                .as_ref()
                .is_some_and(SurfaceFriction::depends_on_air);
            for _ in 0..if coupled { AERATIONS } else { 1 } {
                let contact = self.meet(worn, &self.aerated.clone());
                let fields = third_body.begin(worn, &contact.meeting())?;
                self.aerated = fields.aerated;
            }
            self.third_body = Some(third_body);
        }
        self.mu_of_cells = match &self.surface {
            Some(surface) => {
                let fields = ThirdFields::present(&self.aerated, &self.bed);
                self.mu_of_body(surface, surface.body, worn, &fields)
            }
            None => Vec::new(),
        };
        self.mu_error = self.surface.as_ref().map_or(0.0, |surface| {
            let ways = &self.integrate(&self.p)[surface.body];
            let rows = self.pressing.rows();
            surface.error(rows, ways, &self.mu_of_cells, &worn.depth[surface.body])
        });
        Ok(())
    }

    /// Coefficients of friction of the cells of body b, before their dependence on cycles.
    fn mu_of_body(
        &self,
        surface: &SurfaceFriction,
        b: usize,
        worn: &Worn,
        fields: &ThirdFields,
    ) -> Vec<f64> {
        let aerated = &self.carry(&fields.aerated, 1.0)[b];
        let bed = &self.carry(&fields.bed, 0.0)[b];
        let of_layers = surface.mu_of_layers(&worn.depth[surface.body]);
        let of_layers = if b == surface.body || !surface.has_layers() {
            of_layers
        } else {
            self.carry_across(&of_layers, surface.body)
        };
        let cells = of_layers.iter().enumerate();
        cells
            .map(|(c, mu)| surface.combine(*mu, c, aerated, bed))
            .collect()
    }

    /// A field of body `from` in the coordinates of the other body: for each cell the mean over all cells that
    /// pass it, weighted with the pressure.
    fn carry_across(&self, field: &[f64], from: usize) -> Vec<f64> {
        let largest = self.p.iter().flatten().fold(0.0, |m: f64, p| m.max(*p));
        let least = 1e-9 * largest + f64::MIN_POSITIVE;
        let (rows, to) = (self.pressing.rows(), 1 - from);
        let mut sums = [0, 1].map(|_| vec![0.0; field.len()]);
        for (i, place) in self.places.iter().enumerate() {
            let mut at_place = vec![0.0; field.len()];
            self.shifts[i][from].read(field, rows, &mut at_place);
            let weight: Vec<f64> = self.p[i].iter().map(|p| p + least).collect();
            let product: Vec<f64> = weight.iter().zip(&at_place).map(|(w, f)| w * f).collect();
            self.shifts[i][to].put(&product, place.slip, rows, &mut sums[0]);
            self.shifts[i][to].put(&weight, place.slip, rows, &mut sums[1]);
        }
        let mean = |(c, (sum, weight)): (usize, (&f64, &f64))| {
            if *weight > 0.0 {
                sum / weight
            } else {
                field[c]
            }
        };
        let cells = sums[0].iter().zip(&sums[1]).enumerate();
        cells.map(mean).collect()
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
            self.iterate(worn, n, &rates)?;
            let ways = self.integrate(&self.p);
            let loss = self.loss(n, &rates, &ways);
            let has_settled = |last: &Loss| {
                let cells = loss.depth.iter().flatten().zip(last.depth.iter().flatten());
                let (moved, size) = cells.fold((0.0, 0.0), |(moved, size), (now, last)| {
                    (moved + (now - last) * (now - last), size + now * now)
                });
                moved <= AGREES * AGREES * size
            };
            if correction == CORRECTIONS || last.as_ref().is_some_and(has_settled) {
                return Ok(loss);
            }
            let corrected = self.rates(worn, n, &ThirdFields::default())?;
            if corrected.agree_with(&rates, &ways) {
                return Ok(loss);
            }
            last = Some(loss);
            rates = corrected;
        }
        unreachable!("the last correction returns")
    }

    /// The loss of both bodies in n cycles with oxygen and debris, which follow from the contact at the end of
    /// the jump.
    fn jump_with_third_body(
        &mut self,
        third_body: &ThirdBody,
        worn: &Worn,
        n: f64,
        implicit: bool,
    ) -> Result<Loss, Error> {
        self.lay_bed(&worn.bed);
        self.pressing.begin();
        let before = self.meet(worn, &self.aerated.clone());
        let mut fields = third_body.begin(worn, &before.meeting())?;
        let mut fixed_point = FixedPoint::default();
        for _ in 0..MOST_EVALUATIONS {
            self.lay_bed(&fields.bed);
            let rates = self.rates(worn, n, &fields)?;
            if implicit {
                self.iterate(worn, n, &rates)?;
            }
            let mut loss = self.loss(n, &rates, &self.integrate(&self.p));
            let (supply, lost) = self.supply(third_body, worn, &loss, &rates.aerated);
            let after = if implicit {
                let mut end = worn.clone();
                end.add(&loss);
                Some(self.meet(&end, &fields.aerated))
            } else {
                None
            };
            let meeting = after.as_ref().unwrap_or(&before).meeting();
            let image = third_body.respond(worn, &meeting, (n, &supply, lost), &fields)?;
            loss.debris = image.to_debris();
            if !implicit {
                return Ok(loss);
            }
            match fixed_point.advance(third_body, (worn, loss), &fields, image) {
                Step::Settled(loss) => return Ok(loss),
                Step::Next(next) => fields = next,
            }
        }
        Err(fixed_point.not_converged())
    }

    /// Lays the bed of debris \[m\] into the gap, if the run has one.
    fn lay_bed(&mut self, bed: &[f64]) {
        if self.wear.bed.is_some() {
            self.bed.clear();
            self.bed.extend_from_slice(bed);
        }
    }

    /// Gap, pressure, dissipated energy and slip under the present pressures, from which oxygen and debris
    /// follow; `aerated` is the aerated share so far.
    fn meet(&mut self, worn: &Worn, aerated: &[f64]) -> Contact {
        let (cells, s) = (self.pressing.cells(), self.slip_distance());
        let mut contact = Contact {
            gap: vec![0.0; cells],
            p: vec![0.0; cells],
            dissipated: Vec::new(),
            slip: vec![s; cells],
        };
        let mut h = vec![0.0; cells];
        for i in 0..self.places.len() {
            self.gap(worn, i, &mut h);
            let weight = self.places[i].slip / s;
            let gap = self.pressing.loaded_gap(&h, &self.p[i]);
            for c in 0..cells {
                contact.gap[c] += weight * gap[c];
                contact.p[c] += weight * self.p[i][c];
            }
        }
        contact.dissipated = contact.p.iter().map(|p| self.mu() * s * p).collect();
        if let Some(surface) = &self.surface {
            let of_layers = surface.mu_of_layers(&worn.depth[surface.body]);
            let mut mu = vec![0.0; cells];
            let mut at_place = vec![0.0; cells];
            for i in 0..self.places.len() {
                at_place.fill(0.0);
                let shift = &self.shifts[i][surface.body];
                shift.read(&of_layers, self.pressing.rows(), &mut at_place);
                let weight = self.places[i].slip / s;
                mu.iter_mut()
                    .zip(&at_place)
                    .for_each(|(mu, f)| *mu += weight * f);
            }
            for c in 0..cells {
                let mu = surface.combine(mu[c], c, aerated, &self.bed);
                contact.dissipated[c] *= mu / self.mu;
            }
        }
        contact
    }

    /// The fresh debris of a loss in the cells of the grid, spread over the stroke \[m\], and the sum of what
    /// leaves the contact at once. `aerated` are the aerated shares in the coordinates of both bodies.
    fn supply(
        &self,
        third_body: &ThirdBody,
        worn: &Worn,
        loss: &Loss,
        aerated: &[Vec<f64>; 2],
    ) -> (Vec<f64>, f64) {
        let mut supply = vec![0.0; self.pressing.cells()];
        let (mut lost, s) = (0.0, self.slip_distance());
        for b in 0..2 {
            let yields = |c: usize| {
                let starved = aerated[b].get(c).map_or(0.0, |s| {
                    self.wear.bodies[b].starved_part(worn.depth[b][c], &self.coatings[b], *s)
                });
                third_body.yields(starved)
            };
            let cells = loss.depth[b].iter().enumerate();
            let [fresh, at_once]: [Vec<f64>; 2] =
                [0, 1].map(|k| cells.clone().map(|(c, w)| w * yields(c)[k]).collect());
            lost += at_once.iter().sum::<f64>();
            for (i, place) in self.places.iter().enumerate() {
                let weighted: Vec<f64> = fresh.iter().map(|w| w * place.slip / s).collect();
                self.shifts[i][b].read(&weighted, self.pressing.rows(), &mut supply);
            }
        }
        (supply, lost)
    }

    /// A field of the grid in the coordinates of each body: for each cell the mean over all that passes it,
    /// weighted with the pressure; `outside` where nothing passes.
    fn carry(&self, field: &[f64], outside: f64) -> [Vec<f64>; 2] {
        if field.is_empty() {
            return [vec![], vec![]];
        }
        let largest = self.p.iter().flatten().fold(0.0, |m: f64, p| m.max(*p));
        let least = 1e-9 * largest + f64::MIN_POSITIVE;
        let weights: Vec<Vec<f64>> = self
            .p
            .iter()
            .map(|p| p.iter().map(|p| p + least).collect())
            .collect();
        let products: Vec<Vec<f64>> = weights
            .iter()
            .map(|p| p.iter().zip(field).map(|(p, f)| p * f).collect())
            .collect();
        let (sums, weights) = (self.integrate(&products), self.integrate(&weights));
        [0, 1].map(|b| {
            let cells = sums[b].iter().zip(&weights[b]);
            let mean =
                |(sum, weight): (&f64, &f64)| if *weight > 0.0 { sum / weight } else { outside };
            cells.map(mean).collect()
        })
    }

    /// Solves the pressures at all places at given rates, round by round, accelerated, until they settle.
    fn iterate(&mut self, worn: &Worn, n: f64, rates: &Rates) -> Result<(), Error> {
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
            if change <= LEAST_CHANGE * LEAST_CHANGE * size || self.places.len() == 1 {
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

    /// Energy dissipated in a cycle with the present pressures \[J\].
    pub(crate) fn dissipated_per_cycle(&self) -> f64 {
        if let Some(surface) = &self.surface {
            let ways = &self.integrate(&self.p)[surface.body];
            let products = ways.iter().zip(&self.mu_of_cells).map(|(way, mu)| way * mu);
            return products.sum::<f64>() * (self.mu() / self.mu) * self.pressing.cell_area();
        }
        self.mu() * self.slid_force() * self.pressing.cell_area()
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

    /// Mean coefficient of friction, weighted with the pressure.
    pub(crate) fn mean_mu(&self) -> f64 {
        let Some(surface) = &self.surface else {
            return self.mu();
        };
        let ways = &self.integrate(&self.p)[surface.body];
        let sum: f64 = ways
            .iter()
            .zip(&self.mu_of_cells)
            .map(|(w, mu)| w * mu)
            .sum();
        let loading: f64 = ways.iter().sum();
        self.mu() / self.mu
            * if loading > 0.0 {
                sum / loading
            } else {
                self.mu
            }
    }

    /// Factor of the force in the corners of the stroke, whose coefficient is the one before any cycle.
    pub(crate) fn force_factor(&self) -> f64 {
        self.mean_mu() / self.mu
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
        let dissipated = match &self.surface {
            Some(surface) => energy[surface.body].iter().sum::<f64>() * self.pressing.cell_area(),
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
            let (level, of_cells) = (self.mu(), self.mu_in_jump(b, worn, fields, &mu));
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

    /// The coefficients of friction of body b in a jump: at its start for the body whose layers count,
    /// for the other one those that the first body has on average in the jump.
    fn mu_in_jump(
        &self,
        b: usize,
        worn: &Worn,
        fields: &ThirdFields,
        known: &[Vec<f64>; 2],
    ) -> Option<Vec<f64>> {
        let surface = self.surface.as_ref()?;
        if b != surface.body && surface.has_layers() {
            return Some(self.carry_across(&known[surface.body], surface.body));
        }
        let factor = self.mu() / self.mu;
        let mut mu = self.mu_of_body(surface, b, worn, fields);
        for mu in &mut mu {
            *mu *= factor;
        }
        Some(mu)
    }

    /// Factor of the energy of a cell by its layer, for the body whose layers count.
    fn layer_factor<'a>(
        &'a self,
        b: usize,
        worn: &'a Worn,
        (aerated, bed): (&'a [f64], &'a [f64]),
    ) -> Option<Box<LayerFactor<'a>>> {
        let surface = self.surface.as_ref();
        let surface = surface.filter(|s| s.body == b && s.has_layers())?;
        let mu = move |c: usize, layer: usize| {
            surface.combine(surface.mu_of_layer(layer), c, aerated, bed)
        };
        Some(Box::new(move |c, layer| {
            mu(c, layer) / mu(c, surface.layer(worn.depth[b][c]))
        }))
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

/// The contact that the third body meets.
struct Contact {
    gap: Vec<f64>,
    p: Vec<f64>,
    dissipated: Vec<f64>,
    slip: Vec<f64>,
}

impl Contact {
    /// The fields that the third body needs, by reference.
    fn meeting(&self) -> Meeting<'_> {
        Meeting {
            gap: &self.gap,
            p: &self.p,
            dissipated: &self.dissipated,
            slip: &self.slip,
        }
    }
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
