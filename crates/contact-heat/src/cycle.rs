//! The temperature over a cycle that repeats itself.

use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::kernels::Complex64;
use contact_core::memory::fits;
use contact_core::scene::Grid;
use contact_core::stop::unless;
use ndarray::{Array2, Zip};

use super::conduction::Conduction;
use super::conductor::Layers;
use super::partition::{Partition, partition};

/// Most harmonics of a cycle.
pub const MOST_HARMONICS: usize = 256;
/// Instants per harmonic, and the fewest of a cycle.
const INSTANTS: usize = 8;
/// Memory of the amplitudes of a cell, for each harmonic \[bytes\].
const AMPLITUDES: f64 = 64.0;

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
}

/// The surface temperature of two bodies in the periodic state.
#[derive(Clone, Debug)]
pub struct Temperature {
    /// Mean over the cycle, of body 1 and of body 2 \[the unit of the temperatures far away\].
    pub mean: [Array2<f64>; 2],
    /// Largest of the cycle.
    pub largest: [Array2<f64>; 2],
    /// Mean heat flux from both bodies' friction \[W/m^2\].
    pub heat: Array2<f64>,
    /// Part of the mean heat that flows into body 1 \[W/m^2\].
    pub flux: Array2<f64>,
    /// Parts of the period at which the temperature was evaluated.
    pub instants: Vec<f64>,
    /// The largest temperature of either surface at these.
    pub peaks: Vec<f64>,
}

impl Cycle<'_> {
    fn check(&self, grid: &Grid) -> Result<(), Error> {
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
    fn harmonic(&self, n: usize) -> Vec<Complex64> {
        let mut amplitude = vec![Complex64::ZERO; self.contact.len()];
        let starts = std::iter::once(&0.0).chain(self.ends);
        for ((start, end), heat) in starts.zip(self.ends).zip(self.heat) {
            let half = PI * n as f64 * (end - start);
            let spread = if half == 0.0 { 1.0 } else { half.sin() / half };
            let phase = -PI * n as f64 * (start + end);
            let factor = Complex64::from_polar(self.frequency * spread, phase);
            for (amplitude, heat) in amplitude.iter_mut().zip(heat) {
                *amplitude += factor * heat;
            }
        }
        amplitude
    }
}

/// The temperature of two bodies under the heat of a cycle, those far away being `bulk`.
///
/// The heat is expanded in `harmonics` (0: the mean alone); half the increments of the cycle is a
/// sensible number. Ends when `stop` is raised: [`Error::Interrupted`] after increment 0.
pub fn temperature(
    bodies: [&Layers; 2],
    bulk: [f64; 2],
    grid: &Grid,
    cycle: &Cycle<'_>,
    harmonics: usize,
    stop: &AtomicBool,
) -> Result<Temperature, Error> {
    cycle.check(grid)?;
    if let Some(bulk) = bulk.iter().find(|t| !t.is_finite()) {
        return Err(Error::invalid("bulk temperature", bulk, "finite"));
    }
    if harmonics > MOST_HARMONICS {
        let allowed = format!("0 to {MOST_HARMONICS}");
        return Err(Error::invalid("harmonics", harmonics, allowed));
    }
    fits(
        "the temperature over a cycle",
        AMPLITUDES * (harmonics + 4) as f64 * grid.cells() as f64,
    )?;
    let contact: Vec<bool> = cycle.contact.iter().copied().collect();
    let answers = (0..=harmonics)
        .map(|n| {
            unless(stop)?;
            let w = 2.0 * PI * cycle.frequency * n as f64;
            let mut one = Conduction::new(bodies[0], grid, w)?;
            let mut two = Conduction::new(bodies[1], grid, w)?;
            let warmer = if n == 0 { bulk[1] - bulk[0] } else { 0.0 };
            partition([&mut one, &mut two], &cycle.harmonic(n), &contact, warmer)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(over_time(&answers, bulk, (grid.nx, grid.ny)))
}

/// The series of the harmonics at the instants of a cycle.
fn over_time(answers: &[Partition], bulk: [f64; 2], shape: (usize, usize)) -> Temperature {
    let field = |values: &[Complex64], above: f64| {
        let values = values.iter().map(|v| v.re + above).collect();
        Array2::from_shape_vec(shape, values).expect("a number for each cell")
    };
    let (steady, swings) = answers.split_first().expect("harmonic 0");
    let mean = [0, 1].map(|body| field(&steady.rise[body], bulk[body]));
    let count = INSTANTS * (swings.len() + 1);
    let instants: Vec<f64> = (0..count).map(|m| m as f64 / count as f64).collect();
    let mut largest = mean.clone();
    if !swings.is_empty() {
        for of in &mut largest {
            of.fill(f64::NEG_INFINITY);
        }
    }
    let mut peaks = Vec::with_capacity(count);
    for t in &instants {
        let mut peak = f64::NEG_INFINITY;
        for (body, largest) in largest.iter_mut().enumerate() {
            let mut now = mean[body].clone();
            for (n, swing) in (1..).zip(swings) {
                let turn = Complex64::from_polar(2.0, 2.0 * PI * f64::from(n) * t);
                for (now, rise) in now.iter_mut().zip(&swing.rise[body]) {
                    *now += (turn * rise).re;
                }
            }
            peak = now.iter().copied().fold(peak, f64::max);
            Zip::from(largest).and(&now).for_each(|l, n| *l = l.max(*n));
        }
        peaks.push(peak);
    }
    let [one, two] = &steady.flux;
    let heat: Vec<_> = one.iter().zip(two).map(|(a, b)| a + b).collect();
    Temperature {
        mean,
        largest,
        heat: field(&heat, 0.0),
        flux: field(one, 0.0),
        instants,
        peaks,
    }
}
