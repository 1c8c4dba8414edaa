//! Data of an increment, its buffers, and the solver of its equations.

use super::State;
use super::domain::{FirstPressure, Geometry};
use super::problem::{Drives, Problem};
use super::rolled::{Roll, Rolled};
use crate::error::Error;
use crate::kernels::Quadrant;
use crate::scene::LoadPoint;
use crate::solvers::intermediate::{
    AlternationInfo, AlternationWorkspace, IncrementProblem, solve_increment,
};
use crate::solvers::no_slip::{EarlierTractions, NoSlip, NoSlipTerms, Start};
use crate::solvers::{Interface, Response};

/// Why an increment failed.
pub(super) enum Failure {
    /// The contact has these half-lengths, in cells, and the window no margin around it.
    Narrow([usize; 2]),
    /// Cells beyond the window overlap.
    Beyond,
    Error(Error),
}

impl From<Error> for Failure {
    /// An error that ends the run, as a failure of the increment.
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

/// Fields that an increment works on, kept from one to the next.
pub(super) struct Workspace {
    /// Friction coefficient of the kept cells at the end of the increment.
    pub(super) mu: Vec<f64>,
    /// Value at its start.
    pub(super) mu_before: Vec<f64>,
    pub(super) no_slip: NoSlipTerms,
    pub(super) alternation: AlternationWorkspace,
}

impl Workspace {
    /// Allocates buffers for fields of `cells` cells and sets friction to `mu`.
    pub(super) fn new(cells: usize, mu: f64) -> Self {
        Self {
            mu: vec![mu; cells],
            mu_before: vec![mu; cells],
            no_slip: NoSlipTerms::new(cells),
            alternation: AlternationWorkspace::new(cells),
        }
    }

    /// Resizes to another number of cells.
    pub(super) fn fit(&mut self, cells: usize, mu: f64) {
        if self.mu.len() != cells {
            *self = Self::new(cells, mu);
        }
    }
}

/// Data of an increment.
#[derive(Clone, Copy)]
pub(super) struct Setup<'a> {
    pub(super) problem: &'a Problem,
    pub(super) geometry: &'a Geometry,
    /// C_zz on the whole grid \[m/Pa\].
    pub(super) kernel: &'a Quadrant,
    /// The pressure from which bodies start that have not touched.
    pub(super) first_pressure: &'a FirstPressure,
    /// The state after the last increment.
    pub(super) state: &'a State,
    pub(super) roll: Roll,
    pub(super) rolled: Option<&'a Rolled>,
    /// Friction coefficient of the kept cells at the end of the increment.
    pub(super) mu: &'a [f64],
    /// Value at its start.
    pub(super) mu_before: &'a [f64],
    pub(super) point: &'a LoadPoint,
    pub(super) drives: Drives,
    /// Change of the loads over the change of the last increment, if the path continues in its direction.
    pub(super) goes_on: Option<f64>,
}

impl Setup<'_> {
    /// The interface after the last increment, carried along with the material.
    pub(super) fn last(&self) -> &Interface {
        self.rolled
            .map_or(&self.state.interface, |rolled| &rolled.interface)
    }

    /// The residual slip of the last increment \[m\].
    fn residual(&self) -> &[Vec<f64>; 2] {
        self.rolled
            .map_or(&self.state.residual, |rolled| &rolled.residual)
    }

    /// Pressure and shear an increment earlier. `ratio` is the change of the loads in this increment over the
    /// change in the last one.
    fn earlier(&self, ratio: f64) -> EarlierTractions<'_> {
        let (p, q) = match self.rolled {
            Some(rolled) => (&rolled.p_before, &rolled.q_before),
            None => (&self.state.p_before, &self.state.q_before),
        };
        EarlierTractions::new(p, q, ratio)
    }

    /// The start of the slip: the interface after the last increment, with the tractions of the one before
    /// if the turn of the shear counts (`turns`).
    fn start(&self, turns: bool) -> Start<'_> {
        let turns = turns && self.problem.plan.methods.slip_rotation;
        Start {
            interface: self.last(),
            residual: self.residual(),
            arms: &self.geometry.arms,
            earlier: self
                .goes_on
                .filter(|_| turns)
                .map(|ratio| self.earlier(ratio)),
            elastic_slip: self.problem.scene.friction.reference_mu() * self.problem.approach,
        }
    }

    /// Whether neither loads nor given motions change in the increment.
    pub(super) fn stays(&self) -> bool {
        let (state, loads) = (self.state, &self.point.loads);
        let step = loads.since(&state.loads, state.motion.motions());
        step.projection_factor(&step).is_none()
    }

    /// Fails once the flag is raised.
    pub(super) fn unless_stopped(&self) -> Result<(), Error> {
        self.problem.unless_stopped(self.state.increments)
    }
}

/// A solution of an increment.
pub(super) type Solution = (Interface, AlternationInfo);

/// The solver of the equations of an increment.
pub(super) struct Solver<'a> {
    pub(super) response: Response<'a>,
    pub(super) no_slip: &'a mut NoSlipTerms,
    pub(super) workspace: &'a mut AlternationWorkspace,
}

/// One set of equations of an increment.
pub(super) struct Equations<'a> {
    /// Gap between the undeformed surfaces \[m\].
    pub(super) h_init: &'a [f64],
    /// Share of the tolerance.
    pub(super) share: f64,
    /// Whether the turn term t of u_0 is computed.
    pub(super) turns: bool,
    /// Motion of cells before they enter the contact \[m\].
    pub(super) entry: Option<&'a [Vec<f64>; 2]>,
}

impl Solver<'_> {
    /// Solves the equations `wanted` of an increment (all cells, or the old contact) from a guess `now` of the
    /// tractions.
    pub(super) fn solve(
        &mut self,
        setup: &Setup<'_>,
        wanted: &Equations<'_>,
        mut now: Interface,
    ) -> Result<Solution, Error> {
        setup.unless_stopped()?;
        let equations = IncrementProblem {
            h_init: wanted.h_init,
            friction: setup.problem.plan.friction,
            mu: setup.mu,
            arms: &setup.geometry.arms,
            enters: wanted.entry.is_some() || !wanted.turns,
            normal: setup.drives.normal,
            hardness: setup.problem.hardness,
            tangential: setup.drives.tangential,
        };
        let params = setup.problem.params(wanted.share);
        let mut no_slip = NoSlip::new(setup.start(wanted.turns), self.no_slip, wanted.entry);
        let (response, ws) = (&mut self.response, &mut *self.workspace);
        match solve_increment(response, &equations, &mut no_slip, &mut now, ws, &params) {
            Ok(info) => Ok((now, info)),
            Err(failed) => {
                setup.unless_stopped()?;
                Err(Error::NotConverged {
                    increment: setup.state.increments + 1,
                    solver: failed.solver,
                    residual: failed.residual,
                    tolerance: failed.tolerance,
                    iterations: failed.iterations,
                    why: String::new(),
                })
            }
        }
    }

    /// The solution without contact: no tractions, the undeformed surfaces at the approach `touching` \[m\] at
    /// which they just touch.
    pub(super) fn apart(&mut self, setup: &Setup<'_>, touching: f64) -> Solution {
        let apart = Interface::unloaded(setup.geometry.h_init.len());
        let [_, tilts @ ..] = setup.drives.normal.given;
        let info = AlternationInfo {
            approach: [touching, tilts[0], tilts[1]],
            shift: setup.drives.tangential.given,
            ..AlternationInfo::default()
        };
        let start = Start {
            interface: &apart,
            residual: &apart.q,
            ..setup.start(false)
        };
        NoSlip::new(start, self.no_slip, None);
        (apart, info)
    }
}

/// Number of contact cells, and of slip cells.
pub(super) fn count(now: &Interface) -> (usize, usize) {
    let contact = now.p.iter().filter(|&&p| p > 0.0).count();
    (contact, now.slips.iter().filter(|&&slips| slips).count())
}
