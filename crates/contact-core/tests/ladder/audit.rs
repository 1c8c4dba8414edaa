//! What must hold at every increment of every scene, computed from the fields alone.

use contact_core::march::{Fields, Increment, March, Motion};
use contact_core::scene::Scene;
use ndarray::{Array2, Zip};

use crate::bench::hertz_of;

/// Follows a run and checks each increment against the last one.
pub(crate) struct Audit {
    mu: f64,
    h_init: Array2<f64>,
    cell_area: f64,
    /// Solver's tolerance, relative: displacements are those of the tractions to this part.
    relative: f64,
    /// Solver's tolerance as a length along z \[m\].
    tolerance: f64,
    last: (Fields, Motion),
    elastic: f64,
    work: f64,
}

impl Audit {
    pub(crate) fn new(scene: &Scene) -> Self {
        Self {
            mu: scene.friction.mu,
            h_init: scene.h_init(),
            cell_area: scene.grid.cell_area(),
            relative: scene.settings.solver.tolerance,
            tolerance: scene.settings.solver.tolerance * hertz_of(scene).delta_z,
            last: (unloaded(scene), Motion::default()),
            elastic: 0.0,
            work: 0.0,
        }
    }

    pub(crate) fn check(&mut self, march: &March, increment: &Increment) {
        let now = march.fields();
        self.balance(&now, increment);
        self.contact(&now, increment);
        self.friction(&now, increment);
        self.energy(&now, increment);
        self.last = (now, increment.motion);
    }

    /// The tractions carry the forces.
    fn balance(&self, now: &Fields, increment: &Increment) {
        let loads = increment.point.loads;
        let force = |traction: &Array2<f64>| traction.sum() * self.cell_area;
        let worst = [
            (force(&now.p) - loads.W) / loads.W.max(1e-300),
            (force(&now.q_x) - loads.T_x) / (self.mu * loads.W).max(1e-300),
            (force(&now.q_y) - loads.T_y) / (self.mu * loads.W).max(1e-300),
        ];
        assert!(
            worst.iter().all(|e| e.abs() < 1e-9),
            "balance {worst:?} at {}",
            increment.index
        );
    }

    /// p >= 0, gap >= 0, and not both.
    fn contact(&self, now: &Fields, increment: &Increment) {
        let gap = &now.u_z + &self.h_init - increment.motion.delta_z;
        let allowed = worst_cell(now) * self.tolerance;
        Zip::from(&now.p).and(&gap).for_each(|&p, &gap| {
            assert!(p >= 0.0, "p = {p} at {}", increment.index);
            assert!(gap > -allowed, "penetration {gap:e} at {}", increment.index);
            assert!(
                p <= 0.0 || gap < allowed,
                "gap {gap:e} under p at {}",
                increment.index
            );
        });
    }

    /// |q| <= mu p, no slip in stick cells, slip against q in slip cells, friction takes energy.
    fn friction(&self, now: &Fields, increment: &Increment) {
        let at = increment.index;
        let (last, last_motion) = &self.last;
        let shift = [
            increment.motion.delta_x - last_motion.delta_x,
            increment.motion.delta_y - last_motion.delta_y,
        ];
        let allowed = worst_cell(now) * self.mu * self.tolerance;
        let (mut dissipated, mut entered) = (0.0, 0.0);
        for (n, &p) in now.p.indexed_iter() {
            let q = [now.q_x[n], now.q_y[n]];
            let size = q[0].hypot(q[1]);
            assert!(size <= self.mu * p * (1.0 + 1e-9), "Coulomb's law at {at}");
            // What a cell moved before it entered the contact is no slip.
            let enters = p > 0.0 && last.p[n] <= 0.0;
            let ds = if enters {
                [
                    now.slip_x[n] - last.slip_x[n],
                    now.slip_y[n] - last.slip_y[n],
                ]
            } else {
                [
                    now.u_x[n] - last.u_x[n] - shift[0],
                    now.u_y[n] - last.u_y[n] - shift[1],
                ]
            };
            let slip = ds[0].hypot(ds[1]);
            // A cell slips at its bound, the mean of the increment.
            let taken = if p <= 0.0 {
                -(0.5 * (last.q_x[n] * ds[0] + last.q_y[n] * ds[1])).min(0.0)
            } else if !now.stick[n] {
                let mean = 0.5 * (1.0 + last.p[n] / p);
                -(mean * (q[0] * ds[0] + q[1] * ds[1])).min(0.0)
            } else {
                0.0
            };
            dissipated += taken * self.cell_area;
            let trace = self.mu * last.p[n].max(p) * allowed;
            entered += if enters { trace * self.cell_area } else { 0.0 };
            let gained = now.dissipated[n] - last.dissipated[n];
            assert!(
                gained >= 0.0 && (gained - taken).abs() <= trace + 1e-12 * now.dissipated[n],
                "friction takes {gained:e} J/m^2, not {taken:e} at {at}"
            );
            if p <= 0.0 || self.mu == 0.0 {
                continue;
            }
            if now.stick[n] {
                assert!(slip < allowed, "slip {slip:e} in a stick cell at {at}");
                continue;
            }
            assert!(
                size > self.mu * p * (1.0 - 1e-9),
                "slip below the limit at {at}"
            );
            let along = -(ds[0] * q[0] + ds[1] * q[1]) / size;
            let across = (ds[0] * q[1] - ds[1] * q[0]).abs() / size;
            assert!(along > -allowed, "slip along q by {along:e} at {at}");
            assert!(
                across < 1e-3 * slip + allowed,
                "slip at an angle, {across:e} of {slip:e} at {at}"
            );
        }
        let (theirs, scale) = (increment.energy.dissipated, increment.energy.work.abs());
        let off = (dissipated - theirs).abs();
        assert!(
            off <= 1e-9 * (self.work + scale) + entered,
            "{dissipated:e} J or {theirs:e} J"
        );
    }

    /// Work of the forces = elastic energy stored + friction + what opening and closing take.
    fn energy(&mut self, now: &Fields, increment: &Increment) {
        let stored = 0.5
            * self.cell_area
            * (&now.p * &now.u_z + &now.q_x * &now.u_x + &now.q_y * &now.u_y).sum();
        let e = increment.energy;
        self.work += e.work.abs();
        let missing = e.work - (stored - self.elastic) - e.dissipated - e.opening;
        self.elastic = stored;
        assert!(
            missing.abs() <= self.relative * self.work,
            "energy {missing:e} of {:e} at {}",
            self.work,
            increment.index
        );
    }
}

/// The solver bounds root-mean-square misfits over the contact: one cell may hold all of it.
fn worst_cell(now: &Fields) -> f64 {
    let cells = now.contact.iter().filter(|c| **c).count();
    (cells as f64).sqrt()
}

/// The fields of two bodies just touching.
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
        slip_x: zero.clone(),
        slip_y: zero.clone(),
        dissipated: zero,
        contact: nowhere.clone(),
        stick: nowhere,
    }
}
