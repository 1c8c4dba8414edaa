//! One Newton step of the tangential problem: the linear system on the tangent space.

use super::Response;
use super::tangential::{Shear, TangentialProblem};
use super::vector::{add_scaled, dot};

type Pair = [Vec<f64>; 2];

/// The linear system
///
/// ```text
/// find x in the tangent space, sum x = 0:   Pi (C x + D x + ds) = Pi d(delta)'
/// ```
///
/// with Pi the projection on the tangent space (stick cells: both components; slip cells: across
/// q) and D the curvature |ds|/g of the circle.
#[derive(Debug)]
pub(crate) struct NewtonStep {
    /// Entries xx, xy, yy of the projection in each cell.
    tangent: [Vec<f64>; 3],
    /// D \[m/Pa\].
    diagonal: Vec<f64>,
    /// S = (1 + D/C_xx(0,0))^(-1/2).
    scale: Vec<f64>,
    /// Slip of the state that is linearised \[m\].
    slip: Pair,
    /// Inverse of the sum of the projections over the cells: xx, xy, yy.
    inverse_sum: [f64; 3],
    /// Solution \[Pa\].
    pub(crate) x: Pair,
    /// C x \[m\].
    pub(crate) response_x: Pair,
    residual: Pair,
    z: Pair,
    direction: Pair,
    response_direction: Pair,
}

impl NewtonStep {
    pub(crate) fn new(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        let pair = || [field(), field()];
        Self {
            tangent: [field(), field(), field()],
            diagonal: field(),
            scale: field(),
            slip: pair(),
            inverse_sum: [0.0; 3],
            x: pair(),
            response_x: pair(),
            residual: pair(),
            z: pair(),
            direction: pair(),
            response_direction: pair(),
        }
    }

    /// Tangent space and curvature at the present shear and slip.
    pub(crate) fn linearise(
        &mut self,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
        shift: [f64; 2],
    ) {
        let mut sum = [0.0; 3];
        for n in 0..problem.bound.len() {
            let g = problem.bound[n];
            let slip: [f64; 2] =
                std::array::from_fn(|c| shear.u[c][n] - problem.u_ref[c][n] - shift[c]);
            let (tangent, diagonal) = if g <= 0.0 {
                ([0.0, 0.0, 0.0], 0.0)
            } else if shear.slip[n] {
                let e = [shear.q[0][n] / g, shear.q[1][n] / g];
                let against = -(slip[0] * e[0] + slip[1] * e[1]);
                (
                    [e[1] * e[1], -e[0] * e[1], e[0] * e[0]],
                    against.max(0.0) / g,
                )
            } else {
                ([1.0, 0.0, 1.0], 0.0)
            };
            for (k, t) in tangent.into_iter().enumerate() {
                self.tangent[k][n] = t;
                sum[k] += t;
            }
            self.diagonal[n] = diagonal;
            self.slip[0][n] = slip[0];
            self.slip[1][n] = slip[1];
        }
        self.inverse_sum = invert(sum, problem.free);
    }

    /// Starts from x = 0: the residual is the projected slip.
    pub(crate) fn start(&mut self, response: &Response<'_>) {
        let (c_xx, _) = response.op.self_coefficients();
        for (scale, d) in self.scale.iter_mut().zip(&self.diagonal) {
            *scale = 1.0 / (1.0 + d / c_xx).sqrt();
        }
        for c in 0..2 {
            self.x[c].fill(0.0);
            self.response_x[c].fill(0.0);
            self.residual[c]
                .iter_mut()
                .zip(&self.slip[c])
                .for_each(|(r, s)| *r = -s);
        }
        let mut residual = std::mem::take(&mut self.residual);
        self.project(&mut residual);
        self.residual = residual;
    }

    /// Norm of the residual \[m\], root of the sum of squares.
    pub(crate) fn residual_norm(&self) -> f64 {
        (dot(&self.residual[0], &self.residual[0]) + dot(&self.residual[1], &self.residual[1]))
            .sqrt()
    }

    /// Conjugate gradients until the residual norm is below `target` or `max_passes` are done;
    /// returns the passes.
    pub(crate) fn solve(
        &mut self,
        response: &mut Response<'_>,
        target: f64,
        max_passes: usize,
    ) -> usize {
        let mut last_product = 0.0;
        for pass in 0..max_passes {
            if self.residual_norm() <= target {
                return pass;
            }
            let product = self.precondition(response);
            let beta = if pass == 0 {
                0.0
            } else {
                product / last_product
            };
            last_product = product;
            for c in 0..2 {
                let terms = self.direction[c].iter_mut().zip(&self.z[c]);
                terms.for_each(|(d, z)| *d = z + beta * *d);
            }
            let [d_x, d_y] = &self.direction;
            let [r_x, r_y] = &mut self.response_direction;
            response.tangential([d_x, d_y], [r_x, r_y]);
            let mut curvature = 0.0;
            for c in 0..2 {
                for n in 0..self.diagonal.len() {
                    let d = self.direction[c][n];
                    curvature += d * (self.response_direction[c][n] + self.diagonal[n] * d);
                }
            }
            if !(curvature > 0.0 && product > 0.0) {
                return pass + 1;
            }
            let step = product / curvature;
            for c in 0..2 {
                add_scaled(&mut self.x[c], step, &self.direction[c]);
                add_scaled(&mut self.response_x[c], step, &self.response_direction[c]);
                for n in 0..self.diagonal.len() {
                    let change =
                        self.response_direction[c][n] + self.diagonal[n] * self.direction[c][n];
                    self.z[c][n] = change;
                }
            }
            let mut change = std::mem::take(&mut self.z);
            self.project(&mut change);
            self.z = change;
            for c in 0..2 {
                add_scaled(&mut self.residual[c], -step, &self.z[c]);
            }
        }
        max_passes
    }

    /// z = Pi S P S r; returns r . z.
    fn precondition(&mut self, response: &mut Response<'_>) -> f64 {
        for c in 0..2 {
            for n in 0..self.scale.len() {
                self.response_direction[c][n] = self.scale[n] * self.residual[c][n];
            }
        }
        let mut z = std::mem::take(&mut self.z);
        let [z_x, z_y] = &mut z;
        let [s_x, s_y] = &self.response_direction;
        response.invert_tangential([s_x, s_y], [z_x, z_y]);
        for z in &mut z {
            z.iter_mut().zip(&self.scale).for_each(|(z, s)| *z *= s);
        }
        self.project(&mut z);
        self.z = z;
        dot(&self.residual[0], &self.z[0]) + dot(&self.residual[1], &self.z[1])
    }

    /// The shift that the equations of the tangent space ask for after the step, with u updated.
    pub(crate) fn shift(&self, problem: &TangentialProblem<'_>, shear: &Shear<'_>) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for n in 0..self.diagonal.len() {
            let [xx, xy, yy] = [0, 1, 2].map(|k| self.tangent[k][n]);
            let v: [f64; 2] = std::array::from_fn(|c| {
                shear.u[c][n] - problem.u_ref[c][n] + self.diagonal[n] * self.x[c][n]
            });
            sum[0] += xx * v[0] + xy * v[1];
            sum[1] += xy * v[0] + yy * v[1];
        }
        self.solve_sum(sum)
    }

    fn solve_sum(&self, sum: [f64; 2]) -> [f64; 2] {
        let [xx, xy, yy] = self.inverse_sum;
        [xx * sum[0] + xy * sum[1], xy * sum[0] + yy * sum[1]]
    }

    /// Projects on the tangent space and on sum = 0.
    fn project(&self, v: &mut Pair) {
        let [v_x, v_y] = v;
        let mut sum = [0.0; 2];
        for n in 0..self.diagonal.len() {
            let [xx, xy, yy] = [0, 1, 2].map(|k| self.tangent[k][n]);
            let (a, b) = (xx * v_x[n] + xy * v_y[n], xy * v_x[n] + yy * v_y[n]);
            v_x[n] = a;
            v_y[n] = b;
            sum[0] += a;
            sum[1] += b;
        }
        let shift = self.solve_sum(sum);
        for n in 0..self.diagonal.len() {
            let [xx, xy, yy] = [0, 1, 2].map(|k| self.tangent[k][n]);
            v_x[n] -= xx * shift[0] + xy * shift[1];
            v_y[n] -= xy * shift[0] + yy * shift[1];
        }
    }
}

/// Inverse of the symmetric 2 x 2 matrix (xx, xy, yy) on the free shifts, zero on the others.
fn invert([xx, xy, yy]: [f64; 3], free: [bool; 2]) -> [f64; 3] {
    let reciprocal = |v: f64| if v > 0.0 { 1.0 / v } else { 0.0 };
    match free {
        [false, false] => [0.0; 3],
        [true, false] => [reciprocal(xx), 0.0, 0.0],
        [false, true] => [0.0, 0.0, reciprocal(yy)],
        [true, true] => {
            let det = xx * yy - xy * xy;
            if det > 0.0 {
                [yy / det, -xy / det, xx / det]
            } else {
                [0.0; 3]
            }
        }
    }
}
