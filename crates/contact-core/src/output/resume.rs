//! Going on with a run that has ended early.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde_json::{Map, Value, json};

use super::catalogue::FIELDS;
use super::checkpoint::{Checkpoints, Found};
use super::open::Open;
use super::place::mend;
use super::reader::Store;
use super::writer::StoreWriter;
use crate::error::Error;
use crate::march::{Increment, March};

/// A run taken up where its last checkpoint left it: `march.run(increments, &mut writer)`.
pub struct Resumed {
    /// The load path after the last increment of the checkpoint.
    pub march: March,
    /// Writes on in the store.
    pub writer: StoreWriter,
    /// The increments up to there.
    pub increments: Vec<Increment>,
}

/// Takes up the run of a store; `None` if it is done.
///
/// The result will be that of the run without the interruption, bit by bit. What the store holds
/// stays there meanwhile; only fields that were kept because the run stopped are given up. Fails
/// if there is no store, if another process writes it, or if its checkpoint is damaged or of
/// another version, and ends when `stop` is raised, if there is one ([`Error::Interrupted`]); then
/// nothing is changed.
pub fn resume(
    path: impl AsRef<Path>,
    stop: Option<&Arc<AtomicBool>>,
) -> Result<Option<Resumed>, Error> {
    let stop = stop.cloned().unwrap_or_default();
    mend(path.as_ref());
    let store = Store::open(path)?;
    if store.status() == "done" {
        Checkpoints::clear(store.folder());
        return Ok(None);
    }
    let text = store.metadata()[".zattrs"]["scene"].as_str();
    let Found {
        checkpoints,
        state,
        increments,
    } = Checkpoints::find(store.folder(), text.unwrap_or_default())?;
    let scene = store.scene();
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
    let documents = begun_again(store.metadata(), kept);
    let mut open = Open::new(store.folder().clone(), scene, march.plan());
    open.take_up(checkpoints, &increments, store.increments(), |increment| {
        keeps(increment.index)
    });
    open.write_documents(documents)?;
    Ok(Some(Resumed {
        march,
        writer: StoreWriter::go_on(open),
        increments,
    }))
}

/// The metadata of a store whose run goes on: without the fields that were kept only because it
/// had stopped.
fn begun_again(metadata: &Value, kept: usize) -> Map<String, Value> {
    let mut documents = metadata.as_object().cloned().unwrap_or_default();
    documents[".zattrs"]["status"] = json!("running");
    let of_saved = FIELDS.iter().map(|f| f.name);
    for name in of_saved.chain(["saved_increment", "saved_t"]) {
        if let Some(array) = documents.get_mut(&format!("{name}/.zarray")) {
            array["shape"][0] = json!(kept);
        }
    }
    documents
}
