//! The normal problem: pressure for known shear.
//!
//! ```text
//! minimise  1/2 p.C_zz p + p.h_0   over  0 <= p <= H,  sum of p dA = W, moments of p dA = M_x, M_y
//! ```
//!
//! H is the hardness of the softer surface, infinite for elastic bodies: where p = H the surfaces overlap,
//! and the overlap is the permanent indentation (A. Almqvist et al., J. Tribol. 129 (2007) 880-886).
//!
//! with h_0 = h_init + C_zx q_x + C_zy q_y; its multipliers are the approach delta_z and the tilts
//! phi_x, phi_y, its gradient the gap h = C_zz p + h_0 - (delta_z + y phi_x - x phi_y). A motion
//! that is given enters h_0, and its load has no constraint. Conjugate gradients on the contact
//! with the constraints projected out (I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219, eq.
//! (5)-(6) of the paper), preconditioned, and not restarted when the contact set changes: cells
//! whose pressure would turn negative leave, cells that overlap enter, and the Polak-Ribiere factor
//! reduces the weight of the old direction accordingly. The displacement is updated by the response
//! to each step, so that an iteration costs one convolution, and a second one only when cells
//! leave.

use crate::cells::{Arms, Drive, add_vectors};
use crate::cells::{add_scaled, copy};
use crate::cells::{largest, set_fields, sums, sums_and_maxima, sweep};
use crate::solvers::{Response, SolverError};

/// Data: the gap, and the drive of approach and tilts.
#[derive(Clone, Copy, Debug)]
pub struct NormalProblem<'a> {
    /// Gap between the undeformed surfaces h_init \[m\].
    pub h_init: &'a [f64],
    /// Positions of the cells.
    pub arms: &'a Arms,
    /// Normal force and tilting moments, or the motions where these are prescribed.
    pub drive: Drive,
    /// Largest pressure that the surfaces bear \[Pa\]; infinite for elastic bodies.
    pub hardness: f64,
}

impl NormalProblem<'_> {
    /// Whether a cell under the pressure p with this gap is pressed in: the gap is its indentation.
    fn is_pressed_in(&self, p: f64, gap: f64) -> bool {
        p >= self.hardness && gap < 0.0
    }
}

/// Settings of the normal solver.
#[derive(Clone, Copy, Debug)]
pub struct NormalParams {
    /// Largest root-mean-square gap in the contact and deepest penetration outside with which a
    /// guess is accepted as it is \[m\].
    pub enough: f64,
    /// Tolerance of gap and penetration for the end of the iterations, once there are any \[m\].
    pub tolerance: f64,
    /// Most iterations.
    pub max_iterations: usize,
}

/// Result of the normal solver.
#[derive(Clone, Copy, Debug, Default)]
pub struct NormalInfo {
    /// Approach, and the tilts phi_x, phi_y times the length \[m\].
    pub motion: [f64; 3],
    /// Root-mean-square gap in the contact \[m\].
    pub gap: f64,
    /// Deepest penetration outside the contact \[m\].
    pub penetration: f64,
    /// Iterations done.
    pub iterations: usize,
}

impl NormalInfo {
    /// The larger of gap and penetration \[m\].
    pub fn misfit(&self) -> f64 {
        self.gap.max(self.penetration)
    }
}

/// Buffers of the normal solver.
#[derive(Debug, Default)]
pub struct NormalWorkspace {
    residual: Vec<f64>,
    last_residual: Vec<f64>,
    z: Vec<f64>,
    /// One in cells whose pressure the direction may change, zero elsewhere.
    free: Vec<f64>,
    direction: Vec<f64>,
    response: Vec<f64>,
}

impl NormalWorkspace {
    /// Allocates buffers for fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            residual: field(),
            last_residual: field(),
            z: field(),
            free: field(),
            direction: field(),
            response: field(),
        }
    }
}

/// Iterations without a smaller gap after which the preconditioner is dropped. It is built from the
/// kernel cut off at the border of the grid; a kernel that reaches far beyond it (a stiff plate on
/// a soft foundation) is badly approximated.
const MOST_WITHOUT_GAIN: usize = 50;

/// Solves for `p`, with `u_z` the total normal displacement, including the one under the shear.
///
/// On entry `p` is >= 0, not all zero where the approach is free, and `u_z` is its response; on exit
/// too, and p has the prescribed sums up to rounding.
pub fn solve_normal(
    response: &mut Response<'_>,
    problem: &NormalProblem<'_>,
    p: &mut [f64],
    u_z: &mut [f64],
    ws: &mut NormalWorkspace,
    params: &NormalParams,
) -> Result<NormalInfo, SolverError> {
    copy(p, &mut ws.response);
    balance_pressure(problem, p);
    let change_beyond_rounding = |p: f64, before: f64| (p - before).abs() - ROUNDING * p;
    let [changed] = largest([&*p, &ws.response], |_, [p, before]| {
        [change_beyond_rounding(p, before)]
    });
    if changed > 0.0 {
        add_response_of_change(response, p, u_z, ws);
    }
    let mut descent = Descent::new();
    let mut iterations = 0;
    loop {
        let info = NormalInfo {
            iterations,
            ..assess_gap(problem, p, u_z)
        };
        let misfit = info.misfit();
        descent.record_misfit(misfit);
        let tolerance = if iterations == 0 {
            params.enough
        } else {
            params.tolerance
        };
        let is_solved = misfit <= tolerance;
        if is_solved && is_balanced(problem, p) {
            return Ok(info);
        }
        if iterations == params.max_iterations || response.must_stop() {
            return Err(SolverError {
                solver: "normal",
                residual: misfit,
                tolerance,
                iterations,
            });
        }
        iterations += 1;
        if is_solved {
            // The contact at the last balance was too small to carry the moments.
            copy(p, &mut ws.response);
            balance_pressure(problem, p);
            add_response_of_change(response, p, u_z, ws);
        } else {
            descent.step(response, problem, info.motion, p, u_z, ws);
        }
    }
}

/// The conjugate gradients: data passed from one step to the next.
struct Descent {
    /// Smallest misfit \[m\], and the steps since.
    best: f64,
    since_best: usize,
    preconditioned: bool,
    /// r.z of the last direction; zero to start again.
    last_product: f64,
}

impl Descent {
    /// Starts with the preconditioner and without a last direction.
    fn new() -> Self {
        Self {
            best: f64::INFINITY,
            since_best: 0,
            preconditioned: true,
            last_product: 0.0,
        }
    }

    /// Records the misfit \[m\] of an iteration; switches the preconditioner off if it stalls.
    fn record_misfit(&mut self, misfit: f64) {
        if misfit < self.best {
            (self.best, self.since_best) = (misfit, 0);
        } else {
            self.since_best += 1;
        }
        if self.since_best == MOST_WITHOUT_GAIN && self.preconditioned {
            self.preconditioned = false;
            self.last_product = 0.0;
        }
    }

    /// Steps to the least energy along the next direction; negative pressures are set to zero.
    fn step(
        &mut self,
        response: &mut Response<'_>,
        problem: &NormalProblem<'_>,
        motion: [f64; 3],
        p: &mut [f64],
        u_z: &mut [f64],
        ws: &mut NormalWorkspace,
    ) {
        let product = self.choose_direction(response, problem, motion, p, u_z, ws);
        let [slope, curvature, squares] = line_search_terms(response, ws);
        if !(slope > 0.0 && curvature > 0.0) {
            ws.direction.fill(0.0);
            self.last_product = 0.0;
            return;
        }
        self.last_product = product;
        let step = slope / curvature;
        let hardness = problem.hardness;
        let [outside] = largest([&*p, &ws.direction], |_, [p, d]| {
            let p = p + step * d;
            [(-p).max(p - hardness)]
        });
        if outside <= 0.0 {
            response.count_change(step * step * squares);
            let changes = [&ws.direction[..], &ws.response];
            set_fields(changes, [p, u_z], |_, [d, u], [p, u_z]| {
                [p + step * d, u_z + step * u]
            });
        } else {
            set_fields(
                [&ws.direction[..]],
                [p, &mut ws.response],
                |_, [d], [p, _]| [(p + step * d).clamp(0.0, hardness), p],
            );
            balance_pressure(problem, p);
            add_response_of_change(response, p, u_z, ws);
        }
    }

    /// Chooses the next search direction on the contact and on the cells about to enter it; returns r.z.
    fn choose_direction(
        &self,
        response: &mut Response<'_>,
        problem: &NormalProblem<'_>,
        motion: [f64; 3],
        p: &[f64],
        u_z: &[f64],
        ws: &mut NormalWorkspace,
    ) -> f64 {
        let NormalWorkspace {
            residual,
            last_residual,
            z,
            free,
            direction,
            ..
        } = ws;
        let arms = problem.arms;
        std::mem::swap(residual, last_residual);
        let from = [p, u_z, problem.h_init];
        set_fields(from, [residual], |n, [p, u_z, h], _| {
            let gap = u_z + h - arms.displacement_across(motion, n);
            let changes = (p > 0.0 || gap < 0.0) && !problem.is_pressed_in(p, gap);
            [if changes { -gap } else { 0.0 }]
        });
        response.invert_normal(residual, z, self.preconditioned);
        let from = [p, residual, z];
        let hardness = problem.hardness;
        let weight_and_value = |_: usize, [p, r, z]: [f64; 3]| {
            let changes = if p < hardness {
                p > 0.0 || r > 0.0
            } else {
                r < 0.0
            };
            (f64::from(u8::from(changes)), z)
        };
        let motion_of_all = arms.fit_across(problem.drive.free, from, weight_and_value);
        // A cell at a bound of its pressure stays there if the direction would take it beyond.
        set_fields(from, [free], |n, [p, r, z], _| {
            let rises = z > arms.displacement_across(motion_of_all, n);
            let changes = if p >= hardness {
                r < 0.0 && !rises
            } else {
                p > 0.0 || (r > 0.0 && rises)
            };
            [f64::from(u8::from(changes))]
        });
        let weighted = |_: usize, [free, value]: [f64; 2]| (free, value);
        let fit = |field: &[f64]| arms.fit_across(problem.drive.free, [free, field], weighted);
        let (motion_of_free, drift) = (fit(z), fit(direction));
        let from = [&free[..], residual, last_residual];
        let [product, numerator] = sweep(from, [z], |n, [free, now, last], [z]| {
            let z = free * (z - arms.displacement_across(motion_of_free, n));
            ([z], [now * z, (now - last) * z])
        });
        let beta = if self.last_product > 0.0 {
            (numerator / self.last_product).max(0.0)
        } else {
            0.0
        };
        set_fields([&free[..], z], [direction], |n, [free, z], [d]| {
            [z + beta * free * (d - arms.displacement_across(drift, n))]
        });
        product
    }
}

/// Rounding error of the sum of a scaled pressure, over the sum.
const ROUNDING: f64 = 1e-13;

/// Most rounds of weighting and cutting that scale the pressure to its loads.
const MOST_SCALINGS: usize = 20;

/// Scales p to the prescribed force, or weights it with a rigid motion, p (1 + B m), to the force
/// and the moments.
fn balance_pressure(problem: &NormalProblem<'_>, p: &mut [f64]) {
    let Drive {
        free,
        sums: targets,
        ..
    } = problem.drive;
    if free == [false; 3] {
        return;
    }
    let hardness = problem.hardness;
    if free[0] {
        scale_pressure(p, targets[0], hardness);
    }
    if free == [true, false, false] {
        return;
    }
    let tolerance = 1e-14 * p.iter().sum::<f64>();
    for _ in 0..MOST_SCALINGS {
        let missing_loads = missing_loads(problem, p);
        if missing_loads.iter().all(|m| m.abs() <= tolerance) {
            return;
        }
        let m = problem.arms.motion_for_sums(free, p, missing_loads);
        for n in 0..p.len() {
            p[n] *= (1.0 + problem.arms.displacement_across(m, n)).max(0.0);
            p[n] = p[n].min(hardness);
        }
    }
}

/// Scales the pressure below the hardness to a sum \[Pa\]. Where all contact cells come to the hardness and
/// do not carry the sum, the rest is spread over the other cells.
pub(crate) fn scale_pressure(p: &mut [f64], target: f64, hardness: f64) {
    for _ in 0..MOST_SCALINGS {
        let [below, at] = sums(
            [&*p],
            |_, [p]| if p < hardness { [p, 0.0] } else { [0.0, p] },
        );
        if at >= target || hardness == f64::INFINITY {
            let factor = target / (below + at);
            set_fields([], [p], |_, [], [p]| [p * factor]);
            return;
        }
        if below > 0.0 {
            let factor = (target - at) / below;
            set_fields([], [p], |_, [], [p]| {
                [if p < hardness {
                    (p * factor).min(hardness)
                } else {
                    p
                }]
            });
        } else {
            let [open] = sums([&*p], |_, [p]| [f64::from(u8::from(p <= 0.0))]);
            let share = ((target - at) / open.max(1.0)).min(hardness);
            set_fields([], [p], |_, [], [p]| [if p <= 0.0 { share } else { p }]);
        }
        let [sum] = sums([&*p], |_, [p]| [p]);
        if (sum - target).abs() <= ROUNDING * target {
            return;
        }
    }
}

/// Prescribed loads minus the sums of the pressure; zero for prescribed motions.
fn missing_loads(problem: &NormalProblem<'_>, p: &[f64]) -> [f64; 3] {
    let sums = sums([p], |n, [p]| problem.arms.loads_across(p, n));
    let drive = problem.drive;
    let missing = |k: usize| drive.sums[k] - sums[k];
    std::array::from_fn(|k| if drive.free[k] { missing(k) } else { 0.0 })
}

/// Tolerance of the balance at the end, over the load; rounding errors are far smaller.
const BALANCED: f64 = 1e-10;

/// Whether the pressure carries the moments; the force is met by construction.
fn is_balanced(problem: &NormalProblem<'_>, p: &[f64]) -> bool {
    if problem.drive.free[1..] == [false; 2] {
        return true;
    }
    let tolerance = BALANCED * p.iter().sum::<f64>();
    missing_loads(problem, p)
        .iter()
        .all(|m| m.abs() <= tolerance)
}

/// Adds to `u_z` the response to the change of p from `ws.response`.
fn add_response_of_change(
    response: &mut Response<'_>,
    p: &[f64],
    u_z: &mut [f64],
    ws: &mut NormalWorkspace,
) {
    let from = [p, &ws.response];
    let [squares] = sweep(from, [&mut ws.z], |_, [p, before], _| {
        let change = p - before;
        ([change], [change * change])
    });
    response.count_change(squares);
    response.respond_to_pressure(&ws.z, &mut ws.response);
    add_scaled(u_z, 1.0, &ws.response);
}

/// The rigid motion (least squares fit to h_init + u_z over the contact) and the residuals of the
/// equations.
pub(crate) fn assess_gap(problem: &NormalProblem<'_>, p: &[f64], u_z: &[f64]) -> NormalInfo {
    let Drive { free, given, .. } = problem.drive;
    let fields = [p, u_z, problem.h_init];
    let weight_and_gap = |n: usize, [p, u_z, h]: [f64; 3]| {
        let touches = f64::from(u8::from(p > 0.0 && p < problem.hardness));
        (
            touches,
            u_z + h - problem.arms.displacement_across(given, n),
        )
    };
    let mut motion = add_vectors(given, problem.arms.fit_across(free, fields, weight_and_gap));
    if free[0] && problem.hardness < f64::INFINITY && is_indented_everywhere(problem, p) {
        // No cell that is closed without being pressed in fixes the approach: the least one.
        let [approach] = largest(fields, |n, [p, u_z, h]| {
            let tilt = problem
                .arms
                .displacement_across([0.0, motion[1], motion[2]], n);
            [if p > 0.0 {
                u_z + h - tilt
            } else {
                f64::NEG_INFINITY
            }]
        });
        motion[0] = approach;
    }
    let ([squares, contact], [penetration]) = sums_and_maxima(fields, |n, [p, u_z, h]| {
        let gap = u_z + h - problem.arms.displacement_across(motion, n);
        if problem.is_pressed_in(p, gap) {
            ([0.0, 1.0], [0.0])
        } else if p > 0.0 {
            ([gap * gap, 1.0], [0.0])
        } else {
            ([0.0; 2], [-gap])
        }
    });
    let gap = (squares / contact.max(1.0)).sqrt();
    NormalInfo {
        motion,
        gap,
        penetration,
        iterations: 0,
    }
}

/// Whether all cells in contact are at the hardness.
fn is_indented_everywhere(problem: &NormalProblem<'_>, p: &[f64]) -> bool {
    p.iter().all(|&p| p <= 0.0 || p >= problem.hardness)
}

/// Slope and curvature of the energy along the direction, and the sum of its squares; its response
/// goes to the workspace.
fn line_search_terms(response: &mut Response<'_>, ws: &mut NormalWorkspace) -> [f64; 3] {
    response.respond_to_pressure(&ws.direction, &mut ws.response);
    let fields = [&ws.residual[..], &ws.direction, &ws.response];
    sums(fields, |_, [r, d, u]| [r * d, d * u, d * d])
}
