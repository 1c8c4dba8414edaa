//! Tractions of a contact interpolated between the centres of its cells, up to the rim and the
//! border of the stick zone.
//!
//! Pressure and shear vanish at the rim like the square root of the distance, and so does the
//! shortfall of the shear from its bound inside a stick zone that shrinks; tractions constant in
//! each cell cannot represent that. Their squares are nearly linear and are interpolated bilinearly
//! between the centres of the cells: p^2, with q/p beside it; near the stick zone (m p - q.e)^2, m
//! and e being |q|/p and q/|q| of the slip cells. Cells that stick at the rim, as just after a
//! reversal, where the ring of slip is narrower than a cell, have |q| <= mu p as well: q/p is
//! interpolated there, too, so that the shear has no step. In cells at a border the values are extrapolated from inside
//! (`level`). Where that is impossible (a punch with a sharp edge, a contact of few cells) the
//! border is assumed a quarter of a cell outside the edge of the outermost cell, where a root from
//! the centre of the cell carries the load of half the cell. So the tractions have no step, next to
//! which the stress would be infinite. On a layer as thin as the cells the assumed border makes
//! errors above 0.1 p_H; tractions stay constant there.

use ndarray::{Array2, Zip};
use std::ops::Range;

use super::neighbours::{
    Neighbourhood, cell_and_neighbours, chessboard_distances, cut_window, fill_from_neighbours,
};
use super::sampled_border::SampledBorder;
use super::stick_zone::StickZone;
use crate::convolution::Tractions;
use crate::scene::Grid;

/// Cells up to this distance from a border, along or across, carry the load of the continued
/// tractions; those farther off the load of the cell.
const BORDER_WIDTH: u8 = 3;
/// Assumed distance t of a border that cannot be extrapolated from the centre of the outermost cell
/// \[cells\]: the integral of (1 - s/t)^(1/2) over 0..t is 2 t/3 = 1/2, the load of half a cell.
const ASSUMED_DISTANCE: f64 = 0.75;
/// Places in a cell at which the border on an oblique line is looked for.
const SAMPLES_PER_CELL: f64 = 4.0;

/// The tractions of a contact as fields over a window of its cells.
#[derive(Clone, Debug)]
pub struct Continued {
    /// First column and row of the window.
    start: (usize, usize),
    /// The tractions q_x, q_y, p constant in each cell \[Pa\].
    constant: [Array2<f64>; 3],
    /// Constant corrections of the interpolated tractions, far from borders \[Pa\].
    correction: [Array2<f64>; 3],
    /// p^2 \[Pa^2\], below zero in cells beside the contact.
    level: Array2<f64>,
    /// q/p, in cells beside the contact the mean of their neighbours' within.
    ratios: [Array2<f64>; 2],
    /// m and e, NaN far from the slip cells, and (m p - q.e)^2 \[Pa^2\], negative in cells beside the
    /// stick zone.
    bound: Option<Bound<Array2<f64>>>,
    varying: Array2<Variation>,
    /// Cells whose level could not be extrapolated from inside.
    is_assumed: Array2<bool>,
    /// Whether the tractions are constant in those cells.
    has_assumed_steps: bool,
    /// Distance from the nearest cell at a known or assumed border, in cells along or across, up
    /// to 255.
    distance: Array2<u8>,
}

/// Point where a line of cells crosses the border of a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Column and row of the grid, in cells from the middle of the first.
    pub place: [f64; 2],
    /// Whether the zone is the stick zone; else the contact.
    pub stick: bool,
    /// Whether the border is extrapolated to a place within the cell; else it is assumed.
    pub is_within_cell: bool,
}

/// The tractions that vary within a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Variation {
    Nothing,
    /// The pressure, and q/p.
    Both,
    /// The pressure, and the shear as m p less the shortfall.
    Shortfall,
}

/// The shear near a stick zone: q.e is m p less the root of `shortfall`.
#[derive(Clone, Debug)]
struct Bound<T> {
    m: T,
    e: [T; 2],
    shortfall: T,
}

impl<T> Bound<T> {
    /// Applies a function to all fields.
    fn map<U>(&self, f: impl Fn(&T) -> U) -> Bound<U> {
        Bound {
            m: f(&self.m),
            e: self.e.each_ref().map(&f),
            shortfall: f(&self.shortfall),
        }
    }
}

impl Continued {
    /// Continues the tractions on a grid, each of shape (nx, ny) \[Pa\], in a window of columns and
    /// rows. Without `stick` all cells at the rim are taken to slip. On a layer as thin as the
    /// cells (`thin`) the tractions stay constant where no border can be extrapolated.
    pub fn new(
        grid: &Grid,
        tractions: &Tractions<'_>,
        stick: Option<&[bool]>,
        window: &(Range<usize>, Range<usize>),
        thin: bool,
    ) -> Self {
        let shape = (grid.nx, grid.ny);
        let field = |values: Option<&[f64]>| {
            Array2::from_shape_fn(shape, |(i, j)| values.map_or(0.0, |v| v[i * grid.ny + j]))
        };
        let q = [tractions.q_x, tractions.q_y].map(field);
        let p = field(tractions.p);
        let mut rim = SampledBorder::of_contact(grid, &p);
        let mut is_assumed = Array2::from_elem(shape, false);
        for &cell in &rim.unknown {
            is_assumed[cell] = true;
            if p[cell] <= 0.0 && !thin {
                let pressures_around = || {
                    cell_and_neighbours(cell, shape)
                        .map(|at| p[at])
                        .filter(|p| *p > 0.0)
                };
                let sum: f64 = pressures_around().map(|p| p * p).sum();
                rim.level[cell] =
                    (1.0 - 1.0 / ASSUMED_DISTANCE) * sum / pressures_around().count().max(1) as f64;
            }
        }
        let zone = stick.and_then(|stick| StickZone::new(grid, &p, &q, stick));
        let mut varying = Array2::from_shape_fn(shape, |cell| {
            let touches_contact = cell_and_neighbours(cell, shape).any(|at| rim.level[at] > 0.0);
            let in_zone = zone.as_ref().is_some_and(|zone| zone.covers(cell));
            match (touches_contact, in_zone) {
                (true, true) => Variation::Shortfall,
                (true, false) => Variation::Both,
                _ => Variation::Nothing,
            }
        });
        let constant = rim.unknown.iter().filter(|_| thin);
        for at in constant.flat_map(|cell| cell_and_neighbours(*cell, shape)) {
            varying[at] = Variation::Nothing;
        }
        let zone_known = zone.iter().flat_map(|zone| &zone.border.known);
        let at_rim = (rim.known.iter()).chain(rim.unknown.iter().filter(|_| !thin));
        let distance = chessboard_distances(shape, at_rim.chain(zone_known));
        let mut continued = Self {
            start: (window.0.start, window.1.start),
            ratios: [0, 1].map(|c| cut_window(&ratio(&q[c], &p), window)),
            constant: [&q[0], &q[1], &p].map(|field| cut_window(field, window)),
            correction: [(); 3].map(|()| Array2::zeros((window.0.len(), window.1.len()))),
            level: cut_window(&rim.level, window),
            bound: zone.map(|zone| {
                let whole = Bound {
                    m: zone.m,
                    e: zone.direction,
                    shortfall: zone.border.level,
                };
                whole.map(|field| cut_window(field, window))
            }),
            varying: cut_window(&varying, window),
            is_assumed: cut_window(&is_assumed, window),
            has_assumed_steps: thin && !rim.unknown.is_empty(),
            distance: cut_window(&distance, window),
        };
        continued.keep_loads();
        continued
    }

    /// The places where a line along x (`axis` 0) or y (1), at `at` rows or columns from the first,
    /// crosses the rim of the contact and the border of the stick zone.
    pub fn crossings(&self, axis: usize, at: f64) -> Vec<Crossing> {
        let other_axis = 1 - axis;
        let start = [self.start.0, self.start.1];
        let shape = [self.level.nrows(), self.level.ncols()];
        let position = (at - start[other_axis] as f64).clamp(0.0, (shape[other_axis] - 1) as f64);
        let (lower, part) = (position.floor() as usize, position.fract());
        let upper = (lower + 1).min(shape[other_axis] - 1);
        let cell = |n: usize, row: usize| if axis == 0 { (n, row) } else { (row, n) };
        let value_on_line = |field: &Array2<f64>, n: usize| {
            let [low, high] = [lower, upper].map(|row| field[cell(n, row)]);
            if part == 0.0 {
                low
            } else {
                low + part * (high - low)
            }
        };
        let is_pressed = |n: usize| value_on_line(&self.constant[2], n) > 0.0;
        let is_assumed_at = |n: usize| {
            [lower, upper]
                .iter()
                .any(|row| self.is_assumed[cell(n, *row)])
        };
        let zones = [
            Some(&self.level),
            self.bound.as_ref().map(|bound| &bound.shortfall),
        ];
        let mut crossings = Vec::new();
        for (zone, level) in zones.into_iter().enumerate() {
            let Some(level) = level else { continue };
            for n in 1..shape[axis] {
                let (a, b) = (value_on_line(level, n - 1), value_on_line(level, n));
                // A stick zone that ends where the contact does has no border of its own.
                let outside = if a > 0.0 { n } else { n - 1 };
                if (a > 0.0) == (b > 0.0) || (zone == 1 && !is_pressed(outside)) {
                    continue;
                }
                let within_cell =
                    a.min(b) < 0.0 && !(zone == 0 && (is_assumed_at(n - 1) || is_assumed_at(n)));
                let step = if a.min(b) < 0.0 { a / (a - b) } else { 0.5 };
                let position_along = (start[axis] + n - 1) as f64 + step;
                let place = if axis == 0 {
                    [position_along, at]
                } else {
                    [at, position_along]
                };
                crossings.push(Crossing {
                    place,
                    stick: zone == 1,
                    is_within_cell: within_cell,
                });
            }
        }
        crossings
    }

    /// Finds the crossings of a line in any direction: from a point in steps of about a cell \[cells\],
    /// between two numbers of steps.
    pub fn crossings_along(&self, from: [f64; 2], step: [f64; 2], ends: [f64; 2]) -> Vec<Crossing> {
        let point_at = |n: f64| [from[0] + n * step[0], from[1] + n * step[1]];
        let zones = [
            Some(&self.level),
            self.bound.as_ref().map(|bound| &bound.shortfall),
        ];
        let mut crossings = Vec::new();
        for (zone, level) in zones.into_iter().enumerate() {
            let Some(level) = level else { continue };
            let value_at = |n: f64| self.interpolate(level, point_at(n));
            let count = ((ends[1] - ends[0]) * SAMPLES_PER_CELL).ceil().max(1.0) as usize;
            let place = |k: usize| ends[0] + k as f64 / SAMPLES_PER_CELL;
            let mut previous = (place(0), value_at(place(0)));
            for now in (1..=count).map(|k| (place(k), value_at(place(k)))) {
                let ((m, a), (n, b)) = (previous, now);
                previous = now;
                if (a > 0.0) == (b > 0.0) {
                    continue;
                }
                let outside = point_at(if a > 0.0 { n } else { m });
                if zone == 1 && self.interpolate(&self.constant[2], outside) <= 0.0 {
                    continue;
                }
                let is_extrapolated = a.min(b) < 0.0;
                let crossing = point_at(if is_extrapolated {
                    m + (n - m) * a / (a - b)
                } else {
                    0.5 * (m + n)
                });
                let cell = crossing.map(|v| v.round().max(0.0) as usize);
                crossings.push(Crossing {
                    place: crossing,
                    stick: zone == 1,
                    is_within_cell: is_extrapolated
                        && !(zone == 0 && self.rim_is_unknown((cell[0], cell[1]))),
                });
            }
        }
        crossings
    }

    /// Whether a cell of the grid is pressed.
    pub fn presses(&self, cell: (usize, usize)) -> bool {
        self.index_in_window(cell)
            .is_some_and(|at| self.constant[2][at] > 0.0)
    }

    /// Interpolates a field bilinearly between the centres of the cells.
    fn interpolate(&self, field: &Array2<f64>, [column, row]: [f64; 2]) -> f64 {
        let (columns, rows) = field.dim();
        let split = |v: f64, start: usize, n: usize| {
            let v = (v - start as f64).clamp(0.0, (n - 1) as f64);
            (
                v.floor() as usize,
                (v.floor() as usize + 1).min(n - 1),
                v.fract(),
            )
        };
        let (i, next, s) = split(column, self.start.0, columns);
        let (j, above, t) = split(row, self.start.1, rows);
        let value_in_row = |j: usize| field[(i, j)] + s * (field[(next, j)] - field[(i, j)]);
        value_in_row(j) + t * (value_in_row(above) - value_in_row(j))
    }

    /// Index of a cell of the grid in the window.
    fn index_in_window(&self, cell: (usize, usize)) -> Option<(usize, usize)> {
        let (i, j) = (
            cell.0.checked_sub(self.start.0)?,
            cell.1.checked_sub(self.start.1)?,
        );
        let (columns, rows) = self.level.dim();
        (i < columns && j < rows).then_some((i, j))
    }

    /// Distance of a cell from the cells at a border, in cells along or across.
    pub fn distance(&self, cell: (usize, usize)) -> u8 {
        self.index_in_window(cell)
            .map_or(u8::MAX, |at| self.distance[at])
    }

    /// Whether the tractions have a spurious step at the edges of a cell or of one next to it.
    pub fn has_steps(&self, cell: (usize, usize)) -> bool {
        if !self.has_assumed_steps {
            return false;
        }
        let is_step = |at: (usize, usize)| {
            self.varying[at] == Variation::Nothing
                && cell_and_neighbours(at, self.varying.dim()).any(|at| self.is_assumed[at])
        };
        self.index_in_window(cell)
            .is_some_and(|at| cell_and_neighbours(at, self.varying.dim()).any(is_step))
    }

    /// Whether a cell or one next to it is at an assumed rim.
    pub fn rim_is_unknown(&self, cell: (usize, usize)) -> bool {
        self.index_in_window(cell).is_some_and(|at| {
            cell_and_neighbours(at, self.is_assumed.dim()).any(|at| self.is_assumed[at])
        })
    }

    /// Change of q_x, q_y, p over the length and over the width of a cell far from borders \[Pa\];
    /// none where they are constant.
    pub fn slopes(&self, cell: (usize, usize)) -> Option<[[f64; 3]; 2]> {
        let (i, j) = self.index_in_window(cell)?;
        if self.varying[(i, j)] == Variation::Nothing {
            return None;
        }
        let (columns, rows) = self.level.dim();
        let neighbours = |n: usize, count: usize| (n.saturating_sub(1), (n + 1).min(count - 1));
        let ((left, right), (below, above)) = (neighbours(i, columns), neighbours(j, rows));
        let slope = |c: usize, low: (usize, usize), high: (usize, usize)| {
            let cells = (high.0 - low.0 + high.1 - low.1).max(1);
            (self.constant[c][high] - self.constant[c][low]) / cells as f64
        };
        Some([
            [0, 1, 2].map(|c| slope(c, (left, j), (right, j))),
            [0, 1, 2].map(|c| slope(c, (i, below), (i, above))),
        ])
    }

    /// The interpolated tractions within a cell; none where they are taken as constant.
    pub fn tractions_within(&self, cell: (usize, usize)) -> Option<CellTractions> {
        let at = self.index_in_window(cell)?;
        let varying = self.varying[at];
        if varying == Variation::Nothing {
            return None;
        }
        let neighbourhood = |field: &Array2<f64>| Neighbourhood::new(field, at);
        let bound = self.bound.as_ref();
        let bound = bound.filter(|_| varying == Variation::Shortfall);
        Some(CellTractions {
            constant: [0, 1, 2].map(|c| self.constant[c][at]),
            lacking: [0, 1, 2].map(|c| self.correction[c][at]),
            level: neighbourhood(&self.level),
            ratios: self.ratios.each_ref().map(neighbourhood),
            bound: bound.map(|bound| bound.map(neighbourhood)),
        })
    }

    /// Shifts the interpolated tractions of cells far from the borders to the mean of the constant
    /// ones, which are right to second order there: the load of the cell is kept.
    fn keep_loads(&mut self) {
        let (columns, rows) = self.level.dim();
        let cells = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
        let is_far = |cell: &(usize, usize)| self.distance[*cell] > BORDER_WIDTH;
        let mean = |cell: (usize, usize)| {
            let tractions =
                self.tractions_within((cell.0 + self.start.0, cell.1 + self.start.1))?;
            let quarters = [(-0.25, -0.25), (-0.25, 0.25), (0.25, -0.25), (0.25, 0.25)];
            let mut mean = [0.0; 3];
            for offset in quarters {
                for (mean, q) in mean.iter_mut().zip(tractions.evaluate(offset)) {
                    *mean += q / quarters.len() as f64;
                }
            }
            Some((cell, mean))
        };
        let means: Vec<_> = cells.filter(is_far).filter_map(mean).collect();
        for (cell, mean) in means {
            for (c, mean) in mean.into_iter().enumerate() {
                self.correction[c][cell] = self.constant[c][cell] - mean;
            }
        }
    }
}

/// The tractions within a cell.
pub struct CellTractions {
    /// The constant tractions of the cell \[Pa\].
    pub constant: [f64; 3],
    lacking: [f64; 3],
    level: Neighbourhood,
    ratios: [Neighbourhood; 2],
    bound: Option<Bound<Neighbourhood>>,
}

impl CellTractions {
    /// q_x, q_y, p at an offset from the middle in cells \[Pa\].
    pub fn evaluate(&self, offset: (f64, f64)) -> [f64; 3] {
        let q = self.interpolated(offset);
        std::array::from_fn(|c| q[c] + self.lacking[c])
    }

    /// q_x, q_y, p \[Pa\] at an offset from the middle of the cell, in cells, by the interpolated fields.
    fn interpolated(&self, offset: (f64, f64)) -> [f64; 3] {
        let p = self.level.interpolate(offset).max(0.0).sqrt();
        let [x, y] = self
            .ratios
            .each_ref()
            .map(|ratio| ratio.interpolate(offset));
        let Some(Bound { m, e, shortfall }) = &self.bound else {
            return [p * x, p * y, p];
        };
        let [e_x, e_y] = e.each_ref().map(|e| e.interpolate(offset));
        let length = (e_x * e_x + e_y * e_y).sqrt().max(f64::MIN_POSITIVE);
        let (e_x, e_y) = (e_x / length, e_y / length);
        // Along e the bound gives the shear, across it q/p.
        let shear_along = m.interpolate(offset) * p - shortfall.interpolate(offset).max(0.0).sqrt();
        let shear_across = p * (y * e_x - x * e_y);
        [
            shear_along * e_x - shear_across * e_y,
            shear_along * e_y + shear_across * e_x,
            p,
        ]
    }
}

/// q/p of each cell. Cells beside the contact get the mean over their neighbours inside.
fn ratio(q: &Array2<f64>, p: &Array2<f64>) -> Array2<f64> {
    let inside = Zip::from(q)
        .and(p)
        .map_collect(|q, p| (*p > 0.0).then(|| q / p));
    fill_from_neighbours(&inside).mapv(|ratio| ratio.unwrap_or(0.0))
}
