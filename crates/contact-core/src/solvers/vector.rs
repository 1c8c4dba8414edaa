//! Sums over cells.

use std::ops::Range;

use rayon::prelude::*;

/// Numbers summed side by side, so that the sum runs at the speed of memory. Their order depends
/// on nothing but the length.
const LANES: usize = 8;

/// a . b
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    if a.len() > CHUNK {
        let middle = a.len() / 2;
        let ((a, a_rest), (b, b_rest)) = (a.split_at(middle), b.split_at(middle));
        let (first, rest) = rayon::join(|| dot(a, b), || dot(a_rest, b_rest));
        return first + rest;
    }
    let (a, a_rest) = a.as_chunks::<LANES>();
    let (b, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// Sum of all.
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

/// Size of a vector.
pub(crate) fn size(v: [f64; 2]) -> f64 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

/// Cells that one thread sums or changes in one go.
pub(crate) const CHUNK: usize = 4096;

/// Does two things to so many cells, side by side where these are worth it.
pub(crate) fn both<A: Send, B: Send>(
    cells: usize,
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    if cells > CHUNK {
        rayon::join(one, other)
    } else {
        (one(), other())
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

/// Sets every cell of two fields to their `values(n, old)`.
pub(crate) fn set_pairs(
    [a, b]: [&mut [f64]; 2],
    values: impl Fn(usize, [f64; 2]) -> [f64; 2] + Sync,
) {
    let chunks = (a.par_chunks_mut(CHUNK), b.par_chunks_mut(CHUNK)).into_par_iter();
    chunks.enumerate().for_each(|(i, (a, b))| {
        for (n, (a, b)) in (i * CHUNK..).zip(a.iter_mut().zip(b)) {
            [*a, *b] = values(n, [*a, *b]);
        }
    });
}

/// Sets every cell of four fields to their `values(n, old)`.
pub(crate) fn set_fours(
    [a, b, c, d]: [&mut [f64]; 4],
    values: impl Fn(usize, [f64; 4]) -> [f64; 4] + Sync,
) {
    let chunks = (
        a.par_chunks_mut(CHUNK),
        b.par_chunks_mut(CHUNK),
        c.par_chunks_mut(CHUNK),
        d.par_chunks_mut(CHUNK),
    );
    let chunks = chunks.into_par_iter().enumerate();
    chunks.for_each(|(chunk, (a, b, c, d))| {
        for i in 0..a.len() {
            let old = [a[i], b[i], c[i], d[i]];
            [a[i], b[i], c[i], d[i]] = values(chunk * CHUNK + i, old);
        }
    });
}

/// As [`set_pairs`], and sums of K terms that `values` gives with the new ones. Their order depends on
/// nothing but the number of cells.
pub(crate) fn set_and_sum<const K: usize>(
    [a, b]: [&mut [f64]; 2],
    values: impl Fn(usize, [f64; 2]) -> ([f64; 2], [f64; K]) + Sync,
) -> [f64; K] {
    set_and_sum_from(0, [a, b], &values)
}

fn set_and_sum_from<const K: usize>(
    from: usize,
    [a, b]: [&mut [f64]; 2],
    values: &(impl Fn(usize, [f64; 2]) -> ([f64; 2], [f64; K]) + Sync),
) -> [f64; K] {
    if a.len() > CHUNK {
        let middle = a.len() / 2;
        let ((a, a_rest), (b, b_rest)) = (a.split_at_mut(middle), b.split_at_mut(middle));
        let (mut sums, rest) = rayon::join(
            || set_and_sum_from(from, [a, b], values),
            || set_and_sum_from(from + middle, [a_rest, b_rest], values),
        );
        (0..K).for_each(|k| sums[k] += rest[k]);
        return sums;
    }
    let mut lanes = [[0.0; K]; 4];
    let set = |i: usize, a: &mut f64, b: &mut f64, sums: &mut [f64; K]| {
        let (new, terms) = values(from + i, [*a, *b]);
        [*a, *b] = new;
        (0..K).for_each(|k| sums[k] += terms[k]);
    };
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks_mut::<4>(), b.as_chunks_mut::<4>());
    let whole = 4 * a.len();
    for (i, (a, b)) in a.iter_mut().zip(b).enumerate() {
        for (l, lane) in lanes.iter_mut().enumerate() {
            set(4 * i + l, &mut a[l], &mut b[l], lane);
        }
    }
    for (i, (a, b)) in a_rest.iter_mut().zip(b_rest).enumerate() {
        set(whole + i, a, b, &mut lanes[0]);
    }
    std::array::from_fn(|k| (lanes[0][k] + lanes[1][k]) + (lanes[2][k] + lanes[3][k]))
}

/// Sums of K terms per cell, in chunks shared by the threads and in lanes within them. Their order
/// depends on nothing but the number of cells.
pub(crate) fn sum_cells<const K: usize>(
    cells: usize,
    term: impl Fn(usize) -> [f64; K] + Sync,
) -> [f64; K] {
    sums_of(0..cells, &term)
}

fn sums_of<const K: usize>(
    cells: Range<usize>,
    term: &(impl Fn(usize) -> [f64; K] + Sync),
) -> [f64; K] {
    let add = |a: &mut [f64; K], b: [f64; K]| (0..K).for_each(|k| a[k] += b[k]);
    if cells.len() > CHUNK {
        let middle = cells.start + cells.len() / 2;
        let (mut a, b) = rayon::join(
            || sums_of(cells.start..middle, term),
            || sums_of(middle..cells.end, term),
        );
        add(&mut a, b);
        return a;
    }
    let mut lanes = [[0.0; K]; 4];
    let mut n = cells.start;
    while n + 4 <= cells.end {
        for (l, lane) in lanes.iter_mut().enumerate() {
            add(lane, term(n + l));
        }
        n += 4;
    }
    (n..cells.end).for_each(|n| add(&mut lanes[0], term(n)));
    let [mut total, rest @ ..] = lanes;
    for lane in rest {
        add(&mut total, lane);
    }
    total
}

/// Largest of each of K `values(n)`, and zero.
pub(crate) fn largest<const K: usize>(
    cells: usize,
    values: impl Fn(usize) -> [f64; K] + Sync,
) -> [f64; K] {
    largest_of(0..cells, &values)
}

fn largest_of<const K: usize>(
    cells: Range<usize>,
    values: &(impl Fn(usize) -> [f64; K] + Sync),
) -> [f64; K] {
    let larger = |a: [f64; K], b: [f64; K]| std::array::from_fn(|k| f64::max(a[k], b[k]));
    if cells.len() > CHUNK {
        let middle = cells.start + cells.len() / 2;
        let (a, b) = rayon::join(
            || largest_of(cells.start..middle, values),
            || largest_of(middle..cells.end, values),
        );
        return larger(a, b);
    }
    cells.map(values).fold([0.0; K], larger)
}
