//! One line along x in the frequency domain: the kernels of one frequency k_y act on it.
//!
//! A line z is complex. On the whole grid it is the spectrum of the rows at one k_y; of a
//! mirror-symmetric scene, whose spectra along y are real, it holds two frequencies as a + i b.
//! With X = Z(k) and Y = conj Z(-k) the two frequencies are X + Y and X - Y up to constants, so
//! both cases load, multiply and store alike. Kernels even along x have real spectra S, odd ones
//! -i S, and S(-k) is +-S(k) accordingly, which makes the factor of Y that of X.

// What is known of kernels and components where the code is compiled leaves the loop only if all of
// it is compiled into one function.
#![allow(clippy::inline_always)]

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

/// Components that are given or wanted, known where the code is compiled: the two that nearly all
/// products have, and any.
const SHEAR: u8 = 0b011;
const PRESSURE: u8 = 0b100;
const ANY: u8 = 0;

fn multiply_pairs<T: Precision, const MIRRORED: bool>(
    line: &mut Line<'_, T>,
    kernels: LineKernels<'_, T>,
    given: [bool; 3],
    wanted: [bool; 3],
) {
    let product = Product::<T> {
        kernels,
        given,
        wanted,
    };
    match (given, wanted) {
        ([true, true, false], [true, true, false]) => product.pairs::<MIRRORED, SHEAR>(line),
        ([false, false, true], [false, false, true]) => product.pairs::<MIRRORED, PRESSURE>(line),
        _ => product.pairs::<MIRRORED, ANY>(line),
    }
}

/// The kernels of a line, from the tractions given to the displacements wanted.
struct Product<'a, T> {
    kernels: LineKernels<'a, T>,
    given: [bool; 3],
    wanted: [bool; 3],
}

/// N numbers at a frequency, or at a pair of them.
type Pair<T, const N: usize> = [Complexes<T, N>; 2];

impl<T: Precision> Product<'_, T> {
    fn pairs<const MIRRORED: bool, const OF: u8>(&self, line: &mut Line<'_, T>) {
        let half = (line[0].len() - 1) / 2;
        let whole = (half + 1) / LANES * LANES;
        for k in (0..whole).step_by(LANES) {
            self.at::<LANES, MIRRORED, OF>(line, k);
        }
        for k in whole..=half {
            self.at::<1, MIRRORED, OF>(line, k);
        }
    }

    #[inline(always)]
    fn is<const OF: u8>(flags: [bool; 3], component: usize) -> bool {
        if OF == ANY {
            flags[component]
        } else {
            OF >> component & 1 == 1
        }
    }

    /// The frequencies k to k + N - 1 and their negatives.
    #[inline(always)]
    fn at<const N: usize, const MIRRORED: bool, const OF: u8>(
        &self,
        line: &mut Line<'_, T>,
        k: usize,
    ) {
        let cause = [
            self.load::<N, MIRRORED, OF, 0>(line, k),
            self.load::<N, MIRRORED, OF, 1>(line, k),
            self.load::<N, MIRRORED, OF, 2>(line, k),
        ];
        self.row::<N, MIRRORED, OF, 0>(line, k, &cause);
        self.row::<N, MIRRORED, OF, 1>(line, k, &cause);
        self.row::<N, MIRRORED, OF, 2>(line, k, &cause);
    }

    /// The traction C.
    #[inline(always)]
    fn load<const N: usize, const MIRRORED: bool, const OF: u8, const C: usize>(
        &self,
        line: &Line<'_, T>,
        k: usize,
    ) -> Pair<T, N> {
        if !Self::is::<OF>(self.given, C) {
            return [Complexes::zero(); 2];
        }
        let end = line[C].len() - k;
        let x = Complexes::load(&line[C][k..k + N]);
        let y = Complexes::load_mirrored(&line[C][end - N..end]);
        split::<T, N, MIRRORED>([x, y])
    }

    /// The displacement E.
    #[inline(always)]
    fn row<const N: usize, const MIRRORED: bool, const OF: u8, const E: usize>(
        &self,
        line: &mut Line<'_, T>,
        k: usize,
        cause: &[Pair<T, N>; 3],
    ) {
        if !Self::is::<OF>(self.wanted, E) {
            return;
        }
        let mut sum = [Complexes::<T, N>::zero(); 2];
        self.add::<N, MIRRORED, OF, E, 0>(&mut sum, k, cause);
        self.add::<N, MIRRORED, OF, E, 1>(&mut sum, k, cause);
        self.add::<N, MIRRORED, OF, E, 2>(&mut sum, k, cause);
        let [x, y] = split::<T, N, MIRRORED>(sum);
        let end = line[E].len() - k;
        x.store(&mut line[E][k..k + N]);
        y.store_mirrored(&mut line[E][end - N..end]);
    }

    /// The part of the displacement E that the traction C causes.
    #[inline(always)]
    fn add<const N: usize, const MIRRORED: bool, const OF: u8, const E: usize, const C: usize>(
        &self,
        sum: &mut Pair<T, N>,
        k: usize,
        cause: &[Pair<T, N>; 3],
    ) {
        let (group, kernel, unit) = const { KERNELS[E][C] };
        let (values, count) = match group {
            Group::Tangential => (self.kernels.tangential, 3),
            Group::Normal => (self.kernels.normal, 1),
            Group::Coupling => (self.kernels.coupling, 2),
        };
        if !Self::is::<OF>(self.given, C) || values.is_empty() {
            return;
        }
        let (block, lane) = (k / LANES, k % LANES);
        let each = if MIRRORED { 2 } else { 1 };
        let at = &values[(block * count + kernel) * each..][..each];
        sum[0].add(&lanes(&at[0], lane), unit, &cause[C][0]);
        sum[1].add(&lanes(&at[each - 1], lane), unit, &cause[C][1]);
    }
}

/// (x + y, x - y) on a mirrored line: from the pair to its two frequencies, and back.
#[inline(always)]
fn split<T: Precision, const N: usize, const MIRRORED: bool>(
    [x, y]: [Complexes<T, N>; 2],
) -> [Complexes<T, N>; 2] {
    if !MIRRORED {
        return [x, y];
    }
    [x.plus(&y), x.minus(&y)]
}

#[inline(always)]
fn lanes<T: Precision, const N: usize>(block: &[T; LANES], first: usize) -> [T; N] {
    if N == LANES {
        std::array::from_fn(|i| block[i])
    } else {
        std::array::from_fn(|i| block[first + i])
    }
}
