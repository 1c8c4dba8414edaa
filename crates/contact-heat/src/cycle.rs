//! The heat of a cycle that repeats itself, and its harmonics.

use std::f64::consts::PI;

use contact_core::Error;
use contact_core::kernels::Complex64;
use contact_core::scene::Grid;
use ndarray::Array2;

/// The heat of a cycle.
#[derive(Clone, Debug)]
pub struct Cycle<'a> {
    /// Cycles per second \[Hz\].
    pub frequency: f64,
    /// The end of each increment, as a part of the period: growing, the last one 1.
    pub ends: &'a [f64],
    /// Heat per area of each increment, set free at a constant rate \[J/m^2\].
    pub heat: &'a [Array2<f64>],
    /// The cells that take heat.
    pub contact: &'a Array2<bool>,
    /// Whether the rate of the heat may jump from an increment to the next: then the harmonics
    /// beyond those that are solved are estimated. Increments of a smooth rate are samples of it.
    pub jumps: bool,
}

impl Cycle<'_> {
    /// Fails if the heat of the cycle does not fit the grid, or has no meaning.
    pub(super) fn check(&self, grid: &Grid) -> Result<(), Error> {
        if !(self.frequency > 0.0 && self.frequency.is_finite()) {
            return Err(Error::invalid(
                "frequency",
                self.frequency,
                "positive, in Hz",
            ));
        }
        let count = self.heat.len();
        if count == 0 || self.ends.len() != count {
            let allowed = format!("one for each of the {count} increments, at least one");
            return Err(Error::invalid("ends", self.ends.len(), allowed));
        }
        let starts = std::iter::once(&0.0).chain(self.ends);
        let grows = starts.zip(self.ends).all(|(a, b)| a < b);
        if !(grows && (self.ends[count - 1] - 1.0).abs() < 1e-9) {
            let allowed = "growing parts of the period, more than 0 and the last one 1";
            return Err(Error::invalid("ends", format!("{:?}", self.ends), allowed));
        }
        let shape = (grid.nx, grid.ny);
        let shapes = self
            .heat
            .iter()
            .map(Array2::dim)
            .chain([self.contact.dim()]);
        if let Some(other) = shapes.into_iter().find(|of| *of != shape) {
            let allowed = format!("fields of the grid, {shape:?}");
            return Err(Error::invalid("heat", format!("{other:?}"), allowed));
        }
        if self.heat.iter().flatten().any(|d| !d.is_finite()) {
            return Err(Error::invalid("heat", "not a number", "finite, in J/m^2"));
        }
        if !self.contact.iter().any(|touches| *touches) {
            return Err(Error::invalid(
                "contact",
                "no cell",
                "at least one cell in contact",
            ));
        }
        Ok(())
    }

    /// The amplitude of harmonic n of the heat \[W/m^2\]: q(t) is the real part of the sum of
    /// q_0 and of 2 q_n exp(2 pi i n f t).
    pub(super) fn harmonic(&self, n: usize) -> Vec<Complex64> {
        let mut amplitude = vec![Complex64::ZERO; self.contact.len()];
        for (factor, heat) in self.factors(n).into_iter().zip(self.heat) {
            for (amplitude, heat) in amplitude.iter_mut().zip(heat) {
                *amplitude += factor * heat;
            }
        }
        amplitude
    }

    /// Factors by which the heat of each increment adds to the amplitude of harmonic n \[1/s\].
    pub(super) fn factors(&self, n: usize) -> Vec<Complex64> {
        let starts = std::iter::once(&0.0).chain(self.ends);
        let of_increment = |(start, end): (&f64, &f64)| {
            let half = PI * n as f64 * (end - start);
            let spread = if half == 0.0 { 1.0 } else { half.sin() / half };
            let phase = -PI * n as f64 * (start + end);
            Complex64::from_polar(self.frequency * spread, phase)
        };
        starts.zip(self.ends).map(of_increment).collect()
    }
}
