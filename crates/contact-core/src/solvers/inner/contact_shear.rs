//! The tangential problem on the contact cells alone, packed.

use super::TangentialProblem;
use crate::cells::ContactCells;
use crate::cells::sums;
use crate::cells::{Arms, Drive};
use crate::cells::{copy, copy_to};
use crate::solvers::Shear;

type Pair = [Vec<f64>; 2];

/// Data and unknowns of the tangential solver on the contact cells.
#[derive(Debug, Default)]
pub(crate) struct ContactShear {
    bound: Vec<f64>,
    no_slip: Pair,
    arms: Arms,
    q: Pair,
    u: Pair,
    slips: Vec<bool>,
}

impl ContactShear {
    /// Copies bound, arms, displacement without slip, shear and slip set of the contact cells from the grid.
    pub(crate) fn pack(
        &mut self,
        cells: &ContactCells,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
    ) {
        (self.arms.length, self.arms.axis_ratio) = (problem.arms.length, problem.arms.axis_ratio);
        let ([x, y], [q_x, q_y], [u_x, u_y]) = (&mut self.no_slip, &mut self.q, &mut self.u);
        cells.pack_all([
            (problem.bound, &mut self.bound),
            (&problem.arms.x, &mut self.arms.x),
            (&problem.arms.y, &mut self.arms.y),
            (problem.no_slip[0], x),
            (problem.no_slip[1], y),
            (shear.q[0], q_x),
            (shear.q[1], q_y),
            (shear.u[0], u_x),
            (shear.u[1], u_y),
        ]);
        self.slips.resize(cells.count(), false);
        cells.pack(shear.slips, &mut self.slips);
    }

    /// Borrows the packed fields as the problem and the shear that the solver takes.
    pub(crate) fn problem_and_shear(&mut self, drive: Drive) -> (TangentialProblem<'_>, Shear<'_>) {
        let problem = TangentialProblem {
            bound: &self.bound,
            no_slip: [&self.no_slip[0], &self.no_slip[1]],
            arms: &self.arms,
            drive,
        };
        let [q_x, q_y] = &mut self.q;
        let [u_x, u_y] = &mut self.u;
        let shear = Shear {
            q: [q_x, q_y],
            u: [u_x, u_y],
            slips: &mut self.slips,
        };
        (problem, shear)
    }
}

impl Shear<'_> {
    /// Takes the contact cells from the grid.
    pub(crate) fn pack(&mut self, cells: &ContactCells, grid: &Shear<'_>) {
        for c in 0..2 {
            cells.pack(grid.q[c], self.q[c]);
            cells.pack(grid.u[c], self.u[c]);
        }
        cells.pack(grid.slips, self.slips);
    }

    /// Copies shear and slip set back; the displacements of the grid are kept up to date all along.
    pub(crate) fn unpack(&self, cells: &ContactCells, grid: &mut Shear<'_>) {
        for c in 0..2 {
            cells.unpack(self.q[c], grid.q[c]);
        }
        cells.unpack(self.slips, grid.slips);
    }
}

/// Rounding error of a difference of two numbers, over their size.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The shear before a step.
#[derive(Debug, Default)]
pub(crate) struct ShearBefore {
    q: Pair,
    u: Pair,
}

impl ShearBefore {
    /// Keeps shear and displacements, to go back to.
    pub(crate) fn save(&mut self, shear: &Shear<'_>) {
        let pairs = [(&mut self.q, &shear.q), (&mut self.u, &shear.u)];
        for (kept, now) in pairs {
            for c in 0..2 {
                copy_to(now[c], &mut kept[c]);
            }
        }
    }

    /// Restores the saved shear, but not the displacements.
    pub(crate) fn restore(&self, shear: &mut Shear<'_>) {
        for c in 0..2 {
            copy(&self.q[c], shear.q[c]);
        }
    }

    /// Whether the energy was lower before the step, by more than |dq| times `tolerance` \[m\] and than the
    /// rounding error of the work. With C symmetric and sum dq = 0, the difference of the energy is the sum of
    /// dq times the mean slip.
    pub(crate) fn is_lower(
        &self,
        problem: &TangentialProblem<'_>,
        shear: &Shear<'_>,
        shift: [f64; 3],
        tolerance: f64,
    ) -> bool {
        let prescribed = problem.drive.given;
        let ([q_x, q_y], [u_x, u_y]) = (&shear.q, &shear.u);
        let [x, y] = problem.no_slip;
        let ([p_x, p_y], [v_x, v_y]) = (&self.q, &self.u);
        let (now, before) = ([&**q_x, q_y, u_x, u_y], [&p_x[..], p_y, v_x, v_y]);
        let fields = ((now, before), [x, y]);
        let [rise, moved, work] = sums(fields, |n, ((now, before), u_0)| {
            let prescribed_here = problem.arms.displacement_in_plane(prescribed, n);
            let shift = problem.arms.displacement_in_plane(shift, n);
            let (mut rise, mut moved, mut work) = (0.0, 0.0, 0.0);
            for c in 0..2 {
                let change = now[c] - before[c];
                let mean = 0.5 * (now[2 + c] + before[2 + c]) - u_0[c];
                rise += change * (mean - shift[c]);
                moved += change.abs();
                work += (now[c] * (mean - prescribed_here[c])).abs();
            }
            [rise, moved, work]
        });
        rise > tolerance * moved + ROUNDING * work
    }
}
