//! The load history.

use std::collections::BTreeMap;
use std::path::PathBuf;

use contact_core::Error;
use contact_core::scene::{self as core, Prescribed, RigidMotion};
use numpy::{PyArray1, ToPyArray};
use pyo3::prelude::*;

use super::branch::{Branch, Spacing};
use super::increments::{AnyIncrements, Count};
use crate::error::to_python;

/// The load history, from two bodies just touching.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct LoadPath(pub(crate) core::LoadPath);

/// One value or several to visit in turn.
#[derive(FromPyObject)]
enum Values {
    One(f64),
    Several(Vec<f64>),
}

impl Values {
    fn list(self) -> Vec<f64> {
        match self {
            Self::One(value) => vec![value],
            Self::Several(values) => values,
        }
    }
}

impl LoadPath {
    /// Appends a branch that goes to the loads and motions which `change` makes of the present ones.
    fn branch(
        &self,
        increments: Option<usize>,
        spacing: Spacing,
        t: Option<f64>,
        change: impl FnOnce(&mut core::Loads),
    ) -> Self {
        let (mut to, t_before) = self.0.last();
        change(&mut to);
        Self(self.0.clone().branch(core::Branch {
            spacing: spacing.into(),
            ..core::Branch::new(to, increments, t.unwrap_or(t_before + 1.0))
        }))
    }

    fn column<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&core::LoadPoint) -> f64,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.0.check_length().map_err(to_python)?;
        let column: Vec<f64> = self.0.points().iter().map(of).collect();
        Ok(column.to_pyarray(py))
    }
}

/// Prescribes what is given of the six motions or their loads.
fn prescribe(to: &mut core::Loads, given: [Option<Prescribed>; 6]) {
    for (of, given) in RigidMotion::ALL.into_iter().zip(given) {
        if let Some(prescribed) = given {
            to.prescribe(of, prescribed);
        }
    }
}

#[pymethods]
impl LoadPath {
    #[staticmethod]
    fn start() -> Self {
        Self(core::LoadPath::start())
    }

    #[pyo3(signature = (W, *, increments = Count(None)))]
    fn normal(&self, W: f64, increments: Count) -> Self {
        Self(self.0.clone().normal(W, increments.0))
    }

    #[pyo3(signature = (T_x, *, increments = Count(None)))]
    fn tangential(&self, T_x: Values, increments: Count) -> Self {
        Self(self.0.clone().tangential(&T_x.list(), increments.0))
    }

    #[pyo3(signature = (M_z, *, increments = Count(None)))]
    fn torsion(&self, M_z: Values, increments: Count) -> Self {
        Self(self.0.clone().torsion(&M_z.list(), increments.0))
    }

    #[pyo3(signature = (W, *, increments = Count(None)))]
    fn radial(&self, W: Values, increments: Count) -> Self {
        Self(self.0.clone().radial(&W.list(), increments.0))
    }

    #[pyo3(signature = (*, T_x, T_y, turns = 1, increments))]
    fn ellipse(&self, T_x: f64, T_y: f64, turns: usize, increments: usize) -> PyResult<Self> {
        core::LoadPath::check_turns(turns, increments).map_err(to_python)?;
        Ok(Self(self.0.clone().ellipse((T_x, T_y), turns, increments)))
    }

    #[pyo3(signature = (*, increments = AnyIncrements::Each(1), **columns))]
    fn waypoints(
        &self,
        increments: AnyIncrements,
        columns: Option<BTreeMap<String, Vec<f64>>>,
    ) -> PyResult<Self> {
        let columns = columns.unwrap_or_default();
        let rows = columns.values().map(Vec::len).max().unwrap_or(0);
        if let Some((name, column)) = columns.iter().find(|(_, c)| c.len() != rows) {
            let allowed = format!("{rows} values, as the longest column");
            let error = Error::invalid(name, format!("{} values", column.len()), allowed);
            return Err(to_python(error));
        }
        let names: Vec<&str> = columns.keys().map(String::as_str).collect();
        let row = |i: usize| columns.values().map(|column| column[i]).collect();
        let rows: Vec<Vec<f64>> = (0..rows).map(row).collect();
        let path = self.0.clone().waypoints(&names, &rows, increments.into());
        path.map(Self).map_err(to_python)
    }

    #[staticmethod]
    #[pyo3(signature = (path, *, increments = AnyIncrements::Each(1)))]
    fn from_csv(path: PathBuf, increments: AnyIncrements) -> PyResult<Self> {
        core::LoadPath::from_csv(&path, increments.into())
            .map(Self)
            .map_err(to_python)
    }

    #[pyo3(signature = (*, W = None, T_x = None, T_y = None, M_x = None, M_y = None, M_z = None, sigma_B = None, sigma_B1 = None, rolled = None, increments = Count(None), spacing = Spacing::Uniform, t = None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn force(
        &self,
        W: Option<f64>,
        T_x: Option<f64>,
        T_y: Option<f64>,
        M_x: Option<f64>,
        M_y: Option<f64>,
        M_z: Option<f64>,
        sigma_B: Option<f64>,
        sigma_B1: Option<f64>,
        rolled: Option<f64>,
        increments: Count,
        spacing: Spacing,
        t: Option<f64>,
    ) -> Self {
        let loads = [W, M_x, M_y, T_x, T_y, M_z].map(|load| load.map(Prescribed::Load));
        self.branch(increments.0, spacing, t, |to| {
            prescribe(to, loads);
            to.sigma_B = sigma_B.unwrap_or(to.sigma_B);
            to.sigma_B1 = sigma_B1.unwrap_or(to.sigma_B1);
            to.rolled = rolled.unwrap_or(to.rolled);
        })
    }

    #[pyo3(signature = (*, delta_z = None, delta_x = None, delta_y = None, phi_x = None, phi_y = None, phi_z = None, increments = Count(None), spacing = Spacing::Uniform, t = None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn displace(
        &self,
        delta_z: Option<f64>,
        delta_x: Option<f64>,
        delta_y: Option<f64>,
        phi_x: Option<f64>,
        phi_y: Option<f64>,
        phi_z: Option<f64>,
        increments: Count,
        spacing: Spacing,
        t: Option<f64>,
    ) -> Self {
        let motions = [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z];
        let motions = motions.map(|motion| motion.map(Prescribed::Motion));
        self.branch(increments.0, spacing, t, |to| prescribe(to, motions))
    }

    #[getter]
    fn branches(&self) -> Vec<Branch> {
        self.0.branches.iter().copied().map(Branch).collect()
    }

    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.t)
    }

    #[getter]
    fn W<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.W)
    }

    #[getter]
    fn T_x<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.T_x)
    }

    #[getter]
    fn T_y<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.T_y)
    }

    #[getter]
    fn sigma_B<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.sigma_B)
    }

    #[getter]
    fn sigma_B1<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.sigma_B1)
    }

    #[getter]
    fn rolled<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.rolled)
    }

    #[getter]
    fn M_z<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.column(py, |point| point.loads.M_z)
    }

    fn __len__(&self) -> PyResult<usize> {
        self.0.check_length().map_err(to_python)?;
        Ok(self.0.increments())
    }

    pub(crate) fn __repr__(&self) -> String {
        format!(
            "LoadPath({} branches, {} increments)",
            self.0.branches.len(),
            self.0.increments()
        )
    }
}
