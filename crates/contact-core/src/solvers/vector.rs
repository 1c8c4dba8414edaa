//! Sums over cells.

/// a . b
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// y += factor * x
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

/// Mean of `value(n)` over the cells where `mask(n)`, and their number.
pub(crate) fn mean_where(
    cells: usize,
    mask: impl Fn(usize) -> bool,
    value: impl Fn(usize) -> f64,
) -> (f64, usize) {
    let (sum, count) = (0..cells)
        .filter(|&n| mask(n))
        .fold((0.0, 0), |(sum, count), n| (sum + value(n), count + 1));
    (if count > 0 { sum / count as f64 } else { 0.0 }, count)
}
