//! Writes a store during the run.

use std::path::{Path, PathBuf};
use std::time::Duration;

use contact_core::Error;
use contact_core::march::{Increment, March, Observer};
use contact_core::scene::Grid;

use super::attributes::conclude;
use super::checkpoint::Checkpoints;
use super::folder::Folder;
use super::open::Open;
use super::place::{check_only_store, resolve_place, restore_moved_store};
use super::reader::Store;

/// Time between two checkpoints: the run time that a crash may lose.
const INTERVAL: Duration = Duration::from_secs(5);
/// Cells of a grid from which on a run that is stopped does not wait for the fields of its last
/// increment, a second and more; they follow from the checkpoint.
const NO_FIELDS_FROM: usize = 1 << 21;

/// Appends a run to a store as it is solved. Give it to [`contact_core::march::solve`].
pub struct StoreWriter {
    path: PathBuf,
    overwrite: bool,
    interval: Duration,
    open: Option<Open>,
}

impl StoreWriter {
    /// A writer of a new store at `path`. Nothing is written, or overwritten, before the first
    /// increment is solved. Fails if there is something at `path` already, unless it is a store
    /// and nothing else, and may be overwritten. A link to a store is followed.
    pub fn create(path: impl AsRef<Path>, overwrite: bool) -> Result<Self, Error> {
        let path = resolve_place(path.as_ref())?;
        restore_moved_store(&path);
        let refuse = |message: &str| Err(Folder::new(&path).error(&message));
        if path.exists() {
            if let Err(reason) = Store::open(&path) {
                return refuse(&format!(
                    "exists and is not a result store that could be replaced ({reason}): choose \
                     another path, or remove it"
                ));
            }
            if !overwrite {
                return refuse(
                    "the result store exists: choose another path, or allow to overwrite it \
                     (--overwrite)",
                );
            }
            check_only_store(&path)?;
        }
        Ok(Self {
            path,
            overwrite,
            interval: INTERVAL,
            open: None,
        })
    }

    /// Continues the store of `open`.
    pub(super) fn resumed(open: Open) -> Self {
        Self {
            path: open.folder.root().to_owned(),
            overwrite: false,
            interval: INTERVAL,
            open: Some(open),
        }
    }

    /// Brings the store and the checkpoint up to date whenever `interval` of run time has passed
    /// (default 5 s; zero: after every increment), at the ends of branches, and at the end of the
    /// run. Ends of branches and intervals other than zero are skipped if they would take more than
    /// 3 % of the time.
    #[must_use]
    pub fn with_interval(mut self, interval: Duration) -> Self {
        self.interval = interval;
        self
    }

    /// Number of increments in the store on the disk, from which [`super::resume`] continues; 0 if
    /// there is none.
    pub fn kept(&self) -> usize {
        self.open.as_ref().map_or(0, |open| open.on_disk)
    }

    /// Number of checkpoints of this writer and their total cost, store flush included.
    pub fn checkpoints(&self) -> (usize, Duration) {
        self.open
            .as_ref()
            .map_or((0, Duration::ZERO), |open| open.checkpoints_so_far)
    }
}

impl Observer for StoreWriter {
    /// Appends an increment, saves its fields if wanted, and writes a checkpoint if it is time for one.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if self.open.is_none() {
            let mut open = Open::new(Folder::new(&self.path), march.scene(), march.plan());
            open.begin(self.overwrite)?;
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
    /// cells or more), and writes how the run ended and its doubts. A run that ended early leaves a
    /// checkpoint to resume from.
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
        conclude(&mut open.attributes, march.scene(), &open.reached, failure);
        // A disk too full for the fields may hold the rest.
        if failure.is_some() {
            return open.checkpoint(march.state()).and(last_fields);
        }
        // Nothing will be resumed: the store is enough.
        open.flush().and(last_fields)?;
        open.checkpoints.take().map_or(Ok(()), Checkpoints::remove)
    }
}
