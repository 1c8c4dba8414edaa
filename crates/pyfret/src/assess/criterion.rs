//! Values of a criterion on a section.

use contact_assess::{self as core, Averaging, CriterionJudge, Distance, Judged, RangeOptions};
use contact_core::Error;
use fatigue::{PointResult, Range, Search};
use ndarray::{Array2, Array3};

use super::below::{AssessedBody, depths_of, place};
use crate::argument;
use crate::error::Answer;
use crate::fatigue::{AT_POINT, Assessment, Material};
use crate::prelude::*;
use crate::scene::Body;

/// Values of a criterion on a section.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct CriterionBelow {
    pub(super) below: Arc<AssessedBody>,
    pub(super) judged: Judged<PointResult>,
    pub(super) of: CriterionJudge,
}

#[pymethods]
impl CriterionBelow {
    /// Arrays over (depth, place), NaN where not judged.
    #[pyo3(signature = () -> "dict[str, NDArray[np.float64]]")]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let places = self.judged.along.len();
        let row = |found: &Option<Vec<PointResult>>| match found {
            Some(found) => Some(found.iter().copied().map(Some).collect()),
            None => Some(vec![None; places]),
        };
        let rows: Vec<_> = self.judged.judgements.iter().map(row).collect();
        arrays(py, &rows, |row| {
            self.of.assessment(self.judged.depths[row].layer)
        })
    }

    /// The worst point of a layer, None where it is not judged.
    ///
    /// `range` is the margin of the value with its error, `whole` the range of 10 to 90 % with the
    /// scatter of the material. `order` is the margin without its upper bound, by which layers are
    /// sorted. Criteria with a plane give its `normal` and its `inclination` to the line [degrees].
    #[pyo3(signature = (layer: "int", material = None) -> "dict[str, Any] | None")]
    fn worst<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] layer: usize,
        material: Option<Material>,
    ) -> Answer<Option<Bound<'py, PyDict>>> {
        let worst = self.below.with_site(py, true, |site| {
            core::find_worst_point(site, &self.judged, &self.of, layer)
        })?;
        let Some((worst, assessment)) = worst.zip(self.of.assessment(layer)) else {
            return Ok(None);
        };
        let fields = place(py, &worst)?;
        let (value, error) = (worst.extremum.value, worst.extremum.error.sum());
        let range = assessment.margin_range(value, error);
        fields.set_item("margin", range.best)?;
        fields.set_item("range", (range.low, range.high))?;
        let material = material.as_ref().map(|material| &material.0);
        let (factor, _) = assessment.scatter(material, None)?;
        let whole = assessment.point_range(value, error, factor);
        fields.set_item("whole", (whole.low, whole.high))?;
        fields.set_item("order", assessment.uncapped_margin(value))?;
        if assessment.criterion.has_plane() {
            let normal = worst.judgement.normal;
            fields.set_item("normal", normal)?;
            let angle = core::inclination(normal, self.judged.line);
            fields.set_item("inclination", angle.to_degrees())?;
        }
        Ok(Some(fields))
    }
}

attributes!(CriterionBelow, self:
    /// Depths [m] and their layers.
    depths: (Vec<f64>, Vec<usize>) = depths_of(&self.judged);
    /// The assessment of every layer, None where it is not judged.
    assessments: Vec<Option<Assessment>> = self.of
        .assessments
        .iter()
        .map(|a| a.map(Assessment))
        .collect();
    /// Notes on the materials.
    notes: Vec<String> = self.of.notes.clone();
);

/// A range: low, best, high.
type Three = (f64, f64, f64);

/// Low, best and high value.
fn three(of: Range) -> Three {
    (of.low, of.best, of.high)
}

impl CriterionBelow {
    /// The largest mean over a distance, None if it fits nowhere on the grid. The inner error is the reason if
    /// the distance is refused.
    fn largest(
        &self,
        py: Python<'_>,
        distance: &Distance,
    ) -> argument::Answer<Result<Option<f64>, Error>> {
        self.below.with_site(py, true, |site| {
            match core::largest_mean(site, self.below.line, distance, &self.of) {
                Err(stopped @ Error::Interrupted { .. }) => Err(stopped),
                found => Ok(found.map(|found| found.map(|mean| mean.value))),
            }
        })
    }

    /// The numerical error of `value`, the largest mean of the criterion over a distance along the line.
    fn error_of_largest(
        &self,
        py: Python<'_>,
        distance: &Distance,
        value: f64,
    ) -> argument::Answer<f64> {
        self.below.with_site(py, true, |site| {
            core::error_of_largest_mean(site, self.below.line, distance, &self.of, value)
        })
    }
}

/// The range of the margin of a layer.
///
/// Parameters
/// ----------
/// sections : list of CriterionBelow
///     The sections that the layer was judged in.
/// worst : (float, float)
///     Value of the criterion at the worst point, and its error.
/// scatter, L : float, optional
///     In place of the scatter of the material and of its critical distance [m].
///
/// Returns
/// -------
/// tuple
///     Low, best, high; the same of the stress alone. Highest over lowest by the scatter of the
///     material. The range of the distance, None at a point; L [m]; notes.
#[pyfunction]
#[pyo3(signature = (sections: "Sequence[CriterionBelow]", layer: "int", material, worst: "tuple[float, float]", *, method, scatter: "float | None" = None, L: "float | None" = None))]
#[expect(clippy::type_complexity, reason = "the parts of a range")]
pub(crate) fn range_of_life(
    py: Python<'_>,
    sections: List<Py<CriterionBelow>>,
    #[pyo3(from_py_with = number)] layer: usize,
    material: Option<Material>,
    #[pyo3(from_py_with = number)] worst: (f64, f64),
    method: &str,
    #[pyo3(from_py_with = number)] scatter: Option<f64>,
    #[pyo3(from_py_with = number)] L: Option<f64>,
) -> Answer<(Three, Three, f64, Option<Three>, Option<f64>, Vec<String>)> {
    let method = averaging(method)?;
    let judged = sections
        .first()
        .and_then(|one| one.get().of.assessment(layer).copied());
    let Some(assessment) = judged else {
        refuse!("layer = {layer}: has no material");
    };
    let mean = |length: f64, with_error: bool| -> Answer<Result<(f64, f64), Error>> {
        let distance = Distance {
            method,
            length,
            layer,
        };
        let mut highest: Option<(f64, &CriterionBelow)> = None;
        for section in sections.iter().map(Py::get) {
            match section.largest(py, &distance)? {
                Ok(found) => {
                    let larger =
                        found.filter(|value| highest.is_none_or(|(highest, _)| *value > highest));
                    highest = larger.map(|value| (value, section)).or(highest);
                }
                Err(refused) => return Ok(Err(refused)),
            }
        }
        let Some((value, section)) = highest else {
            let allowed = "so short that the mean stays above the grid";
            return Ok(Err(Error::invalid("L", length, allowed)));
        };
        let error = if with_error {
            section.error_of_largest(py, &distance, value)?
        } else {
            0.0
        };
        Ok(Ok((value, error)))
    };
    let half_width = match sections.first().map(Py::get) {
        Some(section) => section.below.with_site(py, true, |site| {
            contact_subsurface::half_width(site.cycle, site.grid, section.below.line)
        })?,
        None => 0.0,
    };
    let options = RangeOptions {
        scatter,
        length: L,
        half_width,
    };
    let material = material.as_ref().map(|material| &material.0);
    let range = core::margin_range(&assessment, material, worst, &options, mean)?;
    Ok((
        three(range.range.range),
        three(range.range.stress),
        range.range.material,
        range.range.distance.map(three),
        range.length,
        range.notes,
    ))
}

/// Notes on the materials of a body for a criterion, before a contact is solved.
///
/// Parameters
/// ----------
/// materials : list of Material or None
///     Of every layer from the surface down, the substrate's last.
#[pyfunction]
#[pyo3(signature = (criterion: "str", body: "Body", materials: "Sequence[Material | None]"))]
pub(crate) fn notes_on_materials(
    criterion: &str,
    body: &Body,
    materials: List<Option<Material>>,
) -> Answer<Vec<String>> {
    let layers: Vec<_> = materials.into_iter().map(|of| of.map(|of| of.0)).collect();
    let judge = CriterionJudge::new(criterion, &body.0, &layers, Search::default())?;
    Ok(judge.notes_on_materials(&layers)?)
}

/// The region of an average, by its name.
pub(super) fn averaging(method: &str) -> PyResult<Averaging> {
    let row = Averaging::ALL.iter().find(|(name, _)| *name == method);
    row.map(|(_, method)| *method).ok_or_else(|| {
        let names = Averaging::ALL.map(|(name, _)| name).join(", ");
        PyValueError::new_err(format!("method = {method:?}: must be one of {names}"))
    })
}

/// Arrays over (rows, places) of the judgements, NaN where nothing was judged. `assessment` returns the one of
/// a row.
pub(super) fn arrays<'py, 'a>(
    py: Python<'py>,
    rows: &[Option<Vec<Option<PointResult>>>],
    assessment: impl Fn(usize) -> Option<&'a fatigue::Assessment>,
) -> PyResult<Bound<'py, PyDict>> {
    let places = rows.iter().flatten().map(Vec::len).next().unwrap_or(0);
    let at = |row: usize, place: usize| rows[row].as_ref().and_then(|row| row[place]);
    let to_array = |f: fn(&PointResult) -> f64| {
        let values = Array2::from_shape_fn((rows.len(), places), |(row, place)| {
            at(row, place).map_or(f64::NAN, |found| f(&found))
        });
        values.into_pyarray(py)
    };
    let fields = PyDict::new(py);
    for (name, number) in AT_POINT {
        fields.set_item(name, to_array(number))?;
    }
    let margin = Array2::from_shape_fn((rows.len(), places), |(row, place)| {
        let judged = at(row, place).zip(assessment(row));
        judged.map_or(f64::NAN, |(fields, assessment)| {
            assessment.margin(fields.value)
        })
    });
    fields.set_item("margin", margin.into_pyarray(py))?;
    let normal = Array3::from_shape_fn((rows.len(), places, 3), |(row, place, d)| {
        at(row, place).map_or(f64::NAN, |fields| fields.normal[d])
    });
    fields.set_item("normal", normal.into_pyarray(py))?;
    Ok(fields)
}
