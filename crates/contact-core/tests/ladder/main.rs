//! The ladder of truth: the whole solution against the closed forms, one contact per file.
//!
//! Every tolerance is the error that the discretisation must make: a boundary of the contact or
//! of the stick zone is known to a fraction of a cell, tractions are constant on a cell, a path is
//! as fine as its increments.

mod bench;
mod cattaneo_mindlin;
mod coupled_indentation;
mod hertz;
