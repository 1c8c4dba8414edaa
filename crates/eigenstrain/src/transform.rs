//! Transforms of fields on the cells to waves and back: fast transforms, and moments for the integral over
//! small wave numbers.

use std::sync::Arc;

use ndarray::linalg::general_mat_mul;
use ndarray::{Array1, Array2, ArrayView2, ArrayViewMut2, Axis, Slice};
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use crate::mesh::Cells;
use crate::waves::{Periods, Wave, of_integral, of_transforms, reach};

/// Polynomials of a side beyond the phase K L/2 that resolve a wave on it.
const POLYNOMIALS: usize = 8;

/// The transforms of fields on the cells.
pub(crate) struct Transform {
    /// Cells along x (1 in plane strain) and along y (along x in plane strain).
    slow_cells: usize,
    fast_cells: usize,
    periods: Periods,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    slow_forward: Arc<dyn Fft<f64>>,
    slow_backward: Arc<dyn Fft<f64>>,
    /// Orthonormal polynomials on the cells of each side, (cells, polynomials).
    slow_basis: Array2<f64>,
    fast_basis: Array2<f64>,
    /// Waves of the integral in these polynomials: real parts of the even products, imaginary ones of
    /// the odd.
    even: Array2<f64>,
    odd: Array2<f64>,
    waves: Vec<Wave>,
}

impl std::fmt::Debug for Transform {
    /// Prints the size alone.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transform")
            .field("periods", &self.periods)
            .field("waves", &self.waves.len())
            .finish_non_exhaustive()
    }
}

/// Buffers of a thread.
pub(crate) struct Buffers {
    real: Vec<f64>,
    half: Vec<Complex64>,
    row: Vec<Complex64>,
    plane: Vec<Complex64>,
    scratch: Vec<Complex64>,
    moments: Array2<f64>,
    /// Results for all fields: moments along the fast side, and values on the cells.
    along: Array2<f64>,
    dense: Array2<f64>,
    even: Array2<f64>,
    odd: Array2<f64>,
    real_waves: Array2<f64>,
    imaginary_waves: Array2<f64>,
}

/// Fields that are transformed together.
const TOGETHER: usize = 6;

impl Transform {
    /// Plans the transforms of the cells: fast ones, and products for the slow waves.
    pub(crate) fn new(cells: &Cells) -> Self {
        let periods = Periods::from_cells(cells);
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        let mut waves = of_transforms(cells, periods);
        let small = of_integral(cells, periods);
        let reach = reach(cells, periods);
        let (slow_cells, fast_cells) = if cells.plane_strain {
            (1, cells.nx)
        } else {
            (cells.nx, cells.ny)
        };
        let lengths = if cells.plane_strain {
            [cells.dx, cells.dx]
        } else {
            [cells.dx, cells.dy]
        };
        let slow_basis = polynomials(slow_cells, reach * lengths[0]);
        let fast_basis = polynomials(fast_cells, reach * lengths[1]);
        let of_side = |basis: &Array2<f64>, length: f64, k: &dyn Fn(&Wave) -> f64| {
            let phases: Vec<f64> = small.iter().map(|wave| k(wave) * length).collect();
            in_basis(basis, &phases)
        };
        let (slow, fast) = if cells.plane_strain {
            (
                of_side(&slow_basis, cells.dx, &|_| 0.0),
                of_side(&fast_basis, cells.dx, &|w| w.k[0]),
            )
        } else {
            (
                of_side(&slow_basis, cells.dx, &|w| w.k[0]),
                of_side(&fast_basis, cells.dy, &|w| w.k[1]),
            )
        };
        let (even, odd) = products(&slow, &fast, small.len());
        waves.extend(small);
        Self {
            slow_cells,
            fast_cells,
            periods,
            forward: real.plan_fft_forward(periods.fast),
            backward: real.plan_fft_inverse(periods.fast),
            slow_forward: complex.plan_fft_forward(periods.slow),
            slow_backward: complex.plan_fft_inverse(periods.slow),
            slow_basis,
            fast_basis,
            even,
            odd,
            waves,
        }
    }

    /// All waves, the waves of the fast transforms first.
    pub(crate) fn waves(&self) -> &[Wave] {
        &self.waves
    }

    /// Number of slow waves, which are transformed by products.
    fn small(&self) -> usize {
        self.even.ncols()
    }

    /// Allocates the buffers of one thread.
    pub(crate) fn buffers(&self) -> Buffers {
        let zero = Complex64::default();
        let scratch = self.forward.get_scratch_len();
        let scratch = scratch.max(self.backward.get_scratch_len());
        let scratch = scratch.max(self.slow_forward.get_inplace_scratch_len());
        let scratch = scratch.max(self.slow_backward.get_inplace_scratch_len());
        let (slow, fast) = (self.slow_basis.ncols(), self.fast_basis.ncols());
        let rows = |n: usize| Array2::zeros((TOGETHER, n));
        Buffers {
            real: vec![0.0; self.periods.fast],
            half: vec![zero; self.periods.half()],
            row: vec![zero; self.periods.slow],
            plane: vec![zero; self.periods.half() * self.slow_cells],
            scratch: vec![zero; scratch],
            moments: Array2::zeros((slow, fast)),
            along: Array2::zeros((TOGETHER * self.slow_cells, fast)),
            dense: Array2::zeros((TOGETHER * self.slow_cells, self.fast_cells)),
            even: rows(self.even.nrows()),
            odd: rows(self.odd.nrows()),
            real_waves: rows(self.small()),
            imaginary_waves: rows(self.small()),
        }
    }

    /// Transforms up to six fields on the cells, one after the other, to rows of waves, which are `stride`
    /// numbers apart.
    pub(crate) fn to_waves(
        &self,
        fields: &[f64],
        to: &mut [Complex64],
        stride: usize,
        b: &mut Buffers,
    ) {
        let cells = self.slow_cells * self.fast_cells;
        b.even.fill(0.0);
        b.odd.fill(0.0);
        let rows = fields.len() / self.fast_cells;
        if let Ok(view) = ArrayView2::from_shape((rows, self.fast_cells), fields) {
            let mut along = b.along.slice_axis_mut(Axis(0), Slice::from(..rows));
            general_mat_mul(1.0, &view, &self.fast_basis, 0.0, &mut along);
        }
        for (n, (field, to)) in fields
            .chunks_exact(cells)
            .zip(to.chunks_exact_mut(stride))
            .enumerate()
        {
            self.transform(field, to, b);
            let along = b.along.slice_axis(
                Axis(0),
                Slice::from(n * self.slow_cells..(n + 1) * self.slow_cells),
            );
            general_mat_mul(1.0, &self.slow_basis.t(), &along, 0.0, &mut b.moments);
            let (mut even, mut odd) = (0, 0);
            for ((p, q), &moment) in b.moments.indexed_iter() {
                if (p + q) % 2 == 0 {
                    b.even[[n, even]] = moment;
                    even += 1;
                } else {
                    b.odd[[n, odd]] = moment;
                    odd += 1;
                }
            }
        }
        general_mat_mul(1.0, &b.even, &self.even, 0.0, &mut b.real_waves);
        general_mat_mul(1.0, &b.odd, &self.odd, 0.0, &mut b.imaginary_waves);
        let from = self.periods.len();
        for (n, to) in to.chunks_exact_mut(stride).enumerate() {
            for (i, to) in to[from..from + self.small()].iter_mut().enumerate() {
                *to = Complex64::new(b.real_waves[[n, i]], b.imaginary_waves[[n, i]]);
            }
            to[from + self.small()..].fill(Complex64::default());
        }
    }

    /// Transforms a field on the cells to its waves.
    fn transform(&self, field: &[f64], to: &mut [Complex64], b: &mut Buffers) {
        let (half, slow) = (self.periods.half(), self.periods.slow);
        for (i, values) in field.chunks_exact(self.fast_cells).enumerate() {
            b.real[..self.fast_cells].copy_from_slice(values);
            b.real[self.fast_cells..].fill(0.0);
            let done = self
                .forward
                .process_with_scratch(&mut b.real, &mut b.half, &mut b.scratch);
            debug_assert!(done.is_ok(), "lengths agree with the plan");
            if slow == 1 {
                to[..half].copy_from_slice(&b.half);
                return;
            }
            for (m, value) in b.half.iter().enumerate() {
                b.plane[m * self.slow_cells + i] = *value;
            }
        }
        for m in 0..half {
            let row = &mut to[m * slow..(m + 1) * slow];
            let values = &b.plane[m * self.slow_cells..(m + 1) * self.slow_cells];
            row[..self.slow_cells].copy_from_slice(values);
            row[self.slow_cells..].fill(Complex64::default());
            self.slow_forward.process_with_scratch(row, &mut b.scratch);
        }
    }

    /// Up to six rows of answers to fields on the cells: `wave` gives the wave of a field by its
    /// position.
    pub(crate) fn to_fields(
        &self,
        wave: impl Fn(usize, usize) -> Complex64,
        fields: &mut [f64],
        b: &mut Buffers,
    ) {
        let cells = self.slow_cells * self.fast_cells;
        let from = self.periods.len();
        for (n, field) in fields.chunks_exact_mut(cells).enumerate() {
            self.transform_back(|at| wave(n, at), field, b);
            for i in 0..self.small() {
                let value = wave(n, from + i);
                b.real_waves[[n, i]] = value.re;
                b.imaginary_waves[[n, i]] = value.im;
            }
        }
        general_mat_mul(1.0, &b.real_waves, &self.even.t(), 0.0, &mut b.even);
        general_mat_mul(1.0, &b.imaginary_waves, &self.odd.t(), 0.0, &mut b.odd);
        for n in 0..fields.len() / cells {
            let (mut even, mut odd) = (0, 0);
            for ((p, q), moment) in b.moments.indexed_iter_mut() {
                if (p + q) % 2 == 0 {
                    *moment = b.even[[n, even]];
                    even += 1;
                } else {
                    *moment = b.odd[[n, odd]];
                    odd += 1;
                }
            }
            let part = Slice::from(n * self.slow_cells..(n + 1) * self.slow_cells);
            let mut along = b.along.slice_axis_mut(Axis(0), part);
            general_mat_mul(1.0, &self.slow_basis, &b.moments, 0.0, &mut along);
        }
        let rows = fields.len() / self.fast_cells;
        let along = b.along.slice_axis(Axis(0), Slice::from(..rows));
        let mut dense = b.dense.slice_axis_mut(Axis(0), Slice::from(..rows));
        general_mat_mul(1.0, &along, &self.fast_basis.t(), 0.0, &mut dense);
        if let Ok(mut view) = ArrayViewMut2::from_shape((rows, self.fast_cells), fields) {
            view += &dense;
        }
    }

    /// Transforms waves (`wave` returns the amplitude of one) back to a field on the cells.
    fn transform_back(
        &self,
        wave: impl Fn(usize) -> Complex64,
        field: &mut [f64],
        b: &mut Buffers,
    ) {
        let (half, slow) = (self.periods.half(), self.periods.slow);
        for m in 0..half {
            if slow == 1 {
                b.plane[m] = wave(m);
                continue;
            }
            for (n, to) in b.row.iter_mut().enumerate() {
                *to = wave(m * slow + n);
            }
            self.slow_backward
                .process_with_scratch(&mut b.row, &mut b.scratch);
            let to = &mut b.plane[m * self.slow_cells..(m + 1) * self.slow_cells];
            to.copy_from_slice(&b.row[..self.slow_cells]);
        }
        for (i, values) in field.chunks_exact_mut(self.fast_cells).enumerate() {
            for (m, to) in b.half.iter_mut().enumerate() {
                *to = b.plane[m * self.slow_cells + i];
            }
            // The real part of the two waves that are their own opposites.
            b.half[0].im = 0.0;
            if self.periods.fast.is_multiple_of(2) {
                b.half[half - 1].im = 0.0;
            }
            let done = self
                .backward
                .process_with_scratch(&mut b.half, &mut b.real, &mut b.scratch);
            debug_assert!(done.is_ok(), "lengths agree with the plan");
            values.copy_from_slice(&b.real[..self.fast_cells]);
        }
    }
}

/// Coordinates of cell centres from the middle, in cells.
fn centred(cells: usize) -> impl Iterator<Item = f64> {
    (0..cells).map(move |i| i as f64 - 0.5 * (cells as f64 - 1.0))
}

/// Orthonormal polynomials on the cells that resolve waves up to `phase` \[rad\] a cell.
fn polynomials(cells: usize, phase: f64) -> Array2<f64> {
    let wanted = (0.5 * phase * cells as f64).ceil() as usize + POLYNOMIALS;
    let n = wanted.min(cells);
    let mut basis = Array2::zeros((cells, n));
    let half = 0.5 * cells as f64;
    for p in 0..n {
        // x times the last one, made orthogonal twice.
        let mut column: Array1<f64> = if p == 0 {
            Array1::ones(cells)
        } else {
            let x = centred(cells).map(|x| x / half);
            x.zip(basis.column(p - 1)).map(|(x, b)| x * b).collect()
        };
        for _ in 0..2 {
            for q in (p % 2..p).step_by(2) {
                let other = basis.column(q);
                let part = column.dot(&other);
                column.scaled_add(-part, &other);
            }
        }
        let size = column.dot(&column).sqrt();
        basis.column_mut(p).assign(&(column / size));
    }
    basis
}

/// exp(-i phase x) in the polynomials, (polynomials, waves): real parts of the even ones, minus the
/// imaginary ones of the odd.
fn in_basis(basis: &Array2<f64>, phases: &[f64]) -> Array2<f64> {
    let (cells, n) = basis.dim();
    let waves = |of: fn(f64) -> f64| {
        let mut waves = Array2::zeros((cells, phases.len()));
        for (i, x) in centred(cells).enumerate() {
            for (j, phase) in phases.iter().enumerate() {
                waves[[i, j]] = of(phase * x);
            }
        }
        waves
    };
    let (cos, sin) = (
        basis.t().dot(&waves(f64::cos)),
        basis.t().dot(&waves(f64::sin)),
    );
    let mut all = cos;
    for p in (1..n).step_by(2) {
        all.row_mut(p).assign(&sin.row(p));
    }
    all
}

/// Products of the waves of both sides: the ones with real, and the ones with imaginary factors.
fn products(slow: &Array2<f64>, fast: &Array2<f64>, waves: usize) -> (Array2<f64>, Array2<f64>) {
    let pairs = || (0..slow.nrows()).flat_map(|p| (0..fast.nrows()).map(move |q| (p, q)));
    let table = |parity: usize| {
        let of = pairs().filter(|(p, q)| (p + q) % 2 == parity);
        let mut table = Array2::zeros((of.clone().count(), waves));
        for (row, (p, q)) in of.enumerate() {
            // (-i)^2 = -1 of two odd ones, -i of one.
            let sign = if parity == 0 && p % 2 == 0 { 1.0 } else { -1.0 };
            let product = &slow.row(p) * &fast.row(q);
            table.row_mut(row).assign(&(product * sign));
        }
        table
    };
    (table(0), table(1))
}
