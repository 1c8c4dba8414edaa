//! Stage 5: THE LOAD PATH, one increment at a time (the outer loop of figure 2 of the paper).

mod awake;
mod balance;
mod border;
mod carried;
mod coarse;
mod entering;
mod equations;
mod error_bars;
mod fields;
mod halving;
mod increment;
mod kept_contact;
mod partial_cells;
mod path_error;
mod predict;
mod slip_datum;
mod solve;
mod state;

pub use error_bars::{Bar, BranchEnds, ErrorBars, Tractions, coarsest, error_bars, means};
pub use fields::Fields;
pub use increment::{Energy, Increment, Motion, Residuals, Status, Work};
pub use partial_cells::continued_pressure;
pub use path_error::{choose_increments, estimate_path_error};
pub use solve::{BranchSummary, Observer, solve, summarise};
pub use state::State;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use self::awake::with_all_awake;
use self::carried::Carried;
use self::coarse::coarse_start;
use self::predict::first_touch;
use self::slip_datum::Datum;
use crate::convolution::{
    CirculantInverse, DcFft, FrequencyDomain, PARALLEL_FROM, SurfaceOperator,
};
use crate::error::Error;
use crate::kernels::pair_coefficients;
use crate::scene::{History, KernelMethod, LoadPoint, Plan, Preset, Scene};
use crate::solvers::{Arms, CoupledInfo, CoupledWorkspace, Interface};

/// A load path being run through.
pub struct March {
    scene: Scene,
    plan: Plan,
    points: Vec<LoadPoint>,
    /// Gap between the undeformed surfaces on the kept cells \[m\].
    h_init: Vec<f64>,
    /// Where the kept cells are.
    arms: Arms,
    /// Factor of the friction coefficient over the kept cells; empty where it is 1.
    friction_map: Vec<f64>,
    /// Friction coefficient of the kept cells in this increment.
    mu: Vec<f64>,
    op: Box<dyn SurfaceOperator + Send>,
    inverse: Option<CirculantInverse>,
    /// Approach that lengths are measured against \[m\].
    approach: f64,
    state: State,
    /// The last interface, where the increment does not find it as it was left.
    carried: Option<Carried>,
    /// The displacements that mean no slip in the increment.
    datum: Datum,
    workspace: CoupledWorkspace,
    /// Raised from outside to end the run.
    stop: Arc<AtomicBool>,
}

impl March {
    /// Checks the scene, chooses the increments that are not given, plans, and computes the kernels.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        scene.check()?;
        if scene.path.is_open() {
            return Self::new(&choose_increments(scene)?);
        }
        let plan = Plan::new(scene);
        plan.check_memory(scene)?;
        let settings = &scene.settings;
        let stretch = scene.friction.stretch();
        let pair = pair_coefficients(
            (&scene.body1, &scene.body2),
            &scene.grid,
            &settings.kernel,
            settings.skip.equal_layers,
            plan.kernels(),
        )?
        .stretched(stretch);
        let inverse = match settings.solver.preset {
            Preset::Fast => Some(CirculantInverse::new(&pair, plan.mirror)),
            Preset::Spinu2020 => None,
        };
        let op: Box<dyn SurfaceOperator + Send> = match settings.kernel.method {
            KernelMethod::FrequencyDomain { lambda } => Box::new(FrequencyDomain::new(
                (&scene.body1, &scene.body2),
                &scene.grid,
                lambda,
                plan.coupling,
                &pair,
            )),
            _ => Box::new(DcFft::new(&pair, plan.mirror, plan.coupling)),
        };
        let h_init = plan.mirror.fold(&scene.h_init());
        let cells = h_init.len();
        let extent = scene.grid.extent();
        let length = if scene.grid.plane_strain {
            0.5 * extent.0
        } else {
            0.5 * extent.0.max(extent.1)
        };
        let arm = |along: &dyn Fn(f64, f64) -> f64| {
            plan.mirror
                .fold(&scene.grid.map(|x, y| along(x, y) / length))
        };
        let arms = Arms {
            length,
            x: arm(&|x, _| x),
            y: arm(&|_, y| y),
            stretch,
        };
        let friction_map = scene.friction.map.as_ref().map_or_else(Vec::new, |map| {
            plan.mirror.fold(&scene.grid.map(|x, y| map.at(x, y)))
        });
        let approach = scene.approach();
        Ok(Self {
            points: plan.points(scene),
            scene: scene.clone(),
            plan,
            h_init,
            arms,
            friction_map,
            mu: vec![scene.friction.mu; cells],
            op,
            inverse,
            approach,
            state: State::unloaded(cells),
            carried: None,
            datum: Datum::new(cells),
            workspace: CoupledWorkspace::new(cells),
            stop: Arc::default(),
        })
    }

    /// Goes on from a state of the same scene; what follows is what would have followed without
    /// the interruption, bit by bit.
    pub fn resume(scene: &Scene, state: State) -> Result<Self, Error> {
        let mut march = Self::new(scene)?;
        if !state.fits(march.h_init.len()) || state.increments > march.points.len() {
            return Err(Error::invalid(
                "state",
                format!("after increment {}", state.increments),
                "one of this scene: on its grid and within its load path",
            ));
        }
        march.state = state;
        Ok(march)
    }

    /// Ends the run when `flag` is raised, within the increment: [`Error::Interrupted`], and the
    /// state is that of the last increment that was finished.
    pub fn stop_on(&mut self, flag: Arc<AtomicBool>) {
        self.stop = flag;
    }

    /// The scene.
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

    /// The state after the last increment: all that the next one depends on.
    pub fn state(&self) -> &State {
        &self.state
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
        Some(if self.h_init.len() < PARALLEL_FROM {
            self.reach(&point)
        } else {
            with_all_awake(|| self.reach(&point))
        })
    }

    /// One increment: predict, solve, account, keep.
    fn increment(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let index = self.state.increments + 1;
        let transforms = self.op.transforms();
        let (normal, tangential) = self.drives(point);
        self.carry(point);
        self.update_friction();
        let pressed = !normal.free[0] || normal.sums[0] > 0.0;
        let mut coarse_convolutions = 0.0;
        self.datum.goes_on = self.state.going_on(point).is_some();
        let start = if pressed {
            let touch = (self.state.loads.W <= 0.0).then(|| {
                let Some(start) = coarse_start(&self.scene, point) else {
                    return first_touch(&self.h_init, self.approach_at(point));
                };
                coarse_convolutions = start.convolutions;
                self.plan.mirror.fold(&start.p)
            });
            self.state.predict(
                point,
                touch,
                &self.mu,
                &normal,
                self.scene.settings.solver.preset,
            )
        } else {
            Interface::unloaded(self.h_init.len())
        };
        let (now, info) = if pressed {
            self.solve_entering(point, start)?
        } else {
            let info = CoupledInfo {
                approach: normal.given,
                shift: tangential.given,
                ..CoupledInfo::default()
            };
            self.datum.reset(&start, None);
            (start, info)
        };
        if info.exceeds_friction() {
            return Err(Error::BeyondFriction {
                increment: index,
                used: info.friction_used,
            });
        }
        self.check_border(&now, index)?;
        let transforms = self.op.transforms() - transforms;
        let convolutions = transforms as f64 / 6.0 + coarse_convolutions;
        self.account(point, now, &info, convolutions)
    }

    /// The friction coefficient of each cell after what it has been through.
    fn update_friction(&mut self) {
        for n in 0..self.mu.len() {
            let (friction, state) = (&self.scene.friction, &self.state);
            let slipped = self.before().slip[n];
            let mu = friction.kinetic.filter(|_| slipped).unwrap_or(friction.mu);
            let map = self.friction_map.get(n).copied().unwrap_or(1.0);
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
