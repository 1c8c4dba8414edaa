//! The product with spectra: rows along y, lines along x, and back.
//!
//! Only rows that hold data are transformed along y, and along x the lines never leave the cache:
//! each is padded, transformed, multiplied, transformed back and cut. The transform of a traction
//! is shared by all its kernels. Between the two passes numbers travel in blocks of eight, a cache
//! line at a time.
//! Every number is computed by one thread alone, so the result does not depend on their number.

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use std::sync::Arc;

use super::spectra::Spectrum;
use super::y_transform::{YScratch, YTransform};
use super::{Displacements, Half, Mirror, Spectra, Tractions};

/// Rows, and frequencies k_y, per block.
const BLOCK: usize = 8;
/// Cells below which a second thread costs more than it brings.
const PARALLEL_FROM: usize = 64 * 64;
/// Behaviour of the components x, y, z of tractions and displacements under y -> -y.
const HALF: [Half; 3] = [Half::Even, Half::Odd, Half::Even];

/// Planned transforms and buffers for fields of one shape.
pub(crate) struct SpectralProduct {
    nx: usize,
    /// Rows kept along y.
    rows: usize,
    period: (usize, usize),
    y: YTransform,
    x_forward: Arc<dyn RealToComplex<f64>>,
    x_inverse: Arc<dyn ComplexToReal<f64>>,
    /// (block, component, family, k_y, row in block)
    by_row: Vec<f64>,
    /// (block of k_y, component, family, x, k_y in block)
    by_line: Vec<f64>,
    scratch: Vec<Scratch>,
    /// Two-dimensional transforms done.
    pub(crate) transforms: usize,
}

/// Buffers of one thread.
struct Scratch {
    y: YScratch,
    /// (component, family, k_y in block, x)
    tile: Vec<f64>,
    real: Vec<f64>,
    input: [Vec<Complex64>; 3],
    sum: Vec<Complex64>,
    fft: Vec<Complex64>,
}

impl Scratch {
    /// Lines of up to eight frequencies of one component and family, from blocks of eight rows:
    /// `from` starts at the first block's first frequency.
    fn gather(&mut self, line: usize, from: &[f64], per_block: usize, nx: usize, count: usize) {
        let tile = &mut self.tile[line * BLOCK * nx..(line + 1) * BLOCK * nx];
        for (b, block) in from.chunks(per_block).enumerate() {
            let rows = BLOCK.min(nx - b * BLOCK);
            for (k, values) in block.chunks(BLOCK).take(count).enumerate() {
                tile[k * nx + b * BLOCK..][..rows].copy_from_slice(&values[..rows]);
            }
        }
    }
}

/// A power of i.
#[derive(Clone, Copy)]
enum Unit {
    One,
    MinusOne,
    I,
    MinusI,
}

impl SpectralProduct {
    pub(crate) fn new(nx: usize, ny: usize, mirror: Mirror, period: (usize, usize)) -> Self {
        let mut planner = RealFftPlanner::new();
        let y = YTransform::new(mirror, ny, period.1, &mut planner);
        let x_forward = planner.plan_fft_forward(period.0);
        let x_inverse = planner.plan_fft_inverse(period.0);
        let rows = mirror.rows(ny);
        let threads = if nx * rows < PARALLEL_FROM {
            1
        } else {
            rayon::current_num_threads().max(1)
        };
        let frequencies = period.0 / 2 + 1;
        let fft = x_forward.get_scratch_len().max(x_inverse.get_scratch_len());
        let complex = |n| vec![Complex64::default(); n];
        let scratch = (0..threads)
            .map(|_| Scratch {
                y: y.scratch(),
                tile: vec![0.0; 3 * y.families() * BLOCK * nx],
                real: vec![0.0; period.0],
                input: std::array::from_fn(|_| complex(frequencies)),
                sum: complex(frequencies),
                fft: complex(fft),
            })
            .collect();
        let size = 3 * y.families() * y.frequencies();
        Self {
            nx,
            rows,
            period,
            x_forward,
            x_inverse,
            by_row: vec![0.0; nx.div_ceil(BLOCK) * BLOCK * size],
            by_line: vec![0.0; 3 * y.families() * y.frequencies().div_ceil(BLOCK) * nx * BLOCK],
            scratch,
            y,
            transforms: 0,
        }
    }

    /// Applies the kernels to the tractions.
    pub(crate) fn apply(
        &mut self,
        spectra: &Spectra,
        input: Tractions<'_>,
        output: Displacements<'_>,
    ) {
        let input = [input.q_x, input.q_y, input.p];
        let mut output = [output.u_x, output.u_y, output.u_z];
        let wanted: [bool; 3] = std::array::from_fn(|c| output[c].is_some());
        let cells = self.nx * self.rows;
        for field in input.iter().flatten() {
            assert_eq!(
                field.len(),
                cells,
                "a traction must cover the operator's cells"
            );
        }
        for field in output.iter().flatten() {
            assert_eq!(
                field.len(),
                cells,
                "a displacement must cover the operator's cells"
            );
        }
        self.transforms += input.iter().flatten().count() + output.iter().flatten().count();
        self.rows_forward(input);
        self.lines(spectra, input.map(|f| f.is_some()), wanted);
        for (component, field) in output.iter_mut().enumerate() {
            if let Some(field) = field {
                self.rows_inverse(component, field);
            }
        }
    }

    /// Along y, from the rows of the fields to blocks of rows by frequency.
    fn rows_forward(&mut self, input: [Option<&[f64]>; 3]) {
        let (nx, rows, y) = (self.nx, self.rows, &self.y);
        let (families, frequencies) = (y.families(), y.frequencies());
        let per_block = 3 * families * frequencies * BLOCK;
        let blocks_each = nx.div_ceil(BLOCK).div_ceil(self.scratch.len());
        let work = |(part, (chunk, s)): (usize, (&mut [f64], &mut Scratch))| {
            for (b, block) in chunk.chunks_mut(per_block).enumerate() {
                let first = (part * blocks_each + b) * BLOCK;
                for (component, field) in input.iter().enumerate() {
                    let Some(field) = field else { continue };
                    let block = &mut block[component * families * frequencies * BLOCK..];
                    for i in 0..BLOCK.min(nx - first) {
                        let row = &field[(first + i) * rows..(first + i + 1) * rows];
                        y.forward(row, HALF[component], &mut s.y, |family, k, value| {
                            block[(family * frequencies + k) * BLOCK + i] = value;
                        });
                    }
                }
            }
        };
        let chunk = blocks_each * per_block;
        if self.scratch.len() == 1 {
            work((0, (&mut self.by_row, &mut self.scratch[0])));
        } else {
            self.by_row
                .par_chunks_mut(chunk)
                .zip(&mut self.scratch)
                .enumerate()
                .for_each(work);
        }
    }

    /// Along x: transforms of all lines of one frequency k_y, product, and back.
    fn lines(&mut self, spectra: &Spectra, given: [bool; 3], wanted: [bool; 3]) {
        let (nx, families, frequencies) = (self.nx, self.y.families(), self.y.frequencies());
        let per_block = 3 * families * nx * BLOCK;
        let blocks_each = frequencies.div_ceil(BLOCK).div_ceil(self.scratch.len());
        let (by_row, forward, inverse) = (&self.by_row, &self.x_forward, &self.x_inverse);
        let frequencies_x = self.period.0 / 2 + 1;
        let work = |(part, (chunk, s)): (usize, (&mut [f64], &mut Scratch))| {
            for (b, block) in chunk.chunks_mut(per_block).enumerate() {
                let first = (part * blocks_each + b) * BLOCK;
                let count = BLOCK.min(frequencies - first);
                for component in (0..3).filter(|&c| given[c]) {
                    for family in 0..families {
                        let line = component * families + family;
                        let from = &by_row[(line * frequencies + first) * BLOCK..];
                        s.gather(line, from, 3 * families * frequencies * BLOCK, nx, count);
                    }
                }
                for l in 0..count {
                    let k = first + l;
                    let row_of = k * frequencies_x..(k + 1) * frequencies_x;
                    for family in 0..families {
                        for component in (0..3).filter(|&c| given[c]) {
                            let line = component * families + family;
                            s.real[..nx].copy_from_slice(&s.tile[(line * BLOCK + l) * nx..][..nx]);
                            s.real[nx..].fill(0.0);
                            forward
                                .process_with_scratch(
                                    &mut s.real,
                                    &mut s.input[component],
                                    &mut s.fft,
                                )
                                .expect("buffers have the planned lengths");
                        }
                        for component in (0..3).filter(|&c| wanted[c]) {
                            s.sum.fill(Complex64::default());
                            for cause in (0..3).filter(|&c| given[c]) {
                                let (spectrum, unit) = spectra.pair(component, cause);
                                if !spectrum.is_empty() {
                                    let row = &spectrum[row_of.clone()];
                                    add_product(&mut s.sum, row, &s.input[cause], unit);
                                }
                            }
                            s.sum[0].im = 0.0;
                            s.sum[frequencies_x - 1].im = 0.0;
                            inverse
                                .process_with_scratch(&mut s.sum, &mut s.real, &mut s.fft)
                                .expect("buffers have the planned lengths");
                            let lines = &mut block[(component * families + family) * nx * BLOCK..];
                            for (to, from) in lines.chunks_mut(BLOCK).zip(&s.real[..nx]) {
                                to[l] = *from;
                            }
                        }
                    }
                }
            }
        };
        let chunk = blocks_each * per_block;
        if self.scratch.len() == 1 {
            work((0, (&mut self.by_line, &mut self.scratch[0])));
        } else {
            self.by_line
                .par_chunks_mut(chunk)
                .zip(&mut self.scratch)
                .enumerate()
                .for_each(work);
        }
    }

    /// Along y, back to the rows of a field.
    fn rows_inverse(&mut self, component: usize, field: &mut [f64]) {
        let (nx, rows, y) = (self.nx, self.rows, &self.y);
        let families = y.families();
        let by_line = &self.by_line;
        let rows_each = nx.div_ceil(self.scratch.len());
        let per_block = 3 * families * nx * BLOCK;
        let work = |(part, (chunk, s)): (usize, (&mut [f64], &mut Scratch))| {
            for (i, row) in chunk.chunks_mut(rows).enumerate() {
                let i = part * rows_each + i;
                let get = |family: usize, k: usize| {
                    let line = (component * families + family) * nx + i;
                    by_line[k / BLOCK * per_block + line * BLOCK + k % BLOCK]
                };
                y.inverse(HALF[component], &mut s.y, get, row);
            }
        };
        if self.scratch.len() == 1 {
            work((0, (field, &mut self.scratch[0])));
        } else {
            field
                .par_chunks_mut(rows_each * rows)
                .zip(&mut self.scratch)
                .enumerate()
                .for_each(work);
        }
    }
}

impl Spectra {
    /// The spectrum that carries component `cause` of the tractions to component `effect` of the
    /// displacements, and the power of i before it, for the even family (see `y_transform`). An
    /// odd kernel gives -i along x; along y it exchanges a and b, with a minus sign from b to a.
    fn pair(&self, effect: usize, cause: usize) -> (&Spectrum, Unit) {
        match (effect, cause) {
            (0, 0) => (&self.xx, Unit::One),
            (1, 1) => (&self.yy, Unit::One),
            (2, 2) => (&self.zz, Unit::One),
            (0, 1) => (&self.xy, Unit::MinusI),
            (1, 0) => (&self.xy, Unit::I),
            (0, 2) => (&self.xz, Unit::MinusI),
            (2, 0) => (&self.xz, Unit::I),
            _ => (&self.yz, Unit::MinusOne),
        }
    }
}

/// sum += unit * spectrum * input.
fn add_product(sum: &mut [Complex64], spectrum: &[f64], input: &[Complex64], unit: Unit) {
    let terms = sum.iter_mut().zip(spectrum).zip(input);
    match unit {
        Unit::One => terms.for_each(|((t, s), v)| {
            t.re += s * v.re;
            t.im += s * v.im;
        }),
        Unit::MinusOne => terms.for_each(|((t, s), v)| {
            t.re -= s * v.re;
            t.im -= s * v.im;
        }),
        Unit::I => terms.for_each(|((t, s), v)| {
            t.re -= s * v.im;
            t.im += s * v.re;
        }),
        Unit::MinusI => terms.for_each(|((t, s), v)| {
            t.re += s * v.im;
            t.im -= s * v.re;
        }),
    }
}
