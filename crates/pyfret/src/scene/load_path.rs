//! The load history.

use contact_core::scene as core;
use numpy::{PyArray1, ToPyArray};
use pyo3::prelude::*;

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

#[pymethods]
impl Branch {
    #[getter]
    fn W(&self) -> f64 {
        self.0.to.W
    }

    #[getter]
    fn T_x(&self) -> f64 {
        self.0.to.T_x
    }

    #[getter]
    fn T_y(&self) -> f64 {
        self.0.to.T_y
    }

    #[getter]
    fn increments(&self) -> usize {
        self.0.increments
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
        let core::Branch {
            to: core::Loads { W, T_x, T_y },
            increments,
            t_end,
            ..
        } = self.0;
        format!("Branch(W={W:?}, T_x={T_x:?}, T_y={T_y:?}, increments={increments}, t={t_end:?})")
    }
}

/// The load history, from two bodies just touching.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct LoadPath(pub(crate) core::LoadPath);

/// One force or several to visit in turn.
#[derive(FromPyObject)]
enum Values {
    One(f64),
    Several(Vec<f64>),
}

impl LoadPath {
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

    #[pyo3(signature = (W, *, increments))]
    fn normal(&self, W: f64, increments: usize) -> Self {
        Self(self.0.clone().normal(W, increments))
    }

    #[pyo3(signature = (T_x, *, increments))]
    fn tangential(&self, T_x: Values, increments: usize) -> Self {
        let T_x = match T_x {
            Values::One(T) => vec![T],
            Values::Several(T) => T,
        };
        Self(self.0.clone().tangential(&T_x, increments))
    }

    #[pyo3(signature = (*, W = None, T_x = None, T_y = None, increments, spacing = Spacing::Uniform, t = None))]
    fn force(
        &self,
        W: Option<f64>,
        T_x: Option<f64>,
        T_y: Option<f64>,
        increments: usize,
        spacing: Spacing,
        t: Option<f64>,
    ) -> Self {
        let (at, t_before) = self
            .0
            .branches
            .last()
            .map_or_else(Default::default, |b| (b.to, b.t_end));
        Self(self.0.clone().branch(core::Branch {
            to: core::Loads {
                W: W.unwrap_or(at.W),
                T_x: T_x.unwrap_or(at.T_x),
                T_y: T_y.unwrap_or(at.T_y),
            },
            increments,
            spacing: spacing.into(),
            t_end: t.unwrap_or(t_before + 1.0),
        }))
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
