//! The ladder of truth: the whole solution against the closed forms, one contact per file.
//!
//! Every tolerance is the error that the discretisation must make. Tractions are constant on a
//! cell, so the rim of the contact or of the stick zone, continued from the cells inside, is known
//! to a small part of a cell ([`bench::RIM`]), and a field that rises from its rim like a square
//! root is off by as much in the L2 norm ([`bench::FIELD`]); integrals and smooth values are off by
//! the square of the cell ([`bench::SMOOTH`]). A path-dependent state is off by a part of an
//! increment.

mod any_path;
#[path = "../audit/mod.rs"]
mod audit;
mod bench;
mod bulk_stress;
mod cattaneo_mindlin;
mod chosen;
mod coated_hertz;
mod coupled_indentation;
mod energy;
mod entry;
mod figure_13;
mod friction;
mod gross_slip;
mod hertz;
mod invariants;
mod line;
mod mindlin_shear;
mod oblique;
mod paper_scene;
mod path_order;
mod rolling;
mod shapes;
mod strong_coupling;
mod tilt;
mod together;
mod torsion;
