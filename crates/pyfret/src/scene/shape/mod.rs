//! Shapes of the undeformed surfaces.

mod edged;
mod elementary;
mod flat;
mod map;
mod rough;
mod round;
mod sum;
mod waviness;

pub(crate) use edged::{Cone, FlatPunch, Wedge};
pub(crate) use flat::Flat;
pub(crate) use map::SurfaceMap;
pub(crate) use rough::Rough;
pub(crate) use round::{CrownedRoller, Cylinder, Ellipsoid, Sphere};
pub(crate) use sum::{Shape, Sum};
pub(crate) use waviness::Waviness;
