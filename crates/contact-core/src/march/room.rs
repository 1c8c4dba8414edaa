//! How wide the window is: room for the contact and for what it is expected to grow by.

use super::March;
use super::entry_order::AROUND;
use super::window::{Window, embedded, shape_of};
use crate::convolution::good_size;
use crate::error::Error;
use crate::plan::Plan;
use crate::scene::{Grid, LoadPoint, Scene};

/// Least cells between the contact and the border of the window; those that enter it look further around.
const ROOM: usize = 2;
/// What the contact is expected to grow by until the next, wider window, if the loads still grow by as
/// much.
const GROWTH: f64 = 1.08;
/// Part of the grid's length from which a window is not worth it.
const WHOLE: f64 = 0.9;
/// The least cells along an axis of a window.
const LEAST: usize = 32;

impl Window {
    /// The shape of the window to begin with: the whole grid where cells have to be kept everywhere.
    pub(super) fn first(scene: &Scene, plan: &Plan) -> (usize, usize) {
        if plan.window {
            shape_for(&scene.grid, [LEAST, LEAST])
        } else {
            shape_of(&scene.grid)
        }
    }
}

impl March {
    /// Makes the window wide enough in an increment to `point` for a contact of pressure `p`, given on the
    /// kept cells of a grid around the same middle, or for what it grows to from that `at_start`; whether it
    /// was not. Fails where the run is stopped meanwhile.
    pub(super) fn make_room(
        &mut self,
        p: &[f64],
        (nx, ny): (usize, usize),
        point: &LoadPoint,
        at_start: bool,
    ) -> Result<bool, Error> {
        if !self.is_windowed() {
            return Ok(false);
        }
        let half = half_lengths(p, self.plan.mirror.rows(ny), (nx, ny));
        let [within, rest] = self.growth(point);
        let growth = if at_start { within } else { 1.0 };
        let room = if within > 1.0 { AROUND as usize } else { ROOM };
        let cells = |half: usize, growth: f64| 2 * ((half as f64 * growth).round() as usize + room);
        let (now, whole) = (self.window.shape(), &self.scene.grid);
        let narrow = |half: usize, n: usize, whole: usize| n < whole && cells(half, growth) > n;
        if !narrow(half[0], now.0, whole.nx) && !narrow(half[1], now.1, whole.ny) {
            return Ok(false);
        }
        let wider = half.map(|half| cells(half, growth * rest.min(GROWTH)));
        self.move_into(shape_for(whole, [wider[0].max(now.0), wider[1].max(now.1)]))?;
        Ok(true)
    }

    /// Moves into a narrower window where a branch begins from which on nothing presses harder, if no cell
    /// beyond it has been in contact. Fails where the run is stopped meanwhile.
    pub(super) fn give_up_room(&mut self, point: &LoadPoint) -> Result<(), Error> {
        let state = &self.state;
        let last = state
            .increments
            .checked_sub(1)
            .map(|last| &self.points[last]);
        let begins = last.is_some_and(|last| last.ends_branch);
        if !(self.plan.window && begins) || self.presses_harder(point) {
            return Ok(());
        }
        let (mirror, now) = (self.plan.mirror, self.window.shape());
        let rows = mirror.rows(now.1);
        let half = half_lengths(&state.interface.p, rows, now);
        let cells = half.map(|half| (2 * (half + ROOM)).max(LEAST));
        let (nx, ny) = shape_for(&self.scene.grid, cells);
        let shape = (nx.min(now.0), ny.min(now.1));
        let kept = embedded(
            &vec![true; shape.0 * mirror.rows(shape.1)],
            (shape.0, mirror.rows(shape.1)),
            (now.0, rows),
            mirror,
            false,
        );
        let unloaded = |n: usize| state.p_before[n] == 0.0 && state.dissipated[n] == 0.0;
        let untouched = |n: usize| unloaded(n) && state.slip_length[n] == 0.0;
        if shape == now || !(0..kept.len()).all(|n| kept[n] || untouched(n)) {
            return Ok(());
        }
        self.move_into(shape)?;
        // What has been seen clear is what lay beyond the wider one.
        self.state.clear = 0.0;
        Ok(())
    }

    /// Whether the bodies are pressed together harder in this or a later branch, as far as that is known.
    fn presses_harder(&self, point: &LoadPoint) -> bool {
        let mut from = self.state.loads.W;
        self.scene.path.branches[point.branch..]
            .iter()
            .any(|branch| {
                let before = std::mem::replace(&mut from, branch.to.W);
                branch.to.given.delta_z.is_some() || branch.to.W > before
            })
    }

    /// What the contact is expected to grow by in an increment to `point`, and on the rest of the path:
    /// that of a sphere grows like the cube root of the force and like the root of the approach.
    fn growth(&self, point: &LoadPoint) -> [f64; 2] {
        let (last, path) = (&self.state, &self.scene.path);
        let (steps, power) = match point.loads.given.delta_z {
            Some(now) => ([last.motion.delta_z, now, path.delta_z_max()], 1.0 / 2.0),
            None => ([last.loads.W, point.loads.W, path.W_max()], 1.0 / 3.0),
        };
        let grows = |from: f64, to: f64| {
            if from > 0.0 && to > from {
                (to / from).powf(power)
            } else {
                1.0
            }
        };
        [grows(steps[0], steps[1]), grows(steps[1], steps[2])]
    }
}

/// The shape of a window in which so many cells along x and y fit, the longest that transforms take
/// no longer for.
fn shape_for(grid: &Grid, cells: [usize; 2]) -> (usize, usize) {
    let along = |whole: usize, cells: usize| {
        // A window of an odd grid is odd, too, so that it has the same middle.
        let odd = whole % 2;
        let longest = good_size(2 * (cells + odd)) / 2;
        let length = longest - (longest + odd) % 2;
        if length as f64 >= WHOLE * whole as f64 {
            whole
        } else {
            length
        }
    };
    (along(grid.nx, cells[0]), along(grid.ny, cells[1]))
}

/// Cells along x and along y from the middle of a grid to the far side of the outermost that touches; the
/// pressure is that of the kept rows.
fn half_lengths(p: &[f64], rows: usize, (nx, ny): (usize, usize)) -> [usize; 2] {
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
