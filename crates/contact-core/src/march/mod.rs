//! Stage 5: THE LOAD PATH, one increment at a time (the outer loop of figure 2 of the paper).

mod awake;
mod balance;
mod border;
mod carried;
mod coarse;
mod entering;
mod fields;
mod halving;
mod increment;
mod predict;
mod solve;
mod state;

pub use fields::Fields;
pub use increment::{Energy, Increment, Motion, Residuals, Status, Work};
pub use solve::{BranchSummary, Observer, solve, summarise};
pub use state::State;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use self::awake::with_all_awake;
use self::carried::Carried;
use self::coarse::coarse_start;
use self::predict::first_touch;
use crate::convolution::{
    CirculantInverse, DcFft, FrequencyDomain, Half, Mirror, PARALLEL_FROM, SurfaceOperator,
};
use crate::error::Error;
use crate::kernels::influence_coefficients;
use crate::scene::{History, KernelMethod, LoadPoint, Plan, Preset, Scene};
use crate::solvers::{
    Arms, CoupledInfo, CoupledParams, CoupledWorkspace, Drive, IncrementProblem, Interface,
    NormalParams, Response, TangentialMethod, TangentialParams, coupled,
};

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
    workspace: CoupledWorkspace,
    /// Raised from outside to end the run.
    stop: Arc<AtomicBool>,
}

impl March {
    /// Checks the scene, plans, and computes the kernels.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        scene.check()?;
        let plan = Plan::new(scene);
        plan.check_memory(scene)?;
        let settings = &scene.settings;
        let coefficients = |body| {
            influence_coefficients(
                body,
                &scene.grid,
                &settings.kernel,
                settings.skip.equal_layers,
            )
        };
        let stretch = scene.friction.stretch();
        let pair = coefficients(&scene.body2)?
            .pair(&coefficients(&scene.body1)?)
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

    /// Solves the increment from a start, on the cells of the last contact alone if it is `kept`.
    fn solve_pressed(
        &mut self,
        mut now: Interface,
        (normal, tangential): (Drive, Drive),
        kept: bool,
    ) -> Result<(Interface, CoupledInfo), Error> {
        let apart;
        let h_init = if kept {
            let far = 1e3 * (self.approach + self.h_init.iter().fold(0.0, |m, h| h.abs().max(m)));
            let p = &self.state.interface.p;
            let cells = self.h_init.iter().zip(p);
            apart = cells
                .map(|(h, &p)| if p > 0.0 { *h } else { h + far })
                .collect();
            &apart
        } else {
            &self.h_init
        };
        // As March::before, for the sake of the workspace borrowed beside it.
        let carried = self.carried.as_ref();
        let before = carried.map_or(&self.state.interface, Carried::interface);
        let problem = IncrementProblem {
            h_init,
            u_ref: [&before.u[0], &before.u[1]],
            mu: &self.mu,
            arms: &self.arms,
            normal,
            tangential,
        };
        let mut response = Response {
            op: &mut *self.op,
            inverse: self.inverse.as_mut(),
            stop: Some(&self.stop),
        };
        let params = params(&self.scene, self.approach);
        let ws = &mut self.workspace;
        match coupled(&mut response, &problem, &mut now, ws, &params) {
            Ok(info) => Ok((now, info)),
            Err(_) if self.stop.load(Ordering::Relaxed) => Err(Error::Interrupted {
                increment: self.state.increments,
            }),
            Err(e) => Err(Error::NotConverged {
                increment: self.state.increments + 1,
                solver: e.solver,
                residual: e.residual,
                tolerance: e.tolerance,
                iterations: e.iterations,
            }),
        }
    }

    /// What drives the motions across the plane, from the unloaded state, and those in it, in this
    /// increment. By symmetry the half of a mirrored scene has no motion that turns it.
    fn drives(&self, point: &LoadPoint) -> (Drive, Drive) {
        let cell_area = self.scene.grid.cell_area() * self.plan.mirror.multiplicity();
        let (forces, given) = (point.loads.forces(), point.loads.given.motions());
        let before = self.state.motion.motions();
        let mirrored = self.plan.mirror != Mirror::None;
        let drive = |of: [usize; 3], from: [f64; 6]| {
            let mut drive = Drive::default();
            for (k, &load) in of.iter().enumerate() {
                let unit = self.unit(load);
                let odd = mirrored && matches!(load, 1 | 4 | 5);
                match given[load] {
                    _ if odd => {}
                    Some(motion) => drive.given[k] = (motion - from[load]) * unit,
                    None => {
                        drive.free[k] = true;
                        drive.sums[k] = forces[load] / (cell_area * unit);
                    }
                }
            }
            drive
        };
        (drive([0, 1, 2], [0.0; 6]), drive([3, 4, 5], before))
    }

    /// What a motion of [`MOTIONS`](crate::scene::MOTIONS) is multiplied by, and its load divided by,
    /// for the solvers.
    pub(super) fn unit(&self, k: usize) -> f64 {
        match k {
            1 | 2 | 5 => self.arms.length,
            4 => self.arms.stretch,
            _ => 1.0,
        }
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

    /// The fields after the last increment on the whole grid.
    pub fn fields(&self) -> Fields {
        let (nx, ny) = (self.scene.grid.nx, self.scene.grid.ny);
        let unfold = |f: &[f64], half| self.plan.mirror.unfold(f, nx, ny, half);
        let s = &self.state;
        let now = &s.interface;
        let Motion {
            delta_z,
            phi_x,
            phi_y,
            ..
        } = s.motion;
        let stretch = self.arms.stretch;
        let rigid = self.scene.grid.map(|x, y| delta_z + y * phi_x - x * phi_y);
        let p = unfold(&now.p, Half::Even);
        let u_z = unfold(&now.u_z, Half::Even);
        let slips: Vec<f64> = now.slip.iter().map(|&s| f64::from(u8::from(s))).collect();
        let slips = unfold(&slips, Half::Even);
        let contact = p.mapv(|p| p > 0.0);
        let stick = ndarray::Zip::from(&contact)
            .and(&slips)
            .map_collect(|&c, &slips| c && slips == 0.0);
        Fields {
            gap: u_z.clone() + self.scene.h_init() - rigid,
            q_x: unfold(&now.q[0], Half::Even),
            q_y: unfold(&now.q[1], Half::Odd) * stretch,
            u_x: unfold(&now.u[0], Half::Even),
            u_y: unfold(&now.u[1], Half::Odd) / stretch,
            slip_x: unfold(&s.slip[0], Half::Even),
            slip_y: unfold(&s.slip[1], Half::Odd) / stretch,
            dissipated: unfold(&s.dissipated, Half::Even),
            p,
            u_z,
            contact,
            stick,
        }
    }
}

/// Share of the tolerance with which a predicted pressure is taken as it is: the shear moves it
/// further.
const PREDICTED_SHARE: f64 = 0.8;
/// Share of the tolerance that the normal solver iterates to.
const NORMAL_SHARE: f64 = 0.4;
/// Share of the tolerance that the tangential solver iterates to; nothing moves after it.
const TANGENTIAL_SHARE: f64 = 0.9;

/// The settings of the loops, with lengths in metres.
fn params(scene: &Scene, approach: f64) -> CoupledParams {
    let solver = &scene.settings.solver;
    let gap = solver.tolerance * approach;
    let plain = solver.preset == Preset::Spinu2020;
    CoupledParams {
        tolerance: gap,
        normal: NormalParams {
            enough: PREDICTED_SHARE * gap,
            tolerance: NORMAL_SHARE * gap,
            max_iterations: solver.max_iterations,
        },
        tangential: TangentialParams {
            method: if plain {
                TangentialMethod::Gradient
            } else {
                TangentialMethod::Newton
            },
            // What the shear misses acts on the gap, however large mu is.
            tolerance: TANGENTIAL_SHARE * scene.friction.scale().min(1.0) * gap,
            max_iterations: solver.max_iterations,
            forcing: 0.2,
            max_passes: 12,
        },
        max_alternations: solver.max_alternations,
    }
}
