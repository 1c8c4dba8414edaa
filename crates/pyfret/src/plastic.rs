//! How materials yield.

use contact_core::scene as core;
use contact_core::scene::BACK_STRESSES;
use pyo3::types::PyString;

use crate::error::Answer;
use crate::prelude::*;
use crate::quantity::si;

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

/// Reads a number for each back stress: one number, or a list. `name` names it in errors.
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
    let numbers = value.extract::<List<Bound<'_, PyAny>>>()?;
    if numbers.len() > BACK_STRESSES {
        refuse!(
            "{name} = {} numbers: must be at most {BACK_STRESSES}",
            numbers.len()
        );
    }
    for (into, one) in values.iter_mut().zip(numbers) {
        *into = si(name, &one)?;
    }
    Ok(values)
}

#[pymethods]
impl Plastic {
    #[new]
    #[pyo3(signature = (*, s_y: "YieldStress", hardening: "YieldStress" = 0.0, voce_Q: "YieldStress" = 0.0, voce_b: "float" = 0.0, swift_e_0: "float" = 0.0, swift_n: "float" = 0.0, kinematic: "YieldStress" = 0.0, chaboche_C: "Quantities | None" = None, chaboche_gamma: "Quantities | None" = None))]
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
    ) -> Answer<Self> {
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
        core::check_plastic_law(&law, "plastic")?;
        Ok(Self(law))
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

attributes!(Plastic, self:
    /// Yield stress [Pa].
    s_y: f64 = self.0.s_y;
    /// Linear isotropic hardening [Pa].
    hardening: f64 = self.0.hardening;
    /// Growth of the yield stress at which Voce's hardening saturates [Pa].
    voce_Q: f64 = self.0.voce_Q;
    /// Rate of Voce's hardening.
    voce_b: f64 = self.0.voce_b;
    /// Strain of Swift's hardening.
    swift_e_0: f64 = self.0.swift_e_0;
    /// Exponent of Swift's hardening.
    swift_n: f64 = self.0.swift_n;
    /// Linear kinematic hardening [Pa].
    kinematic: f64 = self.0.kinematic;
    /// Moduli of the back stresses with recall [Pa].
    chaboche_C: Vec<f64> = self.0.chaboche_C[..self.back_stresses()].to_vec();
    /// Their rates of recall.
    chaboche_gamma: Vec<f64> = self.0.chaboche_gamma[..self.back_stresses()].to_vec();
);

impl Plastic {
    /// How many back stresses with recall there are.
    fn back_stresses(&self) -> usize {
        let last = self.0.chaboche_C.iter().rposition(|C| *C > 0.0);
        last.map_or(0, |n| n + 1)
    }
}
