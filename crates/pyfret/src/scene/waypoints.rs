//! Load paths from waypoint to waypoint, given or measured.

use std::collections::BTreeMap;

use contact_core::Error;
use contact_core::scene as core;

use super::LoadPath;
use super::increments::{AnyIncrements, Names};
use super::load_path::checked;
use crate::error::Answer;
use crate::prelude::*;

#[pymethods]
impl LoadPath {
    /// Go straight from waypoint to waypoint, a branch for each.
    ///
    /// Parameters
    /// ----------
    /// increments : int, PerRange or "auto"
    ///     Increments per branch; or as many as the change needs; or as the path tolerance of the
    ///     settings asks for.
    /// **columns : array
    ///     Loads (``W``, ``T_x``, ...), motions (``delta_x``, ...), ``sigma_B``, ``sigma_B1``,
    ///     ``rolled`` and the path time ``t`` at the waypoints. What has no column stays as it is.
    #[pyo3(signature = (*, increments = AnyIncrements::Each(1), **columns: "Sequence[float] | NDArray[np.float64]"))]
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
    ///     Increments per branch, as in `waypoints`.
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
