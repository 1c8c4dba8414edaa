//! Engineering materials by their names: numbers with their sources.
//!
//! The scene file takes moduli from here, the criteria of fatigue their limits and lives.
//!
//! ```
//! use material_table::{find, materials};
//!
//! let table = materials();
//! let titanium = find(&table, "Ti-6Al-4V").unwrap();
//! assert_eq!(titanium.name, "titanium_6Al4V");
//! assert!(titanium.number("E")? > 1e11);
//! # Ok::<(), material_table::Error>(())
//! ```

#![forbid(unsafe_code)]

mod allowed;
mod distance;
mod error;
mod estimate;
mod known;
mod material;
mod table;

pub use allowed::Allowed;
pub use error::Error;
pub use estimate::{Family, MARK as ESTIMATE, estimated};
pub use known::Known;
pub use material::{Material, QUANTITIES, Quantity, Sourced};
pub use table::{find, materials, nearest, read};
