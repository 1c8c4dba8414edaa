//! Error bars in a store: its attribute `error_bars`, one object per branch.

use std::path::Path;

use serde_json::{Value, json};

use super::consolidated::FILE;
use super::folder::Folder;
use super::reader::Store;
use super::schema::DOUBTS;
use crate::error::Error;
use crate::estimate::ErrorBars;

/// Adds the error bars of its branches to a store whose run is done.
pub fn write_error_bars(path: impl AsRef<Path>, bars: &[ErrorBars]) -> Result<(), Error> {
    change(path.as_ref(), |attributes| {
        attributes["error_bars"] = json!(bars);
    })
}

/// Says in a store whose run is done why it has no error bars, and returns that.
pub fn write_no_error_bars(path: impl AsRef<Path>, why: &Error) -> Result<String, Error> {
    let doubt = format!("no error bars: another grid or path that tells the errors failed: {why}");
    change(path.as_ref(), |attributes| {
        let others = attributes[DOUBTS]
            .as_str()
            .map(|others| format!("{others}\n"));
        attributes[DOUBTS] = json!(others.unwrap_or_default() + &doubt);
    })?;
    Ok(doubt)
}

/// Changes the attributes of a store whose run is done.
fn change(path: &Path, change: impl FnOnce(&mut Value)) -> Result<(), Error> {
    let store = Store::open(path)?;
    let folder = Folder::new(path);
    let mut metadata = store.consolidated().clone();
    change(&mut metadata.documents[".zattrs"]);
    let attributes = metadata.document(".zattrs");
    folder.put(".zattrs", &format!("{attributes:#}"))?;
    folder.put(FILE, &metadata.encode())
}
