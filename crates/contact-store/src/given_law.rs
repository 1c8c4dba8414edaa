//! The friction law of the user, which a store cannot hold.

use contact_core::Error;
use contact_core::scene::{Scene, UserFriction, missing_law_error};

/// The scene of a store with its friction law, which no store can hold: given again if it has one. Fails if one
/// is missing or not expected.
pub(super) fn with_law(scene: &Scene, law: Option<&UserFriction>) -> Result<Scene, Error> {
    let mut scene = scene.clone();
    match (&scene.friction.law, law) {
        (Some(_), None) => return Err(missing_law_error()),
        (None, Some(_)) => {
            let allowed = "left out: the run has a coefficient and no law of your own";
            return Err(Error::invalid("friction.law", "a law of your own", allowed));
        }
        _ => scene.friction.law = law.cloned(),
    }
    Ok(scene)
}
