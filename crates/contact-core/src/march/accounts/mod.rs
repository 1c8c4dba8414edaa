//! The accounts of an increment.

mod areas;
