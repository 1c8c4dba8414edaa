//! The version of the layout of a store.

/// The conventions that the names of attributes follow (https://cfconventions.org).
pub(super) const CONVENTIONS: &str = "CF-1.11";
/// The version of the store's layout.
pub(super) const SCHEMA: u64 = 3;
/// Attribute of a store: the doubts about the run, a sentence a line; absent without doubts.
pub(super) const DOUBTS: &str = "doubts";
