//! The mesh of the contact plane.

use contact_core::scene as core;
use numpy::{PyArray1, ToPyArray};
use pyo3::prelude::*;

use crate::error::to_python;

/// Rectangular cells around the initial point of contact.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Grid(pub(crate) core::Grid);

#[pymethods]
impl Grid {
    #[staticmethod]
    #[pyo3(signature = (*, extent, n))]
    fn centred(extent: f64, n: usize) -> PyResult<Self> {
        core::Grid::centred(extent, n).map(Self).map_err(to_python)
    }

    #[staticmethod]
    fn from_spacing(n: (usize, usize), spacing: (f64, f64)) -> PyResult<Self> {
        core::Grid::from_spacing(n, spacing)
            .map(Self)
            .map_err(to_python)
    }

    #[staticmethod]
    #[pyo3(signature = (*, extent, n, width = 1.0))]
    fn strip(extent: f64, n: usize, width: f64) -> PyResult<Self> {
        core::Grid::strip(extent, n, width)
            .map(Self)
            .map_err(to_python)
    }

    #[getter]
    fn plane_strain(&self) -> bool {
        self.0.plane_strain
    }

    #[getter]
    fn nx(&self) -> usize {
        self.0.nx
    }

    #[getter]
    fn ny(&self) -> usize {
        self.0.ny
    }

    #[getter]
    fn dx(&self) -> f64 {
        self.0.dx
    }

    #[getter]
    fn dy(&self) -> f64 {
        self.0.dy
    }

    #[getter]
    fn cell_area(&self) -> f64 {
        self.0.cell_area()
    }

    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let x: Vec<f64> = (0..self.0.nx).map(|i| self.0.x(i)).collect();
        x.to_pyarray(py)
    }

    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let y: Vec<f64> = (0..self.0.ny).map(|j| self.0.y(j)).collect();
        y.to_pyarray(py)
    }

    pub(crate) fn __repr__(&self) -> String {
        let core::Grid {
            nx,
            ny,
            dx,
            dy,
            plane_strain,
        } = self.0;
        if plane_strain {
            let extent = self.0.extent().0;
            return format!("Grid.strip(extent={extent:?}, n={nx}, width={dy:?})");
        }
        format!("Grid.from_spacing(({nx}, {ny}), ({dx:?}, {dy:?}))")
    }
}
