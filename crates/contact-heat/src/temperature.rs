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
use super::cycle::Cycle;
use super::partition::{Partition, partition};

/// Most harmonics of a cycle.
pub const MOST_HARMONICS: usize = 256;
/// Instants per harmonic, and the fewest of a cycle.
const INSTANTS: usize = 8;
/// Memory of the amplitudes of a cell, for each harmonic \[bytes\].
const AMPLITUDES: f64 = 64.0;
/// Cells whose temperature over time is summed together.
const TOGETHER: usize = 64;

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
    /// Change of the largest temperature of all with half of the harmonics.
    pub error: f64,
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

/// Sums the harmonics at the instants of a cycle: temperature of both surfaces over time.
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
                beyond.fill_and_window(body, cell, swings.len(), &mut series);
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
