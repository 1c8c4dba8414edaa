//! Surface coefficients of any body, exact to rounding.
//!
//! The response is that of a half-space of the outermost material, known in closed form, plus a
//! remainder that decays like exp(-2 k h) and is smooth: its radial functions are tabulated once
//! and integrated over each cell by Gauss rules, with parts of the cell where the layer is thin
//! against it.

use ndarray::Array2;
use rayon::prelude::*;

use super::InfluenceCoefficients;
use super::cell::Cell;
use super::half_space::{Radial, Six, add_kernel, over_cell, radial};
use super::layered_frf::{HalfSpace, Stack};
use super::radial_table::{Hankel, RadialTable};
use crate::error::Error;
use crate::scene::Grid;

/// Relative error that a cell's Gauss rule may leave, against C33(0,0).
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
}

/// The coefficients of a stack on a grid, and an estimate of their error over C33(0,0).
pub(crate) fn surface_coefficients(stack: &Stack, grid: &Grid) -> (InfluenceCoefficients, f64) {
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
        estimate = hankel.error(&table, r_max);
        Remainder { table, zeta }
    });
    let kernel = SurfaceKernel {
        outermost: stack.outermost(),
        remainder,
        grid,
    };
    let coefficients = kernel.fill();
    // An error e/r of the kernel adds e times the integral of 1/r over the cell.
    let one = HalfSpace {
        a: 2.0 * std::f64::consts::PI,
        b: 0.0,
        c: 0.0,
        nu: 0.0,
    };
    let origin = kernel.cell(0, 0);
    let self_zz = coefficients.zz[(0, 0)];
    let estimate = if self_zz > 0.0 {
        estimate * over_cell(&one, &origin)[2] / self_zz + CUBATURE
    } else {
        0.0
    };
    (coefficients, estimate)
}

impl SurfaceKernel<'_> {
    fn cell(&self, i: usize, j: usize) -> Cell {
        let Grid { dx, dy, .. } = *self.grid;
        Cell {
            x: i as f64 * dx,
            y: j as f64 * dy,
            half_x: dx / 2.0,
            half_y: dy / 2.0,
        }
    }

    /// The coefficients at one offset.
    fn at(&self, i: usize, j: usize) -> Six {
        let cell = self.cell(i, j);
        // The kernel falls off like 1/r, and so does what its integral may err.
        let cells_away = cell.x.hypot(cell.y) / (2.0 * cell.half_x.max(cell.half_y));
        let tolerance = CUBATURE * cells_away.max(1.0);
        let mut sum = [0.0; 6];
        if let Some(orders) = cell.orders(0.0, tolerance) {
            cell.nodes(orders, |x, y, w| {
                let s = x * x + y * y;
                let mut g = radial(&self.outermost, s);
                if let Some(remainder) = &self.remainder {
                    add(&mut g, remainder.table.at(s));
                }
                add_kernel(&mut sum, x, y, w, g);
            });
            return sum;
        }
        if let Some(Remainder { table, zeta }) = &self.remainder {
            cell.nodes_of_parts(*zeta, tolerance, &mut |x, y, w| {
                add_kernel(&mut sum, x, y, w, table.at(x * x + y * y));
            });
        }
        let closed = over_cell(&self.outermost, &cell);
        std::array::from_fn(|n| sum[n] + closed[n])
    }

    /// All offsets >= 0; where cells are square, one octant is computed and mirrored.
    fn fill(&self) -> InfluenceCoefficients {
        let Grid { nx, ny, dx, dy, .. } = *self.grid;
        let square = if dx.to_bits() == dy.to_bits() {
            nx.min(ny)
        } else {
            0
        };
        let mirrored = |i: usize, j: usize| i < j && j < square;
        let empty = || Array2::<f64>::zeros((nx, ny));
        let mut c: [Array2<f64>; 6] = std::array::from_fn(|_| empty());
        let [xx, yy, zz, xy, xz, yz] = c.each_mut().map(|c| {
            c.as_slice_mut()
                .expect("standard layout")
                .par_chunks_mut(ny)
        });
        (xx, yy, zz, xy, xz, yz)
            .into_par_iter()
            .enumerate()
            .for_each(|(i, (xx, yy, zz, xy, xz, yz))| {
                for j in (0..ny).filter(|j| !mirrored(i, *j)) {
                    [xx[j], yy[j], zz[j], xy[j], xz[j], yz[j]] = self.at(i, j);
                }
                // What is odd vanishes on its axis.
                if i == 0 {
                    xy.fill(0.0);
                    xz.fill(0.0);
                }
                (xy[0], yz[0]) = (0.0, 0.0);
            });
        let [mut xx, mut yy, mut zz, mut xy, mut xz, mut yz] = c;
        for j in 0..square {
            for i in 0..j {
                let (here, there) = ((i, j), (j, i));
                (xx[here], yy[here]) = (yy[there], xx[there]);
                (zz[here], xy[here]) = (zz[there], xy[there]);
                (xz[here], yz[here]) = (yz[there], xz[there]);
            }
        }
        InfluenceCoefficients {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        }
    }
}

fn add(g: &mut Radial, other: Radial) {
    for (g, o) in g.iter_mut().zip(other) {
        *g += o;
    }
}

/// Fails if the estimated error is more than the tolerance asked for.
pub(crate) fn check(estimate: f64, tolerance: f64) -> Result<(), Error> {
    if estimate <= tolerance {
        return Ok(());
    }
    Err(Error::KernelInaccurate {
        estimate,
        tolerance,
    })
}
