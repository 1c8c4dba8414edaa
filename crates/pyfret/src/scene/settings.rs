//! How a scene is solved.

use contact_core::Error;
use contact_core::scene as core;
use pyo3::prelude::*;

use crate::error::to_python;
use crate::parts::{members, parts};

/// Families of algorithms.
///
/// ``FAST``: preconditioned solvers; sets and fields carried over and extrapolated.
/// ``SPINU2020``: the paper's, plain conjugate gradients in both directions, plain alternation.
#[pyclass(frozen, eq, eq_int, hash, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Preset {
    #[pyo3(name = "FAST")]
    Fast,
    #[pyo3(name = "SPINU2020")]
    Spinu2020,
}

members!(Preset);

/// Influence coefficients by Hankel integrals: exact to round-off.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Hankel;

parts!(Hankel:);

#[pymethods]
impl Hankel {
    #[new]
    fn new() -> Self {
        Self
    }
}

/// Influence coefficients by the paper's inverse FFT, eq. (9)-(13).
///
/// Parameters
/// ----------
/// enlargement : int
///     How many times larger the domain is, the paper's lambda, 1 to 12 (default 8).
/// aliases : int
///     Order of the alias sums (default 0, as in the paper).
#[pyclass(frozen, eq, get_all, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct InverseFft {
    /// How many times larger the domain is.
    enlargement: usize,
    /// Order of the alias sums.
    aliases: usize,
}

parts!(InverseFft: enlargement, aliases);

#[pymethods]
impl InverseFft {
    #[new]
    #[pyo3(signature = (*, enlargement = 8, aliases = 0))]
    fn new(enlargement: usize, aliases: usize) -> Self {
        Self {
            enlargement,
            aliases,
        }
    }
}

/// No coefficients: every convolution with the frequency response on an enlarged domain.
///
/// Parameters
/// ----------
/// enlargement : int
///     How many times larger the domain is, 1 to 12 (default 8).
#[pyclass(frozen, eq, get_all, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct FrequencyDomain {
    /// How many times larger the domain is.
    enlargement: usize,
}

parts!(FrequencyDomain: enlargement);

#[pymethods]
impl FrequencyDomain {
    #[new]
    #[pyo3(signature = (*, enlargement = 8))]
    fn new(enlargement: usize) -> Self {
        Self { enlargement }
    }
}

/// Any method of conversion, on its way in or out.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Method {
    Hankel(Hankel),
    InverseFft(InverseFft),
    FrequencyDomain(FrequencyDomain),
}

impl From<Method> for core::KernelMethod {
    fn from(method: Method) -> Self {
        match method {
            Method::Hankel(_) => Self::Hankel,
            Method::InverseFft(InverseFft {
                enlargement: lambda,
                aliases,
            }) => Self::InverseFft { lambda, aliases },
            Method::FrequencyDomain(FrequencyDomain {
                enlargement: lambda,
            }) => Self::FrequencyDomain { lambda },
        }
    }
}

impl From<core::KernelMethod> for Method {
    fn from(method: core::KernelMethod) -> Self {
        match method {
            core::KernelMethod::Hankel => Self::Hankel(Hankel),
            core::KernelMethod::InverseFft { lambda, aliases } => Self::InverseFft(InverseFft {
                enlargement: lambda,
                aliases,
            }),
            core::KernelMethod::FrequencyDomain { lambda } => {
                Self::FrequencyDomain(FrequencyDomain {
                    enlargement: lambda,
                })
            }
        }
    }
}

/// What may be left out when the scene does not need it; the answer stays as it is.
///
/// Parameters
/// ----------
/// equal_layers : bool
///     Treat a body whose layers all equal its substrate as homogeneous (default True).
/// coupling : bool
///     Leave out the normal-tangential kernels where they vanish (default True).
/// mirror : bool
///     Solve on half of a mirror-symmetric scene (default True).
/// digits : bool
///     Answer changes of the tractions in single precision where the tolerance is 1e-6 or more
///     (default True).
/// far : bool
///     Solve in a window around the contact, where no cell beyond it can touch (default True).
/// path : bool
///     Leave out the increments of branches whose end does not depend on the way there
///     (default False: results have a row for every increment asked for); they are solved if
///     their fields are to be kept.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Skip(core::SkipSettings);

parts!(Skip: equal_layers, coupling, mirror, digits, far, path);

#[pymethods]
impl Skip {
    #[new]
    #[pyo3(signature = (*, equal_layers = true, coupling = true, mirror = true, digits = true,
                        far = true, path = false))]
    #[allow(clippy::fn_params_excessive_bools)] // one for each rule
    fn new(
        equal_layers: bool,
        coupling: bool,
        mirror: bool,
        digits: bool,
        far: bool,
        path: bool,
    ) -> Self {
        Self(core::SkipSettings {
            equal_layers,
            coupling,
            mirror,
            digits,
            far,
            path,
        })
    }

    /// Whether a body of equal layers is treated as homogeneous.
    #[getter]
    fn equal_layers(&self) -> bool {
        self.0.equal_layers
    }

    /// Whether vanishing normal-tangential kernels are left out.
    #[getter]
    fn coupling(&self) -> bool {
        self.0.coupling
    }

    /// Whether a mirror-symmetric scene is solved on its half.
    #[getter]
    fn mirror(&self) -> bool {
        self.0.mirror
    }

    /// Whether changes of the tractions are answered in single precision.
    #[getter]
    fn digits(&self) -> bool {
        self.0.digits
    }

    /// Whether cells that can never touch are left out.
    #[getter]
    fn far(&self) -> bool {
        self.0.far
    }

    /// Whether increments are left out where the way does not count.
    #[getter]
    fn path(&self) -> bool {
        self.0.path
    }
}

/// Which increments keep their fields, on its way in or out.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Save {
    Indices(Vec<usize>),
    Named(String),
}

impl Save {
    pub(crate) fn into_core(self) -> PyResult<core::SaveFields> {
        match self {
            Self::Indices(indices) => Ok(core::SaveFields::Indices(indices)),
            Self::Named(name) if name == "branches" => Ok(core::SaveFields::Branches),
            Self::Named(name) if name == "all" => Ok(core::SaveFields::All),
            Self::Named(name) => {
                let allowed = "\"branches\", \"all\" or a list of increments, from 1";
                Err(to_python(Error::invalid("output.save", name, allowed)))
            }
        }
    }
}

impl From<&core::SaveFields> for Save {
    fn from(save: &core::SaveFields) -> Self {
        match save {
            core::SaveFields::Branches => Self::Named("branches".into()),
            core::SaveFields::All => Self::Named("all".into()),
            core::SaveFields::Indices(indices) => Self::Indices(indices.clone()),
        }
    }
}

/// How a scene is solved; the defaults are what most users want.
///
/// Parameters
/// ----------
/// preset : Preset, optional
///     Which algorithms (default ``Preset.FAST``).
/// tolerance : float, optional
///     Relative tolerance of the solution (default 1e-6; where increments are chosen 1/100 of
///     ``path_tolerance`` if that is more, 1/2500 where loads only press): gap error in the
///     contact over the Hertz approach, tangential misfit over mu times it, change of the
///     tractions in the last pass.
/// entering : bool, optional
///     Reckon the slip of cells that come into contact from their entry (default True): one more
///     solution in increments in which the contact grows, and far fewer increments.
/// path_tolerance : float, optional
///     Largest error of the shear at the ends of branches that ``increments="auto"`` leaves, over
///     the largest shear of the path (L2, default 5e-3).
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
    Settings: preset, tolerance, entering, turning, path_tolerance, max_alternations,
    max_iterations, kernel, kernel_tolerance, skip, save
);

#[pymethods]
impl Settings {
    #[new]
    #[pyo3(signature = (
        *, preset = None, tolerance = None, entering = None, turning = None, path_tolerance = None, max_alternations = None, max_iterations = None,
        kernel = None, kernel_tolerance = None, skip = None, save = None,
    ))]
    fn new(
        preset: Option<Preset>,
        tolerance: Option<f64>,
        entering: Option<bool>,
        turning: Option<bool>,
        path_tolerance: Option<f64>,
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
        solver.max_alternations = max_alternations.unwrap_or(solver.max_alternations);
        solver.max_iterations = max_iterations.unwrap_or(solver.max_iterations);
        settings.kernel.method = kernel.map_or(settings.kernel.method, Into::into);
        settings.kernel.tolerance = kernel_tolerance.unwrap_or(settings.kernel.tolerance);
        settings.skip = skip.map_or(settings.skip, |s| s.0);
        if let Some(save) = save {
            settings.save = save.into_core()?;
        }
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
