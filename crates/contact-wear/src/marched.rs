//! Cycles of any load path, solved increment by increment.
//!
//! One cycle through [`March`] on given surfaces gives for every cell the integral
//! `P = int p |ds|`, the way slipped and the energy dissipated. A jump of n cycles is implicit in
//! the pressure:
//!
//! ```text
//! w = n k sigma p,   sigma = P/p_m                      of the cycle
//! g = h + (1 - kept)(w_0 + w) + C p + u_q - delta_z >= 0,  p >= 0,  p g = 0
//! ```
//!
//! p_m being the mean pressure of the cycle, weighted with the energy dissipated in its increments,
//! and u_q the mean normal displacement under the shear with the same weights, less the mean gap of
//! cells that are in contact in a part of the cycle only, so that p = p_m for n = 0. `kept` is the
//! part of the worn volume that stays in the contact as debris. The normal problem has the
//! compliance (1 - kept) n k sigma, whatever the loads within the cycle. Predictor: sigma of the
//! last cycle. Corrector: a cycle is solved on the predicted surfaces and the jump repeated with
//! its sigma, until pressure and worn depth no longer change.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::cells::Drive;
use contact_core::march::{ExposedSurface, Increment, March, Reached, State};
use contact_core::scene::{Branch, Dependence, Friction, FrictionHistory, PathGrid, Scene};
use serde::{Deserialize, Serialize};

use super::course::{LayerFactor, coefficients};
use super::cycled::{CycleResults, Sums};
use super::fixed_point::{FixedPoint, MOST_EVALUATIONS, Step};
use super::law::{CellCycle, layer_at};
use super::loss::{Loss, Worn};
use super::outward::extrapolate_outward;
use super::pressing::Pressing;
use super::rates::Rates;
use super::settings::{Jumps, Wear, thicknesses};
use super::surface_friction::SurfaceFriction;
use super::third_body::{Meeting, ThirdBody, ThirdFields};
use super::within_cell::half_cell_error;

/// Change of the pressure between two corrections (root mean square, over the pressure) that ends
/// them.
const AGREES: f64 = 0.02;
/// Change of the worn depth between two corrections (root mean square) that ends them: over that
/// worn in the jump, or over the part of the worn depth that the jump may leave as an error
/// (`USUAL` where jumps are given).
const AGREES_IN_JUMP: f64 = 0.05;
const AGREES_IN_ALL: f64 = 0.1;
const USUAL: f64 = 0.01;
/// Most corrections of a jump. A jump that has not converged by then is too long.
const CORRECTIONS: usize = 8;

/// The state on which the next jump depends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct MarchedState {
    /// The state of the march at the start of a cycle.
    start: State,
    cycled: CycleResults,
}

/// Cycles through the march.
pub(crate) struct Marched {
    pub(crate) pressing: Pressing,
    march: March,
    wear: Wear,
    coatings: [Vec<f64>; 2],
    /// Gap between the unworn surfaces \[m\].
    h: Vec<f64>,
    /// Increments before the cycle.
    lead_in: usize,
    /// First branch of the cycle, after the branch in which the contact adapts.
    first_branch: usize,
    gives_approach: bool,
    /// The coefficient of friction, if uniform, before its dependence on cycles.
    uniform_mu: Option<f64>,
    /// Its dependence on history.
    history: Option<FrictionHistory>,
    /// True if friction depends on the past of a cell, by a history or a law of the user.
    depends_on_past: bool,
    pub(crate) state: MarchedState,
    /// Mean pressure at the end of the last jump \[Pa\].
    pub(crate) p: Vec<f64>,
    /// Cycles solved so far.
    pub(crate) cycles_solved: usize,
    /// Oxygen and debris in the contact.
    third_body: Option<ThirdBody>,
    /// Aerated share of the settled contact; empty without a model of the air.
    pub(crate) aerated: Vec<f64>,
    /// Aerated share of the surfaces of the next cycle.
    cycle_aerated: Vec<f64>,
    /// Dependence of friction on the exposed surface, and whether a user's law has one.
    surface: Option<SurfaceFriction>,
    has_law: bool,
    /// The coefficient of a fresh surface.
    pub(crate) nominal_mu: f64,
    /// Error of the mean coefficient by the cells, over it.
    pub(crate) mu_error: f64,
}

impl Marched {
    /// Solves the lead-in and one cycle on the surfaces `worn` so far, or continues from a `state` without
    /// solving.
    pub(crate) fn new(
        scene: &Scene,
        wear: &Wear,
        state: Option<MarchedState>,
        worn: &Worn,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let (mut scene, first_branch) = (scene.clone(), wear.first_branch(scene)?);
        let settles = Branch {
            increments: Some(1),
            path_error: None,
            ..scene.path.branches[first_branch - 1]
        };
        // A branch without a change of loads, in which the contact adapts to the worn surfaces.
        scene.path.branches.insert(first_branch, settles);
        for (i, branch) in scene.path.branches.iter_mut().enumerate() {
            branch.t_end = (i + 1) as f64;
        }
        scene.settings.skip.contact_window = false;
        scene.settings.solver.path_grid = PathGrid::Same;
        let mut march = March::until(&scene, stop)?;
        let scene = march.scene().clone();
        let points = march.points();
        let lead_in = points
            .iter()
            .take_while(|p| p.branch < first_branch)
            .count();
        let plan = march.plan().clone();
        let h = plan.mirror.fold(&scene.h_init());
        let mut reached = Reached::default();
        let goes_on = state.is_some();
        if !goes_on {
            if worn.deepest() > 0.0 {
                let gap = gap(&h, worn, wear.opens());
                if let Some(surface) = SurfaceFriction::new(&scene) {
                    let mu = surface.of_cells(&worn.depth[surface.body], &[], &worn.bed);
                    march.expose(ExposedSurface {
                        friction: mu.iter().map(|mu| mu / scene.friction.mu).collect(),
                        ..ExposedSurface::default()
                    });
                }
                march.go_on_from(march.state().clone(), &gap);
            }
            for _ in 0..lead_in {
                reached.see(&advance(&mut march)?);
            }
        }
        reached.check(&scene)?;
        let begins = || MarchedState {
            start: march.state().clone(),
            cycled: CycleResults::default(),
        };
        let state = state.unwrap_or_else(begins);
        let pressing = Pressing::new(&scene, &plan, stop)?;
        let mut marched = Self {
            h,
            coatings: [thicknesses(&scene.body1), thicknesses(&scene.body2)],
            gives_approach: scene.path.branches[first_branch].to.given.delta_z.is_some(),
            uniform_mu: uniform_mu(&scene.friction),
            history: scene.friction.history.clone(),
            depends_on_past: scene.friction.history.is_some() || scene.friction.law.is_some(),
            p: Vec::new(),
            third_body: ThirdBody::new(wear, &pressing),
            aerated: Vec::new(),
            cycle_aerated: Vec::new(),
            surface: SurfaceFriction::new(&scene),
            has_law: scene.friction.law.is_some(),
            nominal_mu: scene.friction.mu,
            mu_error: 0.0,
            state,
            wear: wear.clone(),
            pressing,
            march,
            lead_in,
            first_branch: first_branch + 1,
            cycles_solved: 0,
        };
        if goes_on {
            marched.aerate(worn)?;
        } else {
            marched.settle(worn)?;
        }
        Ok(marched)
    }

    /// Solves a cycle on the surfaces worn so far, so that its results belong to them; the next one starts from
    /// its end.
    pub(crate) fn settle(&mut self, worn: &Worn) -> Result<(), Error> {
        let (cycled, mut start) = self.cycle(worn)?;
        start.increments = self.lead_in;
        self.state = MarchedState { start, cycled };
        self.aerate(worn)
    }

    /// Computes the aerated share of the present contact.
    fn aerate(&mut self, worn: &Worn) -> Result<(), Error> {
        if let Some(third_body) = self.third_body.take() {
            let p = self.state.cycled.p.clone();
            let fields = self.begin_third_body(&third_body, worn, &p);
            self.third_body = Some(third_body);
            self.aerated = fields?.0.aerated;
        }
        self.cycle_aerated.clone_from(&self.aerated);
        self.mu_error = self.surface.as_ref().map_or(0.0, |surface| {
            let cycled = &self.state.cycled;
            let cells = cycled.dissipated.iter().zip(&cycled.pressure_times_slip);
            let mu = |(energy, way): (&f64, &f64)| if *way > 0.0 { energy / way } else { 0.0 };
            let mu: Vec<f64> = cells.map(mu).collect();
            let (rows, ways) = (self.pressing.rows(), &cycled.pressure_times_slip);
            surface.error(rows, ways, &mu, &worn.depth[surface.body])
        });
        Ok(())
    }

    /// Exposes worn surfaces to the friction of the next cycle; returns its coefficients, empty where
    /// the surface is fresh.
    fn expose(&mut self, worn: &Worn) -> Vec<f64> {
        if self.surface.is_none() && !self.has_law {
            return Vec::new();
        }
        let surface = self.surface.as_ref();
        let mu = surface.map_or_else(Vec::new, |surface| {
            surface.of_cells(&worn.depth[surface.body], &self.cycle_aerated, &worn.bed)
        });
        let layer = [0, 1].map(|b| {
            let layers = &self.coatings[b];
            let depths = worn.depth[b].iter();
            depths.map(|w| layer_at(*w, layers) as f64).collect()
        });
        self.march.expose(ExposedSurface {
            friction: mu.iter().map(|mu| mu / self.nominal_mu).collect(),
            worn: worn.depth.clone(),
            layer,
            bed: worn.bed.clone(),
            aerated: self.cycle_aerated.clone(),
        });
        mu
    }

    /// The fields of oxygen and debris before a jump, under the pressure p, and the gap that they follow from.
    fn begin_third_body(
        &mut self,
        third_body: &ThirdBody,
        worn: &Worn,
        p: &[f64],
    ) -> Result<(ThirdFields, Vec<f64>), Error> {
        let cycled = &self.state.cycled;
        let unloaded = gap(&self.h, worn, self.wear.opens());
        let h: Vec<f64> = unloaded
            .iter()
            .zip(&cycled.u_q)
            .map(|(h, u)| h + u)
            .collect();
        let gap = self.pressing.loaded_gap(&h, p);
        let cycled = &self.state.cycled;
        let meeting = Meeting {
            gap: &gap,
            p,
            dissipated: &cycled.dissipated,
            slip: &cycled.slip_distance,
        };
        let fields = third_body.begin(worn, &meeting)?;
        Ok((fields, gap))
    }

    /// The loss of both bodies in n cycles.
    pub(crate) fn jump(&mut self, worn: &Worn, n: f64, implicit: bool) -> Result<Loss, Error> {
        self.cycle_aerated.clone_from(&self.aerated);
        let mut p = self.state.cycled.p.clone();
        if !implicit {
            return self.loss_of_jump(worn, n, &mut p, false);
        }
        self.pressing.begin();
        let may_leave = AGREES_IN_ALL
            * match self.wear.jumps {
                Jumps::Tolerance(tolerance) => tolerance,
                Jumps::Number(_) | Jumps::Explicit(_) => USUAL,
            };
        let mut last: Option<(Vec<f64>, Loss)> = None;
        for correction in 0..=CORRECTIONS {
            let loss = self.loss_of_jump(worn, n, &mut p, true)?;
            if let Some((last_p, last_loss)) = &last {
                let change = last_loss.depth_change(&loss);
                let enough = (AGREES_IN_JUMP * depth_norm(&loss.depth))
                    .max(may_leave * depth_norm(&worn.depth));
                if agree(last_p, &p) && change <= enough {
                    self.p = p;
                    return Ok(loss);
                }
                if correction == CORRECTIONS {
                    return Err(Error::NotConverged {
                        increment: 0,
                        solver: "wear",
                        residual: change,
                        tolerance: enough,
                        iterations: CORRECTIONS,
                        why: String::new(),
                    });
                }
            }
            let mut end = worn.clone();
            end.add(&loss);
            last = Some((p.clone(), loss));
            let (cycled, _) = self.cycle(&end)?;
            self.state.cycled = cycled;
        }
        unreachable!("the last correction returns")
    }

    /// The loss in a jump of n cycles that are like the last one. `p` holds the pressure at its start, and at
    /// its end on return. If `implicit`, the loss follows from the pressure at the end.
    fn loss_of_jump(
        &mut self,
        worn: &Worn,
        n: f64,
        p: &mut Vec<f64>,
        implicit: bool,
    ) -> Result<Loss, Error> {
        if let Some(third_body) = self.third_body.take() {
            let loss = self.loss_with_third_body(&third_body, worn, n, p, implicit);
            self.third_body = Some(third_body);
            return loss;
        }
        let rates = self.rates(worn, &self.state.cycled, n, &ThirdFields::default())?;
        self.loss_at_rates(worn, n, &rates, &worn.bed, p, implicit)
    }

    /// Solves a jump of n cycles with oxygen and debris, which follow from the contact at its end: an iteration
    /// to a fixed point. `p` is the pressure at the start, and at the end when it returns.
    fn loss_with_third_body(
        &mut self,
        third_body: &ThirdBody,
        worn: &Worn,
        n: f64,
        p: &mut Vec<f64>,
        implicit: bool,
    ) -> Result<Loss, Error> {
        let cells = self.h.len();
        let start = gap(&self.h, worn, self.wear.opens());
        let mut h = vec![0.0; cells];
        let (mut fields, mut closed) = self.begin_third_body(third_body, worn, p)?;
        let mut fixed_point = FixedPoint::default();
        for _ in 0..MOST_EVALUATIONS {
            let rates = self.rates(worn, &self.state.cycled, n, &fields)?;
            let bed = if fields.bed.is_empty() {
                &worn.bed
            } else {
                &fields.bed
            };
            let loss = self.loss_at_rates(worn, n, &rates, bed, p, implicit)?;
            if implicit {
                for c in 0..cells {
                    let depth = loss.depth[0][c] + loss.depth[1][c];
                    h[c] =
                        start[c] + rates.u_q[c] + self.wear.opens() * depth + worn.bed[c] - bed[c];
                }
                closed = self.pressing.loaded_gap(&h, p);
            }
            let mut lost = 0.0;
            let mut supply = vec![0.0; cells];
            for b in 0..2 {
                for (c, w) in loss.depth[b].iter().enumerate() {
                    let starved = fields.aerated.get(c).map_or(0.0, |s| {
                        self.wear.bodies[b].starved_part(worn.depth[b][c], &self.coatings[b], *s)
                    });
                    let [fresh, at_once] = third_body.yields(starved);
                    supply[c] += w * fresh;
                    lost += w * at_once;
                }
            }
            let dissipated: Vec<f64> = (0..cells)
                .map(|c| rates.mu[c] * rates.sigma[c] * p[c])
                .collect();
            let meeting = Meeting {
                gap: &closed,
                p,
                dissipated: &dissipated,
                slip: &rates.slips,
            };
            let jump = (n, &supply[..], lost);
            let image = third_body.respond(worn, &meeting, jump, &fields)?;
            self.cycle_aerated.clone_from(&image.aerated);
            let step = fixed_point.advance((third_body, implicit), (worn, loss), &fields, image);
            let (mut loss, image) = match step {
                Step::Settled(loss, image) => (loss, image),
                Step::Next(next) => {
                    fields = next;
                    continue;
                }
            };
            loss.debris = third_body.debris(worn, &rates.slips, jump, &image)?;
            return Ok(loss);
        }
        Err(fixed_point.not_converged())
    }

    /// The loss at known rates over a known bed; an implicit jump solves the pressure at its end.
    fn loss_at_rates(
        &mut self,
        worn: &Worn,
        n: f64,
        rates: &Rates,
        bed: &[f64],
        p: &mut [f64],
        implicit: bool,
    ) -> Result<Loss, Error> {
        let (area, shortest_waves) = (self.pressing.cell_area(), self.pressing.shortest_waves());
        let opens = self.wear.opens();
        let in_jump = rates.in_jump(n, (worn, opens), p, shortest_waves);
        if implicit {
            let cells = self.h.len();
            let compliance: Vec<f64> = (0..cells)
                .map(|c| opens * (rates.k[0][c] + rates.k[1][c]) * in_jump.slip[c])
                .collect();
            let gap = gap(&self.h, worn, opens);
            let excess =
                |c: usize| opens * (rates.excess[0][c] + rates.excess[1][c]) * in_jump.slip[c];
            let h: Vec<f64> = (0..cells)
                .map(|c| {
                    gap[c] + rates.u_q[c] + excess(c) - compliance[c] * in_jump.borne[c]
                        + (worn.bed[c] - bed[c])
                })
                .collect();
            self.pressing.solve(&h, &compliance, rates.drive, p, 1.0)?;
        }
        Ok(in_jump.loss(rates, p, area))
    }

    /// The results of the last cycle.
    pub(crate) fn cycled(&self) -> &CycleResults {
        &self.state.cycled
    }

    /// Error of the worn depth by the place of the border of the stick zone within its cell, for
    /// the limit of endless wear \[m\].
    pub(crate) fn border_error(&mut self, worn: &Worn) -> Result<f64, Error> {
        let CycleResults { stick, cuts, p, .. } = &self.state.cycled;
        let surfaces = (worn, self.wear.opens());
        // Of bare and like bodies the shortfall is a root at the border to the end.
        let coated = self.coatings.iter().any(|layers| !layers.is_empty());
        let cuts = if coated || self.march.plan().coupling {
            &[]
        } else {
            &cuts[..]
        };
        half_cell_error(&mut self.pressing, stick, cuts, p, surfaces)
    }

    /// The coefficient of friction after so many cycles, if it is uniform.
    fn mu(&self, cycles: f64) -> Option<f64> {
        let factor = self.history.as_ref().map_or(1.0, |h| h.factor(cycles));
        self.uniform_mu.map(|mu| mu * factor)
    }

    /// Solves one cycle on worn surfaces; returns its results and the state of the march at its end.
    fn cycle(&mut self, worn: &Worn) -> Result<(CycleResults, State), Error> {
        let gap = gap(&self.h, worn, self.wear.opens());
        let mut start = self.state.start.clone();
        if self.depends_on_past {
            // The history that friction depends on includes all cycles so far.
            start.slip_length.clone_from(&worn.slid);
            start.dissipated.clone_from(&worn.energy[0]);
        }
        let surface_mu = self.expose(worn);
        self.march.go_on_from(start, &gap);
        self.march.after_cycles(worn.cycles);
        // The contact adapts to the worn surfaces; the slip of this increment belongs to no cycle.
        advance(&mut self.march)?;
        let cells = self.h.len();
        let mut sums = Sums::new(cells, self.mu(worn.cycles));
        let increments = self.march.points().len() - self.lead_in - 1;
        for _ in 0..increments {
            let before = self.march.state().clone();
            let increment = advance(&mut self.march)?;
            let branch = increment.point.branch - self.first_branch;
            let count = self.wear.branch_count(branch);
            sums.add(&before, self.march.state(), &increment, count);
        }
        self.cycles_solved += 1;
        let state = self.march.state().clone();
        let coupling = self.march.plan().coupling;
        let mut cycled = sums.finish(
            &mut self.pressing,
            coupling,
            (worn, self.wear.opens()),
            &gap,
        );
        cycled.surface_mu = surface_mu;
        Ok((cycled, state))
    }

    /// Rates of wear of every cell in n cycles from worn surfaces on. Cells outside the contact get
    /// the mean of their neighbours.
    fn rates(
        &self,
        worn: &Worn,
        cycled: &CycleResults,
        n: f64,
        fields: &ThirdFields,
    ) -> Result<Rates, Error> {
        let cells = self.h.len();
        let largest = cycled.p.iter().fold(0.0, |m: f64, p| m.max(*p));
        let is_pressed =
            |c: usize| cycled.p[c] > 1e-6 * largest && cycled.pressure_times_slip[c] >= 0.0;
        let rows = self.pressing.rows();
        let mut sigma = extrapolate_outward(rows, cells, |c| {
            is_pressed(c).then(|| cycled.pressure_times_slip[c] / cycled.p[c])
        });
        let mut mu = extrapolate_outward(rows, cells, |c| {
            let slips = is_pressed(c) && cycled.pressure_times_slip[c] > 0.0;
            let of_surface = cycled.surface_mu.get(c).copied().unwrap_or(1.0);
            slips.then(|| cycled.dissipated[c] / (cycled.pressure_times_slip[c] * of_surface))
        });
        if let Some(surface) = &self.surface {
            // The march has solved the factors of place and history; the exposed surface belongs
            // to the jump.
            let depth = &worn.depth[surface.body];
            let of_cells = surface.of_cells(depth, &fields.aerated, &fields.bed);
            mu.iter_mut().zip(of_cells).for_each(|(mu, of)| *mu *= of);
        }
        let mut slip_distance = extrapolate_outward(rows, cells, |c| {
            is_pressed(c).then(|| cycled.slip_distance[c])
        });
        for cut in &cycled.cuts {
            let c = cut.cell;
            mu[c] = self.mu(worn.cycles).unwrap_or(mu[c]);
            if let Some(own) = cut.slip {
                (sigma[c], slip_distance[c]) = (own, own);
            }
        }
        let p: Vec<f64> = cycled.p.iter().map(|p| p.max(1e-6 * largest)).collect();
        let pressure_times_slip: Vec<f64> = sigma.iter().zip(&p).map(|(s, p)| s * p).collect();
        let (mut k, mut above) = ([vec![], vec![]], [vec![], vec![]]);
        let order = if self.surface.as_ref().is_some_and(|s| s.body == 1) {
            [1, 0]
        } else {
            [0, 1]
        };
        for b in order {
            let dissipated: Vec<f64> = (0..cells).map(|c| mu[c] * pressure_times_slip[c]).collect();
            let surface = self.surface.as_ref();
            let surface = surface.filter(|s| s.body == b && s.has_layers());
            let friction = surface.map(|surface| {
                let mu = move |c: usize, layer: usize| {
                    let of_layer = surface.mu_of_layer(layer);
                    surface.combine(of_layer, c, &fields.aerated, &fields.bed)
                };
                move |c: usize, layer: usize| mu(c, layer) / mu(c, surface.layer(worn.depth[b][c]))
            });
            let cycle = CellCycle {
                pressure_times_slip: &pressure_times_slip,
                slip_distance: &slip_distance,
                dissipated: &dissipated,
                worn: &worn.depth[b],
                energy: &worn.energy[b],
                cycles: worn.cycles,
                frequency: self.wear.frequency.unwrap_or(f64::NAN),
                aerated: &fields.aerated,
                debris: &fields.bed,
                protection: &fields.protection,
            };
            let friction = friction.as_ref().map(|f| f as &LayerFactor<'_>);
            let layers = (&self.coatings[b][..], friction);
            let body_coefficients = coefficients(&self.wear.bodies[b], &cycle, layers, n)?;
            if !body_coefficients.mu.is_empty() {
                mu = body_coefficients.mu;
            }
            // Cells outside the contact wear at the pressure of the jump's end alone.
            let means = body_coefficients
                .mean
                .iter()
                .zip(&body_coefficients.end)
                .zip(&cycled.p);
            above[b] = means.map(|((mean, end), p)| (mean - end) * p).collect();
            k[b] = body_coefficients.end;
        }
        let [W, approach] = cycled.mean;
        let drive = if self.gives_approach {
            Drive {
                given: [approach, 0.0, 0.0],
                ..Drive::default()
            }
        } else {
            self.pressing.drive(W)
        };
        Ok(Rates {
            k,
            excess: above,
            sigma,
            mu,
            slips: slip_distance,
            u_q: cycled.u_q.clone(),
            cuts: cycled.cuts.clone(),
            drive,
        })
    }
}

/// The coefficient of friction, if uniform apart from a dependence on cycles.
fn uniform_mu(friction: &Friction) -> Option<f64> {
    friction
        .depends_only_on(&[Dependence::Cycles])
        .then_some(friction.mu)
}

/// Gap between worn surfaces: h plus the part `opens` of the worn depths, less the bed \[m\].
fn gap(h: &[f64], worn: &Worn, opens: f64) -> Vec<f64> {
    let [depth1, depth2] = &worn.depth;
    let cells = h.iter().zip(depth1.iter().zip(depth2));
    cells
        .zip(&worn.bed)
        .map(|((h, (depth1, depth2)), bed)| h + opens * depth1 + opens * depth2 - bed)
        .collect()
}

/// Checks that two pressures agree within [`AGREES`].
fn agree(last: &[f64], now: &[f64]) -> bool {
    let (mut moved, mut size) = (0.0, 0.0);
    for (last, now) in last.iter().zip(now) {
        moved += (now - last).powi(2);
        size += now * now;
    }
    moved <= AGREES * AGREES * size
}

/// Root mean square of the worn depths of both bodies, times a common factor.
fn depth_norm(depth: &[Vec<f64>; 2]) -> f64 {
    depth.iter().flatten().map(|w| w * w).sum::<f64>().sqrt()
}

/// Computes the next increment of a path that has one.
fn advance(march: &mut March) -> Result<Increment, Error> {
    march.advance().unwrap_or(Err(Error::Interrupted {
        increment: march.state().increments,
    }))
}
