//! One line along x in the frequency domain: the kernels of one frequency k_y act on it.
//!
//! A line z is complex. On the whole grid it is the spectrum of the rows at one k_y; of a
//! mirror-symmetric scene, whose spectra along y are real, it holds two frequencies as a + i b.
//! With X = Z(k) and Y = conj Z(-k) the two frequencies are X + Y and X - Y up to constants, so
//! both cases load, multiply and store alike. Kernels even along x have real spectra S, odd ones
//! -i S. S(-k) is +-S(k) accordingly, so that the factor of Y equals the factor of X.

// Properties of kernels and components that are compile-time constants leave the loop only if all
// of it is compiled into one function.
#![allow(clippy::inline_always)]

use rustfft::num_complex::Complex;

use super::complexes::{ComplexBlock, Unit};
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

/// Multiplies a line by the kernels: the spectra of the tractions that act are replaced by the spectra of the
/// displacements wanted, times two if `mirrored`.
pub(crate) fn multiply<T: Precision>(
    mut line: Line<'_, T>,
    kernels: LineKernels<'_, T>,
    acting: [bool; 3],
    wanted: [bool; 3],
    mirrored: bool,
) {
    let period = line[0].len() - 1;
    for z in &mut line {
        z[period] = z[0];
    }
    if mirrored {
        multiply_pairs::<T, true>(&mut line, kernels, acting, wanted);
    } else {
        multiply_pairs::<T, false>(&mut line, kernels, acting, wanted);
    }
}

/// Sets of components as compile-time constants: the two of nearly all
/// products, and any.
const SHEAR: u8 = 0b011;
const PRESSURE: u8 = 0b100;
const ANY: u8 = 0;

/// Calls the product that is compiled for these flags: shear to tangential displacements, pressure to normal
/// displacement, or any.
fn multiply_pairs<T: Precision, const MIRRORED: bool>(
    line: &mut Line<'_, T>,
    kernels: LineKernels<'_, T>,
    acting: [bool; 3],
    wanted: [bool; 3],
) {
    let product = Product::<T> {
        kernels,
        acting,
        wanted,
    };
    match (acting, wanted) {
        ([true, true, false], [true, true, false]) => product.multiply_all::<MIRRORED, SHEAR>(line),
        ([false, false, true], [false, false, true]) => {
            product.multiply_all::<MIRRORED, PRESSURE>(line);
        }
        _ => product.multiply_all::<MIRRORED, ANY>(line),
    }
}

/// The kernels of a line, from the tractions that act to the displacements wanted.
struct Product<'a, T> {
    kernels: LineKernels<'a, T>,
    acting: [bool; 3],
    wanted: [bool; 3],
}

/// N numbers at a frequency, or at a pair of them.
type Pair<T, const N: usize> = [ComplexBlock<T, N>; 2];

impl<T: Precision> Product<'_, T> {
    /// Multiplies all frequencies of a line, in blocks of [`LANES`] and then singly. `SET` is the set of
    /// components that the code is compiled for.
    fn multiply_all<const MIRRORED: bool, const SET: u8>(&self, line: &mut Line<'_, T>) {
        let half = (line[0].len() - 1) / 2;
        let full_blocks = (half + 1) / LANES * LANES;
        for k in (0..full_blocks).step_by(LANES) {
            self.multiply_block::<LANES, MIRRORED, SET>(line, k);
        }
        for k in full_blocks..=half {
            self.multiply_block::<1, MIRRORED, SET>(line, k);
        }
    }

    /// Whether a component acts or is wanted: by the `flags`, or by `SET` where it is fixed at compile time.
    #[inline(always)]
    fn is_in<const SET: u8>(flags: [bool; 3], component: usize) -> bool {
        if SET == ANY {
            flags[component]
        } else {
            SET >> component & 1 == 1
        }
    }

    /// Multiplies the frequencies k to k + N - 1 and their negatives by the kernels.
    #[inline(always)]
    fn multiply_block<const N: usize, const MIRRORED: bool, const SET: u8>(
        &self,
        line: &mut Line<'_, T>,
        k: usize,
    ) {
        let tractions = [
            self.load_traction::<N, MIRRORED, SET, 0>(line, k),
            self.load_traction::<N, MIRRORED, SET, 1>(line, k),
            self.load_traction::<N, MIRRORED, SET, 2>(line, k),
        ];
        self.compute_displacement::<N, MIRRORED, SET, 0>(line, k, &tractions);
        self.compute_displacement::<N, MIRRORED, SET, 1>(line, k, &tractions);
        self.compute_displacement::<N, MIRRORED, SET, 2>(line, k, &tractions);
    }

    /// Loads the spectrum of traction C (0: q_x, 1: q_y, 2: p) at N frequencies and their negatives; zero where
    /// it does not act.
    #[inline(always)]
    fn load_traction<const N: usize, const MIRRORED: bool, const SET: u8, const C: usize>(
        &self,
        line: &Line<'_, T>,
        k: usize,
    ) -> Pair<T, N> {
        if !Self::is_in::<SET>(self.acting, C) {
            return [ComplexBlock::zero(); 2];
        }
        let end = line[C].len() - k;
        let x = ComplexBlock::load(&line[C][k..k + N]);
        let y = ComplexBlock::load_mirrored(&line[C][end - N..end]);
        sum_and_difference::<T, N, MIRRORED>([x, y])
    }

    /// Computes and stores the spectrum of displacement E (0 to 2) at N frequencies and their negatives, if it
    /// is wanted.
    #[inline(always)]
    fn compute_displacement<const N: usize, const MIRRORED: bool, const SET: u8, const E: usize>(
        &self,
        line: &mut Line<'_, T>,
        k: usize,
        tractions: &[Pair<T, N>; 3],
    ) {
        if !Self::is_in::<SET>(self.wanted, E) {
            return;
        }
        let mut sum = [ComplexBlock::<T, N>::zero(); 2];
        self.add_part::<N, MIRRORED, SET, E, 0>(&mut sum, k, tractions);
        self.add_part::<N, MIRRORED, SET, E, 1>(&mut sum, k, tractions);
        self.add_part::<N, MIRRORED, SET, E, 2>(&mut sum, k, tractions);
        let [x, y] = sum_and_difference::<T, N, MIRRORED>(sum);
        let end = line[E].len() - k;
        x.store(&mut line[E][k..k + N]);
        y.store_mirrored(&mut line[E][end - N..end]);
    }

    /// Adds the part of displacement E that traction C causes, if C acts.
    #[inline(always)]
    fn add_part<
        const N: usize,
        const MIRRORED: bool,
        const SET: u8,
        const E: usize,
        const C: usize,
    >(
        &self,
        sum: &mut Pair<T, N>,
        k: usize,
        tractions: &[Pair<T, N>; 3],
    ) {
        let (group, kernel, unit) = const { KERNELS[E][C] };
        let (values, count) = match group {
            Group::Tangential => (self.kernels.tangential, 3),
            Group::Normal => (self.kernels.normal, 1),
            Group::Coupling => (self.kernels.coupling, 2),
        };
        if !Self::is_in::<SET>(self.acting, C) || values.is_empty() {
            return;
        }
        let (block, lane) = (k / LANES, k % LANES);
        let per_kernel = if MIRRORED { 2 } else { 1 };
        let blocks = &values[(block * count + kernel) * per_kernel..][..per_kernel];
        sum[0].add(&take_lanes(&blocks[0], lane), unit, &tractions[C][0]);
        sum[1].add(
            &take_lanes(&blocks[per_kernel - 1], lane),
            unit,
            &tractions[C][1],
        );
    }
}

/// (x + y, x - y) on a mirrored line: from the pair to its two frequencies, and back.
#[inline(always)]
fn sum_and_difference<T: Precision, const N: usize, const MIRRORED: bool>(
    [x, y]: [ComplexBlock<T, N>; 2],
) -> [ComplexBlock<T, N>; 2] {
    if !MIRRORED {
        return [x, y];
    }
    [x.plus(&y), x.minus(&y)]
}

/// The N numbers from `first` of a block of kernel values.
#[inline(always)]
fn take_lanes<T: Precision, const N: usize>(block: &[T; LANES], first: usize) -> [T; N] {
    if N == LANES {
        std::array::from_fn(|i| block[i])
    } else {
        std::array::from_fn(|i| block[first + i])
    }
}
