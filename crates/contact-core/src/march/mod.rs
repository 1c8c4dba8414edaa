//! Stage 5: THE LOAD PATH, one increment at a time (the outer loop of figure 2 of the paper).

mod awake;
mod balance;
mod border;
mod carried;
mod coarse;
mod continued;
mod edge;
mod entering;
mod entry_order;
mod equations;
mod error_bars;
mod fields;
mod finer;
mod halving;
mod increment;
mod kept_contact;
mod lattice;
mod least_squares;
mod level;
mod neighbours;
mod parabola;
mod partial_cells;
mod path_error;
mod predict;
mod residuals;
mod room;
mod screened;
mod slip_datum;
mod solve;
mod state;
#[cfg(test)]
mod tests;
mod trial;
mod view;
mod window;
mod worn;

pub(crate) use continued::Continued;
pub use error_bars::{Bar, BranchEnds, ErrorBars, Tractions, coarsest, error_bars, means};
pub use fields::Fields;
pub use finer::finest;
pub use increment::{Energy, Increment, Motion, Residuals, Status, Work};
pub use partial_cells::continued_pressure;
pub use path_error::{choose_increments, estimate_path_error};
pub use solve::{BranchSummary, Observer, solve, summarise};
pub use state::State;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use self::awake::with_all_awake;
use self::carried::Carried;
use self::coarse::coarse_start;
use self::predict::first_touch;
use self::slip_datum::Datum;
use self::window::{Whole, Window};
use crate::convolution::PARALLEL_FROM;
use crate::error::Error;
use crate::scene::{History, LoadPoint, Plan, Preset, Scene};
use crate::solvers::{CoupledInfo, CoupledWorkspace, Interface};

/// A load path being run through.
pub struct March {
    scene: Scene,
    plan: Plan,
    points: Vec<LoadPoint>,
    /// What the window is cut from.
    whole: Whole,
    /// The part of the grid that is solved on.
    window: Window,
    /// Friction coefficient of the kept cells in this increment.
    mu: Vec<f64>,
    /// Approach that lengths are measured against \[m\].
    approach: f64,
    state: State,
    /// The state as the increment found it, once it is in a wider window.
    unwidened: Option<State>,
    /// The last interface, where the increment does not find it as it was left.
    carried: Option<Carried>,
    /// Whether the first guess of an increment goes on as the last one went.
    extrapolates: bool,
    /// The displacements that mean no slip in the increment.
    datum: Datum,
    workspace: CoupledWorkspace,
    /// Raised from outside to end the run.
    stop: Arc<AtomicBool>,
}

impl March {
    /// Checks the scene, chooses the increments that are not given, plans, and computes the kernels.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        Self::until(scene, &Arc::default())
    }

    /// As [`Self::new`] and [`Self::stop_on`]: the flag also ends the choice of the increments and
    /// the kernels, [`Error::Interrupted`] after increment 0.
    pub fn until(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        scene.check()?;
        if scene.path.is_open() {
            return Self::until(&choose_increments(scene, stop)?, stop);
        }
        let plan = Plan::new(scene);
        plan.check_memory(scene)?;
        let whole = Whole::new(scene, &plan, stop)?;
        let window = whole.window(scene, &plan, Window::first(scene, &plan), stop)?;
        let cells = window.h_init.len();
        let approach = scene.approach();
        let mut solved = scene.clone();
        solved.settings.solver.tolerance = Some(scene.tolerance());
        Ok(Self {
            points: plan.points(scene),
            scene: solved,
            plan,
            mu: vec![scene.friction.mu; cells],
            approach,
            state: State::unloaded(window.shape(), cells),
            unwidened: None,
            carried: None,
            extrapolates: scene.settings.solver.preset == Preset::Fast,
            datum: Datum::new(cells),
            workspace: CoupledWorkspace::new(cells),
            whole,
            window,
            stop: stop.clone(),
        })
    }

    /// Goes on from a state of the same scene; what follows is what would have followed without
    /// the interruption, bit by bit.
    pub fn resume(scene: &Scene, state: State) -> Result<Self, Error> {
        Self::resume_until(scene, state, &Arc::default())
    }

    /// As [`Self::resume`] and [`Self::stop_on`]; before the first increment the flag ends it as it
    /// ends [`Self::until`].
    pub fn resume_until(
        scene: &Scene,
        state: State,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let mut march = Self::until(scene, stop)?;
        let fits = state.fits(&scene.grid, march.plan.mirror);
        if !fits || state.increments > march.points.len() {
            return Err(Error::invalid(
                "state",
                format!("after increment {}", state.increments),
                "one of this scene: on its grid and within its load path",
            ));
        }
        if state.window != march.window.shape() {
            march.move_into(state.window)?;
        }
        (march.state, march.unwidened) = (state, None);
        Ok(march)
    }

    /// Ends the run when `flag` is raised, within the increment: [`Error::Interrupted`], and the
    /// state is that of the last increment that was finished.
    pub fn stop_on(&mut self, flag: Arc<AtomicBool>) {
        self.stop = flag;
    }

    /// Fails once the flag is raised.
    fn unless_stopped(&self) -> Result<(), Error> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted {
                increment: self.state.increments,
            });
        }
        Ok(())
    }

    /// The scene, with the increments and the tolerance that it is solved with.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What is skipped and why.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The loads at the end of every increment that is solved.
    pub fn points(&self) -> &[LoadPoint] {
        &self.points
    }

    /// The state after the last increment: all that the next one depends on. After one that failed
    /// on the way it is in the window that this one began with.
    pub fn state(&self) -> &State {
        self.unwidened.as_ref().unwrap_or(&self.state)
    }

    /// Computes the next increment, in pieces if it does not converge; `None` at the end of the
    /// path.
    ///
    /// After an error the state is that of the last increment that was solved.
    pub fn advance(&mut self) -> Option<Result<Increment, Error>> {
        let point = self.points.get(self.state.increments)?;
        let end = &self.scene.path.branches[point.branch].to;
        let state = &self.state;
        let point = point.resolved(end, state.loads.forces(), state.motion.motions());
        self.unwidened = None;
        let reached = if self.window.h_init.len() < PARALLEL_FROM {
            self.reach(&point)
        } else {
            with_all_awake(|| self.reach(&point))
        };
        if reached.is_ok() {
            self.unwidened = None;
        }
        Some(reached)
    }

    /// One increment: predict, solve, account, keep; again in a wider window where it needs one.
    fn increment(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let index = self.state.increments + 1;
        let transforms = self.transforms();
        let mut coarse_convolutions = 0.0;
        self.give_up_room(point)?;
        let (now, info, clear) = loop {
            self.unless_stopped()?;
            let start = self.start(point, &mut coarse_convolutions)?;
            let (now, info) = self.solve_from(point, start)?;
            if info.exceeds_friction() {
                return Err(Error::BeyondFriction {
                    increment: index,
                    used: info.friction_used,
                });
            }
            self.unless_stopped()?;
            let narrow = self.make_room(&now.p, self.window.shape(), point, false)?;
            if narrow {
                continue;
            }
            if let Some(clear) = self.clear_beyond(&now, &info)? {
                break (now, info, clear);
            }
        };
        self.check_border(&now, index)?;
        let convolutions = (self.transforms() - transforms) as f64 / 6.0 + coarse_convolutions;
        let increment = self.account(point, now, &info, convolutions)?;
        self.state.clear = clear;
        Ok(increment)
    }

    /// The first guess of the increment, in a window with room for it.
    fn start(
        &mut self,
        point: &LoadPoint,
        coarse_convolutions: &mut f64,
    ) -> Result<Option<Interface>, Error> {
        let (normal, _) = self.drives(point);
        let pressed = !normal.free[0] || normal.sums[0] > 0.0;
        let touch = (pressed && self.state.loads.W <= 0.0).then(|| {
            let Some(start) = coarse_start(&self.scene, point, &self.stop) else {
                return first_touch(&self.scene.h_init(), self.approach_at(point));
            };
            *coarse_convolutions += start.convolutions;
            start.p
        });
        if let Some(p) = &touch {
            self.make_room(&self.plan.mirror.fold(p), p.dim(), point, false)?;
        }
        loop {
            self.carry(point);
            self.update_friction();
            self.datum.goes_on = self.state.going_on(point).is_some();
            if !pressed {
                return Ok(None);
            }
            let closing = match touch {
                Some(_) => None,
                None => self.closing_pressure(&normal),
            };
            let start = self.state.predict(
                point,
                touch.as_ref().map(|p| self.in_window(p)),
                closing.as_deref(),
                &self.mu,
                &normal,
                self.extrapolates,
            );
            if !self.make_room(&start.p, self.window.shape(), point, true)? {
                return Ok(Some(start));
            }
        }
    }

    /// Solves the increment from a first guess; bodies that are not pressed do not touch.
    fn solve_from(
        &mut self,
        point: &LoadPoint,
        start: Option<Interface>,
    ) -> Result<(Interface, CoupledInfo), Error> {
        if let Some(start) = start {
            return self.solve_entering(point, start);
        }
        let (normal, tangential) = self.drives(point);
        let apart = Interface::unloaded(self.window.h_init.len());
        let info = CoupledInfo {
            approach: normal.given,
            shift: tangential.given,
            ..CoupledInfo::default()
        };
        self.datum.reset(&apart, &apart.q, None);
        Ok((apart, info))
    }

    /// The friction coefficient of each cell after what it has been through.
    fn update_friction(&mut self) {
        let friction = &self.scene.friction;
        let changes = friction.kinetic.is_some() || friction.history.is_some();
        if !changes && self.window.friction_map.is_empty() {
            return;
        }
        for n in 0..self.mu.len() {
            let (friction, state) = (&self.scene.friction, &self.state);
            let slipped = self.before().slip[n];
            let mu = friction.kinetic.filter(|_| slipped).unwrap_or(friction.mu);
            let map = self.window.friction_map.get(n).copied().unwrap_or(1.0);
            let history = friction.history.as_ref().map_or(1.0, |history| {
                history.factor(match history.of {
                    History::Increment => state.increments as f64,
                    History::Slip => self.origin(n).map_or(0.0, |n| state.slip_length[n]),
                    History::Dissipated => self.origin(n).map_or(0.0, |n| state.dissipated[n]),
                })
            });
            self.mu[n] = if map * history > 0.0 {
                mu * map * history
            } else {
                0.0
            };
        }
    }

    /// Hertz's approach at the loads of a point \[m\], for the first guess.
    fn approach_at(&self, point: &LoadPoint) -> f64 {
        point.loads.given.delta_z.unwrap_or_else(|| {
            self.approach * (point.loads.W / self.scene.path.W_max()).powf(2.0 / 3.0)
        })
    }
}
