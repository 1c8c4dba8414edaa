//! The path on coarser grids: changes of numbers and tractions from these to the grid itself.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;

use super::branch_ends::BranchEnds;
use super::numbers::{MOTIONS, NUMBERS, Q_MAX, numbers};
use crate::error::Error;
use crate::march::{BranchSummary, March, Tractions, summarise};
use crate::plan::Plan;
use crate::scene::{Grid, PathGrid, RigidMotion, SaveFields, Scene};
use crate::yielding::{Below, Yielding};

/// Refinement factors of the coarser grids, below 1. The last one is solved where no finer grid is.
const PARTS: [f64; 3] = [0.5, 0.375, 0.75];
/// Error over its scale where no finer grid is solved. Of the energies of 160 random scenes
/// (`tests/campaigns/error_bars.rs`) 94 % are within 1.5 bars with a factor of 1.5, of the other numbers 96 % and
/// more. Two coarser grids and a factor of 1 leave 9 % of all numbers outside.
const SAFETY: f64 = 1.75;
/// Order m of the [`numbers`]: 1.5, between the order of thin coatings, whose rim is off by a part of a
/// cell (1), and the order of smooth solutions (2). The rotation has 2: in 28 branches with torsion of
/// random scenes (`tests/campaigns/error_bars.rs`) true errors are 1.03 times the estimate with m = 2, and
/// 0.61 times that with m = 1.5. The largest shear lies at the border of the stick zone, which it leaves with
/// a square root; a cell takes its mean there: 0.5.
pub(super) const ORDER: [f64; NUMBERS] = {
    let mut order = [1.5; NUMBERS];
    order[MOTIONS + RigidMotion::PhiZ.index()] = 2.0;
    order[Q_MAX] = 0.5;
    order
};
/// Order m of the tractions, whose errors come from the cells at the rim.
const FIELDS: f64 = 1.0;
/// Fewest cells each way of a coarser grid.
const FEWEST_CELLS_EACH_WAY: usize = 8;

/// Error estimates of a branch from the coarser grids.
#[derive(Clone, Copy, Default)]
pub(super) struct GridErrors {
    /// Scale of the errors of the numbers: root of the mean square over the grids, each in its
    /// unit.
    pub(super) numbers: [f64; NUMBERS],
    /// Errors of pressure and shear (L2), over the largest of the path.
    pub(super) fields: [f64; 2],
    /// Error of the residual stress of bodies that yield, over its largest.
    pub(super) residual: f64,
}

/// Solves the scene on coarser grids and compares: differences of the numbers and of the tractions at the ends
/// of the branches from the run `fine`, which ended there with `tractions`. Without a finer grid (`has_finer`)
/// one more coarser grid is solved, and the errors of the numbers are [`SAFETY`] times their scale.
pub(super) fn coarser_grids(
    scene: &Scene,
    fine: &[BranchSummary],
    tractions: &[Tractions],
    has_finer: bool,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<GridErrors>, Error> {
    let mut of_branches = vec![GridErrors::default(); fine.len()];
    let mut remainders: Vec<Left> = Vec::new();
    // Maps have heights at every second point, but none at three of eight.
    let parts = if scene.has_maps() && halves(&scene.grid) {
        &PARTS[..1]
    } else if has_finer || scene.yields() {
        &PARTS[..2]
    } else {
        &PARTS[..]
    };
    let safety = if has_finer { 1.0 } else { SAFETY };
    for (k, &part) in parts.iter().enumerate() {
        let coarser = coarser(scene, part)?;
        let mut plan = Plan::new(&coarser);
        let fine_cells = plan.methods.volume_cells as f64;
        plan.methods.volume_cells = (part * fine_cells).round() as usize;
        let volume_cells = plan.methods.volume_cells;
        let mut nobody = ();
        let mut ends = BranchEnds::new(&mut nobody);
        let march = March::planned(&coarser, plan, stop)?;
        let coarse = summarise(&march.run(Vec::new(), &mut ends)?);
        let ratio = ratio(&coarser.grid, &scene.grid);
        let grown = ends.yielded.iter().flatten().any(|state| state.grown);
        if let Some(mut bodies) = Yielding::on_cells(&coarser, volume_cells, grown)? {
            let states = ends.yielded.iter().flatten();
            remainders.push(Left {
                ratio,
                below: states.map(|state| bodies.below_the_middle(state)).collect(),
            });
        }
        for ((of_branches, fine), coarse) in of_branches.iter_mut().zip(fine).zip(&coarse) {
            let (f, c) = (numbers(fine), numbers(coarse));
            for n in 0..NUMBERS {
                let off = safety * (f[n] - c[n]) / (ratio.powf(ORDER[n]) - 1.0);
                of_branches.numbers[n] =
                    of_branches.numbers[n].hypot(off / (parts.len() as f64).sqrt());
            }
        }
        if k == 0 {
            let off = distances(tractions, &ends.tractions);
            for (of_branches, off) in of_branches.iter_mut().zip(off) {
                of_branches.fields = off.map(|off| off / (ratio.powf(FIELDS) - 1.0));
            }
        }
    }
    if let [finer, coarser] = &remainders[..] {
        let whole = coarser.ratio.powf(LEFT) - finer.ratio.powf(LEFT);
        let pairs = finer.below.iter().zip(&coarser.below);
        for (of_branch, (finer, coarser)) in of_branches.iter_mut().zip(pairs) {
            // A larger estimate only means that the error is unknown.
            of_branch.residual = (relative_difference(finer, coarser) / whole).min(1.0);
        }
    }
    Ok(of_branches)
}

/// Order m of the residual stress.
const LEFT: f64 = 1.5;

/// Residual stress below the middle of a grid.
struct Left {
    /// Refinement factor of the grid against the scene's.
    ratio: f64,
    /// The planes of each branch.
    below: Vec<Vec<Below>>,
}

/// Largest difference of two residual stresses at the planes of the second, over its largest; linear
/// between the planes of a layer of the first. Infinite where nothing of the second has yielded.
fn relative_difference(first: &[Below], second: &[Below]) -> f64 {
    let (mut most, mut off) = (0.0_f64, 0.0_f64);
    for at in second {
        let same_layer: Vec<&Below> = first.iter().filter(|of| of.layer == at.layer).collect();
        let below = same_layer.partition_point(|of| of.depth < at.depth);
        let above = below.checked_sub(1).and_then(|above| same_layer.get(above));
        for c in 0..3 {
            most = most.max(at.stress[c].abs());
            if let Some((top, bottom)) = above.zip(same_layer.get(below)) {
                let part = (at.depth - top.depth) / (bottom.depth - top.depth);
                let stress = top.stress[c] + part * (bottom.stress[c] - top.stress[c]);
                off = off.max((stress - at.stress[c]).abs());
            }
        }
    }
    if most > 0.0 {
        off / most
    } else {
        f64::INFINITY
    }
}

/// The scene on the coarsest grid of the error estimate. Fails if there is none.
pub fn coarsest(scene: &Scene) -> Result<Scene, Error> {
    coarser(scene, PARTS[1])
}

/// The scene on a grid of the same extent with `part` (0 to 1) of the cells along each side. Odd numbers of
/// cells stay odd, so that the middle of the grid stays the centre of a cell; a strip keeps its one row.
fn coarser(scene: &Scene, part: f64) -> Result<Scene, Error> {
    let grid = &scene.grid;
    let fewer = |n: usize| {
        let fewer = (part * n as f64).round() as usize;
        fewer + (fewer + n) % 2
    };
    let (nx, ny) = (fewer(grid.nx), fewer(grid.ny));
    let ny = if grid.plane_strain { 1 } else { ny };
    if nx < FEWEST_CELLS_EACH_WAY || (ny < FEWEST_CELLS_EACH_WAY && !grid.plane_strain) {
        return Err(Error::invalid(
            "grid.n",
            format!("[{}, {}]", grid.nx, grid.ny),
            format!(
                "{} or more cells, so that a coarser grid shows the error",
                2 * FEWEST_CELLS_EACH_WAY + 4
            ),
        ));
    }
    let (along_x, along_y) = grid.extent();
    let mut coarse = scene.clone();
    coarse.settings.save = SaveFields::Branches;
    coarse.settings.solver.path_grid = PathGrid::Same;
    coarse.grid = Grid {
        nx,
        ny,
        dx: along_x / nx as f64,
        dy: along_y / ny as f64,
        ..*grid
    };
    if scene.has_maps() && halves(grid) && 2 * nx == grid.nx {
        coarse.decimate_maps(grid);
    }
    coarse.check()?;
    Ok(coarse)
}

/// Whether both sides can be divided into cells twice as large, with an even number of them.
fn halves(grid: &Grid) -> bool {
    let even = |n: usize| n.is_multiple_of(4);
    even(grid.nx) && even(grid.ny) && !grid.plane_strain
}

/// Ratio of the cell sizes of two grids, the geometric mean along x and y.
fn ratio(grid: &Grid, finer: &Grid) -> f64 {
    let along_x = grid.dx / finer.dx;
    if grid.plane_strain {
        along_x
    } else {
        (along_x * grid.dy / finer.dy).sqrt()
    }
}

/// Distances of pressure and of shear between two runs at the end of each branch: root of the sum of squares on
/// the coarse cells, over the largest of the path.
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
    // The fine cells that a coarse one covers, with their parts of it.
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
        let mean_of_column = |&(k, part): &(usize, f64)| -> f64 {
            let row = rows[j].iter().map(|&(l, part)| part * fine[(k, l)]);
            part * row.sum::<f64>()
        };
        columns[i].iter().map(mean_of_column).sum()
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
