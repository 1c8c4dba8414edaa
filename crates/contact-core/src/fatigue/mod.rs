//! From stress to decision: whether a stress history cracks, yields or shakes down.
//!
//! Plain arrays in, numbers out: nothing here knows of contacts. Histories are of shape
//! (time, ..., 6), Voigt order xx, yy, zz, xy, xz, yz, tension positive, in Pa. [`evaluate`] takes a
//! [`Criterion`] to all points in parallel; [`Assessment`] has a criterion's weights, limit and
//! lives from a [`Material`]; [`yielding`] gives load factors of first yield and shakedown.

mod acting;
mod assessment;
mod at_point;
mod ball;
mod circle;
mod copositive;
mod criterion;
mod critical_plane;
mod eight_planes;
mod evaluate;
mod face_bound;
mod forms;
mod hemisphere;
mod invariants;
mod lanes;
mod law;
mod life;
mod limit;
mod material;
mod on_planes;
mod path;
mod plane_function;
mod product_bound;
mod refine;
mod shakedown;
mod shear_bound;
mod tangent;

pub use assessment::{Assessment, CRITERIA, Judge, strain_life};
pub use at_point::AtPoint;
pub use ball::{Ball, smallest_ball};
pub use criterion::Criterion;
pub use critical_plane::Search;
pub use evaluate::evaluate;
pub use invariants::dang_van_path;
pub use life::{Basquin, CoffinManson};
pub use material::{Material, QUANTITIES, Quantity, Sourced, materials, materials_from, read};
pub use shakedown::{Yield, yielding};
