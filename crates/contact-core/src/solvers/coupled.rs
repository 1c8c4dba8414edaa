//! The intermediate loop: pressure and shear of one increment together (figure 2 of the paper).
//!
//! The pressure is found for known shear, then the shear for known pressure, until the gap that
//! the shear leaves behind is within the tolerance. Where the bodies are similar neither changes
//! the other and one pass is exact. The displacements are carried along: each solver adds the
//! response to what it changed, and one full convolution at the start ties them to the tractions.

use serde::{Deserialize, Serialize};

use super::admissible::admissible;
use super::shear_gradient::shear_gradient;
use super::vector::{add_scaled, mean_where};
use super::{
    NormalParams, NormalProblem, NormalWorkspace, Response, Shear, SolverError, TangentialMethod,
    TangentialParams, TangentialProblem, TangentialWorkspace, normal, tangential,
};
use crate::convolution::{Displacements, Tractions};

/// Tractions of an increment and the displacements that belong to them, on the kept cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Interface {
    /// Pressure \[Pa\].
    pub p: Vec<f64>,
    /// Shear tractions q_x, q_y on body 2 \[Pa\].
    pub q: [Vec<f64>; 2],
    /// Relative tangential displacements u_x, u_y \[m\].
    pub u: [Vec<f64>; 2],
    /// Relative normal displacement u_z \[m\].
    pub u_z: Vec<f64>,
    /// Contact cells that slip.
    pub slip: Vec<bool>,
}

impl Interface {
    /// Nothing acts.
    pub fn unloaded(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            p: field(),
            q: [field(), field()],
            u: [field(), field()],
            u_z: field(),
            slip: vec![false; cells],
        }
    }

    /// Computes the displacements from the tractions.
    pub(crate) fn evaluate(&mut self, response: &mut Response<'_>, shear: bool) {
        let [u_x, u_y] = &mut self.u;
        let coupled = response.op.is_coupled();
        let tractions = Tractions {
            q_x: shear.then_some(&self.q[0][..]),
            q_y: shear.then_some(&self.q[1][..]),
            p: Some(&self.p),
        };
        let tangential = shear || coupled;
        let displacements = Displacements {
            u_x: tangential.then_some(u_x),
            u_y: tangential.then_some(u_y),
            u_z: Some(&mut self.u_z),
        };
        response.op.apply(tractions, displacements);
    }
}

/// What is given in one increment.
#[derive(Clone, Copy, Debug)]
pub struct IncrementProblem<'a> {
    /// Gap between the undeformed surfaces h_init \[m\].
    pub h_init: &'a [f64],
    /// Tangential displacements of the last increment, the reference of the slip \[m\].
    pub u_ref: [&'a [f64]; 2],
    /// Friction coefficient.
    pub mu: f64,
    /// Sum of the pressure over the kept cells \[Pa\], positive.
    pub sum_p: f64,
    /// Sum of the shear over the kept cells \[Pa\].
    pub sum_q: [f64; 2],
    /// Whether each shift is free to balance its force.
    pub free: [bool; 2],
}

/// Settings of the intermediate loop.
#[derive(Clone, Copy, Debug)]
pub struct CoupledParams {
    /// Settings of the normal solver; its tolerance is that of the gap.
    pub normal: NormalParams,
    /// Settings of the tangential solver.
    pub tangential: TangentialParams,
    /// Most passes.
    pub max_alternations: usize,
}

/// What the intermediate loop ended with.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoupledInfo {
    /// Approach \[m\].
    pub delta_z: f64,
    /// Rigid shift of this increment \[m\].
    pub shift: [f64; 2],
    /// Whether every contact cell slips.
    pub gross_slip: bool,
    /// Passes.
    pub alternations: usize,
    /// Iterations of the normal solver.
    pub normal_iterations: usize,
    /// Conjugate-gradient passes of the tangential solver.
    pub tangential_iterations: usize,
}

/// Buffers of the intermediate loop.
#[derive(Debug)]
pub struct CoupledWorkspace {
    normal: NormalWorkspace,
    tangential: TangentialWorkspace,
    bound: Vec<f64>,
    p_before: Vec<f64>,
    q_before: [Vec<f64>; 2],
    change: [Vec<f64>; 2],
    response: [Vec<f64>; 2],
}

impl CoupledWorkspace {
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
        }
    }
}

/// |T| this close to mu W is full sliding; rounding decides below that.
const FULL_SLIDING: f64 = 1e-12;

/// Solves one increment, from a guess in `now` to the solution.
pub fn coupled(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    params: &CoupledParams,
) -> Result<CoupledInfo, SolverError> {
    let friction = problem.mu > 0.0;
    let coupled = response.op.is_coupled() && friction;
    let force = problem.sum_q[0].hypot(problem.sum_q[1]);
    let limit = problem.mu * problem.sum_p;
    let mut info = CoupledInfo {
        gross_slip: friction && force >= limit * (1.0 - FULL_SLIDING),
        ..CoupledInfo::default()
    };
    make_admissible(problem, now, ws, info.gross_slip);
    now.evaluate(response, friction);
    loop {
        info.alternations += 1;

        // Pressure for known shear.
        ws.p_before.copy_from_slice(&now.p);
        let gap = NormalProblem {
            h_init: problem.h_init,
            sum_p: problem.sum_p,
        };
        let found = normal(
            response,
            &gap,
            &mut now.p,
            &mut now.u_z,
            &mut ws.normal,
            &params.normal,
        )?;
        info.normal_iterations += found.iterations;
        info.delta_z = found.delta_z;
        if !friction {
            return Ok(info);
        }

        // Shear for known pressure: the bound moves with the pressure.
        for c in 0..2 {
            ws.q_before[c].copy_from_slice(&now.q[c]);
        }
        if found.iterations > 0 {
            make_admissible(problem, now, ws, info.gross_slip);
            follow_pressure(response, now, ws, coupled);
        }
        let bound = &ws.bound;
        let slip = TangentialProblem {
            bound,
            u_ref: problem.u_ref,
            sum_q: problem.sum_q,
            free: problem.free,
        };
        if info.gross_slip {
            info.shift = incipient_shift(&slip, now, problem.sum_q);
        } else {
            let [q_x, q_y] = &mut now.q;
            let [u_x, u_y] = &mut now.u;
            let mut shear = Shear {
                q: [q_x, q_y],
                u: [u_x, u_y],
                slip: &mut now.slip,
            };
            let solve = match params.tangential.method {
                TangentialMethod::Newton => tangential,
                TangentialMethod::Gradient => shear_gradient,
            };
            let found = solve(
                response,
                &slip,
                &mut shear,
                &mut ws.tangential,
                &params.tangential,
            )?;
            info.tangential_iterations += found.passes;
            info.shift = found.shift;
        }
        if !coupled {
            return Ok(info);
        }

        // What the change of shear does to the gap.
        let mut changed = false;
        for c in 0..2 {
            for ((change, q), before) in ws.change[c].iter_mut().zip(&now.q[c]).zip(&ws.q_before[c])
            {
                *change = q - before;
                changed |= *change != 0.0;
            }
        }
        if !changed {
            return Ok(info);
        }
        let [change_x, change_y] = &ws.change;
        response.normal_under_shear([change_x, change_y], &mut ws.response[0]);
        add_scaled(&mut now.u_z, 1.0, &ws.response[0]);
        let check = super::normal::assess(problem.h_init, &now.p, &now.u_z);
        info.delta_z = check.delta_z;
        let residual = check.gap.max(check.penetration);
        if residual <= params.normal.tolerance {
            return Ok(info);
        }
        if info.alternations == params.max_alternations {
            return Err(SolverError {
                solver: "coupled",
                residual,
                tolerance: params.normal.tolerance,
                iterations: info.alternations,
            });
        }
    }
}

/// Brings the shear within the bound mu p of the present pressure and to the force asked for.
fn make_admissible(
    problem: &IncrementProblem<'_>,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    gross_slip: bool,
) {
    for (bound, p) in ws.bound.iter_mut().zip(&now.p) {
        *bound = problem.mu * p;
    }
    if gross_slip {
        let force = problem.sum_q[0].hypot(problem.sum_q[1]);
        for n in 0..now.p.len() {
            now.slip[n] = now.p[n] > 0.0;
            for c in 0..2 {
                let part = if force > 0.0 {
                    problem.sum_q[c] / force
                } else {
                    0.0
                };
                now.q[c][n] = ws.bound[n] * part;
            }
        }
    } else {
        let slip = TangentialProblem {
            bound: &ws.bound,
            u_ref: problem.u_ref,
            sum_q: problem.sum_q,
            free: problem.free,
        };
        let [q_x, q_y] = &mut now.q;
        admissible(&slip, &mut [q_x, q_y], &mut now.slip, &mut ws.change);
    }
}

/// u_t after the pressure changed from `p_before` and the shear from `q_before`.
fn follow_pressure(
    response: &mut Response<'_>,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    coupled: bool,
) {
    for c in 0..2 {
        for ((change, q), before) in ws.change[c].iter_mut().zip(&now.q[c]).zip(&ws.q_before[c]) {
            *change = q - before;
        }
    }
    for (before, p) in ws.p_before.iter_mut().zip(&now.p) {
        *before = p - *before;
    }
    let [u_x, u_y] = &mut ws.response;
    let tractions = Tractions {
        q_x: Some(&ws.change[0]),
        q_y: Some(&ws.change[1]),
        p: coupled.then_some(&ws.p_before[..]),
    };
    response.op.apply(
        tractions,
        Displacements {
            u_x: Some(u_x),
            u_y: Some(u_y),
            u_z: None,
        },
    );
    for c in 0..2 {
        add_scaled(&mut now.u[c], 1.0, &ws.response[c]);
    }
}

/// The smallest shift along the force at which every contact cell slips.
fn incipient_shift(problem: &TangentialProblem<'_>, now: &Interface, sum_q: [f64; 2]) -> [f64; 2] {
    let force = sum_q[0].hypot(sum_q[1]);
    let along = |n: usize| -> f64 {
        (0..2)
            .map(|c| (now.u[c][n] - problem.u_ref[c][n]) * sum_q[c] / force)
            .sum()
    };
    let (mean, _) = mean_where(problem.bound.len(), |n| problem.bound[n] > 0.0, along);
    let furthest = (0..problem.bound.len())
        .filter(|&n| problem.bound[n] > 0.0)
        .fold(mean, |m, n| m.max(along(n)));
    std::array::from_fn(|c| furthest * sum_q[c] / force)
}
