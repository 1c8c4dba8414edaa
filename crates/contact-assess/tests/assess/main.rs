//! From stress to decision: a rig with its criterion, cracks.

mod cracks;
mod rig;
