//! Numbers in files: NumPy arrays and text as instruments and spreadsheets write it.
//!
//! A file is decoded ([`text`]), split into fields ([`field`]) and rows ([`table`]); [`heights`] decides whether
//! the rows are a map, points or a profile. Load histories are read from the same tables.

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
pub(in crate::scene) use heights::{Heights, read_heights};
pub(in crate::scene) use table::Table;
pub use text::decode_any;
pub(in crate::scene) use text::decode_unicode;
pub(in crate::scene) use unit::{Kind, named, names, names_and_units};
