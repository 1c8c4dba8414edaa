//! Load paths from waypoint to waypoint, given or measured.

use std::collections::BTreeMap;

use contact_core::Error;
use contact_core::scene as core;

use super::LoadPath;
use super::forces::{Force, values_and_units};
use super::increments::{AnyIncrements, Names};
use super::load_path::{checked, written};
use crate::error::Answer;
use crate::prelude::*;

#[pymethods]
impl LoadPath {
    /// Go straight from waypoint to waypoint, a branch for each.
    ///
    /// Parameters
    /// ----------
    /// increments : int, PerRange or "auto"
    ///     Increments per branch; or as many as the change needs; or (default) as many as the path
    ///     tolerance of the settings takes. A dense recording takes 1.
    /// **columns : array
    ///     Loads (``W``, ``T_x``, ...), motions (``delta_x``, ...), ``sigma_B``, ``sigma_B1``,
    ///     ``rolled`` and the path time ``t`` at the waypoints. What has no column stays as it is.
    #[pyo3(signature = (*, increments = AnyIncrements::Chosen, **columns: "Sequence[float] | NDArray[np.float64]"))]
    fn waypoints(
        &self,
        increments: AnyIncrements,
        columns: Option<BTreeMap<String, List<f64>>>,
    ) -> Answer<Self> {
        let columns = columns.unwrap_or_default();
        let rows = columns
            .values()
            .map(|column| column.len())
            .max()
            .unwrap_or(0);
        if let Some((name, column)) = columns.iter().find(|(_, c)| c.len() != rows) {
            let allowed = format!("{rows} values, as the longest column");
            let error = Error::invalid(name, format!("{} values", column.len()), allowed);
            return Err(error.into());
        }
        let names: Vec<&str> = columns.keys().map(String::as_str).collect();
        let row = |i: usize| columns.values().map(|column| column[i]).collect();
        let rows: Vec<Vec<f64>> = (0..rows).map(row).collect();
        let path = self.0.clone().waypoints(&names, &rows, increments.into());
        checked(path?)
    }

    /// Swing as a sine about where the path stands.
    ///
    /// It goes straight between `points` points of a period, `periods` times. Several loads swing
    /// together, each with its phase. The first period begins where the path stands, so that the
    /// second one is the cycle that repeats itself.
    ///
    /// Parameters
    /// ----------
    /// periods : int
    ///     Number of periods.
    /// W, T_x, T_y : float, optional
    ///     Amplitudes of forces [N].
    /// M_z : float, optional
    ///     Amplitude of the torsional moment [N m].
    /// delta_x, delta_y : float, optional
    ///     Amplitudes of shifts [m].
    /// phi_z : float, optional
    ///     Amplitude of the rotation [rad].
    /// sigma_B, sigma_B1 : float, optional
    ///     Amplitudes of the bulk stresses of body 2 and body 1 [Pa].
    /// phase : float or dict, optional
    ///     Phase [rad] of all, or by name: ``{"sigma_B": np.pi / 2}``.
    /// points : int
    ///     Points of a period (default: 16), with the turning points of every load added. Loads out
    ///     of phase get 64 points or more, a multiple of it.
    /// increments : int, PerRange or "auto"
    ///     Increments from point to point, as in `waypoints`.
    ///
    /// Examples
    /// --------
    /// >>> LoadPath.start().normal(10.0).sine(2, T_x=2.0)
    /// LoadPath(33 branches, increments to be chosen)
    #[pyo3(signature = (periods: "int", *, W: "Force | None" = None, T_x: "Force | None" = None, T_y: "Force | None" = None, M_z: "Moment | None" = None, delta_x: "Length | None" = None, delta_y: "Length | None" = None, phi_z: "Angle | None" = None, sigma_B: "BulkStress | None" = None, sigma_B1: "BulkStress | None" = None, phase: "float | dict[str, float]" = Phases::All(0.0), points: "int" = 16, increments = AnyIncrements::Chosen))]
    fn sine(
        &self,
        #[pyo3(from_py_with = number)] periods: usize,
        #[pyo3(from_py_with = Force::W)] W: Option<Force>,
        #[pyo3(from_py_with = Force::T_x)] T_x: Option<Force>,
        #[pyo3(from_py_with = Force::T_y)] T_y: Option<Force>,
        #[pyo3(from_py_with = Optional::M_z)] M_z: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_x)] delta_x: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_y)] delta_y: Option<f64>,
        #[pyo3(from_py_with = Optional::phi_z)] phi_z: Option<f64>,
        #[pyo3(from_py_with = Optional::sigma_B)] sigma_B: Option<f64>,
        #[pyo3(from_py_with = Optional::sigma_B1)] sigma_B1: Option<f64>,
        phase: Phases,
        #[pyo3(from_py_with = number)] points: usize,
        increments: AnyIncrements,
    ) -> Answer<Self> {
        let ([W, T_x, T_y], units) = values_and_units([W, T_x, T_y]);
        let swinging = [
            ("W", W),
            ("T_x", T_x),
            ("T_y", T_y),
            ("M_z", M_z),
            ("delta_x", delta_x),
            ("delta_y", delta_y),
            ("phi_z", phi_z),
            ("sigma_B", sigma_B),
            ("sigma_B1", sigma_B1),
        ];
        let amplitudes = swinging
            .into_iter()
            .filter_map(|(name, value)| Some((name, value?)));
        let swings: Vec<core::Swing<'_>> = amplitudes
            .map(|(name, amplitude)| (name, amplitude, phase.phase_of(name)))
            .collect();
        if swings.is_empty() {
            refuse!("sine: give the amplitude of a load or motion, such as T_x=100.0");
        }
        if let Phases::Named(phases) = &phase
            && let Some(name) = phases
                .keys()
                .find(|name| !swings.iter().any(|s| s.0 == *name))
        {
            refuse!("sine: phase of {name}, which has no amplitude");
        }
        let path = self
            .0
            .clone()
            .sine(&swings, (periods, points), increments.into())?;
        checked(written(path, units))
    }

    /// Follow a periodic function of path time, straight between `points` points of a period.
    ///
    /// Parameters
    /// ----------
    /// function : callable
    ///     Takes the time from 0 to `period`, and gives the loads or motions by name, as
    ///     ``lambda t: {"T_x": 100.0 * np.sin(t), "sigma_B": 2e8 * np.cos(t)}``.
    /// period : float
    ///     Its period. A function that does not return to its start is refused.
    /// periods : int
    ///     How many are followed (default: 2, the second of which repeats itself).
    /// points : int
    ///     Points of a period (default: 64). The turning points of every load are added.
    /// increments : int, PerRange or "auto"
    ///     Increments from point to point, as in `waypoints`.
    ///
    /// Examples
    /// --------
    /// >>> path = LoadPath.start().normal(10.0)
    /// >>> path.from_function(lambda t: {"T_x": abs(t - 0.5)}, period=1.0)
    /// LoadPath(130 branches, increments to be chosen)
    #[pyo3(signature = (function: "Callable[[float], Mapping[str, float]]", *, period: "float", periods: "int" = 2, points: "int" = 64, increments = AnyIncrements::Chosen))]
    #[expect(
        clippy::wrong_self_convention,
        reason = "a path grows from where it stands"
    )]
    fn from_function(
        &self,
        function: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = number)] period: f64,
        #[pyo3(from_py_with = number)] periods: usize,
        #[pyo3(from_py_with = number)] points: usize,
        increments: AnyIncrements,
    ) -> PyResult<Self> {
        let mut names: Vec<String> = Vec::new();
        let row = |time: f64| -> PyResult<Vec<f64>> {
            let values: BTreeMap<String, f64> = function.call1((time,))?.extract()?;
            if names.is_empty() {
                names = values.keys().cloned().collect();
            }
            if !values.keys().eq(&names) {
                refuse!(
                    "function: must give the same loads at all times, {}",
                    names.join(", ")
                );
            }
            Ok(values.into_values().collect())
        };
        let fits = core::LoadPath::check_points(points, periods);
        fits.map_err(crate::error::to_python)?;
        let samples = core::sample_period(row, (period, points))?;
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let path = self
            .0
            .clone()
            .periodic(&names, &samples, (periods, period), increments.into());
        Ok(checked(path.map_err(crate::error::to_python)?)?)
    }

    /// Read a measured history: a table of text whose titles name the columns of `waypoints`.
    ///
    /// Semicolons, tabs, commas or blanks part its numbers, with decimal points or commas. Units
    /// stand in the titles, ``T_x [kN]``, or in a row between titles and numbers.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file.
    /// increments : int, PerRange or "auto"
    ///     Increments per branch, as in `waypoints` (default: 1, since a recording is dense).
    /// drive : str or list of str, optional
    ///     The one that drives, where the file has both a load and its motion, as every measured
    ///     loop has. The other is left out.
    ///
    /// Raises
    /// ------
    /// StoreError
    ///     If the file cannot be read. The message has the line, the column and the argument to
    ///     give.
    #[staticmethod]
    #[pyo3(signature = (path, *, increments = AnyIncrements::Each(1), drive = Names(Vec::new())))]
    fn from_csv(
        py: Python<'_>,
        path: PathBuf,
        increments: AnyIncrements,
        drive: Names,
    ) -> Answer<Self> {
        let drive: Vec<&str> = drive.0.iter().map(String::as_str).collect();
        let increments = increments.into();
        checked(py.detach(|| core::LoadPath::from_csv(&path, increments, &drive))?)
    }
}

/// Phases of loads that swing [rad]: the same of all, or by name; 0 without one.
#[derive(Clone)]
pub(super) enum Phases {
    All(f64),
    Named(BTreeMap<String, f64>),
}

impl Phases {
    /// The phase of a load or motion \[rad\], 0 if it is not named.
    fn phase_of(&self, name: &str) -> f64 {
        match self {
            Self::All(phase) => *phase,
            Self::Named(phases) => phases.get(name).copied().unwrap_or(0.0),
        }
    }
}

impl<'py> FromPyObject<'_, 'py> for Phases {
    type Error = PyErr;

    /// Takes a phase for all, or a dict by names.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(named) = value.extract::<BTreeMap<String, f64>>() {
            return Ok(Self::Named(named));
        }
        number(&value).map(Self::All)
    }
}
