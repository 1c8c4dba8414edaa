//! u = C * q for people who build their own models.

use std::sync::{Mutex, PoisonError};

use contact_core::convolution::{self, Displacements, Tractions};
use ndarray::{Array3, ArrayViewMut2, Axis};
use numpy::PyArray3;

use crate::error::Answer;
use crate::prelude::*;
use crate::scene::{Body, Grid, Settings};

/// The displacements that tractions cause on a pair of bodies, u = C * q.
///
/// Parameters
/// ----------
/// body1, body2 : Body
///     The upper body and the lower one; their shapes do not matter.
/// grid : Grid
///     Cells on which tractions are constant.
/// settings : Settings, optional
///     Its kernel settings are used.
#[pyclass(frozen, module = "pyfret")]
pub(crate) struct SurfaceOperator {
    shape: (usize, usize),
    /// The upper body.
    #[pyo3(get)]
    body1: Body,
    /// The lower body.
    #[pyo3(get)]
    body2: Body,
    /// Cells on which tractions are constant.
    #[pyo3(get)]
    grid: Grid,
    /// Only the settings of the kernels are used.
    #[pyo3(get)]
    settings: Settings,
    inner: Mutex<Box<dyn convolution::SurfaceOperator>>,
}

made!(SurfaceOperator by "SurfaceOperator": body1, body2, grid, settings);

#[pymethods]
impl SurfaceOperator {
    #[new]
    #[pyo3(signature = (body1, body2, grid, *, settings = None))]
    fn new(
        py: Python<'_>,
        body1: Body,
        body2: Body,
        grid: Grid,
        settings: Option<Settings>,
    ) -> Answer<Self> {
        let settings_or_default = settings.unwrap_or_default();
        let bodies = (&body1.0, &body2.0);
        let operator = stoppable(py, |stop| {
            convolution::operator_of_bodies(bodies, &grid.0, &settings_or_default.0, stop)
        })??;
        Ok(Self {
            shape: (grid.0.nx, grid.0.ny),
            inner: Mutex::new(operator),
            body1,
            body2,
            grid,
            settings: settings_or_default,
        })
    }

    /// Relative displacement u(2) - u(1) [m], shape (3, nx, ny): along x, y and z.
    ///
    /// Parameters
    /// ----------
    /// p : array of shape (nx, ny), optional
    ///     Pressure [Pa] (default: none).
    /// q_x, q_y : array of shape (nx, ny), optional
    ///     Shear tractions on body 2 [Pa] (default: none).
    #[pyo3(signature = (p = None, q_x = None, q_y = None) -> "NDArray[np.float64]")]
    fn displacement<'py>(
        &self,
        py: Python<'py>,
        p: Option<Field<'py>>,
        q_x: Option<Field<'py>>,
        q_y: Option<Field<'py>>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let cells = |name: &str, field: Option<Field<'_>>| {
            field
                .map(|field| field.on_grid(name, &self.grid.0))
                .transpose()
        };
        let (p, q_x, q_y) = (cells("p", p)?, cells("q_x", q_x)?, cells("q_y", q_y)?);
        let mut u = Array3::zeros((3, self.shape.0, self.shape.1));
        interruptible(py, &Arc::default(), || {
            let mut parts = u
                .axis_iter_mut(Axis(0))
                .filter_map(ArrayViewMut2::into_slice);
            let displacements = Displacements {
                u_x: parts.next(),
                u_y: parts.next(),
                u_z: parts.next(),
            };
            let tractions = Tractions {
                q_x: q_x.as_deref(),
                q_y: q_y.as_deref(),
                p: p.as_deref(),
            };
            let mut operator = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
            operator.apply(tractions, displacements);
        })?;
        Ok(u.to_pyarray(py))
    }
}
