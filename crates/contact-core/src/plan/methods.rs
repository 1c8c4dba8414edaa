//! The numerical methods of a run.

use crate::scene::{KernelMethod, Preset, Scene};
use crate::yielding::volume_cells;

/// Algorithm of the tangential problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TangentialMethod {
    /// Semi-smooth Newton steps, [`solve_tangential`](crate::solvers::inner::solve_tangential).
    Newton,
    /// Conjugate gradients of the Polonsky-Keer type, as in the paper.
    Gradient,
}

/// The numerical methods of a run, decided once; each can be switched off alone to measure its benefit
/// (`docs/ablation.md`). `spinu2020` is the paper's choice: none of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools)] // one for each method
pub struct Methods {
    /// Algorithm of the tangential problem (default [`TangentialMethod::Newton`]).
    pub tangential: TangentialMethod,
    /// Precondition the conjugate gradients with a circulant inverse (default true).
    pub preconditioner: bool,
    /// Compute the slip of cells that come into contact from their entry (default: the setting).
    pub entry: bool,
    /// Order the entry of the cells next to the contact one by one; without it their motion is
    /// summed from cell to cell, as for cells farther away (default true).
    pub order_of_entry: bool,
    /// Number of substeps, equal in the root of the radius, in which a contact of dissimilar bodies grows to
    /// the largest of the path; twice the number of substeps of equal radius for similar bodies sheared
    /// meanwhile (default 20; 1 for whole increments).
    pub growth_steps: usize,
    /// Let the direction of slip follow the shear within an increment (default: the setting).
    pub slip_rotation: bool,
    /// Correct the next increment by the residual slip of the last one (default true).
    pub residual_slip: bool,
    /// Extrapolate the first guess along a path that keeps its direction (default true).
    pub extrapolation: bool,
    /// Begin a first contact from the pressure of a paraboloid (default true).
    pub first_contact: bool,
    /// End the inner loops early in all passes but the last (default true).
    pub inexact: bool,
    /// Let cells that the normal solver brings into contact slip at once, where friction does not
    /// hold them (default true).
    pub new_cells_slip: bool,
    /// Accelerate an alternation that is slow (default true).
    pub anderson: bool,
    /// Retry an increment that does not converge, without extrapolation and in halves (default
    /// true).
    pub retries: bool,
    /// Continue zones to their borders within the cells: areas and radii; without it whole cells
    /// count (default true).
    pub partial_cells: bool,
    /// Largest number of cells along a side of the volume grid of yielding bodies (default 64, of a line contact 256);
    /// elements grow with the cells.
    pub volume_cells: usize,
    /// Keep the threads of the pool awake while an increment is solved (default true).
    pub busy_threads: bool,
    /// Solve in a window around the contact (default: the rule of the plan).
    pub window: bool,
    /// Compute responses to changes of the tractions in single precision (default: the rule of the plan).
    pub single_precision: bool,
}

/// The largest error of a cell after an indentation of the paper's scene is 1.8 to 2.5 % with
/// 20 substeps, 1.4 to 1.7 % with 24.
const GROWTH_STEPS: usize = 20;

impl Methods {
    /// Chooses the methods of a scene by its preset and settings.
    pub(super) fn new(scene: &Scene, window: bool, single_precision: bool) -> Self {
        let solver = &scene.settings.solver;
        let fast = solver.preset == Preset::Fast;
        Self {
            tangential: match solver.preset {
                Preset::Fast => TangentialMethod::Newton,
                Preset::Spinu2020 => TangentialMethod::Gradient,
            },
            preconditioner: fast,
            entry: fast && solver.cell_entry_correction,
            order_of_entry: fast,
            growth_steps: GROWTH_STEPS,
            slip_rotation: fast && solver.slip_rotation_correction,
            residual_slip: fast,
            extrapolation: fast,
            first_contact: true,
            inexact: fast,
            new_cells_slip: fast,
            anderson: true,
            retries: true,
            partial_cells: true,
            volume_cells: volume_cells(scene.grid.plane_strain),
            busy_threads: true,
            window,
            single_precision,
        }
    }
}

/// The finest tolerance for which single precision is used: its rounding errors are at most a tenth
/// of it.
const SINGLE: f64 = 1e-6;

/// Whether single precision is enough for the response to changes of the tractions: Ok has the reason why, Err
/// the reason why not. The response to the whole tractions is computed in double precision in each increment.
pub(super) fn decide_single_precision(scene: &Scene) -> Result<&'static str, &'static str> {
    if !scene.settings.skip.single_precision {
        Err("skip.single_precision is off")
    } else if scene.settings.solver.preset != Preset::Fast {
        Err("solver.preset is spinu2020")
    } else if uses_frequency_domain(scene) {
        Err("the frequency-domain operator has double precision alone")
    } else if scene.tolerance() < SINGLE {
        Err("the tolerance is finer than 1e-6")
    } else {
        Ok("the tolerance is 1e-6 or more")
    }
}

/// Whether it is enough to solve on a window around the contact: Ok has the reason why, Err the reason why not.
pub(super) fn decide_window(scene: &Scene) -> Result<&'static str, &'static str> {
    if !scene.settings.skip.contact_window {
        return Err("skip.contact_window is off");
    }
    if scene.settings.solver.preset != Preset::Fast {
        return Err("solver.preset is spinu2020");
    }
    if uses_frequency_domain(scene) {
        return Err("the frequency-domain operator works on the whole grid");
    }
    if scene.grid.plane_strain {
        return Err("the grid is one row of cells");
    }
    if scene.path.branches.iter().any(|b| b.to.rolled != 0.0) {
        return Err("the bodies roll over the grid");
    }
    Ok("a window goes with the contact; the gap beyond it is checked")
}

/// Whether the scene convolves in the frequency domain, without influence coefficients.
pub(super) fn uses_frequency_domain(scene: &Scene) -> bool {
    let method = &scene.settings.kernel.method;
    matches!(method, KernelMethod::FrequencyDomain { .. })
}
