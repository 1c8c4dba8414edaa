//! Results of an increment: motion, loads, areas, energies; and the state after it.

mod areas;
mod energy;
mod history;
mod scatter;
mod spots;

pub(super) use self::energy::of_tractions;
pub(super) use self::history::{Closing, Stuck, close, growth};
pub(super) use self::scatter::SAMPLES;
use super::setup::Setup;
use super::transmitted::transmitted;
use super::{Increment, Motion, Work, Yield, check};
use crate::cells::run_both;
use crate::scene::LoadPoint;
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::NoSlipTerms;

/// The results of a solved increment (areas, energies, residuals, loads), and the cells that did not slip in
/// it.
pub(super) fn draw_up(
    setup: &Setup<'_>,
    no_slip: &NoSlipTerms,
    now: &Interface,
    info: &AlternationInfo,
) -> (Increment, Stuck) {
    let state = setup.state;
    let cell_area = setup.problem.cell_area();
    let motion = motion(setup, info);
    let point = LoadPoint {
        loads: transmitted(setup, setup.point, now),
        ..*setup.point
    };
    let ((energy, (residuals, [p_max, q_max, q_rms])), zones) = run_both(
        now.p.len(),
        || {
            let energy = energy::energies(setup, no_slip, &point, now, info, &motion);
            (energy, check::residuals(setup, no_slip, now, info))
        },
        || areas::areas(setup, no_slip, now, info),
    );
    let increment = Increment {
        index: state.increments + 1,
        point,
        motion,
        status: zones.status,
        contact_area: zones.contact * cell_area,
        stick_area: zones.stick * cell_area,
        cells_per_radius: zones.count.radius,
        spots: spots::spots(setup, &zones.count, now, info, point.loads.W),
        contact_radius: setup
            .problem
            .scene
            .grid
            .equivalent_radius(zones.contact * cell_area),
        p_max,
        q_max,
        q_rms,
        q_scatter: (setup.point.ends_branch)
            .then(|| {
                let cells = zones.count.radius;
                scatter::scatter(setup.geometry, setup.problem.plan.mirror, now, cells)
            })
            .flatten(),
        path_grid: setup.problem.scene.grid.nx,
        energy,
        yielded: Yield::default(),
        residuals,
        work: Work {
            convolutions: 0.0,
            alternations: info.alternations,
            normal_iterations: info.normal_iterations,
            tangential_iterations: info.tangential_iterations,
            parts: 1,
        },
    };
    let stuck = Stuck {
        area: zones.without_slip * cell_area,
        at_limit: zones.at_limit,
    };
    (increment, stuck)
}

/// The rigid motion at the end of the increment; given motions to the last bit.
fn motion(setup: &Setup<'_>, info: &AlternationInfo) -> Motion {
    let (last, arms) = (&setup.state.motion, &setup.geometry.arms);
    let prescribed = &setup.point.loads.given;
    let (approach, shift) = (info.approach, info.shift);
    Motion {
        delta_z: prescribed.delta_z.unwrap_or(approach[0]),
        phi_x: prescribed
            .phi_x
            .unwrap_or(approach[1] / arms.motion_unit(1)),
        phi_y: prescribed
            .phi_y
            .unwrap_or(approach[2] / arms.motion_unit(2)),
        delta_x: prescribed.delta_x.unwrap_or(last.delta_x + shift[0]),
        delta_y: (prescribed.delta_y).unwrap_or(last.delta_y + shift[1] / arms.motion_unit(4)),
        phi_z: (prescribed.phi_z).unwrap_or(last.phi_z + shift[2] / arms.motion_unit(5)),
    }
}
