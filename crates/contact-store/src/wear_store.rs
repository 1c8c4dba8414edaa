//! A run of wear as a Zarr group: scalars over `jump`, fields over `block`, `x`, `y`, the friction
//! loops of the blocks over `block`, `corner`.
//!
//! Beside the arrays lies the state after the last jump
//! ([`wear_checkpoint`](super::wear_checkpoint)), from which [`resume_wear`](super::resume_wear)
//! continues. A killed process may have left fields of later blocks; they are written again with
//! the same bytes.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use contact_core::Error;
use contact_wear::{Block, EventKind, WearRun};
use serde_json::{Map, Value, json};

use super::catalogue::{FieldView, Kind};
use super::consolidated::{Consolidated, FILE};
use super::folder::Folder;
use super::place::{PendingFolder, is_store, lock_folder, restore_moved_store};
use super::schema::SCHEMA;
use super::wear_catalogue::{FIELDS, FRICTION_LOOP, SCALARS, Scalar};
use super::wear_checkpoint::{Kept, write_checkpoint};
use super::{column::Column, variable::Variable, whole};

/// Attributes of the store, its status among them.
pub(super) const ATTRIBUTES: &str = ".zattrs";

/// Writes a run of wear while it goes on.
pub struct WearStore {
    place: PathBuf,
    overwrite: bool,
    /// The folder, and its lock: a store has one writer.
    folder: Option<(Arc<Folder>, File)>,
    kept: Kept,
}

impl WearStore {
    /// A new store at `path`; nothing is written before the first jump. Fails if there is something
    /// already, unless it is a store and may be overwritten.
    pub fn create(path: impl AsRef<Path>, overwrite: bool) -> Result<Self, Error> {
        let store_path = path.as_ref().to_owned();
        restore_moved_store(&store_path);
        if store_path.exists() && !(overwrite && is_store(&store_path)) {
            let message =
                "exists: choose another path, or allow to overwrite a result store (--overwrite)";
            return Err(Folder::new(&store_path).error(&message));
        }
        Ok(Self {
            place: store_path,
            overwrite,
            folder: None,
            kept: Kept::default(),
        })
    }

    /// Continues the store of a resumed run, with the blocks that it holds.
    pub(super) fn resumed(folder: Arc<Folder>, lock: File, kept: Kept) -> Self {
        Self {
            place: folder.root().to_owned(),
            overwrite: false,
            folder: Some((folder, lock)),
            kept,
        }
    }

    /// Checks that there is a run of wear at `path`.
    pub fn is_at(path: impl AsRef<Path>) -> bool {
        let text = Folder::new(path.as_ref()).read(".zattrs");
        let attributes = text.ok().flatten().map(|t| serde_json::from_slice(&t));
        attributes.is_some_and(|read: Result<Value, _>| read.is_ok_and(|a| a.get("wear").is_some()))
    }

    /// Stores the current block, if it is one to be kept, every scalar, and the state.
    pub fn write(&mut self, run: &mut WearRun) -> Result<(), Error> {
        let kept = run.takes_block();
        let block = run.block();
        let begins = match &self.folder {
            Some(_) => None,
            None => Some(PendingFolder::begin(&self.place)?),
        };
        let folder = match (&self.folder, &begins) {
            (Some((folder, _)), _) => folder.clone(),
            (None, Some(begins)) => begins.folder().clone(),
            (None, None) => return Ok(()),
        };
        if kept {
            let n = self.kept.cycles.len();
            for (mut variable, values) in fields(run, &block, n + 1) {
                let sums = self
                    .kept
                    .checksums
                    .entry(variable.name().into())
                    .or_default();
                variable.set_checksums(sums);
                variable.store_last(&folder, n, values.into_iter())?;
                *sums = variable.checksums().to_vec();
            }
            self.kept.cycles.push(block.cycles);
        }
        write_checkpoint(&folder, run.state(), &self.kept)?;
        self.write_documents(&folder, run, &block, "running")?;
        if let Some(begins) = begins {
            let folder = begins.finish(self.overwrite)?;
            let lock = lock_store(&folder)?;
            self.folder = Some((folder, lock));
        }
        Ok(())
    }

    /// Writes how the run ended, and removes the checkpoint of a finished run.
    pub fn finish(&self, run: &WearRun, status: &str) -> Result<(), Error> {
        let Some((folder, _)) = &self.folder else {
            return Ok(());
        };
        self.write_documents(folder, run, &run.block(), status)?;
        if status == "done" {
            clear_checkpoint(folder);
        }
        Ok(())
    }

    /// Writes the columns, the metadata and checksums of all variables (`block`: the fields of the last block of
    /// cycles), and last the attributes with the `status` of the run.
    fn write_documents(
        &self,
        folder: &Arc<Folder>,
        run: &WearRun,
        block: &Block,
        status: &str,
    ) -> Result<(), Error> {
        let mut documents = Map::new();
        documents.insert(".zgroup".into(), json!({ "zarr_format": 2 }));
        documents.insert(ATTRIBUTES.into(), attributes(run, status));
        let mut columns = columns(run, &self.kept.cycles);
        for column in &mut columns {
            column.flush(folder)?;
        }
        let arrays = fields(run, block, self.kept.cycles.len());
        let variables = arrays.iter().map(|(variable, _)| variable);
        let mut checksums = self.kept.checksums.clone();
        for variable in columns.iter().map(Column::variable) {
            checksums.insert(variable.name().into(), variable.checksums().to_vec());
        }
        for variable in columns.iter().map(Column::variable).chain(variables) {
            let name = variable.name();
            documents.insert(format!("{name}/.zarray"), variable.zarray());
            documents.insert(format!("{name}/.zattrs"), variable.attributes());
        }
        let write = |key: &str, document: &Value| folder.put(key, &format!("{document:#}"));
        for (key, document) in documents.iter().filter(|(key, _)| *key != ATTRIBUTES) {
            write(key, document)?;
        }
        let consolidated = Consolidated {
            documents,
            checksums,
        };
        folder.put(FILE, &consolidated.encode())?;
        // The status comes last: a store with the status "done" is whole.
        write(ATTRIBUTES, consolidated.document(ATTRIBUTES))
    }
}

/// The variables of the jumps, the coordinates of the cells, and the cycles of the stored blocks.
pub(super) fn columns(run: &WearRun, cycles: &[f64]) -> Vec<Column> {
    let (jumps, grid) = (run.history(), &run.scene().grid);
    let scalar = |(name, unit, meaning, value): &Scalar| {
        let kind = if matches!(*name, "retries" | "index") {
            Kind::Count
        } else {
            Kind::Real
        };
        Column::new(name, kind, (grid.unit_of(unit), meaning), "jump", &[])
            .extend(jumps.iter().map(value))
    };
    let mut columns: Vec<Column> = SCALARS.iter().map(scalar).collect();
    let along = |name, meaning, n: usize, at: &dyn Fn(usize) -> f64| {
        Column::new(name, Kind::Real, ("m", meaning), name, &[]).extend((0..n).map(at))
    };
    columns.push(along("x", "position along x", grid.nx, &|i| grid.x(i)));
    columns.push(along("y", "position along y", grid.ny, &|j| grid.y(j)));
    let blocks = Column::new(
        "block_cycles",
        Kind::Real,
        ("1", "cycles at the block"),
        "block",
        &[],
    );
    columns.push(blocks.extend(cycles.iter().copied()));
    columns
}

/// Locks the folder; fails if another process writes it.
pub(super) fn lock_store(folder: &Arc<Folder>) -> Result<File, Error> {
    let lock = File::open(folder.root()).map_err(|e| folder.error(&e))?;
    lock_folder(&lock, folder)?;
    Ok(lock)
}

/// Removes the checkpoint of a finished run, which a process that died at its very end has left. A
/// failure is ignored, since the store is whole.
pub(super) fn clear_checkpoint(folder: &Folder) {
    let _ = std::fs::remove_dir_all(folder.root().join("checkpoint"));
}

/// The variables over blocks, each with the values of one `block`; `blocks` is their number so far.
pub(super) fn fields(run: &WearRun, block: &Block, blocks: usize) -> Vec<(Variable, Vec<f64>)> {
    let grid = &run.scene().grid;
    let (n, nx, ny) = (blocks as u64, grid.nx as u64, grid.ny as u64);
    let corners = block.friction_loop.len() as u64;
    let fields = FIELDS.iter().map(|(name, units, what, values)| {
        let (kind, values) = match values(block) {
            FieldView::Real(f) => (Kind::Real, f.iter().copied().collect()),
            FieldView::Mask(f) => (
                Kind::Flag,
                f.iter().map(|s| f64::from(u8::from(*s))).collect(),
            ),
        };
        let (shape, chunk) = (vec![n, nx, ny], vec![1, nx, ny]);
        let dims = ["block", "x", "y"];
        (
            Variable::new(name, kind, (units, what), &dims, shape, chunk),
            values,
        )
    });
    let friction_loop = FRICTION_LOOP
        .iter()
        .enumerate()
        .map(|(c, (name, units, what))| {
            let words = (grid.unit_of(units), *what);
            let (shape, chunk) = (vec![n, corners], vec![1, corners]);
            let dims = ["block", "corner"];
            let values = block.friction_loop.iter().map(|at| at[c]).collect();
            (
                Variable::new(name, Kind::Real, words, &dims, shape, chunk),
                values,
            )
        });
    fields.chain(friction_loop).collect()
}

/// The attributes of a store of wear: scene, wear, events, warnings, `status`.
pub(super) fn attributes(run: &WearRun, status: &str) -> Value {
    let events = run.state().events.iter().map(|e| {
        let kind = match e.kind {
            EventKind::Thinned => "thinned",
            EventKind::WornThrough => "worn through",
        };
        json!({ "kind": kind, "cycles": e.cycles, "cycles_error": e.cycles_error, "body": e.body, "coating": e.coating, "x": e.x, "y": e.y })
    });
    let (scene, hertz) = (run.scene(), run.scene().hertz());
    let mut doubts = scene.doubts();
    doubts.extend(run.doubts());
    json!({
        "doubts": doubts.join("\n"),
        "method": run.wear().note(),
        "title": scene.title,
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "scene": scene.to_toml(),
        "wear": run.wear().to_toml(),
        "a_H": hertz.map(|h| h.a),
        "p_H": hertz.map(|h| h.p0),
        "mu": scene.friction.mu,
        "depth_before": run.state().lost_before[0],
        "volume_before": run.state().lost_before[1],
        "events": events.collect::<Vec<_>>(),
        "coordinates": "cycles block_cycles",
        "status": status,
    })
}

/// Fails if there is no store of a run of wear at `path`, or if a file of it is missing or not as
/// it was written; a store that is being written meanwhile is looked at again.
pub fn verify_wear(path: impl AsRef<Path>) -> Result<(), Error> {
    let folder = Folder::new(path.as_ref());
    let mut consolidated = whole::consolidated(&folder)?;
    if consolidated.document(ATTRIBUTES).get("wear").is_none() {
        return Err(folder.error(&"holds no run of wear"));
    }
    loop {
        let Err(error) = whole::verify(&folder, &consolidated) else {
            return Ok(());
        };
        let again = whole::consolidated(&folder)?;
        if again == consolidated {
            return Err(error);
        }
        consolidated = again;
    }
}
