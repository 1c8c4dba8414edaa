//! Where a line crosses the rim of a contact and the border of its stick zone: there the stress of the surface has
//! its cusps, between the middles of the cells.

use ndarray::Array2;

use crate::fields::Line;
use crate::scene::Grid;

/// What ends at a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zone {
    /// The contact: its rim.
    Contact,
    /// The stick zone.
    Stick,
}

/// A place on the border of a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Border {
    /// Place along the line \[m\].
    pub(super) place: f64,
    /// What ends there.
    pub(super) zone: Zone,
}

/// What may be wrong with a largest value, by its sources, in the unit of the value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// What the search along x leaves.
    pub x: f64,
    /// What the search along y leaves.
    pub y: f64,
    /// What the search over the depths leaves.
    pub z: f64,
    /// By how much the value differs under the tractions of cells twice as large; none where that was not looked at.
    pub tractions: Option<f64>,
}

impl Errors {
    /// All together.
    pub fn sum(&self) -> f64 {
        self.x + self.y + self.z + self.tractions.unwrap_or_default()
    }
}

/// The borders on the row or column of cells that is nearest to a line, of a pressure \[Pa\] and the cells that stick.
///
/// At a rim where the bodies part smoothly the pressure falls as the root of the distance, so that its square, continued
/// from the last two cells, ends there; elsewhere, and for the stick zone, it is taken between two cells.
pub(super) fn borders(
    grid: &Grid,
    p: &Array2<f64>,
    stick: &Array2<bool>,
    line: Line,
) -> Vec<Border> {
    let nearest = |v: f64, n: usize, d: f64| {
        let at = v / d + (n - 1) as f64 / 2.0;
        (at.round().max(0.0) as usize).min(n - 1)
    };
    let (n, d) = match line {
        Line::AlongX(_) => (grid.nx, grid.dx),
        Line::AlongY(_) => (grid.ny, grid.dy),
    };
    let cell = |k: usize| match line {
        Line::AlongX(y) => (k, nearest(y, grid.ny, grid.dy)),
        Line::AlongY(x) => (nearest(x, grid.nx, grid.dx), k),
    };
    let middle = |k: usize| (k as f64 - (n - 1) as f64 / 2.0) * d;
    let touches = |k: usize| p[cell(k)] > 0.0;
    let mut found = Vec::new();
    for (k, next) in (1..n).map(|k| (k - 1, k)) {
        if touches(k) != touches(next) {
            // The last cell in contact, and the way out of it.
            let (last, out) = if touches(k) { (k, 1.0) } else { (next, -1.0) };
            let inside = if out > 0.0 {
                last.checked_sub(1)
            } else {
                Some(last + 1)
            };
            let squares = inside
                .filter(|i| *i < n)
                .map(|i| (p[cell(i)].powi(2), p[cell(last)].powi(2)));
            let beyond = match squares {
                Some((inner, outer)) if inner > outer => (outer / (inner - outer)).min(1.0),
                _ => 0.5,
            };
            let place = middle(last) + out * beyond * d;
            found.push(Border {
                place,
                zone: Zone::Contact,
            });
        } else if touches(k) && stick[cell(k)] != stick[cell(next)] {
            let place = f64::midpoint(middle(k), middle(next));
            found.push(Border {
                place,
                zone: Zone::Stick,
            });
        }
    }
    found
}
