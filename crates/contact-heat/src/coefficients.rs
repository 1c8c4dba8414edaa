//! Influence coefficients: the surface temperature that unit flux on one cell causes.
//!
//! A point source on a half-space answers with exp(-l r)/(2 pi K r), l = sqrt(i w C/K) (Carslaw and
//! Jaeger 1959, chapter X). That is the divergence of (1 - exp(-l r))/(l r) along the radius, so
//! that its integral over a cell is the flux of this field through the four sides: exact for cells
//! small or large against 1/|l|, and of the steady state the closed form of Boussinesq's
//! displacement. The remainder of a stack of layers is smooth, and tabulated like the elastic one.

use std::f64::consts::PI;

use contact_core::Error;
use contact_core::kernels::{Cell, Complex64, Hankel, RadialTable};
use contact_core::memory::fits;
use contact_core::scene::Grid;
use ndarray::Array2;
use quadrature::gauss;
use rayon::prelude::*;

use super::conductor::Layers;
use super::response::{lowest_scale, one_minus_exp, plane_decay_squared, remainder};

/// Relative error that a cell's Gauss rule may leave.
const CUBATURE: f64 = 1e-13;
/// Largest error of the smooth part over the coefficient of the loaded cell.
const TOLERANCE: f64 = 1e-9;
/// Gauss nodes on a side within [`NEAR_DISTANCE`] half lengths of the source: (1 + sqrt 2)^-40 is rounding.
const NODES_NEAR: usize = 20;
/// Tolerance of cells farther away: (2 NEAR_DISTANCE)^-12.
const NODES_FAR: usize = 6;
/// Distance over half the length of a side.
const NEAR_DISTANCE: f64 = 8.0;
/// Memory per cell while coefficients are made: real and imaginary parts of sides and cells
/// \[bytes\].
const NUMBERS: f64 = 64.0;

/// Temperature of a cell under unit flux on another at the angular frequency w \[1/s\], on the offsets >= 0
/// \[m^2 K/W\], shape (nx, ny).
pub(super) fn coefficients(body: &Layers, grid: &Grid, w: f64) -> Result<Array2<Complex64>, Error> {
    fits(
        "the temperature coefficients",
        NUMBERS * grid.cells() as f64,
    )?;
    let mut coefficients = half_space(body, grid, w);
    let Some((_, h)) = body.coatings.first() else {
        return Ok(coefficients);
    };
    let zeta = 2.0 * h;
    let r_max = (grid.nx as f64 * grid.dx).hypot(grid.ny as f64 * grid.dy);
    let hankel = Hankel {
        amplitude: &|k| {
            let rest = k * remainder(body, k, w);
            [rest.re, rest.im]
        },
        orders: [0, 0],
        zeta,
        k_low: lowest_scale(body, w),
    };
    let table = hankel.tabulate(r_max);
    // An error e/r of the kernel adds at most e times the integral of 1/r over a cell.
    let reach = cell_integral_of_1_over_r(grid);
    let estimate = hankel.max_deviation(&table, r_max) * reach / coefficients[(0, 0)].norm();
    if !(estimate <= TOLERANCE) {
        return Err(Error::TemperatureInaccurate {
            estimate,
            tolerance: TOLERANCE,
        });
    }
    let nx_ny = coefficients.dim();
    let rest: Vec<Complex64> = (0..grid.cells())
        .into_par_iter()
        .map(|n| over_cell(&table, grid, (n / nx_ny.1, n % nx_ny.1), zeta))
        .collect();
    coefficients += &Array2::from_shape_vec(nx_ny, rest).expect("a number for each cell");
    Ok(coefficients)
}

/// The tabulated part of the response, integrated over the cell at an offset.
fn over_cell(table: &RadialTable<2>, grid: &Grid, (i, j): (usize, usize), zeta: f64) -> Complex64 {
    let cell = Cell {
        x: i as f64 * grid.dx,
        y: j as f64 * grid.dy,
        half_x: grid.dx / 2.0,
        half_y: grid.dy / 2.0,
    };
    let mut sum = Complex64::ZERO;
    cell.nodes_of_parts(zeta, CUBATURE, &mut |x, y, weight| {
        let [re, im] = table.evaluate(x * x + y * y);
        sum += weight * Complex64::new(re, im);
    });
    sum
}

/// The coefficients of the half-space of the outermost material.
fn half_space(body: &Layers, grid: &Grid, w: f64) -> Array2<Complex64> {
    let material = body.outermost();
    let l = plane_decay_squared(material, w).sqrt();
    let Grid { nx, ny, dx, dy, .. } = *grid;
    let scale = 1.0 / (2.0 * PI * material.conductivity);
    // Through the side at +dx/2 of column i, along y; through that at +dy/2 of row j, along x.
    let along_y = sides((nx, ny), (dx, dy), l);
    let along_x = sides((ny, nx), (dy, dx), l);
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        let before = |of: &Array2<Complex64>, n: usize, m: usize| {
            if n == 0 { -of[(0, m)] } else { of[(n - 1, m)] }
        };
        let through_x = along_y[(i, j)] - before(&along_y, i, j);
        let through_y = along_x[(j, i)] - before(&along_x, j, i);
        scale * (through_x + through_y)
    })
}

/// The flux through sides of length `d.1` at the distances (n + 1/2) `d.0`, around m `d.1`.
fn sides((n, m): (usize, usize), d: (f64, f64), l: Complex64) -> Array2<Complex64> {
    let fluxes: Vec<Complex64> = (0..n * m)
        .into_par_iter()
        .map(|at| {
            let distance = ((at / m) as f64 + 0.5) * d.0;
            side(distance, (at % m) as f64 * d.1, d.1, l)
        })
        .collect();
    Array2::from_shape_vec((n, m), fluxes).expect("a number for each side")
}

/// The flux of (1 - exp(-l r))/(l r) along the radius through one side, at `distance` from the
/// source, around `middle`.
fn side(distance: f64, middle: f64, length: f64, l: Complex64) -> Complex64 {
    // Parts no longer than twice their distance.
    let parts = (length / (2.0 * distance)).ceil().max(1.0);
    let half = length / parts / 2.0;
    let mut sum = Complex64::ZERO;
    for part in 0..parts as usize {
        let centre = middle - length / 2.0 + (2 * part + 1) as f64 * half;
        let far = distance.hypot((centre.abs() - half).max(0.0)) > NEAR_DISTANCE * half;
        for (t, weight) in gauss(if far { NODES_FAR } else { NODES_NEAR }) {
            let r = distance.hypot(centre + t * half);
            sum += weight * half * distance / r * mean_decay(l * r);
        }
    }
    sum
}

/// (1 - exp(-z))/z.
fn mean_decay(z: Complex64) -> Complex64 {
    if z == Complex64::ZERO {
        return Complex64::ONE;
    }
    one_minus_exp(z) / z
}

/// The integral of 1/r over the cell around the source \[m\].
fn cell_integral_of_1_over_r(grid: &Grid) -> f64 {
    let (dx, dy) = (grid.dx, grid.dy);
    2.0 * (dx * (dy / dx).asinh() + dy * (dx / dy).asinh())
}

#[cfg(test)]
mod tests {
    use super::super::conductor::Conductor;
    use super::*;
    use contact_core::kernels::influence_coefficients;
    use contact_core::scene::Elastic;
    use contact_core::scene::{Body, KernelSettings, Shape};

    const STEEL: Conductor = Conductor {
        conductivity: 50.0,
        heat_capacity: 3.6e6,
    };

    fn homogeneous(grid: &Grid, w: f64) -> Array2<Complex64> {
        let body = Layers::homogeneous(STEEL).unwrap();
        coefficients(&body, grid, w).unwrap()
    }

    /// Heat spreads as Boussinesq's displacement does: 1/K in the place of (1 - nu)/G.
    #[test]
    fn steady_ones_are_those_of_boussinesq() {
        for (n, d) in [((40, 24), (1e-5, 1e-5)), ((16, 9), (1e-5, 2.3e-4))] {
            let grid = Grid::from_spacing(n, d).unwrap();
            let elastic = Elastic::new(2.0, 0.0).unwrap();
            let body = Body::homogeneous(elastic, Shape::Flat);
            let twin = influence_coefficients(&body, &grid, &KernelSettings::default(), true, None)
                .unwrap();
            let ours = homogeneous(&grid, 0.0);
            // E = 2 and nu = 0 make G = 1.
            for (ours, twin) in ours.iter().zip(&twin.zz) {
                let error = (ours * STEEL.conductivity - twin).norm() / twin.abs();
                assert!(error < 1e-11, "{error:.1e}");
            }
        }
    }

    /// A fast cycle heats a cell as if it were infinite, q/(K l), and no other: the temperature of
    /// the next one is of the order exp(-200).
    #[test]
    fn fast_ones_stay_within_the_cell() {
        let grid = Grid::from_spacing((4, 4), (1e-3, 1e-3)).unwrap();
        let w = 1e7;
        let c = homogeneous(&grid, w);
        let l = plane_decay_squared(STEEL, w).sqrt();
        let endless = (STEEL.conductivity * l).inv();
        assert!((c[(0, 0)] / endless - 1.0).norm() < 1e-12);
        assert!((c[(1, 0)] / endless).norm() < 1e-12);
    }
}
