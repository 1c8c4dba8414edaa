//! One line along x in the frequency domain: the kernels of one frequency k_y act on it.
//!
//! A line z is complex. On the whole grid it is the spectrum of the rows at one k_y; of a
//! mirror-symmetric scene, whose spectra along y are real, it holds two frequencies as a + i b.
//! With X = Z(k) and Y = conj Z(-k) the two frequencies are X + Y and X - Y up to constants, so
//! both cases load, multiply and store alike. Kernels even along x have real spectra S, odd ones
//! -i S, and S(-k) is +-S(k) accordingly, which makes the factor of Y that of X.

use rustfft::num_complex::Complex;

use super::complexes::{Complexes, Unit};
use super::line_spectra::{LANES, LineKernels};
use super::precision::Precision;

/// Groups of kernels.
#[derive(Clone, Copy)]
enum Group {
    Tangential,
    Normal,
    Coupling,
}

/// The kernel from a component of the tractions (column) to one of the displacements (row): group,
/// kernel in it, factor. An odd kernel gives -i along each axis, and the y components carry -i (see
/// `y_transform`).
const KERNELS: [[(Group, usize, Unit); 3]; 3] = {
    use Group::{Coupling, Normal, Tangential};
    use Unit::{I, MinusI, MinusOne, One};
    [
        [
            (Tangential, 0, One),
            (Tangential, 2, MinusI),
            (Coupling, 0, MinusI),
        ],
        [
            (Tangential, 2, I),
            (Tangential, 1, One),
            (Coupling, 1, MinusOne),
        ],
        [(Coupling, 0, I), (Coupling, 1, MinusOne), (Normal, 0, One)],
    ]
};

/// A line per component: `period + 1` numbers, the last of which repeats the first.
pub(crate) type Line<'a, T> = [&'a mut [Complex<T>]; 3];

/// Replaces the spectra of the tractions `given` by those of the displacements `wanted`, times
/// two if `mirrored`.
pub(crate) fn multiply<T: Precision>(
    mut line: Line<'_, T>,
    kernels: LineKernels<'_, T>,
    given: [bool; 3],
    wanted: [bool; 3],
    mirrored: bool,
) {
    let period = line[0].len() - 1;
    for z in &mut line {
        z[period] = z[0];
    }
    if mirrored {
        multiply_pairs::<T, true>(&mut line, kernels, given, wanted);
    } else {
        multiply_pairs::<T, false>(&mut line, kernels, given, wanted);
    }
}

fn multiply_pairs<T: Precision, const MIRRORED: bool>(
    line: &mut Line<'_, T>,
    kernels: LineKernels<'_, T>,
    given: [bool; 3],
    wanted: [bool; 3],
) {
    let half = (line[0].len() - 1) / 2;
    let whole = (half + 1) / LANES * LANES;
    for k in (0..whole).step_by(LANES) {
        at::<T, LANES, MIRRORED>(line, k, kernels, given, wanted);
    }
    for k in whole..=half {
        at::<T, 1, MIRRORED>(line, k, kernels, given, wanted);
    }
}

/// The frequencies k to k + N - 1 and their negatives.
#[inline]
fn at<T: Precision, const N: usize, const MIRRORED: bool>(
    line: &mut Line<'_, T>,
    k: usize,
    kernels: LineKernels<'_, T>,
    given: [bool; 3],
    wanted: [bool; 3],
) {
    let mut cause = [[Complexes::<T, N>::zero(); 2]; 3];
    for c in 0..3 {
        if given[c] {
            let end = line[c].len() - k;
            let x = Complexes::load(&line[c][k..k + N]);
            let y = Complexes::load_mirrored(&line[c][end - N..end]);
            cause[c] = split::<T, N, MIRRORED>([x, y]);
        }
    }
    let (block, lane) = (k / LANES, k % LANES);
    for e in 0..3 {
        if !wanted[e] {
            continue;
        }
        let mut sum = [Complexes::<T, N>::zero(); 2];
        for c in 0..3 {
            let (group, kernel, unit) = KERNELS[e][c];
            let (values, count) = match group {
                Group::Tangential => (kernels.tangential, 3),
                Group::Normal => (kernels.normal, 1),
                Group::Coupling => (kernels.coupling, 2),
            };
            if !given[c] || values.is_empty() {
                continue;
            }
            let each = if MIRRORED { 2 } else { 1 };
            let at = &values[(block * count + kernel) * each..][..each];
            sum[0].add(&lanes(&at[0], lane), unit, &cause[c][0]);
            sum[1].add(&lanes(&at[each - 1], lane), unit, &cause[c][1]);
        }
        let [x, y] = split::<T, N, MIRRORED>(sum);
        let end = line[e].len() - k;
        x.store(&mut line[e][k..k + N]);
        y.store_mirrored(&mut line[e][end - N..end]);
    }
}

/// (x + y, x - y) on a mirrored line: from the pair to its two frequencies, and back.
#[inline]
fn split<T: Precision, const N: usize, const MIRRORED: bool>(
    [x, y]: [Complexes<T, N>; 2],
) -> [Complexes<T, N>; 2] {
    if !MIRRORED {
        return [x, y];
    }
    [x.plus(&y), x.minus(&y)]
}

#[inline]
fn lanes<T: Precision, const N: usize>(block: &[T; LANES], first: usize) -> [T; N] {
    if N == LANES {
        std::array::from_fn(|i| block[i])
    } else {
        std::array::from_fn(|i| block[first + i])
    }
}
