//! Stage 5: THE LOAD PATH, one increment at a time (the outer loop of figure 2 of the paper).
//!
//! [`March::advance`] takes the next point of the load path, fits the window, and computes the
//! increment: drives -> no slip -> guess -> solve -> check -> account.

mod accounts;
mod carried;
mod check;
mod coupling;
mod direction;
mod domain;
mod entry;
mod expected_radius;
mod exposed_surface;
mod fields;
mod first_pressure;
mod friction;
mod growing;
mod guess;
mod increment;
mod lifted;
mod off_grid;
mod offsets;
mod path_grid;
mod problem;
mod reached;
mod remembered;
mod results;
mod retry;
mod rolled;
mod run;
mod setup;
mod shear_errors;
mod state;
#[cfg(test)]
mod tests;
mod threads;
mod transmitted;
mod worn;
mod yielding;
mod yields;

pub use exposed_surface::ExposedSurface;
pub use fields::{Fields, Tractions};
pub(crate) use growing::is_remembered;
pub(crate) use problem::TANGENTIAL_SHARE;
pub use reached::Reached;
pub use results::{Energy, Increment, Motion, Residuals, Spots, Status, Work, Yield};
pub use run::{BranchSummary, Observer, solve, summarise};
pub use shear_errors::shear_errors;
pub use state::State;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use self::domain::Domain;
use self::problem::{Largest, Problem};
use self::retry::{CONVOLUTIONS, reach};
use self::setup::{Failure, Workspace};
use self::state::Along;
use self::threads::with_busy_threads;
use self::yields::Yields;
use crate::convolution::{Convolutions, PARALLEL_FROM};
use crate::error::Error;
use crate::plan::Plan;
use crate::scene::{LoadPath, LoadPoint, Scene};

/// A load path being run through.
pub struct March {
    problem: Problem,
    points: Vec<LoadPoint>,
    domain: Domain,
    state: State,
    workspace: Workspace,
    /// March of the path on a coarser grid, if there is one.
    coarse: Option<Box<March>>,
    /// Bodies that yield, if there are any.
    yielding: Option<Box<Yields>>,
}

impl March {
    /// Checks the scene, plans, and computes the kernels. Fails where a branch has no number of
    /// increments: [`choose_increments`](crate::estimate::choose_increments) chooses it.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        Self::until(scene, &Arc::default())
    }

    /// Starts as [`Self::new`] and [`Self::stop_on`] do: the flag also ends the computation of the kernels,
    /// [`Error::Interrupted`] after increment 0.
    pub fn until(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        scene.check()?;
        Self::planned(scene, Plan::new(scene), stop)
    }

    /// Starts as [`Self::until`] does, with a scene that has been checked, with a plan that may differ from
    /// [`Plan::new`] in its methods.
    pub fn planned(scene: &Scene, plan: Plan, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        scene.path.check_increments_chosen()?;
        plan.check_memory(scene)?;
        let coarse = Self::on_path_grid(scene, &plan, stop)?;
        let domain = Domain::new(scene, &plan, stop)?;
        let yielding = Yields::from_scene(scene, &plan)?.map(Box::new);
        let mut solved = scene.clone();
        solved.settings.solver.tolerance = Some(scene.tolerance());
        Ok(Self {
            points: plan.points(scene),
            state: State {
                yielded: yielding.as_ref().map(|yields| Box::new(yields.unyielded())),
                ..unloaded(scene, &domain, coarse.as_deref())
            },
            coarse,
            yielding,
            workspace: Workspace::new(domain.cells(), scene.friction.mu),
            problem: Problem {
                largest: Largest::from_path(&scene.path),
                approach: scene.reference_approach(),
                hardness: scene.hardness(),
                cycles: 0.0,
                surface: ExposedSurface::default(),
                share: 1.0,
                remembers: false,
                scene: solved,
                plan,
                stop: stop.clone(),
            },
            domain,
        })
    }

    /// Goes on from a state of the same scene; what follows is what would have followed without
    /// the interruption, bit by bit.
    pub fn resume(scene: &Scene, state: State) -> Result<Self, Error> {
        Self::resume_until(scene, state, &Arc::default())
    }

    /// Resumes as [`Self::resume`] and [`Self::stop_on`] do; before the first increment the flag ends it as it
    /// ends [`Self::until`].
    pub fn resume_until(
        scene: &Scene,
        state: State,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let mut march = Self::until(scene, stop)?;
        let mirror = march.problem.plan.mirror;
        // A run whose path grid did not converge continued without one.
        march.coarse = march.coarse.filter(|_| state.along.is_some());
        let path_fits = match (&march.coarse, &state.along) {
            (Some(coarse), Some(along)) => along.fits(&coarse.problem.scene.grid, mirror),
            (_, along) => along.is_none(),
        };
        let fits = state.fits(&scene.grid, mirror) && path_fits;
        if !fits || state.increments > march.points.len() {
            return Err(Error::invalid(
                "state",
                format!("after increment {}", state.increments),
                "one of this scene: on its grid and within its load path",
            ));
        }
        if march.yielding.is_some() && state.yielded.is_none() {
            let allowed = "a state with the plastic strain of its bodies";
            return Err(Error::invalid("state", "without plastic strain", allowed));
        }
        march.state = state;
        march.fit_volume()?;
        Ok(march)
    }

    /// Ends the run when `flag` is raised, within the increment: [`Error::Interrupted`], and the
    /// state belongs to the last increment that was finished.
    pub fn stop_on(&mut self, flag: Arc<AtomicBool>) {
        if let Some(coarse) = &mut self.coarse {
            coarse.stop_on(flag.clone());
        }
        self.problem.stop = flag;
    }

    /// Replaces the path by another of the same kinds of loads. The march stands at `state` on it; without one
    /// at its start.
    pub(crate) fn go_along(&mut self, path: &LoadPath, state: Option<State>) {
        self.problem.scene.path = path.clone();
        self.problem.largest = Largest::from_path(path);
        self.points = self.problem.plan.points(&self.problem.scene);
        if let Some(coarse) = &mut self.coarse {
            coarse.go_along(path, None);
        }
        let yielding = self.yielding.as_ref();
        let unloaded = || State {
            yielded: yielding.map(|yields| Box::new(yields.unyielded())),
            ..unloaded(&self.problem.scene, &self.domain, self.coarse.as_deref())
        };
        self.state = state.unwrap_or_else(unloaded);
    }

    /// Sets the number of substeps in which a contact grows to the largest of the path
    /// ([`Methods`](crate::plan::Methods)).
    pub(crate) fn grow_in(&mut self, steps: usize) {
        self.problem.plan.methods.growth_steps = steps;
        if let Some(coarse) = &mut self.coarse {
            coarse.grow_in(steps);
        }
    }

    /// Solves the end of an indentation again, from what its stick zone remembers on this grid, if it
    /// is one of which a path grid takes that; returns whether it is.
    pub(crate) fn remember_on_its_grid(&mut self) -> bool {
        self.problem.remembers = is_remembered(&self.problem.scene, &self.problem.plan);
        self.problem.remembers
    }

    /// The scene, with the tolerance that it is solved with.
    pub fn scene(&self) -> &Scene {
        &self.problem.scene
    }

    /// The rules of the plan: computations that are skipped, and why.
    pub fn plan(&self) -> &Plan {
        &self.problem.plan
    }

    /// The loads at the end of every increment that is solved.
    pub fn points(&self) -> &[LoadPoint] {
        &self.points
    }

    /// The state after the last increment: all that the next one depends on.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Computes the next increment, in pieces if it does not converge; `None` at the end of the
    /// path.
    ///
    /// After an error the state belongs to the last increment that was solved.
    pub fn advance(&mut self) -> Option<Result<Increment, Error>> {
        let point = self.next_point()?;
        Some(if self.yielding.is_some() {
            self.advance_yielding(&point)
        } else if self.coarse.is_some() {
            self.on_both_grids(&point)
        } else if self.problem.remembers && point.ends_branch && self.remembers(&point) {
            self.advance_to(&point).and_then(|row| {
                let (scene, after) = (self.problem.scene.clone(), self.state.clone());
                match self.remember(&point, (&scene, &after, &row), 1) {
                    Err(Error::NotConverged { .. }) => Ok(row),
                    ended => ended,
                }
            })
        } else {
            self.advance_to(&point)
        })
    }

    /// The loads at the end of the next increment; none at the end of the path.
    fn next_point(&self) -> Option<LoadPoint> {
        let point = self.points.get(self.state.increments)?;
        let end = &self.problem.scene.path.branches[point.branch].to;
        let (forces, motions) = (self.state.loads.forces(), self.state.motion.motions());
        Some(point.resolved(end, forces, motions))
    }

    /// Computes the increment to a point.
    fn advance_to(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let before = self.domain.work();
        self.domain
            .allow(Convolutions::from_convolutions(CONVOLUTIONS));
        // The state in the window that it was found in, once that has changed.
        let mut result = None;
        let mut ended = self.in_a_window(point, &mut result);
        match &mut ended {
            // Failed attempts count as work, too.
            Ok(increment) => {
                increment.work.convolutions = (self.domain.work() - before).count();
            }
            Err(error) => {
                if let Some(found) = result {
                    self.state = found;
                }
                if let Error::NotConverged { why, .. } = error {
                    *why = retry::why(&self.problem, &self.domain);
                }
            }
        }
        ended
    }

    /// Computes an increment in a window that is wide enough for it, which is widened and the increment
    /// repeated until it is. `found` keeps the state in the former window. The window changes here, between
    /// increments, and nowhere else.
    fn in_a_window(
        &mut self,
        point: &LoadPoint,
        found: &mut Option<State>,
    ) -> Result<Increment, Error> {
        let Self {
            problem,
            domain,
            state,
            workspace,
            ..
        } = self;
        let mut moved = domain.fit(problem, state, point)?;
        loop {
            *found = found.take().or(moved);
            workspace.fit(domain.cells(), problem.scene.friction.mu);
            let busy = problem.plan.methods.busy_threads && domain.cells() >= PARALLEL_FROM;
            let mut reach = || reach(problem, domain, state, workspace, point);
            let ended = if busy {
                with_busy_threads(reach)
            } else {
                reach()
            };
            moved = match ended {
                Ok(increment) => return Ok(increment),
                Err(Failure::Error(error)) => return Err(error),
                Err(Failure::Narrow(half)) => domain.widen(problem, state, point, Some(half))?,
                Err(Failure::Beyond) => domain.widen(problem, state, point, None)?,
            };
        }
    }
}

/// The state before the first increment, with the state of the path grid (`coarse`) if there is one.
fn unloaded(scene: &Scene, domain: &Domain, coarse: Option<&March>) -> State {
    let touching = domain.window.geometry.touching(scene, [0.0; 3]);
    State {
        along: coarse.map(|coarse| Box::new(Along::beginning(&coarse.state))),
        ..State::unloaded(domain.shape(), domain.cells(), touching)
    }
}
