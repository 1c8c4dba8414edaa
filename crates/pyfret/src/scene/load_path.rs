//! The load history.

use std::collections::BTreeMap;
use std::path::PathBuf;

use contact_core::Error;
use contact_core::scene as core;
use numpy::{PyArray1, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::to_python;

/// How the increments of a branch are spaced.
#[pyclass(frozen, eq, eq_int, hash, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Spacing {
    #[pyo3(name = "UNIFORM")]
    Uniform,
    #[pyo3(name = "EQUAL_RADIUS")]
    EqualRadius,
}

impl From<Spacing> for core::Spacing {
    fn from(spacing: Spacing) -> Self {
        match spacing {
            Spacing::Uniform => Self::Uniform,
            Spacing::EqualRadius => Self::EqualRadius,
        }
    }
}

impl From<core::Spacing> for Spacing {
    fn from(spacing: core::Spacing) -> Self {
        match spacing {
            core::Spacing::Uniform => Self::Uniform,
            core::Spacing::EqualRadius => Self::EqualRadius,
        }
    }
}

/// One straight piece of the load history.
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Branch(core::Branch);

impl Branch {
    /// A load, `None` where the motion is given instead.
    fn load(&self, k: usize) -> Option<f64> {
        let free = self.0.to.given.motions()[k].is_none();
        free.then(|| self.0.to.forces()[k])
    }
}

#[pymethods]
impl Branch {
    #[getter]
    fn W(&self) -> Option<f64> {
        self.load(0)
    }

    #[getter]
    fn M_x(&self) -> Option<f64> {
        self.load(1)
    }

    #[getter]
    fn M_y(&self) -> Option<f64> {
        self.load(2)
    }

    #[getter]
    fn T_x(&self) -> Option<f64> {
        self.load(3)
    }

    #[getter]
    fn T_y(&self) -> Option<f64> {
        self.load(4)
    }

    #[getter]
    fn M_z(&self) -> Option<f64> {
        self.load(5)
    }

    #[getter]
    fn delta_z(&self) -> Option<f64> {
        self.0.to.given.delta_z
    }

    #[getter]
    fn delta_x(&self) -> Option<f64> {
        self.0.to.given.delta_x
    }

    #[getter]
    fn delta_y(&self) -> Option<f64> {
        self.0.to.given.delta_y
    }

    #[getter]
    fn phi_x(&self) -> Option<f64> {
        self.0.to.given.phi_x
    }

    #[getter]
    fn phi_y(&self) -> Option<f64> {
        self.0.to.given.phi_y
    }

    #[getter]
    fn phi_z(&self) -> Option<f64> {
        self.0.to.given.phi_z
    }

    #[getter]
    fn sigma_B(&self) -> f64 {
        self.0.to.sigma_B
    }

    #[getter]
    fn sigma_B1(&self) -> f64 {
        self.0.to.sigma_B1
    }

    #[getter]
    fn rolled(&self) -> f64 {
        self.0.to.rolled
    }

    #[getter]
    fn increments(&self) -> Option<usize> {
        self.0.increments
    }

    #[getter]
    fn path_error(&self) -> Option<f64> {
        self.0.path_error
    }

    #[getter]
    fn spacing(&self) -> Spacing {
        self.0.spacing.into()
    }

    #[getter]
    fn t(&self) -> f64 {
        self.0.t_end
    }

    fn __repr__(&self) -> String {
        let given = self.0.to.given.motions();
        let parts = (0..6).filter_map(|k| match (self.load(k), given[k]) {
            (Some(load), _) if load != 0.0 || k == 0 => {
                Some(format!("{}={load:?}", core::LOADS[k]))
            }
            (None, Some(motion)) if motion != 0.0 || k % 3 == 0 => {
                Some(format!("{}={motion:?}", core::MOTIONS[k]))
            }
            _ => None,
        });
        format!(
            "Branch({}, increments={}, t={:?})",
            parts.collect::<Vec<_>>().join(", "),
            self.0
                .increments
                .map_or_else(|| "\"auto\"".to_owned(), |n| n.to_string()),
            self.0.t_end
        )
    }
}

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

/// As many increments as the change needs if the whole range takes this many.
#[pyclass(frozen, eq, hash, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct PerRange(usize);

#[pymethods]
impl PerRange {
    #[new]
    fn new(increments: usize) -> Self {
        Self(increments)
    }

    #[getter]
    fn increments(&self) -> usize {
        self.0
    }

    fn __repr__(&self) -> String {
        format!("PerRange({})", self.0)
    }
}

/// Increments of a branch: a number, or "auto" for as many as the path tolerance asks for.
struct Count(Option<usize>);

impl<'py> FromPyObject<'_, 'py> for Count {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if value.extract::<&str>().is_ok_and(|word| word == "auto") {
            return Ok(Self(None));
        }
        let wrong = |_| PyValueError::new_err("increments: a whole number >= 1, or \"auto\"");
        value.extract().map(|n| Self(Some(n))).map_err(wrong)
    }
}

/// Increments between two waypoints.
#[derive(FromPyObject)]
enum AnyIncrements {
    Each(usize),
    PerRange(PerRange),
}

impl From<AnyIncrements> for core::Increments {
    fn from(increments: AnyIncrements) -> Self {
        match increments {
            AnyIncrements::Each(n) => Self::Each(n),
            AnyIncrements::PerRange(PerRange(n)) => Self::PerRange(n),
        }
    }
}

impl LoadPath {
    /// Appends a branch; `change` makes of each load and given motion the new ones.
    fn branch(
        &self,
        increments: Option<usize>,
        spacing: Spacing,
        t: Option<f64>,
        change: impl Fn(usize, f64, Option<f64>) -> (f64, Option<f64>),
    ) -> Self {
        let (at, t_before) = self
            .0
            .branches
            .last()
            .map_or_else(Default::default, |b| (b.to, b.t_end));
        let (mut forces, mut motions) = (at.forces(), at.given.motions());
        for k in 0..6 {
            (forces[k], motions[k]) = change(k, forces[k], motions[k]);
        }
        Self(self.0.clone().branch(core::Branch {
            to: at.with_forces(forces, core::Given::from_motions(motions)),
            increments,
            spacing: spacing.into(),
            t_end: t.unwrap_or(t_before + 1.0),
            path_error: None,
        }))
    }

    fn column<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&core::LoadPoint) -> f64,
    ) -> Bound<'py, PyArray1<f64>> {
        let column: Vec<f64> = self.0.points().iter().map(of).collect();
        column.to_pyarray(py)
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
    fn ellipse(&self, T_x: f64, T_y: f64, turns: usize, increments: usize) -> Self {
        Self(self.0.clone().ellipse((T_x, T_y), turns, increments))
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
        let named = [W, M_x, M_y, T_x, T_y, M_z];
        let mut path = self.branch(increments.0, spacing, t, |k, load, motion| match named[k] {
            Some(load) => (load, None),
            None => (load, motion),
        });
        if let Some(branch) = path.0.branches.last_mut() {
            branch.to.sigma_B = sigma_B.unwrap_or(branch.to.sigma_B);
            branch.to.sigma_B1 = sigma_B1.unwrap_or(branch.to.sigma_B1);
            branch.to.rolled = rolled.unwrap_or(branch.to.rolled);
        }
        path
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
        let named = [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z];
        self.branch(increments.0, spacing, t, |k, load, motion| match named[k] {
            Some(motion) => (0.0, Some(motion)),
            None => (load, motion),
        })
    }

    #[getter]
    fn branches(&self) -> Vec<Branch> {
        self.0.branches.iter().copied().map(Branch).collect()
    }

    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.t)
    }

    #[getter]
    fn W<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.W)
    }

    #[getter]
    fn T_x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.T_x)
    }

    #[getter]
    fn T_y<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.T_y)
    }

    #[getter]
    fn sigma_B<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.sigma_B)
    }

    #[getter]
    fn sigma_B1<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.sigma_B1)
    }

    #[getter]
    fn rolled<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.rolled)
    }

    #[getter]
    fn M_z<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |point| point.loads.M_z)
    }

    fn __len__(&self) -> usize {
        self.0.increments()
    }

    pub(crate) fn __repr__(&self) -> String {
        format!(
            "LoadPath({} branches, {} increments)",
            self.0.branches.len(),
            self.0.increments()
        )
    }
}
