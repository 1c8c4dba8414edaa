//! Load factors on a section.

use contact_assess::{self as core, Judge as _, Judged, YieldJudge};
use fatigue::Yield;
use ndarray::Array2;

use crate::fatigue::FACTORS;
use crate::prelude::*;

use super::below::{AssessedBody, depths_of, place};

/// Load factors on a section.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct YieldBelow {
    pub(super) below: Arc<AssessedBody>,
    pub(super) judged: Judged<Yield>,
    pub(super) of: YieldJudge,
}

#[pymethods]
impl YieldBelow {
    /// Load factors over (depth, place), NaN where not judged.
    #[pyo3(signature = () -> "dict[str, NDArray[np.float64]]")]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let shape = (self.judged.judgements.len(), self.judged.along.len());
        let fields = PyDict::new(py);
        for (name, of) in FACTORS {
            let values = Array2::from_shape_fn(shape, |(row, place)| {
                self.judged.judgements[row]
                    .as_ref()
                    .map_or(f64::NAN, |row| of(&row[place]))
            });
            fields.set_item(name, values.into_pyarray(py))?;
        }
        Ok(fields)
    }

    /// Place of the least load factor of a layer; `score` is its inverse.
    #[pyo3(signature = (layer: "int", factor) -> "dict[str, Any] | None")]
    fn least<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] layer: usize,
        factor: &str,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let row = FACTORS.iter().find(|(name, _)| *name == factor);
        let Some((_, factor)) = row else {
            let names = FACTORS.map(|(name, _)| name).join(", ");
            refuse!("{factor:?}: must be one of {names}");
        };
        let judge = YieldJudge {
            safety_factor: *factor,
            ..self.of.clone()
        };
        if !judge.judges(layer) {
            return Ok(None);
        }
        let least = self.below.with_site(py, false, |site| {
            core::find_worst_point(site, &self.judged, &judge, layer)
        })?;
        least.map(|least| place(py, &least)).transpose()
    }
}

attributes!(YieldBelow, self:
    /// Depths [m] and their layers.
    depths: (Vec<f64>, Vec<usize>) = depths_of(&self.judged);
);
