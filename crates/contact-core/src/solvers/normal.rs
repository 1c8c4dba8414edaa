//! The normal problem: pressure for known shear.
//!
//! ```text
//! minimise  1/2 p.C_zz p + p.h_0   over  p >= 0,  sum of p dA = W
//! ```
//!
//! with h_0 = h_init + C_zx q_x + C_zy q_y; its multiplier is the approach delta_z, its gradient the
//! gap h = C_zz p + h_0 - delta_z. Conjugate gradients on the contact with the force constraint
//! projected out (I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219, eq. (5)-(6) of the paper),
//! preconditioned, and kept going when the contact set changes: cells whose pressure would turn
//! negative leave, cells that overlap enter, and the Polak-Ribiere factor forgets the old
//! direction as far as the change makes it useless. The displacement is carried along, so an
//! iteration costs one convolution, and a second one only when cells leave.

use super::vector::{add_scaled, dot, mean_where};
use super::{Response, SolverError};

/// What is given: the gap and the force.
#[derive(Clone, Copy, Debug)]
pub struct NormalProblem<'a> {
    /// Gap between the undeformed surfaces h_init \[m\].
    pub h_init: &'a [f64],
    /// Sum of the pressure over the cells, W over the area of a cell \[Pa\], positive.
    pub sum_p: f64,
}

/// Settings of the normal solver.
#[derive(Clone, Copy, Debug)]
pub struct NormalParams {
    /// Largest root-mean-square gap in the contact and deepest penetration outside \[m\].
    pub tolerance: f64,
    /// Most iterations.
    pub max_iterations: usize,
}

/// What the normal solver ended with.
#[derive(Clone, Copy, Debug, Default)]
pub struct NormalInfo {
    /// Approach \[m\].
    pub delta_z: f64,
    /// Root-mean-square gap in the contact \[m\].
    pub gap: f64,
    /// Deepest penetration outside the contact \[m\].
    pub penetration: f64,
    /// Iterations done.
    pub iterations: usize,
}

/// Buffers of the normal solver.
#[derive(Debug, Default)]
pub struct NormalWorkspace {
    residual: Vec<f64>,
    last_residual: Vec<f64>,
    z: Vec<f64>,
    /// Cells whose pressure the direction may change.
    free: Vec<bool>,
    direction: Vec<f64>,
    response: Vec<f64>,
}

impl NormalWorkspace {
    /// For fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            residual: field(),
            last_residual: field(),
            z: field(),
            free: vec![false; cells],
            direction: field(),
            response: field(),
        }
    }
}

/// Solves for `p`, with `u_z` the total normal displacement, that under the shear included.
///
/// On entry `p` is >= 0 and not all zero and `u_z` belongs to it; on exit too, and p sums to
/// `sum_p` up to rounding.
pub fn normal(
    response: &mut Response<'_>,
    problem: &NormalProblem<'_>,
    p: &mut [f64],
    u_z: &mut [f64],
    ws: &mut NormalWorkspace,
    params: &NormalParams,
) -> Result<NormalInfo, SolverError> {
    ws.response.copy_from_slice(p);
    balance(problem.sum_p, p);
    if p.iter()
        .zip(&ws.response)
        .any(|(p, before)| (p - before).abs() > 1e-15 * p)
    {
        add_response_of_change(response, p, u_z, ws);
    }
    let mut last_product = 0.0;
    let mut iterations = 0;
    loop {
        let mut info = assess(problem.h_init, p, u_z);
        info.iterations = iterations;
        if info.gap <= params.tolerance && info.penetration <= params.tolerance {
            return Ok(info);
        }
        if iterations == params.max_iterations || response.stopped() {
            return Err(SolverError {
                solver: "normal",
                residual: info.gap.max(info.penetration),
                tolerance: params.tolerance,
                iterations,
            });
        }
        iterations += 1;

        let product = descend(response, problem, info.delta_z, p, u_z, ws, last_product);
        let (slope, curvature) = line(response, ws);
        if !(slope > 0.0 && curvature > 0.0) {
            ws.direction.fill(0.0);
            last_product = 0.0;
            continue;
        }
        last_product = product;
        let step = slope / curvature;
        if p.iter()
            .zip(&ws.direction)
            .all(|(p, d)| p + step * d >= 0.0)
        {
            add_scaled(p, step, &ws.direction);
            add_scaled(u_z, step, &ws.response);
        } else {
            ws.response.copy_from_slice(p);
            p.iter_mut()
                .zip(&ws.direction)
                .for_each(|(p, d)| *p = (*p + step * d).max(0.0));
            balance(problem.sum_p, p);
            add_response_of_change(response, p, u_z, ws);
        }
    }
}

/// Scales p to the sum asked for.
fn balance(sum_p: f64, p: &mut [f64]) {
    let factor = sum_p / p.iter().sum::<f64>();
    for p in p {
        *p *= factor;
    }
}

/// Adds to `u_z` the response to the change of p from `ws.response`.
fn add_response_of_change(
    response: &mut Response<'_>,
    p: &[f64],
    u_z: &mut [f64],
    ws: &mut NormalWorkspace,
) {
    for ((change, p), before) in ws.z.iter_mut().zip(p).zip(&ws.response) {
        *change = p - before;
    }
    response.normal(&ws.z, &mut ws.response);
    add_scaled(u_z, 1.0, &ws.response);
}

/// The approach (the mean of h_init + u_z over the contact) and what the equations miss.
pub(crate) fn assess(h_init: &[f64], p: &[f64], u_z: &[f64]) -> NormalInfo {
    let surface = |n: usize| u_z[n] + h_init[n];
    let (delta_z, contact) = mean_where(p.len(), |n| p[n] > 0.0, surface);
    let (mut squares, mut penetration) = (0.0, 0.0_f64);
    for n in 0..p.len() {
        let gap = surface(n) - delta_z;
        if p[n] > 0.0 {
            squares += gap * gap;
        } else {
            penetration = penetration.max(-gap);
        }
    }
    let gap = (squares / contact.max(1) as f64).sqrt();
    NormalInfo {
        delta_z,
        gap,
        penetration,
        iterations: 0,
    }
}

/// Next search direction on the contact and on the cells about to enter it; returns r.z.
fn descend(
    response: &mut Response<'_>,
    problem: &NormalProblem<'_>,
    delta_z: f64,
    p: &[f64],
    u_z: &[f64],
    ws: &mut NormalWorkspace,
    last_product: f64,
) -> f64 {
    let cells = p.len();
    std::mem::swap(&mut ws.residual, &mut ws.last_residual);
    for n in 0..cells {
        let gap = u_z[n] + problem.h_init[n] - delta_z;
        ws.residual[n] = if p[n] > 0.0 || gap < 0.0 { -gap } else { 0.0 };
    }
    response.invert_normal(&ws.residual, &mut ws.z);
    let enters = |n: usize| ws.residual[n] > 0.0;
    let (mean_of_all, _) = mean_where(cells, |n| p[n] > 0.0 || enters(n), |n| ws.z[n]);
    // A cell without pressure that the direction would pull at stays out.
    let free = |n: usize| p[n] > 0.0 || (enters(n) && ws.z[n] > mean_of_all);
    let (mean, count) = mean_where(cells, free, |n| ws.z[n]);
    let (mut product, mut fresh, mut sum) = (0.0, 0.0, 0.0);
    for n in 0..cells {
        ws.free[n] = p[n] > 0.0 || (enters(n) && ws.z[n] > mean_of_all);
        if ws.free[n] {
            ws.z[n] -= mean;
            product += ws.residual[n] * ws.z[n];
            fresh += (ws.residual[n] - ws.last_residual[n]) * ws.z[n];
            sum += ws.direction[n];
        }
    }
    let beta = if last_product > 0.0 {
        (fresh / last_product).max(0.0)
    } else {
        0.0
    };
    let drift = beta * sum / count.max(1) as f64;
    for n in 0..cells {
        let d = ws.direction[n];
        ws.direction[n] = if ws.free[n] {
            ws.z[n] + beta * d - drift
        } else {
            0.0
        };
    }
    product
}

/// Slope and curvature of the energy along the direction; its response goes to the workspace.
fn line(response: &mut Response<'_>, ws: &mut NormalWorkspace) -> (f64, f64) {
    response.normal(&ws.direction, &mut ws.response);
    (
        dot(&ws.residual, &ws.direction),
        dot(&ws.direction, &ws.response),
    )
}
