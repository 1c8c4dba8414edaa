//! Accelerated projected gradients for the tangential problem: slow, but every step lowers the
//! energy.
//! The Newton method switches to this one when a step would raise the energy, which happens when many
//! cells change between stick and slip at once. Y. Nesterov's acceleration with restart
//! (B. O'Donoghue, E. Candes, Found. Comput. Math. 15 (2015) 715-732) on the convex set
//! |q| <= g, B^T q = loads.

use super::TangentialProblem;
use super::admissible::{mark_circle, project_to_admissible};
use crate::cells::add_vectors;
use crate::solvers::{Response, Shear};

type Pair = [Vec<f64>; 2];

/// Buffers of the projected gradients, empty until they are needed.
#[derive(Debug, Default)]
pub(crate) struct ProjectedGradient {
    /// Point that the gradient is taken at, ahead of q, and its displacement.
    ahead: Pair,
    u_ahead: Pair,
    q_last: Pair,
    u_last: Pair,
}

impl ProjectedGradient {
    /// Resizes all fields to `cells` cells.
    fn allocate(&mut self, cells: usize) {
        for pair in [
            &mut self.ahead,
            &mut self.u_ahead,
            &mut self.q_last,
            &mut self.u_last,
        ] {
            for field in pair {
                field.resize(cells, 0.0);
            }
        }
    }

    /// Does `passes` iterations, one convolution each, and one more; sets the slip set to the cells
    /// on the circle and returns the rigid motion \[m\], the multiplier of the loads.
    pub(crate) fn iterate(
        &mut self,
        response: &mut Response<'_>,
        problem: &TangentialProblem<'_>,
        shear: &mut Shear<'_>,
        passes: usize,
    ) -> [f64; 3] {
        let mut stiffness = 1.0 / self.largest_compliance(response, problem);
        for c in 0..2 {
            self.ahead[c].copy_from_slice(shear.q[c]);
            self.u_ahead[c].copy_from_slice(shear.u[c]);
        }
        let mut momentum = 1.0_f64;
        let mut shift = [0.0; 3];
        for _ in 0..passes {
            self.step(response, problem, shear, stiffness, &mut shift);
            // The sum of the change is zero only up to rounding, so that the shift is left out of
            // the energy.
            let rigid_motion = shift.map(|s| s / stiffness);
            let [change_size, curvature, descent] = self.add_response(problem, shear, rigid_motion);
            response.count_change(change_size);
            if change_size == 0.0 || response.must_stop() {
                break;
            }
            // The step must not exceed the inverse of the compliance along the change.
            stiffness = stiffness.min(change_size / curvature.max(f64::MIN_POSITIVE));
            if descent > 0.0 {
                // The energy has risen: return to the last point and restart without momentum.
                for c in 0..2 {
                    shear.q[c].copy_from_slice(&self.q_last[c]);
                    shear.u[c].copy_from_slice(&self.u_last[c]);
                }
                momentum = 1.0;
            }
            let next_momentum = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
            let beta = (momentum - 1.0) / next_momentum;
            momentum = next_momentum;
            self.extrapolate(shear, beta);
        }
        mark_circle(problem, &shear.q, shear.slips);
        add_vectors(problem.drive.given, shift.map(|s| -s / stiffness))
    }

    /// A projected step along the gradient from the extrapolated point. On exit `ahead` holds the
    /// change of the shear \[Pa\] and `shear.u` its response \[m\].
    fn step(
        &mut self,
        response: &mut Response<'_>,
        problem: &TangentialProblem<'_>,
        shear: &mut Shear<'_>,
        stiffness: f64,
        shift: &mut [f64; 3],
    ) {
        for c in 0..2 {
            self.q_last[c].copy_from_slice(shear.q[c]);
            self.u_last[c].copy_from_slice(shear.u[c]);
            for n in 0..problem.bound.len() {
                let slip = self.u_ahead[c][n] - displacement_without_slip(problem, c, n);
                shear.q[c][n] = self.ahead[c][n] - stiffness * slip;
            }
        }
        project_to_admissible(problem, &mut shear.q, shift);
        for c in 0..2 {
            for n in 0..problem.bound.len() {
                self.ahead[c][n] = shear.q[c][n] - self.q_last[c][n];
            }
        }
        let ([change_x, change_y], [u_x, u_y]) = (&self.ahead, &mut shear.u);
        response.respond_to_shear([change_x, change_y], [u_x, u_y]);
    }

    /// Adds the last displacements to the response in `shear.u`. Returns three sums over the cells:
    /// change squared, change times response, and the change of the energy, in which the `rigid`
    /// motion \[m\] is left out.
    fn add_response(
        &self,
        problem: &TangentialProblem<'_>,
        shear: &mut Shear<'_>,
        rigid: [f64; 3],
    ) -> [f64; 3] {
        let (mut squares, mut curvature, mut descent) = (0.0, 0.0, 0.0);
        for c in 0..2 {
            for n in 0..problem.bound.len() {
                let (change, response) = (self.ahead[c][n], shear.u[c][n]);
                squares += change * change;
                curvature += change * response;
                let rigid = problem.arms.displacement_in_plane(rigid, n)[c];
                let before = self.u_last[c][n] - displacement_without_slip(problem, c, n) + rigid;
                descent += change * (before + 0.5 * response);
                shear.u[c][n] = self.u_last[c][n] + response;
            }
        }
        [squares, curvature, descent]
    }

    /// Extrapolates the last change by `beta`: the point from which the next step starts.
    fn extrapolate(&mut self, shear: &Shear<'_>, beta: f64) {
        for c in 0..2 {
            for (n, (&q, &u)) in shear.q[c].iter().zip(&*shear.u[c]).enumerate() {
                self.ahead[c][n] = q + beta * (q - self.q_last[c][n]);
                self.u_ahead[c][n] = u + beta * (u - self.u_last[c][n]);
            }
        }
    }

    /// Estimate of the largest eigenvalue of C_tt on the contact \[m/Pa\]: the largest displacement
    /// under unit shear.
    pub(crate) fn largest_compliance(
        &mut self,
        response: &mut Response<'_>,
        problem: &TangentialProblem<'_>,
    ) -> f64 {
        self.allocate(problem.bound.len());
        for (a, g) in self.ahead[0].iter_mut().zip(problem.bound) {
            *a = f64::from(u8::from(*g > 0.0));
        }
        self.ahead[1].fill(0.0);
        let [a_x, a_y] = &self.ahead;
        let [u_x, u_y] = &mut self.u_ahead;
        response.respond_to_shear([a_x, a_y], [u_x, u_y]);
        self.u_ahead[0]
            .iter()
            .fold(f64::MIN_POSITIVE, |m, u| m.max(*u))
    }
}

/// The displacement of a cell without slip, with the prescribed motions \[m\].
fn displacement_without_slip(problem: &TangentialProblem<'_>, c: usize, n: usize) -> f64 {
    problem.no_slip[c][n] + problem.arms.displacement_in_plane(problem.drive.given, n)[c]
}
