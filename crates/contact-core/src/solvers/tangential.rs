//! The tangential problem: shear for known pressure.
//!
//! ```text
//! minimise  1/2 q.C_tt q + q.w   over  |q| <= g = mu p,  sum of q dA = T
//! ```
//!
//! with w = C_tz p - u_ref: convex, its multiplier is the rigid shift d(delta), its gradient the
//! slip ds = u - u_ref - d(delta). Eq. (7)-(8) and (20) of the paper are its optimality conditions.
//!
//! A semi-smooth Newton method: on stick cells both components are free; on slip cells q = g e and
//! only the motion along the circle is, where the constraint adds the diagonal |ds|/g. Each step is
//! a linear system on that tangent space with the force constraint projected out, solved by
//! conjugate gradients preconditioned with S P S, P the inverse of the operator and
//! S = (1 + diag/C_xx(0,0))^(-1/2). Then q returns to the circle, stick cells beyond it start to
//! slip, and slip cells whose slip would go along q stick again. A step that raises the energy is
//! taken back and projected gradients, which cannot, go on from there.

use super::newton_step::NewtonStep;
use super::projected_gradient::{ProjectedGradient, mark_circle, project};
use super::shear_gradient::shear_gradient;
use super::vector::{add_scaled, mean_where, size, sum};
use super::{Response, SolverError};

/// What is given: the friction bound, the reference of the slip, the force.
#[derive(Clone, Copy, Debug)]
pub struct TangentialProblem<'a> {
    /// Largest shear g = mu p in each cell \[Pa\], zero outside the contact.
    pub bound: &'a [f64],
    /// Displacements that mean no slip, those of the last increment \[m\].
    pub u_ref: [&'a [f64]; 2],
    /// Sum of the shear over the cells, T over the area of a cell \[Pa\].
    pub sum_q: [f64; 2],
    /// Whether each shift is free to balance its force; a fixed one is zero (by symmetry).
    pub free: [bool; 2],
}

/// How the tangential problem is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TangentialMethod {
    /// Semi-smooth Newton steps, [`tangential`].
    Newton,
    /// Conjugate gradients of the Polonsky-Keer type, as in the paper.
    Gradient,
}

/// Settings of the tangential solver.
#[derive(Clone, Copy, Debug)]
pub struct TangentialParams {
    /// How the problem is solved.
    pub method: TangentialMethod,
    /// Largest root-mean-square misfit of the slip conditions over the contact \[m\].
    pub tolerance: f64,
    /// Most Newton steps.
    pub max_iterations: usize,
    /// Each linear system is solved to this fraction of its first residual.
    pub forcing: f64,
    /// Most conjugate-gradient passes of a Newton step.
    pub max_passes: usize,
}

/// What the tangential solver ended with.
#[derive(Clone, Copy, Debug, Default)]
pub struct TangentialInfo {
    /// Rigid shift of this increment \[m\].
    pub shift: [f64; 2],
    /// Root-mean-square misfit \[m\].
    pub misfit: f64,
    /// Newton steps.
    pub iterations: usize,
    /// Conjugate-gradient passes, one convolution each.
    pub passes: usize,
}

/// Buffers of the tangential solver.
#[derive(Debug)]
pub struct TangentialWorkspace {
    step: NewtonStep,
    pub(crate) descent: ProjectedGradient,
    u_before: [Vec<f64>; 2],
    pub(crate) q_before: [Vec<f64>; 2],
    pub(crate) residual: [Vec<f64>; 2],
    pub(crate) direction: [Vec<f64>; 2],
    pub(crate) change: [Vec<f64>; 2],
    pub(crate) response: [Vec<f64>; 2],
}

impl TangentialWorkspace {
    /// For fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        let pair = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            step: NewtonStep::new(cells),
            descent: ProjectedGradient::new(cells),
            u_before: pair(),
            q_before: pair(),
            residual: pair(),
            direction: pair(),
            change: pair(),
            response: pair(),
        }
    }
}

/// Shear, displacement and slip set, in and out.
pub struct Shear<'a> {
    /// q_x, q_y \[Pa\]; on entry a guess.
    pub q: [&'a mut [f64]; 2],
    /// Total u_x, u_y \[m\], belonging to q on entry and on exit.
    pub u: [&'a mut [f64]; 2],
    /// Contact cells that slip; on entry a guess.
    pub slip: &'a mut [bool],
}

impl Shear<'_> {
    /// Slip ds = u - u_ref - shift in cell n \[m\].
    pub(crate) fn slip_of(
        &self,
        problem: &TangentialProblem<'_>,
        shift: [f64; 2],
        n: usize,
    ) -> [f64; 2] {
        [
            self.u[0][n] - problem.u_ref[0][n] - shift[0],
            self.u[1][n] - problem.u_ref[1][n] - shift[1],
        ]
    }
}

/// A slip set counts as settled when no slip cell moves along its shear by more than this part of
/// the tolerance, and a change of q is negligible when it moves no cell by more than that.
const SETTLED: f64 = 0.1;

/// Passes of projected gradients after a Newton step that would have raised the energy.
const DESCENT: usize = 30;

/// Solves for the shear. On entry it must be admissible: within the bound and balanced.
pub fn tangential(
    response: &mut Response<'_>,
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    ws: &mut TangentialWorkspace,
    params: &TangentialParams,
) -> Result<TangentialInfo, SolverError> {
    let root_of_contact = (problem.bound.iter().filter(|&&g| g > 0.0).count() as f64).sqrt();
    if params.method == TangentialMethod::Gradient {
        return shear_gradient(response, problem, shear, ws, params);
    }
    ws.step.set_contact(problem.bound);
    let (c_xx, _) = response.op.self_coefficients();
    let negligible = SETTLED * params.tolerance / c_xx;
    let mut info = TangentialInfo {
        shift: first_shift(problem, shear),
        ..Default::default()
    };
    loop {
        let released = release(problem, shear, info.shift, SETTLED * params.tolerance);
        ws.step.linearise(problem, shear, info.shift, c_xx);
        info.misfit = ws.step.residual_norm() / root_of_contact;
        if released == 0 && info.misfit <= params.tolerance {
            return Ok(info);
        }
        if info.iterations == params.max_iterations {
            return Err(SolverError {
                solver: "tangential",
                residual: info.misfit,
                tolerance: params.tolerance,
                iterations: info.iterations,
            });
        }
        info.iterations += 1;
        let target = (params.forcing * info.misfit).max(0.3 * params.tolerance);
        info.passes += ws
            .step
            .solve(response, target * root_of_contact, params.max_passes);
        for c in 0..2 {
            ws.q_before[c].copy_from_slice(shear.q[c]);
            ws.u_before[c].copy_from_slice(shear.u[c]);
        }
        info.shift = ws.step.take(problem, shear);
        mark_slip(problem, shear, info.shift);
        if admissible(problem, &mut shear.q, shear.slip, &mut ws.change) > negligible {
            let [change_x, change_y] = &ws.change;
            let [response_x, response_y] = &mut ws.response;
            response.tangential([change_x, change_y], [response_x, response_y]);
            for c in 0..2 {
                add_scaled(shear.u[c], 1.0, &ws.response[c]);
            }
        }
        if rises(problem, shear, ws, params.tolerance) {
            for c in 0..2 {
                shear.q[c].copy_from_slice(&ws.q_before[c]);
                shear.u[c].copy_from_slice(&ws.u_before[c]);
            }
            info.shift = ws.descent.run(response, problem, shear, DESCENT);
            info.passes += DESCENT;
        }
    }
}

/// Whether the energy is higher than before the step, by more than the tolerance makes of the
/// change of shear. With C symmetric and the sum of the change zero, the difference of the energy
/// is the change times the mean slip.
fn rises(
    problem: &TangentialProblem<'_>,
    shear: &Shear<'_>,
    ws: &TangentialWorkspace,
    tolerance: f64,
) -> bool {
    let (mut rise, mut moved) = (0.0, 0.0);
    for c in 0..2 {
        for n in 0..problem.bound.len() {
            let change = shear.q[c][n] - ws.q_before[c][n];
            let mean = 0.5 * (shear.u[c][n] + ws.u_before[c][n]) - problem.u_ref[c][n];
            rise += change * mean;
            moved += change.abs();
        }
    }
    rise > SETTLED * tolerance * moved
}

/// The shift that fits the stick cells best, or all contact cells where none sticks.
pub(crate) fn first_shift(problem: &TangentialProblem<'_>, shear: &Shear<'_>) -> [f64; 2] {
    let cells = problem.bound.len();
    let sticks = |n: usize| problem.bound[n] > 0.0 && !shear.slip[n];
    let any_sticks = (0..cells).any(sticks);
    std::array::from_fn(|c| {
        let mask = |n: usize| {
            if any_sticks {
                sticks(n)
            } else {
                problem.bound[n] > 0.0
            }
        };
        let slip = |n: usize| shear.u[c][n] - problem.u_ref[c][n];
        if problem.free[c] {
            mean_where(cells, mask, slip).0
        } else {
            0.0
        }
    })
}

/// Stick cells beyond the bound start to slip; slip cells whose slip goes along q stick.
fn mark_slip(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 2]) {
    for n in 0..problem.bound.len() {
        shear.slip[n] = if shear.slip[n] {
            power(problem, shear, shift, n) <= 0.0
        } else {
            let g = problem.bound[n];
            g > 0.0 && size([shear.q[0][n], shear.q[1][n]]) > g
        };
    }
}

/// Releases slip cells that move along their shear by more than `tolerance` \[m\]; how many.
fn release(
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    shift: [f64; 2],
    tolerance: f64,
) -> usize {
    let mut released = 0;
    for n in 0..problem.bound.len() {
        if shear.slip[n] && power(problem, shear, shift, n) > tolerance * problem.bound[n] {
            shear.slip[n] = false;
            released += 1;
        }
    }
    released
}

/// q . ds in cell n, negative where friction dissipates \[Pa m\].
fn power(problem: &TangentialProblem<'_>, shear: &Shear<'_>, shift: [f64; 2], n: usize) -> f64 {
    let slip = shear.slip_of(problem, shift, n);
    shear.q[0][n] * slip[0] + shear.q[1][n] * slip[1]
}

/// Rounds of clipping and balancing before the stick cells are taken to be too few.
const ROUNDS: usize = 8;

/// Makes the shear admissible without asking for its response: slip cells and cells beyond the
/// bound go to the circle |q| = g, cells outside the contact to zero, and stick cells share the
/// force that is missing. Where they cannot carry it, the nearest admissible shear is taken.
///
/// The change of q goes to `change`; returns the root of its sum of squares \[Pa\].
pub(crate) fn admissible(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    slip: &mut [bool],
    change: &mut [Vec<f64>; 2],
) -> f64 {
    for c in 0..2 {
        change[c].copy_from_slice(q[c]);
    }
    if !share_force(problem, q, slip) {
        project(problem, q, &mut [0.0; 2]);
        mark_circle(problem, q, slip);
    }
    let mut squares = 0.0;
    for c in 0..2 {
        for (change, q) in change[c].iter_mut().zip(q[c].iter()) {
            *change = q - *change;
            squares += *change * *change;
        }
    }
    squares.sqrt()
}

/// Cuts the shear to the bound and lets the stick cells share the missing force; whether that
/// ended with both conditions met.
fn share_force(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    slip: &mut [bool],
) -> bool {
    let cells = problem.bound.len();
    let enough = 1e-13 * sum(problem.bound);
    for _ in 0..ROUNDS {
        let mut missing = problem.sum_q;
        let mut sticking = 0;
        for n in 0..cells {
            let g = problem.bound[n];
            let size = size([q[0][n], q[1][n]]);
            let factor = if g <= 0.0 {
                0.0
            } else if size > g || (slip[n] && size > 0.0) {
                g / size
            } else {
                1.0
            };
            slip[n] &= g > 0.0 && size > 0.0;
            sticking += usize::from(g > 0.0 && !slip[n]);
            for c in 0..2 {
                q[c][n] *= factor;
                missing[c] -= q[c][n];
            }
        }
        if (0..2).all(|c| !problem.free[c] || missing[c].abs() <= enough) {
            return true;
        }
        for n in (0..cells).filter(|&n| problem.bound[n] > 0.0 && !slip[n]) {
            for c in (0..2).filter(|&c| problem.free[c]) {
                q[c][n] += missing[c] / sticking as f64;
            }
        }
    }
    false
}
