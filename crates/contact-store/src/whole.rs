//! Checks that a store is whole: its consolidated metadata, and every file that they list.

use std::sync::Arc;

use contact_core::Error;
use rayon::prelude::*;
use serde_json::Value;

use super::attributes::END_ATTRIBUTES;
use super::consolidated::{Consolidated, FILE};
use super::folder::Folder;
use super::schema::SCHEMA;
use super::stored::Stored;

/// Reads the consolidated metadata of a store. Fails if there are none, if they have another layout
/// or if they are damaged.
pub(super) fn consolidated(folder: &Folder) -> Result<Consolidated, Error> {
    match read_folder(folder)? {
        Found::Store(consolidated) => Ok(consolidated),
        Found::Copy(_) => Err(folder.error(
            &"is a copy without checksums, as `save` or xarray write one. It can be read, but a run cannot go on \
              from it. The store itself has checksums",
        )),
    }
}

/// The kind of store in a folder.
pub(super) enum Found {
    /// A store with its checksums.
    Store(Consolidated),
    /// A copy that another program has written, without checksums.
    Copy(Consolidated),
}

/// Reads the kind of store in a folder; fails as [`consolidated`].
pub(super) fn read_folder(folder: &Folder) -> Result<Found, Error> {
    let text = folder
        .read(FILE)
        .map_err(|e| folder.error(&format!("{FILE}: {e}")))?
        .ok_or_else(|| folder.error(&"is not a result store (it has no .zmetadata)"))?;
    let damaged = |e: &dyn std::fmt::Display| folder.error(&format!("{FILE} is damaged: {e}"));
    let (consolidated, whole) = Consolidated::decode(&text).map_err(|e| damaged(&e))?;
    match consolidated.document(".zattrs")["schema"] {
        Value::Null => Err(folder.error(&"is not a result store (it has no schema)")),
        ref schema if *schema != SCHEMA => Err(folder.error(&format!(
            "is a store of schema {schema}: this version reads schema {SCHEMA}; solve its scene again \
             (the attribute `scene` holds it)"
        ))),
        _ if !whole && !text_has_sums(&text) => Ok(Found::Copy(consolidated)),
        _ if !whole => Err(damaged(&"it is not what was written")),
        _ => Ok(Found::Store(consolidated)),
    }
}

/// Checks that metadata hold any checksum, their own or the checksums of the arrays.
fn text_has_sums(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text);
    text.contains("\"checksums\"") || text.contains("\"crc32\"")
}

/// Checks every document and every chunk; the error names the first file that is missing or damaged.
pub(super) fn verify(folder: &Arc<Folder>, consolidated: &Consolidated) -> Result<(), Error> {
    for key in [".zgroup", ".zattrs"] {
        check_document(folder, consolidated, key)
            .map_err(|e| folder.error(&format!("the file {key} {e}")))?;
    }
    let arrays = consolidated.documents.keys();
    let arrays: Vec<_> = arrays
        .filter_map(|key| key.strip_suffix("/.zarray"))
        .collect();
    arrays.par_iter().try_for_each(|name| {
        let stored = array(folder, consolidated, name)?;
        let verified = stored.verify(&stored.whole());
        verified.map_err(|e| folder.error(&format!("{name}: {e}")))
    })
}

/// Opens an array of the store, with its checksums.
pub(super) fn array<'a>(
    folder: &Arc<Folder>,
    consolidated: &'a Consolidated,
    name: &str,
) -> Result<Stored<'a>, Error> {
    let zarray = consolidated.document(&format!("{name}/.zarray"));
    if zarray.is_null() {
        return Err(folder.error(&format!("holds no {name}")));
    }
    // A copy has none of them, a store one list for each array.
    let checksums = (!consolidated.checksums.is_empty()).then(|| {
        consolidated
            .checksums
            .get(name)
            .map_or(&[][..], Vec::as_slice)
    });
    Stored::new(folder, name, zarray, checksums)
}

/// Fails if a document of the group differs from the consolidated metadata, except in how the run ended: a
/// process may have died between writing the two.
fn check_document(folder: &Folder, consolidated: &Consolidated, key: &str) -> Result<(), String> {
    let bytes = folder.read(key).map_err(|e| e.to_string())?;
    let bytes = bytes.ok_or("is missing")?;
    let read: Value = serde_json::from_slice(&bytes).map_err(|e| format!("is damaged: {e}"))?;
    let without_end = |document: &Value| {
        let mut document = document.clone();
        if let Value::Object(entries) = &mut document {
            entries.retain(|key, _| !END_ATTRIBUTES.contains(&key.as_str()));
        }
        document
    };
    if without_end(&read) != without_end(consolidated.document(key)) {
        return Err(format!("is damaged: it differs from {FILE}"));
    }
    Ok(())
}
