//! Coulomb's law of the tractions.

use contact_core::march::Increment;

use super::{Audit, End, Law, ROUNDING, Violations, held, shear, size};

impl Audit {
    /// |q| <= mu p everywhere, and equal where a cell slips. The increment has to report the same.
    pub(super) fn check_coulomb(&self, now: &End, increment: &Increment, found: &mut Violations) {
        let (mu, f) = (self.scene.friction.mu, &now.fields);
        let scale = (mu * increment.p_max).max(f64::MIN_POSITIVE);
        let mut most = 0.0_f64;
        for (n, &p) in f.p.indexed_iter() {
            let beyond = (size(shear(f, n)) - mu * p) / scale;
            most = most.max(beyond);
            let off = if held(f, n) { beyond } else { beyond.abs() };
            found.raise(Law::Coulomb, off / ROUNDING);
        }
        if increment.work.parts == 1 && mu > 0.0 && increment.contact_area > 0.0 {
            let off = (increment.residuals.coulomb - most).abs();
            found.raise(Law::Report, off / ROUNDING);
        }
    }
}
