//! Taking up a run of wear where its store left it.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::{Scene, UserFriction};
use contact_wear::{BodyWear, Law, Wear, WearRun};
use serde_json::Value;

use super::folder::Folder;
use super::given_law::with_law;
use super::place::mend;
use super::stored::Stored;
use super::wear_checkpoint::read_checkpoint;
use super::wear_store::{ATTRIBUTES, WearStore, clear_checkpoint, fields, locked, verify_wear};

/// Takes up a run of wear where its store left it, to the same bytes; `None` if it is done. Fails
/// if `path` holds no run of wear, one by a law of the user's own, or another one than that of a
/// scene and its wear, where they are given, and if a file of it is missing or not as it was
/// written.
pub fn resume_wear(
    path: impl AsRef<Path>,
    of: Option<(&Scene, &Wear)>,
    stop: &Arc<AtomicBool>,
) -> Result<Option<(WearRun, WearStore)>, Error> {
    let own = of.map_or([vec![], vec![]], |(_, wear)| {
        wear.bodies.each_ref().map(BodyWear::own)
    });
    let settled = of.map(|(scene, wear)| wear.settled(scene, stop));
    let friction = of.and_then(|(scene, _)| scene.friction.law.as_ref());
    take_up(path.as_ref(), settled.transpose()?, (&own, friction), stop)
}

/// The same for a run by laws of the user's own, which no store can hold: those of wear are given
/// again for each body, in the order of its layers, and that of friction.
pub fn resume_wear_by(
    path: impl AsRef<Path>,
    own: &[Vec<Arc<dyn Law>>; 2],
    friction: Option<&UserFriction>,
    stop: &Arc<AtomicBool>,
) -> Result<Option<(WearRun, WearStore)>, Error> {
    take_up(path.as_ref(), None, (own, friction), stop)
}

/// The laws of wear of each body and the law of friction that are of the user's own.
type OwnLaws<'a> = (&'a [Vec<Arc<dyn Law>>; 2], Option<&'a UserFriction>);

fn take_up(
    path: &Path,
    of: Option<(Scene, Wear)>,
    (own, friction): OwnLaws<'_>,
    stop: &Arc<AtomicBool>,
) -> Result<Option<(WearRun, WearStore)>, Error> {
    let place = path.to_owned();
    mend(&place);
    let folder = Folder::new(&place);
    let text = folder.read(ATTRIBUTES).map_err(|e| folder.error(&e))?;
    let text = text.ok_or_else(|| folder.error(&"holds no run of wear"))?;
    let attributes: Value = serde_json::from_slice(&text).map_err(|e| folder.error(&e))?;
    let text = |key: &str| attributes[key].as_str().unwrap_or_default();
    let name = place.display().to_string();
    let stored = || Wear::from_store(&format!("{}{}", text("scene"), text("wear")), &name, own);
    let written = |(scene, wear): (Scene, Wear)| [scene.to_toml(), wear.to_toml()];
    if let Some(of) = of
        && written(of) != written(stored()?)
    {
        return Err(
            folder.error(&"belongs to another scene: go on with that one, or choose another store")
        );
    }
    if attributes["status"] == "done" {
        verify_wear(&place)?;
        clear_checkpoint(&folder);
        return Ok(None);
    }
    if [text("scene"), text("wear")].contains(&"") {
        return Err(folder.error(&"holds no run of wear"));
    }
    let (scene, wear) = stored()?;
    let scene = with_law(&scene, friction)?;
    let lock = locked(&folder)?;
    let (state, kept) = read_checkpoint(&folder)?;
    let run = WearRun::resume(&scene, &wear, state, stop)?;
    for (variable, _) in fields(&run, &run.block(), kept.cycles.len()) {
        let name = variable.name();
        let sums = kept.checksums.get(name).map_or(&[][..], Vec::as_slice);
        let stored = Stored::new(&folder, name, &variable.zarray(), Some(sums))?;
        let verified = stored.verify(&stored.all());
        verified.map_err(|e| folder.error(&format!("{name}: {e}")))?;
    }
    Ok(Some((run, WearStore::go_on(folder, lock, kept))))
}
