//! Errors, with the numbers that explain them.

use std::fmt::Display;
use std::sync::Arc;

use crate::digits::short;

/// Error of a law or of a step of another crate, which reaches the caller unchanged.
pub type LawError = Arc<dyn std::error::Error + Send + Sync>;

/// An error that was not made here; equal to itself alone.
#[derive(Clone, Debug)]
pub struct Raised(pub LawError);

impl PartialEq for Raised {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Display for Raised {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        Display::fmt(&self.0, f)
    }
}

/// Every failure of the core, for people: what is wrong, where, what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value of the scene is out of its range.
    #[error("{key} = {value}: must be {allowed}")]
    InvalidScene {
        /// Key of the value, as in the scene file.
        key: String,
        /// The value found.
        value: String,
        /// Description of the allowed values.
        allowed: String,
    },
    /// A friction law of the user's own has raised an error.
    #[error("friction.law: {raised}")]
    FrictionLaw {
        /// The error of the law.
        raised: Raised,
    },
    /// A scene file does not follow the schema.
    #[error("{file}:{line}: {message}")]
    SceneFile {
        /// Name of the file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong and what is allowed.
        message: String,
    },
    /// Values that come from no file do not follow the schema.
    #[error("{message}")]
    Values {
        /// The key, its fault and the allowed values.
        message: String,
    },
    /// A scene file is wrong in several places, or doubtful beside one.
    #[error("{}", join_lines(errors, doubts))]
    SceneFaults {
        /// Each of [`Self::SceneFile`] or [`Self::Setting`], in the order of the file.
        errors: Vec<Error>,
        /// Doubts about values that could be read.
        doubts: Vec<String>,
    },
    /// A value set from outside the scene file (`--set key=value`) is wrong.
    #[error("setting {setting}: {message}")]
    Setting {
        /// The setting, `key=value`.
        setting: String,
        /// What is wrong and what is allowed.
        message: String,
    },
    /// The contact reaches the border of the grid.
    #[error(
        "the contact touches the border of the grid at increment {increment} (W = {} {unit}). \
         The grid is {extent_x:.4e} m by {extent_y:.4e} m and should be about {needed:.4e} m wide",
        short(*W)
    )]
    OffGrid {
        /// Increment, from 1.
        increment: usize,
        /// Normal force \[N\], and its unit, in line contacts N/m.
        W: f64,
        /// See `W`.
        unit: &'static str,
        /// Length of the grid along x \[m\].
        extent_x: f64,
        /// Length of the grid along y \[m\].
        extent_y: f64,
        /// Recommended length \[m\].
        needed: f64,
    },
    /// The worn contact reaches the border of the grid.
    #[error(
        "after {cycles:.6e} cycles the worn contact reaches the border of the grid, or slides over it. \
         The grid is {extent_x:.4e} m by {extent_y:.4e} m and should be about {needed_x:.4e} m by {needed_y:.4e} m"
    )]
    WornOffGrid {
        /// Cycles up to which all is well.
        cycles: f64,
        /// Length of the grid along x \[m\].
        extent_x: f64,
        /// Length of the grid along y \[m\].
        extent_y: f64,
        /// Recommended length along x \[m\].
        needed_x: f64,
        /// Recommended length along y \[m\].
        needed_y: f64,
    },
    /// The contact is certain to leave the grid, before anything is solved.
    #[error(
        "the contact does not fit on the grid: under W = {} {unit} its radius is {a:.4e} m at least. The grid \
         is {extent_x:.4e} m by {extent_y:.4e} m and should be about {needed:.4e} m wide{doubt}",
        short(*W)
    )]
    GridTooSmall {
        /// Largest normal force \[N\], and its unit, in line contacts N/m.
        W: f64,
        /// See `W`.
        unit: &'static str,
        /// Smallest radius that the contact can have \[m\].
        a: f64,
        /// Length of the grid along x \[m\].
        extent_x: f64,
        /// Length of the grid along y \[m\].
        extent_y: f64,
        /// Recommended length \[m\].
        needed: f64,
        /// Doubtful values of the scene, as the end of a sentence; empty without any.
        doubt: String,
    },
    /// The tangential forces and the torsional moment are more than friction can carry.
    #[error(
        "increment {increment}: the tangential loads are {used:.6} times what friction can carry; \
         give the shift instead of the force to slide further"
    )]
    BeyondFriction {
        /// Increment, from 1.
        increment: usize,
        /// Loads over the limit.
        used: f64,
    },
    /// A load whose motion is free is carried by nothing.
    #[error(
        "increment {increment}: nothing resists {load} = {value}: {why}, and {motion} is free; \
         give {motion} instead of {load}"
    )]
    Unresisted {
        /// Increment, from 1.
        increment: usize,
        /// The load, by its name in the scene.
        load: &'static str,
        /// Its value \[N, N m\].
        value: f64,
        /// The missing thing.
        why: &'static str,
        /// The motion that is free, by its name in the scene.
        motion: &'static str,
    },
    /// Friction without a limit would have to hold cells that their shear lifts.
    #[error(
        "increment {increment}: no contact that sticks everywhere carries these loads. Of {contact} cells in contact \
         shear lifts {lifted}, {within} of them within the contact. Give a finite mu, which lets them slip"
    )]
    Lifted {
        /// Increment, from 1.
        increment: usize,
        /// Cells in contact.
        contact: usize,
        /// Cells of these that their shear would lift.
        lifted: usize,
        /// Cells of these that are surrounded by cells in contact.
        within: usize,
    },
    /// A solver stopped before its tolerance.
    #[error(
        "increment {increment}: the {solver} solver stopped at residual {residual:.2e} \
         (tolerance {tolerance:.2e}) after {iterations} iterations{why}"
    )]
    NotConverged {
        /// Increment, from 1.
        increment: usize,
        /// Name of the solver.
        solver: &'static str,
        /// Residual reached, in the unit of the tolerance.
        residual: f64,
        /// Residual asked for.
        tolerance: f64,
        /// Iterations done.
        iterations: usize,
        /// The physical cause, as the end of a sentence; empty if unknown.
        why: String,
    },
    /// The conversion of a frequency response missed its tolerance.
    #[error(
        "the influence coefficients have an estimated error of {estimate:.2e} C33(0,0), \
         more than the {tolerance:.2e} asked for"
    )]
    KernelInaccurate {
        /// Estimated error over C33(0,0).
        estimate: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The conversion of a response to heat missed its tolerance.
    #[error(
        "the temperature coefficients have an estimated error of {estimate:.2e} of the coefficient of the loaded cell, \
         more than {tolerance:.2e}"
    )]
    TemperatureInaccurate {
        /// Estimated error over the coefficient of the loaded cell.
        estimate: f64,
        /// Largest error allowed.
        tolerance: f64,
    },
    /// The heat is not shared out so that the temperatures agree.
    #[error(
        "the temperatures of the bodies in contact differ by {residual:.2e} of themselves (tolerance {tolerance:.2e}) after \
         {iterations} iterations"
    )]
    HeatNotShared {
        /// Root mean square of the difference, over the root mean square of the temperature.
        residual: f64,
        /// Residual asked for.
        tolerance: f64,
        /// Iterations done.
        iterations: usize,
    },
    /// The stress below a loaded cell missed the accuracy promised.
    #[error(
        "the stress coefficients at z = {z:.4e} m have an estimated error of {estimate:.2e} of the \
         traction, more than {tolerance:.2e}"
    )]
    StressInaccurate {
        /// Depth \[m\].
        z: f64,
        /// Estimated error over the traction.
        estimate: f64,
        /// Largest error allowed.
        tolerance: f64,
    },
    /// A file could not be written or read.
    #[error("{path}: {message}")]
    File {
        /// The file or folder.
        path: String,
        /// Message of the operating system.
        message: String,
    },
    /// There is less memory than a scene needs.
    #[error(
        "{what} needs about {:.0} MB of memory, and {:.0} MB are available: a coarser grid, or \
         another machine",
        needed / 1e6, available / 1e6
    )]
    TooLarge {
        /// Purpose of the memory.
        what: &'static str,
        /// Bytes needed.
        needed: f64,
        /// Bytes that there are.
        available: f64,
    },
    /// Error of a step of another crate within ours, unchanged: a fatigue criterion.
    #[error("{0}")]
    Other(Raised),
    /// The run was stopped from outside (Ctrl-C, an observer).
    #[error("stopped after increment {increment}")]
    Interrupted {
        /// Last finished increment.
        increment: usize,
    },
}

/// A line for each error, then for each doubt.
fn join_lines(errors: &[Error], doubts: &[String]) -> String {
    let doubts = doubts.iter().map(|doubt| format!("doubtful: {doubt}"));
    let lines: Vec<_> = errors.iter().map(Error::to_string).chain(doubts).collect();
    lines.join("\n")
}

impl Error {
    /// The line of the scene file that the error is about; 0 where there is none.
    pub fn line(&self) -> usize {
        match self {
            Self::SceneFile { line, .. } => *line,
            _ => 0,
        }
    }

    /// A value out of its range.
    pub fn invalid(
        key: impl Into<String>,
        value: impl Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self::InvalidScene {
            key: key.into(),
            value: value.to_string(),
            allowed: allowed.into(),
        }
    }
}
