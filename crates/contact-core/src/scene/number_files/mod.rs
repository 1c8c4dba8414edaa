//! Numbers in files: NumPy arrays and text as instruments and spreadsheets write it.
//!
//! A file is decoded ([`text`]), parted into fields ([`field`]) and rows ([`table`]); what the rows
//! are, a map, points or a profile, says [`heights`]. Load histories are read from the same tables.

mod field;
mod heights;
mod index;
mod npy;
mod points;
mod profile;
mod raster;
mod table;
mod text;
mod unit;

pub use heights::FileOfNumbers;
pub(in crate::scene) use heights::{Heights, heights};
pub(in crate::scene) use table::Table;
pub(in crate::scene) use text::strict;
pub use text::tolerant;
pub(in crate::scene) use unit::{Kind, named, names, of_titles};
