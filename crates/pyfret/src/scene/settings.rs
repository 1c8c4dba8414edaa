//! How a scene is solved.

use contact_core::Error;
use contact_core::scene as core;
use pyo3::prelude::*;

use crate::error::to_python;

/// Families of algorithms.
#[pyclass(frozen, eq, eq_int, hash, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Preset {
    #[pyo3(name = "FAST")]
    Fast,
    #[pyo3(name = "SPINU2020")]
    Spinu2020,
}

/// Conversion by Hankel integrals, exact to round-off.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Hankel;

#[pymethods]
impl Hankel {
    #[new]
    fn new() -> Self {
        Self
    }
}

/// The paper's conversion, eq. (9)-(13).
#[pyclass(frozen, eq, get_all, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct InverseFft {
    enlargement: usize,
    aliases: usize,
}

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

/// No coefficients: convolution with the frequency response on an enlarged domain.
#[pyclass(frozen, eq, get_all, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct FrequencyDomain {
    enlargement: usize,
}

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

/// What may be left out when the scene does not need it.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Skip(core::SkipSettings);

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

    #[getter]
    fn equal_layers(&self) -> bool {
        self.0.equal_layers
    }

    #[getter]
    fn coupling(&self) -> bool {
        self.0.coupling
    }

    #[getter]
    fn mirror(&self) -> bool {
        self.0.mirror
    }

    #[getter]
    fn digits(&self) -> bool {
        self.0.digits
    }

    #[getter]
    fn far(&self) -> bool {
        self.0.far
    }

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

/// All settings of the solution.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Default, PartialEq)]
pub(crate) struct Settings(pub(crate) core::Settings);

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

    #[getter]
    fn preset(&self) -> Preset {
        match self.0.solver.preset {
            core::Preset::Fast => Preset::Fast,
            core::Preset::Spinu2020 => Preset::Spinu2020,
        }
    }

    #[getter]
    fn tolerance(&self) -> Option<f64> {
        self.0.solver.tolerance
    }

    #[getter]
    fn entering(&self) -> bool {
        self.0.solver.entering
    }

    #[getter]
    fn turning(&self) -> bool {
        self.0.solver.turning
    }

    #[getter]
    fn path_tolerance(&self) -> f64 {
        self.0.solver.path_tolerance
    }

    #[getter]
    fn max_alternations(&self) -> usize {
        self.0.solver.max_alternations
    }

    #[getter]
    fn max_iterations(&self) -> usize {
        self.0.solver.max_iterations
    }

    #[getter]
    fn kernel(&self) -> Method {
        self.0.kernel.method.into()
    }

    #[getter]
    fn kernel_tolerance(&self) -> f64 {
        self.0.kernel.tolerance
    }

    #[getter]
    fn save(&self) -> Save {
        (&self.0.save).into()
    }

    #[getter]
    fn skip(&self) -> Skip {
        Skip(self.0.skip)
    }
}
