//! Tractions at the interface and the displacements of the surfaces.

use serde::{Deserialize, Serialize};

use super::Response;
use crate::convolution::{Displacements, Tractions};

/// Tractions of an increment and the displacements that belong to them, on the kept cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Interface {
    /// Pressure \[Pa\].
    pub p: Vec<f64>,
    /// Shear tractions q_x, q_y on body 2 \[Pa\].
    pub q: [Vec<f64>; 2],
    /// Relative tangential displacements u_x, u_y \[m\].
    pub u: [Vec<f64>; 2],
    /// Relative normal displacement u_z \[m\].
    pub u_z: Vec<f64>,
    /// Contact cells that slip.
    pub slips: Vec<bool>,
}

impl Interface {
    /// Returns fields of zero tractions and displacements.
    pub fn unloaded(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            p: field(),
            q: [field(), field()],
            u: [field(), field()],
            u_z: field(),
            slips: vec![false; cells],
        }
    }

    /// Applies a function to every field.
    pub(crate) fn map(
        &self,
        field: impl Fn(&[f64]) -> Vec<f64>,
        marks: impl Fn(&[bool]) -> Vec<bool>,
    ) -> Self {
        let pair = |fields: &[Vec<f64>; 2]| [field(&fields[0]), field(&fields[1])];
        Self {
            p: field(&self.p),
            q: pair(&self.q),
            u: pair(&self.u),
            u_z: field(&self.u_z),
            slips: marks(&self.slips),
        }
    }

    /// q_x, q_y, p \[Pa\].
    pub(crate) fn tractions(&self) -> [&[f64]; 3] {
        [&self.q[0], &self.q[1], &self.p]
    }

    /// Borrows shear, tangential displacements and slip set as the unknowns of the tangential solvers.
    pub(super) fn shear(&mut self) -> Shear<'_> {
        let ([q_x, q_y], [u_x, u_y]) = (&mut self.q, &mut self.u);
        Shear {
            q: [q_x, q_y],
            u: [u_x, u_y],
            slips: &mut self.slips,
        }
    }

    /// Computes the displacements from the tractions in double precision; the tangential ones only
    /// with `shear` or where pressure causes them.
    pub(crate) fn evaluate(&mut self, response: &mut Response<'_>, shear: bool) {
        let tractions = Tractions {
            q_x: shear.then_some(&self.q[0][..]),
            q_y: shear.then_some(&self.q[1][..]),
            p: Some(&self.p),
        };
        let tangential = shear || response.op.is_coupled();
        let [u_x, u_y] = &mut self.u;
        let displacements = Displacements {
            u_x: tangential.then_some(&mut u_x[..]),
            u_y: tangential.then_some(&mut u_y[..]),
            u_z: Some(&mut self.u_z),
        };
        response.op.apply(tractions, displacements);
        response.squares = 0.0;
    }
}

/// Shear, displacement and slip set, updated in place.
pub struct Shear<'a> {
    /// q_x, q_y \[Pa\]; on entry a guess.
    pub q: [&'a mut [f64]; 2],
    /// Total u_x, u_y \[m\], the response to q on entry and on exit.
    pub u: [&'a mut [f64]; 2],
    /// Contact cells that slip; on entry a guess.
    pub slips: &'a mut [bool],
}

/// Largest shear under the pressure p, mu p \[Pa\].
pub(crate) fn friction_bound(mu: f64, p: f64) -> f64 {
    if p > 0.0 { mu * p } else { 0.0 }
}
