//! Transforms of the rows along y.
//!
//! A real kernel of definite parity in y never mixes the part of the tractions that is even under
//! y -> -y with the odd part. So the complex spectrum F(k_y) = a + i b of a row falls into two
//! families of real numbers that the convolution treats alike:
//!
//! | family | q_x, p | q_y |
//! |---|---|---|
//! | even | a | b |
//! | odd | b | -a |
//!
//! A mirror-symmetric scene has the even family only, and its half rows are transformed by cosine
//! transforms of half the length.

use std::f64::consts::PI;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;

use super::{Half, Mirror};

/// Transform of rows of `rows` cells, zero-padded to the period.
pub(crate) struct YTransform {
    mirror: Mirror,
    rows: usize,
    /// Length of the real transform: the period, or half of it with the mirror.
    length: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    /// exp(-i pi k / (2 length)) for k <= length/2, for the cosine transform.
    twiddle: Vec<Complex64>,
}

/// Buffers of one thread.
#[derive(Clone)]
pub(crate) struct YScratch {
    real: Vec<f64>,
    spectrum: Vec<Complex64>,
    fft: Vec<Complex64>,
}

impl YTransform {
    /// For rows of a grid of `ny` rows, periodic after `period` (even, >= ny) cells.
    pub(crate) fn new(
        mirror: Mirror,
        ny: usize,
        period: usize,
        fft: &mut RealFftPlanner<f64>,
    ) -> Self {
        let length = match mirror {
            Mirror::None => period,
            Mirror::Y => period / 2,
        };
        let twiddle = match mirror {
            Mirror::None => Vec::new(),
            Mirror::Y => (0..=length / 2)
                .map(|k| Complex64::from_polar(1.0, -PI * k as f64 / (2 * length) as f64))
                .collect(),
        };
        Self {
            mirror,
            rows: mirror.rows(ny),
            length,
            forward: fft.plan_fft_forward(length),
            inverse: fft.plan_fft_inverse(length),
            twiddle,
        }
    }

    /// Number of families of real numbers.
    pub(crate) fn families(&self) -> usize {
        match self.mirror {
            Mirror::None => 2,
            Mirror::Y => 1,
        }
    }

    /// Number of frequencies k_y, 0 to half the period.
    pub(crate) fn frequencies(&self) -> usize {
        match self.mirror {
            Mirror::None => self.length / 2 + 1,
            Mirror::Y => self.length + 1,
        }
    }

    pub(crate) fn scratch(&self) -> YScratch {
        let fft = self
            .forward
            .get_scratch_len()
            .max(self.inverse.get_scratch_len());
        YScratch {
            real: vec![0.0; self.length],
            spectrum: vec![Complex64::default(); self.length / 2 + 1],
            fft: vec![Complex64::default(); fft],
        }
    }

    /// Transforms one row; `put(family, k, value)` receives every number.
    pub(crate) fn forward(
        &self,
        row: &[f64],
        half: Half,
        s: &mut YScratch,
        mut put: impl FnMut(usize, usize, f64),
    ) {
        let (n, m) = (self.length, self.rows);
        match self.mirror {
            Mirror::None => {
                s.real[..m].copy_from_slice(row);
                s.real[m..].fill(0.0);
                self.run_forward(s);
                match half {
                    Half::Even => {
                        for (k, v) in s.spectrum.iter().enumerate() {
                            put(0, k, v.re);
                            put(1, k, v.im);
                        }
                    }
                    Half::Odd => {
                        for (k, v) in s.spectrum.iter().enumerate() {
                            put(0, k, v.im);
                            put(1, k, -v.re);
                        }
                    }
                }
            }
            Mirror::Y => {
                // F_k = 2 sum f_j cos(pi k (j + 1/2)/n); for an odd field the sine sum follows
                // from that of (-1)^j f_j read backwards.
                s.real.fill(0.0);
                let odd_sign = if half == Half::Even { 1.0 } else { -1.0 };
                for (j, pair) in row.chunks(2).enumerate() {
                    s.real[j] = pair[0];
                    if let Some(&f) = pair.get(1) {
                        s.real[n - 1 - j] = odd_sign * f;
                    }
                }
                self.run_forward(s);
                for (k, (v, w)) in s.spectrum.iter().zip(&self.twiddle).enumerate() {
                    let c = v * w;
                    match half {
                        Half::Even => {
                            put(0, k, 2.0 * c.re);
                            put(0, n - k, -2.0 * c.im);
                        }
                        Half::Odd => {
                            put(0, n - k, -2.0 * c.re);
                            put(0, k, 2.0 * c.im);
                        }
                    }
                }
                // The zero frequency of the sine and the last one of the cosine carry nothing.
                put(0, if half == Half::Even { n } else { 0 }, 0.0);
            }
        }
    }

    /// Inverse of [`Self::forward`] up to the factor `period`, cut to the kept rows.
    pub(crate) fn inverse(
        &self,
        half: Half,
        s: &mut YScratch,
        get: impl Fn(usize, usize) -> f64,
        row: &mut [f64],
    ) {
        let (n, m) = (self.length, self.rows);
        match self.mirror {
            Mirror::None => {
                for (k, v) in s.spectrum.iter_mut().enumerate() {
                    *v = match half {
                        Half::Even => Complex64::new(get(0, k), get(1, k)),
                        Half::Odd => Complex64::new(-get(1, k), get(0, k)),
                    };
                }
                self.run_inverse(s);
                row.copy_from_slice(&s.real[..m]);
            }
            Mirror::Y => {
                for (k, (v, w)) in s.spectrum.iter_mut().zip(&self.twiddle).enumerate() {
                    let (c, d) = match half {
                        Half::Even => (get(0, k), if k == 0 { 0.0 } else { get(0, n - k) }),
                        Half::Odd => (-get(0, n - k), if k == 0 { 0.0 } else { -get(0, k) }),
                    };
                    *v = Complex64::new(c, -d) * w.conj();
                }
                self.run_inverse(s);
                let odd_sign = if half == Half::Even { 1.0 } else { -1.0 };
                for (j, pair) in row.chunks_mut(2).enumerate() {
                    pair[0] = s.real[j];
                    if let Some(f) = pair.get_mut(1) {
                        *f = odd_sign * s.real[n - 1 - j];
                    }
                }
            }
        }
    }

    fn run_forward(&self, s: &mut YScratch) {
        self.forward
            .process_with_scratch(&mut s.real, &mut s.spectrum, &mut s.fft)
            .expect("buffers have the planned lengths");
    }

    fn run_inverse(&self, s: &mut YScratch) {
        // A real row has real first and last frequencies; rounding must not say otherwise.
        s.spectrum[0].im = 0.0;
        if self.length.is_multiple_of(2) {
            s.spectrum[self.length / 2].im = 0.0;
        }
        self.inverse
            .process_with_scratch(&mut s.spectrum, &mut s.real, &mut s.fft)
            .expect("buffers have the planned lengths");
    }
}
