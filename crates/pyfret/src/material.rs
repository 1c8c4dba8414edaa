//! Elastic materials, alone and as layers.

use contact_core::scene as core;
use pyo3::prelude::*;

use crate::error::{must_be, takes, to_python};
use crate::parts::parts;

/// A homogeneous isotropic elastic material.
///
/// Parameters
/// ----------
/// E : float
///     Young's modulus [Pa], positive; infinite, with nu = 0, for :data:`RIGID`.
/// nu : float
///     Poisson's ratio, -1 < nu < 0.5.
///
/// Examples
/// --------
/// >>> steel = Elastic(E=210e9, nu=0.3)
/// >>> round(steel.G / 1e9, 2)
/// 80.77
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Elastic(pub(crate) core::Elastic);

parts!(Elastic: E, nu);
takes!(Elastic, "a material, such as Elastic(E=210e9, nu=0.3)");

/// A material of a closed form: of a body, that of its substrate.
#[derive(Clone, Copy)]
pub(crate) struct Material(pub(crate) core::Elastic);

impl<'py> FromPyObject<'_, 'py> for Material {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(material) = value.extract::<Elastic>() {
            return Ok(Self(material.0));
        }
        let wanted =
            "a material, such as Elastic(E=210e9, nu=0.3), or a Body, whose substrate is taken";
        let substrate = value
            .getattr("substrate")
            .and_then(|of| of.extract::<Elastic>());
        substrate
            .map(|of| Self(of.0))
            .map_err(|_| must_be(&value, wanted))
    }
}

impl Elastic {
    pub(crate) const RIGID: Self = Self(core::Elastic::RIGID);
}

#[pymethods]
impl Elastic {
    #[new]
    #[pyo3(signature = (*, E, nu))]
    fn new(E: f64, nu: f64) -> PyResult<Self> {
        if (Self(core::Elastic { E, nu })) == Self::RIGID {
            return Ok(Self::RIGID);
        }
        core::Elastic::new(E, nu).map(Self).map_err(to_python)
    }

    /// Young's modulus [Pa]; infinite for :data:`RIGID`.
    #[getter]
    fn E(&self) -> f64 {
        self.0.E
    }

    /// Poisson's ratio.
    #[getter]
    fn nu(&self) -> f64 {
        self.0.nu
    }

    /// Shear modulus E / (2 (1 + nu)) [Pa].
    #[getter]
    fn G(&self) -> f64 {
        self.0.G()
    }

    pub(crate) fn __repr__(&self) -> String {
        if self.0.is_rigid() {
            "RIGID".into()
        } else {
            format!("Elastic(E={:?}, nu={:?})", self.0.E, self.0.nu)
        }
    }
}

/// A layer of constant thickness, perfectly bonded to what is below it.
///
/// Parameters
/// ----------
/// material : Elastic
///     Material of the layer.
/// thickness : float
///     Thickness [m], positive.
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Coating(pub(crate) core::Coating);

parts!(Coating: material, thickness);
takes!(
    Coating,
    "a coating, such as Coating(Elastic(E=300e9, nu=0.25), thickness=3e-6)"
);

#[pymethods]
impl Coating {
    #[new]
    #[pyo3(signature = (material, *, thickness))]
    fn new(material: Elastic, thickness: f64) -> PyResult<Self> {
        let coating = core::Coating {
            material: material.0,
            thickness,
        };
        coating.check("coating").map_err(to_python)?;
        Ok(Self(coating))
    }

    /// Material of the layer.
    #[getter]
    fn material(&self) -> Elastic {
        Elastic(self.0.material)
    }

    /// Thickness [m].
    #[getter]
    fn thickness(&self) -> f64 {
        self.0.thickness
    }

    pub(crate) fn __repr__(&self) -> String {
        format!(
            "Coating({}, thickness={:?})",
            self.material().__repr__(),
            self.0.thickness
        )
    }
}
