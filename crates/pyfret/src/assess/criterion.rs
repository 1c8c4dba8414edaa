//! What a criterion found on a section.

use std::sync::Arc;

use contact_assess::{self as core, ByCriterion, Judged};
use fatigue::AtPoint;
use ndarray::{Array2, Array3};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::below::{Below, depths_of, place};
use crate::arguments::number;
use crate::fatigue::{AT_POINT, Assessment};

/// What a criterion found on a section.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct CriterionBelow {
    pub(super) below: Arc<Below>,
    pub(super) judged: Judged<AtPoint>,
    pub(super) of: ByCriterion,
}

#[pymethods]
impl CriterionBelow {
    /// Depths [m] and their layers.
    #[getter]
    fn depths(&self) -> (Vec<f64>, Vec<usize>) {
        depths_of(&self.judged)
    }

    /// The assessment of every layer, None where it is not judged.
    #[getter]
    fn assessments(&self) -> Vec<Option<Assessment>> {
        self.of
            .assessments
            .iter()
            .map(|a| a.map(Assessment))
            .collect()
    }

    /// What a reader should know of the materials.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.of.notes.clone()
    }

    /// Arrays over (depth, place), NaN where not judged.
    #[pyo3(signature = () -> "dict[str, NDArray[np.float64]]")]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let places = self.judged.along.len();
        let row = |found: &Option<Vec<AtPoint>>| match found {
            Some(found) => Some(found.iter().copied().map(Some).collect()),
            None => Some(vec![None; places]),
        };
        let rows: Vec<_> = self.judged.found.iter().map(row).collect();
        arrays(py, &rows, |row| self.of.of(self.judged.depths[row].layer))
    }

    /// The worst point of a layer, None where it is not judged.
    #[pyo3(signature = (layer: "int") -> "dict[str, Any] | None")]
    fn worst<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] layer: usize,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let worst = self.below.at(py, true, |site| {
            core::worst(site, &self.judged, &self.of, layer)
        })?;
        let Some((worst, assessment)) = worst.zip(self.of.of(layer)) else {
            return Ok(None);
        };
        let found = place(py, &worst)?;
        let (value, error) = (worst.extreme.value, worst.extreme.error.sum());
        found.set_item("margin", assessment.margin(value))?;
        found.set_item("range", assessment.range(value, error).to_vec())?;
        if assessment.criterion.has_plane() {
            let normal = worst.found.normal;
            found.set_item("normal", normal)?;
            let angle = core::inclination(normal, self.judged.line);
            found.set_item("inclination", angle.to_degrees())?;
        }
        Ok(Some(found))
    }
}

/// Arrays over (rows, places) of what a criterion found, NaN where nothing was judged.
pub(super) fn arrays<'py, 'a>(
    py: Python<'py>,
    rows: &[Option<Vec<Option<AtPoint>>>],
    assessment: impl Fn(usize) -> Option<&'a fatigue::Assessment>,
) -> PyResult<Bound<'py, PyDict>> {
    let places = rows.iter().flatten().map(Vec::len).next().unwrap_or(0);
    let at = |row: usize, place: usize| rows[row].as_ref().and_then(|row| row[place]);
    let of = |f: fn(&AtPoint) -> f64| {
        let values = Array2::from_shape_fn((rows.len(), places), |(row, place)| {
            at(row, place).map_or(f64::NAN, |found| f(&found))
        });
        values.into_pyarray(py)
    };
    let found = PyDict::new(py);
    for (name, number) in AT_POINT {
        found.set_item(name, of(number))?;
    }
    let margin = Array2::from_shape_fn((rows.len(), places), |(row, place)| {
        let judged = at(row, place).zip(assessment(row));
        judged.map_or(f64::NAN, |(found, assessment)| {
            assessment.margin(found.value)
        })
    });
    found.set_item("margin", margin.into_pyarray(py))?;
    let normal = Array3::from_shape_fn((rows.len(), places, 3), |(row, place, d)| {
        at(row, place).map_or(f64::NAN, |found| found.normal[d])
    });
    found.set_item("normal", normal.into_pyarray(py))?;
    Ok(found)
}
