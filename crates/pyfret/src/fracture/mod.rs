//! Cracks: stress intensity, arrest, growth.

mod alone;
mod below;
mod film;
mod growth;
mod names;

pub(crate) use alone::Crack;
pub(crate) use below::ContactForCracks;
pub(crate) use film::{channel_crack, ellipse_factor, partial_crack};
pub(crate) use growth::{arrest, crack_life, equivalent_range, threshold_at};
