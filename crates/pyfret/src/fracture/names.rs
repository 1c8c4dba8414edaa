//! Names of the ends of cracks, and their paths.

use ::fracture as of_cracks;
use ndarray::Array1;

use crate::prelude::*;

/// The word for the reason why a crack ends.
pub(super) fn named(end: of_cracks::End) -> &'static str {
    match end {
        of_cracks::End::Reached => "reached",
        of_cracks::End::Closed => "closed",
        of_cracks::End::Surface => "surface",
        of_cracks::End::Kinks => "kinks",
    }
}

/// Adds the tips on the way to a result: length, x and depth \[m\], angle \[rad\].
pub(super) fn set_path(
    py: Python<'_>,
    result: &Bound<'_, PyDict>,
    tips: &[of_cracks::Point],
) -> PyResult<()> {
    let row =
        |f: &dyn Fn(&of_cracks::Point) -> f64| -> Array1<f64> { tips.iter().map(f).collect() };
    result.set_item("length", row(&|tip| tip.s).into_pyarray(py))?;
    result.set_item("x", row(&|tip| tip.x).into_pyarray(py))?;
    result.set_item("z", row(&|tip| tip.z).into_pyarray(py))?;
    result.set_item("angle", row(&|tip| tip.angle).into_pyarray(py))
}
