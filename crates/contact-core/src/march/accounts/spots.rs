//! Sizes of the spots of a contact, and the mean gap between the surfaces.

use crate::cells::{Lattice, sums};
use crate::march::results::{EDGE, Spots};
use crate::march::setup::Setup;
use crate::scene::Nominal;
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;
use crate::zones::SpotCount;

/// The spots of a solved increment under the normal force W \[N\].
pub(super) fn spots(
    setup: &Setup<'_>,
    count: &SpotCount,
    now: &Interface,
    info: &AlternationInfo,
    W: f64,
) -> Spots {
    let (scene, geometry) = (&setup.problem.scene, setup.geometry);
    let cell = scene.grid.cell_area();
    let nominal = scene.nominal_contact(W);
    let arms = &geometry.arms;
    let heights = [&now.u_z[..], &geometry.h_init];
    let [cells, gap] = sums(heights, |n, [u_z, h]| {
        let at = [arms.x[n] * arms.length, arms.y[n] * arms.length];
        if nominal.covers(at) {
            [1.0, u_z + h - arms.displacement_across(info.approach, n)]
        } else {
            [0.0; 2]
        }
    });
    Spots {
        count: count.spots,
        whole_cells: count.cells * cell,
        edge_cells: count.faces * cell,
        largest: (count.largest - EDGE * count.faces_of_largest) * cell,
        lone_share: count.lone / count.cells.max(1.0),
        nominal_area: nominal.area,
        mean_gap: if cells > 0.0 { gap / cells } else { 0.0 },
        rms_slope: if scene.is_uneven() {
            rms_slope(setup, &nominal)
        } else {
            0.0
        },
        slope_length: if scene.grid.plane_strain {
            scene.grid.dx
        } else {
            cell.sqrt()
        },
    }
}

/// Root mean square of the slopes of the gap between neighbouring cells of the nominal contact, without those
/// of the curvature of the shapes: the mean square along x plus the one along y. Of a mirrored scene half of
/// the cells are stored; between its first row and the image the slope along y is zero, for half a pair.
fn rms_slope(setup: &Setup<'_>, nominal: &Nominal) -> f64 {
    let (scene, geometry) = (&setup.problem.scene, setup.geometry);
    let (arms, h, grid) = (&geometry.arms, &geometry.h_init, &geometry.grid);
    let lattice = Lattice::new(grid, setup.problem.plan.mirror);
    let rows = lattice.rows();
    let [upper, lower] = [&scene.body1, &scene.body2].map(|body| body.shape.curvature());
    let [k_xx, k_xy, k_yy] = [0, 1, 2].map(|n| upper[n] + lower[n]);
    let [along_x, pairs_x, along_y, pairs_y] = sums([&h[..]], |n, [here]| {
        let [x, y] = [arms.x[n] * arms.length, arms.y[n] * arms.length];
        let mut parts = [0.0; 4];
        if !nominal.covers([x, y]) {
            return parts;
        }
        if n + rows < h.len() {
            let s_x = (h[n + rows] - here) / grid.dx - (k_xx * (x + 0.5 * grid.dx) + k_xy * y);
            parts[..2].copy_from_slice(&[s_x * s_x, 1.0]);
        }
        if n % rows + 1 < rows {
            let s_y = (h[n + 1] - here) / grid.dy - (k_xy * x + k_yy * (y + 0.5 * grid.dy));
            parts[2..].copy_from_slice(&[s_y * s_y, 1.0]);
        }
        if lattice.is_mirrored() && n % rows == 0 {
            parts[3] += 0.5;
        }
        parts
    });
    (along_x / pairs_x.max(1.0) + along_y / pairs_y.max(1.0)).sqrt()
}
