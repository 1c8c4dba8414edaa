//! The paper's solution of the tangential problem: conjugate gradients of the Polonsky-Keer type.
//!
//! The inner loop of figure 3, with the structure of the normal solver: a conjugate-gradient step
//! on the cells taken to stick, while slip cells follow their slip, eq. (20); then cells beyond the
//! bound are cut to it and slip, those that fall inside stick, the stick cells share the missing
//! force. No preconditioner, no Newton steps: the baseline that [`solve_tangential`](super::solve_tangential)
//! is compared with. Where its sets cycle, projected gradients, which lower the energy in every
//! step, take over for some iterations.

use super::make_admissible;
use super::projected_gradient::ProjectedGradient;
use super::{TangentialInfo, TangentialParams, TangentialProblem, first_shift};
use crate::cells::{add_scaled, dot, length};
use crate::solvers::{Response, Shear, SolverError};

/// Buffers of the gradients, empty until they are needed.
#[derive(Debug, Default)]
pub(crate) struct GradientBuffers {
    residual: [Vec<f64>; 2],
    direction: [Vec<f64>; 2],
    q_before: [Vec<f64>; 2],
    change: [Vec<f64>; 2],
    response: [Vec<f64>; 2],
}

impl GradientBuffers {
    /// Resizes all fields to `cells` cells.
    fn allocate(&mut self, cells: usize) {
        for pair in [
            &mut self.residual,
            &mut self.direction,
            &mut self.q_before,
            &mut self.change,
            &mut self.response,
        ] {
            for field in pair {
                field.resize(cells, 0.0);
            }
        }
    }
}

/// Iterations without a smaller misfit after which the sets are taken to cycle.
const MOST_WITHOUT_GAIN: usize = 30;
/// Iterations of projected gradients after that: enough for a contact of some fifty cells across to
/// reach the tolerance.
const DESCENT: usize = 200;

/// Solves for the shear by conjugate gradients on the stick cells and projected steps on the slip cells. On
/// entry the shear must be admissible.
pub(crate) fn shear_gradient(
    response: &mut Response<'_>,
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    (descent, ws): (&mut ProjectedGradient, &mut GradientBuffers),
    params: &TangentialParams,
) -> Result<TangentialInfo, SolverError> {
    let cells = problem.bound.len();
    // Slip cells take the longest step that cannot overshoot: the inverse of the largest
    // eigenvalue.
    let slip_step = 1.0 / descent.largest_compliance(response, problem);
    ws.allocate(cells);
    let mut info = TangentialInfo::default();
    let mut last_product = 0.0;
    let (mut least_misfit, mut stalled) = (f64::INFINITY, 0);
    loop {
        if stalled < MOST_WITHOUT_GAIN {
            info.shift = first_shift(problem, shear);
        } else {
            info.shift = descent.iterate(response, problem, shear, DESCENT);
            info.passes += DESCENT;
            (least_misfit, stalled, last_product) = (f64::INFINITY, 0, 0.0);
        }
        let (slip_misfit, product) = slip_misfit(problem, shear, info.shift);
        info.misfit = slip_misfit;
        if slip_misfit <= params.tolerance {
            return Ok(info);
        }
        stalled = if slip_misfit < least_misfit {
            0
        } else {
            stalled + 1
        };
        least_misfit = least_misfit.min(slip_misfit);
        if info.iterations == params.max_iterations || response.must_stop() {
            return Err(SolverError {
                solver: "tangential",
                residual: slip_misfit,
                tolerance: params.tolerance,
                iterations: info.iterations,
            });
        }
        info.iterations += 1;
        info.passes += 1;

        ws.update_direction(problem, shear, info.shift, last_product);
        last_product = product;
        let step = ws.step_along_direction(response);
        ws.take_step(problem, shear, info.shift, [slip_step, step]);
        let ([change_x, change_y], [r_x, r_y]) = (&ws.change, &mut ws.response);
        response.respond_to_shear([change_x, change_y], [r_x, r_y]);
        for c in 0..2 {
            add_scaled(shear.u[c], 1.0, &ws.response[c]);
        }
    }
}

impl GradientBuffers {
    /// Chooses the next search direction on the stick cells (Polak-Ribiere: a change of the sets reduces the weight
    /// of the last one). `last_product` is the sum of squares of the last residual, zero to
    /// start again.
    fn update_direction(
        &mut self,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
        shift: [f64; 3],
        last_product: f64,
    ) {
        let sticks = |n: usize| problem.bound[n] > 0.0 && !shear.slips[n];
        let mut numerator = 0.0;
        for n in 0..problem.bound.len() {
            let slip = problem.slip(&shear.u, shift, n);
            for c in 0..2 {
                let residual = if sticks(n) { -slip[c] } else { 0.0 };
                numerator += residual * (residual - self.residual[c][n]);
                self.residual[c][n] = residual;
            }
        }
        let beta = if last_product > 0.0 {
            (numerator / last_product).max(0.0)
        } else {
            0.0
        };
        for n in 0..problem.bound.len() {
            for c in 0..2 {
                let direction = beta * self.direction[c][n] + self.residual[c][n];
                self.direction[c][n] = if sticks(n) { direction } else { 0.0 };
            }
        }
    }

    /// Length of the step to the least energy along the direction, over the length of the direction; zero where
    /// there is none.
    fn step_along_direction(&mut self, response: &mut Response<'_>) -> f64 {
        let ([d_x, d_y], [r_x, r_y]) = (&self.direction, &mut self.response);
        response.respond_to_shear([d_x, d_y], [r_x, r_y]);
        let product =
            |of: &[Vec<f64>; 2]| -> f64 { (0..2).map(|c| dot(&self.direction[c], &of[c])).sum() };
        let (slope, curvature) = (product(&self.residual), product(&self.response));
        if slope > 0.0 && curvature > 0.0 {
            slope / curvature
        } else {
            0.0
        }
    }

    /// Steps slip cells against their slip and the others along the direction; then makes the
    /// shear admissible; `change` is its change \[Pa\].
    fn take_step(
        &mut self,
        problem: &TangentialProblem<'_>,
        shear: &mut Shear<'_>,
        shift: [f64; 3],
        [slip_step, step]: [f64; 2],
    ) {
        for n in 0..problem.bound.len() {
            let g = problem.bound[n];
            let slip = problem.slip(&shear.u, shift, n);
            for c in 0..2 {
                self.q_before[c][n] = shear.q[c][n];
                shear.q[c][n] += if shear.slips[n] {
                    -slip_step * slip[c]
                } else {
                    step * self.direction[c][n]
                };
            }
            if g > 0.0 {
                shear.slips[n] = length([shear.q[0][n], shear.q[1][n]]) > g;
            }
        }
        make_admissible(problem, shear, shift);
        for c in 0..2 {
            let terms = self.change[c].iter_mut().zip(shear.q[c].iter());
            for ((change, q), before) in terms.zip(&self.q_before[c]) {
                *change = q - before;
            }
        }
    }
}

/// Root-mean-square violation of the slip conditions \[m\]: the slip of stick cells; of slip cells
/// the part across q, and along q where friction would push. Also the sum of squares on stick.
fn slip_misfit(problem: &TangentialProblem<'_>, shear: &Shear<'_>, shift: [f64; 3]) -> (f64, f64) {
    let (mut stick, mut slipping, mut count) = (0.0, 0.0, 0);
    for n in 0..problem.bound.len() {
        let g = problem.bound[n];
        if g <= 0.0 {
            continue;
        }
        count += 1;
        let slip = problem.slip(&shear.u, shift, n);
        if shear.slips[n] {
            let e = [shear.q[0][n] / g, shear.q[1][n] / g];
            let along = slip[0] * e[0] + slip[1] * e[1];
            let across = slip[0] * e[1] - slip[1] * e[0];
            slipping += across * across + along.max(0.0).powi(2);
        } else {
            stick += slip[0] * slip[0] + slip[1] * slip[1];
        }
    }
    (((stick + slipping) / f64::from(count.max(1))).sqrt(), stick)
}
