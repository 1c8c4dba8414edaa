//! What the bodies do to each other at the interface, and how the surfaces answer.

use serde::{Deserialize, Serialize};

use super::vector::{largest, set_cells};
use super::{Response, Shear};
use crate::convolution::{Displacements, Tractions};

/// What single precision may miss of the displacements that answer a change, over the largest of them.
pub(crate) const ROUNDING: f64 = 1e-6;

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
    /// What answers with some digits only may have added to the displacements \[m\].
    pub(crate) rounding: f64,
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
            rounding: 0.0,
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

    /// Computes the displacements from the tractions.
    pub(crate) fn evaluate(&mut self, response: &mut Response<'_>, shear: bool) {
        let tractions = Tractions {
            q_x: shear.then_some(&self.q[0][..]),
            q_y: shear.then_some(&self.q[1][..]),
            p: Some(&self.p),
        };
        let [u_x, u_y] = &mut self.u;
        let displacements = wanted(response, shear, [u_x, u_y, &mut self.u_z]);
        response.op.apply(tractions, displacements);
        self.rounding = 0.0;
    }

    /// Computes the displacements from `known` ones of tractions nearby, and the answer to what these
    /// differ by; `change` is a buffer.
    pub(super) fn follow(
        &mut self,
        known: &Self,
        response: &mut Response<'_>,
        shear: bool,
        change: [&mut [f64]; 3],
    ) {
        let [q_x, q_y, p] = change;
        let difference = |to: &mut [f64], now: &[f64], known: &[f64]| {
            set_cells(to, |n, _| now[n] - known[n]);
            to.iter().any(|&change| change != 0.0)
        };
        let changes = [
            shear && difference(q_x, &self.q[0], &known.q[0]),
            shear && difference(q_y, &self.q[1], &known.q[1]),
            difference(p, &self.p, &known.p),
        ];
        let tractions = Tractions {
            q_x: changes[0].then_some(&*q_x),
            q_y: changes[1].then_some(&*q_y),
            p: changes[2].then_some(&*p),
        };
        let [u_x, u_y] = &mut self.u;
        let displacements = wanted(response, shear, [u_x, u_y, &mut self.u_z]);
        response.respond(tractions, displacements);
        let [k_x, k_y] = &known.u;
        let mut moved = 0.0;
        for (u, known) in self
            .displacements_mut()
            .into_iter()
            .zip([k_x, k_y, &known.u_z])
        {
            moved = largest(u.len(), |n| u[n].abs()).max(moved);
            set_cells(u, |n, u| known[n] + u);
        }
        self.rounding = known.rounding + ROUNDING * moved;
    }

    /// u_x, u_y, u_z \[m\].
    pub(super) fn displacements(&self) -> [&Vec<f64>; 3] {
        [&self.u[0], &self.u[1], &self.u_z]
    }

    fn displacements_mut(&mut self) -> [&mut Vec<f64>; 3] {
        let [u_x, u_y] = &mut self.u;
        [u_x, u_y, &mut self.u_z]
    }
}

/// The displacements that matter to a scene with or without shear.
fn wanted<'a>(
    response: &Response<'_>,
    shear: bool,
    [u_x, u_y, u_z]: [&'a mut Vec<f64>; 3],
) -> Displacements<'a> {
    let tangential = shear || response.op.is_coupled();
    Displacements {
        u_x: tangential.then_some(u_x),
        u_y: tangential.then_some(u_y),
        u_z: Some(u_z),
    }
}
