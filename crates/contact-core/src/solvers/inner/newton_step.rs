//! One Newton step of the tangential problem: the linear system on the tangent space.

use super::{Shear, TangentialProblem};
use crate::cells::ContactCells;
use crate::cells::{add, inverse, product};
use crate::cells::{set, sums, sweep};
use crate::solvers::Response;

type Pair = [Vec<f64>; 2];

/// The eigenvalue c_0 at which the guess of the inverse is right, over C_xx(0,0).
const RIGHT: f64 = 2.0;

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
///
/// With P the inverse of C, and c an eigenvalue of C, the guess of the inverse is S P S + A,
///
/// ```text
/// 1/(c + D) ~ s^2 / c + (1 - s^2)/(c_0 + max(D, d)),    s^2 = max(0, (1 - D/d)/(1 + D/c_0))
/// ```
///
/// with equality for c = c_0 = 2 C_xx(0,0), and d = 2 C_xx(0,0) times the root of the cells across the
/// contact, about the geometric mean of the eigenvalues of the shortest and the longest waves; both factors
/// are those that took the fewest passes. At the rim D has no bound, and there a cell must not hear of the
/// others through P: the little that it would move too far is D times as much in the residual.
#[derive(Debug)]
pub(crate) struct NewtonStep {
    tangent: Tangent,
    /// D \[m/Pa\].
    diagonal: Vec<f64>,
    /// S \[1\] and A \[Pa/m\] of the guess S P S + A of (C + D)^-1.
    scale: Vec<f64>,
    alone: Vec<f64>,
    /// Solution \[Pa\].
    x: Pair,
    residual: Pair,
    residual_norm: f64,
    z: Pair,
    direction: Pair,
    /// C x, and C times what was added to x, \[m\] on the grid.
    response_x: Pair,
    /// Traction and displacement on the grid.
    traction: Pair,
    displacement: Pair,
}

/// The tangent space: the projection Pi on it, and what is left of tractions whose sums are to be zero
/// and of displacements up to a rigid motion.
///
/// Where the curvature D is large a cell hardly gives way: a motion taken out of all cells alike would
/// be far more than it can follow. It counts with the weight w = 1/(1 + D/C_xx(0,0)): tractions t become
/// t - w Pi B m with B^T t = 0, displacements v become v - Pi B m with B^T w v = 0, and their products are
/// what they were.
#[derive(Debug)]
struct Tangent {
    /// Direction across the shear of slip cells, along which alone it may change; zero in stick cells.
    across: Pair,
    /// Lever arms of the contact cells; empty where the rotation is not free.
    arms: Pair,
    /// w
    weight: Vec<f64>,
    /// Inverse of B^T w Pi B.
    inverse_sum: [[f64; 3]; 3],
}

/// The same of one cell.
#[derive(Clone, Copy)]
struct Admitted {
    across: [f64; 2],
    arm: [f64; 2],
    weight: f64,
}

impl NewtonStep {
    pub(crate) fn new(cells: usize) -> Self {
        let field = || Vec::with_capacity(cells);
        let pair = || [field(), field()];
        let on_grid = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            tangent: Tangent {
                across: pair(),
                arms: pair(),
                weight: field(),
                inverse_sum: [[0.0; 3]; 3],
            },
            diagonal: field(),
            scale: field(),
            alone: field(),
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
        let of_cells = [
            &mut self.diagonal,
            &mut self.scale,
            &mut self.alone,
            &mut self.tangent.weight,
        ];
        for field in of_cells {
            field.resize(count, 0.0);
        }
        for pair in [
            &mut self.tangent.across,
            &mut self.x,
            &mut self.residual,
            &mut self.z,
            &mut self.direction,
        ] {
            for field in pair {
                field.resize(count, 0.0);
            }
        }
        let [arm_x, arm_y] = &mut self.tangent.arms;
        arm_x.clear();
        arm_y.clear();
        if problem.drive.free[2] {
            arm_x.extend((0..count).map(|i| problem.arms.turn_x(i)));
            arm_y.extend_from_slice(&problem.arms.y);
        }
        clear(&mut self.traction);
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
        let right = RIGHT * c_xx;
        // The root of the contact cells is about the number across.
        let limit = 2.0 * c_xx * (problem.bound.len() as f64).powf(0.25);
        // Where the displacements that mean no slip stay, any field stands in for the turning.
        let turns = !problem.turning.is_empty();
        let turning = if turns {
            problem.turning
        } else {
            problem.bound
        };
        let [u_x, u_y] = &shear.u;
        let ([ref_x, ref_y], [q_x, q_y]) = (problem.u_ref, &shear.q);
        let from = [u_x, u_y, ref_x, ref_y, q_x, q_y, problem.bound, turning];
        let [t_x, t_y] = &mut t.across;
        let [r_x, r_y] = &mut self.residual;
        let to = [
            &mut t_x[..],
            t_y,
            &mut t.weight,
            &mut self.diagonal,
            &mut self.scale,
            &mut self.alone,
            r_x,
            r_y,
        ];
        set((from, &*shear.slip), to, |n, (cell, slips), _| {
            let [u_x, u_y, ref_x, ref_y, q_x, q_y, g, turning] = cell;
            let rigid = problem.arms.in_plane(shift, n);
            let slip = [u_x - ref_x - rigid[0], u_y - ref_y - rigid[1]];
            let e = if slips { [q_x / g, q_y / g] } else { [0.0; 2] };
            let against = -(slip[0] * e[0] + slip[1] * e[1]);
            let kept = if turns { 1.0 - turning } else { 1.0 };
            let curvature = if slips {
                kept * against.max(0.0) / g
            } else {
                0.0
            };
            let weight = 1.0 / (1.0 + curvature / c_xx);
            let shared = ((1.0 - curvature / limit) / (1.0 + curvature / right)).max(0.0);
            let alone = (1.0 - shared) / (right + curvature.max(limit));
            let (scale, r) = (shared.sqrt(), [-slip[0], -slip[1]]);
            [-e[1], e[0], weight, curvature, scale, alone, r[0], r[1]]
        });
        t.inverse_sum = inverse(t.gram(), problem.drive.free);
        let [r_x, r_y] = &mut self.residual;
        let sums = sweep(t.fields(), [r_x, r_y], |_, of_cell, r| {
            let cell = Admitted::of(of_cell);
            let r = cell.project(r);
            (r, cell.weighted_motion_of(r))
        });
        let behind = product(&t.inverse_sum, sums);
        let [squares] = sweep(t.fields(), [r_x, r_y], |_, of_cell, r| {
            let r = Admitted::of(of_cell).without(behind, r);
            (r, [r[0] * r[0] + r[1] * r[1]])
        });
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
        self.restart();
        let mut last_product = 0.0;
        for pass in 0..max_passes {
            if self.residual_norm <= target || response.stopped() {
                return pass;
            }
            let (rigid, product) = self.precondition(response, contact);
            let beta = if pass == 0 {
                0.0
            } else {
                product / last_product
            };
            last_product = product;
            self.turn(rigid, beta);
            contact.unpack_pair(&self.direction, &mut self.traction);
            let [d_x, d_y] = &self.traction;
            let [u_x, u_y] = &mut self.displacement;
            response.tangential([d_x, d_y], [u_x, u_y]);
            let (rigid, curvature) = self.curve(contact);
            if !(curvature > 0.0 && product > 0.0) {
                return pass + 1;
            }
            self.advance(rigid, product / curvature);
        }
        max_passes
    }

    /// z = Pi (S P S + A) r up to a rigid motion, which is returned, and r.z. With that motion taken out
    /// r.z is the same, since B^T w r = 0.
    fn precondition(
        &mut self,
        response: &mut Response<'_>,
        contact: &ContactCells,
    ) -> ([f64; 3], f64) {
        let ([r_x, r_y], [z_x, z_y]) = (&self.residual, &mut self.z);
        set(
            [&self.scale[..], r_x, r_y],
            [z_x, z_y],
            |_, [s, x, y], _| [s * x, s * y],
        );
        contact.unpack_pair(&self.z, &mut self.traction);
        let [s_x, s_y] = &self.traction;
        let [z_x, z_y] = &mut self.displacement;
        response.invert_tangential([s_x, s_y], [z_x, z_y]);
        contact.pack_pair(&self.displacement, &mut self.z);
        let from = [&self.scale[..], &self.alone, r_x, r_y];
        let value =
            |z: [f64; 2], [s, a, x, y]: [f64; 4]| ([s * z[0] + a * x, s * z[1] + a * y], [x, y]);
        (self.tangent).project(&mut self.z, Admitted::motion_of, from, value)
    }

    /// d = z - w Pi B rigid + beta d
    fn turn(&mut self, rigid: [f64; 3], beta: f64) {
        let ([z_x, z_y], [d_x, d_y]) = (&self.z, &mut self.direction);
        let from = (self.tangent.fields(), [&z_x[..], z_y]);
        set(from, [d_x, d_y], |_, (of_cell, z), d| {
            let cell = Admitted::of(of_cell);
            let z = cell.without(rigid.map(|m| cell.weight * m), z);
            [z[0] + beta * d[0], z[1] + beta * d[1]]
        });
    }

    /// z = Pi (C + D) d up to a rigid motion, which is returned, and d.z. With that motion taken out d.z
    /// is the same, since B^T d = 0.
    fn curve(&mut self, contact: &ContactCells) -> ([f64; 3], f64) {
        contact.pack_pair(&self.displacement, &mut self.z);
        let [d_x, d_y] = &self.direction;
        let from = [&self.diagonal[..], d_x, d_y];
        let value = |u: [f64; 2], [d, x, y]: [f64; 3]| ([u[0] + d * x, u[1] + d * y], [x, y]);
        (self.tangent).project(&mut self.z, Admitted::weighted_motion_of, from, value)
    }

    /// x += step d,  r -= step (z - Pi B rigid)
    fn advance(&mut self, rigid: [f64; 3], step: f64) {
        let ([x, y], [r_x, r_y]) = (&mut self.x, &mut self.residual);
        let ([d_x, d_y], [z_x, z_y]) = (&self.direction, &self.z);
        let from = (self.tangent.fields(), [&d_x[..], d_y, z_x, z_y]);
        let to = [&mut x[..], y, r_x, r_y];
        let [squares] = sweep(from, to, |_, (of_cell, from), [x, y, r_x, r_y]| {
            let [d_x, d_y, z_x, z_y] = from;
            let z = Admitted::of(of_cell).without(rigid, [z_x, z_y]);
            let r = [r_x - step * z[0], r_y - step * z[1]];
            let squares = r[0] * r[0] + r[1] * r[1];
            ([x + step * d_x, y + step * d_y, r[0], r[1]], [squares])
        });
        self.residual_norm = squares.sqrt();
        self.add_response(step);
    }

    /// Adds so many times the last displacement to what x causes.
    fn add_response(&mut self, factor: f64) {
        let ([u_x, u_y], [x, y]) = (&self.displacement, &mut self.response_x);
        set([&u_x[..], u_y], [x, y], |_, u, x| {
            [x[0] + factor * u[0], x[1] + factor * u[1]]
        });
    }

    /// Adds C times what is owed to the displacements and to what x causes.
    pub(crate) fn answer(
        &mut self,
        response: &mut Response<'_>,
        contact: &ContactCells,
        shear: &mut Shear<'_>,
    ) {
        contact.unpack_pair(&shear.owed.q, &mut self.traction);
        let [q_x, q_y] = &self.traction;
        let [u_x, u_y] = &mut self.displacement;
        response.tangential([q_x, q_y], [u_x, u_y]);
        contact.pack_pair(&self.displacement, &mut self.z);
        let ([z_x, z_y], [u_x, u_y]) = (&self.z, &mut shear.u);
        set([&z_x[..], z_y], [u_x, u_y], |_, z, u| {
            [u[0] + z[0], u[1] + z[1]]
        });
        shear.owed.settle();
        self.add_response(1.0);
    }

    /// Adds C x and what has been answered since to the displacements of the grid.
    pub(crate) fn follow_on_grid(&self, grid: &mut Shear<'_>) {
        let ([of_x, of_y], [u_x, u_y]) = (&self.response_x, &mut grid.u);
        set([&of_x[..], of_y], [u_x, u_y], |_, of, u| {
            [u[0] + of[0], u[1] + of[1]]
        });
    }

    /// Begins anew: x = 0.
    pub(crate) fn restart(&mut self) {
        clear(&mut self.x);
        clear(&mut self.response_x);
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
        contact.pack_pair(&self.response_x, &mut self.z);
        let ([x, y], [z_x, z_y]) = (&self.x, &self.z);
        let [ref_x, ref_y] = problem.u_ref;
        let from = [&x[..], y, z_x, z_y, ref_x, ref_y, &self.diagonal];
        let ([q_x, q_y], [u_x, u_y]) = (&mut shear.q, &mut shear.u);
        let from = (self.tangent.fields(), from);
        let sums = sweep(from, [q_x, q_y, u_x, u_y], |n, (of_cell, from), old| {
            let [x, y, z_x, z_y, ref_x, ref_y, diagonal] = from;
            let [q_x, q_y, u_x, u_y] = old;
            let u = [u_x + z_x, u_y + z_y];
            let rigid = problem.arms.in_plane(given, n);
            let slip = [u[0] - ref_x - rigid[0], u[1] - ref_y - rigid[1]];
            let cell = Admitted::of(of_cell);
            let turned = cell.project([slip[0] + diagonal * x, slip[1] + diagonal * y]);
            (
                [q_x + x, q_y + y, u[0], u[1]],
                cell.weighted_motion_of(turned),
            )
        });
        add(given, product(&self.tangent.inverse_sum, sums))
    }
}

impl Tangent {
    /// Directions and lever arms. Where the rotation is not free any field does for the arms:
    /// [`Self::inverse_sum`] has no part of it.
    fn fields(&self) -> [&[f64]; 5] {
        let [t_x, t_y] = &self.across;
        let [a_x, a_y] = if self.arms[0].is_empty() {
            &self.across
        } else {
            &self.arms
        };
        [t_x, t_y, a_x, a_y, &self.weight]
    }

    /// B^T w Pi B
    fn gram(&self) -> [[f64; 3]; 3] {
        let [xx, xy, yy, xr, yr, rr] = sums(self.fields(), |_, of_cell| {
            let cell = Admitted::of(of_cell);
            let [x, y] = cell.arm;
            let (of_x, of_y) = (cell.project([1.0, 0.0]), cell.project([0.0, 1.0]));
            let turn = cell.project([-y, x]);
            let of_turn = x * turn[1] - y * turn[0];
            [of_x[0], of_x[1], of_y[1], turn[0], turn[1], of_turn].map(|of| cell.weight * of)
        });
        [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]]
    }

    /// Projects the `value(v, from)` on the tangent space of each cell, into v; returns the motion m
    /// to be taken out for which the sums of what `sums` makes of a cell's v are zero, and the sum of v
    /// times what the values come with.
    fn project<const N: usize>(
        &self,
        v: &mut Pair,
        sums: impl Fn(Admitted, [f64; 2]) -> [f64; 3] + Sync,
        from: [&[f64]; N],
        value: impl Fn([f64; 2], [f64; N]) -> ([f64; 2], [f64; 2]) + Sync,
    ) -> ([f64; 3], f64) {
        let [v_x, v_y] = v;
        let from = (self.fields(), from);
        let [x, y, turn, along] = sweep(from, [v_x, v_y], |_, (of_cell, from), v| {
            let cell = Admitted::of(of_cell);
            let (v, with) = value(v, from);
            let v = cell.project(v);
            let [x, y, turn] = sums(cell, v);
            (v, [x, y, turn, v[0] * with[0] + v[1] * with[1]])
        });
        (product(&self.inverse_sum, [x, y, turn]), along)
    }
}

impl Admitted {
    fn of([t_x, t_y, a_x, a_y, weight]: [f64; 5]) -> Self {
        Self {
            across: [t_x, t_y],
            arm: [a_x, a_y],
            weight,
        }
    }

    /// Pi v. With 1 - e_x^2 in place of t_x^2, where few cells stick, rounding would hide what slip cells
    /// whose shear is turned a little aside give way by.
    fn project(self, v: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.across;
        let along = x * v[0] + y * v[1];
        let sticks = x == 0.0 && y == 0.0;
        if sticks { v } else { [along * x, along * y] }
    }

    /// B^T v
    fn motion_of(self, [a, b]: [f64; 2]) -> [f64; 3] {
        let [x, y] = self.arm;
        [a, b, x * b - y * a]
    }

    /// B^T w v
    fn weighted_motion_of(self, v: [f64; 2]) -> [f64; 3] {
        self.motion_of(v).map(|m| self.weight * m)
    }

    /// v - Pi B m
    fn without(self, m: [f64; 3], v: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.arm;
        let rigid = self.project([m[0] - y * m[2], m[1] + x * m[2]]);
        [v[0] - rigid[0], v[1] - rigid[1]]
    }
}

/// Both fields become zero.
fn clear(pair: &mut Pair) {
    let [x, y] = pair;
    set([], [x, y], |_, [], _| [0.0; 2]);
}
