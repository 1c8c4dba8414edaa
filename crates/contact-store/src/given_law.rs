//! The friction law of a run that is gone on with: no store can hold it.

use contact_core::Error;
use contact_core::scene::{OwnFriction, Scene, is_missing};

/// The scene of a store with the friction law that is given for it.
pub(super) fn with_law(scene: &Scene, law: Option<&OwnFriction>) -> Result<Scene, Error> {
    let mut scene = scene.clone();
    match (&scene.friction.law, law) {
        (Some(_), None) => return Err(is_missing()),
        (None, Some(_)) => {
            let allowed = "left out: the run has a coefficient and no law of your own";
            return Err(Error::invalid("friction.law", "a law of your own", allowed));
        }
        _ => scene.friction.law = law.cloned(),
    }
    Ok(scene)
}
