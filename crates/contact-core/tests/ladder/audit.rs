//! What must hold at every increment of every scene, computed from the fields alone.

use contact_core::march::{Fields, Increment, March, Motion};
use contact_core::scene::{Loads, Scene};
use ndarray::{Array2, Zip};

use crate::bench::hertz_of;
use crate::entry::{Entry, entry};

/// What sums of some thousand cells, in another order, lose to rounding, and a margin.
const ROUNDING: f64 = 1e-9;

/// Follows a run and checks each increment against the last one.
pub(crate) struct Audit {
    mu: f64,
    h_init: Array2<f64>,
    cell_area: f64,
    /// Solver's tolerance, relative: displacements are those of the tractions to this part.
    relative: f64,
    /// Solver's tolerance as a length along z \[m\].
    tolerance: f64,
    last: Last,
    work: f64,
}

/// Where the increment starts.
pub(crate) struct Last {
    pub(crate) fields: Fields,
    pub(crate) motion: Motion,
    pub(crate) loads: Loads,
    /// `None` before the first increment.
    pub(crate) state: Option<contact_core::march::State>,
}

impl Audit {
    pub(crate) fn new(scene: &Scene) -> Self {
        Self {
            mu: scene.friction.mu,
            h_init: scene.h_init(),
            cell_area: scene.grid.cell_area(),
            relative: scene.tolerance(),
            tolerance: scene.tolerance() * hertz_of(scene).delta_z,
            last: Last {
                fields: unloaded(scene),
                motion: Motion::default(),
                loads: Loads::default(),
                state: None,
            },
            work: 0.0,
        }
    }

    pub(crate) fn check(&mut self, march: &March, increment: &Increment) {
        let now = march.fields();
        self.balance(&now, increment);
        self.contact(&now, increment);
        // In pieces, each has a start of its own.
        if increment.work.parts == 1 {
            let entry = entry(march, &self.last, increment, self.allowed(&now));
            self.energy(&now, increment);
            self.friction(&now, increment, &entry, &march.turned());
        }
        self.last = Last {
            fields: now,
            motion: increment.motion,
            loads: increment.point.loads,
            state: Some(march.state().clone()),
        };
    }

    /// A gap that the tolerance leaves in one cell: it bounds root-mean-square misfits over the
    /// contact, and one cell may hold all of it \[m\].
    fn allowed(&self, now: &Fields) -> f64 {
        let cells = now.contact.iter().filter(|c| **c).count();
        (cells as f64).sqrt() * self.tolerance
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
            worst.iter().all(|e| e.abs() < ROUNDING),
            "balance {worst:?} at {}",
            increment.index
        );
    }

    /// p >= 0, gap >= 0, and not both.
    fn contact(&self, now: &Fields, increment: &Increment) {
        let gap = &now.u_z + &self.h_init - increment.motion.delta_z;
        let allowed = self.allowed(now);
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

    /// |q| <= mu p, no slip in stick cells, slip against q in slip cells, friction takes energy:
    /// the mean bound times the slip, since a cell slips at its bound.
    fn friction(
        &self,
        now: &Fields,
        increment: &Increment,
        entry: &Entry,
        turned: &[Array2<f64>; 2],
    ) {
        let at = increment.index;
        let last = &self.last.fields;
        let shift = self.shift(increment);
        let (mut dissipated, mut doubt) = (0.0, 0.0);
        let (mut slips, mut turns) = (0.0_f64, 0.0_f64);
        for (n, &p) in now.p.indexed_iter() {
            let q = [now.q_x[n], now.q_y[n]];
            let size = q[0].hypot(q[1]);
            assert!(
                size <= self.mu * p * (1.0 + ROUNDING),
                "Coulomb's law at {at}"
            );
            // What a cell moved before it entered the contact is no slip.
            let moved = entry.moved(n);
            let ds = [
                now.u_x[n] - last.u_x[n] - shift[0] - moved[0],
                now.u_y[n] - last.u_y[n] - shift[1] - moved[1],
            ];
            let slip = ds[0].hypot(ds[1]);
            // But for the turn of the shear within the increment.
            let turned = turned.each_ref().map(|e| e[n]);
            let off = [ds[0] - turned[0], ds[1] - turned[1]];
            let allowed = self.mu.min(1.0) * self.allowed(now) + entry.doubt(n);
            let mean = self.mu * 0.5 * (last.p[n] + p);
            let gained = now.dissipated[n] - last.dissipated[n];
            let rounding = 1e-12 * now.dissipated[n].abs();
            let taken = if p <= 0.0 {
                // Until it left; what it moved since is no slip.
                (-0.5 * (last.q_x[n] * ds[0] + last.q_y[n] * ds[1])).max(0.0)
            } else if now.stick[n] {
                let slip = off[0].hypot(off[1]);
                assert!(
                    slip <= allowed,
                    "slip {slip:e} in a stick cell at {at}, allowed {allowed:e}"
                );
                0.0
            } else {
                let along = -(off[0] * q[0] + off[1] * q[1]) / size;
                assert!(
                    size > self.mu * p * (1.0 - ROUNDING),
                    "slip below the limit at {at}"
                );
                assert!(along >= -allowed, "slip along q by {along:e} at {at}");
                let across = (off[0] * q[1] - off[1] * q[0]).abs() / size;
                assert!(
                    across <= 1e-3 * slip + allowed,
                    "slip at an angle, {across:e} of {slip:e} at {at}"
                );
                slips += slip * slip;
                turns += turned[0].powi(2) + turned[1].powi(2);
                mean * along
            };
            assert!(
                gained >= -mean * allowed - rounding,
                "friction gives {:e} J/m^2 at {at}",
                -gained
            );
            let off = (gained - taken).abs();
            assert!(
                off <= mean * entry.doubt(n) + 1e-9 * taken.abs() + rounding,
                "friction takes {gained:e} J/m^2, not {taken:e} at {at}"
            );
            dissipated += taken * self.cell_area;
            doubt += mean * entry.doubt(n) * self.cell_area;
        }
        assert!(
            turns.sqrt() <= 0.5 * slips.sqrt() + self.allowed(now),
            "slip turned by {turns:e} of {slips:e} m^2 at {at}"
        );
        let theirs = increment.energy.dissipated;
        assert!(
            (dissipated - theirs).abs() <= ROUNDING * self.work + doubt,
            "{dissipated:e} J or {theirs:e} J at {at}"
        );
    }

    fn shift(&self, increment: &Increment) -> [f64; 2] {
        let (from, to) = (&self.last.motion, &increment.motion);
        [to.delta_x - from.delta_x, to.delta_y - from.delta_y]
    }

    /// Work of the loads = energy stored + work of shear on slip + work of pressure on gaps, all
    /// with the mean of both ends of the increment: an identity for a symmetric C. The increment
    /// reports the same, friction and what distinguishes it from the mean shear apart.
    fn energy(&mut self, now: &Fields, increment: &Increment) {
        let (last, from, to) = (&self.last.fields, self.last.loads, increment.point.loads);
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let shift = self.shift(increment);
        let approach = increment.motion.delta_z - self.last.motion.delta_z;
        let of_loads = mean(from.W, to.W) * approach
            + mean(from.T_x, to.T_x) * shift[0]
            + mean(from.T_y, to.T_y) * shift[1];
        let half = |f: &Fields| {
            0.5 * self.cell_area * (&f.p * &f.u_z + &f.q_x * &f.u_x + &f.q_y * &f.u_y).sum()
        };
        let stored = half(now) - half(last);
        let mut on_surface = 0.0;
        for (n, &p) in now.p.indexed_iter() {
            let ds = [
                now.u_x[n] - last.u_x[n] - shift[0],
                now.u_y[n] - last.u_y[n] - shift[1],
            ];
            let q = [mean(last.q_x[n], now.q_x[n]), mean(last.q_y[n], now.q_y[n])];
            on_surface -= q[0] * ds[0] + q[1] * ds[1];
            on_surface -= mean(last.p[n], p) * (now.gap[n] - last.gap[n]);
        }
        on_surface *= self.cell_area;
        self.work += of_loads.abs();
        let e = increment.energy;
        for (what, missing, allowed) in [
            ("balance", of_loads - stored - on_surface, self.relative),
            ("work", e.work - of_loads, ROUNDING),
            ("elastic", e.elastic - stored, self.relative),
            (
                "on the surface",
                e.dissipated - e.quadrature + e.opening - on_surface,
                ROUNDING,
            ),
        ] {
            assert!(
                missing.abs() <= allowed * self.work,
                "energy, {what}: off by {missing:e} of {:e} J at {}",
                self.work,
                increment.index
            );
        }
    }
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
