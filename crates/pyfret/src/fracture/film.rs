//! Cracks in films, and fronts that are half an ellipse.

use ::fracture as of_cracks;

use crate::error::Answer;
use crate::material::Elastic;
use crate::prelude::*;

/// Factor from the plane K to the deepest point of a semi-elliptic crack of the aspect a/c <= 1.
///
/// Newman and Raju's K under uniform tension over the K of a straight front: an estimate, which
/// takes the stress as constant along the front. J. C. Newman, I. S. Raju, NASA TM 85793 (1984).
#[pyfunction]
#[pyo3(signature = (aspect: "float"))]
pub(crate) fn ellipse_factor(#[pyo3(from_py_with = number)] aspect: f64) -> Answer<f64> {
    Ok(of_cracks::ellipse_factor(aspect)?)
}

/// The film of the material `film` on the material `below`.
fn film(film: Elastic, below: Elastic) -> Answer<of_cracks::Film> {
    let pair = |m: Elastic| (m.0.E, m.0.nu);
    Ok(of_cracks::Film::from_moduli(pair(film), pair(below))?)
}

/// Factor g of a channel crack in a film; use :func:`pyfret.fracture.channel_release`.
#[pyfunction]
pub(crate) fn channel_crack(py: Python<'_>, film_: Elastic, below: Elastic) -> Answer<f64> {
    let film = film(film_, below)?;
    Ok(py.detach(|| film.channel())?)
}

/// Factor F of a crack with its tip in a film; use :func:`pyfret.fracture.film_intensity`.
#[pyfunction]
#[pyo3(signature = (film_, below, depth: "Length"))]
pub(crate) fn partial_crack(
    py: Python<'_>,
    film_: Elastic,
    below: Elastic,
    #[pyo3(from_py_with = Given::depth)] depth: f64,
) -> Answer<f64> {
    let film = film(film_, below)?;
    Ok(py.detach(|| film.partial(depth))?)
}
