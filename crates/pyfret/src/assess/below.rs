//! A section below a contact, and the fields of its points.

use contact_assess::{self as core, Judged, Site};
use contact_core::Error;
use contact_core::scene::{self, ResidualStress};
use contact_subsurface::{Depth, Line, Side};

use super::python_cycle::PythonCycle;
use crate::argument::Answer;
use crate::prelude::*;
use crate::subsurface::{errors, zone_name};

/// A section of a body over a cycle.
pub(super) struct AssessedBody {
    pub(super) body: scene::Body,
    pub(super) grid: scene::Grid,
    pub(super) side: Side,
    pub(super) line: Line,
    pub(super) residual: ResidualStress,
    pub(super) cycle: PythonCycle,
    pub(super) cache: Arc<core::StressCache>,
}

impl AssessedBody {
    /// Does `work` at the site in a thread that can be interrupted; without residual stress if the judge takes
    /// it by itself (`residual` false).
    pub(super) fn with_site<T: Send>(
        &self,
        py: Python<'_>,
        residual: bool,
        work: impl FnOnce(&Site<'_>) -> Result<T, Error> + Send,
    ) -> Answer<T> {
        let (stop, none) = (Arc::default(), ResidualStress::default());
        let judged = interruptible(py, &stop, || {
            work(&Site {
                body: &self.body,
                side: self.side,
                grid: &self.grid,
                residual: if residual { &self.residual } else { &none },
                cycle: &self.cycle,
                stop: stop.clone(),
                cache: self.cache.clone(),
            })
        })?;
        let raised = self.cycle.take_error();
        raised.map_or_else(|| Ok(judged?), |raised| Err(raised.into()))
    }
}

/// The place of a worst point and its errors, as a dict.
pub(super) fn place<'py, F>(
    py: Python<'py>,
    worst: &core::WorstPoint<F>,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    let (depth, error) = (worst.extremum.depth, worst.extremum.error);
    fields.set_item("score", worst.extremum.value)?;
    fields.set_item("x", worst.extremum.x)?;
    fields.set_item("y", worst.extremum.y)?;
    fields.set_item("z", depth.z)?;
    fields.set_item("layer", depth.layer)?;
    fields.set_item("errors", errors(error))?;
    fields.set_item("at", worst.extremum.at.map(zone_name))?;
    Ok(fields)
}

/// The depths of judged samples and their layers.
pub(super) fn depths_of<F>(judged: &Judged<F>) -> (Vec<f64>, Vec<usize>) {
    judged.depths.iter().map(|d: &Depth| (d.z, d.layer)).unzip()
}
