//! What the bodies do to each other at the interface, and how the surfaces answer.

use serde::{Deserialize, Serialize};

use super::{Response, Shear};
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
    pub slip: Vec<bool>,
}

impl Interface {
    /// Nothing acts.
    pub fn unloaded(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            p: field(),
            q: [field(), field()],
            u: [field(), field()],
            u_z: field(),
            slip: vec![false; cells],
        }
    }

    /// What the tangential solvers work on.
    pub(super) fn shear(&mut self) -> Shear<'_> {
        let ([q_x, q_y], [u_x, u_y]) = (&mut self.q, &mut self.u);
        Shear {
            q: [q_x, q_y],
            u: [u_x, u_y],
            slip: &mut self.slip,
        }
    }

    /// Computes the displacements from the tractions, with all digits if they are to be `exact`.
    pub(crate) fn evaluate(&mut self, response: &mut Response<'_>, shear: bool, exact: bool) {
        let [u_x, u_y] = &mut self.u;
        let coupled = response.op.is_coupled();
        let tractions = Tractions {
            q_x: shear.then_some(&self.q[0][..]),
            q_y: shear.then_some(&self.q[1][..]),
            p: Some(&self.p),
        };
        let tangential = shear || coupled;
        let displacements = Displacements {
            u_x: tangential.then_some(u_x),
            u_y: tangential.then_some(u_y),
            u_z: Some(&mut self.u_z),
        };
        if exact {
            response.op.apply(tractions, displacements);
        } else {
            response.respond(tractions, displacements);
        }
    }
}
