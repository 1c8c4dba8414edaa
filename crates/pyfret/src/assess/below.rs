//! A section below a contact, and what is told of its points.

use std::sync::Arc;

use contact_assess::{self as core, Judged, Site};
use contact_core::Error;
use contact_core::scene::{self, ResidualStress};
use contact_subsurface::{Depth, Line, Side, Zone};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::given::Given;
use crate::argument::to_python;
use crate::interruptible::interruptible;

/// A section of a body over a cycle.
pub(super) struct Below {
    pub(super) body: scene::Body,
    pub(super) grid: scene::Grid,
    pub(super) side: Side,
    pub(super) line: Line,
    pub(super) residual: ResidualStress,
    pub(super) given: Given,
}

impl Below {
    /// Does `work` at the site while signals are heard; without residual stress if the judge has it.
    pub(super) fn at<T: Send>(
        &self,
        py: Python<'_>,
        residual: bool,
        work: impl FnOnce(&Site<'_>) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let (stop, none) = (Arc::default(), ResidualStress::default());
        let found = interruptible(py, &stop, || {
            work(&Site {
                body: &self.body,
                side: self.side,
                grid: &self.grid,
                residual: if residual { &self.residual } else { &none },
                cycle: &self.given,
                stop: stop.clone(),
            })
        })?;
        let raised = self.given.taken();
        raised.map_or_else(|| found.map_err(to_python), Err)
    }
}

/// Place and errors of a worst point.
pub(super) fn place<'py, F>(
    py: Python<'py>,
    worst: &core::Worst<F>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    let (depth, error) = (worst.extreme.depth, worst.extreme.error);
    found.set_item("score", worst.extreme.value)?;
    for (name, value) in [
        ("x", worst.extreme.x),
        ("y", worst.extreme.y),
        ("z", depth.z),
    ] {
        found.set_item(name, value)?;
    }
    found.set_item("layer", depth.layer)?;
    let tractions = error.tractions.unwrap_or(f64::NAN);
    let parts = (error.x, error.y, error.z, tractions, error.solution);
    found.set_item("errors", parts)?;
    found.set_item(
        "at",
        worst.extreme.at.map(|zone| match zone {
            Zone::Contact => "rim",
            Zone::Stick => "stick border",
        }),
    )?;
    Ok(found)
}

pub(super) fn depths_of<F>(judged: &Judged<F>) -> (Vec<f64>, Vec<usize>) {
    judged.depths.iter().map(|d: &Depth| (d.z, d.layer)).unzip()
}
