//! One Newton step of the tangential problem: the linear system on the tangent space.

use rayon::prelude::*;

use super::Response;
use super::contact_cells::ContactCells;
use super::rigid_motion::{add, inverse, product};
use super::shear::{Shear, TangentialProblem};
use super::vector::{CHUNK, add_scaled, dot, set_pairs, sum};

type Pair = [Vec<f64>; 2];

/// The linear system
///
/// ```text
/// find x in the tangent space, B^T x = 0:   Pi (C x + D x + ds) = Pi B d(delta)'
/// ```
///
/// with B the rigid motions that are free, Pi the projection on the tangent space (stick cells:
/// both components; slip cells: across q) and D the curvature |ds|/g of the circle, less the part of it
/// by which u_ref turns with q ([`TangentialProblem::turning`]). The unknowns are packed contact cells;
/// what goes through the operator covers the grid.
#[derive(Debug)]
pub(crate) struct NewtonStep {
    tangent: Tangent,
    /// D \[m/Pa\].
    diagonal: Vec<f64>,
    /// S = (1 + D/C_xx(0,0))^(-1/2).
    scale: Vec<f64>,
    /// Solution \[Pa\].
    x: Pair,
    residual: Pair,
    z: Pair,
    direction: Pair,
    response_direction: Pair,
    /// C x, and C times what was added to x, \[m\] on the grid.
    pub(crate) response_x: Pair,
    /// Traction and displacement on the grid.
    traction: Pair,
    displacement: Pair,
}

/// The projection on the tangent space and on sums of zero.
#[derive(Debug)]
struct Tangent {
    xx: Vec<f64>,
    xy: Vec<f64>,
    yy: Vec<f64>,
    /// Inverse of B^T Pi B, Pi the projection on the tangent space of each cell.
    inverse_sum: [[f64; 3]; 3],
    /// Lever arms of the contact cells; empty where the rotation is not free.
    arm_x: Vec<f64>,
    arm_y: Vec<f64>,
}

impl NewtonStep {
    pub(crate) fn new(cells: usize) -> Self {
        let field = || Vec::with_capacity(cells);
        let pair = || [field(), field()];
        let on_grid = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            tangent: Tangent {
                xx: field(),
                xy: field(),
                yy: field(),
                inverse_sum: [[0.0; 3]; 3],
                arm_x: field(),
                arm_y: field(),
            },
            diagonal: field(),
            scale: field(),
            x: pair(),
            residual: pair(),
            z: pair(),
            direction: pair(),
            response_direction: pair(),
            response_x: on_grid(),
            traction: on_grid(),
            displacement: on_grid(),
        }
    }

    /// Makes room for the contact cells.
    pub(crate) fn set_contact(&mut self, problem: &TangentialProblem<'_>) {
        let count = problem.bound.len();
        let t = &mut self.tangent;
        for field in [
            &mut t.xx,
            &mut t.xy,
            &mut t.yy,
            &mut self.diagonal,
            &mut self.scale,
        ] {
            field.resize(count, 0.0);
        }
        t.arm_x.clear();
        t.arm_y.clear();
        if problem.drive.free[2] {
            t.arm_x.extend((0..count).map(|i| problem.arms.turn_x(i)));
            t.arm_y.extend_from_slice(&problem.arms.y);
        }
        for pair in [
            &mut self.x,
            &mut self.residual,
            &mut self.z,
            &mut self.direction,
            &mut self.response_direction,
        ] {
            for field in pair {
                field.resize(count, 0.0);
            }
        }
        for field in &mut self.traction {
            field.fill(0.0);
        }
    }

    /// Tangent space, curvature and residual at the present shear and slip; x starts from zero.
    /// Returns the shift that fits the tangent space best, which the residual is that of.
    pub(crate) fn linearise(
        &mut self,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
        shift: [f64; 3],
        c_xx: f64,
    ) -> [f64; 3] {
        let t = &mut self.tangent;
        let [residual_x, residual_y] = &mut self.residual;
        let chunks = (
            t.xx.par_chunks_mut(CHUNK),
            t.xy.par_chunks_mut(CHUNK),
            t.yy.par_chunks_mut(CHUNK),
            self.diagonal.par_chunks_mut(CHUNK),
            self.scale.par_chunks_mut(CHUNK),
            residual_x.par_chunks_mut(CHUNK),
            residual_y.par_chunks_mut(CHUNK),
        );
        let chunks = chunks.into_par_iter().enumerate();
        chunks.for_each(|(chunk, (xx, xy, yy, diagonal, scale, r_x, r_y))| {
            for i in 0..xx.len() {
                let n = chunk * CHUNK + i;
                let slip = problem.slip(&shear.u, shift, n);
                (xx[i], xy[i], yy[i], diagonal[i]) = (1.0, 0.0, 1.0, 0.0);
                if shear.slip[n] {
                    let g = problem.bound[n];
                    let e = [shear.q[0][n] / g, shear.q[1][n] / g];
                    let against = -(slip[0] * e[0] + slip[1] * e[1]);
                    (xx[i], xy[i], yy[i]) = (e[1] * e[1], -e[0] * e[1], e[0] * e[0]);
                    let turning = problem.turning.get(n).copied().unwrap_or(0.0);
                    diagonal[i] = (1.0 - turning) * against.max(0.0) / g;
                }
                scale[i] = 1.0 / (1.0 + diagonal[i] / c_xx).sqrt();
                (r_x[i], r_y[i]) = (-slip[0], -slip[1]);
            }
        });
        t.inverse_sum = inverse(t.gram(), problem.drive.free);
        let behind = t.project(&mut self.residual);
        add(shift, behind.map(|s| -s))
    }

    /// Norm of the residual \[m\], root of the sum of squares.
    pub(crate) fn residual_norm(&self) -> f64 {
        dot_pair(&self.residual, &self.residual).sqrt()
    }

    /// Conjugate gradients until the residual norm is below `target` or `max_passes` are done;
    /// returns the passes.
    pub(crate) fn solve(
        &mut self,
        response: &mut Response<'_>,
        contact: &ContactCells,
        target: f64,
        max_passes: usize,
    ) -> usize {
        for c in 0..2 {
            self.x[c].fill(0.0);
            self.response_x[c].fill(0.0);
        }
        let mut last_product = 0.0;
        for pass in 0..max_passes {
            if self.residual_norm() <= target || response.stopped() {
                return pass;
            }
            self.precondition(response, contact);
            let product = dot_pair(&self.residual, &self.z);
            let beta = if pass == 0 {
                0.0
            } else {
                product / last_product
            };
            last_product = product;
            for c in 0..2 {
                for (d, z) in self.direction[c].iter_mut().zip(&self.z[c]) {
                    *d = z + beta * *d;
                }
                contact.unpack(&self.direction[c], &mut self.traction[c]);
            }
            let [d_x, d_y] = &self.traction;
            let [u_x, u_y] = &mut self.displacement;
            response.tangential([d_x, d_y], [u_x, u_y]);
            // z = Pi (C + D) d; d lies in the tangent space.
            for c in 0..2 {
                contact.pack(&self.displacement[c], &mut self.response_direction[c]);
                let terms = self.z[c].iter_mut().zip(&self.response_direction[c]);
                for ((z, r), (d, k)) in terms.zip(self.direction[c].iter().zip(&self.diagonal)) {
                    *z = r + k * d;
                }
            }
            self.tangent.project(&mut self.z);
            let curvature = dot_pair(&self.direction, &self.z);
            if !(curvature > 0.0 && product > 0.0) {
                return pass + 1;
            }
            let step = product / curvature;
            for c in 0..2 {
                add_scaled(&mut self.x[c], step, &self.direction[c]);
                add_scaled(&mut self.response_x[c], step, &self.displacement[c]);
                add_scaled(&mut self.residual[c], -step, &self.z[c]);
            }
        }
        max_passes
    }

    /// C times a change of the contact cells, in place; it is added to what x causes.
    pub(crate) fn respond(
        &mut self,
        response: &mut Response<'_>,
        contact: &ContactCells,
        change: &mut Pair,
    ) {
        for c in 0..2 {
            contact.unpack(&change[c], &mut self.traction[c]);
        }
        let [q_x, q_y] = &self.traction;
        let [u_x, u_y] = &mut self.displacement;
        response.tangential([q_x, q_y], [u_x, u_y]);
        for c in 0..2 {
            contact.pack(&self.displacement[c], &mut change[c]);
            add_scaled(&mut self.response_x[c], 1.0, &self.displacement[c]);
        }
    }

    /// z = Pi S P S r
    fn precondition(&mut self, response: &mut Response<'_>, contact: &ContactCells) {
        for c in 0..2 {
            let scaled = self.z[c].iter_mut().zip(&self.scale);
            for ((z, scale), r) in scaled.zip(&self.residual[c]) {
                *z = scale * r;
            }
            contact.unpack(&self.z[c], &mut self.traction[c]);
        }
        let [s_x, s_y] = &self.traction;
        let [z_x, z_y] = &mut self.displacement;
        response.invert_tangential([s_x, s_y], [z_x, z_y]);
        for c in 0..2 {
            contact.pack(&self.displacement[c], &mut self.z[c]);
            for (z, scale) in self.z[c].iter_mut().zip(&self.scale) {
                *z *= scale;
            }
        }
        self.tangent.project(&mut self.z);
    }

    /// Adds x and C x to the shear; returns the shift that the equations of the tangent space ask
    /// for there.
    pub(crate) fn take(
        &mut self,
        contact: &ContactCells,
        problem: &TangentialProblem<'_>,
        shear: &mut Shear<'_>,
    ) -> [f64; 3] {
        let given = problem.drive.given;
        for c in 0..2 {
            contact.pack(&self.response_x[c], &mut self.z[c]);
            add_scaled(shear.u[c], 1.0, &self.z[c]);
            add_scaled(shear.q[c], 1.0, &self.x[c]);
        }
        let (x, diagonal) = (&self.x, &self.diagonal);
        let [z_x, z_y] = &mut self.z;
        set_pairs([z_x, z_y], |i, _| {
            let slip = problem.slip(&shear.u, given, i);
            [
                slip[0] + diagonal[i] * x[0][i],
                slip[1] + diagonal[i] * x[1][i],
            ]
        });
        let sums = self.tangent.project_cells(&mut self.z);
        add(given, product(&self.tangent.inverse_sum, sums))
    }
}

impl Tangent {
    /// B^T Pi B
    fn gram(&self) -> [[f64; 3]; 3] {
        let (xx, xy, yy) = (sum(&self.xx), sum(&self.xy), sum(&self.yy));
        let (mut xr, mut yr, mut rr) = (0.0, 0.0, 0.0);
        for (i, (x, y)) in self.arm_x.iter().zip(&self.arm_y).enumerate() {
            // The rotation moves the cell by (-y, x); Pi leaves r of it.
            let r = [
                self.xy[i] * x - self.xx[i] * y,
                self.yy[i] * x - self.xy[i] * y,
            ];
            xr += r[0];
            yr += r[1];
            rr += x * r[1] - y * r[0];
        }
        [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]]
    }

    /// Projects on the tangent space and on B^T v = 0; returns the motion B that is taken out.
    fn project(&self, v: &mut Pair) -> [f64; 3] {
        let sums = self.project_cells(v);
        let shift = product(&self.inverse_sum, sums);
        let (xx, xy, yy) = (&self.xx[..], &self.xy[..], &self.yy[..]);
        let n = xx.len();
        let [v_x, v_y] = v;
        let (v_x, v_y, xy, yy) = (&mut v_x[..n], &mut v_y[..n], &xy[..n], &yy[..n]);
        if self.arm_x.is_empty() {
            for i in 0..n {
                v_x[i] -= xx[i] * shift[0] + xy[i] * shift[1];
                v_y[i] -= xy[i] * shift[0] + yy[i] * shift[1];
            }
        } else {
            for i in 0..n {
                let a = shift[0] - self.arm_y[i] * shift[2];
                let b = shift[1] + self.arm_x[i] * shift[2];
                v_x[i] -= xx[i] * a + xy[i] * b;
                v_y[i] -= xy[i] * a + yy[i] * b;
            }
        }
        shift
    }

    /// Projects on the tangent space of each cell; returns B^T v.
    fn project_cells(&self, v: &mut Pair) -> [f64; 3] {
        let (xx, xy, yy) = (&self.xx[..], &self.xy[..], &self.yy[..]);
        let n = xx.len();
        let [v_x, v_y] = v;
        let (v_x, v_y, xy, yy) = (&mut v_x[..n], &mut v_y[..n], &xy[..n], &yy[..n]);
        for i in 0..n {
            let (a, b) = (v_x[i], v_y[i]);
            v_x[i] = xx[i] * a + xy[i] * b;
            v_y[i] = xy[i] * a + yy[i] * b;
        }
        let moment = if self.arm_x.is_empty() {
            0.0
        } else {
            dot(&self.arm_x, v_y) - dot(&self.arm_y, v_x)
        };
        [sum(v_x), sum(v_y), moment]
    }
}

fn dot_pair(a: &Pair, b: &Pair) -> f64 {
    dot(&a[0], &b[0]) + dot(&a[1], &b[1])
}
