//! Surface coefficients of any body, exact to rounding.
//!
//! The response of a half-space of the outermost material is known in closed form. A
//! remainder that decays like exp(-2 k h) is smooth: its radial functions are tabulated once
//! and integrated over each cell by Gauss rules; where the layer is thin against the cell, over parts
//! of it.

use std::sync::atomic::AtomicBool;

use ndarray::Array2;

use super::InfluenceCoefficients;
use super::cell::Cell;
use super::coefficients::{ODD, empty_quadrant};
use super::half_space::{Radial, Six, add_kernel, integrate_over_cell, radial_functions};
use super::layered_frf::{HalfSpace, Stack};
use super::radial_table::{Hankel, RadialTable};
use super::rows::for_each_row;
use crate::error::Error;
use crate::plan::KernelSet;
use crate::scene::Grid;

/// Relative error of a cell's Gauss rule, against C33(0,0).
const CUBATURE: f64 = 1e-14;

/// The smooth part of a coated body's response.
struct Remainder {
    table: RadialTable<4>,
    /// Its smallest scale, 2 h of the outermost layer \[m\].
    zeta: f64,
}

/// A body's surface kernel on a grid.
struct SurfaceKernel<'a> {
    outermost: HalfSpace,
    remainder: Option<Remainder>,
    grid: &'a Grid,
    set: KernelSet,
}

/// The coefficients of a stack on a grid, for a set, and an estimate of their error over
/// C33(0,0). Fails when `stop` is raised.
pub(crate) fn surface_coefficients(
    stack: &Stack,
    grid: &Grid,
    set: KernelSet,
    stop: &AtomicBool,
) -> Result<(InfluenceCoefficients, f64), Error> {
    let r_max = (grid.nx as f64 * grid.dx).hypot(grid.ny as f64 * grid.dy);
    let mut estimate = 0.0;
    let remainder = stack.layers.first().map(|(_, h)| {
        let zeta = 2.0 * h;
        let hankel = Hankel {
            amplitude: &|k| {
                let d = stack.remainder(k);
                [d.zz, f64::midpoint(d.rr, d.tt), (d.rr - d.tt) / 2.0, d.rz]
            },
            orders: [0, 0, 2, 1],
            zeta,
            k_low: stack.lowest_scale(),
        };
        let table = hankel.tabulate(r_max);
        estimate = hankel.max_deviation(&table, r_max);
        Remainder { table, zeta }
    });
    let kernel = SurfaceKernel {
        outermost: stack.outermost(),
        remainder,
        grid,
        set,
    };
    let coefficients = kernel.compute_all_offsets(stop)?;
    // An error e/r of the kernel adds e times the integral of 1/r over the cell.
    let unit_material = HalfSpace {
        a: 2.0 * std::f64::consts::PI,
        b: 0.0,
        c: 0.0,
        nu: 0.0,
    };
    let origin = kernel.cell(0, 0);
    let self_zz = coefficients.zz[(0, 0)];
    let estimate = if self_zz > 0.0 {
        estimate * integrate_over_cell(&unit_material, &origin, KernelSet::Normal)[2] / self_zz
            + CUBATURE
    } else {
        0.0
    };
    Ok((coefficients, estimate))
}

impl SurfaceKernel<'_> {
    /// The loaded cell at the offset of i and j cells from the point.
    fn cell(&self, i: usize, j: usize) -> Cell {
        let Grid { dx, dy, .. } = *self.grid;
        Cell {
            x: i as f64 * dx,
            y: j as f64 * dy,
            half_x: dx / 2.0,
            half_y: dy / 2.0,
        }
    }

    /// The coefficients at one offset; entries outside the set are arbitrary.
    fn coefficients_at(&self, i: usize, j: usize) -> Six {
        let cell = self.cell(i, j);
        // The kernel falls off like 1/r, and so does the allowed error of its integral.
        let cells_away = cell.x.hypot(cell.y) / (2.0 * cell.half_x.max(cell.half_y));
        let tolerance = CUBATURE * cells_away.max(1.0);
        let mut sum = [0.0; 6];
        if let Some(orders) = cell.orders(0.0, tolerance) {
            let functions = |s: f64| {
                let mut g = radial_functions(&self.outermost, s);
                if let Some(remainder) = &self.remainder {
                    add_functions(&mut g, remainder.table.evaluate(s));
                }
                g
            };
            if self.set == KernelSet::Normal {
                cell.nodes(orders, |x, y, w| sum[2] += w * functions(x * x + y * y)[0]);
            } else {
                cell.nodes(orders, |x, y, w| {
                    add_kernel(&mut sum, x, y, w, functions(x * x + y * y));
                });
            }
            return sum;
        }
        if let Some(Remainder { table, zeta }) = &self.remainder {
            cell.nodes_of_parts(*zeta, tolerance, &mut |x, y, w| {
                add_kernel(&mut sum, x, y, w, table.evaluate(x * x + y * y));
            });
        }
        let closed_form = integrate_over_cell(&self.outermost, &cell, self.set);
        std::array::from_fn(|n| sum[n] + closed_form[n])
    }

    /// Flags of the six coefficients that are in the set.
    fn in_set(&self) -> [bool; 6] {
        let (shear, coupling) = (self.set != KernelSet::Normal, self.set == KernelSet::All);
        [shear, shear, true, shear, coupling, coupling]
    }

    /// Computes all offsets >= 0; for square cells one octant is computed and mirrored.
    fn compute_all_offsets(&self, stop: &AtomicBool) -> Result<InfluenceCoefficients, Error> {
        let Grid { nx, ny, dx, dy, .. } = *self.grid;
        let square = if dx.to_bits() == dy.to_bits() {
            nx.min(ny)
        } else {
            0
        };
        let is_mirrored = |i: usize, j: usize| i < j && j < square;
        let mut c = self.in_set().map(|is_wanted| {
            if is_wanted {
                Array2::<f64>::zeros((nx, ny))
            } else {
                empty_quadrant()
            }
        });
        let mut rows: Vec<[&mut [f64]; 6]> = (0..nx).map(|_| Default::default()).collect();
        for (n, c) in c.iter_mut().enumerate() {
            let c = c.as_slice_mut().expect("standard layout");
            for (row, c) in rows.iter_mut().zip(c.chunks_mut(ny)) {
                row[n] = c;
            }
        }
        for_each_row(&mut rows, stop, |i, row| {
            for j in (0..ny).filter(|j| !is_mirrored(i, *j)) {
                for ((c, value), odd) in row.iter_mut().zip(self.coefficients_at(i, j)).zip(ODD) {
                    if let Some(c) = c.get_mut(j) {
                        // Odd kernels vanish on their axis.
                        let vanishes = (odd.0 && i == 0) || (odd.1 && j == 0);
                        *c = if vanishes { 0.0 } else { value };
                    }
                }
            }
        })?;
        drop(rows);
        let [mut xx, mut yy, mut zz, mut xy, mut xz, mut yz] = c;
        for (i, j) in (0..square).flat_map(|i| (i + 1..square).map(move |j| (i, j))) {
            let (above_diagonal, below_diagonal) = ((i, j), (j, i));
            zz[above_diagonal] = zz[below_diagonal];
            if !xx.is_empty() {
                (xx[above_diagonal], yy[above_diagonal]) = (yy[below_diagonal], xx[below_diagonal]);
                xy[above_diagonal] = xy[below_diagonal];
            }
            if !xz.is_empty() {
                (xz[above_diagonal], yz[above_diagonal]) = (yz[below_diagonal], xz[below_diagonal]);
            }
        }
        Ok(InfluenceCoefficients {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        })
    }
}

/// Adds radial functions to others.
fn add_functions(g: &mut Radial, addend: Radial) {
    for (g, o) in g.iter_mut().zip(addend) {
        *g += o;
    }
}

/// Fails if the estimated error is larger than the tolerance.
pub(crate) fn check_estimate(estimate: f64, tolerance: f64) -> Result<(), Error> {
    if estimate <= tolerance {
        return Ok(());
    }
    Err(Error::KernelInaccurate {
        estimate,
        tolerance,
    })
}
