//! What a solution may be off, from the meaning of the tolerance alone.
//!
//! The solver bounds the gap (root mean square over the contact, overlap outside) by the tolerance
//! times the approach, and the slip that should not be by mu times that. What this allows of the
//! tractions follows from the operator: the energy of a difference of two solutions is at most the
//! product of the difference and the misfit,
//!
//! ```text
//! (p - p').C (p - p') <= (p - p').(g - g'),  hence  |p - p'| <= |g - g'| / C_min <= 2 tol N^(1/2) / C_min,
//! ```
//!
//! N the contact cells, C_min the response to the wave on the grid that the bodies resist most.

use contact_core::kernels::Stack;
use contact_core::march::Fields;
use contact_core::scene::Scene;
use ndarray::Array2;

pub(crate) struct Misfit {
    /// Yardstick of lengths \[m\].
    pub(crate) yardstick: f64,
    /// Gap and overlap \[m\].
    pub(crate) gap: f64,
    /// Slip where there should be none \[m\].
    pub(crate) slip: f64,
    mu: f64,
    /// Least normal and tangential response to a wave of unit traction \[m/Pa\].
    normal: f64,
    tangential: f64,
}

impl Misfit {
    pub(crate) fn of(scene: &Scene) -> Self {
        let yardstick = scene.approach();
        let gap = scene.tolerance() * yardstick;
        let mu = scene.friction.mu;
        let stacks: Vec<_> = [&scene.body1, &scene.body2]
            .into_iter()
            .filter(|b| !b.substrate.is_rigid())
            .map(Stack::new)
            .collect();
        let grid = &scene.grid;
        let (length, width) = grid.extent();
        let shortest = std::f64::consts::PI * (1.0 / grid.dx).hypot(1.0 / grid.dy);
        let longest = std::f64::consts::PI / length.max(width);
        let (mut normal, mut tangential) = (f64::INFINITY, f64::INFINITY);
        for i in 0..=64 {
            let k = longest * (shortest / longest).powf(f64::from(i) / 64.0);
            let responses = stacks.iter().map(|s| s.response(k));
            let (zz, tt) = responses.fold((0.0, [0.0; 2]), |(zz, tt), r| {
                (zz + r.zz, [tt[0] + r.rr, tt[1] + r.tt])
            });
            normal = f64::min(normal, zz / k);
            tangential = f64::min(tangential, tt[0].min(tt[1]) / k);
        }
        Self {
            yardstick,
            gap,
            // What the shear misses acts on the gap: beyond mu = 1 the tolerance no longer grows.
            slip: mu.min(1.0) * gap,
            mu,
            normal,
            tangential,
        }
    }

    pub(crate) fn root_of_cells(fields: &Fields) -> f64 {
        let cells = fields.contact.iter().filter(|c| **c).count();
        (cells.max(1) as f64).sqrt()
    }

    /// Norm of the difference of the pressures of two solutions \[Pa\].
    pub(crate) fn pressure(&self, fields: &Fields) -> f64 {
        2.0 * self.gap * Self::root_of_cells(fields) / self.normal
    }

    /// The same of the shear after `increments`, each of which hands its slip on to the next; the
    /// bound mu p differs too.
    pub(crate) fn shear(&self, fields: &Fields, increments: usize) -> f64 {
        let own = 2.0 * self.slip * Self::root_of_cells(fields) / self.tangential;
        increments as f64 * (own + self.mu * self.pressure(fields))
    }

    /// Difference of the approaches \[m\]: the gaps, weighted with the pressure.
    pub(crate) fn approach(&self, fields: &Fields) -> f64 {
        let weight = norm(&fields.p) / fields.p.sum() * Self::root_of_cells(fields);
        2.0 * self.gap * weight
    }
}

/// Root of the sum of squares.
pub(crate) fn norm(f: &Array2<f64>) -> f64 {
    f.iter().map(|v| v * v).sum::<f64>().sqrt()
}
