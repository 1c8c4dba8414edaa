//! The intermediate loop: pressure and shear of one increment in turn (figure 2 of the paper).
//!
//! The pressure is found for known shear, then the shear for known pressure, until the gap that
//! the shear leaves behind is within the tolerance. Where the bodies are similar neither changes
//! the other and one pass is exact. The displacements are carried along: each solver adds the
//! response to what it changed.

use super::anderson::Anderson;
use super::known_pressure::{
    bring_within_bound, follow_pressure, incipient_shift, shear_for_known_pressure,
};
use crate::cells::{Arms, Drive, copy, set};
use crate::solvers::inner::{
    NormalParams, NormalProblem, NormalWorkspace, Sliding, TangentialParams, TangentialProblem,
    TangentialWorkspace, assess, exceeds, normal,
};
use crate::solvers::no_slip::NoSlip;
use crate::solvers::{Interface, Response, SolverError};

/// What is given in one increment.
#[derive(Clone, Copy, Debug)]
pub struct IncrementProblem<'a> {
    /// Gap between the undeformed surfaces h_init \[m\].
    pub h_init: &'a [f64],
    /// Friction coefficient of each cell.
    pub mu: &'a [f64],
    /// Where the cells are.
    pub arms: &'a Arms,
    /// What drives approach and tilts, from the unloaded state.
    pub normal: Drive,
    /// What drives shifts and torsion in this increment.
    pub tangential: Drive,
}

impl<'a> IncrementProblem<'a> {
    fn normal_problem(&self) -> NormalProblem<'a> {
        NormalProblem {
            h_init: self.h_init,
            arms: self.arms,
            drive: self.normal,
        }
    }

    /// The tangential problem under a friction bound \[Pa\], with the displacement that means no slip \[m\].
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
    /// Largest root-mean-square gap in the contact and deepest penetration outside at the end \[m\].
    pub tolerance: f64,
    /// Settings of the normal solver.
    pub normal: NormalParams,
    /// Settings of the tangential solver.
    pub tangential: TangentialParams,
    /// Most passes.
    pub max_alternations: usize,
    /// Whether slow alternation is accelerated (default true).
    pub anderson: bool,
}

/// What the intermediate loop ended with.
#[derive(Clone, Copy, Debug, Default)]
pub struct AlternationInfo {
    /// Approach, and the tilts phi_x, phi_y times the length \[m\].
    pub approach: [f64; 3],
    /// Shifts of this increment, and the rotation phi_z times the length \[m\].
    pub shift: [f64; 3],
    /// What the loads ask for over what friction can carry; full sliding from 1 on.
    pub friction_used: f64,
    /// Passes.
    pub alternations: usize,
    /// Iterations of the normal solver.
    pub normal_iterations: usize,
    /// Conjugate-gradient passes of the tangential solver.
    pub tangential_iterations: usize,
}

impl AlternationInfo {
    /// Whether the loads are more than friction can carry: there is no equilibrium, and the shear
    /// was not solved for.
    pub fn exceeds_friction(&self) -> bool {
        exceeds(self.friction_used)
    }

    pub(super) fn iterations(&self) -> usize {
        self.normal_iterations + self.tangential_iterations
    }

    /// Adds the work of another solution that this one took.
    pub(crate) fn add_work(&mut self, other: &Self) {
        self.alternations += other.alternations;
        self.normal_iterations += other.normal_iterations;
        self.tangential_iterations += other.tangential_iterations;
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
    /// The shear that u_z answers to.
    pub(super) q_before: [Vec<f64>; 2],
    pub(super) change: [Vec<f64>; 2],
    pub(super) response: [Vec<f64>; 2],
    /// Tractions q_x, q_y, p at the last convolution in double precision.
    pub(super) evaluated: [Vec<f64>; 3],
    anderson: Anderson,
    /// Passes in which u_0 did not settle.
    pub(super) unsettled: usize,
}

impl AlternationWorkspace {
    /// For fields of `cells` cells.
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
            evaluated: [field(), field(), field()],
            anderson: Anderson::new(cells),
            unsettled: 0,
        }
    }

    /// Computes the displacements of a guess in double precision.
    fn evaluate(&mut self, response: &mut Response<'_>, now: &mut Interface, friction: bool) {
        now.evaluate(response, friction);
        for (evaluated, traction) in self.evaluated.iter_mut().zip(now.tractions()) {
            copy(traction, evaluated);
        }
    }

    /// The change of the shear since `q_before`; whether there is one.
    pub(super) fn change_of_shear(&mut self, now: &Interface) -> bool {
        let ([x, y], before) = (&mut self.change, &self.q_before);
        let from = [&now.q[0][..], &now.q[1], &before[0], &before[1]];
        set(from, [x, y], |_, [q_x, q_y, x, y], _| [q_x - x, q_y - y]);
        self.change.iter().flatten().any(|&change| change != 0.0)
    }
}

/// Pressure and shear in turn, from a guess of the tractions in `now` to the solution.
pub(super) fn alternate(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
) -> Result<AlternationInfo, SolverError> {
    let friction = problem.mu.iter().any(|&mu| mu > 0.0);
    let coupled = response.op.is_coupled() && friction;
    let gap = problem.normal_problem();
    let mut info = AlternationInfo::default();
    let mut sliding = Sliding::default();
    if friction {
        sliding = bring_within_bound(problem, no_slip, now, ws);
    }
    ws.evaluate(response, now, friction);
    ws.anderson.restart(params.anderson);
    ws.unsettled = 0;
    loop {
        info.alternations += 1;

        // Pressure for known shear.
        copy(&now.p, &mut ws.p_before);
        let (p, u_z) = (&mut now.p, &mut now.u_z);
        let found = normal(response, &gap, p, u_z, &mut ws.normal, &params.normal)?;
        info.normal_iterations += found.iterations;
        info.approach = found.motion;
        if !friction || now.p.iter().all(|&p| p <= 0.0) {
            return Ok(info);
        }

        // Shear for known pressure: the bound moves with the pressure.
        for (q, before) in now.q.iter().zip(&mut ws.q_before) {
            copy(q, before);
        }
        if found.iterations > 0 {
            sliding = bring_within_bound(problem, no_slip, now, ws);
            follow_pressure(response, now, ws, coupled);
        }
        info.friction_used = sliding.used;
        if info.exceeds_friction() {
            return Ok(info);
        }
        if sliding.is_full() {
            info.shift = incipient_shift(problem, no_slip, sliding.motion, now, ws);
        } else {
            shear_for_known_pressure(response, problem, no_slip, now, ws, params, &mut info)?;
        }
        if !coupled {
            return Ok(info);
        }

        // What the change of shear does to the gap.
        let change = ws.change_of_shear(now);
        if !change && !ws.anderson.accelerates() {
            return Ok(info);
        }
        if change {
            let [x, y] = &ws.change;
            response.normal_under_shear([x, y], &mut ws.response[0]);
        } else {
            ws.response[0].fill(0.0);
        }
        ws.anderson.close_pass(&ws.response[0], &mut now.u_z);
        let check = assess(&gap, &now.p, &now.u_z);
        info.approach = check.motion;
        let residual = check.gap.max(check.penetration);
        if residual <= params.tolerance {
            return Ok(info);
        }
        if info.alternations >= params.max_alternations {
            return Err(SolverError {
                solver: "coupled",
                residual,
                tolerance: params.tolerance,
                iterations: info.alternations,
            });
        }
        ws.anderson.extrapolate(&now.p, &mut now.u_z);
    }
}
