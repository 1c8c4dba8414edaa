//! The tangential problem: shear for known pressure.
//!
//! ```text
//! minimise  1/2 q.C_tt q + q.w   over  |q| <= g = mu p,  sum of q dA = T, moment of q dA = M_z
//! ```
//!
//! with w = C_tz p - u_0: convex, its multiplier is the rigid motion d(delta), its gradient the
//! slip ds = u - u_0 - d(delta). A prescribed motion enters w, and its force has
//! no constraint. Eq. (7)-(8) and (20) of the paper are its optimality conditions.
//!
//! A semi-smooth Newton method: on stick cells both components are free; on slip cells q = g e only
//! moves along the circle |q| = g, whose curvature adds |ds|/g to the diagonal. Each step is a
//! linear system on that tangent space with the force constraint projected out, solved by conjugate
//! gradients preconditioned with an approximate inverse ([`newton_system`](super::newton_system)).
//! Then q returns to the circle, stick cells beyond it start to slip, and slip cells whose slip
//! would go along q stick again.
//!
//! [`tangential`] solves the problem for a constant u_0: a step that raises the energy is undone,
//! and projected gradients, which cannot raise it, continue from there; likewise where the slip set
//! cycles. [`newton_step`] is one step for a u_0 that depends on the solution; no energy exists
//! then.

use std::sync::atomic::{AtomicBool, Ordering};

use super::admissible::make_admissible;
use super::contact_shear::{ContactShear, ShearBefore};
use super::newton_system::NewtonSystem;
use super::projected_gradient::ProjectedGradient;
use super::shear::{TangentialInfo, TangentialParams, TangentialProblem, first_shift};
use super::shear_gradient::GradientBuffers;
use crate::cells::{ContactCells, length, set_cells, sweep};
use crate::solvers::{Response, Shear, SolverError};

/// Buffers of the tangential solver.
#[derive(Debug)]
pub struct TangentialWorkspace {
    cells: ContactCells,
    contact: ContactShear,
    before: ShearBefore,
    system: NewtonSystem,
    pub(crate) descent: ProjectedGradient,
    pub(crate) gradient: GradientBuffers,
}

impl TangentialWorkspace {
    /// Allocates buffers for fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        Self {
            cells: ContactCells::default(),
            contact: ContactShear::default(),
            before: ShearBefore::default(),
            system: NewtonSystem::new(cells),
            descent: ProjectedGradient::default(),
            gradient: GradientBuffers::default(),
        }
    }
}

/// A slip set counts as settled when no slip cell moves along its shear by more than this part of
/// the tolerance.
const NEGLIGIBLE_CHANGE: f64 = 0.1;

/// Target of the last conjugate gradients over the tolerance; the return to the circles adds an
/// error.
const AIM: f64 = 0.4;

/// Iterations of projected gradients after a Newton step that would have raised the energy.
const DESCENT: usize = 10;

/// Newton steps without a smaller misfit after which the slip set is taken to cycle, so that
/// projected gradients continue (CYCLE), and after which the iteration has failed (STALLED).
const CYCLE: usize = 10;
const STALLED: usize = 100;

/// Solves for the shear. On entry it must be admissible: within the bound and balanced.
pub fn solve_tangential(
    response: &mut Response<'_>,
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    ws: &mut TangentialWorkspace,
    params: &TangentialParams,
) -> Result<TangentialInfo, SolverError> {
    let TangentialWorkspace {
        cells,
        contact,
        before,
        system,
        descent,
        ..
    } = ws;
    let mut newton = Newton::new(response, problem, shear, (cells, contact, system), params);
    newton.system.set_turning(newton.cells, None);
    let (mut least_misfit, mut stalled) = (f64::INFINITY, 0);
    while !newton.conditions_hold() {
        let misfit = newton.info.misfit;
        stalled = if misfit < least_misfit {
            0
        } else {
            stalled + 1
        };
        least_misfit = least_misfit.min(misfit);
        let ended = stalled == STALLED || newton.info.iterations == params.max_iterations;
        if ended || response.must_stop() {
            return Err(newton.failure());
        }
        before.save(&newton.shear);
        newton.take_newton_step(response);
        let cycles = stalled > 0 && stalled.is_multiple_of(CYCLE);
        if cycles
            || before.is_lower(
                &newton.problem,
                &newton.shear,
                newton.info.shift,
                newton.negligible_misfit,
            )
        {
            before.restore(&mut newton.shear);
            newton.shear.unpack(newton.cells, shear);
            newton.info.shift = descent.iterate(response, problem, shear, DESCENT);
            newton.info.passes += DESCENT;
            newton.shear.pack(newton.cells, shear);
        } else {
            newton.system.add_to_displacements(shear);
        }
    }
    newton.shear.unpack(newton.cells, shear);
    Ok(newton.info)
}

/// One Newton step for the shear, with the derivative `turning` of the turn term of u_0 in each
/// cell. If the conditions hold within the tolerance no step is done and `iterations` is 0. On
/// entry the shear must be admissible.
pub fn newton_step(
    response: &mut Response<'_>,
    problem: &TangentialProblem<'_>,
    turning: &[f64],
    shear: &mut Shear<'_>,
    ws: &mut TangentialWorkspace,
    params: &TangentialParams,
) -> TangentialInfo {
    let workspace = (&mut ws.cells, &mut ws.contact, &mut ws.system);
    let mut newton = Newton::new(response, problem, shear, workspace, params);
    newton.system.set_turning(newton.cells, Some(turning));
    if !newton.conditions_hold() {
        newton.take_newton_step(response);
        newton.system.add_to_displacements(shear);
    }
    newton.shear.unpack(newton.cells, shear);
    newton.info
}

/// The iteration on the contact cells, packed.
struct Newton<'a> {
    cells: &'a ContactCells,
    problem: TangentialProblem<'a>,
    shear: Shear<'a>,
    system: &'a mut NewtonSystem,
    info: TangentialInfo,
    params: &'a TangentialParams,
    c_xx: f64,
    negligible_misfit: f64,
    /// Square root of the number of contact cells: norms divided by it are root mean squares.
    root_of_count: f64,
}

impl<'a> Newton<'a> {
    /// Packs the contact cells and sets up the Newton system on them.
    fn new(
        response: &Response<'_>,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
        (cells, contact, system): (
            &'a mut ContactCells,
            &'a mut ContactShear,
            &'a mut NewtonSystem,
        ),
        params: &'a TangentialParams,
    ) -> Self {
        cells.find(problem.bound.len(), |n| problem.bound[n] > 0.0);
        contact.pack(cells, problem, shear);
        let (inside, now) = contact.problem_and_shear(problem.drive);
        system.set_contact(&inside);
        Self {
            info: TangentialInfo {
                shift: first_shift(&inside, &now),
                ..TangentialInfo::default()
            },
            problem: inside,
            shear: now,
            system,
            params,
            c_xx: response.op.self_coefficients().0,
            negligible_misfit: NEGLIGIBLE_CHANGE * params.tolerance,
            root_of_count: (cells.count() as f64).sqrt(),
            cells,
        }
    }

    /// Releases slip cells that should stick and linearises; returns whether the conditions hold.
    /// If the fitted shift differs from the one that slip cells were tested with, they are tested
    /// again.
    fn conditions_hold(&mut self) -> bool {
        for _ in 0..self.params.max_iterations {
            let released = release_slip_cells(
                &self.problem,
                &mut self.shear,
                self.info.shift,
                self.negligible_misfit,
            );
            let fitted =
                (self.system).linearise(&self.problem, &self.shear, self.info.shift, self.c_xx);
            self.info.misfit = self.system.residual_norm() / self.root_of_count;
            if released || self.info.misfit > self.params.tolerance {
                return false;
            }
            let change = |k: usize| (fitted[k] - self.info.shift[k]).abs();
            if (0..3).all(|k| change(k) <= self.negligible_misfit) {
                return true;
            }
            self.info.shift = fitted;
        }
        false
    }

    /// Solves the linear system, adds its solution, and returns slip cells to their circles.
    fn take_newton_step(&mut self, response: &mut Response<'_>) {
        let params = self.params;
        self.info.iterations += 1;
        let target = (params.forcing * self.info.misfit).max(AIM * params.tolerance);
        let target = target * self.root_of_count;
        self.info.passes += (self.system).solve(response, self.cells, target, params.max_passes);
        response.count_change(self.system.sum_of_squares());
        self.info.shift = (self.system).add_solution(self.cells, &self.problem, &mut self.shear);
        mark_slip(&self.problem, &mut self.shear, self.info.shift);
        let Self {
            system,
            shear: now,
            cells,
            ..
        } = self;
        make_admissible(&self.problem, now, self.info.shift);
        let ([x, y], [q_x, q_y]) = (&mut system.change, &now.q);
        let [squares] = sweep([&**q_x, q_y], [&mut x[..], y], |_, q, before| {
            let change = [q[0] - before[0], q[1] - before[1]];
            (change, [change[0] * change[0] + change[1] * change[1]])
        });
        if squares.sqrt() > params.negligible / self.c_xx {
            response.count_change(squares);
            system.add_response_of_change(response, cells, now);
        }
    }

    /// The error after too many iterations.
    fn failure(&self) -> SolverError {
        SolverError {
            solver: "tangential",
            residual: self.info.misfit,
            tolerance: self.params.tolerance,
            iterations: self.info.iterations,
        }
    }
}

/// Marks slip: stick cells beyond the bound start to slip; slip cells whose slip has the direction of q stick.
fn mark_slip(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 3]) {
    let Shear { q, u, slips, .. } = shear;
    set_cells(slips, |n, slips| {
        let q = [q[0][n], q[1][n]];
        if slips {
            friction_power_of_cell(q, problem.slip(u, shift, n)) <= 0.0
        } else {
            length(q) > problem.bound[n]
        }
    });
}

/// Releases slip cells that move along their shear by more than `tolerance` \[m\]; returns whether any did.
fn release_slip_cells(
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    shift: [f64; 3],
    tolerance: f64,
) -> bool {
    let Shear { q, u, slips, .. } = shear;
    let released = AtomicBool::new(false);
    set_cells(slips, |n, slips| {
        let moves_along =
            |slip| friction_power_of_cell([q[0][n], q[1][n]], slip) > tolerance * problem.bound[n];
        if slips && moves_along(problem.slip(u, shift, n)) {
            released.store(true, Ordering::Relaxed);
            return false;
        }
        slips
    });
    released.into_inner()
}

/// q . ds, negative where friction dissipates \[Pa m\].
pub(super) fn friction_power_of_cell(q: [f64; 2], slip: [f64; 2]) -> f64 {
    q[0] * slip[0] + q[1] * slip[1]
}
