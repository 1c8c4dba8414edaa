//! The problem that a march solves: what does not change along the path, and what drives an increment.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::State;
use super::expected_radius::expected_radius;
use crate::cells::{Arms, Drive};
use crate::error::Error;
use crate::plan::{Mirror, Plan};
use crate::scene::{LoadPath, LoadPoint, RigidMotion, Scene};
use crate::solvers::inner::{NormalParams, TangentialParams};
use crate::solvers::intermediate::AlternationParams;

/// A scene and all that is decided before its first increment.
pub(super) struct Problem {
    /// The scene, with the tolerance that it is solved with.
    pub(super) scene: Scene,
    /// What is skipped, and the numerical methods.
    pub(super) plan: Plan,
    /// Largest normal force \[N\] and largest approach \[m\] that the path gives.
    pub(super) largest: Largest,
    /// Approach that lengths are measured against \[m\].
    pub(super) approach: f64,
    /// Cycles of wear done.
    pub(super) cycles: f64,
    /// Raised from outside to end the run.
    pub(super) stop: Arc<AtomicBool>,
}

/// What a load path gives at most; it takes a look at every branch.
#[derive(Clone, Copy)]
pub(super) struct Largest {
    pub(super) W: f64,
    pub(super) delta_z: f64,
}

impl Largest {
    pub(super) fn of(path: &LoadPath) -> Self {
        Self {
            W: path.W_max(),
            delta_z: path.delta_z_max(),
        }
    }
}

/// What drives the motions of an increment: across the plane from the unloaded state, in it from the last
/// increment.
#[derive(Clone, Copy)]
pub(super) struct Drives {
    pub(super) normal: Drive,
    pub(super) tangential: Drive,
}

impl Drives {
    /// Of an increment to a point. By symmetry the half of a mirrored scene has no motion that turns it.
    pub(super) fn new(problem: &Problem, arms: &Arms, state: &State, point: &LoadPoint) -> Self {
        let cell_area = problem.cell_area();
        let (forces, given) = (point.loads.forces(), point.loads.given.motions());
        let before = state.motion.motions();
        let drive = |of: [usize; 3], from: [f64; 6]| {
            let mut drive = Drive::default();
            for (k, &load) in of.iter().enumerate() {
                let unit = arms.unit(load);
                match given[load] {
                    _ if problem.is_odd(load) => {}
                    Some(motion) => drive.given[k] = (motion - from[load]) * unit,
                    None => {
                        drive.free[k] = true;
                        drive.sums[k] = forces[load] / (cell_area * unit);
                    }
                }
            }
            drive
        };
        Self {
            normal: drive([0, 1, 2], [0.0; 6]),
            tangential: drive([3, 4, 5], before),
        }
    }

    /// Whether anything presses the bodies together.
    pub(super) fn press(&self) -> bool {
        !self.normal.free[0] || self.normal.sums[0] > 0.0
    }
}

/// Share of the tolerance with which a predicted pressure is taken as it is: the shear moves it
/// further.
const PREDICTED_SHARE: f64 = 0.8;
/// Share of the tolerance that the normal solver iterates to.
const NORMAL_SHARE: f64 = 0.4;
/// Share of the tolerance that the tangential solver iterates to; nothing moves after it.
pub(crate) const TANGENTIAL_SHARE: f64 = 0.6;
/// Part of the tolerance of the tangential solver that a change of the shear may move a cell by and yet be neglected.
const NEGLIGIBLE_SHARE: f64 = 0.1;
/// Part of the gap that a pass of the alternation begins with down to which its inner loops solve.
const FORCING: f64 = 0.1;

impl Problem {
    /// Fails once the flag is raised: [`Error::Interrupted`] after so many increments.
    pub(super) fn unless_stopped(&self, increment: usize) -> Result<(), Error> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted { increment });
        }
        Ok(())
    }

    /// The approach at the loads of a point from that at which the bodies touch \[m\], about: that of a Hertz
    /// contact, which a coating makes as much larger or smaller as it does the square of the contact radius.
    pub(super) fn approach_at(&self, point: &LoadPoint, touching: f64) -> f64 {
        let hertz = || {
            let radius = expected_radius(&self.scene);
            let coated = self
                .scene
                .hertz()
                .map_or(1.0, |hertz| (radius / hertz.a).powi(2));
            let part = point.loads.W / self.largest.W;
            coated * self.approach * part.powf(2.0 / 3.0)
        };
        let given = point.loads.given.delta_z;
        given.map_or_else(hertz, |delta_z| delta_z - touching)
    }

    /// Area that a kept cell stands for \[m^2\].
    pub(super) fn cell_area(&self) -> f64 {
        self.scene.grid.cell_area() * self.plan.mirror.multiplicity()
    }

    /// Whether a load of [`RigidMotion::ALL`] is zero by symmetry.
    pub(super) fn is_odd(&self, load: usize) -> bool {
        self.plan.mirror != Mirror::None && RigidMotion::ALL[load].is_odd_in_y()
    }

    /// The settings of the loops, with lengths in metres, for a share of the tolerance.
    pub(super) fn params(&self, share: f64) -> AlternationParams {
        let solver = &self.scene.settings.solver;
        let gap = share * self.scene.tolerance() * self.approach;
        // What the shear misses acts on the gap, however large mu is.
        let slip = TANGENTIAL_SHARE * self.scene.friction.scale().min(1.0) * gap;
        AlternationParams {
            tolerance: gap,
            normal: NormalParams {
                enough: PREDICTED_SHARE * gap,
                tolerance: NORMAL_SHARE * gap,
                max_iterations: solver.max_iterations,
            },
            tangential: TangentialParams {
                method: self.plan.methods.tangential,
                tolerance: slip,
                negligible: NEGLIGIBLE_SHARE * slip,
                max_iterations: solver.max_iterations,
                forcing: 0.2,
                max_passes: 12,
            },
            max_alternations: solver.max_alternations,
            forcing: if self.plan.methods.inexact {
                FORCING
            } else {
                0.0
            },
            new_cells_slip: self.plan.methods.new_cells_slip,
            anderson: self.plan.methods.anderson,
        }
    }
}
