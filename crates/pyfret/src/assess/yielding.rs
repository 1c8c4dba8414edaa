//! Load factors on a section.

use contact_assess::{self as core, ByYield, Judge as _, Judged};
use fatigue::Yield;
use ndarray::Array2;

use crate::fatigue::FACTORS;
use crate::prelude::*;

use super::below::{Below, depths_of, place};

/// Load factors on a section.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct YieldBelow {
    pub(super) below: Arc<Below>,
    pub(super) judged: Judged<Yield>,
    pub(super) of: ByYield,
}

#[pymethods]
impl YieldBelow {
    /// Load factors over (depth, place), NaN where not judged.
    #[pyo3(signature = () -> "dict[str, NDArray[np.float64]]")]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let shape = (self.judged.found.len(), self.judged.along.len());
        let found = PyDict::new(py);
        for (name, of) in FACTORS {
            let values = Array2::from_shape_fn(shape, |(row, place)| {
                self.judged.found[row]
                    .as_ref()
                    .map_or(f64::NAN, |row| of(&row[place]))
            });
            found.set_item(name, values.into_pyarray(py))?;
        }
        Ok(found)
    }

    /// Where a load factor of a layer is least; `score` is its inverse.
    #[pyo3(signature = (layer: "int", factor) -> "dict[str, Any] | None")]
    fn least<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] layer: usize,
        factor: &str,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let named = FACTORS.iter().find(|(name, _)| *name == factor);
        let Some((_, factor)) = named else {
            let names = FACTORS.map(|(name, _)| name).join(", ");
            refuse!("{factor:?}: must be one of {names}");
        };
        let of = ByYield {
            of: *factor,
            ..self.of.clone()
        };
        if !of.judges(layer) {
            return Ok(None);
        }
        let least = self.below.at(py, false, |site| {
            core::worst(site, &self.judged, &of, layer)
        })?;
        least.map(|least| place(py, &least)).transpose()
    }
}

attributes!(YieldBelow, self:
    /// Depths [m] and their layers.
    depths: (Vec<f64>, Vec<usize>) = depths_of(&self.judged);
);
