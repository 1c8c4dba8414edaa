//! What the bodies do to each other at the interface, and how the surfaces answer.

use serde::{Deserialize, Serialize};

use super::Response;
use super::inner::Shear;
use super::owed::Owed;
use crate::cells::copy;
use crate::cells::{set, sums, sweep};
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
    /// What of the shear the displacements leave out.
    pub(crate) owed: Owed,
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
            owed: Owed::default(),
            rounding: 0.0,
        }
    }

    /// q_x, q_y, p \[Pa\].
    pub(crate) fn tractions(&self) -> [&[f64]; 3] {
        [&self.q[0], &self.q[1], &self.p]
    }

    /// What the tangential solvers work on.
    pub(super) fn shear(&mut self) -> Shear<'_> {
        let ([q_x, q_y], [u_x, u_y]) = (&mut self.q, &mut self.u);
        Shear {
            q: [q_x, q_y],
            u: [u_x, u_y],
            slip: &mut self.slip,
            owed: &mut self.owed,
        }
    }

    /// The shear that the displacements answer to.
    pub(crate) fn answered(&self, to: [&mut [f64]; 2]) {
        let ([q_x, q_y], [owed_x, owed_y]) = (&self.q, &self.owed.q);
        if self.owed.owes() {
            let from = [&q_x[..], q_y, owed_x, owed_y];
            set(from, to, |_, [x, y, owed_x, owed_y], _| {
                [x - owed_x, y - owed_y]
            });
        } else {
            let [x, y] = to;
            copy(q_x, x);
            copy(q_y, y);
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
        self.owed.settle();
        self.rounding = 0.0;
    }

    /// Computes the displacements from `known` ones of tractions nearby, and the answer to what these
    /// differ by and to what they owe; `change` is a buffer.
    pub(super) fn follow(
        &mut self,
        known: &Self,
        response: &mut Response<'_>,
        shear: bool,
        change: [&mut [f64]; 3],
    ) {
        let [q_x, q_y, p] = change;
        let difference = |to: &mut [f64], now: &[f64], known: &[f64], owed: &[f64]| {
            let [squares] = sweep([now, known], [&mut *to], |_, [now, known], _| {
                let change = now - known;
                ([change], [change * change])
            });
            if !owed.is_empty() {
                set([owed], [to], |_, [owed], [change]| [change + owed]);
            }
            squares != 0.0 || !owed.is_empty()
        };
        let [owed_x, owed_y] = &known.owed.q;
        let changes = [
            shear && difference(q_x, &self.q[0], &known.q[0], owed_x),
            shear && difference(q_y, &self.q[1], &known.q[1], owed_y),
            difference(p, &self.p, &known.p, &[]),
        ];
        let tractions = Tractions {
            q_x: changes[0].then_some(&*q_x),
            q_y: changes[1].then_some(&*q_y),
            p: changes[2].then_some(&*p),
        };
        let [u_x, u_y] = &mut self.u;
        let displacements = wanted(response, shear, [u_x, u_y, &mut self.u_z]);
        response.respond(tractions, displacements);
        let [u_x, u_y] = &mut self.u;
        let pairs = [u_x, u_y, &mut self.u_z].into_iter();
        for (u, known) in pairs.zip([&known.u[0], &known.u[1], &known.u_z]) {
            set([&known[..]], [u], |_, [known], [u]| [known + u]);
        }
        self.owed.settle();
        self.rounding = known.rounding + response.rounding() * self.differs(known.tractions());
    }

    /// Root of the sum of squares of what the tractions differ by from q_x, q_y, p \[Pa\].
    pub(super) fn differs(&self, tractions: [&[f64]; 3]) -> f64 {
        let [squares] = sums((self.tractions(), tractions), |_, (now, other)| {
            let change: [f64; 3] = std::array::from_fn(|k| now[k] - other[k]);
            [change[0] * change[0] + change[1] * change[1] + change[2] * change[2]]
        });
        squares.sqrt()
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
