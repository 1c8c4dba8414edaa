//! Sizes of the spots of a contact, and the mean gap between the surfaces.

use crate::cells::sums;
use crate::march::results::Spots;
use crate::march::setup::Setup;
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
        largest: count.largest * cell,
        lone_share: count.lone / count.cells.max(1.0),
        nominal_area: nominal.area,
        mean_gap: if cells > 0.0 { gap / cells } else { 0.0 },
    }
}
