//! Stress and energy over a load path.

use std::sync::atomic::AtomicBool;

use contact_core::march;
use contact_core::zones::slip_cells;
use contact_subsurface as core;
use contact_subsurface::{Line, Stream};
use ndarray::{Array1, Array2, Axis, Ix2};

use crate::argument::Answer;
use crate::depths::in_layers;
use crate::line::line_if_given;
use crate::prelude::*;
use crate::residual_stress::Profiles;
use crate::scene::{Body, Grid, LoadPath};
use crate::stress::measures;
use crate::yielding::Eigenstress;

/// Extremes of stress below a line; use :func:`pyfret.subsurface.envelope`.
#[pyclass(module = "pyfret")]
pub(crate) struct Envelope {
    stream: Option<Stream<(core::Envelope, core::Largest)>>,
    largest: core::Largest,
    names: Vec<String>,
    cycles: Vec<(usize, usize)>,
    /// Whether it is that below a line.
    of_line: bool,
}

#[pymethods]
impl Envelope {
    #[new]
    #[pyo3(signature = (body, grid, path, z: "Sequence[float]", layer: "Sequence[int]", *, of, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None, body_number: "int" = 2, residual = None))]
    fn new(
        py: Python<'_>,
        body: Body,
        grid: Grid,
        path: LoadPath,
        z: List<f64>,
        layer: List<usize>,
        of: List<String>,
        #[pyo3(from_py_with = number)] x: Option<f64>,
        #[pyo3(from_py_with = number)] y: Option<f64>,
        #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
        #[pyo3(from_py_with = number)] body_number: u8,
        residual: Profiles,
    ) -> Answer<Self> {
        let cycles = path.0.cycles();
        let line = line_if_given(x, y, azimuth)?;
        let along = line.map_or_else(Vec::new, |line| line.places(&grid.0));
        let of_largest = line.unwrap_or(Line::AlongX(0.0));
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
                line: of_largest,
                along,
            },
        );
        let depths = in_layers(&z, &layer)?;
        let side = side(body_number)?;
        let largest = accumulate.1.clone();
        let residual = residual
            .unwrap_or_default()
            .into_iter()
            .map(|layer| layer.0);
        let residual: Vec<_> = residual.collect();
        let new = || {
            let stream = Stream::new(&body.0, side, &grid.0, line, depths, accumulate)?;
            stream.residual(&residual)
        };
        let stream = interruptible(py, &Arc::default(), new)?;
        let stream = stream?;
        Ok(Self {
            stream: Some(stream.rim(true)),
            largest,
            names: of.0,
            cycles,
            of_line: line.is_some(),
        })
    }

    /// Take an increment: tractions [Pa], cells that stick, bulk stress of the body [Pa].
    #[pyo3(signature = (increment: "int", branch: "int", *, p, q_x, q_y, stick, sigma_B: "BulkStress" = 0.0, eigenstress: "Eigenstress | None" = None))]
    fn push(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = number)] increment: usize,
        #[pyo3(from_py_with = number)] branch: usize,
        p: Field<'_>,
        q_x: Field<'_>,
        q_y: Field<'_>,
        stick: Mask<'_, Ix2>,
        #[pyo3(from_py_with = Given::sigma_B)] sigma_B: f64,
        eigenstress: Option<Py<Eigenstress>>,
    ) -> Answer<()> {
        let tractions = [q_x, q_y, p].map(|f| f.as_array().as_standard_layout().into_owned());
        let mut stream = self.stream.take().ok_or_else(finished)?;
        let moment = core::Moment {
            increment,
            branch,
            sigma_B,
        };
        let stick = stick.as_array().as_standard_layout().into_owned();
        let stop = Arc::<AtomicBool>::default();
        stream.stop_on(stop.clone());
        let eigenstress = eigenstress.map(|left| left.get().0.clone());
        let push = || stream.push(moment, tractions, stick, eigenstress);
        interruptible(py, &stop, push)??;
        self.stream = Some(stream);
        Ok(())
    }

    /// Give the extremes of every measure.
    #[pyo3(signature = () -> "dict[str, dict[str, NDArray[np.float64]]]")]
    fn finish<'py>(&mut self, py: Python<'py>) -> Answer<Bound<'py, PyDict>> {
        let mut stream = self.stream.take().ok_or_else(finished)?;
        let stop = Arc::<AtomicBool>::default();
        stream.stop_on(stop.clone());
        let (_, kept) = interruptible(py, &stop, || stream.finish())??;
        let (kept, tops): (Vec<_>, Vec<_>) = kept.into_iter().unzip();
        let largest = self.largest.over_depths(&tops);
        let result = PyDict::new(py);
        for (m, name) in self.names.iter().enumerate() {
            let rows = |of: &dyn Fn(&core::DepthEnvelope) -> Array1<f64>| {
                let rows: Vec<_> = kept.iter().map(of).collect();
                let views: Vec<_> = rows.iter().map(|r| r.view()).collect();
                ndarray::stack(Axis(0), &views).unwrap_or_default()
            };
            let row = |a: &Array2<f64>| a.row(m).to_owned();
            let extremes = PyDict::new(py);
            extremes.set_item("max", rows(&|k| row(&k.path.max)).into_pyarray(py))?;
            extremes.set_item("min", rows(&|k| row(&k.path.min)).into_pyarray(py))?;
            let when = rows(&|k| k.path.increment_of_max.row(m).mapv(|n| n as f64));
            extremes.set_item("increment", when.into_pyarray(py))?;
            let cycles = |extremes: &dyn Fn(&core::Extremes) -> Array2<f64>| -> Vec<_> {
                (0..self.cycles.len())
                    .map(|c| rows(&|k| row(&extremes(&k.cycles[c]))).into_pyarray(py))
                    .collect()
            };
            extremes.set_item("amplitude", cycles(&core::Extremes::amplitude))?;
            extremes.set_item("mean", cycles(&core::Extremes::mean))?;
            if self.of_line {
                let rows = largest.iter().filter_map(|(moment, extremes)| {
                    let m = extremes[m]?;
                    let layer = m.depth.layer as f64;
                    Some([
                        moment.increment as f64,
                        m.value,
                        self.largest.line.nearest_distance(m.x, m.y),
                        m.depth.z,
                        layer,
                        m.error.total(),
                    ])
                });
                let rows = Array2::from(rows.collect::<Vec<_>>());
                extremes.set_item("largest", rows.into_pyarray(py))?;
            }
            result.set_item(name, extremes)?;
        }
        Ok(result)
    }
}

attributes!(Envelope, self:
    /// First and last branch of every cycle.
    cycles: Vec<(usize, usize)> = self.cycles.clone();
);

/// The error of a call after the end.
fn finished() -> PyErr {
    PyValueError::new_err("the envelope has been finished, or was stopped on the way")
}

/// Energy and stiffness of every cycle of a history; use :meth:`pyfret.Result.loops`.
#[pyfunction]
#[pyo3(signature = (path, *, torsion: "bool", branch: "Sequence[int]", T: "Sequence[float]", delta: "Sequence[float]", dissipated: "Sequence[float]", status: "Sequence[int]", grid: "Grid", contact_area: "Sequence[float]", stick_ratio: "Sequence[float]", errors: "Sequence[Sequence[float]]") -> "list[dict[str, float]]")]
pub(crate) fn loops(
    py: Python<'_>,
    path: LoadPath,
    torsion: bool,
    branch: List<usize>,
    T: List<f64>,
    delta: List<f64>,
    dissipated: List<f64>,
    status: List<u8>,
    grid: Grid,
    contact_area: List<f64>,
    stick_ratio: List<f64>,
    errors: List<[f64; 3]>,
) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let history: Vec<core::LoopPoint> = branch
        .iter()
        .zip(T.iter())
        .zip(delta.iter())
        .zip(dissipated.iter())
        .zip(status.iter())
        .zip(contact_area.iter().zip(stick_ratio.iter()))
        .map(
            |(((((&branch, &T), &delta), &dissipated), &status), (&area, &stick))| {
                core::LoopPoint {
                    branch,
                    T,
                    delta,
                    dissipated,
                    status: march::Status::ALL[usize::from(status).min(3)],
                    slip_cells: slip_cells(&grid.0, area, stick),
                }
            },
        )
        .collect();
    let direction = if torsion {
        core::Direction::Torsion
    } else {
        core::Direction::X
    };
    core::loops(&path.0, direction, &history)
        .iter()
        .map(|c| {
            let fields = PyDict::new(py);
            fields.set_item("first_branch", c.branches.0)?;
            fields.set_item("last_branch", c.branches.1)?;
            let of_cycle = c.errors(&errors, grid.0.plane_strain);
            fields.set_item("dissipated", c.dissipated)?;
            fields.set_item("dissipated_error", of_cycle.dissipated)?;
            fields.set_item("T", c.T)?;
            fields.set_item("delta", c.delta)?;
            fields.set_item("stiffness", c.stiffness)?;
            fields.set_item("stiffness_error", c.stiffness_error)?;
            fields.set_item("secant_stiffness", c.secant_stiffness())?;
            fields.set_item("opening", c.checked_opening())?;
            fields.set_item("opening_error", of_cycle.opening)?;
            fields.set_item("energy_ratio", c.energy_ratio())?;
            fields.set_item("energy_ratio_error", of_cycle.energy_ratio)?;
            fields.set_item("sliding_ratio", c.sliding_ratio())?;
            fields.set_item("sliding_ratio_error", of_cycle.sliding_ratio)?;
            fields.set_item("status", c.status.code())?;
            Ok(fields)
        })
        .collect()
}
