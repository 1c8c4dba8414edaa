//! Wear of the surfaces over cycles. Stands above the march and runs marches.
//!
//! A cycle of the load path wears each cell of each body by a depth. A [`Law`] computes it from the
//! integral of the pressure over the slip `int p |ds|`, the slip and the energy dissipated there.
//! Thousands of cycles are done in jumps: a jump of n cycles wears n times the depth of one cycle
//! at the pressure of its end. `n k s` is then a compliance in series with the half-space in every
//! cell (`compliant`), and jumps of any length are stable. A cycle is solved in one of two manners
//! ([`Cycling`]). The first goes increment by increment through the march (`marched`). The second
//! solves, in gross slip with any stroke, the normal problem alone at each place of the stroke,
//! with the worn surfaces in their shifted positions (`sliding`). Each jump is made whole and in
//! two halves, extrapolated to second order; the difference controls its length (`run`). Within a
//! jump each cell follows its law through the bends of tables, layers and laws that stop
//! (`course`); a jump ends where a table of cycles bends.

#![forbid(unsafe_code)]

mod aerated;
mod air;
mod anderson;
mod attempt;
mod block;
mod border;
mod compliant;
mod course;
mod cycled;
mod debris_bed;
mod events;
mod fixed_point;
mod jump;
mod law;
mod loss;
mod marched;
mod method;
mod mixed_cells;
mod model;
mod on_grid;
mod outward;
mod own_friction;
mod passage;
mod peak;
mod pressing;
mod rates;
mod run;
mod scar;
mod settings;
mod settled;
mod shift;
mod sliding;
mod slip_zone;
mod spots;
mod state;
mod stroke;
mod surface_friction;
mod table;
mod third_body;
mod third_body_table;
mod variable;
mod varying;
mod width;
mod within_cell;
mod worn_start;

pub use aerated::Aerated;
pub use air::{Air, Reaction};
pub use block::Block;
pub use debris_bed::DebrisBed;
pub use events::{Event, EventKind};
pub use jump::Jump;
pub use law::{Archard, BodyWear, CellCycle, DissipatedEnergy, Law};
pub use passage::DEPTH_ROUNDING;
pub use run::WearRun;
pub use scar::Scar;
pub use settings::{Cycling, Jumps, Wear, WornThrough};
pub use state::WearState;
pub use variable::FactorVariable;
pub use varying::{Factor, Varying};
pub use worn_start::WornStart;
