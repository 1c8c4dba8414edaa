//! Indentation with friction of dissimilar bodies.

use contact_core::reference as core;
use pyo3::prelude::*;

use crate::scene::Elastic;

#[pyfunction]
pub(crate) fn dundurs_beta(body1: Elastic, body2: Elastic) -> f64 {
    core::dundurs_beta(body1.0, body2.0)
}

#[pyfunction]
#[pyo3(signature = (*, beta, mu))]
pub(crate) fn goodman_stick_ratio(beta: f64, mu: f64) -> f64 {
    core::goodman_stick_ratio(beta, mu)
}
