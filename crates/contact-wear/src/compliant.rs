//! The surface operator with a compliance of its own in each cell: u_z = C p + D p.
//!
//! A jump of n cycles wears `n k s p` off a cell, p being the pressure at its end: as if a spring
//! of the compliance `D = n k s` stood in series with the half-space there. D >= 0 makes the normal
//! problem better conditioned, whatever the length of the jump.

use contact_core::convolution::{
    ApproximateInverse, CirculantInverse, Convolutions, Displacements, SurfaceOperator, Tractions,
};
use contact_core::kernels::InfluenceCoefficients;
use contact_core::plan::Mirror;

/// An operator and the compliance D of each cell \[m/Pa\].
pub(crate) struct Compliant<'a> {
    pub(crate) op: &'a mut dyn SurfaceOperator,
    pub(crate) compliance: &'a [f64],
}

impl Compliant<'_> {
    /// Adds the compliance of each cell times its pressure to u_z.
    fn add(&self, tractions: Tractions<'_>, u_z: Option<&mut [f64]>) {
        if let (Some(p), Some(u_z)) = (tractions.p, u_z) {
            for ((u_z, p), d) in u_z.iter_mut().zip(p).zip(self.compliance) {
                *u_z += d * p;
            }
        }
    }
}

impl SurfaceOperator for Compliant<'_> {
    /// Cells along x and kept rows.
    fn shape(&self) -> (usize, usize) {
        self.op.shape()
    }

    /// Applies the operator and adds the compliance of each cell.
    fn apply(&mut self, tractions: Tractions<'_>, mut displacements: Displacements<'_>) {
        self.op.apply(
            tractions,
            Displacements {
                u_x: displacements.u_x.take(),
                u_y: displacements.u_y.take(),
                u_z: displacements.u_z.as_deref_mut(),
            },
        );
        self.add(tractions, displacements.u_z);
    }

    /// The work of the operator.
    fn work(&self) -> Convolutions {
        self.op.work()
    }

    /// Whether the operator couples pressure and shear.
    fn is_coupled(&self) -> bool {
        self.op.is_coupled()
    }

    /// The self coefficients of the operator, without the compliances.
    fn self_coefficients(&self) -> (f64, f64) {
        self.op.self_coefficients()
    }
}

/// The approximate inverse of C + D. Let P be the approximate inverse of C with the same D_0 added
/// to every cell. The result is S P S,
///
/// ```text
/// s_i^2 = (c + D_0)/(c + D_i),   1/(c + D_0) = mean of 1/(c + D_i) over the contact,
/// ```
///
/// c being the response to the shortest waves. It is exact where D is uniform, and correct in the
/// limit of cells far more compliant than the half-space beside cells that do not wear.
pub(crate) struct CompliantInverse {
    inverse: CirculantInverse,
    /// D_0 \[m/Pa\].
    diagonal: f64,
    scale: Vec<f64>,
    scaled: Vec<f64>,
}

/// An inverse is used again as long as D_0 differs by no more than this part.
const ALIKE: f64 = 0.2;

impl CompliantInverse {
    /// Sets up the inverse for the `compliance` of the cells and the cells that `touch` (> 0). The inverse
    /// `before` is reused if its mean compliance D_0 is near enough.
    pub(crate) fn new_or_reused(
        before: Option<Self>,
        kernel: &InfluenceCoefficients,
        mirror: Mirror,
        (compliance, touches): (&[f64], &[f64]),
    ) -> Self {
        let c = shortest_waves(kernel);
        let touching = touches.iter().zip(compliance).filter(|(p, _)| **p > 0.0);
        let (sum, count) = touching.fold((0.0, 0.0), |(s, n), (_, d)| (s + 1.0 / (c + d), n + 1.0));
        let at = if count > 0.0 { count / sum - c } else { 0.0 };
        let mut inverse = match before {
            Some(before) if (at - before.diagonal).abs() <= ALIKE * before.diagonal => before,
            _ => Self {
                inverse: with_diagonal(kernel, mirror, at),
                diagonal: at,
                scale: vec![0.0; compliance.len()],
                scaled: vec![0.0; compliance.len()],
            },
        };
        let top = c + inverse.diagonal;
        for (scale, d) in inverse.scale.iter_mut().zip(compliance) {
            *scale = (top / (c + d)).sqrt();
        }
        inverse
    }
}

impl ApproximateInverse for CompliantInverse {
    /// Applies the inverse with every cell scaled by its compliance.
    fn normal(&mut self, r: &[f64], z: &mut [f64]) {
        for (scaled, (r, scale)) in self.scaled.iter_mut().zip(r.iter().zip(&self.scale)) {
            *scaled = r * scale;
        }
        self.inverse.normal(&self.scaled, z);
        z.iter_mut()
            .zip(&self.scale)
            .for_each(|(z, scale)| *z *= scale);
    }

    /// Applies the inverse to the shear, to which the compliances do not belong.
    fn tangential(&mut self, r: [&[f64]; 2], z: [&mut [f64]; 2]) {
        self.inverse.tangential(r, z);
    }
}

/// Estimate of the response to waves two cells long: C(0) - C(1) \[m/Pa\].
pub(crate) fn shortest_waves(kernel: &InfluenceCoefficients) -> f64 {
    let zz = &kernel.zz;
    let beside = zz.get((1, 0)).or_else(|| zz.get((0, 1)));
    zz[(0, 0)] - beside.copied().unwrap_or(0.0)
}

/// The circulant inverse of the kernel of u_z under p with D_0 added to every cell, to the self
/// coefficient.
fn with_diagonal(
    kernel: &InfluenceCoefficients,
    mirror: Mirror,
    diagonal: f64,
) -> CirculantInverse {
    let mut with = kernel.clone();
    with.zz[(0, 0)] += diagonal;
    CirculantInverse::new(&with, mirror, false)
}
