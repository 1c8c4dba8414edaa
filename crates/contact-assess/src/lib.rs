//! Stage 7: FROM STRESS TO DECISION: does it crack, yield or shake down, over a closed cycle of a
//! contact.
//!
//! A [`Judge`] judges the stress history of a point: [`CriterionJudge`] by a fatigue criterion,
//! [`YieldJudge`] by load factors of first yield and shakedown. [`judge`] applies it to a section, a
//! few depths at a time, so that memory is bounded for any number of increments ([`CycleSource`](contact_subsurface::CycleSource)
//! gives them, from a store or from arrays); [`find_worst_point`] finds the worst point of a layer, between
//! the samples and on the rim of the contact, by judging the stress there; [`judge_means`] judges means
//! over a critical distance of the material, and [`margin_range`] gives the low, best and high
//! margin. [`crack`] gives the stress intensity of a crack under
//! the stress below a contact.

#![forbid(unsafe_code)]

mod average;
mod by_criterion;
mod by_yield;
mod cache;
mod climb;
pub mod crack;
mod history;
mod judged;
mod mean;
mod prepared_points;
mod range;
mod site;
mod worst;

pub use average::{Averaging, Distance, judge_means};
pub use by_criterion::{CriterionJudge, from_fatigue, inclination, layer_materials};
pub use by_yield::YieldJudge;
pub use cache::{MOST_CONTINUATIONS, MOST_HISTORIES, MOST_MOMENTS, MOST_POINTS, StressCache};
pub use judged::{Judge, Judged, judge};
pub use mean::{LargestMean, error_of_largest_mean, errors_of_means, largest_mean};
pub use range::{MarginRange, RangeOptions, margin_range};
pub use site::Site;
pub use worst::{WorstPoint, find_worst_point};
