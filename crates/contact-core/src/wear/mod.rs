//! Wear: what cycles do to the surfaces.

mod block;
mod compliant;
mod events;
mod law;
mod loss;
mod marched;
mod model;
mod outward;
mod pressing;
mod run;
mod settings;
mod shift;
mod sliding;
mod stroke;

pub use block::Block;
pub use events::{Event, EventKind};
pub use law::{Archard, BodyWear, CellCycle, DissipatedEnergy, Law};
pub use run::{Jump, WearRun, WearState};
pub use settings::{Cycling, Jumps, Wear, WornThrough};
