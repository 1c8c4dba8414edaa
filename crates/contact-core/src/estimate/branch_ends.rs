//! The tractions at the ends of the branches of a run.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::error::Error;
use crate::march::{Increment, March, Observer, Tractions};
use crate::yielding::Yielded;

/// Keeps the tractions at the ends of the branches for an observer who watches the run.
pub struct BranchEnds<'a> {
    watcher: &'a mut dyn Observer,
    /// The tractions of the branches that are done.
    pub tractions: Vec<Tractions>,
    /// Plastic state there.
    pub(super) yielded: Vec<Option<Yielded>>,
}

impl<'a> BranchEnds<'a> {
    /// Passes all calls on to an observer.
    pub fn new(watcher: &'a mut dyn Observer) -> Self {
        Self {
            watcher,
            tractions: Vec::new(),
            yielded: Vec::new(),
        }
    }
}

impl Observer for BranchEnds<'_> {
    /// Keeps tractions and yielded points at the end of each branch, and passes the call on.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if increment.point.ends_branch {
            self.tractions.push(march.tractions());
            self.yielded.push(march.state().yielded.as_deref().cloned());
        }
        self.watcher.on_increment(march, increment)
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.watcher.on_end(march, failure)
    }

    fn stop(&self) -> Option<Arc<AtomicBool>> {
        self.watcher.stop()
    }
}
