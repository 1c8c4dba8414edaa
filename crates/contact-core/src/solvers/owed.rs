//! Shear that the displacements do not answer to yet.
//!
//! When a Newton step ends, slip cells return to the circle and stick cells share the force that this
//! takes. Towards the end what that moves the surfaces by is far within the tolerance, but to know it takes
//! a whole convolution. It is left to the next one, of this increment or of the first guess of the next,
//! so that nothing adds up along the path; until then its bound counts as a misfit of the slip. What it
//! does to the gap is less by the coupling, and not counted.

use serde::{Deserialize, Serialize};

use crate::cells::{set, sweep};

/// What of the shear u_x, u_y, u_z leave out, all in cells of the contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Owed {
    /// Parts of q_x, q_y \[Pa\]; empty where nothing is owed.
    pub(crate) q: [Vec<f64>; 2],
    /// What they move a surface by at most, root mean square over the contact \[m\].
    pub(crate) moves: f64,
}

impl Owed {
    /// Whether there is something.
    pub(crate) fn owes(&self) -> bool {
        !self.q[0].is_empty()
    }

    /// The same with each field changed to another, as long as there is something.
    pub(crate) fn map(&self, to: impl Fn(&Vec<f64>) -> Vec<f64>) -> Self {
        if !self.owes() {
            return Self::default();
        }
        Self {
            q: self.q.each_ref().map(to),
            moves: self.moves,
        }
    }

    /// All has been answered.
    pub(crate) fn settle(&mut self) {
        self.q.iter_mut().for_each(Vec::clear);
        self.moves = 0.0;
    }

    /// Makes room in so many cells, zero in those that owe nothing yet.
    pub(crate) fn extend(&mut self, cells: usize) -> [&mut [f64]; 2] {
        self.q.each_mut().map(|q| {
            q.resize(cells, 0.0);
            &mut q[..]
        })
    }

    /// Takes the shear off, which is about to change.
    pub(crate) fn take(&mut self, q: [&[f64]; 2]) {
        let owed = self.extend(q[0].len());
        set(q, owed, |_, q, owed| [owed[0] - q[0], owed[1] - q[1]]);
    }

    /// Puts it back when it has changed; one unit moves a surface by no more than `norm`. Returns the root
    /// of the sum of squares of what is owed then \[Pa\].
    pub(crate) fn put(&mut self, q: [&[f64]; 2], norm: f64) -> f64 {
        let [x, y] = &mut self.q;
        let [squares, sizes] = sweep(q, [x, y], |_, q, owed| {
            let [x, y] = [owed[0] + q[0], owed[1] + q[1]];
            ([x, y], [x * x + y * y, x.abs() + y.abs()])
        });
        self.moves = norm * sizes;
        if sizes == 0.0 {
            self.settle();
        }
        squares.sqrt()
    }
}
