//! Stress at the rim of the contact on the surface, where sliding pulls most.
//!
//! Towards the rim pressure and shear vanish like the square root of the distance d, and the surface
//! stress has a cusp: samples fall short of its top by the square root of the cell. Inside
//!
//! ```text
//! s = c_0 + c_1 sqrt(d) + c_2 d + ...,   p^2 = b_1 d + b_2 d^2 + ...
//! ```
//!
//! so that the samples at some distance give the rim's place and c_0, the stress there.

use ndarray::{Array3, ArrayView2, Axis};

use super::Depth;
use super::maximum::{Maximum, Top, maximum_of_tops, maximum_on_interfaces, top_of_line};
use super::measure::Measure;
use fatigue::StressTensor;

/// Share of the largest pressure below which a cell carries none.
const NOTHING: f64 = 1e-9;
/// Samples of the stress, by their distance from the rim in cells and in half-lengths of the contact
/// on the line: nearer ones suffer from the cells, farther ones from the terms left out.
const NEAREST: (f64, f64) = (2.5, 0.03);
const FARTHEST: (f64, f64) = (8.0, 0.12);
/// The same of the samples of p^2, from the first cell in contact.
const PRESSURE: (f64, f64) = (8.0, 0.08);
/// Fewest cells of the contact on the line.
const FEWEST: usize = 24;
/// Largest root mean square that the samples of a component may leave, over the largest pressure.
/// A larger one means another singularity nearby, such as the border of a narrow slip zone.
const LEFT: f64 = 5e-3;
/// Largest pressure or shear that may be left at the rim, where both vanish, over the largest pressure: the
/// other components are off by as much. At 0.05 that is what samples on 20 cells of a half-length miss; stick
/// zones that end within the samples leave 0.1 to 0.7.
const OFF: f64 = 0.05;
/// Components that are tractions on the surface: s_zz, s_xz, s_yz.
const TRACTIONS: [usize; 3] = [2, 4, 5];

/// A rim of the contact on a line on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim {
    /// Place along the line \[m\].
    pub place: f64,
    /// Outermost cell in contact.
    pub cell: usize,
    /// The stress \[Pa\].
    pub stress: StressTensor,
}

/// The outer rims of the contact on a line on the surface, from the stress there, shape (6, places)
/// \[Pa\], at even places \[m\]. Left out are those that the samples do not show well enough.
pub fn rims(stress: &ArrayView2<'_, f64>, along: &[f64]) -> Vec<Rim> {
    let p: Vec<f64> = stress.row(2).iter().map(|s_zz| -s_zz).collect();
    let p_max = p.iter().copied().fold(0.0, f64::max);
    let pressed = |p: &f64| *p > NOTHING * p_max;
    let (Some(first), Some(last)) = (p.iter().position(pressed), p.iter().rposition(pressed))
    else {
        return Vec::new();
    };
    let cells = last - first + 1;
    if cells < FEWEST {
        return Vec::new();
    }
    let half = cells as f64 / 2.0;
    let of = |(in_cells, share): (f64, f64)| f64::max(in_cells, share * half);
    let rim = |cell: usize, inwards: bool| {
        let at = |n: usize| if inwards { cell + n } else { cell - n };
        // Distance of the rim from its outermost cell, inwards and in cells.
        let squares = (2..of(PRESSURE) as usize).map(|n| (n as f64, p[at(n)].powi(2)));
        let ([b_0, b_1, b_2], _) = fit(squares, |d| [1.0, d, d * d])?;
        let offset = -2.0 * b_0 / (b_1 + (b_1 * b_1 - 4.0 * b_0 * b_2).max(0.0).sqrt());
        if offset.is_nan() || offset.abs() > 2.0 {
            return None;
        }
        let distance = |n: usize| n as f64 - offset;
        let mut s = [0.0; 6];
        for (s, component) in s.iter_mut().zip(stress.axis_iter(Axis(0))) {
            let samples = (0..cells / 2)
                .map(|n| (distance(n), component[at(n)]))
                .filter(|(d, _)| (of(NEAREST)..of(FARTHEST)).contains(d));
            let ([c_0, ..], left) = fit(samples, |d| [1.0, d.sqrt(), d])?;
            if left > LEFT * p_max {
                return None;
            }
            *s = c_0;
        }
        if TRACTIONS.iter().any(|&k| s[k].abs() > OFF * p_max) {
            return None;
        }
        let step = along[at(1)] - along[cell];
        Some(Rim {
            place: along[cell] + offset * step,
            cell,
            stress: s,
        })
    };
    [rim(first, true), rim(last, false)]
        .into_iter()
        .flatten()
        .collect()
}

/// Least squares of three functions of d: coefficients, and the root mean square that is left.
fn fit(
    samples: impl Iterator<Item = (f64, f64)> + Clone,
    basis: impl Fn(f64) -> [f64; 3],
) -> Option<([f64; 3], f64)> {
    // Gram-Schmidt on the columns: the functions are nearly dependent.
    let columns: Vec<[f64; 3]> = samples.clone().map(|(d, _)| basis(d)).collect();
    let values: Vec<f64> = samples.map(|(_, value)| value).collect();
    if columns.len() < 4 {
        return None;
    }
    let mut q = columns;
    let mut r = [[0.0; 3]; 3];
    for c in 0..3 {
        for b in 0..c {
            let along: f64 = q.iter().map(|row| row[b] * row[c]).sum();
            r[b][c] = along;
            for row in &mut q {
                row[c] -= along * row[b];
            }
        }
        let size = q.iter().map(|row| row[c] * row[c]).sum::<f64>().sqrt();
        r[c][c] = size;
        for row in &mut q {
            row[c] /= size;
        }
    }
    let mut left = values;
    let mut x = [0.0; 3];
    for c in 0..3 {
        let along: f64 = q.iter().zip(&left).map(|(row, v)| row[c] * v).sum();
        x[c] = along;
        for (v, row) in left.iter_mut().zip(&q) {
            *v -= along * row[c];
        }
    }
    for c in (0..3).rev() {
        let known: f64 = (c + 1..3).map(|b| r[c][b] * x[b]).sum();
        x[c] = (x[c] - known) / r[c][c];
    }
    let mean_square = left.iter().map(|v| v * v).sum::<f64>() / left.len() as f64;
    x.iter()
        .all(|v| v.is_finite())
        .then(|| (x, mean_square.sqrt()))
}

impl Measure {
    /// Its largest value on a line at a depth, from the stress there, shape (6, places) \[Pa\],
    /// between the samples, and on the surface at the rims of the contact.
    pub fn top(&self, stress: &ArrayView2<'_, f64>, along: &[f64], depth: Depth) -> Option<Top<1>> {
        let sampled = top_of_line(&self.on(stress).view(), along);
        if depth.z > 0.0 {
            return sampled;
        }
        let at_rims = rims(stress, along).into_iter().map(|rim| Top {
            value: (self.value)(&rim.stress),
            place: [rim.place],
            sample: [rim.cell],
        });
        at_rims
            .chain(sampled)
            .max_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// Its largest value on a section, from the stress there, shape (6, depths, places) \[Pa\].
    pub fn maximum(
        &self,
        stress: &Array3<f64>,
        depths: &[Depth],
        along: &[f64],
    ) -> Option<Maximum<1>> {
        let lines = stress.axis_iter(Axis(1)).zip(depths);
        let tops: Vec<_> = lines
            .map(|(line, depth)| self.top(&line, along, *depth))
            .collect();
        self.largest(&tops, depths)
    }

    /// Its largest value over depths, from the tops at each: that of the interfaces alone if it lives
    /// there.
    pub fn largest<const D: usize>(
        &self,
        tops: &[Option<Top<D>>],
        depths: &[Depth],
    ) -> Option<Maximum<D>> {
        if self.of_interfaces {
            maximum_on_interfaces(tops, depths)
        } else {
            maximum_of_tops(tops, depths)
        }
    }
}
