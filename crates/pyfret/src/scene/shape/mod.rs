//! Shapes of the undeformed surfaces.

mod edged;
mod elementary;
mod map;
mod ridges;
mod rough;
mod round;
mod sum;
mod waviness;

pub(crate) use edged::{Cone, Flat, FlatPunch, Wedge};
pub(crate) use map::{SurfaceMap, check_sides, map_from_heights};
pub(crate) use ridges::{Ridges, Ring};
pub(crate) use rough::Rough;
pub(crate) use round::{CrownedRoller, Cylinder, Ellipsoid, Sphere};
pub(crate) use sum::{Shape, Sum};
pub(crate) use waviness::Waviness;
