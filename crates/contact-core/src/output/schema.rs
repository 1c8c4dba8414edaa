//! What version of the layout a store has.

/// The conventions that the names of attributes follow (https://cfconventions.org).
pub(super) const CONVENTIONS: &str = "CF-1.11";
/// The version of the store's layout.
pub(super) const SCHEMA: u64 = 2;
/// Attribute of a store: what is to be doubted of the run, a sentence a line; none where nothing is.
pub(super) const DOUBTS: &str = "doubts";
