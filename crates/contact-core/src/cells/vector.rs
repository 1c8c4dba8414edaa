//! Sums over cells.

use rayon::prelude::*;

use crate::convolution::PARALLEL_FROM;

/// Numbers summed side by side, so that the sum runs at the speed of memory. Their order depends
/// on nothing but the length.
const LANES: usize = 8;

/// Dot product a . b; long fields are summed in halves on two threads, always in the same order.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    if a.len() > CHUNK {
        let middle = a.len() / 2;
        let ((a, a_second), (b, b_second)) = (a.split_at(middle), b.split_at(middle));
        let (first, second) = rayon::join(|| dot(a, b), || dot(a_second, b_second));
        return first + second;
    }
    let (a, a_rest) = a.as_chunks::<LANES>();
    let (b, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let remainder: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + remainder
}

/// Sum of all entries, always in the same order.
pub(crate) fn sum(a: &[f64]) -> f64 {
    let (a, rest) = a.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for a in a {
        for lane in 0..LANES {
            sums[lane] += a[lane];
        }
    }
    sums.iter().sum::<f64>() + rest.iter().sum::<f64>()
}

/// Length of a vector in the plane.
pub fn length(v: [f64; 2]) -> f64 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

/// Cells that one thread sums or changes in one go.
pub(crate) const CHUNK: usize = PARALLEL_FROM;

/// Runs two functions, in parallel if there are enough `cells`.
pub(crate) fn run_both<A: Send, B: Send>(
    cells: usize,
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    if cells > CHUNK {
        rayon::join(first, second)
    } else {
        (first(), second())
    }
}

/// y += factor * x
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    let chunks = y.par_chunks_mut(CHUNK).zip(x.par_chunks(CHUNK));
    chunks.for_each(|(y, x)| y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x));
}

/// Copies a field, in chunks shared by the threads.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn copy<T: Copy + Send + Sync>(from: &[T], to: &mut [T]) {
    assert_eq!(from.len(), to.len(), "a copy has the length of the field");
    let chunks = to.par_chunks_mut(CHUNK).zip(from.par_chunks(CHUNK));
    chunks.for_each(|(to, from)| to.copy_from_slice(from));
}

/// Copies a field to one that takes its length.
pub(crate) fn copy_to<T: Copy + Send + Sync + Default>(from: &[T], to: &mut Vec<T>) {
    to.resize(from.len(), T::default());
    copy(from, to);
}

/// Sets every cell to its `value(n, old)`, in chunks shared by the threads.
pub(crate) fn set_cells<T: Copy + Send>(field: &mut [T], value: impl Fn(usize, T) -> T + Sync) {
    let chunks = field.par_chunks_mut(CHUNK).enumerate();
    chunks.for_each(|(i, chunk)| {
        for (n, v) in (i * CHUNK..).zip(chunk) {
            *v = value(n, *v);
        }
    });
}
