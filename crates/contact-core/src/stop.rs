//! Long work that somebody may want to end.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::Error;

/// Why work that nobody can stop does not fail.
pub const NOBODY: &str = "nobody stops it";

/// Fails once `stop` is raised: [`Error::Interrupted`] after increment 0.
pub fn unless(stop: &AtomicBool) -> Result<(), Error> {
    if stop.load(Ordering::Relaxed) {
        return Err(Error::Interrupted { increment: 0 });
    }
    Ok(())
}
