//! How a scene is solved.

mod kernel_method;
mod path_grid;
mod preset;
mod save;
mod skip;

use contact_core::scene as core;
use pyo3::prelude::*;

use crate::error::to_python;
use crate::parts::{parts, shown_by_parts};
use kernel_method::Method;
pub(crate) use kernel_method::{FrequencyDomain, Hankel, InverseFft};
use path_grid::PathGrid;
pub(crate) use preset::Preset;
pub(crate) use save::Save;
pub(crate) use skip::Skip;

/// How a scene is solved; the defaults are what most users want.
///
/// Parameters
/// ----------
/// preset : Preset, optional
///     Which algorithms (default ``Preset.FAST``).
/// tolerance : float, optional
///     Relative tolerance of the solution (default 1e-6; where increments are chosen 1/125 of
///     ``path_tolerance`` if that is more, 1/2500 where loads only press): gap error in the
///     contact over the Hertz approach, tangential misfit over mu times it, change of the
///     tractions in the last pass.
/// entering : bool, optional
///     Reckon the slip of cells that come into contact from their entry (default True): one more
///     solution in increments in which the contact grows, and far fewer increments.
/// path_tolerance : float, optional
///     Largest error of the shear at the ends of branches that ``increments="auto"`` leaves, over
///     the largest shear of the path (L2, default 5e-3).
/// path_grid : "auto", "same" or int, optional
///     Cells along x of the grid for increments that are solved for the path alone (fields not
///     kept, not the end of a branch, constant normal force and tilting moments): a half or a
///     quarter of those of the grid; ``"same"``: the grid itself. ``"auto"`` (default): chosen with
///     the increments, such that ``path_tolerance`` holds; ``"same"`` where these are given.
/// turning : bool, optional
///     Let slip follow the turn of the shear within an increment (default True): the path becomes
///     of second order.
/// max_alternations : int, optional
///     Most passes of the intermediate loop per increment (default 60).
/// max_iterations : int, optional
///     Most iterations of an inner loop (default 1000).
/// kernel : Hankel, InverseFft or FrequencyDomain, optional
///     Conversion of the frequency response of coated bodies (default ``Hankel()``).
/// kernel_tolerance : float, optional
///     Largest error of the influence coefficients over C33(0, 0) (default 1e-10).
/// skip : Skip, optional
///     What may be left out (default: all that the scene does not need).
/// save : "branches", "all" or sequence of int, optional
///     Which increments keep their fields (default ``"branches"``: the last of each branch).
///     Increments count from 1; the last of the path is always kept.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Default, PartialEq)]
pub(crate) struct Settings(pub(crate) core::Settings);

parts!(
    Settings: preset, tolerance, entering, turning, path_tolerance, path_grid,
    max_alternations, max_iterations, kernel, kernel_tolerance, skip, save
);

shown_by_parts!(Settings);

#[pymethods]
impl Settings {
    #[new]
    #[pyo3(signature = (
        *, preset = None, tolerance = None, entering = None, turning = None, path_tolerance = None, path_grid = None, max_alternations = None, max_iterations = None,
        kernel = None, kernel_tolerance = None, skip = None, save = None,
    ))]
    fn new(
        preset: Option<Preset>,
        tolerance: Option<f64>,
        entering: Option<bool>,
        turning: Option<bool>,
        path_tolerance: Option<f64>,
        path_grid: Option<PathGrid>,
        max_alternations: Option<usize>,
        max_iterations: Option<usize>,
        kernel: Option<Method>,
        kernel_tolerance: Option<f64>,
        skip: Option<Skip>,
        save: Option<Save>,
    ) -> PyResult<Self> {
        let mut settings = core::Settings::default();
        let solver = &mut settings.solver;
        solver.preset = match preset {
            None => solver.preset,
            Some(Preset::Fast) => core::Preset::Fast,
            Some(Preset::Spinu2020) => core::Preset::Spinu2020,
        };
        solver.tolerance = tolerance.or(solver.tolerance);
        solver.entering = entering.unwrap_or(solver.entering);
        solver.turning = turning.unwrap_or(solver.turning);
        solver.path_tolerance = path_tolerance.unwrap_or(solver.path_tolerance);
        if let Some(path_grid) = path_grid {
            solver.path_grid = path_grid.into_core()?;
        }
        solver.max_alternations = max_alternations.unwrap_or(solver.max_alternations);
        solver.max_iterations = max_iterations.unwrap_or(solver.max_iterations);
        settings.kernel.method = kernel.map_or(settings.kernel.method, Into::into);
        settings.kernel.tolerance = kernel_tolerance.unwrap_or(settings.kernel.tolerance);
        settings.skip = skip.map_or(settings.skip, |s| s.0);
        if let Some(save) = save {
            settings.save = save.into_core()?;
        }
        settings.check().map_err(to_python)?;
        Ok(Self(settings))
    }

    /// Which algorithms.
    #[getter]
    fn preset(&self) -> Preset {
        match self.0.solver.preset {
            core::Preset::Fast => Preset::Fast,
            core::Preset::Spinu2020 => Preset::Spinu2020,
        }
    }

    /// Relative tolerance of the solution; None: the default.
    #[getter]
    fn tolerance(&self) -> Option<f64> {
        self.0.solver.tolerance
    }

    /// Whether slip is reckoned from the entry of a cell into the contact.
    #[getter]
    fn entering(&self) -> bool {
        self.0.solver.entering
    }

    /// Whether slip follows the turn of the shear within an increment.
    #[getter]
    fn turning(&self) -> bool {
        self.0.solver.turning
    }

    /// Largest error of the shear that increments are chosen for.
    #[getter]
    fn path_tolerance(&self) -> f64 {
        self.0.solver.path_tolerance
    }

    /// Grid of the increments that are solved for the path alone.
    #[getter]
    fn path_grid(&self) -> PathGrid {
        self.0.solver.path_grid.into()
    }

    /// Most passes of the intermediate loop per increment.
    #[getter]
    fn max_alternations(&self) -> usize {
        self.0.solver.max_alternations
    }

    /// Most iterations of an inner loop.
    #[getter]
    fn max_iterations(&self) -> usize {
        self.0.solver.max_iterations
    }

    /// Conversion of the frequency response.
    #[getter]
    fn kernel(&self) -> Method {
        self.0.kernel.method.into()
    }

    /// Largest error of the influence coefficients over C33(0, 0).
    #[getter]
    fn kernel_tolerance(&self) -> f64 {
        self.0.kernel.tolerance
    }

    /// Which increments keep their fields.
    #[getter]
    fn save(&self) -> Save {
        (&self.0.save).into()
    }

    /// What may be left out.
    #[getter]
    fn skip(&self) -> Skip {
        Skip(self.0.skip)
    }
}
