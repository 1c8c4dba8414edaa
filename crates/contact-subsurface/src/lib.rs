//! Stage 6: BELOW THE SURFACE: stress and displacement under the tractions; energy of the loops.
//!
//! [`Search`] finds the largest value of a number, an [`Extremum`], as a value at a point;
//! [`borders`] gives the rim of the contact and the border of the stick zone.
//!
//! Three kinds of output: [`Section`], lines along x or y at any depths, by one-dimensional
//! transforms; [`Slices`], whole planes parallel to the surface, by two-dimensional ones;
//! [`Points`], single points anywhere, by summation. One transform of each traction serves all
//! depths and components, and several states of a load path share the kernels.
//!
//! Depth z is counted into the body. Components refer to the axes of `docs/conventions.md`, in body
//! 1 as well. At an interface s_xx, s_yy and s_xy have two values: a [`Depth`] names the layer. The
//! stress is the stress by the tractions plus, if given, the bulk stress of the body, the residual
//! stress of its layers and the residual stress of its plastic strain ([`Eigenstress`]). The
//! displacements are caused by the tractions alone.
//! tractions alone.
//!
//! From a depth of eight cells on, the uniform load of a cell is replaced by point loads
//! on it and its neighbours that act alike to 1e-9 of the traction there; nearer to the surface it
//! is integrated over the cell.

#![forbid(unsafe_code)]

mod body_maximum;
mod borders;
mod climb;
mod coarser;
mod continuation;
mod counters;
mod cycle_recorder;
mod depth;
mod divided;
mod doubled_cells;
mod eigenstress;
mod energy;
mod envelope;
mod excess;
mod extremum;
mod largest;
mod line;
mod line_transform;
mod loads;
mod loop_point;
mod maximum;
mod measure;
mod moments;
mod near_rim;
mod parity;
mod peaks;
mod plane_transform;
mod plastic_strain;
mod points;
mod probe;
mod reversal;
mod search;
mod section;
mod slices;
mod states;
mod stream;
mod uniform;

pub use body_maximum::{BodyMaximum, BodySearch, Loads};
pub use borders::{Border, Zone, borders};
pub use continuation::Continuation;
pub use counters::stresses_computed;
pub use cycle_recorder::CycleRecorder;
pub use depth::{Depth, Point, Side, default_depths, depths};
pub use doubled_cells::DoubledCells;
pub use eigenstress::{Eigenstress, EigenstressSolver};
pub use energy::{Cycle, CycleErrors, finished_cycles, loops};
pub use envelope::{DepthEnvelope, Envelope, Extremes};
pub use extremum::{Errors, Extremum};
pub use largest::{DepthTops, Largest, MomentTops, largest_of_samples};
pub use line::Line;
pub use loop_point::{Direction, LoopPoint};
pub use maximum::{Top, top_of_line, top_of_plane};
pub use measure::{MEASURES, Measure, find_measure};
pub use moments::{
    CycleSource, Moments, SHAKEN, Yielding, half_width, main_sections, note_on_cycle,
    plastic_growth, traction_drift,
};
pub use plastic_strain::{Growth, RATCHETS};
pub use points::Points;
pub use probe::{Component, DISPLACEMENTS, Probe};
pub use search::{Probed, Search};
pub use section::Section;
pub use slices::Slices;
pub use states::States;
pub use stream::{Accumulate, Moment, Stream};
