//! Wear against closed forms, finite elements and itself.

mod gross;
mod partial;
