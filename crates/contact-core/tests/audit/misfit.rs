//! What a solution may be off, from the meaning of the tolerance alone.
//!
//! The solver bounds the gap (root mean square over the contact, overlap outside) by the tolerance
//! times the approach, and the slip that should not be by mu times that. What this allows of the
//! tractions follows from the operator: the energy of a difference of two solutions is at most the
//! product of the difference and the misfit,
//!
//! ```text
//! (p - p').C (p - p') <= (p - p').(g - g'),  hence
//! |p - p'| <= |g - g'| / C_min <= 2 tol N^(1/2) / C_min,
//! ```
//!
//! N the contact cells, C_min the response to the wave on the grid that the bodies resist most.

use contact_core::kernels::Stack;
use contact_core::march::Fields;
use contact_core::scene::Scene;

pub(crate) struct Misfit {
    /// Yardstick of lengths \[m\].
    pub(crate) yardstick: f64,
    /// Gap and overlap \[m\].
    pub(crate) gap: f64,
    /// Slip where there should be none \[m\].
    pub(crate) slip: f64,
    /// Least normal response to a wave of unit traction \[m/Pa\].
    normal: f64,
}

impl Misfit {
    pub(crate) fn of(scene: &Scene) -> Self {
        let yardstick = scene.reference_approach();
        let gap = scene.tolerance() * yardstick;
        let [normal, _] = least_response(scene);
        Self {
            yardstick,
            gap,
            // What the shear misses acts on the gap: beyond mu = 1 the tolerance no longer grows.
            slip: scene.friction.mu.min(1.0) * gap,
            normal,
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
}

/// Least normal and tangential response to a wave of unit traction on the grid \[m/Pa\].
pub(crate) fn least_response(scene: &Scene) -> [f64; 2] {
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
    [normal, tangential]
}
