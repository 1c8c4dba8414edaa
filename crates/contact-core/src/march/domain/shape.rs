//! Shapes of windows: as many cells as are asked for, in lengths that the operator is fast for.

use crate::convolution::fast_length;
use crate::plan::Plan;
use crate::scene::{Grid, Scene};

/// Windows longer than this part of the grid are replaced by the whole grid.
const WHOLE: f64 = 0.9;
/// The least cells along an axis of a window.
const LEAST: usize = 32;

/// The shape of the window to begin with: the whole grid where cells have to be kept everywhere.
pub(super) fn first(scene: &Scene, plan: &Plan) -> (usize, usize) {
    if plan.methods.window {
        shape_for(&scene.grid, [LEAST, LEAST])
    } else {
        shape_of(&scene.grid)
    }
}

/// Cells along x and along y.
pub(super) fn shape_of(grid: &Grid) -> (usize, usize) {
    (grid.nx, grid.ny)
}

/// The shape of a window for so many cells along x and y: the largest whose transforms take no
/// longer.
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

#[cfg(test)]
mod tests {
    use super::shape_for;
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
}
