//! The state of a run on disk: enough to resume to the same result, bit by bit.
//!
//! Beside the arrays of a store lies the folder `checkpoint`:
//!
//! ```text
//! increments   every increment so far, appended
//! state.0      the state after one of them, and how long `increments` was then
//! state.1      the same one checkpoint earlier, or later: they are written in turn
//! ```
//!
//! A state is written beside the older of the two, brought to the disk and renamed: whenever the
//! process dies, one whole state is left. Both files end in a CRC-32 of their preceding bytes. The
//! increments are checked against the CRC-32 in the state. The encoding is `postcard`.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::sync::Arc;

use contact_core::Error;
use contact_core::march::{Increment, State};
use serde::{Deserialize, Serialize};

use super::folder::Folder;

/// The first bytes of a state; the number is the version of the layout.
const MAGIC: &[u8] = b"fret checkpoint 7\n";
pub(super) const FOLDER: &str = "checkpoint";
/// Names in that folder.
pub(super) const FILES: [&str; 3] = ["increments", "state.0", "state.1"];
const INCREMENTS: &str = "checkpoint/increments";
const STATES: [&str; 2] = ["checkpoint/state.0", "checkpoint/state.1"];
/// Bytes of a CRC-32.
const CRC: usize = 4;

/// The header of a state.
#[derive(Serialize, Deserialize)]
struct Head {
    /// Version of the program: another one need not give the same bits.
    version: String,
    /// CRC-32 of the scene as it stands in the store.
    scene: u32,
    /// Length of `increments` \[bytes\] and the CRC-32 of so much of it.
    length: u64,
    crc: u32,
}

/// The checkpoints of a run, being written.
#[derive(Debug)]
pub(super) struct Checkpoints {
    folder: Arc<Folder>,
    scene: u32,
    /// The file `increments`, locked: a store has one writer.
    increments: File,
    length: u64,
    crc: crc32fast::Hasher,
    /// Increments that are not in the file yet.
    pending: Vec<u8>,
    /// Index of the state that is replaced next.
    older: usize,
}

/// The start of a resumed run.
pub(super) struct Found {
    pub(super) checkpoints: Checkpoints,
    /// None if the run died before its first checkpoint.
    pub(super) state: Option<State>,
    pub(super) increments: Vec<Increment>,
}

impl Checkpoints {
    /// Starts the checkpoints of a new run of a scene.
    pub(super) fn begin(folder: &Arc<Folder>, scene: &str) -> Result<Self, Error> {
        let failed = |e: io::Error| folder.error(&format!("{INCREMENTS}: {e}"));
        fs::create_dir_all(folder.root().join(FOLDER)).map_err(failed)?;
        Self::open(folder, scene, true)
    }

    /// Opens the file that increments are appended to, and creates it if `new`; a lock keeps other processes
    /// out.
    fn open(folder: &Arc<Folder>, scene: &str, new: bool) -> Result<Self, Error> {
        let failed = |e: io::Error| folder.error(&format!("{INCREMENTS}: {e}"));
        let increments = OpenOptions::new()
            .create(new)
            .append(true)
            .open(folder.root().join(INCREMENTS))
            .map_err(failed)?;
        if let Err(TryLockError::WouldBlock) = increments.try_lock() {
            return Err(folder.error(&"is being written by another process"));
        }
        Ok(Self {
            folder: folder.clone(),
            scene: crc32fast::hash(scene.as_bytes()),
            increments,
            length: 0,
            crc: crc32fast::Hasher::new(),
            pending: Vec::new(),
            older: 0,
        })
    }

    /// Follows the store to its final place.
    pub(super) fn moved_to(self, folder: &Arc<Folder>) -> Self {
        let folder = folder.clone();
        Self { folder, ..self }
    }

    /// Finds the newest whole checkpoint of a run of the scene: state, increments, and the file to continue.
    pub(super) fn find(folder: &Arc<Folder>, scene: &str) -> Result<Found, Error> {
        let mut checkpoints = Self::open(folder, scene, false)?;
        let log = checkpoints.read(INCREMENTS)?.unwrap_or_default();
        let (mut whole, mut damaged) = (Vec::new(), Vec::new());
        for (which, name) in STATES.into_iter().enumerate() {
            let Some(bytes) = checkpoints.read(name)? else {
                continue;
            };
            match decode(&bytes, checkpoints.scene, &log) {
                Ok((head, state, increments)) => whole.push((which, head, state, increments)),
                Err(reason) => damaged.push(format!("{name} {reason}")),
            }
        }
        let newest = whole.into_iter().max_by_key(|(_, _, s, _)| s.increments);
        let Some((which, head, state, increments)) = newest else {
            if !damaged.is_empty() {
                return Err(folder.error(&damaged.join("; ")));
            }
            checkpoints.truncate(0)?;
            return Ok(Found {
                checkpoints,
                state: None,
                increments: Vec::new(),
            });
        };
        checkpoints.older = 1 - which;
        checkpoints.crc.update(&log[..head.length as usize]);
        checkpoints.truncate(head.length)?;
        Ok(Found {
            checkpoints,
            state: Some(state),
            increments,
        })
    }

    /// Adds an increment to the next checkpoint.
    pub(super) fn push(&mut self, increment: &Increment) -> Result<(), Error> {
        let pending = std::mem::take(&mut self.pending);
        self.pending = postcard::to_extend(increment, pending)
            .map_err(|e| self.folder.error(&format!("{INCREMENTS}: {e}")))?;
        Ok(())
    }

    /// Writes a checkpoint: the increments so far and the state after the last of them.
    pub(super) fn write(&mut self, state: &State) -> Result<(), Error> {
        let failed =
            |name: &str, e: &dyn std::fmt::Display| self.folder.error(&format!("{name}: {e}"));
        self.increments
            .write_all(&self.pending)
            .and_then(|()| self.increments.sync_data())
            .map_err(|e| failed(INCREMENTS, &e))?;
        self.crc.update(&self.pending);
        self.length += self.pending.len() as u64;
        self.pending.clear();
        let head = Head {
            version: env!("CARGO_PKG_VERSION").into(),
            scene: self.scene,
            length: self.length,
            crc: self.crc.clone().finalize(),
        };
        let name = STATES[self.older];
        self.folder
            .write_durably(name, |file| encode(&head, state, file))
            .map_err(|e| failed(name, &e))?;
        self.older = 1 - self.older;
        Ok(())
    }

    /// Removes the checkpoints of a run that is done.
    pub(super) fn remove(self) -> Result<(), Error> {
        let Self {
            folder, increments, ..
        } = self;
        drop(increments);
        fs::remove_dir_all(folder.root().join(FOLDER))
            .map_err(|e| folder.error(&format!("{FOLDER}: {e}")))
    }

    /// Removes the checkpoints of a finished store, if that is allowed. A process that died at its
    /// very end may have left them.
    pub(super) fn clear(folder: &Folder) {
        if !Self::in_use(folder) {
            let _ = fs::remove_dir_all(folder.root().join(FOLDER));
        }
    }

    /// Checks that a process is writing the store.
    pub(super) fn in_use(folder: &Folder) -> bool {
        File::open(folder.root().join(INCREMENTS))
            .is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
    }

    /// Truncates the file `increments` to the increments of the state.
    fn truncate(&mut self, length: u64) -> Result<(), Error> {
        self.length = length;
        self.increments
            .set_len(length)
            .map_err(|e| self.folder.error(&format!("{INCREMENTS}: {e}")))
    }

    /// The bytes of a file of checkpoints; none if there is no such file.
    fn read(&self, name: &str) -> Result<Option<Vec<u8>>, Error> {
        self.folder
            .read(name)
            .map_err(|e| self.folder.error(&format!("{name}: {e}")))
    }
}

/// Writes a checkpoint: magic number, head, state, checksum (CRC-32).
fn encode(head: &Head, state: &State, file: &File) -> io::Result<()> {
    let mut to = ChecksumWriter {
        output: BufWriter::new(file),
        crc: crc32fast::Hasher::new(),
        failure: None,
    };
    to.write_all(MAGIC)?;
    let written = postcard::to_io(head, &mut to).and_then(|to| postcard::to_io(state, to));
    if let Err(error) = written {
        return Err(to.failure.unwrap_or_else(|| io::Error::other(error)));
    }
    let crc = to.crc.finalize();
    to.output.write_all(&crc.to_le_bytes())?;
    to.output.flush()
}

/// Reason and remedy for a checkpoint of another layout.
pub(super) const OTHER_LAYOUT: &str = "is of another layout than this version writes: what has been \
    solved can be read, but to go on, run the scene anew";

/// Reads a checkpoint and the increments that belong to it from the `log`; the error is why they are not valid.
/// `scene` is the checksum of the scene that they must have.
fn decode(bytes: &[u8], scene: u32, log: &[u8]) -> Result<(Head, State, Vec<Increment>), String> {
    let damaged = || "is damaged".to_owned();
    let (content, crc) = bytes.split_last_chunk::<CRC>().ok_or_else(damaged)?;
    if crc32fast::hash(content) != u32::from_le_bytes(*crc) {
        return Err(damaged());
    }
    let content = content.strip_prefix(MAGIC).ok_or(OTHER_LAYOUT)?;
    let (head, content): (Head, _) = postcard::take_from_bytes(content).map_err(|_| damaged())?;
    if head.version != env!("CARGO_PKG_VERSION") {
        return Err(format!(
            "is of version {}, this is version {}: resume with that one, or run the scene anew",
            head.version,
            env!("CARGO_PKG_VERSION")
        ));
    }
    if head.scene != scene {
        return Err("belongs to another scene".into());
    }
    let (state, remainder): (State, _) =
        postcard::take_from_bytes(content).map_err(|_| damaged())?;
    let log = usize::try_from(head.length).ok().and_then(|n| log.get(..n));
    let log = log.filter(|log| crc32fast::hash(log) == head.crc);
    let mut log = log.ok_or_else(|| format!("does not fit {INCREMENTS}, which is damaged"))?;
    let mut increments = Vec::new();
    while !log.is_empty() {
        let increment: Increment;
        (increment, log) = postcard::take_from_bytes(log).map_err(|_| damaged())?;
        increments.push(increment);
    }
    let in_order = increments.iter().map(|i| i.index).eq(1..=state.increments);
    if !remainder.is_empty() || !in_order {
        return Err(damaged());
    }
    Ok((head, state, increments))
}

/// Writes, updates the checksum of the written bytes, and keeps the error of the system.
struct ChecksumWriter<W> {
    output: W,
    crc: crc32fast::Hasher,
    failure: Option<io::Error>,
}

impl<W: Write> Write for ChecksumWriter<W> {
    /// Writes and updates checksum and length.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.output.write(bytes) {
            Ok(written) => {
                self.crc.update(&bytes[..written]);
                Ok(written)
            }
            Err(error) => {
                let kind = error.kind();
                self.failure = Some(error);
                Err(kind.into())
            }
        }
    }

    /// Flushes the file.
    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}
