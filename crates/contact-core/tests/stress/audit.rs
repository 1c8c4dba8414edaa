//! What physics asks of every increment, computed from the fields alone.

use contact_core::march::{Fields, Increment, March, Motion, Status};
use contact_core::scene::Loads;
use ndarray::Array2;

/// How far the equations are off, each over what the tolerance allows: above 1 is a violation.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Violations {
    pub(crate) nan: f64,
    pub(crate) balance: f64,
    pub(crate) contact: f64,
    pub(crate) coulomb: f64,
    pub(crate) slip: f64,
    pub(crate) energy: f64,
    pub(crate) monotone: f64,
}

impl Violations {
    pub(crate) const NAMES: [&str; 7] = [
        "finite numbers",
        "force balance",
        "complementarity",
        "Coulomb's law",
        "stick and slip",
        "energy identity",
        "monotone contact",
    ];

    pub(crate) fn values(&self) -> [f64; 7] {
        [
            self.nan,
            self.balance,
            self.contact,
            self.coulomb,
            self.slip,
            self.energy,
            self.monotone,
        ]
    }

    pub(crate) fn worse(&mut self, other: &Self) {
        self.nan = self.nan.max(other.nan);
        self.balance = self.balance.max(other.balance);
        self.contact = self.contact.max(other.contact);
        self.coulomb = self.coulomb.max(other.coulomb);
        self.slip = self.slip.max(other.slip);
        self.energy = self.energy.max(other.energy);
        self.monotone = self.monotone.max(other.monotone);
    }
}

/// Force balance and Coulomb's law hold to rounding.
const ROUNDING: f64 = 1e-9;

/// Follows a run.
pub(crate) struct Audit {
    h_init: Array2<f64>,
    /// Solver's tolerance as a length \[m\].
    tolerance: f64,
    last: Option<(Fields, Motion, Loads)>,
    work: f64,
}

impl Audit {
    pub(crate) fn new(march: &March) -> Self {
        let scene = march.scene();
        let yardstick = scene.hertz().map_or(0.0, |h| h.delta_z);
        Self {
            h_init: scene.h_init(),
            tolerance: scene.settings.solver.tolerance * yardstick,
            last: None,
            work: 0.0,
        }
    }

    pub(crate) fn check(&mut self, march: &March, increment: &Increment) -> Violations {
        let now = march.fields();
        let mut found = Violations::default();
        let real = [
            &now.p,
            &now.q_x,
            &now.q_y,
            &now.u_x,
            &now.u_y,
            &now.u_z,
            &now.slip_x,
            &now.slip_y,
        ];
        let numbers = [
            increment.motion.delta_x,
            increment.motion.delta_y,
            increment.motion.delta_z,
            increment.energy.imbalance(),
        ];
        let finite = real.iter().all(|f| f.iter().all(|v| v.is_finite()))
            && numbers.iter().all(|v| v.is_finite());
        if !finite {
            found.nan = f64::INFINITY;
            return found;
        }
        found.balance = balance(march, &now, increment) / ROUNDING;
        // The solver bounds root-mean-square misfits over the contact: one cell may hold all of it.
        let cells = now.contact.iter().filter(|c| **c).count() as f64;
        let allowed = cells.sqrt() * self.tolerance * increment.work.parts as f64;
        let gap = &now.u_z + &self.h_init - increment.motion.delta_z;
        for (&p, &gap) in now.p.iter().zip(&gap) {
            if p < 0.0 {
                found.contact = f64::INFINITY;
            }
            let off = if p > 0.0 { gap.abs() } else { -gap };
            if increment.point.loads.W > 0.0 {
                found.contact = found.contact.max(off / allowed);
            }
        }
        self.friction(march, &now, increment, allowed, &mut found);
        self.work += increment.energy.work.abs();
        if self.work > 0.0 {
            let limit = march.scene().settings.solver.tolerance * self.work;
            found.energy = increment.energy.imbalance().abs() / limit;
        }
        self.monotone(march, &now, increment, &mut found);
        self.last = Some((now, increment.motion, increment.point.loads));
        found
    }

    /// |q| <= mu p; no slip in stick cells; slip against q at the bound in slip cells.
    fn friction(
        &self,
        march: &March,
        now: &Fields,
        increment: &Increment,
        allowed: f64,
        found: &mut Violations,
    ) {
        let mu = march.scene().friction.mu;
        let p_max = increment.p_max;
        for n in 0..now.p.len() {
            let at = |f: &Array2<f64>| f.as_slice().map_or(f64::NAN, |f| f[n]);
            let bound = mu * at(&now.p);
            let q = [at(&now.q_x), at(&now.q_y)];
            let size = q[0].hypot(q[1]);
            let beyond = (size - bound) / (mu * p_max).max(f64::MIN_POSITIVE);
            if size > bound {
                found.coulomb = found.coulomb.max(beyond / ROUNDING);
            }
            let Some((last, motion, _)) = &self.last else {
                continue;
            };
            // In pieces, each has slips of its own; a body that slides has any shift beyond the
            // incipient one, and its slip the direction of the force only in the end.
            let sliding = increment.status == Status::GrossSlip;
            if bound <= 0.0 || sliding || increment.work.parts > 1 {
                continue;
            }
            let ds = [
                at(&now.u_x) - at(&last.u_x) - (increment.motion.delta_x - motion.delta_x),
                at(&now.u_y) - at(&last.u_y) - (increment.motion.delta_y - motion.delta_y),
            ];
            let slip = ds[0].hypot(ds[1]);
            let off = if now.stick.as_slice().is_some_and(|stick| stick[n]) {
                slip
            } else {
                let along = (ds[0] * q[0] + ds[1] * q[1]) / size;
                let across = (ds[0] * q[1] - ds[1] * q[0]).abs() / size;
                along.max(across - 1e-3 * slip)
            };
            found.slip = found.slip.max(off / (mu * allowed));
        }
    }

    /// More force, more contact: where shear does not act on the pressure, and up to a rim cell.
    fn monotone(&self, march: &March, now: &Fields, increment: &Increment, found: &mut Violations) {
        let Some((last, _, loads)) = &self.last else {
            return;
        };
        if march.plan().coupling || increment.point.loads.W < loads.W {
            return;
        }
        let count = |f: &Fields| f.contact.iter().filter(|c| **c).count() as f64;
        let lost = count(last) - count(now);
        found.monotone = lost / (1.0 + 0.02 * count(last));
    }
}

fn balance(march: &March, now: &Fields, increment: &Increment) -> f64 {
    let scene = march.scene();
    let Loads { W, T_x, T_y, .. } = increment.point.loads;
    let force = |f: &Array2<f64>| f.sum() * scene.grid.cell_area();
    let scale = if W > 0.0 { W } else { scene.path.W_max() };
    let friction = (scene.friction.mu * scale).max(f64::MIN_POSITIVE);
    let normal = (force(&now.p) - W).abs() / scale;
    if scene.friction.mu == 0.0 {
        return normal;
    }
    let shear = (force(&now.q_x) - T_x)
        .abs()
        .max((force(&now.q_y) - T_y).abs());
    normal.max(shear / friction)
}
