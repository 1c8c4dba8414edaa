//! Will it crack, yield or shake down? Criteria of multiaxial fatigue on plain stress histories.
//!
//! Arrays in, numbers out: the source of a stress does not matter here. A history is of shape
//! (time, points, 6), components xx, yy, zz, xy, xz, yz, tension positive, in Pa. A [`History`] may
//! have the plastic strain beside it. [`evaluate`] applies a [`Criterion`] to all points in
//! parallel. It returns its value, the critical plane, and the most that another plane may have.
//! [`Assessment`] has a criterion's weights, limit and lives from the numbers of a [`Material`].
//! [`yielding`] gives load factors of first yield and of elastic shakedown.
//!
//! ```
//! use std::sync::atomic::AtomicBool;
//!
//! use fatigue::{Assessment, History, Search, evaluate, materials};
//! use ndarray::Array3;
//!
//! // Tension and torsion out of phase, 16 instants of one point.
//! let mut stress = Array3::zeros((16, 1, 6));
//! for t in 0..16 {
//!     let (sin, cos) = (std::f64::consts::TAU * t as f64 / 16.0).sin_cos();
//!     stress[(t, 0, 0)] = 300e6 * sin;
//!     stress[(t, 0, 3)] = 150e6 * cos;
//! }
//! let steel = &materials()["steel_42CrMo4"];
//! let findley = Assessment::from_name("findley", steel)?;
//! let never = AtomicBool::new(false);
//! let results = evaluate(&findley.criterion, &History::elastic(&stress.view()),
//! &Search::default(), &never)?; println!("on the plane {:?}: {:.3e} Pa", results[0].normal,
//! results[0].value); assert!((findley.safety_factor(results[0].value) - 1.108).abs() < 1e-3);
//! # Ok::<(), fatigue::Error>(())
//! ```

#![forbid(unsafe_code)]

mod assessment;
mod ball;
mod circle;
mod combination;
mod copositive;
mod criterion;
mod critical_plane;
mod definition;
mod eight_planes;
mod eight_weights;
mod error;
mod evaluate;
mod face_bound;
mod face_limit;
mod forms;
mod hemisphere;
mod histories;
mod history;
mod invariants;
mod judge;
mod lanes;
mod life;
mod miner;
mod on_planes;
mod path;
mod plane_function;
mod plane_stresses;
mod point_result;
mod product_bound;
mod range;
mod refine;
mod shakedown;
mod shear_bound;
mod spectrum;
mod tangent;
mod turns;

pub use assessment::{Assessment, LONGEST};
pub use ball::{Ball, smallest_ball};
pub use criterion::Criterion;
pub use critical_plane::Search;
pub use definition::{CRITERIA, Definition, Parameter};
pub use error::Error;
pub use evaluate::{evaluate, planes_judged};
pub use history::History;
pub use invariants::dang_van_path;
pub use judge::{Judge, strain_life};
pub use life::{Basquin, CoffinManson};
pub use material_table::{
    Allowed, ESTIMATE, Family, Known, Material, QUANTITIES, Quantity, Sourced, estimated, find,
    materials, nearest, read,
};
pub use miner::{BelowKnee, DamageCurve, PointDamage, sum_damage};
pub use point_result::PointResult;
pub use range::{LifeRange, Range};
pub use shakedown::{Yield, yielding};
pub use spectrum::{CycleDistribution, SpectralMoments};
pub use turns::find_turns;
