//! How a scene is solved and which of its fields are saved.

use crate::error::Error;

/// All settings; `Settings::default()` suits most users.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Conversion of the frequency response.
    pub kernel: KernelSettings,
    /// The three levels of iteration.
    pub solver: SolverSettings,
    /// Computations that may be skipped where the scene does not need them.
    pub skip: SkipSettings,
    /// Choice of the increments whose fields are saved.
    pub save: SaveFields,
}

/// Tolerance of the solution, and its part of the tolerance on the path where the increments are
/// chosen: of a path that only presses the bodies together, where slip is near the rim alone, and
/// of other paths. On the paper's scene with E1/E2 = 0.5, 2, 4 (256 x 256 cells) five eighths of it
/// take 7 % more convolutions for shear at the ends of branches that is
/// 0, 5 and 4 % better, five quarters 3 % fewer for 2 % worse, 1 % better and 8 % worse.
pub(super) const TOLERANCE: f64 = 1e-6;
pub(super) const PATH_PART: [f64; 2] = [4e-4, 8e-3];

/// Highest order of an alias sum; its work grows with the square.
pub(crate) const MOST_ALIASES: usize = 32;

/// Settings of the conversion from the frequency response of a coated body to influence coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelSettings {
    /// Method of conversion (default: [`KernelMethod::Hankel`]).
    pub method: KernelMethod,
    /// Largest error allowed, over `C33(0,0)` (default 1e-10). Only the Hankel method keeps it.
    pub tolerance: f64,
}

impl Default for KernelSettings {
    /// Hankel transforms to a tolerance of 1e-10.
    fn default() -> Self {
        Self {
            method: KernelMethod::Hankel,
            tolerance: 1e-10,
        }
    }
}

/// Method of conversion of a frequency response to influence coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelMethod {
    /// Closed form of the outermost material's half-space plus Hankel integrals of the smooth
    /// remainder. Exact to round-off.
    Hankel,
    /// The paper's eq. (9)-(13): inverse FFT on a domain enlarged `lambda` times, zero frequency
    /// averaged over its cell, with the alias sums up to order `aliases` (the paper: 0).
    InverseFft {
        /// Enlargement of the domain, 1 to 12.
        lambda: usize,
        /// Order of the alias sum, 0 to 32.
        aliases: usize,
    },
    /// The paper's reference \[15\]: no coefficients at all; every convolution is done directly
    /// with the frequency response on a domain enlarged `lambda` times.
    FrequencyDomain {
        /// Enlargement of the domain, 1 to 12.
        lambda: usize,
    },
}

/// Settings of the iterations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// Family of algorithms (default: [`Preset::Fast`]).
    pub preset: Preset,
    /// Relative tolerance of the solution (default:
    /// [`Scene::tolerance`](super::Scene::tolerance)): root-mean-square gap error in the contact
    /// and deepest overlap outside over the Hertz approach, tangential misfit over mu times the
    /// Hertz approach.
    pub tolerance: Option<f64>,
    /// Compute the slip of cells that come into contact from their entry (default true): one more
    /// solution in increments in which the contact grows, and far fewer increments. The preset
    /// [`Preset::Spinu2020`] does without.
    pub cell_entry_correction: bool,
    /// Let the direction of slip follow the shear within an increment (default true): the path becomes
    /// of second order. The preset [`Preset::Spinu2020`] does without.
    pub slip_rotation_correction: bool,
    /// Largest error of the shear at the ends of branches for chosen increments,
    /// over the largest shear of the path (L2, default 5e-3).
    pub path_tolerance: f64,
    /// The grid that the path is solved on between the increments whose fields are kept (default:
    /// [`PathGrid::Auto`]).
    pub path_grid: PathGrid,
    /// Most passes of the intermediate loop per increment (default 60).
    pub max_alternations: usize,
    /// Most iterations of an inner loop (default 1000).
    pub max_iterations: usize,
}

impl Default for SolverSettings {
    /// All methods on, the tolerance of the path 0.5 %.
    fn default() -> Self {
        Self {
            preset: Preset::Fast,
            tolerance: None,
            cell_entry_correction: true,
            slip_rotation_correction: true,
            path_tolerance: 5e-3,
            path_grid: PathGrid::Auto,
            max_alternations: 60,
            max_iterations: 1000,
        }
    }
}

/// The grid of increments that are solved for the path alone: their fields are not kept, they do not
/// end a branch, and the normal force and the tilting moments are constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathGrid {
    /// Chosen with the increments ([`choose_increments`](crate::estimate::choose_increments)); where
    /// these are given, the grid of the scene.
    Auto,
    /// The grid of the scene.
    Same,
    /// Cells along x: an even half or quarter of the cells of the grid.
    Cells(usize),
}

/// Families of algorithms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// Preconditioned solvers, sets and fields carried over and extrapolated.
    Fast,
    /// The paper's method: unpreconditioned conjugate gradients of the Polonsky-Keer type in both
    /// directions, plain alternation, warm start from the last increment.
    Spinu2020,
}

/// Parts of the computation that may be skipped. No rule changes the result; each can be switched
/// off to prove it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools)] // one for each rule
pub struct SkipSettings {
    /// Treat a body whose layers all equal its substrate as homogeneous (default true).
    pub equal_layers: bool,
    /// Leave out the normal-tangential kernels and the intermediate loop where they vanish
    /// (default true).
    pub coupling: bool,
    /// Solve on half of a mirror-symmetric scene (default true).
    pub mirror: bool,
    /// Compute responses to changes of the tractions in single precision where the tolerance is a
    /// thousand times coarser than its digits (default true).
    pub single_precision: bool,
    /// Solve in a window around the contact, where no cell beyond it can touch (default true).
    pub contact_window: bool,
    /// Leave out the increments of branches whose end does not depend on the path (default false:
    /// the results have a row for every increment asked for, and loops their points). They are
    /// solved all the same if their fields are to be saved.
    pub path_independent_branches: bool,
}

impl Default for SkipSettings {
    /// All skips on, except path-independent branches.
    fn default() -> Self {
        Self {
            equal_layers: true,
            coupling: true,
            mirror: true,
            single_precision: true,
            contact_window: true,
            path_independent_branches: false,
        }
    }
}

/// Choice of the increments whose fields are saved; scalars are saved for all.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SaveFields {
    /// The ends of the branches (default).
    #[default]
    Branches,
    /// Every increment.
    All,
    /// The increments with these indices, from 1, and the last.
    Indices(Vec<usize>),
}

impl Settings {
    /// Fails at a number without meaning.
    pub fn check(&self) -> Result<(), Error> {
        let lambda = match self.kernel.method {
            KernelMethod::Hankel => 1,
            KernelMethod::InverseFft { lambda, .. } | KernelMethod::FrequencyDomain { lambda } => {
                lambda
            }
        };
        if !(1..=12).contains(&lambda) {
            return Err(Error::invalid("kernel.lambda", lambda, "1 to 12"));
        }
        if let KernelMethod::InverseFft { aliases, .. } = self.kernel.method
            && aliases > MOST_ALIASES
        {
            let allowed = format!("0 to {MOST_ALIASES}");
            return Err(Error::invalid("kernel.aliases", aliases, allowed));
        }
        for (key, value) in [
            ("kernel.tolerance", self.kernel.tolerance),
            (
                "solver.tolerance",
                self.solver.tolerance.unwrap_or(TOLERANCE),
            ),
            ("solver.path_tolerance", self.solver.path_tolerance),
        ] {
            if !(value > 0.0 && value < 1.0) {
                return Err(Error::invalid(key, value, "between 0 and 1"));
            }
        }
        for (key, value) in [
            ("solver.max_alternations", self.solver.max_alternations),
            ("solver.max_iterations", self.solver.max_iterations),
        ] {
            if value == 0 {
                return Err(Error::invalid(key, value, "at least 1"));
            }
        }
        Ok(())
    }
}
