//! Stress and displacement below the surface.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use contact_core::convolution::Tractions;
use contact_core::scene::{self, ResidualStress};
use contact_store::{ImageData, StressStore, VolumeSink, write_volume};
use contact_subsurface as core;
use contact_subsurface::{Depth, Side};
use ndarray::{Array2, Axis, Ix2};
use numpy::{PyArray2, PyArray3, PyArray4};

use crate::argument::Answer;
use crate::depths::in_layers;
use crate::line::{line, line_if_given};
use crate::prelude::*;
use crate::residual_stress::{Profiles, of_body};
use crate::scene::{Body, Grid};
use crate::states::States;
use crate::yielding::{Eigenstress, of_states};

/// x, y, z and the layer of a point.
type Place = (f64, f64, f64, usize);
/// Numbers for Python, one row per point.
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// Stress [Pa] on a section in several states of a contact, shape (states, 6, depths, places).
///
/// Near the surface tractions vary within the cells. States share the kernels, which cost as much
/// as about ten of them.
#[pyfunction]
#[pyo3(signature = (body, states, z: "Sequence[float]", layer: "Sequence[int]", *, residual = None, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None, body_number: "int" = 2) -> "NDArray[np.float64]")]
pub(crate) fn section_of_states<'py>(
    py: Python<'py>,
    body: Body,
    states: PyRef<'_, States>,
    z: List<f64>,
    layer: List<usize>,
    residual: Profiles,
    #[pyo3(from_py_with = number)] x: Option<f64>,
    #[pyo3(from_py_with = number)] y: Option<f64>,
    #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
    #[pyo3(from_py_with = number)] body_number: u8,
) -> Answer<Bound<'py, PyArray4<f64>>> {
    let (grid, moments) = states.parts();
    let (depths, line, side) = (
        in_layers(&z, &layer)?,
        line(x, y, azimuth)?,
        side(body_number)?,
    );
    let residual = of_body(&body.0, residual)?;
    let section = stoppable(py, |stop| {
        moments.with_states(Some(&residual), stop, |states| {
            core::Section::new(&body.0, side, grid, line, states)?.stress(&depths)
        })
    })??;
    let views: Vec<_> = section.iter().map(|state| state.view()).collect();
    let stacked = ndarray::stack(Axis(0), &views).unwrap_or_default();
    Ok(stacked.into_pyarray(py))
}

/// Tractions on a body, and what they cause below its surface.
///
/// Use :func:`pyfret.subsurface.stress`, which labels what this one gives.
#[pyclass(frozen, module = "pyfret")]
pub(crate) struct Subsurface {
    body: Body,
    grid: Grid,
    side: Side,
    sigma_B: f64,
    residual: ResidualStress,
    eigenstress: Vec<Option<core::Eigenstress>>,
    fields: [Option<Vec<f64>>; 3],
    /// Whether they are tractions of a contact, and the cells that stick.
    rim: bool,
    stick: Option<Vec<bool>>,
    /// The last search, which serves other measures and layers.
    search: Mutex<Option<KeptSearch>>,
}

/// The values at points as rows of an array.
fn rows_of<const R: usize>(values: &[[f64; R]]) -> Array2<f64> {
    Array2::from_shape_fn((values.len(), R), |(n, c)| values[n][c])
}

/// A prepared search for largest values, below a line or anywhere.
#[derive(Clone)]
struct KeptSearch {
    line: core::Line,
    anywhere: bool,
    depths: Vec<Depth>,
    search: Arc<core::BodySearch>,
    /// Once raised, the search has ended early.
    stop: Arc<AtomicBool>,
}

/// Most cells of a grid whose search is kept: it holds about 0.5 kB per cell.
const MOST_SEARCHED: usize = 256 * 256;

/// A largest value: itself, x, y, z, layer, the border that it lies on, its error and its errors by
/// source.
type Judgement = (f64, f64, f64, f64, usize, Option<&'static str>, f64, Errors);

/// Errors by source: along x, y and z, of the tractions and of the solution.
type Errors = (f64, f64, f64, f64, Option<f64>);

/// The errors along x, y, z, by the tractions and by the solution, NaN if unknown.
pub(crate) fn errors(of: core::Errors) -> Errors {
    (
        of.x,
        of.y,
        of.z,
        of.tractions.unwrap_or(f64::NAN),
        of.solution,
    )
}

/// The word for the zone whose border is crossed.
pub(crate) fn zone_name(zone: core::Zone) -> &'static str {
    match zone {
        core::Zone::Contact => "rim",
        core::Zone::Stick => "stick border",
    }
}

impl Subsurface {
    /// The tractions by reference.
    fn tractions(&self) -> Tractions<'_> {
        let [q_x, q_y, p] = &self.fields;
        Tractions {
            q_x: q_x.as_deref(),
            q_y: q_y.as_deref(),
            p: p.as_deref(),
        }
    }

    /// The stick mask of the state, if it has one.
    fn stick(&self) -> Vec<&[bool]> {
        self.stick.iter().map(Vec::as_slice).collect()
    }

    /// Calls `work` with body, grid and the state; `stop` ends it.
    fn with_states<T>(
        &self,
        stop: &Arc<AtomicBool>,
        work: impl FnOnce(&scene::Body, &scene::Grid, core::States<'_>) -> T,
    ) -> T {
        let (tractions, stick) = ([self.tractions()], self.stick());
        let states = core::States {
            tractions: &tractions,
            sigma_B: &[self.sigma_B],
            residual: Some(&self.residual),
            eigenstress: &self.eigenstress,
            stick: self.rim.then_some(&stick[..]),
            stop: stop.clone(),
            continuations: &[],
        };
        work(&self.body.0, &self.grid.0, states)
    }

    /// The search for largest values, kept for other measures and layers.
    fn search(
        &self,
        py: Python<'_>,
        (line, anywhere): (core::Line, bool),
        depths: &[Depth],
        samples: &Array2<f64>,
    ) -> Answer<KeptSearch> {
        let lock = || self.search.lock().unwrap_or_else(PoisonError::into_inner);
        let suits = |kept: &KeptSearch| {
            kept.line == line
                && kept.anywhere == anywhere
                && kept.depths == depths
                && !kept.stop.load(Ordering::Relaxed)
        };
        if let Some(kept) = lock().clone().filter(suits) {
            return Ok(kept);
        }
        let stop: Arc<AtomicBool> = Arc::default();
        let search = interruptible(py, &stop, || {
            self.with_states(&stop, |body, grid, states| {
                let loads = core::Loads {
                    body,
                    side: self.side,
                    grid,
                    states: &states,
                };
                core::BodySearch::new(loads, (line, anywhere), (depths, &samples.view()))
            })
        })??;
        let made = KeptSearch {
            line,
            anywhere,
            depths: depths.to_vec(),
            search: Arc::new(search),
            stop,
        };
        if made.search.serves_all_measures() && self.grid.0.cells() <= MOST_SEARCHED {
            *lock() = Some(made.clone());
        }
        Ok(made)
    }

    /// Prepares planes below the contact.
    fn slices(&self, stop: &Arc<AtomicBool>) -> Result<core::Slices, contact_core::Error> {
        self.with_states(stop, |body, grid, states| {
            core::Slices::new(body, self.side, grid, states)
        })
    }
}

#[pymethods]
impl Subsurface {
    #[new]
    #[pyo3(signature = (body, grid, *, p = None, q_x = None, q_y = None, body_number: "int" = 2, sigma_B: "BulkStress" = 0.0, residual = None, eigenstress: "Sequence[Eigenstress | None] | None" = None, rim = false, stick = None))]
    fn new(
        body: Body,
        grid: Grid,
        p: Option<Field<'_>>,
        q_x: Option<Field<'_>>,
        q_y: Option<Field<'_>>,
        #[pyo3(from_py_with = number)] body_number: u8,
        #[pyo3(from_py_with = Given::sigma_B)] sigma_B: f64,
        residual: Profiles,
        eigenstress: Option<List<Option<Py<Eigenstress>>>>,
        rim: bool,
        stick: Option<Mask<'_, Ix2>>,
    ) -> PyResult<Self> {
        let shape = (grid.0.nx, grid.0.ny);
        let cells = |name: &str, field: Option<Field<'_>>| {
            field.map(|field| field.on_grid(name, &grid.0)).transpose()
        };
        let stick = stick.map(|stick| stick.as_array().to_owned());
        if let Some(stick) = stick.as_ref().filter(|stick| stick.dim() != shape) {
            refuse!(
                "stick has the shape {:?}: must be the grid's, {shape:?}",
                stick.dim()
            );
        }
        Ok(Self {
            rim,
            stick: stick.map(|stick| stick.into_iter().collect()),
            fields: [cells("q_x", q_x)?, cells("q_y", q_y)?, cells("p", p)?],
            side: side(body_number)?,
            sigma_B,
            residual: of_body(&body.0, residual)?,
            eigenstress: of_states(eigenstress),
            body,
            grid,
            search: Mutex::default(),
        })
    }

    /// Stress [Pa] or displacement [m] on a section, shape (6 or 3, depths, places).
    #[pyo3(signature = (z: "Sequence[float]", layer: "Sequence[int]", *, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None, displacement = false) -> "NDArray[np.float64]")]
    fn section<'py>(
        &self,
        py: Python<'py>,
        z: List<f64>,
        layer: List<usize>,
        #[pyo3(from_py_with = number)] x: Option<f64>,
        #[pyo3(from_py_with = number)] y: Option<f64>,
        #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
        displacement: bool,
    ) -> Answer<Bound<'py, PyArray3<f64>>> {
        let (depths, line) = (in_layers(&z, &layer)?, line(x, y, azimuth)?);
        let mut values = stoppable(py, |stop| {
            let section = self.with_states(stop, |body, grid, states| {
                core::Section::new(body, self.side, grid, line, states)
            })?;
            if displacement {
                section.displacement(&depths)
            } else {
                section.stress(&depths)
            }
        })??;
        Ok(values.swap_remove(0).into_pyarray(py))
    }

    /// Stress [Pa] or displacement [m] on a plane, six or three arrays of shape (nx, ny).
    #[pyo3(signature = (z: "float", layer: "int", *, displacement = false) -> "list[NDArray[np.float64]]")]
    fn slice<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] z: f64,
        #[pyo3(from_py_with = number)] layer: usize,
        displacement: bool,
    ) -> Answer<Vec<Bound<'py, PyArray2<f64>>>> {
        let volumes = stoppable(py, |stop| {
            let slices = self.slices(stop)?;
            let depth = Depth { z, layer };
            Ok(if displacement {
                Vec::from(slices.displacement(depth)?.swap_remove(0))
            } else {
                Vec::from(slices.stress(depth)?.swap_remove(0))
            })
        })??;
        Ok(volumes.into_iter().map(|f| f.into_pyarray(py)).collect())
    }

    /// Stress [Pa] or displacement [m] at points x, y, z, layer; shape (n, 6 or 3).
    #[pyo3(signature = (places: "Sequence[tuple[float, float, float, int]]", *, displacement = false) -> "NDArray[np.float64]")]
    fn points<'py>(
        &self,
        py: Python<'py>,
        places: List<Place>,
        displacement: bool,
    ) -> Answer<Matrix<'py>> {
        let places: Vec<_> = places
            .0
            .into_iter()
            .map(|(x, y, z, layer)| (x, y, Depth { z, layer }))
            .collect();
        let values = stoppable(py, |stop| {
            let points = self.with_states(stop, |body, grid, states| {
                core::Points::new(body, self.side, grid, states)
            })?;
            Ok(if displacement {
                rows_of(&points.displacement(&places)?.swap_remove(0))
            } else {
                rows_of(&points.stress(&places)?.swap_remove(0))
            })
        })??;
        Ok(values.into_pyarray(py))
    }

    /// Stress [Pa] on the surface where a line crosses rims and stick borders; shape (n, 6).
    #[pyo3(signature = (*, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None) -> "NDArray[np.float64]")]
    fn border_stress<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] x: Option<f64>,
        #[pyo3(from_py_with = number)] y: Option<f64>,
        #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
    ) -> Answer<Matrix<'py>> {
        let line = line(x, y, azimuth)?;
        let stress = stoppable(py, |stop| {
            let points = self.with_states(stop, |body, grid, states| {
                core::Points::new(body, self.side, grid, states)
            })?;
            let borders = points.borders(0, Some(line));
            let surface = Depth { z: 0.0, layer: 0 };
            let places: Vec<_> = borders.iter().map(|b| (b.x, b.y, surface)).collect();
            Ok(rows_of(&points.stress(&places)?.swap_remove(0)))
        })??;
        Ok(stress.into_pyarray(py))
    }

    /// Largest value of a measure on a section, between its samples; in the layer `only`.
    ///
    /// Gives the value, x, y, z, the layer, the border on which it lies, its error and the parts of
    /// this error. The parts are those along x, y and z, of the tractions and of the solution. The
    /// last follows from the `error_bar` of the stress over the stress. Then come the layers whose
    /// stress still rises at the end of the longest section. `anywhere`: also beside the section.
    #[pyo3(signature = (
        of, samples, z: "Sequence[float]", layer: "Sequence[int]", *, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None, only: "int | None" = None, anywhere = false,
        error_bar: "float | None" = None
    ))]
    fn maximum(
        &self,
        py: Python<'_>,
        of: &str,
        samples: Field<'_>,
        z: List<f64>,
        layer: List<usize>,
        #[pyo3(from_py_with = number)] x: Option<f64>,
        #[pyo3(from_py_with = number)] y: Option<f64>,
        #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
        #[pyo3(from_py_with = number)] only: Option<usize>,
        anywhere: bool,
        #[pyo3(from_py_with = number)] error_bar: Option<f64>,
    ) -> Answer<(Option<Judgement>, Vec<usize>)> {
        let (depths, line) = (in_layers(&z, &layer)?, line(x, y, azimuth)?);
        let grid = &self.grid.0;
        let along = line.places(grid);
        let samples = samples.as_array().to_owned();
        if samples.dim() != (depths.len(), along.len()) {
            refuse!(
                "the samples have the shape {:?}: must be {:?}",
                samples.dim(),
                (depths.len(), along.len())
            );
        }
        let measure = core::find_measure(of)
            .ok_or_else(|| PyValueError::new_err(format!("{of:?}: is no measure of stress")))?;
        let kept = self.search(py, (line, anywhere), &depths, &samples)?;
        let find = || kept.search.find(measure, &samples.view(), only);
        let extremum = interruptible(py, &kept.stop, find)??;
        let largest = extremum.largest.map(|m| {
            let m = error_bar.map_or(m, |stress| m.with_error_bars(stress));
            let at = m.at.map(zone_name);
            (
                m.value,
                m.x,
                m.y,
                m.depth.z,
                m.depth.layer,
                at,
                m.error.total(),
                errors(m.error),
            )
        });
        Ok((largest, extremum.still_rises))
    }

    /// Crossings of a line, or of the lines of all cells, with rims of contact and stick zone.
    ///
    /// x, y, which of them, and whether the place is known within a cell.
    #[pyo3(signature = (*, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None))]
    fn borders(
        &self,
        #[pyo3(from_py_with = number)] x: Option<f64>,
        #[pyo3(from_py_with = number)] y: Option<f64>,
        #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
    ) -> Answer<Vec<(f64, f64, &'static str, bool)>> {
        let along = line_if_given(x, y, azimuth)?;
        let stick = self.stick.as_deref();
        let borders = core::borders(&self.grid.0, &self.tractions(), stick, along);
        let row = |b: core::Border| (b.x, b.y, zone_name(b.zone), b.within_cell);
        Ok(borders?.into_iter().map(row).collect())
    }

    /// Write measures of stress, and displacements, to a .vti file or a Zarr folder.
    #[pyo3(signature = (out, z: "Sequence[float]", layer: "Sequence[int]", *, of, title = ""))]
    fn volume(
        &self,
        py: Python<'_>,
        out: PathBuf,
        z: List<f64>,
        layer: List<usize>,
        of: List<String>,
        title: &str,
    ) -> Answer<()> {
        let depths = in_layers(&z, &layer)?;
        let probes = of.iter().map(|name| core::Probe::find(name, "of"));
        let probes: Vec<_> = probes.collect::<Result<_, _>>()?;
        let (grid, side, stop) = (&self.grid.0, self.side, Arc::default());
        let write = || {
            let slices = self.slices(&stop)?;
            let write = |sink: &dyn VolumeSink| {
                write_volume(&slices, &depths, &[], &probes, &[sink], None).map(drop)
            };
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
        Ok(interruptible(py, &stop, write)??)
    }
}

attributes!(Subsurface, self:
    /// Whether the tractions are tractions of a contact.
    rim: bool = self.rim;
);
