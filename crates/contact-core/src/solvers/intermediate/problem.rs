//! Data, unknowns and results of the intermediate loop.

use super::anderson::Anderson;
use super::lifted::Lifted;
use crate::cells::{Arms, Drive, copy, set_fields};
use crate::solvers::Interface;
use crate::solvers::inner::{
    NormalParams, NormalProblem, NormalWorkspace, TangentialParams, TangentialProblem,
    TangentialWorkspace, exceeds, is_full,
};

/// Data of one increment.
#[derive(Clone, Copy, Debug)]
pub struct IncrementProblem<'a> {
    /// Gap between the undeformed surfaces h_init \[m\].
    pub h_init: &'a [f64],
    /// Whether there is friction anywhere on the load path; without it only the normal problem is
    /// solved.
    pub friction: bool,
    /// Friction coefficient of each cell.
    pub mu: &'a [f64],
    /// Positions of the cells.
    pub arms: &'a Arms,
    /// Whether cells may enter because the contact grows or rolls, or are kept out (a solution on
    /// the old contact).
    pub enters: bool,
    /// Drive of approach and tilts, from the unloaded state.
    pub normal: Drive,
    /// Largest pressure that the surfaces bear \[Pa\]; infinite for elastic bodies.
    pub hardness: f64,
    /// Drive of shifts and torsion in this increment.
    pub tangential: Drive,
}

impl<'a> IncrementProblem<'a> {
    /// The normal problem of the increment.
    pub(super) fn normal_problem(&self) -> NormalProblem<'a> {
        NormalProblem {
            h_init: self.h_init,
            arms: self.arms,
            drive: self.normal,
            hardness: self.hardness,
        }
    }

    /// The tangential problem under a friction bound \[Pa\], with the displacement without
    /// slip \[m\].
    pub(super) fn tangential_problem<'b>(
        &'b self,
        bound: &'b [f64],
        no_slip: [&'b [f64]; 2],
    ) -> TangentialProblem<'b> {
        TangentialProblem {
            bound,
            no_slip,
            arms: self.arms,
            drive: self.tangential,
        }
    }
}

/// Settings of the intermediate loop.
#[derive(Clone, Copy, Debug)]
pub struct AlternationParams {
    /// Largest root-mean-square gap in the contact and deepest penetration outside at the end
    /// \[m\].
    pub tolerance: f64,
    /// Settings of the normal solver.
    pub normal: NormalParams,
    /// Settings of the tangential solver.
    pub tangential: TangentialParams,
    /// Most passes.
    pub max_alternations: usize,
    /// Tolerance of the inner loops over the gap after the last pass, where it exceeds their own tolerance;
    /// 0 solves to their own tolerance in each pass \[1\].
    pub forcing: f64,
    /// Whether cells that the normal solver brings into contact slip at once where friction cannot
    /// hold them; in the first pass only if no cell enters by growth (default true).
    pub new_cells_slip: bool,
    /// Whether slow alternation is accelerated (default true).
    pub anderson: bool,
}

impl AlternationParams {
    /// The settings with the inner tolerances of a pass that begins with this `residual` of the gap
    /// \[m\], and whether these are the final ones.
    pub(super) fn params_of_pass(&self, residual: f64) -> (Self, bool) {
        let factor = self.forcing * residual / self.tolerance;
        if !(factor > 1.0) {
            return (*self, true);
        }
        let mut inner = *self;
        inner.normal.enough *= factor;
        inner.normal.tolerance *= factor;
        inner.tangential.tolerance *= factor;
        (inner, false)
    }
}

/// Result of the intermediate loop.
#[derive(Clone, Copy, Debug, Default)]
pub struct AlternationInfo {
    /// Approach, and the tilts phi_x, phi_y times the length \[m\].
    pub approach: [f64; 3],
    /// Shifts of this increment, and the rotation phi_z times the length \[m\].
    pub shift: [f64; 3],
    /// Loads over the limit of friction \[1\]; full sliding from 1 on.
    pub friction_used: f64,
    /// Passes.
    pub alternations: usize,
    /// Iterations of the normal solver.
    pub normal_iterations: usize,
    /// Conjugate-gradient passes of the tangential solver.
    pub tangential_iterations: usize,
}

impl AlternationInfo {
    /// Whether the loads exceed the limit of friction: there is no equilibrium, and the shear was
    /// not solved.
    pub fn exceeds_friction(&self) -> bool {
        exceeds(self.friction_used)
    }

    /// Whether the loads reach the limit of friction.
    pub fn uses_all_friction(&self) -> bool {
        is_full(self.friction_used)
    }

    /// Adds the work of another solution for the same increment.
    pub(crate) fn add_work(&mut self, addend: &Self) {
        self.alternations += addend.alternations;
        self.normal_iterations += addend.normal_iterations;
        self.tangential_iterations += addend.tangential_iterations;
    }
}

/// Buffers of the intermediate loop.
#[derive(Debug)]
pub struct AlternationWorkspace {
    pub(super) normal: NormalWorkspace,
    pub(super) tangential: TangentialWorkspace,
    /// mu p \[Pa\].
    pub(super) bound: Vec<f64>,
    /// Pressure before the normal solver.
    pub(super) p_before: Vec<f64>,
    /// The shear to which u_z belongs.
    pub(super) q_before: [Vec<f64>; 2],
    pub(super) change: [Vec<f64>; 2],
    pub(super) response: [Vec<f64>; 2],
    pub(super) anderson: Anderson,
    /// Cells under friction without a limit that the shear would lift off.
    pub(super) lifted: Lifted,
    /// Passes in which the turn term of u_0 did not settle.
    pub(super) unsettled: usize,
}

impl AlternationWorkspace {
    /// Allocates buffers for fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        let pair = || [field(), field()];
        Self {
            normal: NormalWorkspace::new(cells),
            tangential: TangentialWorkspace::new(cells),
            bound: field(),
            p_before: field(),
            q_before: pair(),
            change: pair(),
            response: pair(),
            anderson: Anderson::new(cells),
            lifted: Lifted::default(),
            unsettled: 0,
        }
    }

    /// Begins a new increment, which may take several solutions.
    pub(crate) fn begin_increment(&mut self) {
        self.lifted.clear();
    }

    /// Begins a solution.
    pub(super) fn begin_solution(&mut self, params: &AlternationParams) {
        self.anderson.restart(params.anderson);
        self.unsettled = 0;
    }

    /// Saves the tractions before a pass.
    pub(super) fn save_tractions(&mut self, now: &Interface) {
        copy(&now.p, &mut self.p_before);
        for (q, before) in now.q.iter().zip(&mut self.q_before) {
            copy(q, before);
        }
    }

    /// Computes the change of the shear since `q_before`; returns whether there is one.
    pub(super) fn compute_change_of_shear(&mut self, now: &Interface) -> bool {
        let ([x, y], before) = (&mut self.change, &self.q_before);
        let from = [&now.q[0][..], &now.q[1], &before[0], &before[1]];
        set_fields(from, [x, y], |_, [q_x, q_y, x, y], _| [q_x - x, q_y - y]);
        self.change.iter().flatten().any(|&change| change != 0.0)
    }
}
