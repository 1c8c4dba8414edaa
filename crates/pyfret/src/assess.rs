//! From stress to decision: judgement of a section below a contact over a closed cycle.

use std::sync::{Arc, Mutex};

use contact_core::assess::{
    self as core, Averaging, ByCriterion, ByYield, Distance, Judge, Judged, Moments, OverCycle,
    Site,
};
use contact_core::fatigue::{AtPoint, Search, Yield};
use contact_core::fields::{Depth, Line, Side, Zone, residual_of_layers};
use contact_core::{Error, scene};
use ndarray::{Array2, Array3, Ix2};
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::to_python;
use crate::arguments::{Array, List, Mask, side};
use crate::fatigue::{Assessment, Material};
use crate::interruptible::interruptible;
use crate::scene::{Body, Grid};
use crate::subsurface::{Subsurface, line};

/// Fields of several moments.
type Fields<'py> = List<Array<'py, Ix2>>;
type Sticking<'py> = List<Mask<'py, Ix2>>;
/// A load factor of several.
type Factor = fn(&Yield) -> f64;

/// The moments of a cycle that an object of Python gives: fields of shape (nx, ny) of each and bulk stresses.
struct Given {
    /// Called with the numbers of moments, or with none for the start of the cycle.
    give: Py<PyAny>,
    count: usize,
    shape: (usize, usize),
    /// What Python raised.
    raised: Mutex<Option<PyErr>>,
}

impl Given {
    fn ask(&self, which: Option<&[usize]>) -> Result<Option<Moments>, Error> {
        Python::attach(|py| self.asked(py, which)).map_err(|error| {
            if let Ok(mut raised) = self.raised.lock() {
                *raised = Some(error);
            }
            Error::Interrupted { increment: 0 }
        })
    }

    fn asked(&self, py: Python<'_>, which: Option<&[usize]>) -> PyResult<Option<Moments>> {
        let given = self.give.call1(py, (which.map(<[usize]>::to_vec),))?;
        if given.is_none(py) {
            return Ok(None);
        }
        let (q_x, q_y, p, stick, sigma_B): (
            Fields<'_>,
            Fields<'_>,
            Fields<'_>,
            Sticking<'_>,
            Vec<f64>,
        ) = given.extract(py)?;
        let lengths = [q_x.len(), q_y.len(), p.len(), stick.len(), sigma_B.len()];
        let shapes = q_x
            .iter()
            .chain(q_y.iter())
            .chain(p.iter())
            .map(|f| f.as_array().dim());
        let mut shapes = shapes.chain(stick.iter().map(|f| f.as_array().dim()));
        if lengths.iter().any(|n| *n != lengths[0]) || shapes.any(|found| found != self.shape) {
            return Err(PyValueError::new_err(format!(
                "fields of a cycle: must be as many of each, of the shape of the grid, {:?}",
                self.shape
            )));
        }
        let own = |f: &Array<'_, Ix2>| f.as_array().as_standard_layout().into_owned();
        let tractions = (0..p.len()).map(|n| [own(&q_x[n]), own(&q_y[n]), own(&p[n])]);
        Ok(Some(Moments {
            tractions: tractions.collect(),
            stick: stick
                .iter()
                .map(|f| f.as_array().as_standard_layout().into_owned())
                .collect(),
            sigma_B,
        }))
    }
}

impl OverCycle for Given {
    fn count(&self) -> usize {
        self.count
    }

    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        let allowed = "the moments asked for";
        self.ask(Some(which))?
            .filter(|moments| moments.sigma_B.len() == which.len())
            .ok_or_else(|| Error::invalid("fields of a cycle", "others", allowed))
    }

    fn start(&self) -> Result<Option<Moments>, Error> {
        self.ask(None)
    }
}

/// A section of a body below a contact over a cycle.
///
/// `moments` is called with a list of numbers from 0 to `count` - 1, or with None for the moment
/// before the cycle: lists of q_x, q_y, p [Pa] and stick, of shape (nx, ny) each, and of the bulk
/// stress [Pa]; or None.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct CycleSection {
    below: Arc<Below>,
}

struct Below {
    body: scene::Body,
    grid: scene::Grid,
    side: Side,
    line: Line,
    residual: Vec<f64>,
    given: Given,
}

impl Below {
    /// Does `work` at the site while signals are heard; without residual stress if the judge has it.
    fn at<T: Send>(
        &self,
        py: Python<'_>,
        residual: bool,
        work: impl FnOnce(&Site<'_>) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let stop = Arc::default();
        let found = interruptible(py, &stop, || {
            work(&Site {
                body: &self.body,
                side: self.side,
                grid: &self.grid,
                residual: if residual { &self.residual } else { &[] },
                cycle: &self.given,
                stop: stop.clone(),
            })
        })?;
        let raised = self
            .given
            .raised
            .lock()
            .ok()
            .and_then(|mut raised| raised.take());
        raised.map_or_else(|| found.map_err(to_python), Err)
    }
}

#[pymethods]
impl CycleSection {
    #[new]
    #[pyo3(signature = (body, grid, moments, count, *, x = None, y = None, body_number = 2, residual = None))]
    fn new(
        body: Body,
        grid: Grid,
        moments: Py<PyAny>,
        count: usize,
        x: Option<f64>,
        y: Option<f64>,
        body_number: u8,
        residual: Option<List<f64>>,
    ) -> PyResult<Self> {
        let residual = residual_of_layers(&body.0, &residual.unwrap_or_default());
        let below = Below {
            side: side(body_number)?,
            line: line(x, y)?,
            residual: residual.map_err(to_python)?,
            given: Given {
                give: moments,
                count,
                shape: (grid.0.nx, grid.0.ny),
                raised: Mutex::new(None),
            },
            body: body.0,
            grid: grid.0,
        };
        Ok(Self {
            below: Arc::new(below),
        })
    }

    /// Part of the largest traction by which the cycle ends off its start, if that was kept.
    fn unsettled(&self, py: Python<'_>) -> PyResult<Option<f64>> {
        self.below.at(py, true, |site| core::unsettled(site.cycle))
    }

    /// Judge the section by a criterion for the materials of the layers.
    #[pyo3(signature = (z, layer, materials, criterion, *, tolerance))]
    fn by_criterion(
        &self,
        py: Python<'_>,
        z: List<f64>,
        layer: List<usize>,
        materials: List<Option<Material>>,
        criterion: &str,
        tolerance: f64,
    ) -> PyResult<CriterionBelow> {
        let depths = Subsurface::depths(&z, &layer)?;
        let of = criterion_of(&self.below, materials, criterion, tolerance)?;
        let judged = self.below.at(py, true, |site| {
            core::judge(site, self.below.line, &depths, std::slice::from_ref(&of))
        })?;
        Ok(CriterionBelow {
            below: self.below.clone(),
            judged: only(judged)?,
            of,
        })
    }

    /// Judge the section by yield stresses of the layers from the surface down [Pa].
    fn by_yield(
        &self,
        py: Python<'_>,
        z: List<f64>,
        layer: List<usize>,
        s_y: List<Option<f64>>,
    ) -> PyResult<YieldBelow> {
        let depths = Subsurface::depths(&z, &layer)?;
        let of = ByYield {
            s_y: s_y.0,
            residual: self.below.residual.clone(),
            of: |found| found.von_mises,
        };
        let judged = self.below.at(py, false, |site| {
            core::judge(site, self.below.line, &depths, std::slice::from_ref(&of))
        })?;
        Ok(YieldBelow {
            below: self.below.clone(),
            judged: only(judged)?,
            of,
        })
    }

    /// Judge the mean over a critical distance L [m] in a layer: arrays over the places.
    #[pyo3(signature = (L, method, layer, materials, criterion, *, tolerance))]
    fn mean<'py>(
        &self,
        py: Python<'py>,
        L: f64,
        method: &str,
        layer: usize,
        materials: List<Option<Material>>,
        criterion: &str,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let named = Averaging::ALL.iter().find(|(name, _)| *name == method);
        let Some((_, method)) = named else {
            let names = Averaging::ALL.map(|(name, _)| name).join(", ");
            let message = format!("method = {method:?}: must be one of {names}");
            return Err(PyValueError::new_err(message));
        };
        let of = criterion_of(&self.below, materials, criterion, tolerance)?;
        let Some(assessment) = of.of(layer).copied() else {
            let message = format!("layer = {layer}: has no material");
            return Err(PyValueError::new_err(message));
        };
        let distance = Distance {
            method: *method,
            length: L,
            layer,
        };
        let found = self.below.at(py, true, |site| {
            core::average(site, self.below.line, &distance, &of)
        })?;
        let rows = [found];
        let view: Vec<Option<Vec<Option<AtPoint>>>> = rows.into_iter().map(Some).collect();
        fields(py, &view, |_| Some(&assessment))
    }
}

fn criterion_of(
    below: &Below,
    materials: List<Option<Material>>,
    criterion: &str,
    tolerance: f64,
) -> PyResult<ByCriterion> {
    let search = Search {
        tolerance,
        ..Search::default()
    };
    let given = materials.into_iter().map(|m| m.map(|m| m.0)).collect();
    let of_layers = core::materials_of_layers(&below.body, given).map_err(to_python)?;
    ByCriterion::new(criterion, &below.body, &of_layers, search).map_err(to_python)
}

fn only<F>(judged: Vec<Judged<F>>) -> PyResult<Judged<F>> {
    let mut judged = judged.into_iter();
    judged
        .next()
        .ok_or_else(|| PyValueError::new_err("nothing was judged"))
}

/// Arrays over (rows, places) of what a criterion found, NaN where nothing was judged.
fn fields<'py, 'a>(
    py: Python<'py>,
    rows: &[Option<Vec<Option<AtPoint>>>],
    assessment: impl Fn(usize) -> Option<&'a contact_core::fatigue::Assessment>,
) -> PyResult<Bound<'py, PyDict>> {
    let places = rows.iter().flatten().map(Vec::len).next().unwrap_or(0);
    let at = |row: usize, place: usize| rows[row].as_ref().and_then(|row| row[place]);
    let of = |f: &dyn Fn(&AtPoint) -> f64| {
        let values = Array2::from_shape_fn((rows.len(), places), |(row, place)| {
            at(row, place).map_or(f64::NAN, |found| f(&found))
        });
        values.into_pyarray(py)
    };
    let found = PyDict::new(py);
    found.set_item("value", of(&|p| p.value))?;
    found.set_item("missed", of(&|p| p.missed))?;
    found.set_item("planes", of(&|p| p.planes as f64))?;
    found.set_item("shear_amplitude", of(&|p| p.shear_amplitude))?;
    found.set_item("shear_chord", of(&|p| p.shear_chord))?;
    found.set_item("normal_max", of(&|p| p.normal_max))?;
    found.set_item("normal_min", of(&|p| p.normal_min))?;
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

/// Place and errors of a worst point.
fn place<'py, F>(py: Python<'py>, worst: &core::Worst<F>) -> PyResult<Bound<'py, PyDict>> {
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
    found.set_item("errors", (error.x, error.y, error.z, error.tractions))?;
    found.set_item(
        "at",
        worst.extreme.at.map(|zone| match zone {
            Zone::Contact => "contact",
            Zone::Stick => "stick",
        }),
    )?;
    Ok(found)
}

fn depths_of<F>(judged: &Judged<F>) -> (Vec<f64>, Vec<usize>) {
    judged.depths.iter().map(|d: &Depth| (d.z, d.layer)).unzip()
}

/// What a criterion found on a section.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct CriterionBelow {
    below: Arc<Below>,
    judged: Judged<AtPoint>,
    of: ByCriterion,
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
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let places = self.judged.along.len();
        let row = |found: &Option<Vec<AtPoint>>| match found {
            Some(found) => Some(found.iter().copied().map(Some).collect()),
            None => Some(vec![None; places]),
        };
        let rows: Vec<_> = self.judged.found.iter().map(row).collect();
        fields(py, &rows, |row| self.of.of(self.judged.depths[row].layer))
    }

    /// The worst point of a layer, None where it is not judged.
    fn worst<'py>(&self, py: Python<'py>, layer: usize) -> PyResult<Option<Bound<'py, PyDict>>> {
        let worst = self.below.at(py, true, |site| {
            core::worst(site, &self.judged, &self.of, layer)
        })?;
        let Some((worst, assessment)) = worst.zip(self.of.of(layer)) else {
            return Ok(None);
        };
        let found = place(py, &worst)?;
        found.set_item("margin", assessment.margin(worst.extreme.value))?;
        if assessment.criterion.has_plane() {
            let normal = worst.found.normal;
            found.set_item("normal", normal)?;
            let angle = core::inclination(normal, self.judged.line);
            found.set_item("inclination", angle.to_degrees())?;
        }
        Ok(Some(found))
    }
}

/// Load factors on a section.
#[pyclass(frozen, module = "pyfret.fatigue")]
pub(crate) struct YieldBelow {
    below: Arc<Below>,
    judged: Judged<Yield>,
    of: ByYield,
}

/// The factors by their names.
const FACTORS: [(&str, Factor); 3] = [
    ("von_mises", |f| f.von_mises),
    ("tresca", |f| f.tresca),
    ("shakedown", |f| f.shakedown),
];

#[pymethods]
impl YieldBelow {
    /// Depths [m] and their layers.
    #[getter]
    fn depths(&self) -> (Vec<f64>, Vec<usize>) {
        depths_of(&self.judged)
    }

    /// Load factors over (depth, place), NaN where not judged.
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
    fn least<'py>(
        &self,
        py: Python<'py>,
        layer: usize,
        factor: &str,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let named = FACTORS.iter().find(|(name, _)| *name == factor);
        let Some((_, factor)) = named else {
            let names = FACTORS.map(|(name, _)| name).join(", ");
            let message = format!("{factor:?}: must be one of {names}");
            return Err(PyValueError::new_err(message));
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
