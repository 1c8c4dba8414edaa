//! The surface operator with a compliance of its own in each cell: u_z = C p + D p.
//!
//! A jump of n cycles wears `n k s p` off a cell, p being the pressure at its end: as if a spring of
//! the compliance `D = n k s` stood in series with the half-space there. D >= 0 makes the normal problem
//! better conditioned, whatever the length of the jump.

use crate::convolution::{CirculantInverse, Displacements, SurfaceOperator, Tractions};
use crate::kernels::InfluenceCoefficients;
use crate::plan::Mirror;

/// An operator and the compliance D of each cell \[m/Pa\].
pub(crate) struct Compliant<'a> {
    pub(crate) op: &'a mut dyn SurfaceOperator,
    pub(crate) compliance: &'a [f64],
}

impl Compliant<'_> {
    fn add(&self, tractions: Tractions<'_>, u_z: Option<&mut [f64]>) {
        if let (Some(p), Some(u_z)) = (tractions.p, u_z) {
            for ((u_z, p), d) in u_z.iter_mut().zip(p).zip(self.compliance) {
                *u_z += d * p;
            }
        }
    }
}

impl SurfaceOperator for Compliant<'_> {
    fn shape(&self) -> (usize, usize) {
        self.op.shape()
    }

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

    fn transforms(&self) -> usize {
        self.op.transforms()
    }

    fn is_coupled(&self) -> bool {
        self.op.is_coupled()
    }

    fn self_coefficients(&self) -> (f64, f64) {
        self.op.self_coefficients()
    }
}

/// The approximate inverse of the kernel of u_z under p with the compliance D added to every cell:
/// to the self coefficient.
pub(crate) fn inverse(zz: &InfluenceCoefficients, mirror: Mirror, d: f64) -> CirculantInverse {
    let mut with = zz.clone();
    with.zz[(0, 0)] += d;
    CirculantInverse::new(&with, mirror, false)
}
