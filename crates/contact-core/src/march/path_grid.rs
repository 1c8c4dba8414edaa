//! The path on a coarser grid, and on the grid of the scene where its fields are wanted.
//!
//! The error of the increments hardly depends on the grid, and most increments are solved for the
//! path alone. These are solved on a grid of a half or a quarter of the cells each way. The grid of
//! the scene is solved
//!
//! - at the ends of branches and where fields are kept,
//! - while the normal force or a tilting moment changes: a cell that comes into contact sticks
//!   where it entered, and the coarse grid knows that only to within its own cells. In a first
//!   indentation of round smooth bodies that is a function of the radius, and the end alone is
//!   solved ([`remembered`](super::remembered)),
//!
//! each time from the state to which the change of the coarse grid has carried it
//! ([`carried`](super::carried)). In between, a number x of an increment is
//!
//! ```text
//! x = x_fine,0 + (x_coarse - x_coarse,0)
//! ```
//!
//! with both at the last increment (0) that was solved on both grids, so that it jumps by no more
//! than the error of the coarse path where the fine grid takes over. The contact area is taken from
//! the fine grid: at constant normal force the shear moves the rim by less than a coarse cell. The
//! area of the stick zone is the same part of it as on the coarse grid. Energies come from the
//! coarse grid wherever the fine one starts from a carried state. If the coarse grid does not
//! converge the run continues without it, in a first indentation from its increments on the fine grid.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::carried::{carried, pressed};
use super::coupling::coupling;
use super::remembered::remembers_enough;
use super::state::Along;
use super::{Increment, March, Motion, State, Work};
use crate::error::Error;
use crate::plan::Plan;
use crate::scene::{LoadPoint, PathGrid, Scene};

/// Tolerance of increments that start from a carried state, over the tolerance of the scene.
const CARRIED_SHARE: f64 = 0.25;
/// Largest mu times the coupling of the bodies. The shear at the ends of branches of a rigid sphere on
/// nu = 0 (128 cells, path on 64) is off by 8e-3, 1.2e-2, 0.10 and 0.69 at 0.3, 0.5, 0.7 and 1: a
/// single increment from a carried state need not lead to the solution that small ones lead to.
const MOST_COUPLING: f64 = 0.25;

impl March {
    /// The march of the scene on its path grid; none where that is the grid itself.
    pub(super) fn on_path_grid(
        scene: &Scene,
        plan: &Plan,
        stop: &Arc<AtomicBool>,
    ) -> Result<Option<Box<Self>>, Error> {
        let Some(grid) = scene.path_grid() else {
            return Ok(None);
        };
        if scene.yields() {
            return Ok(None);
        }
        let product = scene.friction.mu * coupling(scene);
        if product > MOST_COUPLING {
            let allowed = format!(
                "\"auto\" or \"same\": mu times the coupling of the bodies is {product:.2}, at most \
                 {MOST_COUPLING} for a coarser path"
            );
            return Err(Error::invalid("solver.path_grid", grid.nx, allowed));
        }
        let mut coarse = scene.clone();
        coarse.grid = grid;
        coarse.settings.solver.tolerance = Some(scene.tolerance());
        coarse.settings.solver.path_grid = PathGrid::Same;
        Ok(Some(Box::new(Self::planned(&coarse, plan.clone(), stop)?)))
    }

    /// Cells of the fine grid along the side of one of the path grid.
    fn ratio(&self) -> usize {
        let coarse = self.coarse.as_ref();
        coarse.map_or(1, |coarse| {
            self.problem.scene.grid.nx / coarse.problem.scene.grid.nx
        })
    }

    /// Computes the increment to a point on the path grid, and also on the grid of the scene where its fields
    /// are kept or it ends a branch.
    pub(super) fn on_both_grids(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let remembers = self.remembers(point);
        let solves = self.is_wanted(point) || (self.presses_anew(point) && !remembers);
        let was_carried = solves && !remembers && self.catch_up();
        let carried = was_carried.then(|| self.state.dissipated.clone());
        let before = solves.then(|| self.state.along.clone());
        let on_coarse = match self.advance_on_path_grid() {
            Ok(increment) => increment,
            Err(error @ Error::Interrupted { .. }) => return Err(error),
            Err(_) => {
                self.coarse = None;
                if remembers {
                    return self.press_on_grid();
                }
                self.catch_up();
                self.state.along = None;
                return self.advance_to(point);
            }
        };
        if !solves {
            return Ok(self.in_between(&on_coarse));
        }
        self.problem.share = if was_carried || remembers {
            CARRIED_SHARE
        } else {
            1.0
        };
        let solved = if remembers {
            self.remember_path_grid(point, &on_coarse)
        } else {
            self.advance_to(point)
        };
        self.problem.share = 1.0;
        let Some(along) = &mut self.state.along else {
            return solved;
        };
        match solved {
            Ok(increment) => {
                along.then = along.now.clone();
                let increment = match carried {
                    Some(carried) => self.with_energy(&increment, &on_coarse, &carried),
                    None => increment,
                };
                if let Some(along) = &mut self.state.along {
                    along.rows = Some([increment, on_coarse]);
                }
                Ok(increment)
            }
            Err(error) => {
                self.state.along = before.flatten();
                Err(error)
            }
        }
    }

    /// The increment with the energies of the path grid, where it starts from a carried state whose energies per
    /// area are `carried`.
    ///
    /// The increment starts from displacements that were interpolated, so that its slip is not the one of the
    /// grid: its energy is 2 to 5 % low at the end of a branch. The increments of the path grid follow each
    /// other.
    fn with_energy(
        &mut self,
        row: &Increment,
        on_coarse: &Increment,
        carried: &[f64],
    ) -> Increment {
        let state = &mut self.state;
        let factor = on_coarse.energy.dissipated / row.energy.dissipated;
        if factor.is_finite() && state.dissipated.len() == carried.len() {
            for (now, before) in state.dissipated.iter_mut().zip(carried) {
                *now = before + factor * (*now - before);
            }
        }
        state.work += on_coarse.energy.work - row.energy.work;
        let mut increment = *row;
        increment.energy = on_coarse.energy;
        increment.residuals.energy = on_coarse.residuals.energy;
        increment
    }

    /// Computes the end of an indentation on the grid of the scene from what the stick zone of the path grid
    /// remembers; `row` is the increment on the path grid. If the stick zone is too small, or that does not
    /// converge, the whole indentation is solved on the grid itself.
    fn remember_path_grid(
        &mut self,
        point: &LoadPoint,
        row: &Increment,
    ) -> Result<Increment, Error> {
        let ratio = self.ratio();
        let (Some(coarse), Some(along)) = (self.coarse.take(), self.state.along.clone()) else {
            unreachable!("a march without a path grid");
        };
        let begun = self.domain.work();
        let remembered = remembers_enough(row)
            .then(|| self.remember(point, (coarse.scene(), &along.now, row), ratio));
        let solved = if let Some(ended @ (Ok(_) | Err(Error::Interrupted { .. }))) = remembered {
            ended
        } else {
            let pressed = self.press_on_grid();
            self.state.along = Some(along);
            pressed
        };
        self.coarse = Some(coarse);
        solved.map(|mut row| {
            // The failed attempt counts as work, too.
            row.work.convolutions = (self.domain.work() - begun).count();
            row
        })
    }

    /// Solves all increments up to the next one on the grid of the scene, as if there were no path grid. The
    /// state after it has no path grid; after a failure it is as before.
    fn press_on_grid(&mut self) -> Result<Increment, Error> {
        let share = std::mem::replace(&mut self.problem.share, 1.0);
        let anew = super::unloaded(&self.problem.scene, &self.domain, None);
        let before = std::mem::replace(&mut self.state, anew);
        let mut work = Work::default();
        let ended = loop {
            let point = self.next_point().expect("a point of the path");
            let ended = self.advance_to(&point).map(|row| {
                work = work + row.work;
                Increment { work, ..row }
            });
            if ended.is_err() || self.state.increments > before.increments {
                break ended;
            }
        };
        if ended.is_err() {
            self.state = before;
        }
        self.problem.share = share;
        ended
    }

    /// Whether the fields at a point are kept, or it ends a branch.
    fn is_wanted(&self, point: &LoadPoint) -> bool {
        let index = self.state.increments + 1;
        let keeps = &self.problem.scene.settings.save;
        point.ends_branch || keeps.keeps(point, index, index == self.points.len())
    }

    /// Whether the increment must be solved on both grids: the normal force or a tilting moment changes (or its
    /// motion, where that is given), or none has been solved on both so far.
    fn presses_anew(&self, point: &LoadPoint) -> bool {
        let step = point
            .loads
            .since(&self.state.loads, self.state.motion.motions());
        let (forces, motions) = (step.forces(), step.given.motions());
        let is_known = self
            .state
            .along
            .as_ref()
            .is_some_and(|along| along.rows.is_some());
        !is_known || (0..3).any(|k| motions[k].unwrap_or(forces[k]) != 0.0)
    }

    /// The next increment on the path grid.
    fn advance_on_path_grid(&mut self) -> Result<Increment, Error> {
        let (Some(coarse), Some(along)) = (&mut self.coarse, &mut self.state.along) else {
            unreachable!("a march without a path grid");
        };
        std::mem::swap(&mut coarse.state, &mut along.now);
        let ended = coarse.advance();
        std::mem::swap(&mut coarse.state, &mut along.now);
        ended.expect("both grids go along one path")
    }

    /// Brings the state of the fine grid to the present increment of the path grid; returns whether it was
    /// behind.
    fn catch_up(&mut self) -> bool {
        let Some(along) = &self.state.along else {
            return false;
        };
        if !along.is_ahead() {
            return false;
        }
        let mut now = self.carried(along);
        if let Some(along) = &mut now.along {
            along.then = along.now.clone();
        }
        self.state = now;
        true
    }

    /// The state, on the fine grid, with its fields at the present increment.
    pub(super) fn caught_up(&self) -> Cow<'_, State> {
        match &self.state.along {
            Some(along) if along.is_ahead() => Cow::Owned(self.carried(along)),
            _ => Cow::Borrowed(&self.state),
        }
    }

    /// The state carried to the present increment of the path grid; in an indentation that is solved
    /// on it alone, what the path grid has.
    fn carried(&self, along: &Along) -> State {
        let (problem, ratio) = (&self.problem, self.ratio());
        if self.remembers(&self.points[along.now.increments - 1]) {
            let whole = (problem.scene.grid.nx, problem.scene.grid.ny);
            return State {
                along: self.state.along.clone(),
                ..pressed(problem, whole, &along.now, ratio)
            };
        }
        carried(problem, &self.state, along, ratio)
    }

    /// Accounts for an increment that was solved on the coarse grid alone: it has the numbers of the last
    /// increment on both grids, plus the change on the coarse grid.
    fn in_between(&mut self, coarse: &Increment) -> Increment {
        let state = &mut self.state;
        let rows = state.along.as_ref().and_then(|along| along.rows);
        let [fine, then] = rows.unwrap_or([*coarse; 2]);
        let moved = |of: fn(&Increment) -> f64| of(&fine) + (of(coarse) - of(&then));
        let prescribed = coarse.point.loads.given.motions();
        let motion = |k: usize| {
            prescribed[k].unwrap_or_else(|| {
                let [fine, now, then] = [&fine, coarse, &then].map(|i| i.motion.motions()[k]);
                fine + (now - then)
            })
        };
        let force = |k: usize| {
            let [fine, now, then] = [&fine, coarse, &then].map(|i| i.point.loads.forces()[k]);
            prescribed[k].map_or(now, |_| fine + (now - then))
        };
        let mut point = coarse.point;
        let forces = std::array::from_fn(force);
        point.loads = point.loads.with_forces(forces, point.loads.given);
        let increment = Increment {
            point,
            motion: Motion::from_motions(std::array::from_fn(motion)),
            contact_area: fine.contact_area,
            // Without contact on the coarse grid nothing slips.
            stick_area: if coarse.contact_area > 0.0 {
                coarse.stick_ratio() * fine.contact_area
            } else {
                fine.contact_area
            },
            path_grid: coarse.path_grid,
            cells_per_radius: fine.cells_per_radius,
            p_max: moved(|i| i.p_max),
            q_max: moved(|i| i.q_max),
            q_rms: moved(|i| i.q_rms),
            ..*coarse
        };
        state.step = point.loads.since(&state.loads, state.motion.motions());
        state.loads = point.loads;
        state.motion = increment.motion;
        state.work += increment.energy.work;
        state.increments += 1;
        increment
    }
}
