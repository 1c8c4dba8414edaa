//! The energy identity.

use contact_core::march::Increment;

use super::{Audit, End, Law, Misfit, ROUNDING, Violations, shear};

fn mean(a: f64, b: f64) -> f64 {
    0.5 * (a + b)
}

impl Audit {
    /// Work of the loads = energy stored + work of shear on slip + work of pressure on gaps, all
    /// with the mean of both ends of the increment: an identity for a symmetric C. The increment
    /// reports the same.
    pub(super) fn check_energy(
        &mut self,
        (now, rolled): (&End, isize),
        increment: &Increment,
        found: &mut Violations,
    ) {
        let (from, to, shift) = (self.start.loads, now.loads, self.shift(now));
        let d = [
            now.motion.delta_z - self.start.motion.delta_z,
            shift[0],
            shift[1],
        ];
        let of_loads = mean(from.W, to.W) * d[0]
            + mean(from.T_x, to.T_x) * d[1]
            + mean(from.T_y, to.T_y) * d[2]
            - self.on_slopes(now, rolled);
        self.work += of_loads.abs();
        // In pieces, each has mean tractions of its own.
        if increment.work.parts > 1 || self.work == 0.0 {
            return;
        }
        let [stored, mut on_surface] = self.stored_and_on_surface(now, d);
        on_surface -= self.on_slopes(now, rolled);
        let e = increment.energy;
        let rounding = ROUNDING * self.work;
        let allowed = self.energy_within_tolerance(now) + rounding;
        for (missing, allowed) in [
            (of_loads - stored - on_surface, allowed),
            (e.work - of_loads, rounding),
            (e.elastic - stored, allowed),
            (
                e.dissipated - e.quadrature + e.opening - on_surface,
                allowed,
            ),
            (e.imbalance(), allowed),
        ] {
            found.raise(Law::Energy, missing.abs() / allowed);
        }
    }

    /// Work of the pressure on the undeformed gap of material that rolls through the contact \[J\].
    fn on_slopes(&self, now: &End, rolled: isize) -> f64 {
        let last = &self.start.fields.p;
        let cells = now.fields.p.indexed_iter().filter(|_| rolled != 0);
        let sum: f64 = cells
            .map(|(n, p)| mean(*p, last[n]) * self.wider(n, rolled))
            .sum();
        sum * self.scene.grid.cell_area()
    }

    /// Change of the elastic energy, and the work of the tractions on gaps and slips \[J\].
    fn stored_and_on_surface(&self, now: &End, d: [f64; 3]) -> [f64; 2] {
        let (f, last) = (&now.fields, &self.start.fields);
        let (mut stored, mut on_surface) = (0.0, 0.0);
        for (t, u, t_0, u_0, d) in [
            (&f.p, &f.u_z, &last.p, &last.u_z, d[0]),
            (&f.q_x, &f.u_x, &last.q_x, &last.u_x, d[1]),
            (&f.q_y, &f.u_y, &last.q_y, &last.u_y, d[2]),
        ] {
            for (n, &t) in t.indexed_iter() {
                stored += 0.5 * (t * u[n] - t_0[n] * u_0[n]);
                on_surface -= mean(t, t_0[n]) * (u[n] - u_0[n] - d);
            }
        }
        [stored, on_surface].map(|energy| energy * self.scene.grid.cell_area())
    }

    /// A gap or a slip within the tolerance, times the traction there (Cauchy and Schwarz), at the
    /// beginning and at the end \[J\].
    fn energy_within_tolerance(&self, now: &End) -> f64 {
        let cells = Misfit::root_of_cells(&now.fields);
        let (mut pressed, mut sheared) = (0.0, 0.0);
        for f in [&self.start.fields, &now.fields] {
            let squares = f.p.indexed_iter().fold([0.0; 2], |[p, q], (n, now)| {
                let [x, y] = shear(f, n);
                [p + now * now, q + x * x + y * y]
            });
            pressed += 0.5 * squares[0].sqrt();
            sheared += 0.5 * squares[1].sqrt();
        }
        let allowed = self.misfit.gap * pressed + self.misfit.slip * sheared;
        cells * allowed * self.scene.grid.cell_area()
    }
}
