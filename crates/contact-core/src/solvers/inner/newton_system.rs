//! One Newton step of the tangential problem: the linear system on the tangent space.

use super::TangentialProblem;
use super::tangent::{CellTangent, Pair, Tangent};
use crate::cells::ContactCells;
use crate::cells::{add_vectors, inverse, product, set_fields, sums, sweep};
use crate::solvers::no_slip::slip;
use crate::solvers::{Response, Shear};

/// c_0/C_xx(0,0), c_0 being the eigenvalue of C for which the approximate inverse is exact.
const EXACT_EIGENVALUE: f64 = 2.0;

/// The linear system
///
/// ```text
/// find x in the tangent space, B^T x = 0:   Pi (C x + D x + ds) = Pi B d(delta)'
/// ```
///
/// with B the rigid motions that are free, Pi the projection on the tangent space (stick cells:
/// both components; slip cells: across q) and D = (1 - t') |ds|/g the curvature of the circle, t'
/// being the derivative of the turn term of u_0 ([`Self::set_turning`]). The unknowns are packed
/// contact cells; fields that the operator takes and gives cover the grid.
///
/// With P the approximate inverse of C, and c an eigenvalue of C, the preconditioner is S P S + A,
///
/// ```text
/// 1/(c + D) ~ s^2 / c + (1 - s^2)/(c_0 + max(D, d)),    s^2 = max(0, (1 - D/d)/(1 + D/c_0))
/// ```
///
/// with equality for c = c_0 = 2 C_xx(0,0). The curvature limit is d = 2 C_xx(0,0) n^(1/2), with
/// n = N^(1/2) contact cells across the contact: about the geometric mean of the eigenvalues of the
/// shortest waves, O(C_xx), and of the longest, O(n C_xx). Both factors 2 took the fewest passes in
/// tests. A cell with D >= d has s = 0, so that P does not couple it to other cells. D is unbounded
/// at the rim, where g vanishes; an error dx that the coupling made in x there would enter the
/// residual as D dx.
#[derive(Debug)]
pub(crate) struct NewtonSystem {
    tangent: Tangent,
    /// t': derivative of the turn term of u_0 by the angle of the shear, over |ds| \[1\].
    turning: Vec<f64>,
    /// D \[m/Pa\].
    diagonal: Vec<f64>,
    /// C_xx(0,0) \[m/Pa\].
    c_xx: f64,
    /// S \[1\] and A \[Pa/m\] of the preconditioner S P S + A ~ (C + D)^-1.
    scale: Vec<f64>,
    uncoupled: Vec<f64>,
    /// Solution x, and the correction after it that returns slip cells to the circle |q| = g
    /// \[Pa\].
    x: Pair,
    pub(super) change: Pair,
    residual: Pair,
    residual_norm: f64,
    z: Pair,
    direction: Pair,
    /// C applied to x and to the corrections since, on the grid \[m\].
    response_x: Pair,
    /// Traction and displacement on the grid.
    traction: Pair,
    displacement: Pair,
}

impl NewtonSystem {
    /// Allocates buffers for fields of `cells` cells.
    pub(crate) fn new(cells: usize) -> Self {
        let field = || Vec::with_capacity(cells);
        let pair = || [field(), field()];
        let on_grid = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            tangent: Tangent::new(cells),
            turning: field(),
            diagonal: field(),
            c_xx: 0.0,
            scale: field(),
            uncoupled: field(),
            x: pair(),
            change: pair(),
            residual: pair(),
            residual_norm: 0.0,
            z: pair(),
            direction: pair(),
            response_x: on_grid(),
            traction: on_grid(),
            displacement: on_grid(),
        }
    }

    /// Resizes all fields to the number of contact cells.
    pub(crate) fn set_contact(&mut self, problem: &TangentialProblem<'_>) {
        let count = problem.bound.len();
        let fields_of_cells = [
            &mut self.turning,
            &mut self.diagonal,
            &mut self.scale,
            &mut self.uncoupled,
            &mut self.tangent.weight,
        ];
        for field in fields_of_cells {
            field.resize(count, 0.0);
        }
        for pair in [
            &mut self.tangent.across,
            &mut self.x,
            &mut self.change,
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
            arm_x.extend((0..count).map(|i| problem.arms.turn_arm_x(i)));
            arm_y.extend_from_slice(&problem.arms.y);
        }
        clear_pair(&mut self.traction);
    }

    /// Sets t' in the contact cells from its values on the grid; zero without values.
    pub(super) fn set_turning(&mut self, contact: &ContactCells, turning: Option<&[f64]>) {
        match turning {
            Some(turning) => contact.pack(turning, &mut self.turning),
            None => self.turning.fill(0.0),
        }
    }

    /// Computes tangent space, curvature and residual at the present shear and slip; x starts from zero.
    /// Returns the least-squares rigid shift on the tangent space; the residual belongs to that
    /// shift.
    pub(crate) fn linearise(
        &mut self,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
        shift: [f64; 3],
        c_xx: f64,
    ) -> [f64; 3] {
        self.c_xx = c_xx;
        let t = &mut self.tangent;
        let ([t_x, t_y], [r_x, r_y]) = (&mut t.across, &mut self.residual);
        let ([x, y], [q_x, q_y], [u_x, u_y]) = (problem.no_slip, &shear.q, &shear.u);
        let from = [u_x, u_y, x, y, q_x, q_y, problem.bound, &self.turning];
        let from = ((from, problem.arms.fields()), &*shear.slips);
        let to = [
            &mut t_x[..],
            t_y,
            &mut t.weight,
            &mut self.diagonal,
            r_x,
            r_y,
        ];
        let sums = sweep(from, to, |_, ((cell, arms), slips), _| {
            let [u_x, u_y, x, y, q_x, q_y, g, turning] = cell;
            let slip = slip(
                [u_x, u_y],
                [x, y],
                problem.arms.displacement_at(arms, shift),
            );
            let inverse_bound = if slips { 1.0 / g } else { 0.0 };
            let e = [q_x * inverse_bound, q_y * inverse_bound];
            let opposing_slip = -(slip[0] * e[0] + slip[1] * e[1]);
            let curvature = (1.0 - turning) * opposing_slip.max(0.0) * inverse_bound;
            let [t_x, t_y] = [-e[1], e[0]];
            let weight = 1.0 / (1.0 + curvature / c_xx);
            let cell = CellTangent::from_fields([
                t_x,
                t_y,
                problem.arms.axis_ratio * arms[0],
                arms[1],
                weight,
            ]);
            let r = cell.project([-slip[0], -slip[1]]);
            let ([xx, xy, yy, xr, yr, rr], [x, y, turn]) = (cell.gram(), cell.weighted_sums(r));
            (
                [t_x, t_y, weight, curvature, r[0], r[1]],
                [xx, xy, yy, xr, yr, rr, x, y, turn],
            )
        });
        let [xx, xy, yy, xr, yr, rr, x, y, turn] = sums;
        let gram = [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]];
        t.inverse_sum = inverse(gram, problem.drive.free);
        let correction = product(&t.inverse_sum, [x, y, turn]);
        let [r_x, r_y] = &mut self.residual;
        let [squares] = sweep(t.fields(), [r_x, r_y], |_, of_cell, r| {
            let r = CellTangent::from_fields(of_cell).subtract_motion(correction, r);
            (r, [r[0] * r[0] + r[1] * r[1]])
        });
        self.residual_norm = squares.sqrt();
        add_vectors(shift, correction.map(|s| -s))
    }

    /// Computes the scaling S and the diagonal A of the preconditioner S P S + A for the present tangent space.
    fn compute_preconditioner(&mut self) {
        let exact = EXACT_EIGENVALUE * self.c_xx;
        // The square root of the number of contact cells is about their number across.
        let limit = 2.0 * self.c_xx * (self.diagonal.len() as f64).powf(0.25);
        let to = [&mut self.scale[..], &mut self.uncoupled];
        set_fields([&self.diagonal[..]], to, |_, [curvature], _| {
            let coupled = ((1.0 - curvature / limit) / (1.0 + curvature / exact)).max(0.0);
            let uncoupled = (1.0 - coupled) / (exact + curvature.max(limit));
            [coupled.sqrt(), uncoupled]
        });
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
        self.reset_solution();
        self.compute_preconditioner();
        let mut last_product = 0.0;
        for pass in 0..max_passes {
            if self.residual_norm <= target || response.must_stop() {
                return pass;
            }
            let (rigid, product) = self.precondition(response, contact);
            let beta = if pass == 0 {
                0.0
            } else {
                product / last_product
            };
            last_product = product;
            self.update_direction(rigid, beta);
            contact.unpack_pair(&self.direction, &mut self.traction);
            let [d_x, d_y] = &self.traction;
            let [u_x, u_y] = &mut self.displacement;
            response.respond_to_shear([d_x, d_y], [u_x, u_y]);
            let (rigid, curvature) = self.apply_system(contact);
            if !(curvature > 0.0 && product > 0.0) {
                return pass + 1;
            }
            self.take_step(rigid, product / curvature);
        }
        max_passes
    }

    /// Computes z = Pi (S P S + A) r up to a rigid motion, and returns this motion and r.z. Without the motion
    /// r.z is the same, since B^T w r = 0.
    fn precondition(
        &mut self,
        response: &mut Response<'_>,
        contact: &ContactCells,
    ) -> ([f64; 3], f64) {
        let ([r_x, r_y], [z_x, z_y]) = (&self.residual, &mut self.z);
        set_fields(
            [&self.scale[..], r_x, r_y],
            [z_x, z_y],
            |_, [s, x, y], _| [s * x, s * y],
        );
        contact.unpack_pair(&self.z, &mut self.traction);
        let [s_x, s_y] = &self.traction;
        let [z_x, z_y] = &mut self.displacement;
        response.invert_tangential([s_x, s_y], [z_x, z_y]);
        contact.pack_pair(&self.displacement, &mut self.z);
        let from = [&self.scale[..], &self.uncoupled, r_x, r_y];
        let value =
            |z: [f64; 2], [s, a, x, y]: [f64; 4]| ([s * z[0] + a * x, s * z[1] + a * y], [x, y]);
        (self.tangent).project(&mut self.z, CellTangent::sums, from, value)
    }

    /// d = z - w Pi B rigid + beta d
    fn update_direction(&mut self, rigid: [f64; 3], beta: f64) {
        let ([z_x, z_y], [d_x, d_y]) = (&self.z, &mut self.direction);
        let from = (self.tangent.fields(), [&z_x[..], z_y]);
        set_fields(from, [d_x, d_y], |_, (of_cell, z), d| {
            let cell = CellTangent::from_fields(of_cell);
            let z = cell.subtract_motion(rigid.map(|m| cell.weight * m), z);
            [z[0] + beta * d[0], z[1] + beta * d[1]]
        });
    }

    /// Computes z = Pi (C + D) d up to a rigid motion, and returns this motion and d.z. Without the motion
    /// d.z is the same, since B^T d = 0.
    fn apply_system(&mut self, contact: &ContactCells) -> ([f64; 3], f64) {
        contact.pack_pair(&self.displacement, &mut self.z);
        let [d_x, d_y] = &self.direction;
        let from = [&self.diagonal[..], d_x, d_y];
        let value = |u: [f64; 2], [d, x, y]: [f64; 3]| ([u[0] + d * x, u[1] + d * y], [x, y]);
        (self.tangent).project(&mut self.z, CellTangent::weighted_sums, from, value)
    }

    /// x += step d,  r -= step (z - Pi B rigid)
    fn take_step(&mut self, rigid: [f64; 3], step: f64) {
        let ([x, y], [r_x, r_y]) = (&mut self.x, &mut self.residual);
        let ([d_x, d_y], [z_x, z_y]) = (&self.direction, &self.z);
        let from = (self.tangent.fields(), [&d_x[..], d_y, z_x, z_y]);
        let to = [&mut x[..], y, r_x, r_y];
        let [squares] = sweep(from, to, |_, (of_cell, from), [x, y, r_x, r_y]| {
            let [d_x, d_y, z_x, z_y] = from;
            let z = CellTangent::from_fields(of_cell).subtract_motion(rigid, [z_x, z_y]);
            let r = [r_x - step * z[0], r_y - step * z[1]];
            let squares = r[0] * r[0] + r[1] * r[1];
            ([x + step * d_x, y + step * d_y, r[0], r[1]], [squares])
        });
        self.residual_norm = squares.sqrt();
        self.add_response(step);
    }

    /// response_x += factor times the last displacement.
    fn add_response(&mut self, factor: f64) {
        let ([u_x, u_y], [x, y]) = (&self.displacement, &mut self.response_x);
        set_fields([&u_x[..], u_y], [x, y], |_, u, x| {
            [x[0] + factor * u[0], x[1] + factor * u[1]]
        });
    }

    /// Adds the response C dq to the displacements and to `response_x`, dq being [`Self::change`]
    /// (packed).
    pub(crate) fn add_response_of_change(
        &mut self,
        response: &mut Response<'_>,
        contact: &ContactCells,
        shear: &mut Shear<'_>,
    ) {
        contact.unpack_pair(&self.change, &mut self.traction);
        let [q_x, q_y] = &self.traction;
        let [u_x, u_y] = &mut self.displacement;
        response.respond_to_shear([q_x, q_y], [u_x, u_y]);
        contact.pack_pair(&self.displacement, &mut self.z);
        let ([z_x, z_y], [u_x, u_y]) = (&self.z, &mut shear.u);
        set_fields([&z_x[..], z_y], [u_x, u_y], |_, z, u| {
            [u[0] + z[0], u[1] + z[1]]
        });
        self.add_response(1.0);
    }

    /// Adds C x and the responses added since to the displacements of the grid.
    pub(crate) fn add_to_displacements(&self, grid: &mut Shear<'_>) {
        let ([response_x, response_y], [u_x, u_y]) = (&self.response_x, &mut grid.u);
        set_fields([&response_x[..], response_y], [u_x, u_y], |_, of, u| {
            [u[0] + of[0], u[1] + of[1]]
        });
    }

    /// Sets x = 0.
    pub(crate) fn reset_solution(&mut self) {
        clear_pair(&mut self.x);
        clear_pair(&mut self.response_x);
    }

    /// Sum of the squares of x \[Pa^2\].
    pub(crate) fn sum_of_squares(&self) -> f64 {
        let [x, y] = &self.x;
        let [squares] = sums([&x[..], y], |_, [x, y]| [x * x + y * y]);
        squares
    }

    /// Adds x and C x to the shear, which [`Self::change`] keeps; returns the shift that satisfies the equations
    /// of the tangent space there.
    pub(crate) fn add_solution(
        &mut self,
        contact: &ContactCells,
        problem: &TangentialProblem<'_>,
        shear: &mut Shear<'_>,
    ) -> [f64; 3] {
        let prescribed = problem.drive.given;
        contact.pack_pair(&self.response_x, &mut self.z);
        let ([x, y], [z_x, z_y]) = (&self.x, &self.z);
        let [x_0, y_0] = problem.no_slip;
        let from = [&x[..], y, z_x, z_y, x_0, y_0, &self.diagonal];
        let from = (from, problem.arms.fields());
        let from = (self.tangent.fields(), from);
        let ([q_x, q_y], [u_x, u_y]) = (&mut shear.q, &mut shear.u);
        let [kept_x, kept_y] = &mut self.change;
        let to = [&mut **q_x, q_y, u_x, u_y, kept_x, kept_y];
        let sums = sweep(from, to, |_, (of_cell, (from, arms)), old| {
            let [x, y, z_x, z_y, x_0, y_0, diagonal] = from;
            let (q, u) = ([old[0] + x, old[1] + y], [old[2] + z_x, old[3] + z_y]);
            let slip = slip(
                u,
                [x_0, y_0],
                problem.arms.displacement_at(arms, prescribed),
            );
            let cell = CellTangent::from_fields(of_cell);
            let projected = cell.project([slip[0] + diagonal * x, slip[1] + diagonal * y]);
            let new = [q[0], q[1], u[0], u[1], q[0], q[1]];
            (new, cell.weighted_sums(projected))
        });
        add_vectors(prescribed, product(&self.tangent.inverse_sum, sums))
    }
}

/// Sets both fields to zero.
fn clear_pair(pair: &mut Pair) {
    let [x, y] = pair;
    set_fields([], [x, y], |_, [], _| [0.0; 2]);
}
