//! Products of kernels with loads along a straight line, by one-dimensional transforms.
//!
//! Nothing is transformed across the line. For each distance between a row of loads and the line,
//! the kernel is transformed along the line and multiplied with the transform of the loads, and the
//! products are added up. One transform back gives the line. Rows at equal distances on both sides
//! of the line share the kernel, whose parity across the line is known. Where the loads are
//! symmetric to the line, half of the entries are not needed.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::convolution::{Tractions, fast_length};
use contact_core::kernels::{DepthKernel, Quantity, SharedCorners};
use contact_core::stop::unless;
use ndarray::Array2;
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;

use super::Side;
use super::loads::{Loads, Plane, Source, snap_to_half_cells};
use super::parity::Buffers;

/// The loads on one kind of source, transformed along a line.
pub(super) struct LineTransform {
    source: Source,
    /// First column with loads.
    start: isize,
    /// Offsets along the line that occur.
    offsets: usize,
    period: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    pairs: Vec<RowPair>,
}

/// The rows of loads at one distance from the line.
struct RowPair {
    distance: f64,
    /// The spectra of all states, for each component and parity of the kernel across the line
    /// (even, odd); empty where all vanish.
    spectra: [[Vec<Complex64>; 2]; 3],
}

impl LineTransform {
    /// Plans the transforms of all load rows for the line at `y` \[m\].
    pub(super) fn new(
        plane: &Plane,
        side: Side,
        y: f64,
        states: &[Tractions<'_>],
        source: Source,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let patch = plane.loaded_patch(states, source);
        let loads: Vec<Loads> = states
            .iter()
            .map(|state| plane.loads(state, side, source, patch))
            .collect();
        // Columns lie symmetric to the middle of the grid.
        let offsets = (plane.n.0 as isize - patch.start.0) as usize;
        let period = fast_length(2 * offsets - 1);
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (
            planner.plan_fft_forward(period),
            planner.plan_fft_inverse(period),
        );
        // Rows by their distance in millionths of a cell: on equal ones the kernel is shared.
        let mut by_distance: BTreeMap<u64, (f64, Vec<(usize, bool)>)> = BTreeMap::new();
        for j in 0..patch.rows {
            let row = (j as isize + patch.start.1) as f64;
            let offset = snap_to_half_cells(y / plane.d.1 - (row - (plane.n.1 - 1) as f64 / 2.0));
            let key = (offset.abs() * 1e6).round() as u64;
            let (_, rows) = by_distance.entry(key).or_insert((offset.abs(), Vec::new()));
            rows.push((j, offset < 0.0));
        }
        let transform = |rows: &[(usize, bool)], component: usize, odd: bool| {
            let mut spectra = Vec::new();
            for loads in &loads {
                let mut real = vec![0.0; period];
                for &(j, beyond) in rows {
                    let sign = if odd && beyond { -1.0 } else { 1.0 };
                    for (r, q) in real.iter_mut().zip(loads.row(component, j)) {
                        *r += sign * q;
                    }
                }
                let mut spectrum = vec![Complex64::default(); period / 2 + 1];
                forward
                    .process(&mut real, &mut spectrum)
                    .expect("buffers have the planned lengths");
                spectra.append(&mut spectrum);
            }
            if spectra.iter().all(|v| v.norm_sqr() == 0.0) {
                spectra.clear();
            }
            spectra
        };
        let pairs = by_distance
            .into_values()
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|(offset, rows)| {
                unless(stop)?;
                Ok(RowPair {
                    distance: offset * plane.d.1,
                    spectra: [0, 1, 2].map(|c| [false, true].map(|odd| transform(&rows, c, odd))),
                })
            })
            .collect::<Result<_, Error>>()?;
        Ok(Self {
            source,
            start: patch.start.0,
            offsets,
            period,
            forward,
            inverse,
            pairs,
        })
    }

    /// Convolves the loads with a kernel for all states: the N quantities along the line of n cells, each of
    /// shape (R, n); `d` are the sides of the cells.
    pub(super) fn convolve<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        d: (f64, f64),
        (states, n): (usize, usize),
        stop: &AtomicBool,
    ) -> Result<Vec<Array2<f64>>, Error> {
        let frequencies = self.period / 2 + 1;
        // By parity of the kernel along the line, state and component.
        let mut sums = [0, 1].map(|_| vec![Complex64::default(); states * R * frequencies]);
        let mut entries = vec![0.0; 3 * R * self.offsets];
        let mut buffers = Buffers::new(&*self.forward);
        let mut corners = SharedCorners::new(0.0, self.offsets);
        for pair in &self.pairs {
            unless(stop)?;
            let (even, odd) = entries_with_loads::<Q, N, R>(pair);
            if even.is_empty() && odd.is_empty() {
                continue;
            }
            let put = |i: usize, response: [[f64; 3]; R]| {
                for (entry, value) in response.as_flattened().iter().enumerate() {
                    entries[entry * self.offsets + i] = *value;
                }
            };
            let y = pair.distance;
            self.source
                .row(kernel, self.offsets, y, d, &mut corners, put);
            let line = |(row, column): (usize, usize)| {
                &entries[(3 * row + column) * self.offsets..][..self.offsets]
            };
            // One real transform holds an even kernel in its real part, an odd one in its
            // imaginary part.
            for k in 0..even.len().max(odd.len()) {
                let (even, odd) = (even.get(k).copied(), odd.get(k).copied());
                let entry_values = |entry| line(entry).iter().copied();
                buffers.transform(
                    &*self.forward,
                    even.map(entry_values),
                    odd.map(entry_values),
                );
                for (parity, entry) in [even, odd].into_iter().enumerate() {
                    let Some((row, column)) = entry else { continue };
                    let across = usize::from(Q::is_odd(row, column).1);
                    let loads = pair.spectra[column][across].chunks_exact(frequencies);
                    let sums = sums[parity].chunks_exact_mut(R * frequencies);
                    for (sum, load) in sums.zip(loads) {
                        let sum = &mut sum[row * frequencies..][..frequencies];
                        for ((sum, load), kernel) in sum.iter_mut().zip(load).zip(&buffers.spectrum)
                        {
                            let real = if parity == 0 { kernel.re } else { -kernel.im };
                            *sum += load * real;
                        }
                    }
                }
            }
        }
        Ok(self.transform_back(&sums, (states, R, n)))
    }

    /// Transforms the sums of even and odd entries back to the line, for all states and components. A kernel
    /// that is odd along the line has the transform -i times its sum.
    fn transform_back(
        &self,
        sums: &[Vec<Complex64>; 2],
        (states, components, n): (usize, usize, usize),
    ) -> Vec<Array2<f64>> {
        let frequencies = self.period / 2 + 1;
        let norm = 1.0 / self.period as f64;
        let mut spectrum = vec![Complex64::default(); frequencies];
        let mut real = vec![0.0; self.period];
        let mut scratch = vec![Complex64::default(); self.inverse.get_scratch_len()];
        let mut lines = vec![Array2::zeros((components, n)); states];
        for (line, result) in lines
            .iter_mut()
            .flat_map(|state| state.rows_mut())
            .enumerate()
        {
            let part = line * frequencies..(line + 1) * frequencies;
            let (even, odd) = (&sums[0][part.clone()], &sums[1][part]);
            for ((s, e), o) in spectrum.iter_mut().zip(even).zip(odd) {
                *s = Complex64::new(e.re + o.im, e.im - o.re);
            }
            // The first and last frequencies of a real line are real; rounding errors are removed.
            spectrum[0].im = 0.0;
            spectrum[frequencies - 1].im = 0.0;
            self.inverse
                .process_with_scratch(&mut spectrum, &mut real, &mut scratch)
                .expect("buffers have the planned lengths");
            let period = self.period as isize;
            for (i, v) in result.into_iter().enumerate() {
                *v = norm * real[(i as isize - self.start).rem_euclid(period) as usize];
            }
        }
        lines
    }
}

/// Row and column of a kernel's entry.
type Entry = (usize, usize);

/// The entries of the kernel that act on loads that are not zero, even and odd ones along the line.
fn entries_with_loads<Q: Quantity<N, R>, const N: usize, const R: usize>(
    pair: &RowPair,
) -> (Vec<Entry>, Vec<Entry>) {
    let entries = (0..R).flat_map(|row| (0..3).map(move |column| (row, column)));
    let meets = |&(row, column): &Entry| {
        let across = usize::from(Q::is_odd(row, column).1);
        !pair.spectra[column][across].is_empty()
    };
    entries
        .filter(meets)
        .partition(|&(row, column)| !Q::is_odd(row, column).0)
}
