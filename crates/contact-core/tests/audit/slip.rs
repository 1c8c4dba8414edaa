//! Stick and slip, from displacements, shifts and tractions.
//!
//! An increment may leave each cell e from where it should be, less than the tolerance in the root mean
//! square over the contact of N cells,
//!
//! ```text
//! sum |e|^2 <= N tol^2,
//! ```
//!
//! and the next one may begin with that or make it good. So a cell that has stuck since the end of increment
//! j has moved by e - e_j in the end, however many increments ago that was; the cells that stick are those
//! of some increments j, and by the triangle inequality
//!
//! ```text
//! (sum |moved|^2)^(1/2) <= tol [N^(1/2) + (sum_j N_j)^(1/2)].
//! ```
//!
//! A cell that slips does so against a shear that turns from where slip begins to that at the end: what it
//! moved lies between the opposites of both, but for e - e_j of that one increment. In a cell that slips all the
//! time slip begins with the shear at the start. In a cell that stuck then it begins on the way, with a shear at
//! its bound that is nearer to the one at the end than the one at the start was.

use std::f64::consts::FRAC_PI_2;

use contact_core::march::{Increment, Status};
use contact_core::scene::Scene;
use ndarray::Array2;

use super::{Audit, End, Law, Violations, dot, shear, size};

/// Where cells have come to rest.
pub(super) struct Rest {
    /// The increment at the end of which a cell had last slipped or entered the contact.
    since: Array2<usize>,
    /// What it has moved since \[m\].
    moved: Array2<[f64; 2]>,
    /// Contact cells at the end of each increment.
    cells: Vec<f64>,
}

impl Rest {
    pub(super) fn new(scene: &Scene) -> Self {
        let dim = (scene.grid.nx, scene.grid.ny);
        Self {
            since: Array2::zeros(dim),
            moved: Array2::from_elem(dim, [0.0; 2]),
            cells: vec![0.0],
        }
    }

    /// What the cells that stick may have moved, root of the sum of squares, over the tolerance.
    fn allowed(&self, stick: &Array2<bool>) -> f64 {
        let mut begun = vec![false; self.cells.len()];
        for (since, sticks) in self.since.iter().zip(stick) {
            begun[*since] |= sticks;
        }
        let of_begun = self.cells.iter().zip(&begun).filter(|(_, begun)| **begun);
        let before: f64 = of_begun.map(|(cells, _)| cells).sum();
        self.cells.last().map_or(0.0, |now| now.sqrt()) + before.sqrt()
    }
}

impl Audit {
    /// Cells that stick do not move, those that slip move against the shear.
    pub(super) fn check_slip(&mut self, now: &End, increment: &Increment, found: &mut Violations) {
        let f = &now.fields;
        let contact = f.contact.iter().filter(|c| **c).count();
        self.rest.cells.push(contact as f64);
        // In pieces, each has slips of its own; a body that slides has any shift beyond the incipient
        // one, and its slip the direction of the force only in the end.
        let known = increment.status != Status::GrossSlip && increment.work.parts == 1;
        let shift = self.shift(now);
        let (mut stick, mut slip) = (0.0, 0.0);
        for (n, &p) in f.p.indexed_iter() {
            let enters = self.start.fields.p[n] <= 0.0;
            if known && p > 0.0 && f.stick[n] && !enters {
                let by = self.moved(f, shift, n);
                let moved = &mut self.rest.moved[n];
                *moved = [moved[0] + by[0], moved[1] + by[1]];
                stick += dot(*moved, *moved);
                continue;
            }
            self.rest.since[n] = increment.index;
            self.rest.moved[n] = [0.0; 2];
            if !known || p <= 0.0 {
                continue;
            }
            let (from, to) = (shear(&self.start.fields, n), shear(f, n));
            let off = if enters {
                // What it moved before it entered is no slip; the fields tell the rest.
                let against = if f.stick[n] { [0.0; 2] } else { to };
                Sector::about(against, 0.0).off(self.gain(f, n))
            } else if self.start.fields.stick[n] {
                let way = size([to[0] - from[0], to[1] - from[1]]);
                Sector::about(to, way).off(self.moved(f, shift, n))
            } else {
                Sector::between(from, to).off(self.moved(f, shift, n))
            };
            slip += off * off;
        }
        if self.scene.friction.mu == 0.0 || contact == 0 || !known {
            return;
        }
        let [.., before, cells] = self.rest.cells[..] else {
            return;
        };
        let tolerance = self.misfit.slip;
        found.raise(
            Law::Stick,
            stick.sqrt() / (tolerance * self.rest.allowed(&f.stick)),
        );
        found.raise(
            Law::Slip,
            slip.sqrt() / (tolerance * (cells.sqrt() + before.sqrt())),
        );
    }
}

/// Directions within an angle of one.
struct Sector {
    middle: [f64; 2],
    half: f64,
}

impl Sector {
    /// Between two shears.
    fn between(from: [f64; 2], to: [f64; 2]) -> Self {
        let unit = |q: [f64; 2]| q.map(|c| c / size(q).max(f64::MIN_POSITIVE));
        let (from, to) = (unit(from), unit(to));
        Self {
            middle: [from[0] + to[0], from[1] + to[1]],
            half: 0.5 * angle(from, to),
        }
    }

    /// Of the shears of the size of `to` that are no farther from it than `way`.
    fn about(to: [f64; 2], way: f64) -> Self {
        Self {
            middle: to,
            half: 2.0 * (0.5 * way / size(to)).min(1.0).asin(),
        }
    }

    /// How far the opposite of a motion is from the sector \[m\].
    fn off(&self, moved: [f64; 2]) -> f64 {
        if size(self.middle) == 0.0 {
            return size(moved);
        }
        let beyond = angle(self.middle, moved.map(|v| -v)) - self.half;
        size(moved) * beyond.clamp(0.0, FRAC_PI_2).sin()
    }
}

/// Between 0 and pi.
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).abs().atan2(dot(a, b))
}
