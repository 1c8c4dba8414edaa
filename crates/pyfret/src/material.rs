//! Elastic materials, alone and as layers.

use contact_core::scene as core;
use pyo3::inspect::PyStaticConstant;
use pyo3::{PyTypeInfo, type_hint_union};

use crate::error::Answer;
use crate::plastic::Plastic;
use crate::prelude::*;
use crate::residual_stress::{Profile, Shown, shown, text};

/// A homogeneous isotropic elastic material.
///
/// Parameters
/// ----------
/// E : float
///     Young's modulus [Pa], positive; infinite, with nu = 0, for :data:`RIGID`.
/// nu : float
///     Poisson's ratio, -1 < nu <= 0.5.
/// plastic : Plastic, optional
///     How it yields (default: it stays elastic).
///
/// Examples
/// --------
/// >>> steel = Elastic(E=210e9, nu=0.3)
/// >>> round(steel.G / 1e9, 2)
/// 80.77
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Elastic(pub(crate) core::Elastic, pub(crate) Option<core::Plastic>);

parts!(Elastic: E, nu, plastic);
takes!(Elastic, "a material, such as Elastic(E=210e9, nu=0.3)");

/// A material of a closed form: of a body, its substrate, and the curvature xx, xy, yy of its surface
/// \[1/m\].
#[derive(Clone, Copy)]
pub(crate) struct Material(pub(crate) core::Elastic, pub(crate) [f64; 3]);

impl Material {
    /// A material alone, whose body has no shape.
    pub(crate) fn without_shape(material: core::Elastic) -> Self {
        Self(material, [0.0; 3])
    }
}

impl<'py> FromPyObject<'_, 'py> for Material {
    type Error = PyErr;

    // By its name: the class stands above this file.
    const INPUT_TYPE: PyStaticExpr = type_hint_union!(
        Elastic::TYPE_HINT,
        PyStaticExpr::Constant {
            value: PyStaticConstant::Str("Body")
        }
    );

    /// Takes a material, or the substrate of a body.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(material) = value.extract::<Elastic>() {
            return Ok(Self::without_shape(material.0));
        }
        let allowed =
            "a material, such as Elastic(E=210e9, nu=0.3), or a Body, whose substrate is taken";
        let read = |name: &str| value.getattr(name);
        let substrate = read("substrate").and_then(|of| of.extract::<Elastic>());
        let curvature = read("_curvature").and_then(|of| of.extract());
        substrate
            .and_then(|material| Ok(Self(material.0, curvature?)))
            .map_err(|_| must_be(&value, allowed))
    }
}

impl Elastic {
    pub(crate) const RIGID: Self = Self(core::Elastic::RIGID, None);
}

#[pymethods]
impl Elastic {
    #[new]
    #[pyo3(signature = (*, E: "Modulus", nu: "float", plastic = None))]
    fn new(
        #[pyo3(from_py_with = Given::E)] E: f64,
        #[pyo3(from_py_with = number)] nu: f64,
        plastic: Option<Plastic>,
    ) -> Answer<Self> {
        if (Self(core::Elastic { E, nu }, None)) == Self::RIGID && plastic.is_none() {
            return Ok(Self::RIGID);
        }
        let material = core::Elastic::new(E, nu)?;
        Ok(Self(material, plastic.map(|law| law.0)))
    }

    pub(crate) fn __repr__(&self) -> String {
        if self.0.is_rigid() {
            "RIGID".into()
        } else {
            let law = self.plastic();
            let law = law.map_or_else(String::new, |law| format!(", plastic={}", law.__repr__()));
            format!("Elastic(E={:?}, nu={:?}{law})", self.0.E, self.0.nu)
        }
    }
}

attributes!(Elastic, self:
    /// How it yields; None where it stays elastic.
    plastic: Option<Plastic> = self.1.map(Plastic);
    /// Young's modulus [Pa]; infinite for :data:`RIGID`.
    E: f64 = self.0.E;
    /// Poisson's ratio.
    nu: f64 = self.0.nu;
    /// Shear modulus E / (2 (1 + nu)) [Pa].
    G: f64 = self.0.G();
);

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
    #[pyo3(signature = (*, normal: "NormalCompliance" = 0.0, shear: "ShearCompliance" = 0.0))]
    fn new(
        #[pyo3(from_py_with = Given::bond_normal)] normal: f64,
        #[pyo3(from_py_with = Given::bond_shear)] shear: f64,
    ) -> Answer<Self> {
        let bond = core::Bond { normal, shear };
        bond.check("bond")?;
        Ok(Self(bond))
    }

    /// The bond that a thin layer of a material makes: h (1 - 2 nu)/(2 G (1 - nu)) and h/G.
    #[staticmethod]
    #[pyo3(signature = (material, *, thickness: "Thickness"))]
    fn of_layer(
        material: Elastic,
        #[pyo3(from_py_with = Given::thickness)] thickness: f64,
    ) -> Answer<Self> {
        let bond = core::Bond::of_layer(material.0, thickness);
        bond.check("bond")?;
        Ok(Self(bond))
    }

    pub(crate) fn __repr__(&self) -> String {
        format!("Bond(normal={:?}, shear={:?})", self.0.normal, self.0.shear)
    }
}

attributes!(Bond, self:
    /// Approach per pressure [m/Pa].
    normal: f64 = self.0.normal;
    /// Slip per shear traction [m/Pa].
    shear: f64 = self.0.shear;
);

/// A layer of constant thickness on what is below it.
///
/// Parameters
/// ----------
/// material : Elastic, Material or str
///     Material of the layer: also a row of the table, or its name, such as ``"TiN"``.
/// thickness : float
///     Thickness [m], positive.
/// bond : Bond
///     Bond to what is below it (default: perfect).
/// residual : float or array_like, optional
///     Residual stress of the layer [Pa], as :class:`Body` takes the stress of its substrate.
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Coating {
    pub(crate) layer: core::Coating,
    pub(crate) bond: core::Bond,
    pub(crate) plastic: Option<core::Plastic>,
    pub(crate) residual: core::Profile,
}

impl Coating {
    /// A layer that is perfectly bonded.
    pub(crate) fn perfect(layer: core::Coating) -> Self {
        Self {
            layer,
            bond: core::Bond::PERFECT,
            plastic: None,
            residual: core::Profile::default(),
        }
    }
}

parts!(Coating: material, thickness, bond, residual);
takes!(
    Coating,
    "a coating, such as Coating(Elastic(E=300e9, nu=0.25), thickness=3e-6)"
);

#[pymethods]
impl Coating {
    #[new]
    #[pyo3(signature = (material: "Elastic | Material | str", *, thickness: "Thickness", bond = Bond(core::Bond::PERFECT), residual = None))]
    fn new(
        material: Elastic,
        #[pyo3(from_py_with = Given::thickness)] thickness: f64,
        bond: Bond,
        residual: Option<Profile>,
    ) -> Answer<Self> {
        let coating = core::Coating {
            material: material.0,
            thickness,
        };
        coating.check("coating")?;
        let residual = residual.unwrap_or_default().0;
        residual.check("coating.residual")?;
        Ok(Self {
            layer: coating,
            bond: bond.0,
            plastic: material.1,
            residual,
        })
    }

    pub(crate) fn __repr__(&self) -> String {
        let bond = if self.bond == core::Bond::PERFECT {
            String::new()
        } else {
            format!(", bond={}", self.bond().__repr__())
        };
        let residual = if self.residual.rows.is_empty() {
            String::new()
        } else {
            format!(", residual={}", text(&self.residual))
        };
        format!(
            "Coating({}, thickness={:?}{bond}{residual})",
            self.material().__repr__(),
            self.layer.thickness
        )
    }
}

attributes!(Coating, self:
    /// Material of the layer.
    material: Elastic = Elastic(self.layer.material, self.plastic);
    /// Thickness [m].
    thickness: f64 = self.layer.thickness;
    /// Bond to what is below it.
    bond: Bond = Bond(self.bond);
    /// Residual stress [Pa], or its table; None where it has none.
    residual: Option<Shown> = shown(&self.residual);
);
