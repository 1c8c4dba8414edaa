//! Cells that the rim of the contact, or the border of the stick zone, goes through.
//!
//! With the distance d inwards from the rim the pressure grows like d^(1/2 + e), or like d on a layer
//! thinner than the cells; and mu p - q . t, t being the direction of the shear where cells slip, like
//! d^(1/2) from the border of a stick zone that shrinks, like d^(3/2) from that of one that grows. A power
//! of either, the level f, vanishes linearly:
//!
//! ```text
//! f = b_1 d + b_2 d^2 + ...,   f = p^(2/(1 + 2 e)) or (mu p - q . t)^2,   tan(pi e) = beta q_n/p
//! ```
//!
//! with Dundurs' beta and the shear q_n towards the inside on body 2 (a rim that slides on dissimilar
//! bodies; Comninou, J. Appl. Mech. 43 (1976) 631). Of the laws that may hold the one counts whose level is
//! the straightest. Where a stick zone grows, cells stick with the shear that they slipped with, and each
//! increment adds a root of the distance from where the border then is: together the power 3/2 from where
//! it is at the end, if an increment is about as long as a cell. If it is longer whole cells count, with
//! what the zone has grown since the middle of the increment (`balance`).
//!
//! A root is not told by the outermost cells: that one shows a border that is off by up to a tenth of a
//! cell, the second by a thirtieth, those further in by less than a hundredth. So f is continued outwards
//! from these: along that line of cells, out of eight, that meets the border most squarely, by the parabola
//! through the next cells. A higher power is told by all. Where the continued f is zero runs the border, a
//! straight line within a cell.

use ndarray::Array2;

use super::March;
use crate::convolution::Mirror;
use crate::reference::dundurs_beta;
use crate::scene::Grid;
use crate::solvers::{Interface, friction_bound, size};

/// Farthest that the border may lie from the middle between the outermost cell of the zone and its
/// neighbour outside, in cells along the line: beyond, f is no such level (a punch with a sharp edge).
const FARTHEST: f64 = 1.5;
/// How much further out than the true border the level of a root vanishes with constant tractions, in
/// cells: the mean over places and directions of the border within the cells, of Hertz contacts and of
/// their stick zones.
const SPREAD: f64 = 0.012;
/// Most cells of a line that tell the level.
const ALONG: usize = 7;
/// Cells of a zone on a line that tell its border, each as it comes. In a zone of more the error that
/// constant tractions leave, about 1/(20 k) cells k cells from the rim, and the parabola's, about
/// (k/L)^4 of its length L, are least together with every (L/24)^(3/5)-th cell. Worth it where the two
/// ends of a line are all there is; along a closed border such errors have either sign.
const CLOSE: f64 = 24.0;
/// Outermost cells that a root of the distance is told without, and a higher power.
pub(super) const ROOT: usize = 2;
pub(super) const POWER: usize = 0;
/// The laws of a stick zone's border: mu p - q . t grows like d^(1/2) where it shrinks, like d^(3/2)
/// where it grows.
pub(super) const SHRINKS: usize = 0;
pub(super) const GROWS: usize = 1;
/// Largest second difference of the level along a line, and largest change of it from cell to cell,
/// over the first change of the level: beyond, another border lies there (of the stick zone before
/// a reversal).
const FIRST_BEND: f64 = 0.4;
const BEND: f64 = 0.15;

/// Areas, in kept cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Zones {
    pub(super) contact: f64,
    /// The stick zone.
    pub(super) stick: f64,
    /// Part of the border of the stick zone that lies where it was in the middle of the increment, if
    /// the zone grows.
    pub(super) behind: f64,
}

impl March {
    /// Areas of the contact and of the stick zone.
    pub(super) fn zones(&self, now: &Interface) -> Zones {
        let lattice = Lattice::new(&self.window.grid, self.plan.mirror);
        let beta = dundurs_beta(self.scene.body1.outermost(), self.scene.body2.outermost());
        let contact: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
        let stick: Vec<bool> = contact
            .iter()
            .zip(&now.slip)
            .map(|(&c, &s)| c && !s)
            .collect();
        let rim = lattice.edges(&contact, [ROOT, POWER], |line| {
            let at = line.cells[0];
            let q_n = now.q[0][at] * line.inwards[0] + now.q[1][at] * line.inwards[1];
            let e = (beta * q_n / now.p[at]).atan() / std::f64::consts::PI;
            let square = e == 0.0;
            move |n| {
                let p = now.p[n];
                [
                    if square {
                        p * p
                    } else {
                        p.powf(2.0 / (1.0 + 2.0 * e))
                    },
                    p,
                ]
            }
        });
        let area = |zone: &[bool], edges: &[(usize, Edge)]| -> f64 {
            let whole = zone.iter().filter(|&&inside| inside).count() as f64;
            let partial = |(n, edge): &(usize, Edge)| edge.share() - f64::from(u8::from(zone[*n]));
            whole + edges.iter().map(partial).sum::<f64>()
        };
        let contact_area = area(&contact, &rim);
        if !now.slip.contains(&true) {
            return Zones {
                contact: contact_area,
                stick: contact_area,
                behind: 0.0,
            };
        }
        let slipping = |line: &Line| {
            let outside = contact[line.outside];
            let n = if outside { line.outside } else { line.cells[0] };
            let q = [now.q[0][n], now.q[1][n]];
            q.map(|q_k| q_k / size(q).max(f64::MIN_POSITIVE))
        };
        let shortfall = |at: &Interface, n: usize, [x, y]: [f64; 2]| {
            friction_bound(self.mu[n], at.p[n]) - (at.q[0][n] * x + at.q[1][n] * y)
        };
        let mut border = lattice.edges(&stick, [ROOT, POWER], |line| {
            let along = slipping(&line);
            move |n| shortfalls(shortfall(now, n, along))
        });
        // The zone grows where the shear falls further behind its bound; cells that have come to stick
        // in one increment, two deep, know nothing of the others.
        let before = self.before();
        let grows = |line: &Line| {
            let along = slipping(line);
            line.cells().get(1).is_some_and(|&n| {
                let stuck = !before.slip[n] && before.p[n] > 0.0;
                stuck && shortfall(now, n, along) > shortfall(before, n, along)
            })
        };
        for (_, edge) in &mut border {
            let told = |level: &Level| level.law == SHRINKS || grows(&level.line);
            edge.level = edge.level.filter(told);
        }
        for (n, edge) in &mut border {
            if let Ok(at) = rim.binary_search_by_key(n, |(n, _)| *n)
                && edge.share() > rim[at].1.share()
            {
                *edge = rim[at].1;
            }
        }
        let at_end =
            |(_, edge): &&(usize, Edge)| edge.level.is_some_and(|level| level.law == GROWS);
        let at_end = border.iter().filter(at_end).count();
        Zones {
            contact: contact_area,
            stick: area(&stick, &border),
            behind: 1.0 - at_end as f64 / border.len().max(1) as f64,
        }
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
    let rim = lattice.edges(&contact, [ROOT], |_| {
        |n: usize| [continued[n] * continued[n]]
    });
    for (n, edge) in rim {
        if let Some(level) = edge.level {
            continued[n] = level.middle.max(0.0).sqrt();
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

/// A line of cells that leads into a zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// The last cell before the zone.
    pub(super) outside: usize,
    /// The first ones of the zone, outermost first, and how many there are.
    cells: [usize; ALONG],
    count: usize,
    /// Direction into the zone.
    pub(super) inwards: [f64; 2],
}

impl Line {
    /// The first cells of the zone, outermost first.
    fn cells(&self) -> &[usize] {
        &self.cells[..self.count]
    }
}

/// A level continued to a cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    /// The line that tells it, and the law that it follows.
    pub(super) line: Line,
    pub(super) law: usize,
    /// How much further out than the border it vanishes, in the mean over the places of the border
    /// within the cells, in cells.
    spread: f64,
    /// Its value at the cell's centre.
    pub(super) middle: f64,
    /// Its change from cell to cell along x and y.
    pub(super) gradient: [f64; 2],
}

/// A cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The level of the zone; none where the cells do not tell.
    pub(super) level: Option<Level>,
    /// Whether the cell is in the zone.
    inside: bool,
}

impl Edge {
    /// The part of the cell that belongs to the zone, 0 to 1; all or nothing where the cells do not
    /// tell.
    fn share(&self) -> f64 {
        match self.level {
            Some(level) => {
                let slope = level.gradient[0].hypot(level.gradient[1]);
                half_plane(level.middle - level.spread * slope, level.gradient)
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
    /// `levels` of a line of cells gives the levels of a cell on it, by K laws that the tractions may
    /// follow there; the straightest counts, without so many outermost cells as are `skipped` by it.
    pub(super) fn edges<const K: usize, F: Fn(usize) -> [f64; K]>(
        self,
        zone: &[bool],
        skipped: [usize; K],
        levels: impl Fn(Line) -> F,
    ) -> Vec<(usize, Edge)> {
        (0..zone.len())
            .filter(|&n| self.at_border(n, zone))
            .map(|n| {
                let inside = zone[n];
                let level = self.level(n, zone, skipped, &levels);
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

    /// The straightest level at the centre of a cell, continued from inside.
    fn level<const K: usize, F: Fn(usize) -> [f64; K]>(
        self,
        n: usize,
        zone: &[bool],
        skipped: [usize; K],
        levels: &impl Fn(Line) -> F,
    ) -> Option<Level> {
        let in_zone = |m: &usize| zone[*m];
        let inwards = self.inwards(n, zone)?;
        let (i, j) = self.place(n);
        let step = |k: isize| self.kept(i + k * inwards[0], j + k * inwards[1]);
        // Steps from the cell to the outermost one of the zone on the line.
        let first = (-1..=1).find(|&k| step(k).is_some_and(|m| zone[m]))?;
        let d = inwards.map(|k| k as f64);
        let mut line = Line {
            outside: step(first - 1).filter(|m| !in_zone(m))?,
            cells: [0; ALONG],
            count: 0,
            inwards: d.map(|k| k / d[0].hypot(d[1])),
        };
        // As far as it stays in the zone.
        let cells = (first..).map_while(|k| step(k).filter(in_zone));
        let stride = if self.flat {
            (cells.clone().count() as f64 / CLOSE)
                .powf(0.6)
                .round()
                .max(1.0)
        } else {
            1.0
        };
        for m in cells.step_by(stride as usize).take(ALONG) {
            line.cells[line.count] = m;
            line.count += 1;
        }
        let levels = levels(line);
        let mut along = [[0.0; ALONG]; K];
        for (k, &m) in line.cells().iter().enumerate() {
            let here = levels(m);
            (0..K).for_each(|law| along[law][k] = here[law]);
        }
        let count = line.count;
        let bends = along.each_ref().map(|levels| bend(&levels[1..count]));
        let law = (1..K).fold(0, |best, law| {
            let straighter = bends[law] < bends[best] || bends[best].is_nan();
            if straighter { law } else { best }
        });
        let parabola = Parabola::through(&along[law][..count], skipped[law])?;
        // The outermost cell, and this one, on the parabola.
        let outermost = -(skipped[law] as f64);
        let place = 0.5 - stride * parabola.at(outermost) / parabola.slope(outermost);
        let here = outermost - first as f64 / stride;
        let slope = parabola.slope(here) / stride;
        let usable = place.abs() <= FARTHEST && parabola.slope(outermost) > 0.0 && slope > 0.0;
        if !usable {
            return None;
        }
        let third = line.cells().get(2);
        let gradient = third.map_or([0.0; 2], |&m| self.gradient(m, zone, |m| levels(m)[law]));
        let along = gradient[0] * d[0] + gradient[1] * d[1];
        let gradient = if along > 0.0 {
            gradient.map(|g| g * slope / along)
        } else {
            d.map(|d_k| d_k * slope / (d[0] * d[0] + d[1] * d[1]))
        };
        Some(Level {
            line,
            law,
            spread: if skipped[law] == ROOT {
                SPREAD / stride
            } else {
                0.0
            },
            middle: parabola.at(here),
            gradient,
        })
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
        let (i, j) = self.place(n);
        (-reach..=reach)
            .flat_map(move |columns| (-across..=across).map(move |rows| [columns, rows]))
            .map(move |d| (d, self.kept(i + d[0], j + d[1])))
    }

    /// The kept cell that stands for the one so many columns and rows away.
    fn beside(self, n: usize, [columns, rows]: [isize; 2]) -> Option<usize> {
        let (i, j) = self.place(n);
        self.kept(i + columns, j + rows)
    }

    /// Column and row of a kept cell.
    fn place(self, n: usize) -> (isize, isize) {
        (n as isize / self.rows, n as isize % self.rows)
    }

    /// The kept cell that stands for the one in a column and row.
    fn kept(self, i: isize, j: isize) -> Option<usize> {
        // The kept half lies at y > 0.
        let j = if j < 0 && self.mirrored { -1 - j } else { j };
        let on_grid = (0..self.columns).contains(&i) && (0..self.rows).contains(&j);
        on_grid.then(|| (i * self.rows + j) as usize)
    }
}

/// The levels of what the shear falls short of its bound in a stick zone, by the law of its border.
pub(super) fn shortfalls(shortfall: f64) -> [f64; 2] {
    let shortfall = shortfall.max(0.0);
    [shortfall * shortfall, shortfall.cbrt().powi(2)]
}

/// How much a level bends along a line, against its rise.
fn bend(levels: &[f64]) -> f64 {
    let near = &levels[..levels.len().min(4)];
    let bends = near.windows(3).map(|y| (y[2] - 2.0 * y[1] + y[0]).abs());
    bends.sum::<f64>() / (near.last().unwrap_or(&0.0) - near.first().unwrap_or(&0.0)).abs()
}

/// f = c_0 + c_1 s + c_2 s^2 along a line, s in cells from the first one that is not skipped.
#[derive(Clone, Copy)]
struct Parabola([f64; 3]);

impl Parabola {
    /// Given the outermost cell and the next ones: least squares through five that are not skipped,
    /// the parabola through three if there are no more, a straight line through two if these are all.
    fn through(levels: &[f64], skipped: usize) -> Option<Self> {
        // The last one skipped tells whether the next ones can be trusted.
        let before = usize::from(skipped > 0);
        let (checked, used) = (levels.get(skipped - before..)?, levels.get(skipped..)?);
        let &[y_1, y_2, ..] = checked else {
            return None;
        };
        let mut last = None;
        let smooth = checked.windows(3).take_while(|y| {
            let bend = y[2] - 2.0 * y[1] + y[0];
            let (before, most) = match last.replace(bend) {
                Some(before) => (before, BEND),
                None => (0.0, FIRST_BEND),
            };
            (bend - before).abs() <= most * (y_2 - y_1).abs()
        });
        // Cells on the line before a bend that is too sharp.
        let cells = smooth.count() + 2 - before;
        Some(match (cells, used) {
            // About the middle sample, with the orthogonal polynomials 1, s, s^2 - 2.
            (5.., &[a, b, c, d, e, ..]) => {
                let c_2 = (2.0 * (a + e) - (b + d) - 2.0 * c) / 14.0;
                let c_1 = (2.0 * (e - a) + d - b) / 10.0;
                let c_0 = (a + b + c + d + e) / 5.0 - 2.0 * c_2;
                Self([c_0 - 2.0 * c_1 + 4.0 * c_2, c_1 - 4.0 * c_2, c_2])
            }
            (3.., &[a, b, c, ..]) => Self([a, 2.0 * b - 1.5 * a - 0.5 * c, 0.5 * (a + c) - b]),
            (2.., &[a, b, ..]) => Self([a, b - a, 0.0]),
            // With the last one skipped.
            (_, &[a, ..]) => Self([a, y_2 - y_1, 0.0]),
            (_, []) => return None,
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
        let edges = lattice.edges(&zone, [ROOT], |_| |n: usize| [f[n]]);
        let partial: f64 = edges
            .iter()
            .map(|(n, edge)| {
                // Sampled at the centres nothing is spread.
                let level = edge.level.map(|level| Level {
                    spread: 0.0,
                    ..level
                });
                Edge { level, ..*edge }.share() - f64::from(u8::from(zone[*n]))
            })
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
