//! An increment of bodies that yield: the contact, solved again until their residual displacement no
//! longer changes.

use ndarray::Array2;

use super::accounts::of_tractions;
use super::offsets::{Offsets, replace};
use super::{Increment, March, Yield};
use crate::error::Error;
use crate::scene::LoadPoint;
use crate::solvers::Interface;
use crate::yielding::{MOST_PASSES, Residual, Rim, Yielded, Yielding};

/// Equivalent plastic strain at which a run ends: the equations hold for small strains.
const LARGEST_STRAIN: f64 = 0.15;
/// Halvings of an increment before the run gives up.
const HALVINGS: u32 = 4;

impl March {
    /// The bodies that yield, with the stress of a state; none where no body may.
    pub fn yielding(&mut self) -> Option<&mut Yielding> {
        self.yielding.as_mut().map(|yields| &mut yields.bodies)
    }

    /// Displacements that the surfaces have without tractions after the last increment; none where no
    /// body may yield.
    pub fn residual(&self) -> Option<Residual> {
        let yields = self.yielding.as_ref()?;
        Some(yields.bodies.residual_of(self.state.yielded.as_ref()?))
    }

    /// Adds the residual displacement of the surfaces to a gap.
    pub(super) fn offset_gap(&self, gap: Array2<f64>) -> Array2<f64> {
        match self.residual() {
            Some(residual) => gap + residual.gap,
            None => gap,
        }
    }

    /// Computes the increment of yielding bodies to a point, in halves if it does not converge.
    pub(super) fn advance_yielding(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        self.in_yielding_halves(point, HALVINGS)
    }

    /// Computes the increment of yielding bodies to a point. If it does not converge, it is computed in two
    /// halves, each halved again up to `halvings` times; after a failure the state is as before.
    fn in_yielding_halves(&mut self, point: &LoadPoint, halvings: u32) -> Result<Increment, Error> {
        let start = self.state.clone();
        let failure = match self.pass_to(point) {
            Err(error @ Error::NotConverged { .. }) if halvings > 0 => error,
            ended => return ended,
        };
        let middle = point.interpolate_to(&start.loads, start.motion.motions(), 0.5);
        let mut halves = || {
            let first = self.in_yielding_halves(&middle, halvings - 1)?;
            self.state.increments -= 1;
            let second = self.in_yielding_halves(point, halvings - 1)?;
            Ok(first.followed_by(&second))
        };
        let ended = halves();
        if let Err(error) = ended {
            self.state = start;
            return Err(match error {
                Error::Interrupted { .. } => error,
                _ => failure,
            });
        }
        ended
    }

    /// Computes the increment to a point in one piece; after a failure the state is as before.
    fn pass_to(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let start = self.state.clone();
        let ended = self.settle(point);
        if ended.is_err() {
            self.state = start;
        }
        ended
    }

    /// Solves the increment as for elastic bodies. None, with the state as before, if the bodies have yielded
    /// before or would yield in it.
    fn elastically(&mut self, point: &LoadPoint) -> Result<Option<Increment>, Error> {
        let fresh = |yielded: &Yielded| yielded.bodies.iter().all(|body| body.points.is_empty());
        let Some(before) = self.state.yielded.clone().filter(|yielded| fresh(yielded)) else {
            return Ok(None);
        };
        let start = self.state.clone();
        let first = self.tractions();
        let increment = self.advance_to(point)?;
        let [p, q_x, q_y] = self.tractions();
        let Some(yields) = &mut self.yielding else {
            return Ok(Some(increment));
        };
        yields.bodies.begin(&before, first.each_ref());
        let loads = [&start.loads, &point.loads].map(|loads| [loads.sigma_B1, loads.sigma_B]);
        yields.bodies.set_bulk(loads[0], loads[1]);
        if yields.bodies.pass([&p, &q_x, &q_y]) {
            let reached = yields.bodies.reached();
            return Ok(Some(Increment {
                yielded: Yield {
                    reached,
                    ..Yield::default()
                },
                ..increment
            }));
        }
        self.state = start;
        Ok(None)
    }

    /// Solves the increment on the volume grid of the state. If a point yields at the border of that grid, it
    /// is solved again on the larger one.
    fn settle(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let start = self.state.clone();
        let increment = self.settle_on_grid(point)?;
        let Some(now) = self.state.yielded.as_deref() else {
            return Ok(increment);
        };
        if !now.at_border || now.grown {
            return Ok(increment);
        }
        self.state = start;
        if let Some(yielded) = &mut self.state.yielded {
            yielded.grown = true;
        }
        let mut repeated = self.settle_on_grid(point)?;
        repeated.work.convolutions += increment.work.convolutions;
        Ok(repeated)
    }

    /// Rebuilds the yielding bodies if the state is on another volume grid than they are.
    pub(super) fn fit_volume(&mut self) -> Result<(), Error> {
        if let (Some(yields), Some(state)) = (&mut self.yielding, &self.state.yielded) {
            yields.fit(&self.problem.scene, state)?;
        }
        Ok(())
    }

    /// Solves contact and plastic flow in turn on one volume grid, until the residual displacements that the
    /// contact was solved with agree with the strain that follows; fails after [`MOST_PASSES`] passes.
    fn settle_on_grid(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        self.fit_volume()?;
        if let Some(increment) = self.elastically(point)? {
            return Ok(increment);
        }
        // Offsets cover the whole grid, at the end of an increment.
        self.domain
            .widen(&self.problem, &mut self.state, point, None)?;
        self.grow_in(1);
        let start = self.state.clone();
        let Some(before) = start.yielded.as_deref() else {
            return self.advance_to(point);
        };
        let first = self.tractions();
        let mirror = self.problem.plan.mirror;
        let arms = self.domain.window.geometry.arms.clone();
        let Some(yields) = &mut self.yielding else {
            return self.advance_to(point);
        };
        yields.bodies.begin(before, first.each_ref());
        let loads = [&start.loads, &point.loads].map(|loads| [loads.sigma_B1, loads.sigma_B]);
        yields.bodies.set_bulk(loads[0], loads[1]);
        let from = Offsets::from_residual(&yields.bodies.residual(), &arms, mirror);
        if let Some(factor) = start.going_on(point) {
            yields.bodies.guess(before, factor);
        }
        let mut convolutions = 0.0;
        for pass in 1..=MOST_PASSES {
            let Some(yields) = &self.yielding else { break };
            let to = Offsets::from_residual(&yields.bodies.residual(), &arms, mirror);
            self.state.clone_from(&start);
            let geometry = &mut self.domain.window.geometry;
            replace(&mut self.state, geometry, &yields.bare, [&from, &to]);
            let mut increment = self.advance_to(point)?;
            convolutions += increment.work.convolutions;
            let [p, q_x, q_y] = self.tractions();
            let Some(yields) = &mut self.yielding else {
                break;
            };
            if yields.bodies.pass([&p, &q_x, &q_y]) {
                let now = yields.bodies.commit(before);
                if now.largest > LARGEST_STRAIN {
                    let message = format!("a strain of {:.1} %", 100.0 * now.largest);
                    let allowed = format!(
                        "such that strains stay below {:.0} %: a smaller load, or more hardening",
                        100.0 * LARGEST_STRAIN
                    );
                    return Err(Error::invalid("plastic", message, allowed));
                }
                let stored = |interface: &Interface, yielded: &Yielded| {
                    of_tractions(&self.problem, interface) + yielded.locked
                };
                let elastic =
                    stored(&self.state.interface, &now) - stored(&start.interface, before);
                let energy = &mut increment.energy;
                // The tractions did work on the residual displacements: by reciprocity this is the
                // plastic work and the change of the energy of the residual stress.
                // So does the bulk stress on the plastic strain.
                let by_bulk = yields.bodies.work_of_bulk();
                let trapezoidal = energy.elastic - elastic + by_bulk;
                energy.work += by_bulk;
                energy.elastic = elastic;
                energy.plastic = now.work - before.work;
                energy.quadrature += energy.plastic - trapezoidal;
                increment.yielded = Yield {
                    volume: now.volume,
                    largest: now.largest,
                    at_border: now.at_border,
                    at_rim: now.at_rim == Some(Rim::Coating)
                        || now.at_rim == Some(Rim::Surface) && self.problem.scene.friction.mu > 0.0,
                    passes: pass,
                    reached: yields.bodies.reached(),
                };
                self.state.yielded = Some(Box::new(now));
                increment.work.convolutions = convolutions;
                return Ok(increment);
            }
        }
        let (residual, tolerance) = self
            .yielding
            .as_ref()
            .map_or((0.0, 0.0), |yields| yields.bodies.residuals());
        Err(Error::NotConverged {
            increment: start.increments + 1,
            solver: "plastic",
            residual,
            tolerance,
            iterations: MOST_PASSES,
            why: self.problem.scene.describe_shear_flow(self.mean_shear()),
        })
    }

    /// Shear force over the area of contact \[Pa\].
    fn mean_shear(&self) -> f64 {
        let [p, q_x, q_y] = self.tractions();
        let cells = p.iter().filter(|p| **p > 0.0).count().max(1);
        q_x.sum().hypot(q_y.sum()) / cells as f64
    }
}
