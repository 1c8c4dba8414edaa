//! Wear against closed forms, finite elements and itself.

mod bench;
mod coatings;
mod finite_elements;
mod gross_slip;
mod input;
mod invariants;
mod partial_slip;
mod resumed;
#[path = "../splitmix/mod.rs"]
mod splitmix;
