//! What physics asks of every increment, computed from the fields and the motions at its two ends
//! alone.

mod contact;
mod coulomb;
mod dissipation;
mod energy;
pub(crate) mod misfit;
mod response;
mod rolled;
mod sector;
mod slip;
mod status;

use std::fmt::{Debug, Formatter, Result};

use contact_core::march::{Fields, Increment, March, Motion};
use contact_core::plan::Plan;
use contact_core::scene::{Loads, Scene};
use ndarray::Array2;

use self::misfit::Misfit;
use self::response::Response;
use self::slip::Rest;

/// What sums of up to 2^16 cells lose to rounding, 2^16 eps = 1.5e-11, and a margin: force balance
/// and Coulomb's law hold by construction.
const ROUNDING: f64 = 1e-9;

/// What is asked.
#[derive(Clone, Copy, Debug)]
enum Law {
    Finite,
    Response,
    Balance,
    Contact,
    Coulomb,
    Stick,
    Slip,
    Dissipation,
    Energy,
    Monotone,
    Report,
    Status,
}

/// How far each law is off over what the tolerance allows: above 1 is a violation.
#[derive(Clone, Copy, Default)]
pub(crate) struct Violations(pub(crate) [f64; Self::NAMES.len()]);

impl Violations {
    /// In the order of [`Law`].
    pub(crate) const NAMES: [&'static str; 12] = [
        "finite numbers",
        "displacements of the tractions",
        "force balance",
        "complementarity",
        "Coulomb's law",
        "motion of cells that stick",
        "direction of slip",
        "energy that friction takes",
        "energy identity",
        "monotone contact",
        "residuals as reported",
        "status and stick area beside the cells",
    ];

    /// Whether all laws hold.
    pub(crate) fn hold(&self) -> bool {
        self.0.iter().all(|value| *value <= 1.0)
    }

    /// Takes the worse of both for each law.
    pub(crate) fn worse(&mut self, other: &Self) {
        for (worst, value) in self.0.iter_mut().zip(other.0) {
            *worst = worst.max(value);
        }
    }

    fn raise(&mut self, law: Law, value: f64) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        let worst = &mut self.0[law as usize];
        *worst = worst.max(value);
    }
}

impl Debug for Violations {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_map()
            .entries(Self::NAMES.into_iter().zip(self.0))
            .finish()
    }
}

/// Fields, motion and loads at one end of an increment.
struct End {
    fields: Fields,
    motion: Motion,
    loads: Loads,
}

/// Follows a run.
pub(crate) struct Audit {
    scene: Scene,
    h_init: Array2<f64>,
    misfit: Misfit,
    coupling: bool,
    response: Response,
    /// The start of the next increment.
    start: End,
    /// Where cells have come to rest.
    rest: Rest,
    /// Work of the loads so far \[J\].
    work: f64,
}

impl Audit {
    pub(crate) fn new(scene: &Scene) -> Self {
        let plan = Plan::new(scene);
        let h_init = scene.h_init();
        // The bodies just touch.
        let touching = h_init.iter().copied().fold(f64::INFINITY, f64::min);
        Self {
            h_init,
            misfit: Misfit::of(scene),
            coupling: plan.coupling,
            response: Response::new(scene, &plan),
            start: End {
                fields: unloaded(scene),
                motion: Motion {
                    delta_z: touching,
                    ..Motion::default()
                },
                loads: Loads::default(),
            },
            rest: Rest::new(scene),
            work: 0.0,
            scene: scene.clone(),
        }
    }

    /// Audits an increment that `march` has just solved.
    pub(crate) fn check(&mut self, march: &March, increment: &Increment) -> Violations {
        let now = End {
            fields: march.fields(),
            motion: increment.motion,
            loads: increment.point.loads,
        };
        let mut found = Violations::default();
        if !is_finite(&now, increment) {
            found.raise(Law::Finite, f64::INFINITY);
            return found;
        }
        self.check_response(&now.fields, &mut found);
        self.check_contact(&now, increment, &mut found);
        self.check_status(&now, increment, &mut found);
        let rolled = self.rolls(&now);
        if rolled == 0 {
            self.check_monotone(&now, &mut found);
        }
        self.roll(rolled);
        self.check_coulomb(&now, increment, &mut found);
        self.check_slip(&now, increment, &mut found);
        self.check_dissipation(&now, increment, &mut found);
        self.check_energy((&now, rolled), increment, &mut found);
        self.start = now;
        found
    }

    /// How far the bodies were shifted in the increment \[m\].
    fn shift(&self, now: &End) -> [f64; 2] {
        let (from, to) = (&self.start.motion, &now.motion);
        [to.delta_x - from.delta_x, to.delta_y - from.delta_y]
    }

    /// How far a cell of body 2 has moved against body 1 in the increment \[m\], eq. (7).
    fn moved(&self, now: &Fields, shift: [f64; 2], n: (usize, usize)) -> [f64; 2] {
        let last = &self.start.fields;
        [
            now.u_x[n] - last.u_x[n] - shift[0],
            now.u_y[n] - last.u_y[n] - shift[1],
        ]
    }

    /// What the slip that the fields add up has grown by in the increment \[m\].
    fn gain(&self, now: &Fields, n: (usize, usize)) -> [f64; 2] {
        let last = &self.start.fields;
        [
            now.slip_x[n] - last.slip_x[n],
            now.slip_y[n] - last.slip_y[n],
        ]
    }
}

fn is_finite(now: &End, increment: &Increment) -> bool {
    let f = &now.fields;
    let fields = [
        &f.p, &f.q_x, &f.q_y, &f.u_x, &f.u_y, &f.u_z, &f.slip_x, &f.slip_y,
    ];
    let motions = now.motion.motions();
    fields
        .into_iter()
        .flatten()
        .chain(&motions)
        .all(|v| v.is_finite())
        && increment.energy.imbalance().is_finite()
}

fn size(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Whether a cell is held: at the limit of friction it may slip by less than an increment can tell.
fn held(f: &Fields, n: (usize, usize)) -> bool {
    f.stick[n] && !f.at_limit[n]
}

fn shear(f: &Fields, n: (usize, usize)) -> [f64; 2] {
    [f.q_x[n], f.q_y[n]]
}

/// The fields of two bodies that do not touch.
fn unloaded(scene: &Scene) -> Fields {
    let zero = Array2::zeros((scene.grid.nx, scene.grid.ny));
    let nowhere = zero.mapv(|_: f64| false);
    Fields {
        p: zero.clone(),
        q_x: zero.clone(),
        q_y: zero.clone(),
        u_x: zero.clone(),
        u_y: zero.clone(),
        u_z: zero.clone(),
        gap: scene.h_init(),
        indentation: zero.clone(),
        slip_x: zero.clone(),
        slip_y: zero.clone(),
        dissipated: zero,
        contact: nowhere.clone(),
        stick: nowhere.clone(),
        at_limit: nowhere,
        yielded: None,
    }
}
