//! The store being written.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::catalogue::{FIELDS, FieldView, Kind, SCALARS, STATUS_MEANINGS};
use super::folder::Folder;
use super::reader::Store;
use super::variable::{Column, Variable};
use crate::error::Error;
use crate::march::{Fields, Increment, March, Observer};
use crate::scene::{LoadPoint, Plan, Scene};

/// Time between two flushes: what a crash may lose. A flush replaces some eighty small files.
const FLUSH_INTERVAL: Duration = Duration::from_secs(5);

/// Appends a run to a store while it goes on. Give it to [`crate::march::solve`].
pub struct StoreWriter {
    path: PathBuf,
    overwrite: bool,
    flush_interval: Duration,
    open: Option<Open>,
}

/// A store that has been begun.
struct Open {
    folder: Arc<Folder>,
    attributes: Map<String, Value>,
    /// Over `increment`, as in [`SCALARS`].
    scalars: Vec<Column>,
    /// x, y, `saved_increment`, `saved_t`.
    others: Vec<Column>,
    fields: Vec<Variable>,
    last: Option<(usize, LoadPoint)>,
    saved: usize,
    saved_increment: usize,
    /// Metadata documents as they were last written.
    documents: Map<String, Value>,
    flushed: Instant,
}

impl StoreWriter {
    /// A writer of a new store at `path`. Nothing is written, or overwritten, before the first
    /// increment is solved. Fails if there is something at `path` already, unless it is a store
    /// and may be overwritten.
    pub fn create(path: impl AsRef<Path>, overwrite: bool) -> Result<Self, Error> {
        let path = path.as_ref();
        let refuse = |message: &str| {
            Err(Error::File {
                path: path.display().to_string(),
                message: message.to_owned(),
            })
        };
        if path.exists() {
            if Store::open(path).is_err() {
                return refuse("exists and is not a result store: choose another path");
            }
            if !overwrite {
                return refuse(
                    "the result store exists: choose another path, or allow to overwrite it \
                     (--overwrite)",
                );
            }
        }
        Ok(Self {
            path: path.to_owned(),
            overwrite,
            flush_interval: FLUSH_INTERVAL,
            open: None,
        })
    }

    /// Brings the store up to date whenever `interval` of run time has passed (default 5 s), and
    /// at the end of the run.
    #[must_use]
    pub fn with_flush_interval(mut self, interval: Duration) -> Self {
        self.flush_interval = interval;
        self
    }
}

impl Observer for StoreWriter {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if self.open.is_none() {
            if self.overwrite && self.path.exists() {
                remove(&self.path).map_err(|e| Error::File {
                    path: self.path.display().to_string(),
                    message: format!("cannot be replaced: {e}"),
                })?;
            }
            self.open = Some(Open::new(&self.path, march.scene(), march.plan())?);
        }
        let Some(open) = &mut self.open else {
            return Ok(());
        };
        let last = increment.index == march.points().len();
        let save = &march.scene().settings.save;
        open.append(increment);
        if save.keeps(&increment.point, increment.index, last) {
            open.save(&march.fields())?;
        }
        if open.flushed.elapsed() >= self.flush_interval {
            open.flush()?;
        }
        Ok(())
    }

    /// Keeps the fields of the last increment and says how the run ended.
    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        let Some(open) = &mut self.open else {
            return Ok(());
        };
        if open
            .last
            .is_some_and(|(index, _)| index != open.saved_increment)
        {
            open.save(&march.fields())?;
        }
        let status = failure.map_or("done".to_owned(), ToString::to_string);
        open.attributes.insert("status".into(), json!(status));
        open.flush()
    }
}

impl Open {
    /// Begins the store: the group, without a variable.
    fn new(path: &Path, scene: &Scene, plan: &Plan) -> Result<Self, Error> {
        let grid = &scene.grid;
        let scalars = SCALARS.iter().map(|s| {
            let codes = [
                ("flag_values", json!([0, 1, 2, 3])),
                ("flag_meanings", json!(STATUS_MEANINGS)),
            ];
            let attributes = if s.kind == Kind::Code {
                &codes[..]
            } else {
                &[]
            };
            Column::new(
                s.name,
                s.kind,
                (s.units, s.long_name),
                "increment",
                attributes,
            )
        });
        let position = |name, words| Column::new(name, Kind::Real, words, name, &[]);
        let saved = |name, kind, words| Column::new(name, kind, words, "saved", &[]);
        let others = vec![
            position("x", ("m", "position along x")).extend((0..grid.nx).map(|i| grid.x(i))),
            position("y", ("m", "position along y")).extend((0..grid.ny).map(|j| grid.y(j))),
            saved(
                "saved_increment",
                Kind::Count,
                ("1", "increment whose fields are kept"),
            ),
            saved(
                "saved_t",
                Kind::Real,
                ("1", "path time at which fields are kept"),
            ),
        ];
        let fields = FIELDS
            .iter()
            .map(|f| Variable::field(f.name, f.kind, (f.units, f.long_name), (grid.nx, grid.ny)));
        let mut open = Self {
            folder: Folder::new(path),
            attributes: group_attributes(scene, plan),
            scalars: scalars.collect(),
            others,
            fields: fields.collect(),
            last: None,
            saved: 0,
            saved_increment: 0,
            documents: Map::new(),
            flushed: Instant::now(),
        };
        open.write_documents(open.group_documents())?;
        Ok(open)
    }

    fn append(&mut self, increment: &Increment) {
        for (column, scalar) in self.scalars.iter_mut().zip(SCALARS) {
            column.push((scalar.value)(increment));
        }
        self.last = Some((increment.index, increment.point));
    }

    /// Stores the fields of the last increment; they belong to the store from the next flush on.
    fn save(&mut self, fields: &Fields) -> Result<(), Error> {
        let Some((index, point)) = self.last else {
            return Ok(());
        };
        let chunk = [self.saved as u64, 0, 0];
        self.saved += 1;
        self.saved_increment = index;
        self.fields
            .par_iter_mut()
            .zip(FIELDS)
            .try_for_each(|(variable, field)| {
                variable.set_length(self.saved);
                let folder = &self.folder;
                match (field.values)(fields) {
                    FieldView::Real(f) => variable.store(folder, &chunk, f.iter().copied()),
                    FieldView::Mask(f) => {
                        let values = f.iter().map(|&yes| f64::from(u8::from(yes)));
                        variable.store(folder, &chunk, values)
                    }
                }
            })?;
        for column in &mut self.others {
            match column.variable().name() {
                "saved_increment" => column.push(index as f64),
                "saved_t" => column.push(point.t),
                _ => {}
            }
        }
        Ok(())
    }

    /// Brings the store up to date: values, then the metadata of each array, then the
    /// consolidated metadata that makes all of it count at once.
    fn flush(&mut self) -> Result<(), Error> {
        for column in self.scalars.iter_mut().chain(&mut self.others) {
            column.flush(&self.folder)?;
        }
        let mut documents = self.group_documents();
        let columns = self.scalars.iter().chain(&self.others);
        for variable in columns.map(Column::variable).chain(&self.fields) {
            let name = variable.name();
            documents.insert(format!("{name}/.zarray"), variable.zarray());
            documents.insert(format!("{name}/.zattrs"), variable.attributes());
        }
        self.write_documents(documents)?;
        self.flushed = Instant::now();
        Ok(())
    }

    fn group_documents(&self) -> Map<String, Value> {
        let mut documents = Map::new();
        documents.insert(".zgroup".into(), json!({ "zarr_format": 2 }));
        documents.insert(".zattrs".into(), Value::Object(self.attributes.clone()));
        documents
    }

    /// Writes the metadata documents that have changed, and all of them as consolidated metadata.
    fn write_documents(&mut self, documents: Map<String, Value>) -> Result<(), Error> {
        for (key, document) in &documents {
            if self.documents.get(key) != Some(document) {
                self.write(key, document)?;
            }
        }
        let consolidated = json!({ "zarr_consolidated_format": 1, "metadata": documents });
        self.write(".zmetadata", &consolidated)?;
        self.documents = documents;
        Ok(())
    }

    fn write(&self, key: &str, document: &Value) -> Result<(), Error> {
        self.folder
            .write(key, format!("{document:#}").as_bytes())
            .map_err(|e| self.folder.error(&format!("{key}: {e}")))
    }
}

/// Removes a store: first from its place, at once, then from the disk.
fn remove(path: &Path) -> std::io::Result<()> {
    let mut name = path.as_os_str().to_owned();
    name.push(".replaced-by-fret");
    let aside = PathBuf::from(name);
    if aside.exists() {
        fs::remove_dir_all(&aside)?;
    }
    fs::rename(path, &aside)?;
    fs::remove_dir_all(&aside)
}

/// What the group says about the run.
fn group_attributes(scene: &Scene, plan: &Plan) -> Map<String, Value> {
    let plan: Vec<_> = plan.lines.iter().map(ToString::to_string).collect();
    let mut attributes = Map::new();
    let mut set = |key: &str, value: Value| attributes.insert(key.to_owned(), value);
    set("title", json!(scene.title));
    set("schema", json!(super::SCHEMA));
    set("version", json!(env!("CARGO_PKG_VERSION")));
    set("scene", json!(scene.to_toml()));
    set("plan", json!(plan));
    set("mu", json!(scene.friction.mu));
    if let Some(hertz) = scene.hertz() {
        set("a_H", json!(hertz.a));
        set("p_H", json!(hertz.p0));
        set("R", json!(hertz.a * hertz.a / hertz.delta_z));
    }
    set("status", json!("running"));
    let coordinates = "t branch_of_increment saved_increment saved_t";
    set("coordinates", json!(coordinates));
    attributes
}
