//! A store being read.

use std::path::Path;
use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::Scene;
use contact_core::yielding::Yielded;
use ndarray::Array2;
use serde_json::Value;
use zarrs::array::ArraySubset;

use super::catalogue::{PointVariable, YIELDED, from_rows};
use super::consolidated::{Consolidated, FILE};
use super::folder::Folder;
use super::stored::Stored;
use super::whole::{self, Found};

/// Most points of an increment that may have yielded.
const MOST_POINTS: usize = 1 << 24;

/// A result store as it was when it was opened.
pub struct Store {
    folder: Arc<Folder>,
    consolidated: Consolidated,
    scene: Scene,
    increments: usize,
    saved: usize,
}

impl Store {
    /// Opens a store. Fails if there is none, one of another layout, or one whose metadata are
    /// damaged. Values are checked when they are read; [`Self::verify`] checks all of them.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let folder = Folder::new(path.as_ref());
        let consolidated = whole::consolidated(&folder)?;
        Self::from_metadata(folder, consolidated)
    }

    /// Opens a store as [`Self::open`], or a copy without checksums that Python's `save` has
    /// written, to read it alone. Values of a copy are not checked.
    pub fn open_to_read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let folder = Folder::new(path.as_ref());
        let (Found::Store(consolidated) | Found::Copy(consolidated)) = whole::read_folder(&folder)?;
        Self::from_metadata(folder, consolidated)
    }

    /// A store with this metadata; fails if it has no scene, or more increments than the path of the scene.
    fn from_metadata(folder: Arc<Folder>, consolidated: Consolidated) -> Result<Self, Error> {
        let damaged = |e: &dyn std::fmt::Display| folder.error(&format!("{FILE} is damaged: {e}"));
        let attributes = consolidated.document(".zattrs");
        let scene = attributes["scene"]
            .as_str()
            .ok_or_else(|| folder.error(&"holds no scene"))?;
        let file = format!("scene in {}", folder.root().display());
        let scene = Scene::from_toml_str(scene, &file, &[])?;
        // A store that has only been begun holds no variable.
        let length = |name: &str| consolidated.length(name);
        let (increments, saved) = (length("increment"), length("saved_increment"));
        if saved > increments || increments > scene.path.increments() {
            return Err(damaged(&format!(
                "fields of {saved} and scalars of {increments} increments, for a path of {}",
                scene.path.increments()
            )));
        }
        Ok(Self {
            folder,
            consolidated,
            scene,
            increments,
            saved,
        })
    }

    /// Fails if a file of the store is missing, or is not as it was written; the error names it.
    pub fn verify(&self) -> Result<(), Error> {
        whole::verify(&self.folder, &self.consolidated)
    }

    /// Fails if a chunk of an array is missing or damaged that holds entries of the first axis from
    /// `first` to before `end`. Entries beyond the array as it was opened are left out.
    pub fn verify_part(&self, name: &str, first: u64, end: u64) -> Result<(), Error> {
        let stored = self.array(name)?;
        let shape = stored.shape();
        let mut ranges: Vec<_> = shape.iter().map(|n| 0..*n).collect();
        ranges[0] = first.min(shape[0])..end.min(shape[0]);
        let verified = stored.verify(&ArraySubset::new_with_ranges(&ranges));
        verified.map_err(|e| self.folder.error(&format!("{name}: {e}")))
    }

    /// Opens a store and checks all of it. If the store is being written meanwhile, it tries again.
    pub fn open_whole(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let mut store = Self::open(path)?;
        loop {
            let Err(error) = store.verify() else {
                return Ok(store);
            };
            let again = Self::open(path)?;
            if again.consolidated == store.consolidated {
                return Err(error);
            }
            store = again;
        }
    }

    /// The attributes of the group: the scene, the version, how the run ended.
    pub fn attributes(&self) -> &Value {
        self.consolidated.document(".zattrs")
    }

    /// The folder of the store.
    pub(super) fn folder(&self) -> &Arc<Folder> {
        &self.folder
    }

    /// The metadata documents of the group and the arrays, and the checksums.
    pub(super) fn consolidated(&self) -> &Consolidated {
        &self.consolidated
    }

    /// The scene that was solved.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// `running`, `done` or the reason why the run stopped.
    pub fn status(&self) -> &str {
        self.consolidated.document(".zattrs")["status"]
            .as_str()
            .unwrap_or_default()
    }

    /// Increments solved.
    pub fn increments(&self) -> usize {
        self.increments
    }

    /// Increments whose fields are saved.
    pub fn saved(&self) -> usize {
        self.saved
    }

    /// The values of a variable over `increment`, `saved`, `x` or `y`.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Error> {
        let failed = |e: &dyn std::fmt::Display| self.folder.error(&format!("{name}: {e}"));
        let stored = self.array(name)?;
        let grid = &self.scene.grid;
        let longest = self.increments.max(grid.nx).max(grid.ny) as u64;
        let shape = stored.shape();
        if shape.len() != 1 || shape[0] > longest {
            return Err(failed(&format!("is of shape {shape:?}, no column")));
        }
        stored.numbers(&stored.whole()).map_err(|e| failed(&e))
    }

    /// A field of the `saved`-th (from 0) of the increments whose fields are saved. A mask has 0 and 1.
    pub fn field(&self, name: &str, saved: usize) -> Result<Array2<f64>, Error> {
        let failed = |e: &dyn std::fmt::Display| self.folder.error(&format!("{name}: {e}"));
        let stored = self.array(name)?;
        let (nx, ny) = (self.scene.grid.nx, self.scene.grid.ny);
        let part = saved as u64..saved as u64 + 1;
        let part = ArraySubset::new_with_ranges(&[part, 0..nx as u64, 0..ny as u64]);
        let values = stored.numbers(&part).map_err(|e| failed(&e))?;
        Array2::from_shape_vec((nx, ny), values).map_err(|e| failed(&e))
    }

    /// Columns of the yielded points in all increments whose fields are saved, one for each of [`YIELDED`]; no
    /// columns if the bodies stay elastic.
    pub(super) fn points(&self) -> Result<Vec<Vec<f64>>, Error> {
        if !self.scene.yields() || self.consolidated.length(YIELDED[0].name) == 0 {
            return Ok(Vec::new());
        }
        let longest = self.saved.saturating_mul(MOST_POINTS) as u64;
        let column = |variable: &PointVariable| {
            let failed =
                |e: &dyn std::fmt::Display| self.folder.error(&format!("{}: {e}", variable.name));
            let stored = self.array(variable.name)?;
            let shape = stored.shape();
            if shape.len() != 1 || shape[0] > longest {
                return Err(failed(&format!(
                    "is of shape {shape:?}, no column of points"
                )));
            }
            stored.numbers(&stored.whole()).map_err(|e| failed(&e))
        };
        let points: Vec<Vec<f64>> = YIELDED.iter().map(column).collect::<Result<_, _>>()?;
        if points.iter().any(|column| column.len() != points[0].len()) {
            let message = "the columns of the points that have yielded differ in length";
            return Err(self.folder.error(&message));
        }
        Ok(points)
    }

    /// The plastic state after the increment of a number, from 1. It has no points if nothing has yielded;
    /// `None` if the bodies stay elastic.
    pub fn yielded(&self, increment: usize) -> Result<Option<Yielded>, Error> {
        if !self.scene.yields() {
            return Ok(None);
        }
        let mut points = self.points()?;
        if let Some(increments_of_points) = points.first() {
            let is_wanted = increments_of_points
                .iter()
                .map(|n| *n as usize == increment);
            let is_wanted: Vec<bool> = is_wanted.collect();
            for column in &mut points {
                let mut mine = is_wanted.iter();
                column.retain(|_| mine.next().copied().unwrap_or(false));
            }
        }
        Ok(Some(from_rows(&points)))
    }

    /// The relative error bar of the stress below the branch of an increment, from 1; `None` if the
    /// run has none. Stores of older versions have error bars of pressure and shear as fields.
    pub fn stress_error(&self, increment: usize) -> Result<Option<f64>, Error> {
        let bars = &self.attributes()["error_bars"];
        if bars.is_null() {
            return Ok(None);
        }
        let branches = self.column("branch_of_increment")?;
        let branch = increment.checked_sub(1).and_then(|row| branches.get(row));
        let bar = |name: &str| bars[*branch? as usize][name]["total"].as_f64();
        let fields = bar("p").zip(bar("q")).map(|(p, q)| p.hypot(q));
        Ok(bar("stress").or(fields))
    }

    /// An array of the store by its name.
    fn array(&self, name: &str) -> Result<Stored<'_>, Error> {
        whole::array(&self.folder, &self.consolidated, name)
    }
}
