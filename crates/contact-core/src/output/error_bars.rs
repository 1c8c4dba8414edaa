//! Error bars in a store: its attribute `error_bars`, one object per branch.

use std::path::Path;

use serde_json::{Value, json};

use super::folder::Folder;
use super::reader::Store;
use crate::error::Error;
use crate::estimate::ErrorBars;

/// Adds the error bars of its branches to a store whose run is done.
pub fn write_error_bars(path: impl AsRef<Path>, bars: &[ErrorBars]) -> Result<(), Error> {
    let store = Store::open(&path)?;
    let folder = Folder::new(path.as_ref());
    let mut documents = store.metadata().clone();
    documents[".zattrs"]["error_bars"] = json!(bars);
    let write = |key: &str, document: &Value| {
        folder
            .write(key, format!("{document:#}").as_bytes())
            .map_err(|e| folder.error(&format!("{key}: {e}")))
    };
    write(".zattrs", &documents[".zattrs"])?;
    write(
        ".zmetadata",
        &json!({ "zarr_consolidated_format": 1, "metadata": documents }),
    )
}
