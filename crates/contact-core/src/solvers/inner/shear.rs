//! Data, unknowns and results of the tangential solvers.

use crate::cells::{Arms, Drive, add_vectors};
use crate::plan::TangentialMethod;
use crate::solvers::Shear;
use crate::solvers::no_slip::slip;

/// Data: the friction bound, the reference of the slip, the drive of the shift.
#[derive(Clone, Copy, Debug)]
pub struct TangentialProblem<'a> {
    /// Largest shear g = mu p in each cell \[Pa\], zero outside the contact.
    pub bound: &'a [f64],
    /// The displacement without slip, u_0 \[m\].
    pub no_slip: [&'a [f64]; 2],
    /// Positions of the cells.
    pub arms: &'a Arms,
    /// Forces and torsional moment, or the motions of this increment where these are prescribed.
    pub drive: Drive,
}

impl TangentialProblem<'_> {
    /// The slip increment of cell n \[m\]: displacement `u` less the displacement without slip and the rigid
    /// motion `shift`.
    pub(crate) fn slip(&self, u: &[&mut [f64]; 2], shift: [f64; 3], n: usize) -> [f64; 2] {
        let at_cell = |f: [&[f64]; 2]| [f[0][n], f[1][n]];
        slip(
            at_cell([u[0], u[1]]),
            at_cell(self.no_slip),
            self.arms.displacement_in_plane(shift, n),
        )
    }
}

/// Settings of the tangential solver.
#[derive(Clone, Copy, Debug)]
pub struct TangentialParams {
    /// Algorithm of the solution.
    pub method: TangentialMethod,
    /// Largest root-mean-square misfit of the slip conditions over the contact \[m\].
    pub tolerance: f64,
    /// A change of the shear whose displacement is smaller than this is not convolved \[m\].
    pub negligible: f64,
    /// Most Newton steps.
    pub max_iterations: usize,
    /// Each linear system is solved to this fraction of its first residual.
    pub forcing: f64,
    /// Most conjugate-gradient passes of a Newton step.
    pub max_passes: usize,
}

/// Result of the tangential solver.
#[derive(Clone, Copy, Debug, Default)]
pub struct TangentialInfo {
    /// Rigid motion of this increment: delta_x, delta_y, phi_z times the length \[m\].
    pub shift: [f64; 3],
    /// Root-mean-square misfit \[m\].
    pub misfit: f64,
    /// Newton steps; [`newton_step`](super::newton_step) returns 0 if the shear was already the
    /// solution.
    pub iterations: usize,
    /// Conjugate-gradient passes, one convolution each.
    pub passes: usize,
}

/// The shift that fits the stick cells best, or all contact cells where none sticks.
pub(crate) fn first_shift(problem: &TangentialProblem<'_>, shear: &Shear<'_>) -> [f64; 3] {
    let cells = problem.bound.len();
    let sticks = |n: usize| problem.bound[n] > 0.0 && !shear.slips[n];
    let any_sticks = (0..cells).any(sticks);
    let prescribed = problem.drive.given;
    let ([u_x, u_y], [x, y]) = (&shear.u, problem.no_slip);
    let [arm_x, arm_y] = problem.arms.fields();
    let fields = ([u_x, u_y, x, y, problem.bound, arm_x, arm_y], &*shear.slips);
    let weight_and_slip = |_, ([u_x, u_y, x, y, bound, arm_x, arm_y], slips): ([f64; 7], bool)| {
        let is_fitted = bound > 0.0 && !(slips && any_sticks);
        let rigid = problem.arms.displacement_at([arm_x, arm_y], prescribed);
        (
            f64::from(u8::from(is_fitted)),
            slip([u_x, u_y], [x, y], rigid),
        )
    };
    let fitted = problem
        .arms
        .fit_in_plane(problem.drive.free, fields, weight_and_slip);
    add_vectors(prescribed, fitted)
}
