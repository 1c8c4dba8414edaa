//! Stick and slip, from displacements, shifts and tractions.
//!
//! An increment may leave each cell e from where it should be, less than the tolerance in the root
//! mean square over the contact of N cells,
//!
//! ```text
//! sum |e|^2 <= N tol^2,
//! ```
//!
//! and the next one may begin with that or make it good. So a cell that has stuck since the end of
//! increment j has moved by e - e_j in the end, however many increments ago that was; the cells
//! that stick are those of some increments j, and by the triangle inequality
//!
//! ```text
//! (sum |moved|^2)^(1/2) <= tol [N^(1/2) + (sum_j N_j)^(1/2)].
//! ```
//!
//! A cell that slips moves against the shear ([`Sector`]), but for e - e_j of that one increment.

use contact_core::march::{Fields, Increment, Status};
use contact_core::scene::Scene;
use ndarray::Array2;

use super::rolled::carried;
use super::sector::Sector;
use super::{Audit, End, Law, Violations, dot, held};

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

    /// Carries all along with the material.
    pub(super) fn roll(&mut self, cells: isize) {
        self.since = carried(&self.since, cells, 0);
        self.moved = carried(&self.moved, cells, [0.0; 2]);
    }

    /// What the cells that stick may have moved, root of the sum of squares, over the tolerance.
    fn allowed(&self, f: &Fields) -> f64 {
        let mut begun = vec![false; self.cells.len()];
        for (n, since) in self.since.indexed_iter() {
            begun[*since] |= held(f, n);
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
        // In pieces, each has slips of its own; a body that slides has any shift beyond the
        // incipient one, and its slip the direction of the force only in the end.
        let known = increment.status != Status::GrossSlip && increment.work.parts == 1;
        let shift = self.shift(now);
        let (mut stick, mut slip) = (0.0, 0.0);
        for (n, &p) in f.p.indexed_iter() {
            let enters = self.start.fields.p[n] <= 0.0;
            if known && p > 0.0 && held(f, n) && !enters {
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
            // What a cell moved before it entered is no slip; the fields tell the rest.
            let by = if enters {
                self.gain(f, n)
            } else {
                self.moved(f, shift, n)
            };
            let off = Sector::of(&self.start.fields, f, n).off(by);
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
            stick.sqrt() / (tolerance * self.rest.allowed(f)),
        );
        found.raise(
            Law::Slip,
            slip.sqrt() / (tolerance * (cells.sqrt() + before.sqrt())),
        );
    }
}
