//! Resuming an interrupted run.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::march::{Increment, March};
use contact_core::scene::UserFriction;
use serde_json::json;

use super::catalogue::{FIELDS, Kind, YIELDED};
use super::checkpoint::{Checkpoints, Found};
use super::column::{Column, POINT_CHUNK, SCALAR_CHUNK};
use super::consolidated::Consolidated;
use super::folder::Folder;
use super::given_law::with_law;
use super::open::Open;
use super::place::{resolve_place, restore_moved_store};
use super::reader::Store;
use super::wear_store::WearStore;
use super::writer::StoreWriter;

/// The columns over the increments whose fields are kept.
const SAVED: [(&str, Kind); 2] = [("saved_increment", Kind::Count), ("saved_t", Kind::Real)];

/// A run that continues from its last checkpoint: `march.run(increments, &mut writer)`.
pub struct Resumed {
    /// The load path after the last increment of the checkpoint.
    pub march: March,
    /// Continues the store.
    pub writer: StoreWriter,
    /// The increments up to the checkpoint.
    pub increments: Vec<Increment>,
}

/// Resumes the run of a store; returns `None` if it is done.
///
/// The result will be the result of an uninterrupted run, bit by bit. The content of the store
/// stays there meanwhile. Fields that were saved because the run stopped are dropped. Fails if
/// there is no store, if another process writes it, if a file of it is missing or damaged, or if
/// its checkpoint is of another version. Ends when `stop` is raised, if there is one
/// ([`Error::Interrupted`]). Nothing is changed then.
pub fn resume(
    path: impl AsRef<Path>,
    stop: Option<&Arc<AtomicBool>>,
) -> Result<Option<Resumed>, Error> {
    resume_with_law(path, None, stop)
}

/// Resumes a run with a friction law of the user, which no store can hold, so it is given again.
/// Fails if the run has such a law and none is given, or the reverse.
pub fn resume_with_law(
    path: impl AsRef<Path>,
    law: Option<&UserFriction>,
    stop: Option<&Arc<AtomicBool>>,
) -> Result<Option<Resumed>, Error> {
    let stop = stop.cloned().unwrap_or_default();
    let path = resolve_place(path.as_ref())?;
    restore_moved_store(&path);
    if WearStore::is_at(&path) {
        let message = "holds a run of wear: `fret resume` or pyfret.wear.resume goes on with it";
        return Err(Folder::new(&path).error(&message));
    }
    let store = Store::open(&path)?;
    if Checkpoints::in_use(store.folder()) {
        return Err(store.folder().error(&"is being written by another process"));
    }
    store.verify()?;
    if store.status() == "done" {
        Checkpoints::clear(store.folder());
        return Ok(None);
    }
    let text = store.consolidated().document(".zattrs")["scene"].as_str();
    let Found {
        checkpoints,
        state,
        increments,
    } = Checkpoints::find(store.folder(), text.unwrap_or_default())?;
    let scene = &with_law(store.scene(), law)?;
    let march = match state {
        Some(state) => March::resume_until(scene, state, &stop)?,
        None => March::until(scene, &stop)?,
    };
    let points = march.points();
    let keeps = |index: usize| {
        let save = &scene.settings.save;
        save.keeps(&points[index - 1], index, index == points.len())
    };
    let kept = (1..=store.increments()).filter(|&index| keeps(index));
    let kept = kept.count().min(store.saved());
    let points = columns_of_kept_points(&store, kept)?;
    let metadata = metadata_for_resume(&store, kept, &points)?;
    let mut open = Open::new(store.folder().clone(), scene, march.plan());
    let on_disk = (store.increments(), &metadata.checksums);
    open.restore(checkpoints, &increments, on_disk, &points, |increment| {
        keeps(increment.index)
    });
    open.write_metadata(metadata)?;
    Ok(Some(Resumed {
        march,
        writer: StoreWriter::resumed(open),
        increments,
    }))
}

/// The metadata of a store whose run is resumed, cut to the first `kept` saved increments. Fields that were
/// saved only since the run had stopped are left out.
fn metadata_for_resume(
    store: &Store,
    kept: usize,
    points: &[Vec<f64>],
) -> Result<Consolidated, Error> {
    let mut metadata = store.consolidated().clone();
    metadata.documents[".zattrs"]["status"] = json!("running");
    let of_saved = FIELDS.iter().map(|f| f.name);
    for name in of_saved.chain(SAVED.map(|(name, _)| name)) {
        if let Some(array) = metadata.documents.get_mut(&format!("{name}/.zarray")) {
            array["shape"][0] = json!(kept);
        }
    }
    for (name, kind) in SAVED {
        if store.saved() > 0 {
            let column = store.column(name)?;
            let checksums = Column::checksums_of_chunks(kind, &column[..kept], SCALAR_CHUNK);
            metadata.checksums.insert(name.to_owned(), checksums);
        }
    }
    for (of, values) in YIELDED.iter().zip(points) {
        if let Some(array) = metadata.documents.get_mut(&format!("{}/.zarray", of.name)) {
            array["shape"][0] = json!(values.len());
            let checksums = Column::checksums_of_chunks(of.kind, values, POINT_CHUNK);
            metadata.checksums.insert(of.name.to_owned(), checksums);
        }
    }
    Ok(metadata)
}

/// Columns of the yielded points in the first `kept` of the increments whose fields are saved.
fn columns_of_kept_points(store: &Store, kept: usize) -> Result<Vec<Vec<f64>>, Error> {
    let mut points = store.points()?;
    let last = match kept.checked_sub(1) {
        Some(last) => store.column("saved_increment")?[last],
        None => 0.0,
    };
    let rows = points
        .first()
        .map_or(0, |of| of.partition_point(|increment| *increment <= last));
    for column in &mut points {
        column.truncate(rows);
    }
    Ok(points)
}
