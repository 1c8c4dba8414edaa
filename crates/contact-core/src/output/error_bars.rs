//! Error bars in a store: its attribute `error_bars`, one object per branch.

use std::path::Path;

use serde_json::json;

use super::consolidated::FILE;
use super::folder::Folder;
use super::reader::Store;
use crate::error::Error;
use crate::estimate::ErrorBars;

/// Adds the error bars of its branches to a store whose run is done.
pub fn write_error_bars(path: impl AsRef<Path>, bars: &[ErrorBars]) -> Result<(), Error> {
    let store = Store::open(&path)?;
    let folder = Folder::new(path.as_ref());
    let mut metadata = store.consolidated().clone();
    metadata.documents[".zattrs"]["error_bars"] = json!(bars);
    let attributes = metadata.document(".zattrs");
    folder.put(".zattrs", &format!("{attributes:#}"))?;
    folder.put(FILE, &metadata.encode())
}
