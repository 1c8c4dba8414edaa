//! Stress and displacement below the surface.

use std::collections::HashMap;
use std::path::PathBuf;

use contact_core::convolution::Tractions;
use contact_core::fields as core;
use contact_core::fields::{Depth, Line, Measure, Side, Stream};
use contact_core::march;
use contact_core::output::{ImageData, StressStore, VolumeSink, write_volume};
use ndarray::{Array1, Array2, Array3, Axis};
use numpy::{
    AllowTypeChange, IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayLike2, PyArrayLike3,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::to_python;
use crate::scene::{Body, Grid, LoadPath};

/// A field on the grid.
type Field<'py> = PyArrayLike2<'py, f64, AllowTypeChange>;
/// x, y, z and the layer of a point.
type Place = (f64, f64, f64, usize);
/// Numbers for Python, one row per point.
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

fn side(body_number: u8) -> PyResult<Side> {
    match body_number {
        1 => Ok(Side::Body1),
        2 => Ok(Side::Body2),
        n => Err(PyValueError::new_err(format!(
            "body_number = {n}: must be 1 or 2"
        ))),
    }
}

fn measures(names: &[String]) -> PyResult<Vec<Measure>> {
    let known = || -> Vec<_> { core::MEASURES.iter().map(|m| m.name).collect() };
    names
        .iter()
        .map(|name| {
            core::measure_named(name).copied().ok_or_else(|| {
                PyValueError::new_err(format!("{name:?}: must be one of {}", known().join(", ")))
            })
        })
        .collect()
}

fn line(x: Option<f64>, y: Option<f64>) -> PyResult<Line> {
    match (x, y) {
        (None, Some(y)) => Ok(Line::AlongX(y)),
        (Some(x), None) => Ok(Line::AlongY(x)),
        _ => Err(PyValueError::new_err(
            "a section has either x or y constant",
        )),
    }
}

/// Name, unit and meaning of everything that can be asked of a place.
#[pyfunction]
pub(crate) fn probe_labels() -> HashMap<&'static str, (&'static str, &'static str)> {
    let label = |p: core::Probe| (p.name(), (p.unit(), p.long_name()));
    core::Probe::all().map(label).collect()
}

/// The depths with their layers; on an interface both.
#[pyfunction]
pub(crate) fn depths(body: Body, z: Vec<f64>) -> PyResult<(Vec<f64>, Vec<usize>)> {
    let depths = core::depths(&body.0, &z).map_err(to_python)?;
    Ok(depths.iter().map(|d| (d.z, d.layer)).unzip())
}

/// The stresses of n points, from an array of shape (6, n).
fn tensors(stress: &Field<'_>) -> PyResult<Vec<core::StressTensor>> {
    let stress = stress.as_array();
    if stress.nrows() != 6 {
        return Err(PyValueError::new_err(
            "stress: must have six rows, xx, yy, zz, xy, xz, yz",
        ));
    }
    let columns = stress.columns().into_iter();
    Ok(columns.map(|s| std::array::from_fn(|c| s[c])).collect())
}

/// A measure of stresses of shape (6, n).
#[pyfunction]
pub(crate) fn measure<'py>(
    py: Python<'py>,
    name: String,
    stress: Field<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (of, stress) = (measures(&[name])?[0].value, tensors(&stress)?);
    Ok(stress.iter().map(of).collect::<Vec<_>>().into_pyarray(py))
}

/// Principal values and directions of stresses of shape (6, n).
#[pyfunction]
pub(crate) fn principal<'py>(
    py: Python<'py>,
    stress: Field<'py>,
) -> PyResult<(Matrix<'py>, Bound<'py, PyArray3<f64>>)> {
    let stress = tensors(&stress)?;
    let mut values = Array2::zeros((stress.len(), 3));
    let mut directions = Array3::zeros((stress.len(), 3, 3));
    for (n, s) in stress.iter().enumerate() {
        let of = core::principal(s);
        for i in 0..3 {
            values[(n, i)] = of.values[i];
            for j in 0..3 {
                directions[(n, i, j)] = of.directions[i][j];
            }
        }
    }
    Ok((values.into_pyarray(py), directions.into_pyarray(py)))
}

/// Tractions on a body, and what they cause below its surface.
#[pyclass(frozen, module = "pyfret")]
pub(crate) struct Subsurface {
    body: Body,
    grid: Grid,
    side: Side,
    fields: [Option<Vec<f64>>; 3],
}

impl Subsurface {
    fn tractions(&self) -> Tractions<'_> {
        let [q_x, q_y, p] = &self.fields;
        Tractions {
            q_x: q_x.as_deref(),
            q_y: q_y.as_deref(),
            p: p.as_deref(),
        }
    }

    fn depths(z: &[f64], layer: &[usize]) -> PyResult<Vec<Depth>> {
        if z.len() != layer.len() {
            return Err(PyValueError::new_err("z and layer differ in length"));
        }
        let pairs = z.iter().zip(layer);
        Ok(pairs.map(|(&z, &layer)| Depth { z, layer }).collect())
    }
}

#[pymethods]
impl Subsurface {
    #[new]
    #[pyo3(signature = (body, grid, *, p = None, q_x = None, q_y = None, body_number = 2))]
    fn new(
        body: Body,
        grid: Grid,
        p: Option<Field<'_>>,
        q_x: Option<Field<'_>>,
        q_y: Option<Field<'_>>,
        body_number: u8,
    ) -> PyResult<Self> {
        let shape = (grid.0.nx, grid.0.ny);
        let cells = |name: &str, field: Option<Field<'_>>| match field {
            None => Ok(None),
            Some(field) if field.as_array().dim() != shape => Err(PyValueError::new_err(format!(
                "{name} has the shape {:?}: must be that of the grid, {shape:?}",
                field.as_array().dim()
            ))),
            Some(field) => Ok(Some(field.as_array().iter().copied().collect())),
        };
        Ok(Self {
            fields: [cells("q_x", q_x)?, cells("q_y", q_y)?, cells("p", p)?],
            side: side(body_number)?,
            body,
            grid,
        })
    }

    #[pyo3(signature = (z, layer, *, x = None, y = None, displacement = false))]
    fn section<'py>(
        &self,
        py: Python<'py>,
        z: Vec<f64>,
        layer: Vec<usize>,
        x: Option<f64>,
        y: Option<f64>,
        displacement: bool,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (depths, line) = (Self::depths(&z, &layer)?, line(x, y)?);
        let found = py.detach(|| {
            let states = [self.tractions()];
            let section = core::Section::new(&self.body.0, self.side, &self.grid.0, line, &states)?;
            if displacement {
                section.displacement(&depths)
            } else {
                section.stress(&depths)
            }
        });
        Ok(found.map_err(to_python)?.swap_remove(0).into_pyarray(py))
    }

    #[pyo3(signature = (z, layer, *, displacement = false))]
    fn slice<'py>(
        &self,
        py: Python<'py>,
        z: f64,
        layer: usize,
        displacement: bool,
    ) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let found = py.detach(|| {
            let states = [self.tractions()];
            let slices = core::Slices::new(&self.body.0, self.side, &self.grid.0, &states)?;
            let depth = Depth { z, layer };
            Ok(if displacement {
                Vec::from(slices.displacement(depth)?.swap_remove(0))
            } else {
                Vec::from(slices.stress(depth)?.swap_remove(0))
            })
        });
        let found = found.map_err(to_python)?;
        Ok(found.into_iter().map(|f| f.into_pyarray(py)).collect())
    }

    fn points<'py>(
        &self,
        py: Python<'py>,
        places: Vec<Place>,
    ) -> PyResult<(Matrix<'py>, Matrix<'py>)> {
        let places: Vec<_> = places
            .into_iter()
            .map(|(x, y, z, layer)| (x, y, Depth { z, layer }))
            .collect();
        let both = py.detach(|| {
            let states = [self.tractions()];
            let points = core::Points::new(&self.body.0, self.side, &self.grid.0, &states)?;
            Ok((points.stress(&places)?, points.displacement(&places)?))
        });
        let (stress, u) = both.map_err(to_python)?;
        let stress = Array2::from_shape_fn((places.len(), 6), |(n, c)| stress[0][n][c]);
        let u = Array2::from_shape_fn((places.len(), 3), |(n, c)| u[0][n][c]);
        Ok((stress.into_pyarray(py), u.into_pyarray(py)))
    }

    #[pyo3(signature = (out, z, layer, *, of, title = ""))]
    fn volume(
        &self,
        py: Python<'_>,
        out: PathBuf,
        z: Vec<f64>,
        layer: Vec<usize>,
        of: Vec<String>,
        title: &str,
    ) -> PyResult<()> {
        let depths = Self::depths(&z, &layer)?;
        let probes = of.iter().map(|name| core::Probe::named(name, "of"));
        let probes: Vec<_> = probes.collect::<Result<_, _>>().map_err(to_python)?;
        let (grid, side) = (&self.grid.0, self.side);
        let write = || {
            let states = [self.tractions()];
            let slices = core::Slices::new(&self.body.0, side, grid, &states)?;
            let write =
                |sink: &dyn VolumeSink| write_volume(&slices, &depths, &probes, &[sink]).map(drop);
            if out
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("vti"))
            {
                let image = ImageData::create(&out, grid, side, &depths, &probes)?;
                write(&image)?;
                image.finish()
            } else {
                let store = StressStore::create(&out, title, grid, side, &depths, None, &probes)?;
                write(&store)?;
                store.finish()
            }
        };
        py.detach(write).map_err(to_python)
    }
}

/// Stress below a line or on planes over a load path; give it every increment, then take what it
/// kept.
#[pyclass(module = "pyfret")]
pub(crate) struct Envelope {
    stream: Option<Stream<(core::Envelope, core::Largest)>>,
    names: Vec<String>,
    cycles: Vec<(usize, usize)>,
    /// Whether it is that below a line.
    of_line: bool,
}

#[pymethods]
impl Envelope {
    #[new]
    #[pyo3(signature = (body, grid, path, z, layer, *, of, x = None, y = None, body_number = 2))]
    fn new(
        body: Body,
        grid: Grid,
        path: LoadPath,
        z: Vec<f64>,
        layer: Vec<usize>,
        of: Vec<String>,
        x: Option<f64>,
        y: Option<f64>,
        body_number: u8,
    ) -> PyResult<Self> {
        let cycles = core::cycles(&path.0);
        let line = match (x, y) {
            (None, None) => None,
            _ => Some(line(x, y)?),
        };
        let along = match line {
            Some(Line::AlongX(_)) => (0..grid.0.nx).map(|i| grid.0.x(i)).collect(),
            Some(Line::AlongY(_)) => (0..grid.0.ny).map(|j| grid.0.y(j)).collect(),
            None => Vec::new(),
        };
        let accumulate = (
            core::Envelope {
                measures: measures(&of)?,
                cycles: cycles.clone(),
            },
            core::Largest {
                // Only a line has tops that are known between its samples.
                measures: if line.is_some() {
                    measures(&of)?
                } else {
                    Vec::new()
                },
                along,
            },
        );
        let depths = Subsurface::depths(&z, &layer)?;
        let side = side(body_number)?;
        let stream = Stream::new(&body.0, side, &grid.0, line, depths, accumulate);
        Ok(Self {
            stream: Some(stream.map_err(to_python)?),
            names: of,
            cycles,
            of_line: line.is_some(),
        })
    }

    #[getter]
    fn cycles(&self) -> Vec<(usize, usize)> {
        self.cycles.clone()
    }

    #[pyo3(signature = (increment, branch, *, p, q_x, q_y))]
    fn push(
        &mut self,
        py: Python<'_>,
        increment: usize,
        branch: usize,
        p: Field<'_>,
        q_x: Field<'_>,
        q_y: Field<'_>,
    ) -> PyResult<()> {
        let tractions = [q_x, q_y, p].map(|f| f.as_array().as_standard_layout().into_owned());
        let stream = self.stream.as_mut().ok_or_else(finished)?;
        let moment = core::Moment { increment, branch };
        py.detach(|| stream.push(moment, tractions))
            .map_err(to_python)
    }

    /// For each name, arrays over (depth, place): max, min, increment of the largest value; lists
    /// over cycles of amplitude and mean; below a line, rows of the largest values at each
    /// increment: increment, value, place along the line, depth, layer.
    fn finish<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let stream = self.stream.take().ok_or_else(finished)?;
        let (_, kept) = py.detach(|| stream.finish()).map_err(to_python)?;
        let (kept, tops): (Vec<_>, Vec<_>) = kept.into_iter().unzip();
        let largest = core::Largest::over_depths(&tops);
        let result = PyDict::new(py);
        for (m, name) in self.names.iter().enumerate() {
            let rows = |of: &dyn Fn(&core::DepthEnvelope) -> Array1<f64>| {
                let rows: Vec<_> = kept.iter().map(of).collect();
                let views: Vec<_> = rows.iter().map(|r| r.view()).collect();
                ndarray::stack(Axis(0), &views).unwrap_or_default()
            };
            let row = |a: &Array2<f64>| a.row(m).to_owned();
            let of = PyDict::new(py);
            of.set_item("max", rows(&|k| row(&k.path.max)).into_pyarray(py))?;
            of.set_item("min", rows(&|k| row(&k.path.min)).into_pyarray(py))?;
            let when = rows(&|k| k.path.increment_of_max.row(m).mapv(|n| n as f64));
            of.set_item("increment", when.into_pyarray(py))?;
            let cycles = |of: &dyn Fn(&core::Extremes) -> Array2<f64>| -> Vec<_> {
                (0..self.cycles.len())
                    .map(|c| rows(&|k| row(&of(&k.cycles[c]))).into_pyarray(py))
                    .collect()
            };
            of.set_item("amplitude", cycles(&core::Extremes::amplitude))?;
            of.set_item("mean", cycles(&core::Extremes::mean))?;
            if self.of_line {
                let rows = largest.iter().filter_map(|(moment, of)| {
                    let m = of[m]?;
                    let layer = m.depth.layer as f64;
                    Some([
                        moment.increment as f64,
                        m.value,
                        m.place[0],
                        m.depth.z,
                        layer,
                    ])
                });
                let rows = Array2::from(rows.collect::<Vec<_>>());
                of.set_item("largest", rows.into_pyarray(py))?;
            }
            result.set_item(name, of)?;
        }
        Ok(result)
    }
}

fn finished() -> PyErr {
    PyValueError::new_err("the envelope has been finished")
}

/// The largest value of a measure on a section, from its stress of shape (6, depths, places):
/// value, place along the line, depth, layer.
#[pyfunction]
pub(crate) fn maximum(
    name: String,
    stress: PyArrayLike3<'_, f64, AllowTypeChange>,
    z: Vec<f64>,
    layer: Vec<usize>,
    along: Vec<f64>,
) -> PyResult<Option<(f64, f64, f64, usize)>> {
    let stress = stress.as_array().to_owned();
    let depths = Subsurface::depths(&z, &layer)?;
    if stress.dim() != (6, depths.len(), along.len()) {
        return Err(PyValueError::new_err(format!(
            "the stress has the shape {:?}: must be {:?}",
            stress.dim(),
            (6, depths.len(), along.len())
        )));
    }
    let found = measures(&[name])?[0].maximum(&stress, &depths, &along);
    Ok(found.map(|m| (m.value, m.place[0], m.depth.z, m.depth.layer)))
}

/// The rims of the contact on a line on the surface, from the stress of shape (6, places): places,
/// and stresses of shape (6, rims).
#[pyfunction]
pub(crate) fn rims<'py>(
    py: Python<'py>,
    stress: Field<'py>,
    along: Vec<f64>,
) -> PyResult<(Vec<f64>, Matrix<'py>)> {
    if stress.as_array().dim() != (6, along.len()) {
        return Err(PyValueError::new_err(
            "stress: must be of the shape (6, places)",
        ));
    }
    let found = core::rims(&stress.as_array(), &along);
    let tensors = Array2::from_shape_fn((6, found.len()), |(c, n)| found[n].stress[c]);
    let places = found.iter().map(|rim| rim.place).collect();
    Ok((places, tensors.into_pyarray(py)))
}

/// The loops of a history, one dictionary per cycle.
#[pyfunction]
#[pyo3(signature = (path, *, branch, T, delta, dissipated, status))]
pub(crate) fn loops(
    py: Python<'_>,
    path: LoadPath,
    branch: Vec<usize>,
    T: Vec<f64>,
    delta: Vec<f64>,
    dissipated: Vec<f64>,
    status: Vec<u8>,
) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let history: Vec<core::LoopPoint> = branch
        .iter()
        .zip(&T)
        .zip(&delta)
        .zip(&dissipated)
        .zip(&status)
        .map(
            |((((&branch, &T), &delta), &dissipated), &status)| core::LoopPoint {
                branch,
                T,
                delta,
                dissipated,
                status: march::Status::ALL[usize::from(status).min(3)],
            },
        )
        .collect();
    core::loops(&path.0, &history)
        .iter()
        .map(|c| {
            let of = PyDict::new(py);
            of.set_item("first_branch", c.branches.0)?;
            of.set_item("last_branch", c.branches.1)?;
            of.set_item("dissipated", c.dissipated)?;
            of.set_item("T", c.T)?;
            of.set_item("delta", c.delta)?;
            of.set_item("stiffness", c.stiffness)?;
            of.set_item("secant_stiffness", c.secant_stiffness())?;
            of.set_item("opening", c.opening)?;
            of.set_item("energy_ratio", c.energy_ratio())?;
            of.set_item("sliding_ratio", c.sliding_ratio())?;
            of.set_item("status", c.status.code())?;
            Ok(of)
        })
        .collect()
}
