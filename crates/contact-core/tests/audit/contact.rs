//! Contact: complementarity of pressure and gap, the forces, and that more force makes more
//! contact.

use contact_core::march::Increment;
use contact_core::scene::{Body, Loads, Shape};
use ndarray::Array2;

use super::{Audit, End, Law, ROUNDING, Violations};

impl Audit {
    /// p >= 0, no gap under pressure, no overlap without, as the tolerance says: the first in the
    /// root mean square, the second everywhere. The increment has to report the same. The tractions
    /// carry the forces.
    pub(super) fn check_contact(&self, now: &End, increment: &Increment, found: &mut Violations) {
        found.raise(Law::Balance, self.unbalanced(now) / ROUNDING);
        let p = &now.fields.p;
        if p.iter().any(|&p| p < 0.0) {
            found.raise(Law::Contact, f64::INFINITY);
        }
        let gap = &now.fields.u_z + &self.h_init - now.motion.delta_z;
        let (mut squares, mut cells, mut overlap) = (0.0, 0.0_f64, 0.0_f64);
        for (&p, &gap) in p.iter().zip(&gap) {
            if p > 0.0 {
                squares += gap * gap;
                cells += 1.0;
            } else {
                overlap = overlap.max(-gap);
            }
        }
        let gap = (squares / cells.max(1.0)).sqrt();
        found.raise(Law::Contact, gap.max(overlap) / self.misfit.gap);
        let said = &increment.residuals;
        // Of an increment in pieces the worst of them is reported.
        if increment.work.parts == 1 {
            let off = |said: f64, found: f64| (said * self.misfit.yardstick - found).abs();
            let off = off(said.gap, gap).max(off(said.penetration, overlap));
            // The sums run in another order here; u_z may cancel against h_init to a millionth.
            found.raise(Law::Report, off / (1e-3 * self.misfit.gap));
            found.raise(Law::Report, said.balance / ROUNDING);
        }
    }

    /// More force, more contact: where shear does not act on the pressure. A stiff coating bends as
    /// a plate does, and of several spots one that is pressed may part another. A cell may leave
    /// whose pressure is within what the tolerance allows.
    pub(super) fn check_monotone(&self, now: &End, found: &mut Violations) {
        let coated = |body: &Body| !body.coatings.is_empty();
        let coated = coated(&self.scene.body1) || coated(&self.scene.body2);
        let in_spots = matches!(self.scene.body1.shape, Shape::Sum(_));
        if coated && in_spots || self.coupling || now.loads.W < self.start.loads.W {
            return;
        }
        let cells = self.start.fields.p.iter().zip(&now.fields.p);
        let lost = cells.filter(|(_, now)| **now == 0.0);
        let lost = lost.fold(0.0_f64, |most, (before, _)| most.max(*before));
        if lost > 0.0 {
            found.raise(Law::Monotone, lost / self.misfit.pressure(&now.fields));
        }
    }

    /// Largest part of the normal force, or of the tangential ones over what friction bears, that
    /// the tractions do not carry.
    fn unbalanced(&self, now: &End) -> f64 {
        let (scene, f) = (&self.scene, &now.fields);
        let Loads { W, T_x, T_y, .. } = now.loads;
        let force = |f: &Array2<f64>| f.sum() * scene.grid.cell_area();
        let scale = if W > 0.0 { W } else { scene.path.W_max() };
        // Where nothing presses over all of the path nothing is carried.
        let scale = scale.max(f64::MIN_POSITIVE);
        let friction = (scene.friction.mu * scale).max(f64::MIN_POSITIVE);
        let normal = (force(&f.p) - W).abs() / scale;
        if scene.friction.mu == 0.0 {
            return normal;
        }
        let shear = (force(&f.q_x) - T_x).abs().max((force(&f.q_y) - T_y).abs());
        normal.max(shear / friction)
    }
}
