//! The direction of the load path from one increment to the next.

use crate::scene::{Given, Loads};

impl Loads {
    /// The change from `before` and `motions` to here, of what is given.
    pub(crate) fn since(&self, before: &Self, motions: [f64; 6]) -> Self {
        let forces = before.forces();
        let (to, given) = (self.forces(), self.given.motions());
        let force = |k: usize| given[k].map_or(to[k] - forces[k], |_| 0.0);
        let motion = |k: usize| given[k].map(|to| to - motions[k]);
        Self {
            sigma_B: self.sigma_B - before.sigma_B,
            sigma_B1: self.sigma_B1 - before.sigma_B1,
            rolled: self.rolled - before.rolled,
            ..Self::default()
        }
        .with_forces(
            std::array::from_fn(force),
            Given::from_motions(std::array::from_fn(motion)),
        )
    }

    /// The factor f with self = f other, if the two changes are of the same kind and point the same
    /// way.
    pub(crate) fn along(&self, other: &Self) -> Option<f64> {
        let (a, b) = (self.given.motions(), other.given.motions());
        if (0..6).any(|k| a[k].is_some() != b[k].is_some()) {
            return None;
        }
        let (f, g) = (self.forces(), other.forces());
        let pairs = (0..6)
            .map(|k| a[k].zip(b[k]).unwrap_or((f[k], g[k])))
            .chain([
                (self.sigma_B, other.sigma_B),
                (self.sigma_B1, other.sigma_B1),
                (self.rolled, other.rolled),
            ]);
        let (mut both, mut own, mut its) = (0.0, 0.0, 0.0);
        for (a, b) in pairs {
            // Forces, moments, lengths and angles compare as parts of the larger of the two.
            let scale = a.abs().max(b.abs());
            if scale > 0.0 {
                let (a, b) = (a / scale, b / scale);
                both += a * b;
                own += a * a;
                its += b * b;
            }
        }
        let parallel = both > 0.0 && both * both >= (1.0 - 1e-9) * own * its;
        parallel.then(|| both / its)
    }
}
