//! A section below a contact, and what is told of its points.

use contact_assess::{self as core, Judged, Site};
use contact_core::Error;
use contact_core::scene::{self, ResidualStress};
use contact_subsurface::{Depth, Line, Side};

use super::given::Given;
use crate::argument::Answer;
use crate::prelude::*;
use crate::subsurface::{errors, zone_name};

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
    ) -> Answer<T> {
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
        raised.map_or_else(|| Ok(found?), |raised| Err(raised.into()))
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
    found.set_item("x", worst.extreme.x)?;
    found.set_item("y", worst.extreme.y)?;
    found.set_item("z", depth.z)?;
    found.set_item("layer", depth.layer)?;
    found.set_item("errors", errors(error))?;
    found.set_item("at", worst.extreme.at.map(zone_name))?;
    Ok(found)
}

pub(super) fn depths_of<F>(judged: &Judged<F>) -> (Vec<f64>, Vec<usize>) {
    judged.depths.iter().map(|d: &Depth| (d.z, d.layer)).unzip()
}
