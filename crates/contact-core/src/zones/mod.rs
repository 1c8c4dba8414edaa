//! Zones of a sampled field: where their borders run, how large they are, tractions continued to them.

mod continued;
mod edge;
mod level;
mod parabola;
mod partial_cells;

pub(crate) use continued::Continued;
pub(crate) use edge::Edge;
pub(crate) use level::{Level, Line, Power, Told};
pub use partial_cells::continued_pressure;
pub(crate) use partial_cells::{SHRINKS, STICK};
