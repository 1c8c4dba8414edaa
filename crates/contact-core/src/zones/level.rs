//! Levels of a zone of kept cells, continued to its border.
//!
//! A root is not told by the outermost cells: that one shows a border that is off by up to a tenth of a
//! cell, the second by a thirtieth, those further in by less than a hundredth. So f is continued outwards
//! from these: along that line of cells, out of eight, that meets the border most squarely, by the parabola
//! through the next cells, on one that is no parabola by those before its middle. A linear law is told by
//! all, slip by those next to its border. Where the continued f is zero runs the border, a straight line
//! within a cell.

use super::edge::Edge;
use super::parabola::Parabola;
use crate::cells::Lattice;

/// Farthest that the border may lie from the middle between the outermost cell of the zone and its
/// neighbour outside, in cells along the line: beyond, f is no such level (a punch with a sharp edge).
const FARTHEST: f64 = 1.5;
/// Most cells of a line that tell the level.
const ALONG: usize = 7;
/// Cells of a zone on a line that tell its border, each as it comes. In a zone of more the error that
/// constant tractions leave, about 1/(20 k) cells k cells from the rim, and the parabola's, about
/// (k/L)^4 of its length L, are least together with every (L/24)^(3/5)-th cell. Worth it where the two
/// ends of a line are all there is; along a closed border such errors have either sign.
const CLOSE: f64 = 24.0;
/// A level that bends by less of its rise needs no other law.
const STRAIGHT: f64 = 0.1;

/// Which cells tell a level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Told {
    /// Outermost cells that do not.
    skipped: usize,
    /// Most cells of a line, with these.
    most: usize,
    /// Whether, where it is no parabola, only what lies before the middle of a line tells it.
    before_middle: bool,
    /// How much further out than the true border the level vanishes with constant tractions, in cells: the
    /// mean over places and directions of the border within the cells.
    spread: f64,
}

impl Told {
    /// Of a root of the distance; the spread is that of Hertz contacts and of their stick zones, twisted ones too,
    /// on many cells.
    pub(crate) const ROOT: Self = Self {
        skipped: 2,
        most: ALONG,
        before_middle: false,
        spread: 0.010,
    };
    /// Of a linear law, or a root that is only looked for.
    pub(crate) const LINEAR: Self = Self {
        skipped: 0,
        most: ALONG,
        before_middle: false,
        spread: 0.0,
    };
    /// Of slip, which changes over the width of a slip ring: the cells next to its border. The spread is
    /// that of the slip of Hertz contacts that are pushed.
    pub(crate) const SLIP: Self = Self {
        skipped: 0,
        most: 3,
        before_middle: false,
        spread: 0.024,
    };

    /// The same where a level need not go on beyond the middle of a line: what shear falls short of its
    /// bound has a cone in the middle of a contact that is twisted.
    pub(crate) const fn before_the_middle(self) -> Self {
        Self {
            before_middle: true,
            ..self
        }
    }
}

/// The power of a value that makes a level.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Power {
    One,
    Two,
    TwoThirds,
    Other(f64),
}

impl Power {
    /// The level of a value, which is not below zero.
    fn of(self, value: f64) -> f64 {
        let value = value.max(0.0);
        match self {
            Self::One => value,
            Self::Two => value * value,
            Self::TwoThirds => value.cbrt().powi(2),
            Self::Other(power) => value.powf(power),
        }
    }
}

/// A line of cells that leads into a zone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// The last cell before the zone.
    pub(crate) outside: usize,
    /// The first ones of the zone, outermost first, and how many there are.
    cells: [usize; ALONG],
    count: usize,
    /// Direction into the zone.
    pub(crate) inwards: [f64; 2],
}

impl Line {
    /// The first cell of the zone.
    pub(crate) fn outermost(&self) -> usize {
        self.cells[0]
    }

    /// Leaves no more than the first cells to tell the level.
    pub(crate) fn shorten(&mut self, count: usize) {
        self.count = self.count.min(count);
    }

    /// The first cells of the zone, outermost first.
    pub(crate) fn cells(&self) -> &[usize] {
        &self.cells[..self.count]
    }
}

/// A level continued to a cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level {
    /// The line that tells it, and the law that it follows.
    pub(crate) line: Line,
    pub(crate) law: usize,
    /// How much further out than the border it vanishes, in the mean over the places of the border
    /// within the cells, in cells.
    pub(crate) spread: f64,
    /// Its value at the cell's centre.
    pub(crate) middle: f64,
    /// Its change from cell to cell along x and y.
    pub(crate) gradient: [f64; 2],
}

impl Lattice {
    /// Every cell at the border of a zone, in it or next to it, in order.
    ///
    /// `laws` of a line of cells gives K powers and the value of a cell on it: the value to one of
    /// them vanishes linearly at the border, the straightest counts, as its cells tell it.
    pub(crate) fn edges<const K: usize, V: Fn(usize) -> f64>(
        self,
        zone: &[bool],
        told: [Told; K],
        laws: impl Fn(&mut Line) -> ([Power; K], V),
    ) -> Vec<(usize, Edge)> {
        let edge = |n: usize| (n, self.edge(n, zone, told, &laws));
        self.border(zone).into_iter().map(edge).collect()
    }

    /// One of these cells.
    pub(crate) fn edge<const K: usize, V: Fn(usize) -> f64>(
        self,
        n: usize,
        zone: &[bool],
        told: [Told; K],
        laws: &impl Fn(&mut Line) -> ([Power; K], V),
    ) -> Edge {
        Edge {
            level: self.level(n, zone, told, laws),
            inside: zone[n],
        }
    }

    /// The straightest level at the centre of a cell, continued from inside.
    fn level<const K: usize, V: Fn(usize) -> f64>(
        self,
        n: usize,
        zone: &[bool],
        told: [Told; K],
        laws: &impl Fn(&mut Line) -> ([Power; K], V),
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
        // Cells before the middle of the line.
        let half = cells.clone().take(2 * ALONG).count().div_ceil(2);
        for m in cells.step_by(stride as usize).take(ALONG) {
            line.cells[line.count] = m;
            line.count += 1;
        }
        let (powers, value) = laws(&mut line);
        let mut values = [0.0; ALONG];
        for (value_k, &m) in values.iter_mut().zip(line.cells()) {
            *value_k = value(m);
        }
        let levels = |law: usize| values.map(|value| powers[law].of(value));
        let checked = if told[0].before_middle {
            line.count.min(half)
        } else {
            line.count
        };
        let bends = |levels: &[f64; ALONG]| bend(&levels[1..checked]);
        let (mut law, mut along) = (0, levels(0));
        for other in 1..K {
            let straight = bends(&along);
            if straight <= STRAIGHT {
                break;
            }
            let others = levels(other);
            if bends(&others) < straight || straight.is_nan() {
                (law, along) = (other, others);
            }
        }
        let Told {
            mut skipped,
            most,
            before_middle,
            spread,
        } = told[law];
        let mut tell = &along[..line.count.min(most)];
        // The cell whose gradient tells the direction of the border.
        let mut sloping = 2;
        if before_middle && !Parabola::holds(tell, skipped) {
            tell = &tell[..tell.len().min(half)];
            skipped = skipped.min((tell.len() - 1) / 3);
            // That in the middle has none.
            sloping = sloping.min(tell.len().saturating_sub(2));
        }
        let parabola = Parabola::through(tell, skipped)?;
        // The outermost cell, and this one, on the parabola.
        let outermost = -(skipped as f64);
        let place = 0.5 - stride * parabola.at(outermost) / parabola.slope(outermost);
        let here = outermost - first as f64 / stride;
        let slope = parabola.slope(here) / stride;
        let usable = place.abs() <= FARTHEST && parabola.slope(outermost) > 0.0 && slope > 0.0;
        if !usable {
            return None;
        }
        let sloping = line.cells().get(sloping);
        let gradient = sloping.map_or([0.0; 2], |&m| {
            self.gradient(m, zone, |m| powers[law].of(value(m)))
        });
        let along = gradient[0] * d[0] + gradient[1] * d[1];
        let gradient = if along > 0.0 {
            gradient.map(|g| g * slope / along)
        } else {
            d.map(|d_k| d_k * slope / (d[0] * d[0] + d[1] * d[1]))
        };
        Some(Level {
            line,
            law,
            spread: spread / stride,
            middle: parabola.at(here),
            gradient,
        })
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
}

/// How much a level bends along a line, against its rise.
fn bend(levels: &[f64]) -> f64 {
    let near = &levels[..levels.len().min(4)];
    let bends = near.windows(3).map(|y| (y[2] - 2.0 * y[1] + y[0]).abs());
    bends.sum::<f64>() / (near.last().unwrap_or(&0.0) - near.first().unwrap_or(&0.0)).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Mirror;
    use crate::scene::Grid;

    /// Area over that of the true zone for a level sampled at the centres.
    fn area(n: usize, (a, b): (f64, f64), mirror: Mirror) -> f64 {
        let grid = Grid::centred(2.4, n).expect("a grid");
        let f = mirror.fold(&grid.map(|x, y| 1.0 - (x / a).powi(2) - (y / b).powi(2)));
        let zone: Vec<bool> = f.iter().map(|&f| f > 0.0).collect();
        let lattice = Lattice::new(&grid, mirror);
        let whole = zone.iter().filter(|&&inside| inside).count() as f64;
        let edges = lattice.edges(&zone, [Told::ROOT], |_| ([Power::One], |n: usize| f[n]));
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
}
