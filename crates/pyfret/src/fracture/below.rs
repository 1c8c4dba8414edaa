//! Cracks below a contact.

use std::sync::{Mutex, PoisonError};

use ::fracture as of_cracks;
use contact_assess::crack as core;
use contact_core::scene::ResidualStress;
use contact_subsurface as subsurface;
use ndarray::Array2;

use super::names::{named, set_path};
use crate::error::Answer;
use crate::prelude::*;
use crate::residual_stress::{Profiles, of_body};
use crate::scene::Body;
use crate::states::States;

/// K over (state, length) as a dict of arrays.
fn tables<'py>(py: Python<'py>, found: &[core::OverCycle]) -> PyResult<Bound<'py, PyDict>> {
    let states = found.first().map_or(0, |over| over.faces.len());
    let table = |f: &dyn Fn(&core::OverCycle, usize) -> f64| {
        Array2::from_shape_fn((states, found.len()), |(n, l)| f(&found[l], n)).into_pyarray(py)
    };
    let result = PyDict::new(py);
    result.set_item("K_I", table(&|c, n| c.faces[n].K_I))?;
    result.set_item("K_II", table(&|c, n| c.faces[n].K_II))?;
    result.set_item("K_I_linear", table(&|c, n| c.linear[n].K_I))?;
    result.set_item("K_II_linear", table(&|c, n| c.linear[n].K_II))?;
    result.set_item("error", table(&|c, n| c.faces[n].error))?;
    result.set_item("open", table(&|c, n| c.open[n]))?;
    Ok(result)
}

/// A contact in several of its states, prepared for cracks; use :meth:`pyfret.Result.crack`.
///
/// Cracks at several places share the stress that the first one needs.
#[pyclass(frozen, module = "pyfret._core")]
pub(crate) struct ContactForCracks {
    body: Body,
    side: subsurface::Side,
    states: Py<States>,
    residual: ResidualStress,
    prepared: Mutex<Option<Arc<core::Prepared>>>,
}

impl ContactForCracks {
    /// Calls `f` with the prepared contact; it is prepared again if an interrupt had ended its computation.
    fn with_prepared<T: Send>(
        &self,
        py: Python<'_>,
        f: impl FnOnce(&core::Prepared) -> Result<T, contact_core::Error> + Send,
    ) -> Answer<T> {
        let states = self.states.get();
        let answer = stoppable(py, |stop| {
            let mut kept = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
            let usable = kept.as_ref().filter(|prepared| prepared.is_usable());
            let prepared = if let Some(prepared) = usable {
                prepared.clone()
            } else {
                let (grid, moments) = states.parts();
                moments.with_states(Some(&self.residual), stop, |states| {
                    let body = &self.body.0;
                    let prepared = core::Prepared::new(body, self.side, grid, &states);
                    Ok(Arc::new(prepared))
                })?
            };
            *kept = Some(prepared.clone());
            drop(kept);
            f(&prepared)
        })??;
        Ok(answer)
    }
}

#[pymethods]
impl ContactForCracks {
    #[new]
    #[pyo3(signature = (body, states, *, residual = None, body_number: "int" = 2))]
    fn new(
        body: Body,
        states: Py<States>,
        residual: Profiles,
        #[pyo3(from_py_with = number)] body_number: u8,
    ) -> PyResult<Self> {
        Ok(Self {
            side: side(body_number)?,
            residual: of_body(&body.0, residual)?,
            body,
            states,
            prepared: Mutex::default(),
        })
    }

    /// Return K of cracks.
    ///
    /// The mouth may be off by `mouth_error` [m]: the change of K by it is part of the error of K.
    #[pyo3(signature = (*, x: "float", lengths: "Sequence[float]", angle: "Angle" = 0.0, kink: "tuple[float, float] | None" = None, azimuth: "Angle" = 0.0, offset: "float" = 0.0, friction: "float" = 0.0, mouth_error: "float | None" = None) -> "dict[str, NDArray[np.float64]]")]
    fn intensity<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] x: f64,
        lengths: List<f64>,
        #[pyo3(from_py_with = Given::angle)] angle: f64,
        #[pyo3(from_py_with = number)] kink: Option<(f64, f64)>,
        #[pyo3(from_py_with = Given::azimuth)] azimuth: f64,
        #[pyo3(from_py_with = number)] offset: f64,
        #[pyo3(from_py_with = number)] friction: f64,
        #[pyo3(from_py_with = number)] mouth_error: Option<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let cracks = core::Cracks {
            x,
            angle,
            kink,
            azimuth,
            offset,
            lengths: lengths.0,
            friction,
        };
        let over = self.with_prepared(py, |contact| {
            core::over_cycle(contact, &cracks, mouth_error)
        })?;
        tables(py, &over)
    }

    /// Return the number of the place with the largest range of K_I of straight cracks.
    ///
    /// Places are x, azimuth and offset of the plane.
    #[pyo3(signature = (places: "Sequence[tuple[float, float, float]]", *, lengths: "Sequence[float]", angle: "Angle" = 0.0, friction: "float" = 0.0))]
    fn widest_range(
        &self,
        py: Python<'_>,
        places: List<(f64, f64, f64)>,
        lengths: List<f64>,
        #[pyo3(from_py_with = Given::angle)] angle: f64,
        #[pyo3(from_py_with = number)] friction: f64,
    ) -> Answer<usize> {
        let at = |(x, azimuth, offset): &(f64, f64, f64)| core::Cracks {
            x: *x,
            angle,
            kink: None,
            azimuth: *azimuth,
            offset: *offset,
            lengths: lengths.to_vec(),
            friction,
        };
        let cracks: Vec<_> = places.iter().map(at).collect();
        self.with_prepared(py, |contact| core::widest_range(contact, &cracks))
    }

    /// Return K of a crack that grows.
    #[pyo3(signature = (*, x: "float", start: "float", end: "float", direction, tolerance: "float", angle: "Angle" = 0.0, azimuth: "Angle" = 0.0, offset: "float" = 0.0, friction: "float" = 0.0) -> "dict[str, Any]")]
    fn growth<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] x: f64,
        #[pyo3(from_py_with = number)] start: f64,
        #[pyo3(from_py_with = number)] end: f64,
        direction: &str,
        #[pyo3(from_py_with = number)] tolerance: f64,
        #[pyo3(from_py_with = Given::angle)] angle: f64,
        #[pyo3(from_py_with = Given::azimuth)] azimuth: f64,
        #[pyo3(from_py_with = number)] offset: f64,
        #[pyo3(from_py_with = number)] friction: f64,
    ) -> Answer<Bound<'py, PyDict>> {
        let growth = core::Growth {
            x,
            angle,
            azimuth,
            offset,
            start,
            growing: of_cracks::Growing {
                direction: core::direction_named(direction)?,
                to: end,
                friction,
                tolerance,
            },
        };
        let growth = self.with_prepared(py, |contact| core::grown(contact, &growth))?;
        let result = tables(py, &growth.over)?;
        set_path(py, &result, &growth.tips)?;
        result.set_item("path_error", growth.error)?;
        result.set_item("end", named(growth.end))?;
        Ok(result)
    }
}
