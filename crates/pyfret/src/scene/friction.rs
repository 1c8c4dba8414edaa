//! Friction laws.

use contact_core::scene as core;
use pyo3::{PyTypeInfo, type_hint_union};

use super::SurfaceMap;
use super::friction_law::{function, own_law};
use crate::error::{Answer, to_python};
use crate::hints;
use crate::parts::members;
use crate::prelude::*;

members!(
    /// History of a cell.
    ///
    /// ``INCREMENT``: increments done, the same for all cells. ``SLIP``: length of the way that the
    /// cell has slipped [m]. ``DISSIPATED``: energy dissipated per area [J/m^2]. ``CYCLES``: cycles of
    /// wear done; a path that is run through once has done none. Over jumps of wear each is summed over
    /// all cycles so far.
    History: Increment = "INCREMENT", Slip = "SLIP", Dissipated = "DISSIPATED", Cycles = "CYCLES"
);

/// Coulomb's law with a coefficient that depends on direction, place and history.
///
/// The coefficient of an increment follows from the history at its end, extrapolated from the last
/// increment.
///
/// Parameters
/// ----------
/// mu : float
///     Coefficient, >= 0; ``float("inf")`` for a contact that never slips.
/// mu_y : float, optional
///     Coefficient along y, mu being that along x: the bound is an ellipse.
/// kinetic : float, optional
///     Coefficient, along x, of cells that slipped in the increment before.
/// map : SurfaceMap, optional
///     Factor of the coefficient over the surface.
/// history : (History, list of pairs), optional
///     Factor of the coefficient, linear between the pairs (history, factor).
/// layers : sequence of float, optional
///     Coefficient of each layer that wear exposes, in place of `mu`: the coatings of the coated
///     body from the outermost on, then its substrate. Before wear the first one holds.
/// starved : float, optional
///     Coefficient where no oxygen arrives; see :class:`pyfret.wear.Air`. The aerated share s of a
///     cell gives starved + (mu - starved) s.
/// bed : (float, float), optional
///     Coefficient mu_bed of a thick bed of debris, and the thickness h_ref [m] of the bed; see
///     :class:`pyfret.wear.DebrisBed`. The bed h gives mu_bed + (mu - mu_bed) exp(-h/h_ref).
/// law : callable, optional
///     A function of five arrays with a number for each cell. These are places `x`, `y` [m],
///     pressure `p` [Pa], length of the way slipped `slip` [m] and energy per area `dissipated`
///     [J/m^2]. It gives the coefficient along x of each cell, finite and >= 0, as an array of the
///     same shape or one number. `mu` is about the size of it: the measure of tolerances, and the
///     coefficient of cells without pressure so far. An increment is solved again until the
///     coefficient follows from pressure and history at its end. What the function raises is raised
///     as it is. It also gets arrays of `worn1`, `worn2` (worn depths [m]), `layer1`, `layer2` (the
///     exposed layer, from 0), `bed` (debris per area [m]) and `aerated` (share with oxygen) that
///     its signature names. No other law beside it; over cycles of wear slip and
///     energy are sums over all cycles so far. A store keeps that there is a law, not which:
///     ``pyfret.resume(store, friction_law=...)``.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Friction(pub(crate) core::Friction);

parts!(Friction: mu, mu_y, kinetic, map, history, layers, starved, bed, law);

#[pymethods]
impl Friction {
    #[new]
    #[pyo3(signature = (mu: "float | None" = None, *, mu_y: "float | None" = None, kinetic: "float | None" = None, map = None, history: "tuple[History, Sequence[tuple[float, float]]] | None" = None, layers: "Sequence[float] | None" = None, starved: "float | None" = None, bed: "tuple[float, float] | None" = None, law: "FrictionFunction | Literal['own'] | None" = None))]
    fn new(
        #[pyo3(from_py_with = number)] mu: Option<f64>,
        #[pyo3(from_py_with = number)] mu_y: Option<f64>,
        #[pyo3(from_py_with = number)] kinetic: Option<f64>,
        map: Option<SurfaceMap>,
        history: Option<(History, List<(f64, f64)>)>,
        layers: Option<List<f64>>,
        #[pyo3(from_py_with = number)] starved: Option<f64>,
        bed: Option<(f64, f64)>,
        law: Option<&Bound<'_, PyAny>>,
    ) -> Answer<Self> {
        let layers = layers.map(|layers| layers.0);
        if layers.as_ref().is_some_and(Vec::is_empty) {
            refuse!("layers = []: must have a coefficient for each layer of the coated body");
        }
        let first = layers.as_ref().and_then(|layers| layers.first().copied());
        let Some(mu) = mu.or(first) else {
            let missing =
                "mu is missing: it must be a coefficient, or layers a list of coefficients";
            return Err(pyo3::exceptions::PyTypeError::new_err(missing).into());
        };
        let law = core::Friction {
            mu,
            mu_y,
            kinetic,
            map: map.map(|map| map.0),
            history: history.map(|(of, table)| core::FrictionHistory {
                of: of.into(),
                table: table.0,
            }),
            layers: layers.unwrap_or_default(),
            starved,
            bed: bed.map(|(mu, thickness)| core::BedFriction { mu, thickness }),
            law: law.map(own_law).transpose()?,
        };
        law.check(None)?;
        Ok(Self(law))
    }

    /// Factor as a function of the history.
    #[getter]
    fn history(&self) -> Option<(History, Vec<(f64, f64)>)> {
        let history = self.0.history.as_ref();
        history.map(|h| (h.of.into(), h.table.clone()))
    }

    /// The law in words: names with their values, and facts without a value.
    fn words(&self) -> Vec<(&'static str, Option<f64>)> {
        self.0.describe()
    }

    pub(crate) fn __repr__(&self) -> String {
        let mut parts = vec![format!("{:?}", self.0.mu)];
        let coefficients = self.0.coefficients();
        parts.extend(coefficients.map(|(name, mu)| format!("{name}={mu:?}")));
        parts.extend(self.0.map.as_ref().map(|_| "map=...".to_owned()));
        parts.extend(self.0.history.as_ref().map(|_| "history=...".to_owned()));
        if !self.0.layers.is_empty() {
            parts.push(format!("layers={:?}", self.0.layers));
        }
        let bed = self.0.bed.as_ref();
        parts.extend(bed.map(|bed| format!("bed=({:?}, {:?})", bed.mu, bed.thickness)));
        parts.extend(self.0.law.as_ref().map(|_| "law=...".to_owned()));
        format!("Friction({})", parts.join(", "))
    }
}

attributes!(Friction, self, py:
    /// The function that gives the coefficient; ``"own"`` if only that there is one is known.
    law: Option<Bound<'py, PyAny>> = self.0.law.as_ref().map(|law| function(py, law));
);

attributes!(Friction, self:
    /// Coefficient.
    mu: f64 = self.0.mu;
    /// Whether it is the same everywhere and at all times, if not in all directions.
    is_constant: bool = self.0.depends_only_on(&[core::Dependence::Direction]);
    /// Coefficient along y, if it is another.
    mu_y: Option<f64> = self.0.mu_y;
    /// Coefficient of cells that slipped in the increment before.
    kinetic: Option<f64> = self.0.kinetic;
    /// Coefficient of each layer that wear exposes.
    layers: Option<Vec<f64>> = Some(&self.0.layers).filter(|layers| !layers.is_empty()).cloned();
    /// Coefficient where no oxygen arrives.
    starved: Option<f64> = self.0.starved;
    /// Coefficient of a thick bed of debris, and the thickness of the bed [m].
    bed: Option<(f64, f64)> = self.0.bed.map(|bed| (bed.mu, bed.thickness));
    /// Factor over the surface.
    map: Option<SurfaceMap> = self.0.map.clone().map(SurfaceMap);
);

/// A coefficient, a law, or `"stick"`, as in scene files.
pub(crate) struct AnyFriction(pub(crate) core::Friction);

impl<'py> FromPyObject<'_, 'py> for AnyFriction {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr =
        type_hint_union!(Friction::TYPE_HINT, hints::FLOAT, hints::word!("stick"));

    /// Takes a coefficient, a law, or the word "stick".
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(law) = value.extract::<Friction>() {
            return Ok(Self(law.0));
        }
        let sticks = value.extract::<&str>().is_ok_and(|word| word == "stick");
        let mu = if sticks {
            f64::INFINITY
        } else if let Ok(mu) = number(&value) {
            mu
        } else {
            let allowed = "a coefficient, such as 0.3, a law, such as Friction(0.3, kinetic=0.25) or Friction(0.3, law=function), or \"stick\" \
                          for no slip";
            return Err(must_be(&value, allowed));
        };
        let law = core::Friction::coulomb(mu);
        law.check(None).map_err(to_python)?;
        Ok(Self(law))
    }
}
