//! The data of a march that are constant along the path, and the drives of an increment.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::State;
use super::expected_radius::expected_radius;
use super::exposed_surface::ExposedSurface;
use crate::cells::{Arms, Drive};
use crate::error::Error;
use crate::plan::{Mirror, Plan};
use crate::scene::{LoadPath, LoadPoint, RigidMotion, Scene};
use crate::solvers::inner::{NormalParams, TangentialParams};
use crate::solvers::intermediate::AlternationParams;

/// A scene and the decisions taken before its first increment.
pub(super) struct Problem {
    /// The scene, with the tolerance that it is solved with.
    pub(super) scene: Scene,
    /// The computations to skip, and the numerical methods.
    pub(super) plan: Plan,
    /// Largest normal force \[N\] and largest approach \[m\] that the path gives.
    pub(super) largest: Largest,
    /// Approach that scales lengths \[m\].
    pub(super) approach: f64,
    /// Largest pressure that the surfaces bear \[Pa\]; infinite for elastic bodies.
    pub(super) hardness: f64,
    /// Cycles of wear done.
    pub(super) cycles: f64,
    /// Surfaces that wear has left.
    pub(super) surface: ExposedSurface,
    /// Part of the tolerance that the increment is solved to.
    pub(super) share: f64,
    /// Whether the end of an indentation is solved again from what its own stick zone remembers.
    pub(super) remembers: bool,
    /// Raised from outside to end the run.
    pub(super) stop: Arc<AtomicBool>,
}

/// The largest loads that a path gives, over all branches.
#[derive(Clone, Copy)]
pub(super) struct Largest {
    pub(super) W: f64,
    pub(super) delta_z: f64,
}

impl Largest {
    /// The largest force and approach of a path.
    pub(super) fn from_path(path: &LoadPath) -> Self {
        Self {
            W: path.W_max(),
            delta_z: path.delta_z_max(),
        }
    }
}

/// The drives of the motions of an increment: across the plane from the unloaded state, in it from
/// the last increment.
#[derive(Clone, Copy)]
pub(super) struct Drives {
    pub(super) normal: Drive,
    pub(super) tangential: Drive,
}

impl Drives {
    /// The load or the motion that drives each of the six motions in the increment to a point. Motions that are
    /// odd under the mirror vanish by symmetry.
    pub(super) fn new(problem: &Problem, arms: &Arms, state: &State, point: &LoadPoint) -> Self {
        let cell_area = problem.cell_area();
        let (forces, given) = (point.loads.forces(), point.loads.given.motions());
        let before = state.motion.motions();
        let drive = |of: [usize; 3], from: [f64; 6]| {
            let mut drive = Drive::default();
            for (k, &load) in of.iter().enumerate() {
                let unit = arms.motion_unit(load);
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

/// Tolerance within which a predicted pressure is accepted, over the whole: the shear changes the
/// gap further.
const PREDICTED_SHARE: f64 = 0.8;
/// Share of the tolerance that the normal solver iterates to.
const NORMAL_SHARE: f64 = 0.4;
/// Share of the tolerance that the tangential solver iterates to; it is the last to change
/// displacements.
pub(crate) const TANGENTIAL_SHARE: f64 = 0.6;
/// A change of the shear is not convolved if it displaces a cell by less than this part of the
/// tangential tolerance.
const NEGLIGIBLE_SHARE: f64 = 0.1;
/// Tolerance of the inner loops over the gap at the start of a pass of the alternation.
const FORCING: f64 = 0.1;

impl Problem {
    /// Fails once the flag is raised: [`Error::Interrupted`] after this `increment`.
    pub(super) fn unless_stopped(&self, increment: usize) -> Result<(), Error> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted { increment });
        }
        Ok(())
    }

    /// Estimate of the approach \[m\] at the loads of a point, from first touch on: the approach of a Hertz
    /// contact. For coatings it is scaled like the square of the expected contact radius.
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
        let prescribed_approach = point.loads.given.delta_z;
        prescribed_approach.map_or_else(hertz, |delta_z| delta_z - touching)
    }

    /// Area that a kept cell stands for \[m^2\].
    pub(super) fn cell_area(&self) -> f64 {
        self.scene.grid.cell_area() * self.plan.mirror.multiplicity()
    }

    /// Whether a load of [`RigidMotion::ALL`] is zero by symmetry.
    pub(super) fn is_odd(&self, load: usize) -> bool {
        self.plan.mirror != Mirror::None && RigidMotion::ALL[load].is_odd_in_y()
    }

    /// The settings of the loops for a share of the tolerance, with tolerances as lengths \[m\].
    pub(super) fn params(&self, share: f64) -> AlternationParams {
        let solver = &self.scene.settings.solver;
        let gap = self.share * share * self.scene.tolerance() * self.approach;
        // An error of the shear acts on the gap, however large mu is: the factor mu is capped at 1.
        let slip = TANGENTIAL_SHARE * self.scene.friction.reference_mu().min(1.0) * gap;
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
