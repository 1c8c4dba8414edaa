//! Error bars in a store: its attribute `error_bars`, one object per branch.

use std::path::Path;

use contact_core::Error;
use contact_core::estimate::ErrorBars;
use contact_core::scene::Grid;
use serde_json::{Map, Value, json};

use super::catalogue::HALF_WIDTH;
use super::consolidated::FILE;
use super::folder::Folder;
use super::reader::Store;
use super::schema::DOUBTS;

/// Adds the error bars of its branches to a store whose run is done.
pub fn write_error_bars(path: impl AsRef<Path>, bars: &[ErrorBars]) -> Result<(), Error> {
    let grid = Store::open(path.as_ref())?.scene().grid;
    change_attributes(path.as_ref(), |attributes| {
        attributes["error_bars"] = to_attributes(bars, &grid);
    })
}

/// Converts the error bars of the branches of a run to an attribute: lists by the names of the variables.
pub(super) fn to_attributes(bars: &[ErrorBars], grid: &Grid) -> Value {
    let mut attributes = json!(bars);
    if grid.plane_strain {
        for bar in attributes.as_array_mut().into_iter().flatten() {
            let half = bar
                .as_object_mut()
                .and_then(|bar| bar.remove("contact_radius"));
            bar[HALF_WIDTH.0] = half.into();
        }
    }
    attributes
}

/// Writes into a finished store why it has no error bars, and returns that sentence.
pub fn write_no_error_bars(path: impl AsRef<Path>, why: &Error) -> Result<String, Error> {
    let mut doubt = String::new();
    change_attributes(path.as_ref(), |attributes| {
        if let Some(attributes) = attributes.as_object_mut() {
            doubt = doubt_bars(attributes, why);
        }
    })?;
    Ok(doubt)
}

/// Adds to the doubts why there are no error bars, and returns that sentence.
pub(super) fn doubt_bars(attributes: &mut Map<String, Value>, why: &Error) -> String {
    let doubt = format!(
        "no error bars: the run on another grid or path, which estimates the errors, failed: {why}"
    );
    let earlier = attributes.get(DOUBTS).and_then(Value::as_str);
    let doubts = earlier.map_or(doubt.clone(), |earlier| format!("{earlier}\n{doubt}"));
    attributes.insert(DOUBTS.into(), json!(doubts));
    doubt
}

/// Changes the attributes of a store whose run is done, and writes the metadata again.
fn change_attributes(path: &Path, change: impl FnOnce(&mut Value)) -> Result<(), Error> {
    let store = Store::open(path)?;
    let folder = Folder::new(path);
    let mut metadata = store.consolidated().clone();
    change(&mut metadata.documents[".zattrs"]);
    let attributes = metadata.document(".zattrs");
    folder.put(".zattrs", &format!("{attributes:#}"))?;
    folder.put(FILE, &metadata.encode())
}
