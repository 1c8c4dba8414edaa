//! Cells that the rim of the contact, or the border of the stick zone, goes through.
//!
//! With the distance d inwards from the rim the pressure grows like d^(1/2 + e), and mu p - q . t, t being
//! the direction of the shear where cells slip, like d^(1/2) from the border of a stick zone that shrinks.
//! A power of either, the level f, vanishes linearly:
//!
//! ```text
//! f = b_1 d + b_2 d^2 + ...,   f = p^(2/(1 + 2 e)) or (mu p - q . t)^2,   tan(pi e) = beta q_n/p
//! ```
//!
//! with Dundurs' beta and the shear q_n towards the inside on body 2 (a rim that slides on dissimilar
//! bodies; Comninou, J. Appl. Mech. 43 (1976) 631). Where a stick zone grows, cells stick with the shear
//! that they slipped with, mu p - q . t grows like d^(3/2) in the limit of small increments and does not
//! show the border of one increment: there whole cells count.
//!
//! The outermost cell shows a border that is off by up to a tenth of a cell, the second by a thirtieth,
//! those further in by less than a hundredth. So f is continued outwards from these: along that line of cells, out of eight, that meets the
//! border most squarely, by the parabola through the next cells. Where the continued f is zero runs
//! the border, a straight line within a cell.

use ndarray::Array2;

use super::March;
use crate::convolution::Mirror;
use crate::reference::dundurs_beta;
use crate::scene::Grid;
use crate::solvers::{Interface, friction_bound, size};

/// Farthest that the border may lie from the middle between the outermost cell of the zone and its
/// neighbour outside, in cells along the line: beyond, f is no such level (a punch with a sharp edge).
const FARTHEST: f64 = 1.5;
/// How much further out than the true border the level of cells with constant tractions vanishes, in
/// cells: the mean over places and directions of the border within the cells, of Hertz contacts and of
/// their stick zones.
const SPREAD: f64 = 0.012;
/// Power of d that mu p - q . t grows with from the border of a stick zone, if it shrinks and if it
/// grows.
const SHRINKS: f64 = 0.5;
const GROWS: f64 = 1.5;
/// Largest second difference of the level along a line, and largest change of it from cell to cell,
/// over the first change of the level: beyond, another border lies there (of the stick zone before
/// a reversal).
const FIRST_BEND: f64 = 0.4;
const BEND: f64 = 0.15;

impl March {
    /// Area of the contact and of the stick zone, in kept cells.
    pub(super) fn contact_and_stick(&self, now: &Interface) -> [f64; 2] {
        let lattice = Lattice::new(&self.window.grid, self.plan.mirror);
        let beta = dundurs_beta(self.scene.body1.outermost(), self.scene.body2.outermost());
        let contact: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
        let stick: Vec<bool> = contact
            .iter()
            .zip(&now.slip)
            .map(|(&c, &s)| c && !s)
            .collect();
        let rim = lattice.edges(
            &contact,
            |[_, rim], inwards| {
                let q_n = now.q[0][rim] * inwards[0] + now.q[1][rim] * inwards[1];
                let e = (beta * q_n / now.p[rim]).atan() / std::f64::consts::PI;
                (0.5 + e, None)
            },
            |n, _| now.p[n],
        );
        let area = |zone: &[bool], edges: &[(usize, Edge)]| -> f64 {
            let whole = zone.iter().filter(|&&inside| inside).count() as f64;
            let partial =
                |(n, edge): &(usize, Edge)| edge.share(SPREAD) - f64::from(u8::from(zone[*n]));
            whole + edges.iter().map(partial).sum::<f64>()
        };
        let contact_area = area(&contact, &rim);
        if !now.slip.contains(&true) {
            return [contact_area; 2];
        }
        let q = |n: usize| [now.q[0][n], now.q[1][n]];
        let mut border = lattice.edges(
            &stick,
            |_, _| (SHRINKS, Some(GROWS)),
            |n, [outside, outermost]| {
                let e = q(if contact[outside] { outside } else { outermost });
                let along = (q(n)[0] * e[0] + q(n)[1] * e[1]) / size(e).max(f64::MIN_POSITIVE);
                friction_bound(self.mu[n], now.p[n]) - along
            },
        );
        for (n, edge) in &mut border {
            if let Ok(at) = rim.binary_search_by_key(n, |(n, _)| *n)
                && edge.share(0.0) > rim[at].1.share(0.0)
            {
                *edge = rim[at].1;
            }
        }
        [contact_area, area(&stick, &border)]
    }
}

/// The pressure at the centres of the cells \[Pa\], shape (nx, ny), with that at the rim of the contact
/// continued from inside.
///
/// Cells at the rim carry what balances the others, a tenth more or less than the pressure at their
/// centres; without them the error of p falls from first to second order. The sum over the cells is
/// that of the load only to first order: balances need the pressure as it was solved for.
pub fn continued_pressure(p: &Array2<f64>, grid: &Grid) -> Array2<f64> {
    let lattice = Lattice::new(grid, Mirror::None);
    let contact: Vec<bool> = p.iter().map(|&p| p > 0.0).collect();
    let mut continued: Vec<f64> = p.iter().copied().collect();
    let rim = lattice.edges(&contact, |_, _| (0.5, None), |n, _| continued[n]);
    for (n, edge) in rim {
        if let Some((level, _)) = edge.level {
            continued[n] = level.max(0.0).sqrt();
        }
    }
    let kept = |i: usize, j: usize| continued[i * grid.ny + j];
    Array2::from_shape_fn((grid.nx, grid.ny), |(i, j)| kept(i, j))
}

/// Where the kept cells are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    columns: isize,
    rows: isize,
    mirrored: bool,
    flat: bool,
}

/// The level continued to a cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The level at the cell's centre and its change from cell to cell along x and y; none where the
    /// cells do not tell.
    level: Option<(f64, [f64; 2])>,
    /// Whether the cell is in the zone.
    inside: bool,
}

impl Edge {
    /// The level at the cell's centre and its change from cell to cell along x and y, where the
    /// cells tell them.
    pub(super) fn level(&self) -> Option<(f64, [f64; 2])> {
        self.level
    }

    /// The part of the cell that belongs to the zone, 0 to 1, with the border so many cells further
    /// in than the level says; all or nothing where the cells do not tell.
    fn share(&self, further_in: f64) -> f64 {
        match self.level {
            Some((level, slope)) => {
                half_plane(level - further_in * slope[0].hypot(slope[1]), slope)
            }
            None => f64::from(u8::from(self.inside)),
        }
    }
}

impl Lattice {
    pub(super) fn new(grid: &Grid, mirror: Mirror) -> Self {
        Self {
            columns: grid.nx as isize,
            rows: mirror.rows(grid.ny) as isize,
            mirrored: mirror == Mirror::Y,
            flat: grid.ny == 1,
        }
    }

    /// Every cell at the border of a zone, in it or next to it, in order.
    ///
    /// `value` of a cell in the zone, given the two on the line on either side of the border, the
    /// outer one first, vanishes there like a power of the distance: the first of the two that
    /// `exponents` gives, for these cells and the direction inwards. Where there is a second one that
    /// fits better the cells do not tell.
    pub(super) fn edges(
        self,
        zone: &[bool],
        exponents: impl Fn([usize; 2], [f64; 2]) -> (f64, Option<f64>),
        value: impl Fn(usize, [usize; 2]) -> f64,
    ) -> Vec<(usize, Edge)> {
        (0..zone.len())
            .filter(|&n| self.at_border(n, zone))
            .map(|n| {
                let inside = zone[n];
                let level = self.level(n, zone, &exponents, &value);
                (n, Edge { level, inside })
            })
            .collect()
    }

    /// Whether a cell has neighbours of the other kind.
    fn at_border(self, n: usize, zone: &[bool]) -> bool {
        let rows = self.rows as usize;
        let (i, j) = (n / rows, n % rows);
        if i > 0 && i + 1 < self.columns as usize && j > 0 && j + 1 < rows {
            let same =
                |m: usize| zone[m - 1] == zone[n] && zone[m] == zone[n] && zone[m + 1] == zone[n];
            return !(same(n - rows) && same(n) && same(n + rows));
        }
        self.around(n, 1)
            .any(|(_, m)| m.is_some_and(|m| zone[m]) != zone[n])
    }

    /// The level at the centre of a cell and its change from cell to cell, continued from inside.
    fn level(
        self,
        n: usize,
        zone: &[bool],
        exponents: &impl Fn([usize; 2], [f64; 2]) -> (f64, Option<f64>),
        value: &impl Fn(usize, [usize; 2]) -> f64,
    ) -> Option<(f64, [f64; 2])> {
        let in_zone = |m: &usize| zone[*m];
        let inwards = self.inwards(n, zone)?;
        let step = |k: isize| self.beside(n, inwards.map(|d| k * d));
        // Steps from the cell to the outermost one of the zone on the line.
        let first = (-1..=1).find(|&k| step(k).is_some_and(|m| zone[m]))?;
        let sides = [step(first - 1).filter(|m| !in_zone(m))?, step(first)?];
        // From the second cell of the zone on, as far as the line stays in it.
        let line: Vec<usize> = (first + 1..first + 7)
            .map_while(|k| step(k).filter(in_zone))
            .collect();
        let d = inwards.map(|k| k as f64);
        let (exponent, other) = exponents(sides, d.map(|k| k / d[0].hypot(d[1])));
        let values: Vec<f64> = line.iter().map(|&m| value(m, sides)).collect();
        let levels =
            |exponent: f64| -> Vec<f64> { values.iter().map(|&v| raised(v, exponent)).collect() };
        let here = levels(exponent);
        if other.is_some_and(|other| straightness(&levels(other)) < straightness(&here)) {
            return None;
        }
        let parabola = Parabola::through(&here)?;
        // The outermost cell, and this one, on the parabola, which counts from the third cell.
        let outermost = -2.0;
        let place = 0.5 - parabola.at(outermost) / parabola.slope(outermost);
        let here = outermost - first as f64;
        let slope = parabola.slope(here);
        let usable = place.abs() <= FARTHEST && parabola.slope(outermost) > 0.0 && slope > 0.0;
        let third = usable.then(|| line.get(1))?;
        let gradient = third.map_or([0.0; 2], |&m| {
            self.gradient(m, zone, |m| raised(value(m, sides), exponent))
        });
        let along = gradient[0] * d[0] + gradient[1] * d[1];
        let gradient = if along > 0.0 {
            gradient.map(|g| g * slope / along)
        } else {
            d.map(|d_k| d_k * slope / (d[0] * d[0] + d[1] * d[1]))
        };
        Some((parabola.at(here), gradient))
    }

    /// The direction, out of eight, that leads most squarely into the zone.
    fn inwards(self, n: usize, zone: &[bool]) -> Option<[isize; 2]> {
        let mut to = [0, 0];
        for (d, m) in self.around(n, 2) {
            if m.is_some_and(|m| zone[m]) {
                to = [to[0] + d[0], to[1] + d[1]];
            }
        }
        // The tangent of 22.5 degrees is 0.414.
        let part = |k: isize, other: isize| {
            if 1000 * k.abs() > 414 * other.abs() {
                k.signum()
            } else {
                0
            }
        };
        (to != [0, 0]).then(|| [part(to[0], to[1]), part(to[1], to[0])])
    }

    /// Central differences of the level from cell to cell; zero where a neighbour is not in the zone.
    fn gradient(self, n: usize, zone: &[bool], level: impl Fn(usize) -> f64) -> [f64; 2] {
        let along = |d: [isize; 2]| {
            let [next, last] = [d, [-d[0], -d[1]]].map(|d| self.beside(n, d).filter(|&m| zone[m]));
            Some(0.5 * (level(next?) - level(last?)))
        };
        if self.flat {
            return [along([1, 0]).unwrap_or(0.0), 0.0];
        }
        match (along([1, 0]), along([0, 1])) {
            (Some(x), Some(y)) => [x, y],
            _ => [0.0; 2],
        }
    }

    /// The cells around a cell, and where they are from it.
    fn around(self, n: usize, reach: isize) -> impl Iterator<Item = ([isize; 2], Option<usize>)> {
        let across = if self.flat { 0 } else { reach };
        (-reach..=reach)
            .flat_map(move |i| (-across..=across).map(move |j| [i, j]))
            .map(move |d| (d, self.beside(n, d)))
    }

    /// The kept cell that stands for the one so many columns and rows away.
    fn beside(self, n: usize, [columns, rows]: [isize; 2]) -> Option<usize> {
        let i = n as isize / self.rows + columns;
        let j = n as isize % self.rows + rows;
        // The kept half lies at y > 0.
        let j = if j < 0 && self.mirrored { -1 - j } else { j };
        let on_grid = (0..self.columns).contains(&i) && (0..self.rows).contains(&j);
        on_grid.then(|| (i * self.rows + j) as usize)
    }
}

/// The level of a value that grows with this power of the distance.
fn raised(value: f64, exponent: f64) -> f64 {
    let value = value.max(0.0);
    if exponent == SHRINKS {
        value * value
    } else {
        value.powf(1.0 / exponent)
    }
}

/// How much a level bends along a line, against its rise.
fn straightness(levels: &[f64]) -> f64 {
    let near = &levels[..levels.len().min(4)];
    let bends = near.windows(3).map(|y| (y[2] - 2.0 * y[1] + y[0]).abs());
    bends.sum::<f64>() / (near.last().unwrap_or(&0.0) - near.first().unwrap_or(&0.0)).abs()
}

/// f = c_0 + c_1 s + c_2 s^2 along a line, s in cells from the third one of the zone.
#[derive(Clone, Copy)]
struct Parabola([f64; 3]);

impl Parabola {
    /// Given the second cell and the next ones: least squares through the third to seventh, through
    /// the third to fifth if there are no more, a straight line through two if these are all.
    fn through(levels: &[f64]) -> Option<Self> {
        let &[y_1, y_2, ..] = levels else { return None };
        let mut last = None;
        let smooth = levels.windows(3).take_while(|y| {
            let bend = y[2] - 2.0 * y[1] + y[0];
            let (before, most) = match last.replace(bend) {
                Some(before) => (before, BEND),
                None => (0.0, FIRST_BEND),
            };
            (bend - before).abs() <= most * (y_2 - y_1).abs()
        });
        Some(match (smooth.count(), levels) {
            // About the middle sample, with the orthogonal polynomials 1, s, s^2 - 2.
            (4.., &[_, a, b, c, d, e, ..]) => {
                let c_2 = (2.0 * (a + e) - (b + d) - 2.0 * c) / 14.0;
                let c_1 = (2.0 * (e - a) + d - b) / 10.0;
                let c_0 = (a + b + c + d + e) / 5.0 - 2.0 * c_2;
                Self([c_0 - 2.0 * c_1 + 4.0 * c_2, c_1 - 4.0 * c_2, c_2])
            }
            (2.., &[_, a, b, c, ..]) => Self([a, 2.0 * b - 1.5 * a - 0.5 * c, 0.5 * (a + c) - b]),
            (1, &[_, a, b, ..]) => Self([a, b - a, 0.0]),
            _ => Self([y_2, y_2 - y_1, 0.0]),
        })
    }

    fn at(self, s: f64) -> f64 {
        let Self([c_0, c_1, c_2]) = self;
        c_0 + s * (c_1 + s * c_2)
    }

    fn slope(self, s: f64) -> f64 {
        let Self([_, c_1, c_2]) = self;
        c_1 + 2.0 * c_2 * s
    }
}

/// The part of the unit square about the origin where f + g . x > 0.
fn half_plane(f: f64, g: [f64; 2]) -> f64 {
    let [small, large] = [g[0].abs().min(g[1].abs()), g[0].abs().max(g[1].abs())];
    let beyond = 0.5 * (small + large) - f.abs();
    // The part on the other side of the line from the origin.
    let other = if beyond <= 0.0 {
        0.0
    } else if beyond < small {
        0.5 * beyond * beyond / (small * large)
    } else {
        0.5 - f.abs() / large
    };
    if f > 0.0 { 1.0 - other } else { other }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Area over that of the true zone for a level sampled at the centres.
    fn area(n: usize, (a, b): (f64, f64), mirror: Mirror) -> f64 {
        let grid = Grid::centred(2.4, n).expect("a grid");
        let f = mirror.fold(&grid.map(|x, y| 1.0 - (x / a).powi(2) - (y / b).powi(2)));
        let zone: Vec<bool> = f.iter().map(|&f| f > 0.0).collect();
        let lattice = Lattice::new(&grid, mirror);
        let whole = zone.iter().filter(|&&inside| inside).count() as f64;
        let edges = lattice.edges(&zone, |_, _| (1.0, None), |n, _| f[n]);
        let partial: f64 = edges
            .iter()
            .map(|(n, edge)| edge.share(0.0) - f64::from(u8::from(zone[*n])))
            .sum();
        (whole + partial) * grid.cell_area() * mirror.multiplicity()
            / (std::f64::consts::PI * a * b)
    }

    #[test]
    fn ellipses_keep_their_area() {
        for n in [32, 33, 64, 65, 128] {
            // Within a cell the border is straight: its sagitta is d^2/(8 a).
            let d = 2.4 / n as f64;
            for axes in [(1.0, 1.0), (0.9, 0.5)] {
                // Within seven cells the border bends too much, and whole cells count at some places.
                let part = d / axes.1;
                let allowed = if part > 1.0 / 8.0 {
                    0.25 * part
                } else {
                    part * part
                };
                let error = (area(n, axes, Mirror::None) - 1.0).abs();
                assert!(error < allowed, "{n} {axes:?} {error:e}");
            }
        }
    }

    #[test]
    fn half_the_grid_tells_the_same() {
        let [whole, half] = [Mirror::None, Mirror::Y].map(|m| area(64, (1.0, 0.7), m));
        assert!((whole - half).abs() < 1e-12, "{whole} {half}");
    }

    #[test]
    fn a_line_cuts_a_square() {
        for (f, g, share) in [
            (0.0, [1.0, 0.3], 0.5),
            (0.25, [1.0, 0.0], 0.75),
            (-0.25, [0.0, 1.0], 0.25),
            (2.0, [1.0, 1.0], 1.0),
            (-0.5, [1.0, 1.0], 0.125),
            (-0.5, [-1.0, 1.0], 0.125),
        ] {
            assert!((half_plane(f, g) - share).abs() < 1e-15, "{f} {g:?}");
        }
    }
}
