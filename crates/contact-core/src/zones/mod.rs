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
mod spots;
mod stick_zone;

pub use continued::{Continued, Crossing, Within};
pub(crate) use edge::Edge;
pub(crate) use laws::Power;
pub use laws::{SHRINKS, STICK};
pub(crate) use level::Line;
pub use level::{Level, Stencil};
pub use outline::{Outline, azimuth_of};
pub use rim_pressure::continued_pressure;
pub use spots::Spot;
pub(crate) use spots::cells_per_radius;
