//! How far the numbers of a run are off: what cells, increments and solver leave in them.
//!
//! **Cells.** The path is run again on coarser grids, of r_i times the cell. An error that falls like the
//! m-th power of the cell is told by each of them (Richardson),
//!
//! ```text
//! error = |f - c_i|/(r_i^m - 1)
//! ```
//!
//! but the place of the rim within the cells makes errors of numbers go up and down from grid to grid, as
//! much as they fall where the rim is well found: the root of the mean square over the grids is the scale
//! of the error. A finer grid tells the error itself (`finer`), up to what it leaves on that scale. The
//! tractions are compared as fields, their means over the cells of the first coarser grid.
//!
//! **Increments.** The change from fewer or to more of them (`path_error`), of every number.
//!
//! **Solver.** Its tolerance.
//!
//! Errors of cells and of increments whose signs are known add up or cancel, though neither is known
//! exactly: the square of the error is that of their sum by three parts, and that of what they are
//! without signs by one.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::choice::choose_increments;
use super::finer::Finer;
use super::numbers::numbers;
use super::path_error::path_errors;
use crate::error::Error;
use crate::march::{Increment, March, Observer, Tractions, summarise};
use crate::scene::{Grid, SaveFields, Scene};

/// Cells of the coarser grids each way, over those of the grid.
const PARTS: [f64; 2] = [0.5, 0.375];
/// Order m of numbers: between that of thin coatings, whose rim is off by a part of a cell, and that
/// of smooth solutions.
const NUMBERS: f64 = 1.5;
/// Order m of the tractions, which are off in the cells of the rim.
const FIELDS: f64 = 1.0;
/// Part of the square of the error of a number that is reckoned without signs.
const UNSIGNED: f64 = 0.25;
/// How well the border of a stick zone is found at least, in cells: so well where the slip ring is narrow.
const BORDER: f64 = 0.1;
/// Fewest cells each way of a coarser grid.
const FEWEST: usize = 8;

/// The estimated error of a number and its parts, >= 0, in the unit of the number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// All: the root of the sum of the squares. Of a number whose error a finer grid tells, a quarter of
    /// that sum, and three of the square of cells and increments together, with their signs.
    pub total: f64,
    /// What the cells leave.
    pub cells: f64,
    /// What the increments leave.
    pub path: f64,
    /// What the solver's tolerance leaves.
    pub solver: f64,
}

impl Bar {
    fn new(cells: f64, path: f64, solver: f64) -> Self {
        Self {
            total: cells.hypot(path).hypot(solver),
            cells,
            path,
            solver,
        }
    }
}

/// Estimated errors of the numbers at the end of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorBars {
    /// Branch, from 0.
    pub branch: usize,
    /// Of the contact radius \[m\].
    pub contact_radius: Bar,
    /// Of the stick area over the contact area.
    pub stick_ratio: Bar,
    /// Of the largest pressure \[Pa\].
    pub p_max: Bar,
    /// Of the approach \[m\].
    pub delta_z: Bar,
    /// Of the shift along x \[m\].
    pub delta_x: Bar,
    /// Of the shift along y \[m\].
    pub delta_y: Bar,
    /// Of the rotation \[rad\].
    pub phi_z: Bar,
    /// Of the energy dissipated in the branch \[J\].
    pub dissipated: Bar,
    /// Of the pressure as a field: L2 norm, over the largest of the path.
    pub p: Bar,
    /// Of the shear as a field: L2 norm, over the largest of the path.
    pub q: Bar,
}

/// Keeps the tractions at the ends of the branches for an observer who watches the run.
pub struct BranchEnds<'a> {
    watcher: &'a mut dyn Observer,
    /// The tractions of the branches that are done.
    pub tractions: Vec<Tractions>,
}

impl<'a> BranchEnds<'a> {
    /// Beside an observer.
    pub fn beside(watcher: &'a mut dyn Observer) -> Self {
        Self {
            watcher,
            tractions: Vec::new(),
        }
    }
}

impl Observer for BranchEnds<'_> {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if increment.point.ends_branch {
            self.tractions.push(march.tractions());
        }
        self.watcher.on_increment(march, increment)
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.watcher.on_end(march, failure)
    }

    fn stop(&self) -> Option<Arc<AtomicBool>> {
        self.watcher.stop()
    }
}

/// Solves the scene again on two coarser grids, along the path with fewer increments, and in few
/// increments on a finer grid, at some times the work of the run, and gives the errors of the branches of
/// `increments`, which ended with these tractions. Where a finer grid would have more than 512 x 512
/// cells the coarser ones alone tell the scale of errors. Ends when `stop` is raised.
pub fn error_bars(
    scene: &Scene,
    increments: &[Increment],
    tractions: &[Tractions],
    stop: &Arc<AtomicBool>,
) -> Result<Vec<ErrorBars>, Error> {
    let scene = &choose_increments(scene, stop)?;
    let along_path = path_errors(scene, stop)?;
    let fine = summarise(increments);
    let mut squares = vec![[0.0; 8]; fine.len()];
    let mut fields = Vec::new();
    for (k, part) in PARTS.into_iter().enumerate() {
        let coarser = coarser(scene, part)?;
        let mut nobody = ();
        let mut coarse_ends = BranchEnds::beside(&mut nobody);
        let march = March::until(&coarser, stop)?;
        let coarse = summarise(&march.run(Vec::new(), &mut coarse_ends)?);
        let ratio = ratio(&coarser.grid, &scene.grid);
        for ((squares, fine), coarse) in squares.iter_mut().zip(&fine).zip(&coarse) {
            let (f, c) = (numbers(fine), numbers(coarse));
            for n in 0..8 {
                squares[n] += ((f[n] - c[n]) / (ratio.powf(NUMBERS) - 1.0)).powi(2);
            }
        }
        if k == 0 {
            let off = distances(tractions, &coarse_ends.tractions);
            fields = off
                .into_iter()
                .map(|off| off.map(|off| off / (ratio.powf(FIELDS) - 1.0)))
                .collect();
        }
    }
    let finer = Finer::solve(scene, stop)?;
    let tolerance = scene.tolerance();
    let cell = if scene.grid.plane_strain {
        scene.grid.dx
    } else {
        scene.grid.cell_area().sqrt()
    };
    let branches = fine.iter().zip(squares).zip(fields).zip(along_path);
    Ok(branches
        .enumerate()
        .map(|(branch, (((fine, mut squares), [p, q]), path))| {
            let value = numbers(fine);
            // What the finer grid leaves of an error.
            let left = finer.as_ref().map_or(0.0, |f| f.ratio.powf(-NUMBERS));
            let of_finer = finer
                .as_ref()
                .map(|finer| finer.off[branch].map(|off| off / (1.0 - left)));
            if let Some(off) = of_finer {
                for (square, off) in squares.iter_mut().zip(off) {
                    *square = (left * left) * *square + PARTS.len() as f64 * off * off;
                }
            }
            // A ring along the border of the stick zone over the area of the contact.
            let ring = 2.0 * BORDER * cell / fine.contact_radius * fine.stick_ratio.sqrt();
            if fine.stick_ratio < 1.0 && fine.contact_radius > 0.0 {
                squares[1] += PARTS.len() as f64 * ring * ring;
            }
            let bar = |n: usize| {
                let (of_path, solver) = (path.numbers[n], tolerance * value[n].abs());
                let cells = (squares[n] / PARTS.len() as f64).sqrt();
                let bar = Bar::new(cells, of_path.abs(), solver);
                let with_signs = |off: f64| {
                    let square = (off + of_path).powi(2);
                    let total = (1.0 - UNSIGNED) * square + UNSIGNED * bar.total.powi(2);
                    Bar {
                        total: total.sqrt(),
                        ..bar
                    }
                };
                of_finer.map_or(bar, |off| with_signs(off[n]))
            };
            ErrorBars {
                branch: fine.branch,
                contact_radius: bar(0),
                stick_ratio: bar(1),
                p_max: bar(2),
                delta_z: bar(3),
                delta_x: bar(4),
                delta_y: bar(5),
                phi_z: bar(6),
                dissipated: bar(7),
                p: Bar::new(p, path.p, tolerance),
                q: Bar::new(q, path.q, tolerance),
            }
        })
        .collect())
}

/// The scene on the coarsest of the grids that tell the errors of the cells. Fails where there is none.
pub fn coarsest(scene: &Scene) -> Result<Scene, Error> {
    coarser(scene, PARTS[1])
}

/// The scene in a part of its cells each way, an odd number of them where it has an odd one, so that
/// as much lies in the middle of a cell; a strip keeps its one row.
fn coarser(scene: &Scene, part: f64) -> Result<Scene, Error> {
    let grid = &scene.grid;
    let fewer = |n: usize| {
        let fewer = (part * n as f64).round() as usize;
        fewer + (fewer + n) % 2
    };
    let (nx, ny) = (fewer(grid.nx), fewer(grid.ny));
    let ny = if grid.plane_strain { 1 } else { ny };
    if nx < FEWEST || (ny < FEWEST && !grid.plane_strain) {
        return Err(Error::invalid(
            "grid.n",
            format!("[{}, {}]", grid.nx, grid.ny),
            format!(
                "{} or more cells, so that a part of them tells the error",
                2 * FEWEST + 4
            ),
        ));
    }
    let (along_x, along_y) = grid.extent();
    let mut coarse = scene.clone();
    coarse.settings.save = SaveFields::Branches;
    coarse.grid = Grid {
        nx,
        ny,
        dx: along_x / nx as f64,
        dy: along_y / ny as f64,
        ..*grid
    };
    coarse.check()?;
    Ok(coarse)
}

/// The cell of a grid over that of another, on the mean of both axes.
fn ratio(grid: &Grid, finer: &Grid) -> f64 {
    let along_x = grid.dx / finer.dx;
    if grid.plane_strain {
        along_x
    } else {
        (along_x * grid.dy / finer.dy).sqrt()
    }
}

/// The distances of pressures and shears at the ends of the branches, over the largest of the path.
fn distances(fine: &[Tractions], coarse: &[Tractions]) -> Vec<[f64; 2]> {
    let norm = |f: &Array2<f64>| f.iter().map(|f| f * f).sum::<f64>();
    let [p, q] = coarse.iter().fold([f64::MIN_POSITIVE; 2], |[p, q], of| {
        [p.max(norm(&of[0])), q.max(norm(&of[1]) + norm(&of[2]))]
    });
    fine.iter()
        .zip(coarse)
        .map(|(fine, coarse)| {
            let off = |k: usize| norm(&(means(&fine[k], coarse[k].dim()) - &coarse[k]));
            [(off(0) / p).sqrt(), ((off(1) + off(2)) / q).sqrt()]
        })
        .collect()
}

/// The means of a field over the cells of a coarser grid of the same extent.
pub fn means(fine: &Array2<f64>, (nx, ny): (usize, usize)) -> Array2<f64> {
    // The fine cells that a coarse one covers, and the parts of it that they are.
    let covered = |i: usize, fine: usize, coarse: usize| -> Vec<(usize, f64)> {
        let ratio = fine as f64 / coarse as f64;
        let (low, high) = (i as f64 * ratio, (i + 1) as f64 * ratio);
        (low.floor() as usize..(high.ceil() as usize).min(fine))
            .map(|k| {
                let part = (high.min((k + 1) as f64) - low.max(k as f64)) / ratio;
                (k, part.max(0.0))
            })
            .collect()
    };
    let (across_x, across_y) = fine.dim();
    let rows: Vec<_> = (0..ny).map(|j| covered(j, across_y, ny)).collect();
    let columns: Vec<_> = (0..nx).map(|i| covered(i, across_x, nx)).collect();
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        let of = |&(k, part): &(usize, f64)| -> f64 {
            let row = rows[j].iter().map(|&(l, part)| part * fine[(k, l)]);
            part * row.sum::<f64>()
        };
        columns[i].iter().map(of).sum()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_keep_the_sum() {
        let fine = Array2::from_shape_fn((12, 7), |(i, j)| (i * i + 3 * j) as f64);
        for n in [(6, 7), (5, 3), (12, 1)] {
            let coarse = means(&fine, n);
            let cell = 12.0 * 7.0 / (n.0 * n.1) as f64;
            assert!(
                (coarse.sum() * cell / fine.sum() - 1.0).abs() < 1e-14,
                "{n:?}"
            );
        }
        assert_eq!(means(&fine, (12, 7)), fine);
    }
}
