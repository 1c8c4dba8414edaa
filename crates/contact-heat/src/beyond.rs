//! The harmonics of the heat beyond those that are solved, where it may set in or stop at once.
//!
//! Such heat has harmonics that fall like 1/n: a series that ends at N overshoots by 9 % of the step
//! (Gibbs). Beyond N the answer of a place to the heat of an increment is that at N, times r_n/r_N
//! with
//!
//! ```text
//! 1/r_n = g + e (i n)^(1/2),
//! ```
//!
//! g for conduction to the sides (slow cycles), e for plane waves (fast ones), both from the answer
//! at N to the heat of the strongest increment, which is what stops at a reversal. The heats of the
//! increments are sums of a few [`MODES`]. The series ends at [`LAST`] with C. Lanczos' factors
//! sin(pi n/LAST)/(pi n/LAST) squared, each a mean over a part 1/LAST of the period (Applied
//! Analysis, 1956, section IV.6).

use std::f64::consts::PI;

use contact_core::Error;
use contact_core::kernels::Complex64;
use contact_core::scene::Grid;

use super::conduction::Conduction;
use super::conductor::Layers;
use super::cycle::Cycle;
use super::partition::partition;

/// The first harmonic that is left out.
pub(super) const LAST: usize = 512;
/// Most fields whose sums the heats of the increments are, and the part of the strongest that may be
/// left of one.
const MODES: usize = 8;
const LEFT: f64 = 3e-3;

/// Answers of cells beyond the harmonics that are solved.
pub(super) struct Beyond {
    /// Amplitudes of the modes in harmonic n.
    amplitudes: Vec<Vec<Complex64>>,
    /// The answers of both bodies to each mode at the highest harmonic that is solved.
    answers: Vec<[Vec<Complex64>; 2]>,
    /// Highest solved harmonic.
    solved: f64,
    /// g and e of the cells of both bodies \[W/(m^2 K)\]; none without heat.
    local: [Vec<Option<[f64; 2]>>; 2],
}

impl Beyond {
    /// Extrapolates the harmonics beyond the highest one that is solved, by the local law of fast changes in
    /// each cell.
    pub(super) fn new(
        bodies: [&Layers; 2],
        grid: &Grid,
        cycle: &Cycle<'_>,
        harmonics: usize,
        contact: &[bool],
    ) -> Result<Self, Error> {
        let solved = harmonics as f64;
        let w = 2.0 * PI * cycle.frequency * solved;
        let mut one = Conduction::new(bodies[0], grid, w)?;
        let mut two = Conduction::new(bodies[1], grid, w)?;
        let (modes, parts) = modes(cycle);
        let mut answers = Vec::new();
        for mode in &modes {
            let heat: Vec<Complex64> = mode.iter().map(|q| Complex64::from(*q)).collect();
            answers.push(partition([&mut one, &mut two], &heat, contact, 0.0)?.rise);
        }
        let of_cell = |(rise, heat): (&Complex64, &f64)| {
            let inverse = heat / rise;
            let usable = *heat > 0.0 && rise.re > 0.0 && inverse.im >= 0.0;
            usable.then(|| {
                let e = inverse.im / (solved / 2.0).sqrt();
                [(inverse.re - inverse.im).max(0.0), e]
            })
        };
        let local = [0, 1].map(|body| {
            let (rise, heat) = (&answers[0][body], &modes[0]);
            rise.iter().zip(heat).map(of_cell).collect()
        });
        let of_harmonic = |n: usize| {
            let factors = cycle.factors(n);
            let of_mode = |m: usize| {
                factors
                    .iter()
                    .zip(&parts)
                    .map(|(f, part)| f * part[m])
                    .sum()
            };
            (0..modes.len()).map(of_mode).collect()
        };
        Ok(Self {
            amplitudes: (0..LAST).map(of_harmonic).collect(),
            answers,
            solved,
            local,
        })
    }

    /// Fills the unsolved harmonics of a cell by the local law, and damps all by Lanczos factors.
    pub(super) fn fill_and_window(
        &self,
        body: usize,
        cell: usize,
        solved: usize,
        series: &mut [Complex64],
    ) {
        if let Some([g, e]) = self.local[body][cell] {
            let inverse = |n: f64| {
                let root = (n / 2.0).sqrt();
                Complex64::new(g + e * root, e * root)
            };
            let at_solved = 2.0 * inverse(self.solved);
            for n in solved + 1..LAST {
                let modes = self.amplitudes[n].iter().zip(&self.answers);
                let answer: Complex64 = modes.map(|(part, of)| part * of[body][cell]).sum();
                series[n] = answer * at_solved / inverse(n as f64);
            }
        }
        for (n, of) in series.iter_mut().enumerate().take(LAST).skip(1) {
            let turn = PI * n as f64 / LAST as f64;
            *of *= (turn.sin() / turn).powi(2);
        }
    }
}

/// Orthonormal fields, the first the heat of the strongest increment, and the part of each in the heat
/// of every increment: the strongest of what is left, one after the other.
fn modes(cycle: &Cycle<'_>) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let starts = std::iter::once(&0.0).chain(cycle.ends);
    let lengths: Vec<f64> = starts.zip(cycle.ends).map(|(a, b)| b - a).collect();
    let mut left: Vec<Vec<f64>> = cycle
        .heat
        .iter()
        .map(|of| of.iter().copied().collect())
        .collect();
    let mut parts = vec![Vec::new(); left.len()];
    let (mut found, mut strongest) = (Vec::new(), 0.0_f64);
    while found.len() < MODES {
        let rates = left.iter().zip(&lengths);
        let rates = rates.map(|(of, length)| product(of, of).sqrt() / length);
        let Some((at, rate)) = rates.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b)) else {
            break;
        };
        strongest = strongest.max(rate);
        if rate <= LEFT * strongest && !found.is_empty() {
            break;
        }
        let size = (rate * lengths[at]).max(f64::MIN_POSITIVE);
        let mode: Vec<f64> = left[at].iter().map(|q| q / size).collect();
        for (of, parts) in left.iter_mut().zip(&mut parts) {
            let part = product(of, &mode);
            parts.push(part);
            for (q, mode) in of.iter_mut().zip(&mode) {
                *q -= part * mode;
            }
        }
        found.push(mode);
    }
    (found, parts)
}
