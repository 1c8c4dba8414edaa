//! Tractions of a contact between the middles of its cells, out to its rim and to the stick zone.
//!
//! Constant tractions cannot follow the root with which pressure and shear vanish at the rim, nor that
//! with which the shear falls short of its bound inside a stick zone that shrinks. The squares can
//! be interpolated: p^2, and with it q/p; near the stick zone (m p - |q|)^2, m being |q|/p where
//! cells slip. They are interpolated bilinearly between the middles of the cells, with the values at the
//! borders that `level` extrapolates from inside. Where no border can be extrapolated (a punch with a
//! sharp edge, a contact of few cells) the tractions stay constant.

use ndarray::{Array2, Zip};
use std::ops::Range;

use super::neighbours::{Around, around, cut, distances, filled};
use super::sampled_border::SampledBorder;
use super::stick_zone::StickZone;
use crate::convolution::Tractions;
use crate::scene::Grid;

/// The tractions of a contact as fields over a window of its cells.
#[derive(Clone, Debug)]
pub(crate) struct Continued {
    /// First column and row of the window.
    start: (usize, usize),
    /// The tractions q_x, q_y, p as they are \[Pa\].
    constant: [Array2<f64>; 3],
    /// p^2 \[Pa^2\], below zero in cells beside the contact.
    level: Array2<f64>,
    /// q/p, in cells beside the contact the mean of their neighbours' within.
    ratios: [Array2<f64>; 2],
    /// m, not a number far from the slip cells, and (m p - |q|)^2 \[Pa^2\], below zero in cells beside the stick zone.
    bound: Option<[Array2<f64>; 2]>,
    varying: Array2<Varying>,
    /// Distance of the cells from those beside a border that the tractions are continued to, in
    /// cells along or across, up to 255.
    distance: Array2<u8>,
}

/// What of the tractions varies in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Varying {
    Nothing,
    Pressure,
    /// And the shear in proportion to it.
    Both,
    /// The shear as its bound less the shortfall.
    Shortfall,
}

impl Continued {
    /// Of tractions on a grid, each of shape (nx, ny) \[Pa\], in a window of columns and rows. Without
    /// the cells that stick, shear is taken to slip at the rim.
    pub(crate) fn new(
        grid: &Grid,
        tractions: &Tractions<'_>,
        stick: Option<&[bool]>,
        window: &(Range<usize>, Range<usize>),
    ) -> Self {
        let shape = (grid.nx, grid.ny);
        let field = |values: Option<&[f64]>| {
            Array2::from_shape_fn(shape, |(i, j)| values.map_or(0.0, |v| v[i * grid.ny + j]))
        };
        let q = [tractions.q_x, tractions.q_y].map(field);
        let p = field(tractions.p);
        let rim = SampledBorder::of_contact(grid, &p);
        let zone = stick.and_then(|stick| StickZone::new(grid, &p, &q, stick));
        let mut varying = Array2::from_shape_fn(shape, |cell| {
            let presses = around(cell, shape).any(|at| rim.level[at] > 0.0);
            let in_zone = zone.as_ref().is_some_and(|zone| zone.reaches(cell));
            match (presses, in_zone) {
                (true, true) => Varying::Shortfall,
                (true, false) => Varying::Both,
                _ => Varying::Nothing,
            }
        });
        let sticks = |n: usize| stick.is_some_and(|stick| stick[n]);
        for &cell in &rim.known {
            // Shear that sticks at the rim does not follow from the pressure.
            if sticks(cell.0 * grid.ny + cell.1) && q.iter().any(|q| q[cell] != 0.0) {
                around(cell, shape).for_each(|at| varying[at] = Varying::Pressure);
            }
        }
        for cell in &rim.unknown {
            around(*cell, shape).for_each(|at| varying[at] = Varying::Nothing);
        }
        let zone_known = zone.iter().flat_map(|zone| &zone.border.known);
        let distance = distances(shape, rim.known.iter().chain(zone_known));
        Self {
            start: (window.0.start, window.1.start),
            ratios: [0, 1].map(|c| cut(&ratio(&q[c], &p), window)),
            constant: [&q[0], &q[1], &p].map(|field| cut(field, window)),
            level: cut(&rim.level, window),
            bound: zone.map(|zone| [&zone.m, &zone.border.level].map(|field| cut(field, window))),
            varying: cut(&varying, window),
            distance: cut(&distance, window),
        }
    }

    /// A cell of the grid in the window.
    fn place(&self, cell: (usize, usize)) -> Option<(usize, usize)> {
        let (i, j) = (
            cell.0.checked_sub(self.start.0)?,
            cell.1.checked_sub(self.start.1)?,
        );
        let (columns, rows) = self.level.dim();
        (i < columns && j < rows).then_some((i, j))
    }

    /// Distance of a cell from those beside a border, in cells along or across.
    pub(crate) fn distance(&self, cell: (usize, usize)) -> u8 {
        self.place(cell).map_or(u8::MAX, |at| self.distance[at])
    }

    /// Calls `f` with what the tractions q_x, q_y, p exceed the constant ones by at places in a cell \[Pa\]:
    /// each place by its offset from the middle in cells, with the datum that goes with it.
    pub(crate) fn each_excess<T>(
        &self,
        cell: (usize, usize),
        places: &[((f64, f64), T)],
        mut f: impl FnMut([f64; 3], &T),
    ) {
        let Some(cell) = self.place(cell) else { return };
        let varying = self.varying[cell];
        if varying == Varying::Nothing {
            return;
        }
        let constant = [0, 1, 2].map(|c| self.constant[c][cell]);
        let level = Around::new(&self.level, cell);
        let ratios = [0, 1].map(|c| Around::new(&self.ratios[c], cell));
        let bound = self
            .bound
            .as_ref()
            .filter(|_| varying == Varying::Shortfall);
        let bound = bound.map(|fields| [0, 1].map(|c| Around::new(&fields[c], cell)));
        for (offset, of) in places {
            let p = level.at(*offset).max(0.0).sqrt();
            if varying == Varying::Pressure {
                f([0.0, 0.0, p - constant[2]], of);
                continue;
            }
            let [x, y] = [0, 1].map(|c| ratios[c].at(*offset));
            let size = match &bound {
                Some([m, shortfall]) => {
                    let q = m.at(*offset) * p - shortfall.at(*offset).max(0.0).sqrt();
                    q.max(0.0) / x.hypot(y).max(f64::MIN_POSITIVE)
                }
                None => p,
            };
            f(
                [
                    size * x - constant[0],
                    size * y - constant[1],
                    p - constant[2],
                ],
                of,
            );
        }
    }
}

/// q/p, in cells beside the contact the mean of their neighbours' within.
fn ratio(q: &Array2<f64>, p: &Array2<f64>) -> Array2<f64> {
    let within = Zip::from(q)
        .and(p)
        .map_collect(|q, p| (*p > 0.0).then(|| q / p));
    filled(&within).mapv(|ratio| ratio.unwrap_or(0.0))
}
