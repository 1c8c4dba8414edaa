//! Energies of an increment.

use crate::cells::sums;
use crate::march::problem::Problem;
use crate::march::setup::Setup;
use crate::march::{Energy, Motion};
use crate::scene::LoadPoint;
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::{NoSlipTerms, slip};
use crate::solvers::{Interface, friction_bound};

/// Energies by the trapezoidal rule, exact for any symmetric C: the sum of mean traction times
/// change of displacement is the change of the elastic energy. The dissipated energy is not
/// computed with the mean shear; the difference is returned as `quadrature`.
pub(super) fn energies(
    setup: &Setup<'_>,
    no_slip: &NoSlipTerms,
    point: &LoadPoint,
    now: &Interface,
    info: &AlternationInfo,
    motion: &Motion,
) -> Energy {
    let (problem, geometry, roll) = (setup.problem, setup.geometry, &setup.roll);
    let (cell_area, mirror) = (problem.cell_area(), problem.plan.mirror);
    let (last, arms) = (setup.last(), &geometry.arms);
    let (started, ended) = (setup.state.motion.motions(), motion.motions());
    let approach = [0, 1, 2].map(|k| (ended[k] - started[k]) * arms.motion_unit(k));
    let sums = sums([&now.p[..], &last.p], |n, [p, p_before]| {
        if p <= 0.0 && p_before <= 0.0 {
            return [0.0; 7];
        }
        let hardness = problem.hardness;
        let mut plastic = 0.0;
        if p >= hardness {
            let gap = now.u_z[n] + geometry.h_init[n] - arms.displacement_across(info.approach, n);
            plastic = hardness * (-gap).max(0.0);
        }
        let p = mean(p, p_before);
        let du_z = now.u_z[n] - last.u_z[n];
        let stretch = roll.stretch_at(geometry, n);
        let wider = roll.gap_at(geometry, mirror, n);
        let rigid = arms.displacement_in_plane(info.shift, n);
        let (slip, entered) = slip_of(no_slip, now, last, rigid, n);
        let mut elastic = p * du_z;
        let (mut trapezoidal, mut of_bulk) = (0.0, 0.0);
        let mut opening = -p * (du_z + wider - arms.displacement_across(approach, n));
        for c in 0..2 {
            let q = mean(now.q[c][n], last.q[c][n]);
            let du = now.u[c][n] - last.u[c][n];
            elastic += q * (du - stretch[c]);
            opening -= q * entered[c];
            trapezoidal -= q * slip[c];
            of_bulk -= q * stretch[c];
        }
        let dissipated = dissipated([setup.mu[n], setup.mu_before[n]], now, last, slip, n);
        let quadrature = dissipated - trapezoidal;
        [
            elastic,
            dissipated,
            quadrature,
            opening - plastic,
            of_bulk,
            -p * wider,
            plastic,
        ]
    });
    let sums = sums.map(|sum| sum * cell_area);
    let [
        elastic,
        dissipated,
        quadrature,
        opening,
        bulk,
        rolling,
        plastic,
    ] = sums;
    Energy {
        work: work_of_loads(setup, point, motion) + bulk + rolling,
        elastic,
        dissipated,
        plastic,
        opening,
        quadrature,
    }
}

/// Elastic energy of the tractions \[J\], 1/2 sum of traction times displacement.
pub(in crate::march) fn of_tractions(problem: &Problem, interface: &Interface) -> f64 {
    let Interface { p, q, u, u_z, .. } = interface;
    let fields = [&p[..], &q[0], &q[1], u_z, &u[0], &u[1]];
    let [sum] = sums(fields, |_, [p, q_x, q_y, u_z, u_x, u_y]| {
        [p * u_z + q_x * u_x + q_y * u_y]
    });
    0.5 * problem.cell_area() * sum
}

/// Work of the loads in the increment \[J\], by the trapezoidal rule.
fn work_of_loads(setup: &Setup<'_>, point: &LoadPoint, motion: &Motion) -> f64 {
    let (from, to) = (setup.state.loads.forces(), point.loads.forces());
    let (started, ended) = (setup.state.motion.motions(), motion.motions());
    (0..6)
        .map(|k| mean(from[k], to[k]) * (ended[k] - started[k]))
        .sum()
}

/// The mean of two numbers, for the trapezoidal rule.
fn mean(a: f64, b: f64) -> f64 {
    0.5 * (a + b)
}

/// The slip of cell n in the increment, from where its material started or entered the contact, and its motion
/// before it entered \[m\]. `rigid` is the rigid motion at the cell.
pub(super) fn slip_of(
    no_slip: &NoSlipTerms,
    now: &Interface,
    last: &Interface,
    rigid: [f64; 2],
    n: usize,
) -> ([f64; 2], [f64; 2]) {
    let at = |u: &[Vec<f64>; 2]| [u[0][n], u[1][n]];
    let entered = if last.p[n] > 0.0 {
        [0.0; 2]
    } else {
        no_slip.entry_or_turn(n)
    };
    let moved = slip(at(&now.u), at(&last.u), rigid);
    ([moved[0] - entered[0], moved[1] - entered[1]], entered)
}

/// Energy per area dissipated in a cell by its `slip`, with the friction coefficients at the end
/// and at the start \[J/m^2\]. A cell slips at its bound: the energy is the mean bound of the
/// increment times the slip against the final shear, exact for constant pressure in an increment of
/// any size (the trapezoidal rule would mix in the shear before the onset). It is not negative, up
/// to the tolerance, since slip opposes the shear. A cell that leaves the contact dissipates half
/// of its last shear times its slip, if it moves against that shear.
pub(super) fn dissipated(
    [mu, mu_before]: [f64; 2],
    now: &Interface,
    last: &Interface,
    slip: [f64; 2],
    n: usize,
) -> f64 {
    let power = |q: &[Vec<f64>; 2]| q[0][n] * slip[0] + q[1][n] * slip[1];
    let bound = friction_bound(mu, now.p[n]);
    if bound <= 0.0 {
        return (-0.5 * power(&last.q)).max(0.0);
    }
    if !now.slips[n] {
        return 0.0;
    }
    let mean = if bound.is_finite() {
        0.5 * (1.0 + friction_bound(mu_before, last.p[n]) / bound)
    } else {
        1.0
    };
    -mean * power(&now.q)
}
