//! Lines at any depths below a straight line on the surface.
//!
//! The lines need no transform across them: for each distance between a row of loads and the line,
//! the kernel is transformed along the line, multiplied with the transform of the loads, and the
//! products are added up; one transform back gives the line. Rows at equal distances on both sides
//! of the line share the kernel, whose parity across the line is known; where the loads are
//! symmetric to the line, half of the entries are not needed at all.

use ndarray::{Array2, Array3, ArrayView1};
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::bulk::Bulk;
use super::loads::{Loads, Plane, Source, snapped};
use super::near_rim::NearRim;
use super::parity::Buffers;
use super::{Depth, Side};
use crate::convolution::{Tractions, good_size};
use crate::error::Error;
use crate::kernels::{DepthKernel, Displacement, Quantity, Stack, Stress, refuse_rigid};
use crate::scene::{Body, Grid};
use crate::stop::unless;

/// A straight line on the surface, through the middles of cells or anywhere between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    /// Along x at this y \[m\].
    AlongX(f64),
    /// Along y at this x \[m\].
    AlongY(f64),
}

/// Stress and displacement below a line, at the places of the grid's cells along it.
pub struct Section {
    body: Body,
    stack: Stack,
    grid: Grid,
    side: Side,
    line: Line,
    plane: Plane,
    bulk: Bulk,
    rim: Option<NearRim>,
    states: usize,
    /// For loads on cells and for point loads; the latter may serve all depths asked for.
    rows: [Rows; 2],
    stop: Arc<AtomicBool>,
}

/// The transforms of the loads along the line.
struct Rows {
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
    /// By component and by the kernel's parity across the line (even, odd): the spectra of all
    /// states, or nothing where all vanish.
    spectra: [[Vec<Complex64>; 2]; 3],
}

impl Section {
    /// Below `line` in the body `side` under each of the `states` of tractions, each field of
    /// shape (nx, ny) of the grid.
    pub fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Line,
        states: &[Tractions<'_>],
    ) -> Result<Self, Error> {
        Self::until(body, side, grid, line, states, &Arc::default())
    }

    /// As [`Self::new`]; when `stop` is raised, this and what is asked of it later ends with
    /// [`Error::Interrupted`].
    pub fn until(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Line,
        states: &[Tractions<'_>],
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        body.check("body")?;
        grid.check()?;
        let (exchanged, at) = match line {
            Line::AlongX(y) => (false, y),
            Line::AlongY(x) => (true, x),
        };
        let plane = Plane::new(grid, exchanged);
        let half = plane.n.1 as f64 * plane.d.1 / 2.0;
        if at.is_nan() || at.abs() > half * (1.0 + 1e-9) {
            let key = if exchanged { "x" } else { "y" };
            return Err(Error::invalid(
                key,
                at,
                format!("a place above the grid, {:e} to {half:e} m", -half),
            ));
        }
        let [cells, points] =
            Source::ALL.map(|source| Rows::new(&plane, side, at, states, source, stop));
        Ok(Self {
            stack: Stack::new(body),
            body: body.clone(),
            grid: *grid,
            side,
            line,
            plane,
            bulk: Bulk::default(),
            rim: None,
            states: states.len(),
            rows: [cells?, points?],
            stop: stop.clone(),
        })
    }

    /// Adds the stress that the body has under the bulk stress `sigma_B` of each of the states \[Pa\]
    /// (0 for those beyond the list): that of its own modulus in each layer.
    #[must_use]
    pub fn with_bulk_stress(mut self, sigma_B: &[f64]) -> Self {
        self.bulk = Bulk::new(sigma_B, &self.grid);
        self
    }

    /// Takes the tractions, the same `states`, for those of contacts of which the cells `stick` (for
    /// states beyond the list: which slip at their rim). Near the surface and near the rim and the
    /// stick zone the stress is then that of tractions that vary within the cells.
    #[must_use]
    pub fn with_rim(mut self, states: &[Tractions<'_>], stick: &[&[bool]]) -> Self {
        let grid = &self.grid;
        let (columns, rows) = match self.line {
            Line::AlongX(y) => {
                let ((_, j), _) = NearRim::locate(grid, 0.0, y);
                (0..grid.nx, j..j + 1)
            }
            Line::AlongY(x) => {
                let ((i, _), _) = NearRim::locate(grid, x, 0.0);
                (i..i + 1, 0..grid.ny)
            }
        };
        self.rim = Some(NearRim::new(
            grid,
            self.side,
            states,
            stick,
            (columns, rows),
        ));
        self
    }

    /// Stress of each state \[Pa\], shape (6, depths, cells along the line): xx, yy, zz, xy, xz,
    /// yz.
    pub fn stress(&self, depths: &[Depth]) -> Result<Vec<Array3<f64>>, Error> {
        self.gather::<6>(depths, |depth| self.stress_at(depth))
    }

    /// Displacement of each state relative to infinity \[m\], shape (3, depths, cells along the
    /// line).
    pub fn displacement(&self, depths: &[Depth]) -> Result<Vec<Array3<f64>>, Error> {
        self.gather::<3>(depths, |depth| {
            self.at(&self.kernel::<Displacement, 5, 3>(depth)?, depth)
        })
    }

    /// Hands the stresses of all states on each line, of shape (6, cells along the line), to `f`
    /// as soon as they are known, with what it keeps of that depth; depths in parallel.
    pub fn pass_stress<T: Send>(
        &self,
        depths: &[Depth],
        kept: &mut [T],
        f: impl Fn(&mut T, &[Array2<f64>]) + Sync,
    ) -> Result<(), Error> {
        depths.par_iter().zip(kept).try_for_each(|(depth, kept)| {
            f(kept, &self.stress_at(*depth)?);
            Ok(())
        })
    }

    /// The lines at all depths, by state.
    fn gather<const R: usize>(
        &self,
        depths: &[Depth],
        lines: impl Fn(Depth) -> Result<Vec<Array2<f64>>, Error> + Sync,
    ) -> Result<Vec<Array3<f64>>, Error> {
        let lines: Vec<_> = depths
            .par_iter()
            .map(|depth| lines(*depth))
            .collect::<Result<_, _>>()?;
        let of_state = |state: usize| {
            Array3::from_shape_fn((R, depths.len(), self.plane.n.0), |(r, depth, i)| {
                lines[depth][state][(r, i)]
            })
        };
        Ok((0..self.states).map(of_state).collect())
    }

    /// The stress of all states at one depth, each of shape (6, cells along the line).
    fn stress_at(&self, depth: Depth) -> Result<Vec<Array2<f64>>, Error> {
        let kernel = self.kernel::<Stress, 10, 6>(depth)?;
        let mut lines = self.at(&kernel, depth)?;
        self.add_rim(&kernel, depth, &mut lines);
        for (state, line) in lines.iter_mut().enumerate() {
            let bulk = self.bulk.stress(&self.body, state, depth.layer);
            for (mut row, bulk) in line.rows_mut().into_iter().zip(bulk) {
                row += bulk;
            }
        }
        Ok(lines)
    }

    /// Adds to the stress lines of all states at a depth what the rim does to them.
    fn add_rim(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        lines: &mut [Array2<f64>],
    ) {
        let Some(rim) = &self.rim else { return };
        let (first, offset) = match self.line {
            Line::AlongX(y) => NearRim::locate(&self.grid, self.grid.x(0), y),
            Line::AlongY(x) => NearRim::locate(&self.grid, x, self.grid.y(0)),
        };
        let Some(parts) = rim.parts(kernel, depth, offset) else {
            return;
        };
        for (state, line) in lines.iter_mut().enumerate() {
            for (n, mut stress) in line.columns_mut().into_iter().enumerate() {
                let cell = match self.line {
                    Line::AlongX(_) => (n, first.1),
                    Line::AlongY(_) => (first.0, n),
                };
                if rim.is_near(state, depth, cell) {
                    let more = rim.stress(&parts, state, cell);
                    stress += &ArrayView1::from(&more);
                }
            }
        }
    }

    fn kernel<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        depth: Depth,
    ) -> Result<DepthKernel<Q, N, R>, Error> {
        refuse_rigid(&self.body, depth.layer)?;
        unless(&self.stop)?;
        let place = self.stack.place(depth.z, Some(depth.layer))?;
        DepthKernel::new(&self.stack, place, self.plane.reach())
    }

    /// The lines of all states at one depth, each of shape (R, cells along the line).
    fn at<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        depth: Depth,
    ) -> Result<Vec<Array2<f64>>, Error> {
        let source = Source::at(depth.z, self.plane.d);
        let rows = &self.rows[source.index()];
        let shape = (self.states, self.plane.n.0);
        let own = rows.convolve(kernel, self.plane.d, shape, &self.stop)?;
        let exchanged = matches!(self.line, Line::AlongY(_));
        let turn = |own: Array2<f64>| {
            Array2::from_shape_fn(own.dim(), |(row, i)| {
                let from = if exchanged {
                    Q::exchanged(row, 0).0
                } else {
                    row
                };
                // A component with one index z changes its sign between the bodies.
                let sign = if Q::has_one_z(row) {
                    self.side.sign()
                } else {
                    1.0
                };
                sign * own[(from, i)]
            })
        };
        Ok(own.into_iter().map(turn).collect())
    }
}

impl Rows {
    fn new(
        plane: &Plane,
        side: Side,
        at: f64,
        states: &[Tractions<'_>],
        source: Source,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let patch = plane.patch(states, source);
        let loads: Vec<Loads> = states
            .iter()
            .map(|state| plane.loads(state, side, source, patch))
            .collect();
        // Columns lie symmetric to the middle of the grid.
        let offsets = (plane.n.0 as isize - patch.start.0) as usize;
        let period = good_size(2 * offsets - 1);
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (
            planner.plan_fft_forward(period),
            planner.plan_fft_inverse(period),
        );
        // Rows by their distance in millionths of a cell: on equal ones the kernel is shared.
        let mut by_distance: BTreeMap<u64, (f64, Vec<(usize, bool)>)> = BTreeMap::new();
        for j in 0..patch.rows {
            let row = (j as isize + patch.start.1) as f64;
            let offset = snapped(at / plane.d.1 - (row - (plane.n.1 - 1) as f64 / 2.0));
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

    /// The lines of all states, each of shape (R, n).
    fn convolve<Q: Quantity<N, R>, const N: usize, const R: usize>(
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
        for pair in &self.pairs {
            unless(stop)?;
            let (even, odd) = needed::<Q, N, R>(pair);
            if even.is_empty() && odd.is_empty() {
                continue;
            }
            self.source
                .row(kernel, self.offsets, pair.distance, d, |i, response| {
                    for (entry, value) in response.as_flattened().iter().enumerate() {
                        entries[entry * self.offsets + i] = *value;
                    }
                });
            let line = |(row, column): (usize, usize)| {
                &entries[(3 * row + column) * self.offsets..][..self.offsets]
            };
            // One real transform holds an even kernel in its real part, an odd one in its
            // imaginary part.
            for k in 0..even.len().max(odd.len()) {
                let (even, odd) = (even.get(k).copied(), odd.get(k).copied());
                let of = |entry| line(entry).iter().copied();
                buffers.transform(&*self.forward, even.map(of), odd.map(of));
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
        Ok(self.back(&sums, (states, R, n)))
    }

    /// Transforms the sums back; a kernel odd along the line has the transform -i times its sum.
    fn back(
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
            // A real line has real first and last frequencies; rounding must not say otherwise.
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

/// The kernel's entries that meet loads, by their parity along the line.
fn needed<Q: Quantity<N, R>, const N: usize, const R: usize>(
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
