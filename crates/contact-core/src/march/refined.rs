//! Tractions on finer cells, for what lies right below the rim of the contact.
//!
//! Constant tractions cannot follow the root with which pressure and shear vanish there. The level
//! p^2 and the ratio q/p can be interpolated: between the middles of the cells they are taken
//! bilinear, at the border of the contact as `partial_cells` continues them from inside.

use ndarray::Array2;

use super::partial_cells::Lattice;
use crate::convolution::Mirror;
use crate::error::Error;
use crate::scene::Grid;

/// Tractions on finer cells over the same place.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The finer cells; every middle of a coarse one is the middle of one of them.
    pub grid: Grid,
    /// Pressure \[Pa\], shape (nx, ny) of the finer grid; its sum is the load of the coarse one.
    pub p: Array2<f64>,
    /// Shear \[Pa\], as large a part of the pressure as it was.
    pub q: [Array2<f64>; 2],
}

/// The tractions p and q_x, q_y \[Pa\] of `grid`, shape (nx, ny), on cells an odd `factor` finer along
/// each side (along x alone in plane strain).
///
/// # Errors
///
/// Where the factor is even or the finer grid has too many cells.
pub fn refined(
    grid: &Grid,
    factor: usize,
    p: &Array2<f64>,
    q: [&Array2<f64>; 2],
) -> Result<Refined, Error> {
    if factor.is_multiple_of(2) {
        return Err(Error::invalid("factor", factor, "odd: 1, 3, 5, ..."));
    }
    let along_y = if grid.plane_strain { 1 } else { factor };
    let fine = Grid {
        nx: grid.nx.saturating_mul(factor),
        ny: grid.ny.saturating_mul(along_y),
        dx: grid.dx / factor as f64,
        dy: grid.dy / along_y as f64,
        plane_strain: grid.plane_strain,
    };
    fine.check()?;
    let level = level(p, grid);
    let ratios = q.map(|q| ratio(q, p));
    let column: Vec<_> = (0..fine.nx).map(|i| between(i, factor, grid.nx)).collect();
    let row: Vec<_> = (0..fine.ny).map(|j| between(j, along_y, grid.ny)).collect();
    let bilinear = |field: &Array2<f64>, (i, j): (usize, usize)| {
        let ((i, i_next, s), (j, j_next, t)) = (column[i], row[j]);
        let along_x = |j| (1.0 - s) * field[(i, j)] + s * field[(i_next, j)];
        (1.0 - t) * along_x(j) + t * along_x(j_next)
    };
    let shape = (fine.nx, fine.ny);
    let mut finer = Array2::from_shape_fn(shape, |at| bilinear(&level, at).max(0.0).sqrt());
    let (load, carried) = (p.sum() * grid.cell_area(), finer.sum() * fine.cell_area());
    if carried > 0.0 {
        finer *= load / carried;
    }
    let q = ratios.map(|ratio| Array2::from_shape_fn(shape, |at| finer[at] * bilinear(&ratio, at)));
    Ok(Refined {
        grid: fine,
        p: finer,
        q,
    })
}

/// p^2 \[Pa^2\], below zero in cells beside the contact.
fn level(p: &Array2<f64>, grid: &Grid) -> Array2<f64> {
    let contact: Vec<bool> = p.iter().map(|&p| p > 0.0).collect();
    let values: Vec<f64> = p.iter().copied().collect();
    let mut level = p.mapv(|p| p.max(0.0).powi(2));
    let edges = Lattice::new(grid, Mirror::None).edges(&contact, |_, _| [0.5; 2], |n, _| values[n]);
    for (n, edge) in edges {
        if let Some(continued) = edge.level() {
            level[(n / grid.ny, n % grid.ny)] = if contact[n] {
                continued.max(0.0)
            } else {
                continued.min(0.0)
            };
        }
    }
    level
}

/// q/p, in cells beside the contact the mean of their neighbours' within.
fn ratio(q: &Array2<f64>, p: &Array2<f64>) -> Array2<f64> {
    let (nx, ny) = p.dim();
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        if p[(i, j)] > 0.0 {
            return q[(i, j)] / p[(i, j)];
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for i in i.saturating_sub(1)..(i + 2).min(nx) {
            for j in j.saturating_sub(1)..(j + 2).min(ny) {
                if p[(i, j)] > 0.0 {
                    sum += q[(i, j)] / p[(i, j)];
                    count += 1.0;
                }
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    })
}

/// The two of `count` coarse cells between whose middles that of a fine one lies, and how far on.
fn between(fine: usize, factor: usize, count: usize) -> (usize, usize, f64) {
    let place = (fine as f64 + 0.5) / factor as f64 - 0.5;
    let place = place.clamp(0.0, (count - 1) as f64);
    let first = place as usize;
    (first, (first + 1).min(count - 1), place - first as f64)
}
