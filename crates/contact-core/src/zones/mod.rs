//! Zones of a sampled field: where their borders run, how large they are, tractions continued to
//! them.

mod continued;
mod discrete_root;
mod edge;
mod laws;
mod level;
mod neighbours;
mod outline;
mod parabola;
mod rim_pressure;
mod sampled_border;
mod slip_zone;
mod spots;
mod stick_zone;

pub use continued::{CellTractions, Continued, Crossing};
pub(crate) use edge::Edge;
pub(crate) use laws::Power;
pub use laws::{SHRINKING, STICK};
pub(crate) use level::Line;
pub use level::{Level, Stencil};
pub use outline::{Outline, principal_azimuth};
pub use rim_pressure::continue_pressure_to_rim;
pub use slip_zone::slip_cells;
pub use spots::Spot;
pub(crate) use spots::{SpotCount, count_spots};
