//! One Newton step of the tangential problem: the linear system on the tangent space.

use rayon::prelude::*;

use super::Response;
use super::contact_cells::ContactCells;
use super::rigid_motion::{add, inverse, product};
use super::shear::{Shear, TangentialProblem};
use super::vector::{CHUNK, add_scaled, set_and_sum, set_pairs, sum, sum_cells};

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
    residual_norm: f64,
    z: Pair,
    direction: Pair,
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
            residual_norm: 0.0,
            z: pair(),
            direction: pair(),
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
        ] {
            for field in pair {
                field.resize(count, 0.0);
            }
        }
        let [t_x, t_y] = &mut self.traction;
        set_pairs([t_x, t_y], |_, _| [0.0; 2]);
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
        let (behind, squares) = t.project(&mut self.residual, |_, r| r, |_, [x, y]| x * x + y * y);
        self.residual_norm = squares.sqrt();
        add(shift, behind.map(|s| -s))
    }

    /// Norm of the residual \[m\], root of the sum of squares.
    pub(crate) fn residual_norm(&self) -> f64 {
        self.residual_norm
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
        for [a, b] in [&mut self.x, &mut self.response_x] {
            set_pairs([a, b], |_, _| [0.0; 2]);
        }
        let mut last_product = 0.0;
        for pass in 0..max_passes {
            if self.residual_norm <= target || response.stopped() {
                return pass;
            }
            let product = self.precondition(response, contact);
            let beta = if pass == 0 {
                0.0
            } else {
                product / last_product
            };
            last_product = product;
            let ([d_x, d_y], z) = (&mut self.direction, &self.z);
            set_pairs([d_x, d_y], |i, [x, y]| {
                [z[0][i] + beta * x, z[1][i] + beta * y]
            });
            contact.unpack_pair(&self.direction, &mut self.traction);
            let [d_x, d_y] = &self.traction;
            let [u_x, u_y] = &mut self.displacement;
            response.tangential([d_x, d_y], [u_x, u_y]);
            // z = Pi (C + D) d; d lies in the tangent space.
            contact.pack_pair(&self.displacement, &mut self.z);
            let (d, diagonal) = (&self.direction, &self.diagonal);
            let (_, curvature) = self.tangent.project(
                &mut self.z,
                |i, [x, y]| [x + diagonal[i] * d[0][i], y + diagonal[i] * d[1][i]],
                |i, [x, y]| x * d[0][i] + y * d[1][i],
            );
            if !(curvature > 0.0 && product > 0.0) {
                return pass + 1;
            }
            let step = product / curvature;
            let add_to = |sum: &mut Pair, change: &Pair| {
                let [x, y] = sum;
                set_pairs([x, y], |n, [x, y]| {
                    [x + step * change[0][n], y + step * change[1][n]]
                });
            };
            add_to(&mut self.x, &self.direction);
            add_to(&mut self.response_x, &self.displacement);
            let ([r_x, r_y], z) = (&mut self.residual, &self.z);
            let [squares] = set_and_sum([r_x, r_y], |i, [x, y]| {
                let r = [x - step * z[0][i], y - step * z[1][i]];
                (r, [r[0] * r[0] + r[1] * r[1]])
            });
            self.residual_norm = squares.sqrt();
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

    /// z = Pi S P S r; returns r.z.
    fn precondition(&mut self, response: &mut Response<'_>, contact: &ContactCells) -> f64 {
        let (r, scale) = (&self.residual, &self.scale);
        let [z_x, z_y] = &mut self.z;
        set_pairs([z_x, z_y], |i, _| [scale[i] * r[0][i], scale[i] * r[1][i]]);
        contact.unpack_pair(&self.z, &mut self.traction);
        let [s_x, s_y] = &self.traction;
        let [z_x, z_y] = &mut self.displacement;
        response.invert_tangential([s_x, s_y], [z_x, z_y]);
        contact.pack_pair(&self.displacement, &mut self.z);
        let (_, product) = self.tangent.project(
            &mut self.z,
            |i, [x, y]| [scale[i] * x, scale[i] * y],
            |i, [x, y]| r[0][i] * x + r[1][i] * y,
        );
        product
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
        let sums = self.tangent.sums(|i| {
            let slip = problem.slip(&shear.u, given, i);
            [
                slip[0] + diagonal[i] * x[0][i],
                slip[1] + diagonal[i] * x[1][i],
            ]
        });
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

    /// Projects the values made of v on the tangent space and on B^T v = 0; returns the motion B that
    /// is taken out, and the sum of what `term` makes of the result.
    fn project(
        &self,
        v: &mut Pair,
        value: impl Fn(usize, [f64; 2]) -> [f64; 2] + Sync,
        term: impl Fn(usize, [f64; 2]) -> f64 + Sync,
    ) -> ([f64; 3], f64) {
        let [v_x, v_y] = v;
        let sums = set_and_sum([v_x, v_y], |i, v| {
            let v = self.in_cell(i, value(i, v));
            (v, self.motion_of(i, v))
        });
        let shift = product(&self.inverse_sum, sums);
        let [sum] = set_and_sum([v_x, v_y], |i, v| {
            let rigid = match (self.arm_x.get(i), self.arm_y.get(i)) {
                (Some(x), Some(y)) => [shift[0] - y * shift[2], shift[1] + x * shift[2]],
                _ => [shift[0], shift[1]],
            };
            let rigid = self.in_cell(i, rigid);
            let v = [v[0] - rigid[0], v[1] - rigid[1]];
            (v, [term(i, v)])
        });
        (shift, sum)
    }

    /// B^T Pi v
    fn sums(&self, v: impl Fn(usize) -> [f64; 2] + Sync) -> [f64; 3] {
        sum_cells(self.xx.len(), |i| self.motion_of(i, self.in_cell(i, v(i))))
    }

    /// The part of v in the tangent space of a cell.
    fn in_cell(&self, i: usize, [a, b]: [f64; 2]) -> [f64; 2] {
        let (xx, xy, yy) = (self.xx[i], self.xy[i], self.yy[i]);
        [xx * a + xy * b, xy * a + yy * b]
    }

    /// B^T v of a cell.
    fn motion_of(&self, i: usize, [a, b]: [f64; 2]) -> [f64; 3] {
        let turn = match (self.arm_x.get(i), self.arm_y.get(i)) {
            (Some(x), Some(y)) => x * b - y * a,
            _ => 0.0,
        };
        [a, b, turn]
    }
}
