//! Friction laws.

use contact_core::scene as core;
use pyo3::prelude::*;

use super::SurfaceMap;

/// What a cell has been through.
#[pyclass(frozen, eq, eq_int, hash, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum History {
    #[pyo3(name = "INCREMENT")]
    Increment,
    #[pyo3(name = "SLIP")]
    Slip,
    #[pyo3(name = "DISSIPATED")]
    Dissipated,
}

impl From<History> for core::History {
    fn from(history: History) -> Self {
        match history {
            History::Increment => Self::Increment,
            History::Slip => Self::Slip,
            History::Dissipated => Self::Dissipated,
        }
    }
}

impl From<core::History> for History {
    fn from(history: core::History) -> Self {
        match history {
            core::History::Increment => Self::Increment,
            core::History::Slip => Self::Slip,
            core::History::Dissipated => Self::Dissipated,
        }
    }
}

/// Coulomb's law with a coefficient that depends on direction, place and history.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Friction(pub(crate) core::Friction);

#[pymethods]
impl Friction {
    #[new]
    #[pyo3(signature = (mu, *, mu_y = None, kinetic = None, map = None, history = None))]
    fn new(
        mu: f64,
        mu_y: Option<f64>,
        kinetic: Option<f64>,
        map: Option<SurfaceMap>,
        history: Option<(History, Vec<(f64, f64)>)>,
    ) -> Self {
        Self(core::Friction {
            mu,
            mu_y,
            kinetic,
            map: map.map(|map| map.0),
            history: history.map(|(of, table)| core::FrictionHistory {
                of: of.into(),
                table,
            }),
        })
    }

    #[getter]
    fn mu(&self) -> f64 {
        self.0.mu
    }

    #[getter]
    fn mu_y(&self) -> Option<f64> {
        self.0.mu_y
    }

    #[getter]
    fn kinetic(&self) -> Option<f64> {
        self.0.kinetic
    }

    #[getter]
    fn map(&self) -> Option<SurfaceMap> {
        self.0.map.clone().map(SurfaceMap)
    }

    #[getter]
    fn history(&self) -> Option<(History, Vec<(f64, f64)>)> {
        let history = self.0.history.as_ref();
        history.map(|h| (h.of.into(), h.table.clone()))
    }

    pub(crate) fn __repr__(&self) -> String {
        let mut parts = vec![format!("{:?}", self.0.mu)];
        for (name, mu) in [("mu_y", self.0.mu_y), ("kinetic", self.0.kinetic)] {
            parts.extend(mu.map(|mu| format!("{name}={mu:?}")));
        }
        parts.extend(self.0.map.as_ref().map(|_| "map=...".to_owned()));
        parts.extend(self.0.history.as_ref().map(|_| "history=...".to_owned()));
        format!("Friction({})", parts.join(", "))
    }
}

/// A coefficient or a law.
#[derive(FromPyObject)]
pub(crate) enum AnyFriction {
    Law(Friction),
    Coefficient(f64),
}

impl From<AnyFriction> for core::Friction {
    fn from(friction: AnyFriction) -> Self {
        match friction {
            AnyFriction::Law(law) => law.0,
            AnyFriction::Coefficient(mu) => Self::coulomb(mu),
        }
    }
}
