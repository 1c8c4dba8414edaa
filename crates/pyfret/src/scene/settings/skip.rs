//! What may be left out.

use contact_core::scene as core;
use pyo3::prelude::*;

use crate::parts::{parts, shown_by_parts};

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
#[pyclass(frozen, eq, from_py_object, module = "pyfret.settings")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Skip(pub(super) core::SkipSettings);

parts!(Skip: equal_layers, coupling, mirror, digits, far, path);
shown_by_parts!(Skip);

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
