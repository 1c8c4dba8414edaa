//! The temperature over a cycle that repeats itself.

use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::kernels::Complex64;
use contact_core::memory::fits;
use contact_core::scene::Grid;
use contact_core::stop::unless;
use ndarray::Array2;
use rayon::prelude::*;
use rustfft::FftPlanner;

use super::beyond::{Beyond, LAST};
use super::conduction::Conduction;
use super::conductor::Layers;
use super::partition::{Partition, partition};

/// Most harmonics of a cycle.
pub const MOST_HARMONICS: usize = 256;
/// Instants per harmonic, and the fewest of a cycle.
const INSTANTS: usize = 8;
/// Memory of the amplitudes of a cell, for each harmonic \[bytes\].
const AMPLITUDES: f64 = 64.0;
/// Cells whose temperature over time is summed together.
const TOGETHER: usize = 64;

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
    /// What half of the harmonics change the largest temperature of all by.
    pub error: f64,
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
    pub(super) fn harmonic(&self, n: usize) -> Vec<Complex64> {
        let mut amplitude = vec![Complex64::ZERO; self.contact.len()];
        for (factor, heat) in self.factors(n).into_iter().zip(self.heat) {
            for (amplitude, heat) in amplitude.iter_mut().zip(heat) {
                *amplitude += factor * heat;
            }
        }
        amplitude
    }

    /// What a unit heat of each increment adds to the amplitude of harmonic n \[1/s\].
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
    let beyond = (cycle.jumps && harmonics > 0)
        .then(|| Beyond::new(bodies, grid, cycle, harmonics, &contact))
        .transpose()?;
    let shape = (grid.nx, grid.ny);
    let mut found = over_time(&answers, beyond.as_ref(), bulk, shape);
    if harmonics > 0 {
        let half = over_time(&answers[..=harmonics / 2], beyond.as_ref(), bulk, shape);
        let hottest = |of: &[f64]| of.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        found.error = (hottest(&found.peaks) - hottest(&half.peaks)).abs();
    }
    Ok(found)
}

/// The series of the harmonics at the instants of a cycle.
fn over_time(
    answers: &[Partition],
    beyond: Option<&Beyond>,
    bulk: [f64; 2],
    shape: (usize, usize),
) -> Temperature {
    let field = |values: &[Complex64], above: f64| {
        let values = values.iter().map(|v| v.re + above).collect();
        Array2::from_shape_vec(shape, values).expect("a number for each cell")
    };
    let (steady, swings) = answers.split_first().expect("harmonic 0");
    let mean = [0, 1].map(|body| field(&steady.rise[body], bulk[body]));
    let count = beyond.map_or(INSTANTS * (swings.len() + 1), |_| 2 * LAST);
    let instants: Vec<f64> = (0..count).map(|m| m as f64 / count as f64).collect();
    let transform = FftPlanner::new().plan_fft_inverse(count);
    let cells: Vec<usize> = (0..shape.0 * shape.1).collect();
    let coldest = || vec![f64::NEG_INFINITY; count];
    let mut peaks = coldest();
    let largest = [0, 1].map(|body| {
        let over_period = |cell: usize| {
            let mut series = vec![Complex64::ZERO; count];
            series[0] = (steady.rise[body][cell].re + bulk[body]).into();
            for (amplitude, swing) in series[1..].iter_mut().zip(swings) {
                *amplitude = 2.0 * swing.rise[body][cell];
            }
            if let Some(beyond) = beyond {
                beyond.add(body, cell, swings.len(), &mut series);
            }
            transform.process(&mut series);
            series
        };
        let some = |some: &[usize]| {
            let mut peaks = coldest();
            let tops: Vec<f64> = (some.iter())
                .map(|cell| {
                    let series = over_period(*cell);
                    for (peak, now) in peaks.iter_mut().zip(&series) {
                        *peak = peak.max(now.re);
                    }
                    series
                        .iter()
                        .map(|v| v.re)
                        .fold(f64::NEG_INFINITY, f64::max)
                })
                .collect();
            (tops, peaks)
        };
        let parts: Vec<_> = cells.par_chunks(TOGETHER).map(some).collect();
        let mut tops = Vec::with_capacity(cells.len());
        for (of_cells, of_instants) in parts {
            tops.extend(of_cells);
            for (peak, now) in peaks.iter_mut().zip(of_instants) {
                *peak = peak.max(now);
            }
        }
        Array2::from_shape_vec(shape, tops).expect("a number for each cell")
    });
    let [one, two] = &steady.flux;
    let heat: Vec<_> = one.iter().zip(two).map(|(a, b)| a + b).collect();
    Temperature {
        mean,
        largest,
        heat: field(&heat, 0.0),
        flux: field(one, 0.0),
        instants,
        peaks,
        error: 0.0,
    }
}
