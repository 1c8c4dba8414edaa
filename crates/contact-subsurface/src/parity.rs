//! Transforms of sequences of definite parity, two at a time.

use realfft::RealToComplex;
use rustfft::num_complex::Complex64;

/// Buffers of a transform of an even and an odd sequence together.
pub(super) struct Buffers {
    real: Vec<f64>,
    /// The even sequence's transform in the real part, minus the odd one's in the imaginary part.
    pub(super) spectrum: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl Buffers {
    /// Allocates the buffers of a transform.
    pub(super) fn new(fft: &dyn RealToComplex<f64>) -> Self {
        Self {
            real: vec![0.0; fft.len()],
            spectrum: vec![Complex64::default(); fft.len() / 2 + 1],
            scratch: vec![Complex64::default(); fft.get_scratch_len()],
        }
    }

    /// Transforms sequences given on the offsets >= 0 and continued by their parity.
    pub(super) fn transform(
        &mut self,
        fft: &dyn RealToComplex<f64>,
        even: Option<impl Iterator<Item = f64>>,
        odd: Option<impl Iterator<Item = f64>>,
    ) {
        let period = self.real.len();
        self.real.fill(0.0);
        for (i, v) in even.into_iter().flatten().enumerate() {
            self.real[i] = v;
            self.real[(period - i) % period] = v;
        }
        for (i, v) in odd.into_iter().flatten().enumerate().skip(1) {
            self.real[i] += v;
            self.real[period - i] -= v;
        }
        fft.process_with_scratch(&mut self.real, &mut self.spectrum, &mut self.scratch)
            .expect("buffers have the planned lengths");
    }
}
