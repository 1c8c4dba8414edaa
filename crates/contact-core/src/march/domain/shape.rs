//! Shapes of windows: as many cells as are asked for, in lengths that the operator is fast for.

use ndarray::Array2;

use crate::convolution::fast_length;
use crate::plan::Plan;
use crate::scene::{Grid, Scene};

/// Windows longer than this part of the grid are replaced by the whole grid.
const WHOLE: f64 = 0.9;
/// The least cells along an axis of a window.
const LEAST: usize = 32;

/// The shape of the window to begin with: the whole grid where cells have to be kept everywhere, or where a
/// window does not pay.
pub(super) fn first(scene: &Scene, plan: &Plan) -> (usize, usize) {
    let least = shape_for(&scene.grid, [LEAST, LEAST]);
    if plan.methods.window && pays(scene, least) {
        least
    } else {
        shape_of(&scene.grid)
    }
}

/// Whether a window of this shape saves more than it costs. Between smooth bodies it does: no cell beyond it can
/// come into contact by surprise.
///
/// Between uneven surfaces it need not pay on a short path.
/// Laying it out, and laying out the whole grid for the gap beyond it, take about three convolutions of the
/// whole grid, and as long as five on 128 x 128 cells whatever the grid. An increment takes about six
/// convolutions (balls with 128 to 512 points a side, self-affine and band-limited), of which the window saves
/// the part outside it.
pub(super) fn pays(scene: &Scene, shape: (usize, usize)) -> bool {
    if !scene.is_uneven() {
        return true;
    }
    let Scene { grid, path, .. } = scene;
    let cells = (grid.nx * grid.ny) as f64;
    let share = (shape.0 * shape.1) as f64 / cells;
    let cost = 3.0 + 5.0 * (128.0 * 128.0 / cells);
    6.0 * path.increments().max(1) as f64 * (1.0 - share) > cost
}

/// Cells along x and along y.
pub(super) fn shape_of(grid: &Grid) -> (usize, usize) {
    (grid.nx, grid.ny)
}

/// The shape of a window for so many cells along x and y: the largest window whose transforms take no longer
/// than for the smallest possible one.
pub(super) fn shape_for(grid: &Grid, cells: [usize; 2]) -> (usize, usize) {
    let along = |whole: usize, cells: usize| {
        // A window of an odd grid is odd, too, so that it has the same middle.
        let odd = whole % 2;
        let longest = fast_length(2 * (cells + odd)) / 2;
        let length = longest - (longest + odd) % 2;
        if length as f64 >= WHOLE * whole as f64 {
            whole
        } else {
            length
        }
    };
    (along(grid.nx, cells[0]), along(grid.ny, cells[1]))
}

/// Cells along x and along y from the middle of a grid to the far side of the outermost that
/// touches; the pressure belongs to the kept rows.
pub(in crate::march) fn half_lengths(
    p: &[f64],
    rows: usize,
    (nx, ny): (usize, usize),
) -> [usize; 2] {
    let to = |i: usize, n: usize| (2 * i + 1).abs_diff(n).div_ceil(2);
    let touches = |p: &f64| *p > 0.0;
    let mut half = [0; 2];
    for (i, column) in p.chunks(rows).enumerate() {
        let ends = [
            column.iter().position(touches),
            column.iter().rposition(touches),
        ];
        for j in ends.into_iter().flatten() {
            half[0] = half[0].max(to(i, nx));
            half[1] = half[1].max(to(j + ny - rows, ny));
        }
    }
    half
}

/// The nx x ny entries in the middle of a field.
pub(super) fn middle(field: &Array2<f64>, (nx, ny): (usize, usize)) -> Array2<f64> {
    let (i, j) = ((field.nrows() - nx) / 2, (field.ncols() - ny) / 2);
    Array2::from_shape_fn((nx, ny), |(a, b)| field[(i + a, j + b)])
}

#[cfg(test)]
mod tests {
    use super::{half_lengths, shape_for};
    use crate::scene::Grid;

    #[test]
    fn what_a_window_is_laid_out_for_fits_in_it() {
        for whole in 40..260 {
            let grid = Grid::centred(1.0, whole).unwrap();
            for cells in (10..whole).step_by(2) {
                let (nx, ny) = shape_for(&grid, [cells, cells]);
                let fits = cells <= nx && nx <= whole && (whole - nx) % 2 == 0;
                assert!(fits && nx == ny, "{nx} x {ny} for {cells} of {whole}");
            }
        }
    }

    #[test]
    fn the_outermost_cell_that_touches_counts() {
        // The cell in column 1 and row 1 of the upper three rows.
        for ((nx, ny), far) in [((4, 5), [1, 1]), ((7, 6), [2, 2])] {
            let mut p = vec![0.0; 3 * nx];
            assert_eq!(half_lengths(&p, 3, (nx, ny)), [0, 0]);
            p[4] = 1.0;
            assert_eq!(half_lengths(&p, 3, (nx, ny)), far);
        }
    }
}
