//! Wear against closed forms, finite elements and itself.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // figures with --nocapture; a test may fail

mod audit;
mod bench;
mod coatings;
#[path = "../../../contact-core/tests/files/mod.rs"]
mod files;
mod finite_elements;
mod gross_slip;
mod input;
mod invariants;
mod late;
mod laws;
mod over_cycles;
mod partial_slip;
mod random;
mod resumed;
#[path = "../../../contact-core/tests/splitmix/mod.rs"]
mod splitmix;
mod third_body;
