//! A store being read.

use std::path::Path;
use std::sync::Arc;

use ndarray::Array2;
use serde_json::Value;
use zarrs::array::{Array, ArraySubset};

use super::SCHEMA;
use super::folder::Folder;
use super::variable::{numbers, open_array};
use crate::error::Error;
use crate::scene::Scene;

/// A result store as it was when it was opened.
pub struct Store {
    folder: Arc<Folder>,
    /// The consolidated metadata.
    metadata: Value,
    scene: Scene,
    increments: usize,
    saved: usize,
}

impl Store {
    /// Opens a store; fails if there is none, or one of another layout.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let folder = Folder::new(path.as_ref());
        let text = folder
            .read(".zmetadata")
            .map_err(|e| folder.error(&e))?
            .ok_or_else(|| folder.error(&"is not a result store (it has no .zmetadata)"))?;
        let document: Value = serde_json::from_slice(&text)
            .map_err(|e| folder.error(&format!(".zmetadata is damaged: {e}")))?;
        let metadata = &document["metadata"];
        let attributes = &metadata[".zattrs"];
        if attributes["schema"] != SCHEMA {
            return Err(folder.error(&format!(
                "is a store of schema {}: this version reads schema {SCHEMA}",
                attributes["schema"]
            )));
        }
        let scene = attributes["scene"]
            .as_str()
            .ok_or_else(|| folder.error(&"holds no scene"))?;
        let file = format!("scene in {}", folder.root().display());
        let scene = Scene::from_toml_str(scene, &file, &[])?;
        // A store that has only been begun holds no variable.
        let length = |name: &str| {
            let length = &metadata[format!("{name}/.zarray")]["shape"][0];
            length.as_u64().unwrap_or(0) as usize
        };
        let (increments, saved) = (length("increment"), length("saved_increment"));
        if saved > increments || increments > scene.path.increments() {
            return Err(folder.error(&format!(
                ".zmetadata is damaged: fields of {saved} and scalars of {increments} increments, \
                 for a path of {}",
                scene.path.increments()
            )));
        }
        Ok(Self {
            increments,
            saved,
            metadata: metadata.clone(),
            folder,
            scene,
        })
    }

    pub(super) fn folder(&self) -> &Arc<Folder> {
        &self.folder
    }

    /// The metadata documents of the group and the arrays.
    pub(super) fn metadata(&self) -> &Value {
        &self.metadata
    }

    /// The scene that was solved.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// `running`, `done` or the sentence that says why the run stopped.
    pub fn status(&self) -> &str {
        self.metadata[".zattrs"]["status"]
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

    /// A variable over `increment`, `saved`, `x` or `y`.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Error> {
        let (array, dtype) = self.array(name)?;
        let grid = &self.scene.grid;
        let longest = self.increments.max(grid.nx).max(grid.ny) as u64;
        if array.shape().len() != 1 || array.shape()[0] > longest {
            let shape = array.shape();
            return Err(self
                .folder
                .error(&format!("{name}: is of shape {shape:?}, no column")));
        }
        numbers(&array, dtype, &array.subset_all())
            .map_err(|e| self.folder.error(&format!("{name}: {e}")))
    }

    /// A field of the `saved`-th increment whose fields are saved, from 0; a mask is 0 and 1.
    pub fn field(&self, name: &str, saved: usize) -> Result<Array2<f64>, Error> {
        let failed = |e: &dyn std::fmt::Display| self.folder.error(&format!("{name}: {e}"));
        let (array, dtype) = self.array(name)?;
        let (nx, ny) = (self.scene.grid.nx, self.scene.grid.ny);
        let part = saved as u64..saved as u64 + 1;
        let part = ArraySubset::new_with_ranges(&[part, 0..nx as u64, 0..ny as u64]);
        let values = numbers(&array, dtype, &part).map_err(|e| failed(&e))?;
        Array2::from_shape_vec((nx, ny), values).map_err(|e| failed(&e))
    }

    fn array(&self, name: &str) -> Result<(Array<Folder>, Option<&str>), Error> {
        let zarray = &self.metadata[format!("{name}/.zarray")];
        if zarray.is_null() {
            return Err(self.folder.error(&format!("holds no {name}")));
        }
        let array = open_array(&self.folder, name, zarray.clone())?;
        Ok((array, zarray["dtype"].as_str()))
    }
}
