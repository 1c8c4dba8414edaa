//! The precision that a product with spectra is computed in.
//!
//! Fields are f64 throughout. A product in f32 takes half of the time and of the memory; its input
//! is scaled by a power of two, so that any magnitude is representable, and its error is about 1e-7
//! of the largest displacement.

use std::ops::{AddAssign, SubAssign};

use rustfft::FftNum;
use rustfft::num_traits::Float;

/// f64 or f32.
pub(crate) trait Precision: FftNum + Float + AddAssign + SubAssign + Default {
    /// Converts from f64 to this precision.
    fn from_double(value: f64) -> Self;

    /// Converts to f64.
    fn to_double(self) -> f64;

    /// The scale of fields with this largest absolute value, a power of two.
    fn unit(largest: impl FnOnce() -> f64) -> f64;
}

impl Precision for f64 {
    fn from_double(value: f64) -> Self {
        value
    }

    fn to_double(self) -> f64 {
        self
    }

    /// Power of two by which kernels are divided, so that they stay within the range of the type; 1 in double
    /// precision.
    fn unit(_: impl FnOnce() -> f64) -> f64 {
        1.0
    }
}

impl Precision for f32 {
    fn from_double(value: f64) -> Self {
        value as f32
    }

    fn to_double(self) -> f64 {
        f64::from(self)
    }

    /// Largest power of two below the largest kernel: divided by it, the kernels are of the order of one.
    fn unit(largest: impl FnOnce() -> f64) -> f64 {
        let largest = largest();
        if largest > 0.0 && largest.is_finite() {
            largest.log2().floor().exp2()
        } else {
            1.0
        }
    }
}
