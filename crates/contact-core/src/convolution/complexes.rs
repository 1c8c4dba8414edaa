//! Blocks of complex numbers that are processed together, real and imaginary parts apart.

use rustfft::num_complex::Complex;

use super::precision::Precision;

/// A power of i.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unit {
    One,
    MinusOne,
    I,
    MinusI,
}

/// N complex numbers, real and imaginary parts apart.
#[derive(Clone, Copy)]
pub(crate) struct ComplexBlock<T, const N: usize> {
    pub(crate) re: [T; N],
    pub(crate) im: [T; N],
}

impl<T: Precision, const N: usize> ComplexBlock<T, N> {
    /// N zeros.
    #[inline]
    pub(crate) fn zero() -> Self {
        Self {
            re: [T::zero(); N],
            im: [T::zero(); N],
        }
    }

    /// Loads N complex numbers in order.
    ///
    /// # Panics
    ///
    /// If `z` has another length.
    #[inline]
    pub(crate) fn load(z: &[Complex<T>]) -> Self {
        let z: &[Complex<T>; N] = z.try_into().expect("N numbers");
        Self {
            re: std::array::from_fn(|i| z[i].re),
            im: std::array::from_fn(|i| z[i].im),
        }
    }

    /// Loads conjugates in reverse order, as [`Self::store_mirrored`] stores them.
    #[inline]
    pub(crate) fn load_mirrored(z: &[Complex<T>]) -> Self {
        let z: &[Complex<T>; N] = z.try_into().expect("N numbers");
        Self {
            re: std::array::from_fn(|i| z[N - 1 - i].re),
            im: std::array::from_fn(|i| -z[N - 1 - i].im),
        }
    }

    /// Stores the N numbers in order.
    ///
    /// # Panics
    ///
    /// If `z` has another length.
    #[inline]
    pub(crate) fn store(&self, z: &mut [Complex<T>]) {
        let z: &mut [Complex<T>; N] = z.try_into().expect("N numbers");
        for i in 0..N {
            z[i] = Complex::new(self.re[i], self.im[i]);
        }
    }

    /// Stores the conjugates in reverse order: from frequencies to their negatives.
    ///
    /// # Panics
    ///
    /// If `z` has another length.
    #[inline]
    pub(crate) fn store_mirrored(&self, z: &mut [Complex<T>]) {
        let z: &mut [Complex<T>; N] = z.try_into().expect("N numbers");
        for i in 0..N {
            z[N - 1 - i] = Complex::new(self.re[i], -self.im[i]);
        }
    }

    /// Adds the product of a real spectrum, a `unit` (1, -1, i or -i) and the numbers z.
    #[inline]
    pub(crate) fn add(&mut self, spectrum: &[T; N], unit: Unit, z: &Self) {
        match unit {
            Unit::One => {
                for i in 0..N {
                    self.re[i] += spectrum[i] * z.re[i];
                    self.im[i] += spectrum[i] * z.im[i];
                }
            }
            Unit::MinusOne => {
                for i in 0..N {
                    self.re[i] -= spectrum[i] * z.re[i];
                    self.im[i] -= spectrum[i] * z.im[i];
                }
            }
            Unit::I => {
                for i in 0..N {
                    self.re[i] -= spectrum[i] * z.im[i];
                    self.im[i] += spectrum[i] * z.re[i];
                }
            }
            Unit::MinusI => {
                for i in 0..N {
                    self.re[i] += spectrum[i] * z.im[i];
                    self.im[i] -= spectrum[i] * z.re[i];
                }
            }
        }
    }

    /// Applies `f` to each pair of numbers, given their real and imaginary parts.
    #[inline]
    fn map_pairs(&self, other: &Self, f: impl Fn([T; 2], [T; 2]) -> [T; 2]) -> Self {
        let pair = |i: usize| f([self.re[i], self.im[i]], [other.re[i], other.im[i]]);
        Self {
            re: std::array::from_fn(|i| pair(i)[0]),
            im: std::array::from_fn(|i| pair(i)[1]),
        }
    }

    /// Sum, number by number.
    #[inline]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        self.map_pairs(other, |z, w| [z[0] + w[0], z[1] + w[1]])
    }

    /// Difference, number by number.
    #[inline]
    pub(crate) fn minus(&self, other: &Self) -> Self {
        self.map_pairs(other, |z, w| [z[0] - w[0], z[1] - w[1]])
    }

    /// Complex product, number by number.
    #[inline]
    pub(crate) fn times(&self, other: &Self) -> Self {
        self.map_pairs(other, |z, w| {
            [z[0] * w[0] - z[1] * w[1], z[0] * w[1] + z[1] * w[0]]
        })
    }

    /// Each number times i.
    #[inline]
    pub(crate) fn times_i(&self) -> Self {
        self.map_pairs(self, |z, _| [-z[1], z[0]])
    }

    /// Each number with the opposite sign.
    #[inline]
    pub(crate) fn negative(&self) -> Self {
        self.map_pairs(self, |z, _| [-z[0], -z[1]])
    }

    /// Complex conjugate of each number.
    #[inline]
    pub(crate) fn conjugate(&self) -> Self {
        self.map_pairs(self, |z, _| [z[0], -z[1]])
    }
}
