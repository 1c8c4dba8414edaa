//! Transforms of the rows along y, two rows in one complex transform.
//!
//! The spectrum of a row is kept as complex lines: F(k_y) itself on the whole grid, and on the
//! half of a mirror-symmetric scene, where F is real or imaginary, the real numbers of k_y = 2 m
//! and 2 m + 1 as one complex number. A field that is odd in a mirror-symmetric scene, q_y or u_y,
//! carries a factor -i, so that its lines are real there too and are convolved as the others are.
//!
//! The half rows are transformed by cosine transforms of half the length (J. Makhoul, IEEE Trans.
//! ASSP 28 (1980) 27-34), written so that they hold for complex data.

use std::f64::consts::PI;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use super::complexes::ComplexBlock;
use super::line_spectra::LANES;
use super::precision::Precision;
use crate::plan::{Mirror, Parity};

/// Rows that travel together: eight complex numbers of single precision fill a cache line.
pub(crate) const ROWS: usize = 8;

/// Transform of rows of `rows` cells, zero-padded to the period.
pub(crate) struct YTransform<T: Precision> {
    mirror: Mirror,
    /// Length of the transform: the period, or half of it with the mirror.
    length: usize,
    forward: Arc<dyn Fft<T>>,
    inverse: Arc<dyn Fft<T>>,
    /// exp(-i pi k / (2 length)) for k <= length/2, for the cosine transform.
    twiddle: Vec<Complex<T>>,
}

/// Buffers of one thread.
pub(crate) struct YScratch<T> {
    /// Two rows, then their spectrum; the last number repeats the first.
    pair: Vec<Complex<T>>,
    /// Cosine spectrum of two rows, k_y = 0 to half the period, and a zero.
    cosines: Vec<Complex<T>>,
    fft: Vec<Complex<T>>,
}

impl<T: Precision> YTransform<T> {
    /// Plans the transforms of rows periodic after `period` (even) cells.
    pub(crate) fn new(mirror: Mirror, period: usize, planner: &mut FftPlanner<T>) -> Self {
        let (length, twiddles) = match mirror {
            Mirror::None => (period, 0),
            Mirror::Y => (period / 2, period / 4 + 1),
        };
        let angle = |k: usize| -PI * k as f64 / (2 * length) as f64;
        Self {
            mirror,
            length,
            forward: planner.plan_fft_forward(length),
            inverse: planner.plan_fft_inverse(length),
            twiddle: (0..twiddles)
                .map(|k| {
                    let (sin, cos) = angle(k).sin_cos();
                    Complex::new(T::from_double(cos), T::from_double(sin))
                })
                .collect(),
        }
    }

    /// Number of complex lines.
    pub(crate) fn lines(&self) -> usize {
        self.length / 2 + 1
    }

    /// Allocates the buffers of one thread.
    pub(crate) fn scratch(&self) -> YScratch<T> {
        let zeros = |n| vec![Complex::default(); n];
        let fft = [&self.forward, &self.inverse].map(|f| f.get_inplace_scratch_len());
        YScratch {
            pair: zeros(self.length + 1),
            cosines: zeros(self.length + 2),
            fft: zeros(fft[0].max(fft[1])),
        }
    }

    /// Transforms a pair of rows times `scale`; the second may be missing. Line l of the pair goes
    /// to `lines[ROWS * l]` and `lines[ROWS * l + 1]`.
    pub(crate) fn forward(
        &self,
        rows: [&[f64]; 2],
        scale: f64,
        half: Parity,
        s: &mut YScratch<T>,
        lines: &mut [Complex<T>],
    ) {
        let n = self.length;
        s.pair[..n].fill(Complex::default());
        match self.mirror {
            Mirror::None if rows[1].is_empty() => {
                (s.pair.iter_mut().zip(rows[0]))
                    .for_each(|(v, a)| v.re = T::from_double(a * scale));
            }
            Mirror::None => {
                let pairs = rows[0].iter().zip(rows[1]);
                (s.pair.iter_mut().zip(pairs)).for_each(|(v, (a, b))| {
                    *v = Complex::new(T::from_double(a * scale), T::from_double(b * scale));
                });
            }
            Mirror::Y => {
                // Even cells forwards, odd ones backwards from the end; no second row counts as
                // zero.
                let (second, scale_2) = match rows[1] {
                    [] => (rows[0], 0.0),
                    two => (two, scale),
                };
                let ((one, last_1), (two, last_2)) = (rows[0].as_chunks(), second.as_chunks());
                let pair = |a: f64, b: f64| {
                    Complex::new(T::from_double(a * scale), T::from_double(b * scale_2))
                };
                let sign = T::from_double(half.sign());
                let (low, high) = s.pair[..n].split_at_mut(n / 2);
                let halves = low.iter_mut().zip(high.iter_mut().rev());
                for (([a, c], [b, d]), (even, odd)) in one.iter().zip(two).zip(halves) {
                    (*even, *odd) = (pair(*a, *b), pair(*c, *d) * sign);
                }
                for (a, b) in last_1.iter().zip(last_2) {
                    s.pair[one.len()] = pair(*a, *b);
                }
            }
        }
        self.forward
            .process_with_scratch(&mut s.pair[..n], &mut s.fft);
        s.pair[n] = s.pair[0];
        let lines = lines.chunks_mut(ROWS);
        match self.mirror {
            // F of the rows f + i g is (X + Y)/2 and (X - Y)/(2 i); the halves are left out.
            Mirror::None => {
                let values = s.pair.iter().zip(s.pair.iter().rev()).zip(lines);
                match half {
                    Parity::Even => values.for_each(|((v, w), line)| {
                        line[0] = v + w.conj();
                        line[1] = over_i(v - w.conj());
                    }),
                    Parity::Odd => values.for_each(|((v, w), line)| {
                        line[0] = over_i(v + w.conj());
                        line[1] = w.conj() - v;
                    }),
                }
            }
            Mirror::Y => {
                self.compute_cosines(s, half);
                for ([a, b], line) in s.cosines.as_chunks().0.iter().zip(lines) {
                    if let Some(rows) = line.first_chunk_mut() {
                        *rows = [Complex::new(a.re, b.re), Complex::new(a.im, b.im)];
                    }
                }
            }
        }
    }

    /// Inverse of [`Self::forward`] times the period and `scale`; the second row may be empty.
    pub(crate) fn inverse(
        &self,
        half: Parity,
        scale: f64,
        s: &mut YScratch<T>,
        lines: &[Complex<T>],
        rows: [&mut [f64]; 2],
    ) {
        let n = self.length;
        let lines = lines.chunks(ROWS);
        match self.mirror {
            Mirror::None => {
                for (k, line) in lines.take(n / 2 + 1).enumerate() {
                    let (f, ig) = match half {
                        Parity::Even => (line[0], times_i(line[1])),
                        Parity::Odd => (times_i(line[0]), -line[1]),
                    };
                    s.pair[k] = f + ig;
                    s.pair[n - k] = (f - ig).conj();
                }
            }
            Mirror::Y => {
                for (c, line) in s.cosines.as_chunks_mut().0.iter_mut().zip(lines) {
                    if let Some([a, b]) = line.first_chunk() {
                        *c = [Complex::new(a.re, b.re), Complex::new(a.im, b.im)];
                    }
                }
                self.invert_cosines(s, half);
            }
        }
        self.inverse
            .process_with_scratch(&mut s.pair[..n], &mut s.fft);
        // The half left out in the forward transform, and in a mirrored line's product.
        let [first, second] = rows;
        let scale = 0.5 * scale;
        match self.mirror {
            Mirror::None => {
                (first.iter_mut().zip(&s.pair)).for_each(|(f, v)| *f = scale * v.re.to_double());
                (second.iter_mut().zip(&s.pair)).for_each(|(f, v)| *f = scale * v.im.to_double());
            }
            Mirror::Y => {
                let scales = [scale, scale * half.sign()];
                write_row(&s.pair[..n], first, scales, |v| v.re);
                write_row(&s.pair[..n], second, scales, |v| v.im);
            }
        }
    }

    /// Computes C(k) = 2 sum f_j cos(pi k (j + 1/2)/n). An odd field has its sine sums, which are the cosine sums of
    /// (-1)^j f_j read backwards, with the factor -i of the spectrum of q_y.
    fn compute_cosines(&self, s: &mut YScratch<T>, half: Parity) {
        let n = self.length;
        let full_blocks = self.twiddle.len() / LANES * LANES;
        for k in (0..full_blocks).step_by(LANES) {
            self.unpack_cosines::<LANES>(s, half, k);
        }
        for k in full_blocks..self.twiddle.len() {
            self.unpack_cosines::<1>(s, half, k);
        }
        // The zero frequency of the sines and the last one of the cosines are zero.
        s.cosines[if half == Parity::Even { n } else { 0 }] = Complex::default();
        s.cosines[n + 1] = Complex::default();
    }

    /// Unpacks the frequencies `k..k+N` and their mirror `n-k-N+1..=n-k`.
    #[inline]
    fn unpack_cosines<const N: usize>(&self, s: &mut YScratch<T>, half: Parity, k: usize) {
        let (frequencies, mirrored) = (k..k + N, self.length + 1 - k - N..=self.length - k);
        let w = ComplexBlock::<T, N>::load(&self.twiddle[frequencies.clone()]);
        let a = ComplexBlock::load(&s.pair[frequencies.clone()]).times(&w);
        let b = ComplexBlock::load_mirrored(&s.pair[mirrored.clone()])
            .times(&w)
            .conjugate();
        let (low, high) = (a.plus(&b), a.minus(&b).times_i());
        let (low, high) = match half {
            Parity::Even => (low, high),
            Parity::Odd => (high.negative(), low.negative()),
        };
        low.store(&mut s.cosines[frequencies]);
        high.conjugate().store_mirrored(&mut s.cosines[mirrored]);
    }

    /// Computes the fields from their cosine sums: the inverse of [`Self::compute_cosines`].
    fn invert_cosines(&self, s: &mut YScratch<T>, half: Parity) {
        let n = self.length;
        s.cosines[if half == Parity::Even { n } else { 0 }] = Complex::default();
        let full_blocks = self.twiddle.len() / LANES * LANES;
        for k in (0..full_blocks).step_by(LANES) {
            self.pack_cosines::<LANES>(s, half, k);
        }
        for k in full_blocks..self.twiddle.len() {
            self.pack_cosines::<1>(s, half, k);
        }
    }

    /// Packs the frequencies `k..k+N` and their mirror `n-k-N+1..=n-k`.
    #[inline]
    fn pack_cosines<const N: usize>(&self, s: &mut YScratch<T>, half: Parity, k: usize) {
        let (frequencies, mirrored) = (k..k + N, self.length + 1 - k - N..=self.length - k);
        let w = ComplexBlock::<T, N>::load(&self.twiddle[frequencies.clone()]);
        let a = ComplexBlock::load(&s.cosines[frequencies.clone()]);
        let b = ComplexBlock::load_mirrored(&s.cosines[mirrored.clone()]).conjugate();
        let (low, high) = match half {
            Parity::Even => (a, b),
            Parity::Odd => (b.negative(), a.negative()),
        };
        let high = high.times_i();
        let (difference, sum) = (low.minus(&high), low.plus(&high));
        difference
            .times(&w.conjugate())
            .store(&mut s.pair[frequencies]);
        let sum = sum.times(&w).conjugate();
        sum.store_mirrored(&mut s.pair[mirrored]);
    }
}

/// Writes the cells of a row from its even ones, forwards, and its odd ones, backwards from the end, times
/// their scales.
#[inline]
fn write_row<T: Precision>(
    pair: &[Complex<T>],
    row: &mut [f64],
    scales: [f64; 2],
    component: impl Fn(&Complex<T>) -> T,
) {
    let (low, high) = pair.split_at(pair.len() / 2);
    let (cells, last) = row.as_chunks_mut::<2>();
    for (j, cell) in last.iter_mut().enumerate() {
        *cell = scales[0] * component(&pair[cells.len() + j]).to_double();
    }
    for (cells, (even, odd)) in cells.iter_mut().zip(low.iter().zip(high.iter().rev())) {
        *cells = [
            scales[0] * component(even).to_double(),
            scales[1] * component(odd).to_double(),
        ];
    }
}

/// i z
fn times_i<T: Precision>(z: Complex<T>) -> Complex<T> {
    Complex::new(-z.im, z.re)
}

/// z / i
fn over_i<T: Precision>(z: Complex<T>) -> Complex<T> {
    Complex::new(z.im, -z.re)
}
