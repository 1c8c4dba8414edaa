//! The load path, one increment at a time.

use std::sync::{Mutex, PoisonError};

use contact_core::march as core;
use numpy::ToPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::to_python;
use crate::scene::Scene;

/// A load path being run through; iterating solves one increment after the other.
#[pyclass(module = "pyfret")]
pub(crate) struct March {
    /// Python may hand the object to another thread.
    inner: Mutex<core::March>,
}

impl March {
    fn inner(&mut self) -> &mut core::March {
        self.inner.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl March {
    #[new]
    fn new(py: Python<'_>, scene: Scene) -> PyResult<Self> {
        let march = py
            .detach(|| core::March::new(&scene.0))
            .map_err(to_python)?;
        Ok(Self {
            inner: Mutex::new(march),
        })
    }

    #[getter]
    fn done(&mut self) -> usize {
        self.inner().state().increments
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __next__<'py>(&mut self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        py.check_signals()?;
        let march = self.inner();
        match py.detach(|| march.advance()) {
            None => Ok(None),
            Some(Err(error)) => Err(to_python(error)),
            Some(Ok(increment)) => scalars(py, &increment).map(Some),
        }
    }

    fn fields<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let f = self.inner().fields();
        let fields = PyDict::new(py);
        for (name, field) in [
            ("p", &f.p),
            ("q_x", &f.q_x),
            ("q_y", &f.q_y),
            ("u_x", &f.u_x),
            ("u_y", &f.u_y),
            ("u_z", &f.u_z),
            ("gap", &f.gap),
            ("slip_x", &f.slip_x),
            ("slip_y", &f.slip_y),
            ("dissipated_density", &f.dissipated),
        ] {
            fields.set_item(name, field.to_pyarray(py))?;
        }
        for (name, mask) in [("contact", &f.contact), ("stick", &f.stick)] {
            fields.set_item(name, mask.to_pyarray(py))?;
        }
        Ok(fields)
    }
}

/// The scalars of an increment under the names of the result store.
fn scalars<'py>(py: Python<'py>, increment: &core::Increment) -> PyResult<Bound<'py, PyDict>> {
    let core::Increment {
        point,
        motion,
        energy,
        residuals,
        work,
        ..
    } = increment;
    let scalars = PyDict::new(py);
    for (name, value) in [
        ("t", point.t),
        ("W", point.loads.W),
        ("T_x", point.loads.T_x),
        ("T_y", point.loads.T_y),
        ("delta_z", motion.delta_z),
        ("delta_x", motion.delta_x),
        ("delta_y", motion.delta_y),
        ("contact_area", increment.contact_area),
        ("stick_area", increment.stick_area),
        ("stick_ratio", increment.stick_ratio()),
        ("contact_radius", increment.contact_radius()),
        ("p_max", increment.p_max),
        ("q_max", increment.q_max),
        ("work", energy.work),
        ("elastic", energy.elastic),
        ("dissipated", energy.dissipated),
        ("opening", energy.opening),
        ("residual_gap", residuals.gap),
        ("residual_penetration", residuals.penetration),
        ("residual_coulomb", residuals.coulomb),
        ("residual_stick", residuals.stick),
        ("residual_direction", residuals.direction),
        ("residual_balance", residuals.balance),
        ("residual_energy", residuals.energy),
        ("convolutions", work.convolutions),
    ] {
        scalars.set_item(name, value)?;
    }
    for (name, count) in [
        ("increment", increment.index),
        ("branch_of_increment", point.branch),
        ("alternations", work.alternations),
        ("normal_iterations", work.normal_iterations),
        ("tangential_iterations", work.tangential_iterations),
    ] {
        scalars.set_item(name, count)?;
    }
    Ok(scalars)
}
