//! Products of kernels with loads on a whole plane, by two-dimensional transforms.
//!
//! The kernel, known by its parities on the offsets >= 0, is transformed along x, then along y,
//! where each line of frequencies is multiplied with the loads and transformed back at once; the
//! transform of the loads is shared by all depths.

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
use rustfft::{Fft, FftPlanner};

use super::Side;
use super::loads::{Patch, Plane, Source};
use super::parity::Buffers;

/// The loads on one kind of source, transformed, and the plans of the transforms.
pub(super) struct PlaneTransform {
    source: Source,
    /// First loaded column and row.
    start: (isize, isize),
    /// Offsets along x and y that occur.
    offsets: (usize, usize),
    period: (usize, usize),
    x_forward: Arc<dyn RealToComplex<f64>>,
    x_inverse: Arc<dyn ComplexToReal<f64>>,
    y_real: Arc<dyn RealToComplex<f64>>,
    y_inverse: Arc<dyn Fft<f64>>,
    /// (state, component, k_x, k_y), or nothing where a component vanishes.
    spectra: Vec<[Vec<Complex64>; 3]>,
}

impl PlaneTransform {
    /// Transforms the tractions of each state on the whole grid, for sources that are cells or points.
    pub(super) fn new(
        plane: &Plane,
        side: Side,
        states: &[Tractions<'_>],
        source: Source,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let patch = plane.loaded_patch(states, source);
        // The patch lies symmetric to the middle along x, not so along y.
        let beyond = patch.start.1 + patch.rows as isize - 1;
        let offsets = (
            (plane.n.0 as isize - patch.start.0) as usize,
            (plane.n.1 as isize - patch.start.1).max(beyond + 1) as usize,
        );
        let period = (
            fast_length(2 * offsets.0 - 1),
            fast_length(2 * offsets.1 - 1),
        );
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        let mut transform = Self {
            source,
            start: patch.start,
            offsets,
            period,
            x_forward: real.plan_fft_forward(period.0),
            x_inverse: real.plan_fft_inverse(period.0),
            y_real: real.plan_fft_forward(period.1),
            y_inverse: complex.plan_fft_inverse(period.1),
            spectra: Vec::new(),
        };
        let y_forward = complex.plan_fft_forward(period.1);
        transform.spectra = states
            .iter()
            .map(|state| {
                let loads = plane.loads(state, side, source, patch);
                let load = |c: usize| {
                    transform.transform_loads(|j| loads.row(c, j), patch, &*y_forward, stop)
                };
                Ok([load(0)?, load(1)?, load(2)?])
            })
            .collect::<Result<_, Error>>()?;
        Ok(transform)
    }

    /// Number of frequencies along x: half of the length and one.
    fn frequencies(&self) -> usize {
        self.period.0 / 2 + 1
    }

    /// Transforms the loads of one component along x and y: an array over (k_x, k_y). `row` returns the loads
    /// of a row.
    fn transform_loads<'a>(
        &self,
        row: impl Fn(usize) -> &'a [f64],
        patch: Patch,
        y_forward: &dyn Fft<f64>,
        stop: &AtomicBool,
    ) -> Result<Vec<Complex64>, Error> {
        if (0..patch.rows).all(|j| row(j).iter().all(|q| *q == 0.0)) {
            return Ok(Vec::new());
        }
        let frequencies = self.frequencies();
        let mut loads_spectrum = vec![Complex64::default(); frequencies * self.period.1];
        let mut real = vec![0.0; self.period.0];
        let mut spectrum = vec![Complex64::default(); frequencies];
        for j in 0..patch.rows {
            unless(stop)?;
            real.fill(0.0);
            real[..patch.columns].copy_from_slice(row(j));
            self.x_forward
                .process(&mut real, &mut spectrum)
                .expect("buffers have the planned lengths");
            for (k, v) in spectrum.iter().enumerate() {
                loads_spectrum[k * self.period.1 + j] = *v;
            }
        }
        loads_spectrum
            .par_chunks_mut(self.period.1)
            .try_for_each(|line| {
                unless(stop)?;
                y_forward.process(line);
                Ok(())
            })?;
        Ok(loads_spectrum)
    }

    /// Multiplies by a kernel and transforms back: the R components on the grid for each state.
    pub(super) fn convolve<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        plane: Plane,
        states: usize,
        stop: &AtomicBool,
    ) -> Result<Vec<[Array2<f64>; R]>, Error> {
        let half = self.along_x(kernel, plane.d, stop)?;
        let lines = self.along_y::<Q, N, R>(&half, plane.n.1, states, stop)?;
        let of_state = |state: usize| {
            let of_row = |row: usize| {
                unless(stop)?;
                Ok(self.back_along_x(&lines[state * R + row], plane.n))
            };
            let planes: Vec<_> = (0..R).map(of_row).collect::<Result<_, Error>>()?;
            Ok(planes.try_into().expect("one plane per component"))
        };
        (0..states).map(of_state).collect()
    }

    /// Transforms the entries of a kernel along x, each an array over (k_x, offset along y) of numbers that are
    /// real by parity.
    fn along_x<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        d: (f64, f64),
        stop: &AtomicBool,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let (nx, ny) = self.offsets;
        let frequencies = self.frequencies();
        let mut half = vec![vec![0.0; frequencies * ny]; 3 * R];
        let mut entries = vec![0.0; 3 * R * nx];
        let mut buffers = Buffers::new(&*self.x_forward);
        let pairs = pair_entries::<R>(|row, column| Q::is_odd(row, column).0);
        let mut corners = SharedCorners::new(0.0, nx);
        for j in 0..ny {
            unless(stop)?;
            let y = j as f64 * d.1;
            let put = |i: usize, response: [[f64; 3]; R]| {
                for (e, value) in response.as_flattened().iter().enumerate() {
                    entries[e * nx + i] = *value;
                }
            };
            self.source.row(kernel, nx, y, d, &mut corners, put);
            for pair in &pairs {
                let entry_values = |e: usize| entries[e * nx..][..nx].iter().copied();
                buffers.transform(
                    &*self.x_forward,
                    pair[0].map(entry_values),
                    pair[1].map(entry_values),
                );
                for (k, v) in buffers.spectrum.iter().enumerate() {
                    if let Some(even) = pair[0] {
                        half[even][k * ny + j] = v.re;
                    }
                    if let Some(odd) = pair[1] {
                        half[odd][k * ny + j] = -v.im;
                    }
                }
            }
        }
        Ok(half)
    }

    /// Transforms the kernel along y, multiplies by the loads, and transforms the product back along y: for
    /// each state and component an array over (y, k_x).
    fn along_y<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        half: &[Vec<f64>],
        rows: usize,
        states: usize,
        stop: &AtomicBool,
    ) -> Result<Vec<Vec<Complex64>>, Error> {
        let (frequencies, period) = (self.frequencies(), self.period.1);
        let ny = self.offsets.1;
        let pairs = pair_entries::<R>(|row, column| Q::is_odd(row, column).1);
        let mut lines = vec![vec![Complex64::default(); rows * frequencies]; states * R];
        let mut buffers = Buffers::new(&*self.y_real);
        let mut sums = vec![Complex64::default(); states * R * period];
        let mut scratch = vec![Complex64::default(); self.y_inverse.get_inplace_scratch_len()];
        for k in 0..frequencies {
            unless(stop)?;
            sums.fill(Complex64::default());
            for pair in &pairs {
                let entry_values = |e: usize| half[e][k * ny..][..ny].iter().copied();
                buffers.transform(
                    &*self.y_real,
                    pair[0].map(entry_values),
                    pair[1].map(entry_values),
                );
                for (odd_y, entry) in pair.iter().enumerate() {
                    let Some(entry) = *entry else { continue };
                    let (row, column) = (entry / 3, entry % 3);
                    let odd_x = usize::from(Q::is_odd(row, column).0);
                    for (state, loads) in self.spectra.iter().enumerate() {
                        if !loads[column].is_empty() {
                            let load = &loads[column][k * period..][..period];
                            let sum = &mut sums[(state * R + row) * period..][..period];
                            multiply(sum, load, &buffers.spectrum, odd_y == 1, odd_x + odd_y);
                        }
                    }
                }
            }
            for (sum, line) in sums.chunks_exact_mut(period).zip(&mut lines) {
                self.y_inverse.process_with_scratch(sum, &mut scratch);
                for j in 0..rows {
                    let from = (j as isize - self.start.1).rem_euclid(period as isize) as usize;
                    line[j * frequencies + k] = sum[from];
                }
            }
        }
        Ok(lines)
    }

    /// Transforms a component over (y, k_x) back along x, to the grid.
    fn back_along_x(&self, lines: &[Complex64], (nx, ny): (usize, usize)) -> Array2<f64> {
        let norm = 1.0 / (self.period.0 * self.period.1) as f64;
        let mut field = Array2::zeros((nx, ny));
        let mut spectrum = vec![Complex64::default(); self.frequencies()];
        let mut real = vec![0.0; self.period.0];
        let mut scratch = vec![Complex64::default(); self.x_inverse.get_scratch_len()];
        let period = self.period.0 as isize;
        for (j, line) in lines.chunks_exact(self.frequencies()).enumerate() {
            spectrum.copy_from_slice(line);
            // The first and last frequencies of a real row are real; rounding errors are removed.
            spectrum[0].im = 0.0;
            spectrum[self.period.0 / 2].im = 0.0;
            self.x_inverse
                .process_with_scratch(&mut spectrum, &mut real, &mut scratch)
                .expect("buffers have the planned lengths");
            for i in 0..nx {
                let from = (i as isize - self.start.0).rem_euclid(period) as usize;
                field[(i, j)] = norm * real[from];
            }
        }
        field
    }
}

/// Adds load times spectrum to the sums. The transform of an entry is real, or -i times the imaginary part, by
/// its parity; `n` counts the odd directions, `odd` is its parity in the frequency.
fn multiply(
    sum: &mut [Complex64],
    load: &[Complex64],
    spectrum: &[Complex64],
    odd: bool,
    n: usize,
) {
    let period = sum.len();
    let rotate = |v: Complex64, s: f64| match n {
        0 => v * s,
        1 => Complex64::new(v.im * s, -v.re * s),
        _ => v * -s,
    };
    let value = |k: usize| if odd { -spectrum[k].im } else { spectrum[k].re };
    let sign = if odd { -1.0 } else { 1.0 };
    sum[0] += rotate(load[0], value(0));
    sum[period / 2] += rotate(load[period / 2], value(period / 2));
    for k in 1..period / 2 {
        let s = value(k);
        sum[k] += rotate(load[k], s);
        sum[period - k] += rotate(load[period - k], sign * s);
    }
}

/// Entries (3 row + column) in pairs of an even and an odd one, which share a transform.
fn pair_entries<const R: usize>(is_odd: impl Fn(usize, usize) -> bool) -> Vec<[Option<usize>; 2]> {
    let (odd, even): (Vec<usize>, Vec<usize>) =
        (0..3 * R).partition(|entry| is_odd(entry / 3, entry % 3));
    (0..even.len().max(odd.len()))
        .map(|n| [even.get(n).copied(), odd.get(n).copied()])
        .collect()
}
