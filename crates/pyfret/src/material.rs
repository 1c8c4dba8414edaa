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
///     Poisson's ratio, -1 < nu <= 0.5.
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

/// How a layer is bonded to what lies below it: springs that give way under the traction there.
///
/// The upper side moves against the lower one by compliance times traction, in tension as in
/// pressure.
///
/// Parameters
/// ----------
/// normal, shear : float
///     Approach per pressure and slip per shear traction [m/Pa], 0 (default) or more; a large shear
///     compliance is a frictionless interface.
///
/// Examples
/// --------
/// >>> glue = Elastic(E=3e9, nu=0.4)
/// >>> Bond.of_layer(glue, thickness=0.0).normal
/// 0.0
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Bond(pub(crate) core::Bond);

parts!(Bond: normal, shear);
takes!(Bond, "a bond, such as Bond(normal=1e-17, shear=1e-16)");

#[pymethods]
impl Bond {
    #[new]
    #[pyo3(signature = (*, normal = 0.0, shear = 0.0))]
    fn new(normal: f64, shear: f64) -> PyResult<Self> {
        let bond = core::Bond { normal, shear };
        bond.check("bond").map_err(to_python)?;
        Ok(Self(bond))
    }

    /// The bond that a thin layer of a material makes: h (1 - 2 nu)/(2 G (1 - nu)) and h/G.
    #[staticmethod]
    #[pyo3(signature = (material, *, thickness))]
    fn of_layer(material: Elastic, thickness: f64) -> PyResult<Self> {
        let bond = core::Bond::of_layer(material.0, thickness);
        bond.check("bond").map_err(to_python)?;
        Ok(Self(bond))
    }

    /// Approach per pressure [m/Pa].
    #[getter]
    fn normal(&self) -> f64 {
        self.0.normal
    }

    /// Slip per shear traction [m/Pa].
    #[getter]
    fn shear(&self) -> f64 {
        self.0.shear
    }

    pub(crate) fn __repr__(&self) -> String {
        format!("Bond(normal={:?}, shear={:?})", self.0.normal, self.0.shear)
    }
}

/// A layer of constant thickness on what is below it.
///
/// Parameters
/// ----------
/// material : Elastic
///     Material of the layer.
/// thickness : float
///     Thickness [m], positive.
/// bond : Bond
///     Bond to what is below it (default: perfect).
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Coating(pub(crate) core::Coating, pub(crate) core::Bond);

impl Coating {
    /// A layer that is perfectly bonded.
    pub(crate) fn perfect(coating: core::Coating) -> Self {
        Self(coating, core::Bond::PERFECT)
    }
}

parts!(Coating: material, thickness, bond);
takes!(
    Coating,
    "a coating, such as Coating(Elastic(E=300e9, nu=0.25), thickness=3e-6)"
);

#[pymethods]
impl Coating {
    #[new]
    #[pyo3(signature = (material, *, thickness, bond = Bond(core::Bond::PERFECT)))]
    fn new(material: Elastic, thickness: f64, bond: Bond) -> PyResult<Self> {
        let coating = core::Coating {
            material: material.0,
            thickness,
        };
        coating.check("coating").map_err(to_python)?;
        Ok(Self(coating, bond.0))
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

    /// Bond to what is below it.
    #[getter]
    fn bond(&self) -> Bond {
        Bond(self.1)
    }

    pub(crate) fn __repr__(&self) -> String {
        let bond = if self.1 == core::Bond::PERFECT {
            String::new()
        } else {
            format!(", bond={}", self.bond().__repr__())
        };
        format!(
            "Coating({}, thickness={:?}{bond})",
            self.material().__repr__(),
            self.0.thickness
        )
    }
}
