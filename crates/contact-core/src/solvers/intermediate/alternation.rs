//! The intermediate loop: pressure and shear of one increment together (figure 2 of the paper).
//!
//! The pressure is found for known shear, then the shear for known pressure, until the gap that
//! the shear leaves behind is within the tolerance. Where the bodies are similar neither changes
//! the other and one pass is exact. The displacements are carried along: each solver adds the
//! response to what it changed, from those of the last increment on. Where single precision answers,
//! what it may have missed adds up; before that comes to matter, a full convolution ties the
//! displacements to the tractions again.

use super::mixing::Mixing;
use crate::cells::set;
use crate::cells::{Arms, Drive, add};
use crate::cells::{copy, size};
use crate::convolution::{Displacements, Tractions};
use crate::solvers::inner::admissible;
use crate::solvers::inner::first_shift;
use crate::solvers::inner::shear_gradient;
use crate::solvers::inner::{
    NormalParams, NormalProblem, NormalWorkspace, TangentialMethod, TangentialParams,
    TangentialProblem, TangentialWorkspace, normal, tangential,
};
use crate::solvers::inner::{Sliding, exceeds, sliding};
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
    /// Tractions near the solution, and the displacements that belong to them.
    pub known: Option<&'a Interface>,
}

/// The displacements that mean no slip in an increment.
pub trait SlipDatum {
    /// Goes a `part` of the way to where the solution, as far as it is known, and its shift would have
    /// them; whether they follow at all.
    fn follow(&mut self, now: &Interface, shift: [f64; 3], part: f64) -> bool;
    /// The displacements \[m\].
    fn displacements(&self) -> [&[f64]; 2];
    /// The part of a turn of the shear that they take over from the slip, in each cell.
    fn turning(&self) -> &[f64];
}

/// Steps without a smaller misfit, each halving the part of the way that the displacements that mean no
/// slip follow, after which these stay in a pass, and passes after which they stay for good.
const STALLED: usize = 5;
const LOST: usize = 3;
/// The first pass ends with a step that begins with less than this part of its first misfit, where
/// that is more than so many times the tolerance.
const NEARER: f64 = 0.5;
const FAR: f64 = 3.0;
/// Part of the tolerances that rounding may come to; beyond a half of it a solution is not begun.
const ROUNDED: f64 = 0.1;
/// Iterations whose changes are about what they change together; where it takes more, some go back and
/// forth, and what that has rounded is not known.
const STRAIGHT: usize = 30;
/// Most looks.
const LOOKS: usize = 5;

/// Settings of the intermediate loop.
#[derive(Clone, Copy, Debug)]
pub struct CoupledParams {
    /// Largest root-mean-square gap in the contact and deepest penetration outside at the end \[m\].
    pub tolerance: f64,
    /// Settings of the normal solver.
    pub normal: NormalParams,
    /// Settings of the tangential solver.
    pub tangential: TangentialParams,
    /// Most passes.
    pub max_alternations: usize,
}

impl CoupledParams {
    /// What rounding may add to the displacements \[m\].
    fn rounding(&self) -> f64 {
        ROUNDED * self.tolerance.min(self.tangential.tolerance)
    }
}

/// What the intermediate loop ended with.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoupledInfo {
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

impl CoupledInfo {
    /// Whether the loads are more than friction can carry: there is no equilibrium, and the shear
    /// was not solved for.
    pub fn exceeds_friction(&self) -> bool {
        exceeds(self.friction_used)
    }

    fn iterations(&self) -> usize {
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
pub struct CoupledWorkspace {
    normal: NormalWorkspace,
    tangential: TangentialWorkspace,
    bound: Vec<f64>,
    p_before: Vec<f64>,
    /// The shear that u_z answers to.
    q_before: [Vec<f64>; 2],
    change: [Vec<f64>; 2],
    response: [Vec<f64>; 2],
    /// Tractions q_x, q_y, p that the iterations begin with.
    begun: [Vec<f64>; 3],
    mixing: Mixing,
    /// Passes in which the displacements that mean no slip could not be followed to the end.
    lost: usize,
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
            begun: [field(), field(), field()],
            mixing: Mixing::new(cells),
            lost: 0,
        }
    }

    fn change_of_shear(&mut self, now: &Interface) {
        let ([change_x, change_y], before) = (&mut self.change, &self.q_before);
        let from = [&now.q[0][..], &now.q[1], &before[0], &before[1]];
        set(from, [change_x, change_y], |_, [q_x, q_y, x, y], _| {
            [q_x - x, q_y - y]
        });
        if now.owed.owes() {
            let [x, y] = &now.owed.q;
            set([&x[..], y], [change_x, change_y], |_, owed, change| {
                [change[0] - owed[0], change[1] - owed[1]]
            });
        }
    }
}

/// Solves one increment, from a guess in `now` to the solution; with all digits where some are not
/// enough.
pub fn coupled(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    datum: &mut dyn SlipDatum,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    params: &CoupledParams,
) -> Result<CoupledInfo, SolverError> {
    let rounds = response.rounding() > 0.0;
    match look(response, problem, datum, now, ws, params) {
        Err(_) if rounds && !response.stopped() => {
            response.exact = true;
            let solved = look(response, problem, datum, now, ws, params);
            response.exact = false;
            solved
        }
        ended => ended,
    }
}

/// Looks at the solution until nothing is left to do.
fn look(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    datum: &mut dyn SlipDatum,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    params: &CoupledParams,
) -> Result<CoupledInfo, SolverError> {
    let friction = problem.mu.iter().any(|&mu| mu > 0.0);
    let coupled = response.op.is_coupled() && friction;
    let rounds = response.rounding() > 0.0;
    let mut info = CoupledInfo::default();
    let mut slides = make_admissible(problem, datum.displacements(), now, ws, friction);
    ws.lost = 0;
    for look in 0..LOOKS {
        let known = problem.known.filter(|_| look == 0);
        let before = info.iterations();
        begin(response, known, now, ws, params, friction);
        ws.mixing.restart();
        loop {
            info.alternations += 1;

            // Pressure for known shear.
            copy(&now.p, &mut ws.p_before);
            let gap = NormalProblem {
                h_init: problem.h_init,
                arms: problem.arms,
                drive: problem.normal,
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
            info.approach = found.motion;
            if !friction || now.p.iter().all(|&p| p <= 0.0) {
                break;
            }

            // Shear for known pressure: the bound moves with the pressure.
            now.answered(ws.q_before.each_mut().map(|q| &mut q[..]));
            if found.iterations > 0 {
                slides = make_admissible(problem, datum.displacements(), now, ws, friction);
                follow_pressure(response, now, ws, coupled);
            }
            info.friction_used = slides.used;
            if info.exceeds_friction() {
                return Ok(info);
            }
            let settled = if slides.is_full() {
                let slip = problem.slip(&ws.bound, datum.displacements());
                info.shift = incipient_shift(&slip, now, slides.motion);
                true
            } else {
                shear_under(response, problem, datum, now, ws, params, &mut info)?
            };
            if !coupled {
                break;
            }

            // What the change of shear does to the gap.
            ws.change_of_shear(now);
            if ws.change.iter().flatten().any(|&change| change != 0.0) {
                let [change_x, change_y] = &ws.change;
                response.normal_under_shear([change_x, change_y], &mut ws.response[0]);
            } else if ws.mixing.mixes() {
                ws.response[0].fill(0.0);
            } else {
                break;
            }
            ws.mixing.settle(&ws.response[0], &mut now.u_z);
            let check = crate::solvers::inner::assess(&gap, &now.p, &now.u_z);
            info.approach = check.motion;
            let residual = check.gap.max(check.penetration);
            if residual <= params.tolerance && settled {
                break;
            }
            if info.alternations >= params.max_alternations {
                return Err(SolverError {
                    solver: "coupled",
                    residual,
                    tolerance: params.tolerance,
                    iterations: info.alternations,
                });
            }
            ws.mixing.mix(&now.p, &mut now.u_z);
        }
        if !rounds {
            break;
        }
        let [q_x, q_y, p] = &ws.begun;
        now.rounding += response.rounding() * now.differs([q_x, q_y, p]);
        let straight = info.iterations() - before <= STRAIGHT;
        if straight && now.rounding <= params.rounding() {
            break;
        }
    }
    Ok(info)
}

/// The displacements of the guess: from known ones, unless too many digits have been lost on the way.
fn begin(
    response: &mut Response<'_>,
    known: Option<&Interface>,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    params: &CoupledParams,
    friction: bool,
) {
    let allowed = if response.rounding() > 0.0 {
        0.5 * params.rounding()
    } else {
        0.0
    };
    let mut rounded = f64::INFINITY;
    if let Some(known) = known.filter(|known| known.rounding < allowed) {
        let [q_x, q_y] = &mut ws.change;
        now.follow(known, response, friction, [q_x, q_y, &mut ws.p_before]);
        rounded = now.rounding;
    }
    if rounded > allowed {
        now.evaluate(response, friction);
    }
    for (begun, traction) in ws.begun.iter_mut().zip(now.tractions()) {
        copy(traction, begun);
    }
}

/// Shear for known pressure, with the displacements that mean no slip where the solution says: these
/// follow after each step, as long as the misfit falls. Whether it is settled: far from the solution the
/// first pass ends early, since it moves the pressure, which moves the shear again.
fn shear_under(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    datum: &mut dyn SlipDatum,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    params: &CoupledParams,
    info: &mut CoupledInfo,
) -> Result<bool, SolverError> {
    let first_of_more = info.alternations == 1 && params.max_alternations > 1;
    let ends_early = first_of_more && response.op.is_coupled();
    let params = &params.tangential;
    let solve = match params.method {
        TangentialMethod::Newton => tangential,
        TangentialMethod::Gradient => shear_gradient,
    };
    if info.alternations == 1 {
        let slip = problem.slip(&ws.bound, datum.displacements());
        info.shift = first_shift(&slip, &now.shear());
    }
    let (mut least, mut stalled, mut part) = (f64::INFINITY, 0, 1.0);
    let (mut step, mut first) = (0, None);
    loop {
        step += 1;
        let follows = stalled < STALLED && ws.lost < LOST && datum.follow(now, info.shift, part);
        let slip = TangentialProblem {
            turning: if follows { datum.turning() } else { &[] },
            ..problem.slip(&ws.bound, datum.displacements())
        };
        let inner = &mut ws.tangential;
        let found = solve(response, &slip, &mut now.shear(), inner, params)?;
        info.tangential_iterations += found.passes;
        info.shift = found.shift;
        if !follows || found.iterations == 0 {
            return Ok(true);
        }
        let nearer = found.misfit <= NEARER * *first.get_or_insert(found.misfit);
        if ends_early && nearer && found.misfit > FAR * params.tolerance {
            return Ok(false);
        }
        if found.misfit < least {
            (least, stalled) = (found.misfit, 0);
        } else {
            stalled += 1;
            part *= 0.5;
        }
        if step == params.max_iterations {
            stalled = STALLED;
        }
        if stalled == STALLED {
            ws.lost += 1;
        }
    }
}

/// Brings the shear within the bound mu p of the present pressure and to the loads asked for.
fn make_admissible(
    problem: &IncrementProblem<'_>,
    u_ref: [&[f64]; 2],
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    friction: bool,
) -> Sliding {
    if !friction {
        return Sliding::default();
    }
    set([problem.mu, &now.p], [&mut ws.bound], |_, [mu, p], _| {
        [friction_bound(mu, p)]
    });
    let slip = problem.slip(&ws.bound, u_ref);
    let slides = sliding(&slip);
    if slides.is_full() {
        for n in 0..now.p.len() {
            now.slip[n] = now.p[n] > 0.0;
            let along = problem.arms.in_plane(slides.motion, n);
            let size = size(along).max(f64::MIN_POSITIVE);
            for c in 0..2 {
                now.q[c][n] = ws.bound[n] * along[c] / size;
            }
        }
    } else {
        let [q_x, q_y] = &mut now.q;
        admissible(&slip, &mut [q_x, q_y], &mut now.slip);
    }
    slides
}

/// Largest shear under the pressure p \[Pa\].
pub(crate) fn friction_bound(mu: f64, p: f64) -> f64 {
    if p > 0.0 { mu * p } else { 0.0 }
}

/// u_t after the pressure changed from `p_before` and the shear that is answered from `q_before`.
fn follow_pressure(
    response: &mut Response<'_>,
    now: &mut Interface,
    ws: &mut CoupledWorkspace,
    coupled: bool,
) {
    now.owed.settle();
    ws.change_of_shear(now);
    set([&now.p[..]], [&mut ws.p_before], |_, [p], [before]| {
        [p - before]
    });
    let [u_x, u_y] = &mut ws.response;
    let tractions = Tractions {
        q_x: Some(&ws.change[0]),
        q_y: Some(&ws.change[1]),
        p: coupled.then_some(&ws.p_before[..]),
    };
    response.respond(
        tractions,
        Displacements {
            u_x: Some(u_x),
            u_y: Some(u_y),
            u_z: None,
        },
    );
    let ([of_x, of_y], [u_x, u_y]) = (&ws.response, &mut now.u);
    set([&of_x[..], of_y], [u_x, u_y], |_, of, u| {
        [u[0] + of[0], u[1] + of[1]]
    });
}

/// The smallest motion of the kind `sliding` at which every contact cell slips.
fn incipient_shift(
    problem: &TangentialProblem<'_>,
    now: &Interface,
    sliding: [f64; 3],
) -> [f64; 3] {
    let given = problem.drive.given;
    let needed = |n: usize| -> f64 {
        let along = problem.arms.in_plane(sliding, n);
        let given = problem.arms.in_plane(given, n);
        let ahead: f64 = (0..2)
            .map(|c| (now.u[c][n] - problem.u_ref[c][n] - given[c]) * along[c])
            .sum();
        ahead / (along[0] * along[0] + along[1] * along[1])
    };
    let furthest = (0..problem.bound.len())
        .filter(|&n| problem.bound[n] > 0.0)
        .map(needed)
        .filter(|needed| needed.is_finite())
        .fold(f64::NEG_INFINITY, f64::max);
    add(given, sliding.map(|s| furthest * s))
}

impl<'a> IncrementProblem<'a> {
    /// The tangential problem under a friction bound.
    fn slip(&self, bound: &'a [f64], u_ref: [&'a [f64]; 2]) -> TangentialProblem<'a> {
        TangentialProblem {
            bound,
            u_ref,
            turning: &[],
            arms: self.arms,
            drive: self.tangential,
        }
    }
}
