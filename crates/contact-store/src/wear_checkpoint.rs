//! The state of a run of wear after its last jump: the file `checkpoint/wear` of its store, with a
//! checksum.

use std::sync::Arc;

use contact_core::Error;
use contact_wear::WearState;
use serde::{Deserialize, Serialize};

use super::checkpoint::OTHER_LAYOUT;
use super::consolidated::Checksums;
use super::folder::Folder;

/// File name of the state in the folder of a checkpoint.
pub(super) const FILE: &str = "wear";
const CHECKPOINT: &str = "checkpoint/wear";
/// The first bytes of a checkpoint; the number is the version of the layout.
const MAGIC: &[u8] = b"fret wear checkpoint 3\n";

/// The blocks that are kept.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Kept {
    /// Cycles at each.
    pub(super) cycles: Vec<f64>,
    /// Checksums of their fields, block by block.
    pub(super) checksums: Checksums,
}

/// Writes the state and the list of the stored blocks.
pub(super) fn write_checkpoint(
    folder: &Arc<Folder>,
    state: &WearState,
    kept: &Kept,
) -> Result<(), Error> {
    let failed = |e: &dyn std::fmt::Display| folder.error(&format!("{CHECKPOINT}: {e}"));
    let mut bytes = MAGIC.to_vec();
    let content =
        postcard::to_stdvec(&(env!("CARGO_PKG_VERSION"), state, kept)).map_err(|e| failed(&e))?;
    bytes.extend(crc32fast::hash(&content).to_le_bytes());
    bytes.extend(content);
    std::fs::create_dir_all(folder.root().join("checkpoint")).map_err(|e| failed(&e))?;
    let write = |mut file: &std::fs::File| std::io::Write::write_all(&mut file, &bytes);
    folder
        .write_durably(CHECKPOINT, write)
        .map_err(|e| failed(&e))
}

/// Reads the state of the run and the list of the stored blocks; the error is why they cannot be read.
pub(super) fn read_checkpoint(folder: &Arc<Folder>) -> Result<(WearState, Kept), Error> {
    let damaged = |why: &str| folder.error(&format!("{CHECKPOINT} {why}"));
    let bytes = folder
        .read(CHECKPOINT)
        .map_err(|e| damaged(&e.to_string()))?;
    let bytes = bytes.ok_or_else(|| damaged("is missing"))?;
    let content = bytes
        .strip_prefix(MAGIC)
        .ok_or_else(|| damaged(OTHER_LAYOUT))?;
    let (crc, content) = content
        .split_at_checked(4)
        .ok_or_else(|| damaged("is cut off"))?;
    if crc != crc32fast::hash(content).to_le_bytes() {
        return Err(damaged("is damaged: its checksum differs"));
    }
    let decoded: Result<(String, WearState, Kept), _> = postcard::from_bytes(content);
    let (version, state, kept) = decoded.map_err(|e| damaged(&e.to_string()))?;
    if version != env!("CARGO_PKG_VERSION") {
        return Err(damaged(&format!("is of version {version}")));
    }
    Ok((state, kept))
}
