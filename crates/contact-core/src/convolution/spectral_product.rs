//! The product with spectra: rows along y, lines along x, and back.
//!
//! Only rows that hold data are transformed along y, and along x the lines never leave the cache:
//! each is padded, transformed, multiplied, transformed back and cut. The transform of a traction
//! is shared by all its kernels. Between the two passes numbers travel in blocks of eight rows, a
//! cache line at a time.
//! Every number is computed by one thread alone, so the result does not depend on their number.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use super::line_product::multiply;
use super::line_spectra::LineSpectra;
use super::precision::Precision;
use super::y_transform::{ROWS, YScratch, YTransform};
use super::{Displacements, Spectra, Tractions};
use crate::error::Error;
use crate::plan::{Mirror, Parity};

/// Number of cells below which a second thread costs more than it saves.
pub(crate) const PARALLEL_FROM: usize = 48 * 48;
/// Parts of the work per thread: a delayed thread leaves the remaining parts to the others.
const PARTS_PER_THREAD: usize = 4;
/// Behaviour of the components x, y, z of tractions and displacements under y -> -y.
const PARITIES: [Parity; 3] = [Parity::Even, Parity::Odd, Parity::Even];

/// Planned transforms, spectra and buffers for fields of one shape.
pub(crate) struct SpectralProduct<T: Precision> {
    nx: usize,
    /// Rows stored along y.
    rows: usize,
    mirror: Mirror,
    /// The components that have kernels.
    components: Range<usize>,
    /// Period along x.
    period: usize,
    y: YTransform<T>,
    spectra: LineSpectra<T>,
    /// The scale of the spectra.
    unit: f64,
    x_forward: Arc<dyn Fft<T>>,
    x_inverse: Arc<dyn Fft<T>>,
    /// Spectra along y: (block of rows, component, line, row in block)
    by_row: Vec<Complex<T>>,
    /// Convolved lines: (line, component, x), `stride` numbers per line.
    by_line: Vec<Complex<T>>,
    stride: usize,
    parts: Vec<Scratch<T>>,
    /// Largest absolute value in each block of rows, by its bits.
    largest: Vec<u64>,
    /// Two-dimensional transforms done.
    pub(crate) transforms: usize,
}

/// Buffers of one part of the work.
struct Scratch<T> {
    y: YScratch<T>,
    /// A line per component with kernels, one number longer than the period, with space for a last
    /// block.
    line: [Vec<Complex<T>>; 3],
    fft: Vec<Complex<T>>,
    /// One block of rows of one component: (line, row in block)
    block: Vec<Complex<T>>,
}

impl<T: Precision> SpectralProduct<T> {
    /// Plans the product for fields of the whole grid of nx x ny cells, or of its mirrored half, and spectra of the
    /// given periods (even). Fails when `stop` is raised.
    pub(crate) fn new(
        (nx, ny): (usize, usize),
        mirror: Mirror,
        spectra: &Spectra,
        period: (usize, usize),
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let mut planner = FftPlanner::new();
        let y = YTransform::new(mirror, period.1, &mut planner);
        let x_forward = planner.plan_fft_forward(period.0);
        let x_inverse = planner.plan_fft_inverse(period.0);
        let rows = mirror.rows(ny);
        let threads = rayon::current_num_threads().max(1);
        let parts = if threads == 1 || nx * rows < PARALLEL_FROM {
            1
        } else {
            PARTS_PER_THREAD * threads
        };
        let zeros = |n| vec![Complex::default(); n];
        let fft = x_forward
            .get_inplace_scratch_len()
            .max(x_inverse.get_inplace_scratch_len());
        let components = if spectra.xx.is_empty() { 2..3 } else { 0..3 };
        let scratch = || Scratch {
            y: y.scratch(),
            line: std::array::from_fn(|_| zeros(period.0 + 1 + ROWS)),
            fft: zeros(fft),
            block: zeros(ROWS * y.lines()),
        };
        let width = nx.next_multiple_of(ROWS);
        let largest = || spectra.zz.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
        let unit = T::unit(largest);
        // Lines a power of two apart would all meet in one set of the cache.
        let stride = components.len() * width + ROWS;
        let (row, mirrored) = (period.0 / 2 + 1, mirror != Mirror::None);
        Ok(Self {
            nx,
            rows,
            mirror,
            period: period.0,
            parts: (0..parts).map(|_| scratch()).collect(),
            largest: vec![0; nx.div_ceil(ROWS)],
            spectra: LineSpectra::new(spectra, row, mirrored, unit, stop)?,
            unit,
            x_forward,
            x_inverse,
            by_row: zeros(components.len() * y.lines() * width),
            by_line: zeros(stride * y.lines()),
            components,
            stride,
            y,
            transforms: 0,
        })
    }

    /// Applies the kernels to the tractions.
    ///
    /// # Panics
    /// If a field does not cover the cells, or has no kernels.
    pub(crate) fn apply(&mut self, input: Tractions<'_>, output: Displacements<'_>) {
        let input = [input.q_x, input.q_y, input.p];
        let mut output = [output.u_x, output.u_y, output.u_z];
        let cells = self.nx * self.rows;
        let sizes = (input.iter().flatten().map(|f| f.len()))
            .chain(output.iter().flatten().map(|f| f.len()));
        for size in sizes {
            assert_eq!(size, cells, "a field must cover the operator's cells");
        }
        let is_wanted: [bool; 3] = std::array::from_fn(|c| output[c].is_some());
        for c in (0..3).filter(|&c| input[c].is_some() || is_wanted[c]) {
            assert!(self.components.contains(&c), "component {c} has no kernels");
        }
        self.transforms += input.iter().flatten().count() + output.iter().flatten().count();
        let (loaded_blocks, largest) = self.find_loaded_blocks(input);
        let unit = T::unit(|| largest);
        self.transform_rows(input, 1.0 / unit, &loaded_blocks);
        self.convolve_lines(input.map(|f| f.is_some()), is_wanted, &loaded_blocks);
        self.transform_rows_back(unit * self.unit, &mut output);
    }

    /// Returns the range of blocks of rows that hold all tractions that are not zero, and the largest absolute
    /// traction.
    fn find_loaded_blocks(&mut self, input: [Option<&[f64]>; 3]) -> (Range<usize>, f64) {
        let block = ROWS * self.rows;
        let work = |(b, largest): (usize, &mut [u64]), _: &mut Scratch<T>| {
            let fields = input.into_iter().flatten();
            let blocks = fields.filter_map(|field| field.chunks(block).nth(b));
            largest[0] = blocks.map(max_abs_bits).max().unwrap_or(0);
        };
        share_work(&mut self.parts, &mut self.largest, 1, work);
        let is_loaded = |&largest: &u64| largest != 0;
        let first = self.largest.iter().position(is_loaded).unwrap_or(0);
        let last = self
            .largest
            .iter()
            .rposition(is_loaded)
            .map_or(0, |b| b + 1);
        let largest = self.largest.iter().max().copied().unwrap_or(0);
        (first..last, f64::from_bits(largest))
    }

    /// Transforms along y, from the rows of the fields to blocks of rows by line.
    fn transform_rows(&mut self, input: [Option<&[f64]>; 3], scale: f64, loaded: &Range<usize>) {
        let (rows, y) = (self.rows, &self.y);
        let (lines, components) = (y.lines(), self.components.clone());
        let per_block = components.len() * lines * ROWS;
        let acting = &mut self.by_row[loaded.start * per_block..loaded.end * per_block];
        let first = loaded.start;
        let work = |(b, block): (usize, &mut [Complex<T>]), s: &mut Scratch<T>| {
            for (component, field) in input.iter().enumerate() {
                let Some(field) = field else { continue };
                let from = &field[(first + b) * ROWS * rows..];
                let mut field_rows = from.chunks(rows);
                let component_index = component - components.start;
                let block = &mut block[component_index * lines * ROWS..][..lines * ROWS];
                for r in (0..ROWS).step_by(2) {
                    let (first_row, second_row) = (field_rows.next(), field_rows.next());
                    match first_row {
                        Some(one) => y.forward(
                            [one, second_row.unwrap_or_default()],
                            scale,
                            PARITIES[component],
                            &mut s.y,
                            &mut block[r..],
                        ),
                        None => clear_row(block, r),
                    }
                    if second_row.is_none() {
                        clear_row(block, r + 1);
                    }
                }
            }
        };
        share_work(&mut self.parts, acting, per_block, work);
    }

    /// Transforms all components of a line along x, multiplies them by the kernels, and transforms back.
    fn convolve_lines(&mut self, is_given: [bool; 3], is_wanted: [bool; 3], loaded: &Range<usize>) {
        let (period, mirrored) = (self.period, self.mirror != Mirror::None);
        let (by_row, spectra) = (&self.by_row, &self.spectra);
        let (forward, inverse) = (&self.x_forward, &self.x_inverse);
        let (lines, components) = (self.y.lines(), self.components.clone());
        let width = self.nx.next_multiple_of(ROWS);
        let work = |(l, convolved): (usize, &mut [Complex<T>]), s: &mut Scratch<T>| {
            let Scratch { line, fft, .. } = s;
            for component in (0..3).filter(|&c| is_given[c]) {
                let z = &mut line[component];
                z[..loaded.start * ROWS].fill(Complex::default());
                z[loaded.end * ROWS..].fill(Complex::default());
                for b in loaded.clone() {
                    let component_index = component - components.start;
                    let from = ((b * components.len() + component_index) * lines + l) * ROWS;
                    copy_block(&mut z[b * ROWS..], &by_row[from..]);
                }
                forward.process_with_scratch(&mut z[..period], fft);
            }
            let full_lines = line.each_mut().map(|z| &mut z[..=period]);
            multiply(
                full_lines,
                spectra.kernels_of_line(l),
                is_given,
                is_wanted,
                mirrored,
            );
            for component in (0..3).filter(|&c| is_wanted[c]) {
                let z = &mut line[component];
                inverse.process_with_scratch(&mut z[..period], fft);
                convolved[(component - components.start) * width..][..width]
                    .copy_from_slice(&z[..width]);
            }
        };
        share_work(&mut self.parts, &mut self.by_line, self.stride, work);
    }

    /// Transforms along y, back to the rows of the fields, in parallel.
    fn transform_rows_back(&mut self, scale: f64, output: &mut [Option<&mut [f64]>; 3]) {
        let (rows, y, by_line) = (self.rows, &self.y, &self.by_line);
        let (width, stride) = (self.nx.next_multiple_of(ROWS), self.stride);
        let first = self.components.start;
        let transform_field = |component: usize, field: &mut [f64], parts: &mut [Scratch<T>]| {
            let work = |(b, cells): (usize, &mut [f64]), s: &mut Scratch<T>| {
                for (l, to) in s.block.chunks_mut(ROWS).enumerate() {
                    let from = l * stride + (component - first) * width + b * ROWS;
                    copy_block(to, &by_line[from..]);
                }
                for (r, pair) in cells.chunks_mut(2 * rows).enumerate() {
                    let (first_row, second_row) = pair.split_at_mut(rows);
                    y.inverse(
                        PARITIES[component],
                        scale,
                        &mut s.y,
                        &s.block[2 * r..],
                        [first_row, second_row],
                    );
                }
            };
            share_work(parts, field, ROWS * rows, work);
        };
        let count = output.iter().flatten().count().max(1);
        let fields = (output.iter_mut().enumerate())
            .filter_map(|(component, field)| field.as_deref_mut().map(|f| (component, f)));
        if self.parts.len() < count || count == 1 {
            fields
                .for_each(|(component, field)| transform_field(component, field, &mut self.parts));
            return;
        }
        let parts_per_field = self.parts.len() / count;
        rayon::scope(|scope| {
            for ((component, field), parts) in fields.zip(self.parts.chunks_mut(parts_per_field)) {
                scope.spawn(move |_| transform_field(component, field, parts));
            }
        });
    }
}

/// The bits of the largest absolute value; they are ordered like the values, NaN last.
fn max_abs_bits(field: &[f64]) -> u64 {
    let size = |v: &f64| v.abs().to_bits();
    field.iter().map(size).max().unwrap_or(0)
}

/// Copies a block of constant size, which spares a call of memcpy.
fn copy_block<T: Copy>(to: &mut [Complex<T>], from: &[Complex<T>]) {
    if let (Some(to), Some(from)) = (to.first_chunk_mut::<ROWS>(), from.first_chunk()) {
        *to = *from;
    }
}

/// Clears a row of a block that lies beyond the grid.
fn clear_row<T: Precision>(block: &mut [Complex<T>], row: usize) {
    for line in block.chunks_mut(ROWS) {
        line[row] = Complex::default();
    }
}

/// Distributes `items` in groups of `size` over the threads, each of which has its own buffers, and calls
/// `work` with each group and its first index.
fn share_work<T: Send, P: Precision>(
    parts: &mut [Scratch<P>],
    items: &mut [T],
    size: usize,
    work: impl Fn((usize, &mut [T]), &mut Scratch<P>) + Sync,
) {
    let items_per_part = items.len().div_ceil(size).div_ceil(parts.len()).max(1);
    if let [scratch] = parts {
        (items.chunks_mut(size).enumerate()).for_each(|item| work(item, scratch));
        return;
    }
    items
        .par_chunks_mut(items_per_part * size)
        .zip(parts)
        .enumerate()
        .for_each(|(part, (chunk, scratch))| {
            for (i, item) in chunk.chunks_mut(size).enumerate() {
                work((part * items_per_part + i, item), scratch);
            }
        });
}
