//! Resuming a run of wear from its store.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::{Scene, UserFriction};
use contact_wear::{BodyWear, Law, Wear, WearRun};
use serde_json::Value;

use super::folder::Folder;
use super::given_law::with_law;
use super::place::restore_moved_store;
use super::stored::Stored;
use super::wear_checkpoint::read_checkpoint;
use super::wear_store::{ATTRIBUTES, WearStore, clear_checkpoint, fields, lock_store, verify_wear};

/// Resumes a run of wear from its store, to the same bytes; returns `None` if it is done. Fails if
/// `path` holds no run of wear, if the run has a law of the user, or if scene and wear are given
/// and differ from the stored ones. It also fails if a file is missing or not as it was written.
pub fn resume_wear(
    path: impl AsRef<Path>,
    expected: Option<(&Scene, &Wear)>,
    stop: &Arc<AtomicBool>,
) -> Result<Option<(WearRun, WearStore)>, Error> {
    let laws = expected.map_or([vec![], vec![]], |(_, wear)| {
        wear.bodies.each_ref().map(BodyWear::user_laws)
    });
    let settled = expected.map(|(scene, wear)| wear.complete(scene, stop));
    let friction = expected.and_then(|(scene, _)| scene.friction.law.as_ref());
    resume_from(path.as_ref(), settled.transpose()?, (&laws, friction), stop)
}

/// Resumes a run with laws of the user, which no store can hold. The laws of wear are given again
/// for each body, in the order of its layers, and the law of friction, too.
pub fn resume_wear_with_laws(
    path: impl AsRef<Path>,
    laws: &[Vec<Arc<dyn Law>>; 2],
    friction: Option<&UserFriction>,
    stop: &Arc<AtomicBool>,
) -> Result<Option<(WearRun, WearStore)>, Error> {
    resume_from(path.as_ref(), None, (laws, friction), stop)
}

/// The user's laws of wear of each body, and the user's law of friction.
type OwnLaws<'a> = (&'a [Vec<Arc<dyn Law>>; 2], Option<&'a UserFriction>);

/// Opens a store and its checkpoint, and continues the run with the user's own `laws` and friction. If a scene
/// and its wear are `expected`, the store must have the same. None if the run is done.
fn resume_from(
    path: &Path,
    expected: Option<(Scene, Wear)>,
    (laws, friction): OwnLaws<'_>,
    stop: &Arc<AtomicBool>,
) -> Result<Option<(WearRun, WearStore)>, Error> {
    let store_path = path.to_owned();
    restore_moved_store(&store_path);
    let folder = Folder::new(&store_path);
    let text = folder.read(ATTRIBUTES).map_err(|e| folder.error(&e))?;
    let text = text.ok_or_else(|| folder.error(&"holds no run of wear"))?;
    let attributes: Value = serde_json::from_slice(&text).map_err(|e| folder.error(&e))?;
    let text = |key: &str| attributes[key].as_str().unwrap_or_default();
    let name = store_path.display().to_string();
    let stored = || Wear::from_store(&format!("{}{}", text("scene"), text("wear")), &name, laws);
    let written = |(scene, wear): (Scene, Wear)| [scene.to_toml(), wear.to_toml()];
    if let Some(expected) = expected
        && written(expected) != written(stored()?)
    {
        return Err(
            folder.error(&"belongs to another scene: go on with that one, or choose another store")
        );
    }
    if attributes["status"] == "done" {
        verify_wear(&store_path)?;
        clear_checkpoint(&folder);
        return Ok(None);
    }
    if [text("scene"), text("wear")].contains(&"") {
        return Err(folder.error(&"holds no run of wear"));
    }
    let (scene, wear) = stored()?;
    let scene = with_law(&scene, friction)?;
    let lock = lock_store(&folder)?;
    let (state, kept) = read_checkpoint(&folder)?;
    let run = WearRun::resume(&scene, &wear, state, stop)?;
    for (variable, _) in fields(&run, &run.block(), kept.cycles.len()) {
        let name = variable.name();
        let sums = kept.checksums.get(name).map_or(&[][..], Vec::as_slice);
        let stored = Stored::new(&folder, name, &variable.zarray(), Some(sums))?;
        let verified = stored.verify(&stored.whole());
        verified.map_err(|e| folder.error(&format!("{name}: {e}")))?;
    }
    Ok(Some((run, WearStore::resumed(folder, lock, kept))))
}
