//! Nested grids: the pressure of bodies that have not touched yet, from a grid of half as many
//! cells each way.
//!
//! Solved there, from a grid coarser still, without friction and not further than the coarse cells
//! deserve, it spares the fine grid most of its iterations.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;

use super::March;
use crate::scene::{Branch, Grid, LoadPath, LoadPoint, Loads, Preset, SaveFields, Scene, Spacing};

/// Cells of a grid below which a coarser one is not worth its kernels.
const FROM: usize = 128 * 128;
/// Tolerance on a coarse grid, where the cells themselves are off by more.
const TOLERANCE: f64 = 1e-4;

/// A pressure, and what it cost.
pub(super) struct CoarseStart {
    /// The pressure on the cells of the fine grid \[Pa\].
    pub(super) p: Array2<f64>,
    /// Convolutions, in terms of those of the fine grid.
    pub(super) convolutions: f64,
}

/// The pressure under the loads of a point, if a coarse grid is of use.
///
/// Where the bodies are paraboloids of one material each, Hertz's pressure is a better start. None,
/// too, once `stop` is raised.
pub(super) fn coarse_start(
    scene: &Scene,
    point: &LoadPoint,
    stop: &Arc<AtomicBool>,
) -> Option<CoarseStart> {
    let Grid { nx, ny, dx, dy, .. } = scene.grid;
    let homogeneous = scene.body1.is_homogeneous() && scene.body2.is_homogeneous();
    let of_use = scene.settings.solver.preset == Preset::Fast
        && nx.is_multiple_of(2)
        && ny.is_multiple_of(2)
        && nx * ny >= FROM
        && !(homogeneous && scene.hertz().is_some());
    if !of_use {
        return None;
    }
    let mut coarse = scene.clone();
    coarse.grid = Grid::from_spacing((nx / 2, ny / 2), (2.0 * dx, 2.0 * dy)).ok()?;
    coarse.friction.mu = 0.0;
    coarse.settings.solver.tolerance = Some(TOLERANCE.max(scene.tolerance()));
    coarse.settings.save = SaveFields::Branches;
    let mut to = Loads {
        T_x: 0.0,
        T_y: 0.0,
        M_z: 0.0,
        ..point.loads
    };
    (to.given.delta_x, to.given.delta_y) = (None, None);
    to.given.phi_z = Some(0.0);
    coarse.path = LoadPath {
        branches: vec![Branch {
            to,
            increments: Some(1),
            spacing: Spacing::Uniform,
            t_end: 1.0,
            path_error: None,
        }],
        rig_stiffness: None,
    };
    let mut march = March::until(&coarse, stop).ok()?;
    let increment = march.advance()?.ok()?;
    let p = march.fields().p;
    Some(CoarseStart {
        p: Array2::from_shape_fn((nx, ny), |(i, j)| between(&p, i, j)),
        convolutions: increment.work.convolutions / 4.0,
    })
}

/// Linear between the centres of the coarse cells, at the centre of a fine cell; zero beyond the grid.
fn between(coarse: &Array2<f64>, i: usize, j: usize) -> f64 {
    let at = |i: Option<usize>, j: Option<usize>| -> f64 {
        let place = i.zip(j);
        place
            .and_then(|place| coarse.get(place))
            .copied()
            .unwrap_or(0.0)
    };
    // The coarse cell that the fine one lies in, and the neighbour that is next to it.
    let beside = |n: usize| {
        let own = n / 2;
        let next = if n.is_multiple_of(2) {
            own.checked_sub(1)
        } else {
            Some(own + 1)
        };
        (Some(own), next)
    };
    let ((i, i_next), (j, j_next)) = (beside(i), beside(j));
    0.5625 * at(i, j) + 0.1875 * (at(i_next, j) + at(i, j_next)) + 0.0625 * at(i_next, j_next)
}
