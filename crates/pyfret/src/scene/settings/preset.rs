//! Families of algorithms.

use pyo3::prelude::*;

use crate::parts::members;

/// Families of algorithms.
///
/// ``FAST``: preconditioned solvers; sets and fields carried over and extrapolated.
/// ``SPINU2020``: the paper's, plain conjugate gradients in both directions, plain alternation.
#[pyclass(frozen, eq, eq_int, hash, from_py_object, module = "pyfret.settings")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Preset {
    #[pyo3(name = "FAST")]
    Fast,
    #[pyo3(name = "SPINU2020")]
    Spinu2020,
}

members!(Preset);
