//! Short cracks from a surface, against tables and closed cases: intensities, closure, growth and
//! arrest, films.

#![allow(clippy::unwrap_used)]

mod closure;
mod film;
mod growth;
mod jumps;
mod linear;
mod truth;
