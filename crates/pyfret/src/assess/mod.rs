//! Decision from stress: judgement of a section below a contact over a closed cycle.

mod below;
mod criterion;
mod python_cycle;
mod yielding;

use contact_assess::{self as core, CriterionJudge, Distance, Judged, YieldJudge};
use fatigue::Search;
use numpy::PyArray2;

use self::below::AssessedBody;
pub(crate) use self::criterion::{CriterionBelow, notes_on_materials, range_of_life};
use self::criterion::{arrays, averaging};
use self::python_cycle::PythonCycle;
pub(crate) use self::yielding::YieldBelow;
use crate::argument::{Answer, to_python};
use crate::depths::in_layers;
use crate::fatigue::Material;
use crate::line::{LineName, line, name_of};
use crate::prelude::*;
use crate::residual_stress::{Profiles, of_body};
use crate::scene::{Body, Grid};

/// x, y and azimuth of the sections in which a cycle of a contact is looked at by default.
///
/// The first stands along the shear. Others follow where the contact or its shear has no axis
/// there, or where bulk and residual stress have another direction. `moments` and `count` as in
/// :class:`CycleSection`.
#[pyfunction]
#[pyo3(signature = (body, grid, moments: "Callable[[list[int] | None], States | None]", count: "int", *, residual = None))]
pub(crate) fn cycle_sections(
    py: Python<'_>,
    body: Body,
    grid: Grid,
    moments: Py<PyAny>,
    #[pyo3(from_py_with = number)] count: usize,
    residual: Profiles,
) -> PyResult<Vec<LineName>> {
    let cycle = PythonCycle::new(moments, count, &grid.0);
    let residual = of_body(&body.0, residual)?;
    let lines = py.detach(|| contact_subsurface::main_sections(&cycle, &grid.0, &residual));
    let lines = lines.map_err(|error| cycle.take_error().unwrap_or_else(|| to_python(error)))?;
    Ok(lines.into_iter().map(name_of).collect())
}

/// Stress below a body over a cycle, which the sections of several questions share.
///
/// It belongs to one run, one body and one of its cycles. Its memory is at most 192 MB.
#[pyclass(frozen, module = "pyfret._core")]
pub(crate) struct StressCache(Arc<core::StressCache>);

#[pymethods]
impl StressCache {
    #[new]
    fn new() -> Self {
        Self(Arc::default())
    }
}

/// A section of a body below a contact over a cycle.
///
/// `moments` is called with a list of numbers from 0 to `count` - 1, or with None for the moment
/// before the cycle. It gives :class:`States` on the grid, or None. `yielding` is the plastic work
/// of the cycle and the work beside which it is small [J]. `path_error` is the error of the shear
/// by the increments, over the largest shear. `cache` shares the stress with other sections.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct CycleSection {
    below: Arc<AssessedBody>,
}

#[pymethods]
impl CycleSection {
    #[new]
    #[pyo3(signature = (body, grid, moments: "Callable[[list[int] | None], States | None]", count: "int", *, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None, body_number: "int" = 2, residual = None, yielding: "tuple[float, float] | None" = None, path_error: "float | None" = None, cache: "StressCache | None" = None))]
    fn new(
        body: Body,
        grid: Grid,
        moments: Py<PyAny>,
        #[pyo3(from_py_with = number)] count: usize,
        #[pyo3(from_py_with = number)] x: Option<f64>,
        #[pyo3(from_py_with = number)] y: Option<f64>,
        #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
        #[pyo3(from_py_with = number)] body_number: u8,
        residual: Profiles,
        #[pyo3(from_py_with = number)] yielding: Option<(f64, f64)>,
        #[pyo3(from_py_with = number)] path_error: Option<f64>,
        cache: Option<PyRef<'_, StressCache>>,
    ) -> PyResult<Self> {
        let below = AssessedBody {
            side: side(body_number)?,
            line: line(x, y, azimuth)?,
            residual: of_body(&body.0, residual)?,
            cycle: PythonCycle::new(moments, count, &grid.0)
                .with_plastic_work(yielding)
                .with_path_error(path_error),
            body: body.0,
            grid: grid.0,
            cache: cache.map(|cache| cache.0.clone()).unwrap_or_default(),
        };
        Ok(Self {
            below: Arc::new(below),
        })
    }

    /// A note on a cycle that does not end as it began, if its start was kept.
    fn note_on_cycle(&self, py: Python<'_>) -> Answer<Option<String>> {
        self.below.with_site(py, true, |site| {
            contact_subsurface::note_on_cycle(site.cycle)
        })
    }

    /// Judge the section by criteria for the materials of the layers, all by the same stress.
    #[pyo3(signature = (z: "Sequence[float]", layer: "Sequence[int]", materials, criteria, *, tolerance: "float"))]
    fn by_criteria(
        &self,
        py: Python<'_>,
        z: List<f64>,
        layer: List<usize>,
        materials: List<Option<Material>>,
        criteria: List<String>,
        #[pyo3(from_py_with = number)] tolerance: f64,
    ) -> Answer<Vec<CriterionBelow>> {
        let depths = in_layers(&z, &layer)?;
        let to_criterion = |name: &String| criterion_of(&self.below, &materials, name, tolerance);
        let criteria_of_layers = criteria
            .iter()
            .map(to_criterion)
            .collect::<Answer<Vec<_>>>()?;
        let judged = self.below.with_site(py, true, |site| {
            core::judge(site, self.below.line, &depths, &criteria_of_layers)
        })?;
        let below = |(judged, of)| CriterionBelow {
            below: self.below.clone(),
            judged,
            of,
        };
        Ok(judged
            .into_iter()
            .zip(criteria_of_layers)
            .map(below)
            .collect())
    }

    /// Judge the section by yield stresses of the layers from the surface down [Pa].
    #[pyo3(signature = (z: "Sequence[float]", layer: "Sequence[int]", s_y: "Sequence[float | None]"))]
    fn by_yield(
        &self,
        py: Python<'_>,
        z: List<f64>,
        layer: List<usize>,
        s_y: List<Option<f64>>,
    ) -> Answer<YieldBelow> {
        let depths = in_layers(&z, &layer)?;
        let judge = YieldJudge {
            s_y: s_y.0,
            residual: self.below.residual.clone(),
            safety_factor: |found| found.von_mises,
        };
        let judged = self.below.with_site(py, false, |site| {
            core::judge(site, self.below.line, &depths, std::slice::from_ref(&judge))
        })?;
        Ok(YieldBelow {
            below: self.below.clone(),
            judged: only(judged)?,
            of: judge,
        })
    }

    /// Judge the mean over a critical distance L [m] in a layer: arrays over the places.
    #[pyo3(signature = (L: "float", method, layer: "int", materials, criterion, *, tolerance: "float") -> "dict[str, NDArray[np.float64]]")]
    fn mean<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] L: f64,
        method: &str,
        #[pyo3(from_py_with = number)] layer: usize,
        materials: List<Option<Material>>,
        criterion: &str,
        #[pyo3(from_py_with = number)] tolerance: f64,
    ) -> Answer<Bound<'py, PyDict>> {
        let judge = criterion_of(&self.below, &materials, criterion, tolerance)?;
        let Some(assessment) = judge.assessment(layer).copied() else {
            refuse!("layer = {layer}: has no material");
        };
        let distance = Distance {
            method: averaging(method)?,
            length: L,
            layer,
        };
        let line = self.below.line;
        let (found, errors) = self.below.with_site(py, true, |site| {
            let mean = core::judge_means(site, line, &distance, &judge)?;
            let errors = core::errors_of_means(site, line, &distance, &judge, &mean)?;
            Ok((mean, errors))
        })?;
        let fields = arrays(py, &[Some(found)], |_| Some(&assessment))?;
        fields.set_item(
            "error",
            PyArray2::from_vec2(py, &[errors]).map_err(PyErr::from)?,
        )?;
        Ok(fields)
    }
}

/// The criterion for the materials of the layers, with the `tolerance` of its search.
fn criterion_of(
    below: &AssessedBody,
    materials: &[Option<Material>],
    criterion: &str,
    tolerance: f64,
) -> Answer<CriterionJudge> {
    let search = Search {
        tolerance,
        ..Search::default()
    };
    let layers = materials
        .iter()
        .map(|m| m.as_ref().map(|m| m.0.clone()))
        .collect();
    let of_layers = core::layer_materials(&below.body, layers)?;
    Ok(CriterionJudge::new(
        criterion,
        &below.body,
        &of_layers,
        search,
    )?)
}

/// The judgement of a single judge.
fn only<F>(judged: Vec<Judged<F>>) -> Answer<Judged<F>> {
    let mut judged = judged.into_iter();
    judged
        .next()
        .ok_or_else(|| PyValueError::new_err("nothing was judged").into())
}
