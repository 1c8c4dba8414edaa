//! Tractions of a contact between the middles of its cells, out to its rim and to the stick zone.
//!
//! Constant tractions cannot follow the root with which pressure and shear vanish at the rim, nor that
//! with which the shear falls short of its bound inside a stick zone that shrinks. The squares can
//! be interpolated: p^2, and with it q/p; near the stick zone (m p - |q|)^2, m being |q|/p where
//! cells slip. Between the middles of the cells they are taken bilinear, at the borders as
//! `level` continues them from inside. Where these do not tell the border (a punch with a
//! sharp edge, a contact of few cells) the tractions stay as they are.

use ndarray::{Array2, Axis, Zip};
use std::ops::Range;

use super::edge::Edge;
use super::level::{Power, Told};
use super::partial_cells::{SHRINKS, STICK};
use crate::cells::Lattice;
use crate::convolution::Tractions;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Columns or rows of stick cells over which m is carried on from the slip cells beside them.
const CARRIED: usize = 10;

/// Most that the level of a cell may be off what is continued from inside, in its change over a cell:
/// beyond, that is no level (a rough contact, a layer as thin as the cells).
const OFF: f64 = 0.12;

/// Told cells around one outside that does not tell itself, which make up for it.
const ENOUGH: usize = 4;

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
    goes_on: Array2<GoesOn>,
    /// Distance of the cells from those beside a border that the tractions are continued to, in
    /// cells along or across, up to 255.
    distance: Array2<u8>,
}

/// What of the tractions is not constant in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum GoesOn {
    Nothing,
    Pressure,
    /// With the shear in its ratio to it.
    Both,
    /// The shear by what it falls short of its bound.
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
        let rim = Border::of_contact(grid, &p);
        let zone = stick.and_then(|stick| StickZone::new(grid, &p, &q, stick));
        let mut goes_on = Array2::from_shape_fn(shape, |cell| {
            let presses = around(cell, shape).any(|at| rim.level[at] > 0.0);
            let in_zone = zone.as_ref().is_some_and(|zone| zone.reaches(cell));
            match (presses, in_zone) {
                (true, true) => GoesOn::Shortfall,
                (true, false) => GoesOn::Both,
                _ => GoesOn::Nothing,
            }
        });
        let sticks = |n: usize| stick.is_some_and(|stick| stick[n]);
        for &cell in &rim.told {
            // Not to be had from the slip: the shear that sticks at the rim.
            if sticks(cell.0 * grid.ny + cell.1) && q.iter().any(|q| q[cell] != 0.0) {
                around(cell, shape).for_each(|at| goes_on[at] = GoesOn::Pressure);
            }
        }
        for cell in &rim.untold {
            around(*cell, shape).for_each(|at| goes_on[at] = GoesOn::Nothing);
        }
        let zone_told = zone.iter().flat_map(|zone| &zone.border.told);
        let distance = distances(shape, rim.told.iter().chain(zone_told));
        Self {
            start: (window.0.start, window.1.start),
            ratios: [0, 1].map(|c| cut(&ratio(&q[c], &p), window)),
            constant: [&q[0], &q[1], &p].map(|field| cut(field, window)),
            level: cut(&rim.level, window),
            bound: zone.map(|zone| [&zone.m, &zone.border.level].map(|field| cut(field, window))),
            goes_on: cut(&goes_on, window),
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

    /// Adds up what the tractions q_x, q_y, p are more than constant at places in a cell \[Pa\]: each
    /// place by its offset from the middle in cells, with what is to be done with it.
    pub(crate) fn each_excess<T>(
        &self,
        cell: (usize, usize),
        places: &[((f64, f64), T)],
        mut f: impl FnMut([f64; 3], &T),
    ) {
        let Some(cell) = self.place(cell) else { return };
        let goes_on = self.goes_on[cell];
        if goes_on == GoesOn::Nothing {
            return;
        }
        let constant = [0, 1, 2].map(|c| self.constant[c][cell]);
        let level = Around::new(&self.level, cell);
        let ratios = [0, 1].map(|c| Around::new(&self.ratios[c], cell));
        let bound = self.bound.as_ref().filter(|_| goes_on == GoesOn::Shortfall);
        let bound = bound.map(|fields| [0, 1].map(|c| Around::new(&fields[c], cell)));
        for (offset, of) in places {
            let p = level.at(*offset).max(0.0).sqrt();
            if goes_on == GoesOn::Pressure {
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

/// A level that is above zero in a zone and below on the other side of its border.
struct Border {
    level: Array2<f64>,
    /// Cells at the border whose level is known, and the others.
    told: Vec<(usize, usize)>,
    untold: Vec<(usize, usize)>,
}

impl Border {
    /// p^2 \[Pa^2\].
    fn of_contact(grid: &Grid, p: &Array2<f64>) -> Self {
        let contact: Vec<bool> = p.iter().map(|&p| p > 0.0).collect();
        let level = p.mapv(|p| p.max(0.0).powi(2));
        let edges = Lattice::new(grid, Mirror::None).edges(&contact, [Told::ROOT], |_| {
            ([Power::Two], |n: usize| p[(n / grid.ny, n % grid.ny)])
        });
        Self::new(&level, &edges)
    }

    /// With the levels of the cells at the border that these tell.
    fn new(own: &Array2<f64>, edges: &[(usize, Edge)]) -> Self {
        let shape = own.dim();
        let place = |n: usize| (n / shape.1, n % shape.1);
        let find =
            |(i, j): (usize, usize)| edges.binary_search_by_key(&(i * shape.1 + j), |(n, _)| *n);
        // A zone's own level is not below zero, and outside of it there is none.
        let agrees = |cell: (usize, usize), (level, slope): Plane| {
            let off = (level.max(0.0) - own[cell]).abs();
            off <= OFF * slope[0].hypot(slope[1])
        };
        let planes: Vec<Option<Plane>> = edges
            .iter()
            .map(|(n, edge)| {
                edge.level
                    .map(|level| (level.middle, level.gradient))
                    .filter(|plane| agrees(place(*n), *plane))
            })
            .collect();
        // From the planes of those cells around one of which this is true.
        let from_around = |cell: (usize, usize), of: &dyn Fn((usize, usize), Plane) -> bool| {
            let levels: Vec<f64> = around(cell, shape)
                .filter_map(|at| {
                    let (level, slope) = planes[find(at).ok()?].filter(|plane| of(at, *plane))?;
                    let offset = [cell.0 as f64 - at.0 as f64, cell.1 as f64 - at.1 as f64];
                    let there = level + slope[0] * offset[0] + slope[1] * offset[1];
                    agrees(cell, (there, slope)).then_some(there)
                })
                .collect();
            (
                levels.iter().sum::<f64>() / levels.len().max(1) as f64,
                levels.len(),
            )
        };
        let mut level = own.clone();
        let (mut told, mut untold) = (Vec::new(), Vec::new());
        for ((n, _), plane) in edges.iter().zip(&planes) {
            let cell = place(*n);
            let (continued, count) = from_around(cell, &|_, _| true);
            match plane {
                Some((continued, _)) => level[cell] = *continued,
                None if own[cell] <= 0.0 && count >= ENOUGH => level[cell] = continued,
                None => {
                    untold.push(cell);
                    continue;
                }
            }
            told.push(cell);
        }
        // Cells of the zone with their middle outside: those next to them are off like outermost
        // ones.
        let thin = |at: (usize, usize), plane: Plane| own[at] > 0.0 && plane.0 < 0.0;
        let thin_cells = edges.iter().zip(&planes).filter_map(|((n, _), plane)| {
            plane
                .filter(|plane| thin(place(*n), *plane))
                .map(|_| place(*n))
        });
        for cell in thin_cells.flat_map(|cell| around(cell, shape)) {
            if own[cell] > 0.0 && find(cell).is_err() {
                let (continued, count) = from_around(cell, &thin);
                if count > 0 {
                    level[cell] = continued;
                }
            }
        }
        Self {
            level,
            told,
            untold,
        }
    }
}

/// A level in the middle of a cell, and its change from cell to cell along x and y.
type Plane = (f64, [f64; 2]);

/// What bounds the shear, and how far it falls short of that.
struct StickZone {
    /// |q|/p where cells slip, and carried on into the zone; not a number further in.
    m: Array2<f64>,
    /// (m p - |q|)^2 \[Pa^2\].
    border: Border,
    /// Cells next to the border.
    near: Array2<bool>,
}

impl StickZone {
    /// None where all cells stick or all slip.
    fn new(grid: &Grid, p: &Array2<f64>, q: &[Array2<f64>; 2], stick: &[bool]) -> Option<Self> {
        let shape = p.dim();
        let sticks = |(i, j): (usize, usize)| stick[i * grid.ny + j];
        let q = Zip::from(&q[0]).and(&q[1]).map_collect(|x, y| x.hypot(*y));
        let slipping = Array2::from_shape_fn(shape, |cell| {
            (p[cell] > 0.0 && !sticks(cell)).then(|| q[cell] / p[cell])
        });
        if !stick.contains(&true) || slipping.iter().all(Option::is_none) {
            return None;
        }
        let m = carried(&slipping);
        let short = |cell: (usize, usize)| (m[cell] * p[cell] - q[cell]).max(0.0);
        let level = Array2::from_shape_fn(shape, |cell| {
            if sticks(cell) {
                short(cell).powi(2)
            } else {
                0.0
            }
        });
        // Where the zone grows the shear goes like the power 3/2: that needs nothing.
        let mut edges =
            Lattice::new(grid, Mirror::None).edges(stick, [Told::ROOT, Told::LINEAR], |_| {
                (STICK, |n: usize| short((n / grid.ny, n % grid.ny)))
            });
        edges.retain(|(n, _)| p[(n / grid.ny, n % grid.ny)] > 0.0);
        for (_, edge) in &mut edges {
            edge.level = edge.level.filter(|level| level.law == SHRINKS);
        }
        let border = Border::new(&level, &edges);
        let mut near = Array2::from_elem(shape, false);
        for cell in border.told.iter().flat_map(|cell| around(*cell, shape)) {
            near[cell] = true;
        }
        for cell in border.untold.iter().flat_map(|cell| around(*cell, shape)) {
            near[cell] = false;
        }
        Some(Self { m, border, near })
    }

    /// Whether the shear in a cell is to be had from the bound.
    fn reaches(&self, cell: (usize, usize)) -> bool {
        self.near[cell] && around(cell, self.m.dim()).all(|at| self.m[at].is_finite())
    }
}

/// The part of a field in a window of columns and rows.
fn cut<T: Clone>(field: &Array2<T>, (columns, rows): &(Range<usize>, Range<usize>)) -> Array2<T> {
    let columns = field.slice_axis(Axis(0), columns.clone().into());
    columns.slice_axis(Axis(1), rows.clone().into()).to_owned()
}

/// A field in a cell and its neighbours.
struct Around([[f64; 3]; 3]);

impl Around {
    fn new(field: &Array2<f64>, (i, j): (usize, usize)) -> Self {
        let (nx, ny) = field.dim();
        let near = |n: usize, count: usize| [n.saturating_sub(1), n, (n + 1).min(count - 1)];
        Self(near(i, nx).map(|i| near(j, ny).map(|j| field[(i, j)])))
    }

    /// Bilinear between the middles, at an offset of at most half a cell.
    fn at(&self, (s, t): (f64, f64)) -> f64 {
        let Self(field) = self;
        let (next, above) = (usize::from(s > 0.0) * 2, usize::from(t > 0.0) * 2);
        let (s, t) = (s.abs(), t.abs());
        let along = |column: [f64; 3]| column[1] + t * (column[above] - column[1]);
        let (here, there) = (along(field[1]), along(field[next]));
        here + s * (there - here)
    }
}

/// q/p, in cells beside the contact the mean of their neighbours' within.
fn ratio(q: &Array2<f64>, p: &Array2<f64>) -> Array2<f64> {
    let within = Zip::from(q)
        .and(p)
        .map_collect(|q, p| (*p > 0.0).then(|| q / p));
    filled(&within).mapv(|ratio| ratio.unwrap_or(0.0))
}

/// A quantity that some cells have, carried on to the next ones; not a number beyond.
fn carried(known: &Array2<Option<f64>>) -> Array2<f64> {
    let mut all = known.mapv(|v| v.unwrap_or(f64::NAN));
    let lacks = |all: &Array2<f64>, cell| all[cell].is_nan();
    let shape = all.dim();
    let at_border = |&(cell, v): &(_, &Option<f64>)| {
        v.is_some() && around(cell, shape).any(|at| lacks(&all, at))
    };
    let mut front: Vec<_> = known
        .indexed_iter()
        .filter(at_border)
        .map(|(cell, _)| cell)
        .collect();
    for _ in 0..CARRIED {
        let mut next: Vec<_> = front
            .iter()
            .flat_map(|cell| around(*cell, shape))
            .filter(|cell| lacks(&all, *cell))
            .collect();
        next.sort_unstable();
        next.dedup();
        let mean = |cell: &(usize, usize)| {
            let there = || {
                around(*cell, shape)
                    .map(|at| all[at])
                    .filter(|v| !v.is_nan())
            };
            there().sum::<f64>() / there().count() as f64
        };
        let means: Vec<f64> = next.iter().map(mean).collect();
        for (cell, mean) in next.iter().zip(means) {
            all[*cell] = mean;
        }
        front = next;
    }
    all
}

/// Cells that lack a quantity get the mean of their neighbours that have it.
fn filled(known: &Array2<Option<f64>>) -> Array2<Option<f64>> {
    Array2::from_shape_fn(known.dim(), |cell| {
        known[cell].or_else(|| {
            let there = || around(cell, known.dim()).filter_map(|at| known[at]);
            let count = there().count();
            (count > 0).then(|| there().sum::<f64>() / count as f64)
        })
    })
}

/// Distances from some cells, by two sweeps.
fn distances<'a>(
    shape: (usize, usize),
    from: impl Iterator<Item = &'a (usize, usize)>,
) -> Array2<u8> {
    let mut distance = Array2::from_elem(shape, u8::MAX);
    for cell in from {
        distance[*cell] = 0;
    }
    let mut sweep = |n: usize| {
        let cell = (n / shape.1, n % shape.1);
        let nearest = around(cell, shape).map(|at| distance[at]).min();
        distance[cell] = distance[cell].min(nearest.unwrap_or(u8::MAX).saturating_add(1));
    };
    (0..shape.0 * shape.1).for_each(&mut sweep);
    (0..shape.0 * shape.1).rev().for_each(&mut sweep);
    distance
}

/// A cell and its neighbours.
fn around(
    (i, j): (usize, usize),
    (nx, ny): (usize, usize),
) -> impl Iterator<Item = (usize, usize)> {
    let rows = j.saturating_sub(1)..(j + 2).min(ny);
    (i.saturating_sub(1)..(i + 2).min(nx)).flat_map(move |i| rows.clone().map(move |j| (i, j)))
}
