//! What friction takes.

use contact_core::march::Increment;

use super::{Audit, End, Law, ROUNDING, Violations, dot, held, shear, size};

impl Audit {
    /// Friction takes the mean bound of the increment times the slip against the shear from a cell
    /// that slips; from one that leaves the contact the slip against half of the shear that it had,
    /// if that is so directed; nothing from the others: by the tractions, displacements and shifts
    /// alone. All of it is what the increment reports.
    pub(super) fn check_dissipation(
        &self,
        now: &End,
        increment: &Increment,
        found: &mut Violations,
    ) {
        let (mu, f, last) = (self.scene.friction.mu, &now.fields, &self.start.fields);
        let shift = self.shift(now);
        let (mut all, mut sum, mut so_far) = (0.0, 0.0, 0.0);
        for (n, &p) in f.p.indexed_iter() {
            let gained = f.dissipated[n] - last.dissipated[n];
            all += gained;
            sum += gained.abs();
            so_far += f.dissipated[n].abs();
            // In pieces, each has slips of its own.
            if increment.work.parts > 1 {
                continue;
            }
            // What a cell moved before it entered the contact is no slip.
            let slip = if last.p[n] <= 0.0 {
                self.gain(f, n)
            } else {
                self.moved(f, shift, n)
            };
            let mean = 0.5 * mu * (p + last.p[n]);
            let taken = if mu * p <= 0.0 {
                (-0.5 * dot(slip, shear(last, n))).max(0.0)
            } else if held(f, n) {
                0.0
            } else {
                let q = shear(f, n);
                -mean * dot(slip, q) / size(q)
            };
            // The differences of displacements may cancel to a thousandth of the tolerance, and the
            // shear is at its bound up to rounding.
            let known = (1e-3 * self.misfit.slip + ROUNDING * size(slip)) * mean
                + 1e-12 * f.dissipated[n].abs();
            let off = (gained - taken).abs();
            if off > 0.0 {
                found.raise(Law::Dissipation, off / known);
            }
        }
        let area = self.scene.grid.cell_area();
        let off = (all * area - increment.energy.dissipated).abs();
        if off > 0.0 {
            let known = (ROUNDING * sum + 1e-12 * so_far) * area;
            found.raise(Law::Dissipation, off / known);
        }
    }
}
