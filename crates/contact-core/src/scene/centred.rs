//! Measured heights about their mean: two passes over the memory of a large map.

use ndarray::{Array2, ArrayView2, ShapeBuilder};
use rayon::prelude::*;

/// Points of a piece. Sums are taken piece by piece, whatever the number of threads is.
const PIECE: usize = 1 << 15;
/// Sums that run beside each other in a piece.
const LANES: usize = 8;

/// Heights less their mean over the points with a number.
pub(super) struct Centred {
    /// Heights; a hole is NaN.
    pub(super) values: Array2<f64>,
    /// Number of holes.
    pub(super) holes: usize,
    /// Root of the mean square: S_q of ISO 25178-2.
    pub(super) rms: f64,
}

/// Subtracts the mean of the points with a number. Fails with a place (i, j) that has no finite
/// height.
pub(super) fn centre(heights: &ArrayView2<'_, f64>) -> Result<Centred, (usize, usize)> {
    let (nx, ny) = heights.dim();
    let along_y = heights.is_standard_layout() || !heights.t().is_standard_layout();
    // A copy of a view with steps or turned lines alone.
    let turned = heights.t();
    let lines = if along_y { heights } else { &turned }.as_standard_layout();
    let numbers = lines.as_slice().unwrap_or_default();
    let sums = numbers.par_chunks(PIECE).map(|piece| {
        let holes = piece.iter().filter(|z| z.is_nan()).count();
        (sum(piece, |z| if z.is_nan() { 0.0 } else { z }), holes)
    });
    let sums: Vec<_> = sums.collect();
    let holes: usize = sums.iter().map(|(_, holes)| holes).sum();
    let measured = (numbers.len() - holes).max(1) as f64;
    let mean = sums.iter().map(|(sum, _)| sum).sum::<f64>() / measured;
    if !mean.is_finite() {
        let index = numbers.iter().position(|z| z.is_infinite()).unwrap_or(0);
        let (line, point) = (index / lines.ncols(), index % lines.ncols());
        return Err(if along_y {
            (line, point)
        } else {
            (point, line)
        });
    }
    let mut values = vec![0.0; numbers.len()];
    let squares = (values.par_chunks_mut(PIECE)).zip(numbers.par_chunks(PIECE));
    let squares = squares.map(|(values, heights)| {
        for (value, z) in values.iter_mut().zip(heights) {
            *value = z - mean;
        }
        sum(values, |z| if z.is_nan() { 0.0 } else { z * z })
    });
    let squares: Vec<f64> = squares.collect();
    let rms = (squares.iter().sum::<f64>() / measured).sqrt();
    let values = if along_y {
        Array2::from_shape_vec((nx, ny), values)
    } else {
        Array2::from_shape_vec((nx, ny).f(), values)
    };
    let values = values.unwrap_or_default();
    Ok(Centred { values, holes, rms })
}

/// Sums a function of the numbers in [`LANES`] lanes.
fn sum(numbers: &[f64], term: impl Fn(f64) -> f64) -> f64 {
    let mut lanes = [0.0; LANES];
    let groups = numbers.chunks_exact(LANES);
    let last: f64 = groups.remainder().iter().map(|z| term(*z)).sum();
    for group in groups {
        for (lane, z) in lanes.iter_mut().zip(group) {
            *lane += term(*z);
        }
    }
    lanes.iter().sum::<f64>() + last
}

#[cfg(test)]
mod tests {
    use ndarray::{Array2, Axis, Slice};

    use super::centre;

    #[test]
    fn heights_of_any_layout_are_centred() {
        let base = Array2::from_shape_fn((301, 203), |(i, j)| (i * i + 7 * j) as f64);
        let mean = base.mean().unwrap();
        for view in [
            base.view(),
            base.t(),
            base.slice_axis(Axis(1), Slice::new(0, None, -1)),
            base.slice_axis(Axis(0), Slice::new(0, None, 2)),
        ] {
            let centred = centre(&view).unwrap();
            let mean = view.mean().unwrap();
            let expected = view.mapv(|z| z - mean);
            let rms = (expected.mapv(|z| z * z).mean().unwrap()).sqrt();
            assert!((&centred.values - &expected).iter().all(|z| z.abs() < 1e-9));
            assert!((centred.rms / rms - 1.0).abs() < 1e-12);
            assert_eq!(centred.holes, 0);
        }
        let mut holed = base.clone();
        holed[(3, 4)] = f64::NAN;
        let centred = centre(&holed.view()).unwrap();
        assert!(centred.values[(3, 4)].is_nan());
        assert_eq!(centred.holes, 1);
        let without = (base.sum() - base[(3, 4)]) / (base.len() - 1) as f64;
        assert!((centred.values[(0, 0)] + without).abs() < 1e-9);
        assert!((mean - without).abs() > 1e-3);
        holed[(5, 6)] = f64::INFINITY;
        assert_eq!(centre(&holed.t()).err(), Some((6, 5)));
    }
}
