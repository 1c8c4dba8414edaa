//! Stage 7: FILES. The result store, one Zarr group that `xarray.open_zarr` opens.
//!
//! Zarr of version 2, which every Zarr library reads, with the dimension names of xarray. Scalars
//! have the dimension `increment`, fields `saved`, `x`, `y`; [`SCALARS`] and [`FIELDS`] describe
//! the variables. The attributes of the group hold the scene and how the run ended.
//!
//! [`StoreWriter`] appends during the run. Every file is replaced as a whole, the consolidated
//! metadata last. So a reader, during the run or after a crash, sees the store as it was at one
//! moment. The metadata hold a checksum of every chunk, too. Reading gives the values that were
//! written, or an error names the file ([`Store::verify`]). Beside the arrays the store holds a
//! checkpoint of the state, from which [`resume`] continues to the same result, bit by bit. Groups
//! are laid out beside their place and moved there at once: a path holds nothing, or a store.
//!
//! [`Columns`] and [`WearColumns`] keep the same variables in memory.
//!
//! Stress below the surface goes to a group of its own ([`StressStore`]) or to VTK image data
//! ([`ImageData`]), volumes plane by plane while they are computed ([`write_volume`]).

#![forbid(unsafe_code)]

mod attributes;
mod catalogue;
mod checkpoint;
mod column;
mod consolidated;
mod error_bars;
mod folder;
mod given_law;
mod image_data;
mod memory;
mod open;
mod place;
mod reader;
mod resume;
mod schema;
mod stored;
mod stored_cycle;
mod stress_store;
mod variable;
mod volume;
mod wear_catalogue;
mod wear_checkpoint;
mod wear_memory;
mod wear_resume;
mod wear_store;
mod whole;
mod worn_read;
mod writer;

pub use attributes::group_attributes;
pub use catalogue::{
    AXES, Axis, FIELDS, Field, FieldView, Kind, POINTS, PointVariable, SCALARS, STATUS_MEANINGS,
    Scalar, YIELDED, from_rows, to_rows,
};
pub use error_bars::{write_error_bars, write_no_error_bars};
pub use image_data::ImageData;
pub use memory::{Columns, KeptField};
pub use reader::Store;
pub use resume::{Resumed, resume, resume_with_law};
pub use stored_cycle::StoredCycle;
pub use stress_store::StressStore;
pub use volume::{VolumeSink, write_volume};
pub use wear_memory::{StoredVariable, WearColumns};
pub use wear_resume::{resume_wear, resume_wear_with_laws};
pub use wear_store::{WearStore, verify_wear};
pub use worn_read::read_worn;
pub use writer::StoreWriter;
