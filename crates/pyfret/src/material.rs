//! Elastic materials, alone and as layers.

use contact_core::scene as core;
use contact_core::scene::BACK_STRESSES;
use pyo3::exceptions::PyValueError;
use pyo3::inspect::{PyStaticConstant, PyStaticExpr};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use pyo3::{PyTypeInfo, type_hint_union};

use crate::arguments::{List, number};
use crate::error::{must_be, takes, to_python};
use crate::parts::parts;
use crate::quantity::{Given, known, si};
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

/// A material of a closed form: of a body, that of its substrate.
#[derive(Clone, Copy)]
pub(crate) struct Material(pub(crate) core::Elastic);

impl<'py> FromPyObject<'_, 'py> for Material {
    type Error = PyErr;

    // By its name: the class stands above this file.
    const INPUT_TYPE: PyStaticExpr = type_hint_union!(
        Elastic::TYPE_HINT,
        PyStaticExpr::Constant {
            value: PyStaticConstant::Str("Body")
        }
    );

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
    pub(crate) const RIGID: Self = Self(core::Elastic::RIGID, None);
}

#[pymethods]
impl Elastic {
    #[new]
    #[pyo3(
        signature = (*, E: "float", nu: "float", plastic = None, **unknown),
        text_signature = "(*, E, nu, plastic=None)"
    )]
    fn new(
        #[pyo3(from_py_with = Given::E)] E: f64,
        #[pyo3(from_py_with = number)] nu: f64,
        plastic: Option<Plastic>,
        unknown: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        known("Elastic", unknown, &["E", "nu", "plastic"])?;
        if (Self(core::Elastic { E, nu }, None)) == Self::RIGID && plastic.is_none() {
            return Ok(Self::RIGID);
        }
        let material = core::Elastic::new(E, nu).map_err(to_python)?;
        Ok(Self(material, plastic.map(|law| law.0)))
    }

    /// How it yields; None where it stays elastic.
    #[getter]
    fn plastic(&self) -> Option<Plastic> {
        self.1.map(Plastic)
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
            let law = self.plastic();
            let law = law.map_or_else(String::new, |law| format!(", plastic={}", law.__repr__()));
            format!("Elastic(E={:?}, nu={:?}{law})", self.0.E, self.0.nu)
        }
    }
}

/// Yielding after von Mises, with isotropic and kinematic hardening.
///
/// The yield stress is the sum of what is given, with p the equivalent plastic strain::
///
///     R(p) = s_y + hardening p + voce_Q (1 - exp(-voce_b p)) + s_y ((1 + p/swift_e_0)^swift_n - 1)
///
/// The back stress is 2/3 kinematic e_p (Prager) and the sum of up to three terms with recall
/// (Chaboche)::
///
///     dX_i = 2/3 C_i de_p - gamma_i X_i dp
///
/// Parameters
/// ----------
/// s_y : float
///     Yield stress [Pa], positive.
/// hardening : float
///     Growth of the yield stress per equivalent plastic strain [Pa], 0 or more (default 0).
/// voce_Q, voce_b : float
///     Growth of the yield stress at which it saturates [Pa], and rate (default 0, none).
/// swift_e_0, swift_n : float
///     Strain and exponent of a power law (default 0, none).
/// kinematic : float
///     Linear kinematic hardening [Pa], 0 or more (default 0).
/// chaboche_C, chaboche_gamma : float or sequence of float
///     Moduli [Pa] and rates of recall of up to three back stresses (default none).
///
/// Examples
/// --------
/// >>> Elastic(E=210e9, nu=0.3, plastic=Plastic(s_y=900e6, hardening=5e9)).plastic.s_y
/// 900000000.0
/// >>> Plastic(s_y="250 MPa", chaboche_C=[60e9, 5e9], chaboche_gamma=[400, 20]).chaboche_C
/// [60000000000.0, 5000000000.0]
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Plastic(pub(crate) core::Plastic);

parts!(
    Plastic: s_y, hardening, voce_Q, voce_b, swift_e_0, swift_n, kinematic, chaboche_C,
    chaboche_gamma
);
takes!(
    Plastic,
    "a law of yielding, such as Plastic(s_y=900e6, hardening=5e9)"
);

/// The arguments of a law of yielding.
const PLASTIC: [&str; 9] = [
    "s_y",
    "hardening",
    "voce_Q",
    "voce_b",
    "swift_e_0",
    "swift_n",
    "kinematic",
    "chaboche_C",
    "chaboche_gamma",
];

/// Numbers of the back stresses: one, or one for each.
fn of_back_stresses(
    name: &str,
    value: Option<&Bound<'_, PyAny>>,
) -> PyResult<[f64; BACK_STRESSES]> {
    let mut values = [0.0; BACK_STRESSES];
    let Some(value) = value else {
        return Ok(values);
    };
    if value.is_instance_of::<PyString>() || value.hasattr("magnitude")? || value.len().is_err() {
        values[0] = si(name, value)?;
        return Ok(values);
    }
    let given = value.extract::<List<Bound<'_, PyAny>>>()?;
    if given.len() > BACK_STRESSES {
        let message = format!(
            "{name} = {} numbers: must be at most {BACK_STRESSES}",
            given.len()
        );
        return Err(PyValueError::new_err(message));
    }
    for (into, one) in values.iter_mut().zip(given) {
        *into = si(name, &one)?;
    }
    Ok(values)
}

#[pymethods]
impl Plastic {
    #[new]
    #[pyo3(
        signature = (*, s_y: "float", hardening: "float" = 0.0, voce_Q: "float" = 0.0, voce_b: "float" = 0.0, swift_e_0: "float" = 0.0, swift_n: "float" = 0.0, kinematic: "float" = 0.0, chaboche_C: "float | Sequence[float] | None" = None, chaboche_gamma: "float | Sequence[float] | None" = None, **unknown),
        text_signature = "(*, s_y, hardening=0.0, voce_Q=0.0, voce_b=0.0, swift_e_0=0.0, swift_n=0.0, kinematic=0.0, chaboche_C=None, chaboche_gamma=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        #[pyo3(from_py_with = Given::s_y)] s_y: f64,
        #[pyo3(from_py_with = Given::hardening)] hardening: f64,
        #[pyo3(from_py_with = Given::voce_Q)] voce_Q: f64,
        #[pyo3(from_py_with = number)] voce_b: f64,
        #[pyo3(from_py_with = number)] swift_e_0: f64,
        #[pyo3(from_py_with = number)] swift_n: f64,
        #[pyo3(from_py_with = Given::kinematic)] kinematic: f64,
        chaboche_C: Option<&Bound<'_, PyAny>>,
        chaboche_gamma: Option<&Bound<'_, PyAny>>,
        unknown: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        known("Plastic", unknown, &PLASTIC)?;
        let law = core::Plastic {
            s_y,
            hardening,
            voce_Q,
            voce_b,
            swift_e_0,
            swift_n,
            kinematic,
            chaboche_C: of_back_stresses("chaboche_C", chaboche_C)?,
            chaboche_gamma: of_back_stresses("chaboche_gamma", chaboche_gamma)?,
        };
        core::check_plastic(&law, "plastic").map_err(to_python)?;
        Ok(Self(law))
    }

    /// Yield stress [Pa].
    #[getter]
    fn s_y(&self) -> f64 {
        self.0.s_y
    }

    /// Linear isotropic hardening [Pa].
    #[getter]
    fn hardening(&self) -> f64 {
        self.0.hardening
    }

    /// Growth of the yield stress at which Voce's hardening saturates [Pa].
    #[getter]
    fn voce_Q(&self) -> f64 {
        self.0.voce_Q
    }

    /// Rate of Voce's hardening.
    #[getter]
    fn voce_b(&self) -> f64 {
        self.0.voce_b
    }

    /// Strain of Swift's hardening.
    #[getter]
    fn swift_e_0(&self) -> f64 {
        self.0.swift_e_0
    }

    /// Exponent of Swift's hardening.
    #[getter]
    fn swift_n(&self) -> f64 {
        self.0.swift_n
    }

    /// Linear kinematic hardening [Pa].
    #[getter]
    fn kinematic(&self) -> f64 {
        self.0.kinematic
    }

    /// Moduli of the back stresses with recall [Pa].
    #[getter]
    fn chaboche_C(&self) -> Vec<f64> {
        self.0.chaboche_C[..self.back_stresses()].to_vec()
    }

    /// Their rates of recall.
    #[getter]
    fn chaboche_gamma(&self) -> Vec<f64> {
        self.0.chaboche_gamma[..self.back_stresses()].to_vec()
    }

    pub(crate) fn __repr__(&self) -> String {
        let core::Plastic {
            s_y,
            hardening,
            kinematic,
            ..
        } = self.0;
        let mut parts = vec![
            format!("s_y={s_y:?}"),
            format!("hardening={hardening:?}"),
            format!("kinematic={kinematic:?}"),
        ];
        for (name, value) in [
            ("voce_Q", self.0.voce_Q),
            ("voce_b", self.0.voce_b),
            ("swift_e_0", self.0.swift_e_0),
            ("swift_n", self.0.swift_n),
        ] {
            if value != 0.0 {
                parts.push(format!("{name}={value:?}"));
            }
        }
        if self.back_stresses() > 0 {
            parts.push(format!("chaboche_C={:?}", self.chaboche_C()));
            parts.push(format!("chaboche_gamma={:?}", self.chaboche_gamma()));
        }
        format!("Plastic({})", parts.join(", "))
    }
}

impl Plastic {
    /// How many back stresses with recall there are.
    fn back_stresses(&self) -> usize {
        let last = self.0.chaboche_C.iter().rposition(|C| *C > 0.0);
        last.map_or(0, |n| n + 1)
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
    #[pyo3(signature = (*, normal: "float" = 0.0, shear: "float" = 0.0))]
    fn new(
        #[pyo3(from_py_with = number)] normal: f64,
        #[pyo3(from_py_with = number)] shear: f64,
    ) -> PyResult<Self> {
        let bond = core::Bond { normal, shear };
        bond.check("bond").map_err(to_python)?;
        Ok(Self(bond))
    }

    /// The bond that a thin layer of a material makes: h (1 - 2 nu)/(2 G (1 - nu)) and h/G.
    #[staticmethod]
    #[pyo3(signature = (material, *, thickness: "float"))]
    fn of_layer(
        material: Elastic,
        #[pyo3(from_py_with = number)] thickness: f64,
    ) -> PyResult<Self> {
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
/// residual : float or array_like, optional
///     Residual stress of the layer [Pa], as :class:`Body` takes that of its substrate.
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
    #[pyo3(
        signature = (material, *, thickness: "float", bond = Bond(core::Bond::PERFECT), residual = None, **unknown),
        text_signature = "(material, *, thickness, bond=..., residual=None)"
    )]
    fn new(
        material: Elastic,
        #[pyo3(from_py_with = Given::thickness)] thickness: f64,
        bond: Bond,
        residual: Option<Profile>,
        unknown: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        known(
            "Coating",
            unknown,
            &["material", "thickness", "bond", "residual"],
        )?;
        let coating = core::Coating {
            material: material.0,
            thickness,
        };
        coating.check("coating").map_err(to_python)?;
        let residual = residual.unwrap_or_default().0;
        residual.check("coating.residual").map_err(to_python)?;
        Ok(Self {
            layer: coating,
            bond: bond.0,
            plastic: material.1,
            residual,
        })
    }

    /// Material of the layer.
    #[getter]
    fn material(&self) -> Elastic {
        Elastic(self.layer.material, self.plastic)
    }

    /// Thickness [m].
    #[getter]
    fn thickness(&self) -> f64 {
        self.layer.thickness
    }

    /// Bond to what is below it.
    #[getter]
    fn bond(&self) -> Bond {
        Bond(self.bond)
    }

    /// Residual stress [Pa], or its table; None where it has none.
    #[getter]
    fn residual(&self) -> Option<Shown> {
        shown(&self.residual)
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
