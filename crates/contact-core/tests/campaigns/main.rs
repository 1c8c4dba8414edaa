//! Random scenes against what physics and finer solutions say of them: a few here, thousands by
//! `make stress`, `make path-errors`, `make error-bars`.

#[path = "../document/mod.rs"]
mod document;
mod error_bars;
mod path_error;
#[path = "../splitmix/mod.rs"]
mod splitmix;
mod stress;
