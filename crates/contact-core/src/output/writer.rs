//! The store being written.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::catalogue::{FIELDS, FieldView, Kind, SCALARS, STATUS_MEANINGS};
use super::checkpoint::Checkpoints;
use super::folder::Folder;
use super::reader::Store;
use super::variable::{Column, Variable};
use crate::error::Error;
use crate::march::{Fields, Increment, March, Observer, State};
use crate::scene::{Grid, LoadPoint, Plan, Scene};

/// Time between two checkpoints: what a crash may lose.
const INTERVAL: Duration = Duration::from_secs(5);
/// Largest part of the time that goes to checkpoints.
const SHARE: f64 = 0.03;
/// Cells of a grid from which on a run that is stopped does not wait for the fields of its last
/// increment, a second and more; they follow from the checkpoint.
const NO_FIELDS_FROM: usize = 1 << 21;
/// What a checkpoint is taken to cost before one has been timed.
const FIRST_COST: Duration = Duration::from_millis(30);

/// Appends a run to a store while it goes on. Give it to [`crate::march::solve`].
pub struct StoreWriter {
    path: PathBuf,
    overwrite: bool,
    interval: Duration,
    open: Option<Open>,
}

/// A store that has been begun.
pub(super) struct Open {
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
    checkpoints: Option<Checkpoints>,
    /// Increments that the store on the disk holds.
    on_disk: usize,
    /// When the last checkpoint was written, and how long that took.
    written: Instant,
    cost: Duration,
    /// Checkpoints so far, and how long they took together.
    checkpoints_so_far: (usize, Duration),
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
            interval: INTERVAL,
            open: None,
        })
    }

    /// A writer that goes on with the store of `open`.
    pub(super) fn go_on(open: Open) -> Self {
        Self {
            path: open.folder.root().to_owned(),
            overwrite: false,
            interval: INTERVAL,
            open: Some(open),
        }
    }

    /// Brings the store and the checkpoint up to date whenever `interval` of run time has passed
    /// (default 5 s; zero: after every increment), at the ends of branches, and at the end of the
    /// run. Branch ends are passed over while that would take more than 3 % of the time, and so
    /// are intervals other than zero.
    #[must_use]
    pub fn with_interval(mut self, interval: Duration) -> Self {
        self.interval = interval;
        self
    }

    /// Checkpoints that this writer has written, and the time that they took, what brings the
    /// store up to date for each included.
    pub fn checkpoints(&self) -> (usize, Duration) {
        self.open
            .as_ref()
            .map_or((0, Duration::ZERO), |open| open.checkpoints_so_far)
    }
}

impl Observer for StoreWriter {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if self.open.is_none() {
            if self.overwrite && self.path.exists() {
                remove(&self.path)?;
            }
            let mut open = Open::new(Folder::new(&self.path), march.scene(), march.plan());
            open.begin()?;
            self.open = Some(open);
        }
        let Some(open) = &mut self.open else {
            return Ok(());
        };
        let last = increment.index == march.points().len();
        let save = &march.scene().settings.save;
        open.append(increment)?;
        if save.keeps(&increment.point, increment.index, last) {
            open.save(&march.fields())?;
        }
        if open.is_due(self.interval, increment.point.ends_branch) {
            open.checkpoint(march.state())?;
        }
        Ok(())
    }

    /// Keeps the fields of the last increment (unless the run was stopped on a grid of two million
    /// cells or more) and says how the run ended; a run that ended early leaves a checkpoint to go on
    /// from.
    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        let Some(open) = &mut self.open else {
            return Ok(());
        };
        let beyond_disk = march.state().increments >= open.on_disk;
        let Grid { nx, ny, .. } = march.scene().grid;
        let stopped = matches!(failure, Some(Error::Interrupted { .. }));
        let in_haste = stopped && nx * ny >= NO_FIELDS_FROM;
        let unsaved = march.state().increments != open.saved_increment;
        let last_fields = if beyond_disk && unsaved && !in_haste {
            open.save(&march.fields())
        } else {
            Ok(())
        };
        let status = failure.map_or("done".to_owned(), ToString::to_string);
        open.attributes.insert("status".into(), json!(status));
        // Where there is no room for the fields there may be for the rest.
        if failure.is_some() {
            return open.checkpoint(march.state()).and(last_fields);
        }
        // Nothing will be resumed: the store is enough.
        open.flush().and(last_fields)?;
        open.checkpoints.take().map_or(Ok(()), Checkpoints::remove)
    }
}

impl Open {
    /// A store without an increment; nothing is written yet.
    pub(super) fn new(folder: Arc<Folder>, scene: &Scene, plan: &Plan) -> Self {
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
        Self {
            folder,
            attributes: group_attributes(scene, plan),
            scalars: scalars.collect(),
            others,
            fields: fields.collect(),
            last: None,
            saved: 0,
            saved_increment: 0,
            documents: Map::new(),
            checkpoints: None,
            on_disk: 0,
            written: Instant::now(),
            cost: FIRST_COST,
            checkpoints_so_far: (0, Duration::ZERO),
        }
    }

    /// Begins the store: the group, without a variable, and the place of the checkpoints.
    fn begin(&mut self) -> Result<(), Error> {
        self.write_documents(self.group_documents())?;
        let scene = self.attributes["scene"].as_str().unwrap_or_default();
        self.checkpoints = Some(Checkpoints::begin(&self.folder, scene)?);
        Ok(())
    }

    /// Takes up what a run has left: its increments, of which those that `keeps` says keep their
    /// fields, and a store on the disk that holds `on_disk` of them or more.
    pub(super) fn take_up(
        &mut self,
        checkpoints: Checkpoints,
        increments: &[Increment],
        on_disk: usize,
        keeps: impl Fn(&Increment) -> bool,
    ) {
        self.checkpoints = Some(checkpoints);
        self.on_disk = on_disk;
        for increment in increments {
            self.append_scalars(increment);
            if keeps(increment) {
                self.count_saved(increment.index, &increment.point);
            }
        }
    }

    fn append(&mut self, increment: &Increment) -> Result<(), Error> {
        self.append_scalars(increment);
        match &mut self.checkpoints {
            Some(checkpoints) => checkpoints.push(increment),
            None => Ok(()),
        }
    }

    fn append_scalars(&mut self, increment: &Increment) {
        for (column, scalar) in self.scalars.iter_mut().zip(SCALARS) {
            column.push((scalar.value)(increment));
        }
        self.last = Some((increment.index, increment.point));
    }

    /// Whether a checkpoint is to be written now.
    fn is_due(&self, interval: Duration, ends_branch: bool) -> bool {
        let elapsed = self.written.elapsed();
        interval.is_zero()
            || ((ends_branch || elapsed >= interval) && elapsed.mul_f64(SHARE) >= self.cost)
    }

    /// Brings the store up to date, then the checkpoint, which so never is ahead of it.
    fn checkpoint(&mut self, state: &State) -> Result<(), Error> {
        let begun = Instant::now();
        self.flush()?;
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.write(state)?;
        }
        self.written = Instant::now();
        self.cost = self.written - begun;
        let (count, time) = &mut self.checkpoints_so_far;
        (*count, *time) = (*count + 1, *time + self.cost);
        Ok(())
    }

    /// Stores the fields of the last increment; they belong to the store from the next flush on.
    fn save(&mut self, fields: &Fields) -> Result<(), Error> {
        let Some((index, point)) = self.last else {
            return Ok(());
        };
        let chunk = [self.saved as u64, 0, 0];
        self.fields
            .par_iter()
            .zip(FIELDS)
            .try_for_each(|(variable, field)| {
                let folder = &self.folder;
                match (field.values)(fields) {
                    FieldView::Real(f) => variable.store(folder, &chunk, f.iter().copied()),
                    FieldView::Mask(f) => {
                        let values = f.iter().map(|&yes| f64::from(u8::from(yes)));
                        variable.store(folder, &chunk, values)
                    }
                }
            })?;
        self.count_saved(index, &point);
        Ok(())
    }

    /// Counts the fields of an increment among those that are kept.
    fn count_saved(&mut self, index: usize, point: &LoadPoint) {
        self.saved += 1;
        self.saved_increment = index;
        for variable in &mut self.fields {
            variable.set_length(self.saved);
        }
        for column in &mut self.others {
            match column.variable().name() {
                "saved_increment" => column.push(index as f64),
                "saved_t" => column.push(point.t),
                _ => {}
            }
        }
    }

    /// Brings the store up to date: values, then the metadata of each array, then the
    /// consolidated metadata that makes all of it count at once. A store that holds more, since
    /// the run went on from an older checkpoint, keeps it; only its status changes.
    fn flush(&mut self) -> Result<(), Error> {
        let solved = self.last.map_or(0, |(index, _)| index);
        if solved < self.on_disk {
            let mut documents = self.documents.clone();
            documents.insert(".zattrs".into(), Value::Object(self.attributes.clone()));
            return self.write_documents(documents);
        }
        let (scalars, others) = (&mut self.scalars, &mut self.others);
        let mut columns: Vec<_> = scalars.iter_mut().chain(others).collect();
        columns
            .par_iter_mut()
            .try_for_each(|column| column.flush(&self.folder))?;
        let mut documents = self.group_documents();
        let columns = self.scalars.iter().chain(&self.others);
        for variable in columns.map(Column::variable).chain(&self.fields) {
            let name = variable.name();
            documents.insert(format!("{name}/.zarray"), variable.zarray());
            documents.insert(format!("{name}/.zattrs"), variable.attributes());
        }
        self.write_documents(documents)?;
        self.on_disk = solved;
        Ok(())
    }

    fn group_documents(&self) -> Map<String, Value> {
        let mut documents = Map::new();
        documents.insert(".zgroup".into(), json!({ "zarr_format": 2 }));
        documents.insert(".zattrs".into(), Value::Object(self.attributes.clone()));
        documents
    }

    /// Writes the metadata documents that have changed, and all of them as consolidated metadata.
    pub(super) fn write_documents(&mut self, documents: Map<String, Value>) -> Result<(), Error> {
        let changed = documents
            .iter()
            .filter(|(key, document)| self.documents.get(*key) != Some(document));
        (changed.collect::<Vec<_>>().par_iter())
            .try_for_each(|(key, document)| self.write(key, document))?;
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
fn remove(path: &Path) -> Result<(), Error> {
    let folder = Folder::new(path);
    if Checkpoints::in_use(&folder) {
        return Err(folder.error(&"is being written by another process"));
    }
    remove_folder(path).map_err(|e| folder.error(&format!("cannot be replaced: {e}")))
}

fn remove_folder(path: &Path) -> std::io::Result<()> {
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
