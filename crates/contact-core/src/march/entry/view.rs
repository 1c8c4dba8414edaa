//! The distance and the direction of the contact from a cell outside.

use std::f64::consts::PI;

use super::neighbours::{Neighbour, Neighbours};
use crate::cells::length;

/// Radius within which contact cells count, in columns and rows.
pub(super) const REACH: isize = 8;
/// No contact is near if S exceeds the one of the half-plane beyond the radius by less than this part.
const ONSET: f64 = 0.03;
/// S d^(1/4) of a half-plane at the distance d: 4 pi^(1/2) Gamma(5/8)/Gamma(9/8).
const EDGE: f64 = 10.799_631_181_215_187;
/// Limit in plane strain.
const FLAT_EDGE: f64 = 4.0;

/// Sums over the contact cells around a cell n outside:
///
/// ```text
/// S = sum_m r_nm^(-9/4),   e ~ sum_m r_nm^(-9/4) (x_m - x_n)/r_nm, |e| = 1
/// ```
///
/// over the contact cells m within the radius, with half of the plane beyond added to S; lengths in
/// units of a cell, (dx dy)^(1/2) or dx in plane strain, where the power is -5/4. A straight edge
/// of a continuum at the distance d has S ~ d^(-1/4), which defines d for any edge. Closing and
/// motion of cells outside are nearly functions of this d, whatever steps the edge makes between
/// the cells. Power, radius and onset were set on a sphere pressed on a harder coating;
/// `make constants` shows what they do elsewhere.
#[derive(Clone, Copy)]
pub(super) struct View {
    sum: f64,
    toward: [f64; 2],
    flat: bool,
}

impl View {
    /// The contact as seen from cell n: sums of weights over the contact cells around. None if none is near
    /// enough to count.
    pub(super) fn from_cell(
        n: usize,
        cells: &Neighbours,
        contact: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let beyond = half_plane_sum_beyond(cells.flat);
        let mut view = Self {
            sum: beyond,
            toward: [0.0; 2],
            flat: cells.flat,
        };
        let seen = cells
            .neighbours_within(n, REACH)
            .filter(|near| contact(near.cell));
        seen.for_each(|near| view.add(&near));
        (view.sum > (1.0 + ONSET) * beyond).then_some(view)
    }

    /// Adds a contact cell to the sums of the view.
    pub(super) fn add(&mut self, near: &Neighbour) {
        self.sum += near.weight;
        for (toward, way) in self.toward.iter_mut().zip(near.direction) {
            *toward += near.weight * way;
        }
    }

    /// d^(1/2), d being the distance of the contact in lengths of a cell, from the sum of weights.
    pub(super) fn root(&self) -> f64 {
        let edge = if self.flat { FLAT_EDGE } else { EDGE };
        (edge / self.sum).powi(2)
    }

    /// The unit vector e towards the contact; zero where the contact surrounds the cell evenly.
    pub(super) fn toward(&self) -> [f64; 2] {
        let size = length(self.toward).max(f64::MIN_POSITIVE);
        self.toward.map(|toward| toward / size)
    }
}

/// The part of the sum of weights of a half-plane that lies beyond the radius of the view; `flat` in plane
/// strain.
fn half_plane_sum_beyond(flat: bool) -> f64 {
    let side = if flat { 1.0 } else { PI };
    side * 4.0 / (REACH as f64 + 0.5).powf(0.25)
}
