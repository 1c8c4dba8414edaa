//! The response of a body to tractions on its surface.

use contact_core::kernels as core;
use contact_core::kernels::{Complex64, Stack};
use ndarray::{Array2, Array3, ArrayView2, Ix1};
use numpy::{PyArray1, PyArray2, PyArray3, PyArray4, PyReadonlyArray3};

use crate::argument::Answer;
use crate::prelude::*;
use crate::scene::{Body, Grid, Settings};

/// Surface response at one-dimensional arrays of wave numbers; see :mod:`pyfret.kernels`.
#[pyfunction]
#[pyo3(signature = (body, k_x, k_y) -> "NDArray[np.complex128]")]
pub(crate) fn surface_frf<'py>(
    py: Python<'py>,
    body: Body,
    k_x: Array<'py, Ix1>,
    k_y: Array<'py, Ix1>,
) -> Answer<Bound<'py, PyArray3<Complex64>>> {
    let stack = Stack::from_checked_body(&body.0)?;
    let mut frf = Array3::zeros((k_x.len()?, 3, 3));
    let waves = k_x.as_array().into_iter().zip(k_y.as_array());
    for (n, (&k_x, &k_y)) in waves.enumerate() {
        let matrix = stack.surface_frf(k_x, k_y)?;
        for (i, row) in matrix.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                frf[(n, i, j)] = entry;
            }
        }
    }
    Ok(frf.into_pyarray(py))
}

/// Surface displacement under unit traction on one cell, C_ij [m/Pa].
///
/// Parameters
/// ----------
/// body : Body
///     Homogeneous or coated, taken as the lower body.
/// grid : Grid
///     The cells; only their number and size matter.
/// settings : Settings, optional
///     Its kernel settings are used.
///
/// Returns
/// -------
/// array of shape (3, 3, 2 nx - 1, 2 ny - 1)
///     u_x, u_y, u_z under q_x, q_y, p at all offsets of the observed cell from the loaded one. The
///     offset (0, 0) is in the middle.
#[pyfunction]
#[pyo3(signature = (body, grid, *, settings = None) -> "NDArray[np.float64]")]
pub(crate) fn influence_coefficients(
    py: Python<'_>,
    body: Body,
    grid: Grid,
    settings: Option<Settings>,
) -> Answer<Bound<'_, PyArray4<f64>>> {
    let settings = settings.unwrap_or_default().0;
    let shortcut = settings.skip.equal_layers;
    let matrix = stoppable(py, |stop| {
        core::influence_coefficients(&body.0, &grid.0, &settings.kernel, shortcut, Some(stop))
            .map(|coefficients| coefficients.matrix())
    })??;
    Ok(matrix.into_pyarray(py))
}

/// Stress at the depth `z` [m] under unit traction on one cell, tension positive.
///
/// Parameters
/// ----------
/// body : Body
///     Homogeneous or coated, taken as the lower body.
/// grid : Grid
///     The cells; only their number and size matter.
/// z : float
///     Depth [m].
/// layer : int, optional
///     Layer from the surface down (their number for the substrate); it decides at an interface,
///     where stresses jump (default: the upper one).
///
/// Returns
/// -------
/// array of shape (6, 3, 2 nx - 1, 2 ny - 1)
///     s_xx, s_yy, s_zz, s_xy, s_xz, s_yz under q_x, q_y, p at all offsets; the offset (0, 0) is in
///     the middle.
#[pyfunction]
#[pyo3(signature = (body, grid, z: "float", *, layer: "int | None" = None) -> "NDArray[np.float64]")]
pub(crate) fn stress_coefficients(
    py: Python<'_>,
    body: Body,
    grid: Grid,
    #[pyo3(from_py_with = number)] z: f64,
    #[pyo3(from_py_with = number)] layer: Option<usize>,
) -> Answer<Bound<'_, PyArray4<f64>>> {
    let matrix = stoppable(py, |stop| {
        core::stress_coefficients(&body.0, &grid.0, z, layer, Some(stop))
            .map(|coefficients| coefficients.matrix())
    })??;
    Ok(matrix.into_pyarray(py))
}

/// Stress at a point under unit traction on the cell of sides `cell` [m] around the origin.
///
/// Returns
/// -------
/// array of shape (6, 3)
///     s_xx, s_yy, s_zz, s_xy, s_xz, s_yz under q_x, q_y, p; tension is positive.
#[pyfunction]
#[pyo3(signature = (body, cell: "tuple[float, float]", point: "tuple[float, float, float]", *, layer: "int | None" = None) -> "NDArray[np.float64]")]
pub(crate) fn stress_at(
    py: Python<'_>,
    body: Body,
    #[pyo3(from_py_with = number)] cell: (f64, f64),
    #[pyo3(from_py_with = number)] point: (f64, f64, f64),
    #[pyo3(from_py_with = number)] layer: Option<usize>,
) -> Answer<Bound<'_, PyArray2<f64>>> {
    let at = || core::stress_of_cell_at(&body.0, cell, point, layer);
    let stress = interruptible(py, &Arc::default(), at)??;
    Ok(Array2::from_shape_fn((6, 3), |(i, j)| stress[i][j]).into_pyarray(py))
}

/// The paper's conversion, planned; see :func:`pyfret.kernels.convert`.
#[pyclass(frozen, module = "pyfret.kernels")]
pub(crate) struct Conversion(core::Conversion);

#[pymethods]
impl Conversion {
    #[new]
    #[pyo3(signature = (grid, *, enlargement: "int" = 8, aliases: "int" = 0))]
    fn new(
        grid: Grid,
        #[pyo3(from_py_with = number)] enlargement: usize,
        #[pyo3(from_py_with = number)] aliases: usize,
    ) -> Answer<Self> {
        Ok(Self(core::Conversion::new(&grid.0, enlargement, aliases)?))
    }

    /// Wave numbers k_x, k_y [1/m] at which the response is needed, never both zero.
    #[pyo3(signature = () -> "tuple[NDArray[np.float64], NDArray[np.float64]]")]
    fn wave_vectors<'py>(
        &self,
        py: Python<'py>,
    ) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let (k_x, k_y): (Vec<f64>, Vec<f64>) = self.0.wave_vectors().unzip();
        (k_x.into_pyarray(py), k_y.into_pyarray(py))
    }

    /// Influence coefficients from the response at the wave vectors, shape (n, 3, 3).
    #[pyo3(signature = (frf: "NDArray[np.complex128]") -> "NDArray[np.float64]")]
    fn convert<'py>(
        &self,
        py: Python<'py>,
        frf: PyReadonlyArray3<'py, Complex64>,
    ) -> PyResult<Bound<'py, PyArray4<f64>>> {
        let frf = frf.as_array();
        let expected = (self.0.wave_vectors().len(), 3, 3);
        if frf.dim() != expected {
            refuse!(
                "the response has the shape {:?}: must be {expected:?}, one matrix per wave vector",
                frf.dim()
            );
        }
        let matrix = |m: ArrayView2<'_, Complex64>| [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)]));
        let samples: Vec<_> = frf.outer_iter().map(matrix).collect();
        let converted = interruptible(py, &Arc::default(), || self.0.convert(&samples))?;
        Ok(converted.into_pyarray(py))
    }
}
