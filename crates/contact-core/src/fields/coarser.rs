//! The tractions of a contact on cells twice as large: how much a value changes with them tells what the cells leave.

use super::{Border, Depth, Line, Point, Points, Side, States, StressTensor};
use crate::convolution::Tractions;
use crate::error::Error;
use crate::scene::{Body, Grid};

/// A body under the tractions of the first of some states on cells twice as large.
pub(super) struct Coarser {
    points: Points,
    borders: Vec<Border>,
    /// Where the middle of its grid is \[m\].
    middle: (f64, f64),
}

impl Coarser {
    pub(super) fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Option<Line>,
        states: &States<'_>,
    ) -> Result<Self, Error> {
        let across = if grid.ny == 1 { 1 } else { 2 };
        let (nx, ny) = (grid.nx.div_ceil(2), grid.ny.div_ceil(across));
        let coarse = Grid {
            nx,
            ny,
            dx: 2.0 * grid.dx,
            dy: across as f64 * grid.dy,
            ..*grid
        };
        // Cells beyond a grid of an odd number carry nothing.
        let middle = (
            (2 * nx - grid.nx) as f64 * 0.5 * grid.dx,
            (across * ny - grid.ny) as f64 * 0.5 * grid.dy,
        );
        let own = states.tractions.first().copied().unwrap_or_default();
        let cells = |n: usize| {
            let (i, j) = (2 * (n / ny), across * (n % ny));
            let columns = i..(i + 2).min(grid.nx);
            columns.flat_map(move |i| (j..(j + across).min(grid.ny)).map(move |j| i * grid.ny + j))
        };
        let part = 1.0 / (2 * across) as f64;
        let mean = |field: Option<&[f64]>| -> Option<Vec<f64>> {
            let of = |field: &[f64], n: usize| part * cells(n).map(|m| field[m]).sum::<f64>();
            field.map(|field| (0..nx * ny).map(|n| of(field, n)).collect())
        };
        let [p, q_x, q_y] = [own.p, own.q_x, own.q_y].map(mean);
        let tractions = [Tractions {
            p: p.as_deref(),
            q_x: q_x.as_deref(),
            q_y: q_y.as_deref(),
        }];
        let stick = states.stick.and_then(|stick| stick.first());
        let stick: Option<Vec<bool>> = stick.map(|stick| {
            let any = |n: usize| cells(n).any(|m| stick[m]);
            (0..nx * ny).map(any).collect()
        });
        let stick: Vec<&[bool]> = stick.iter().map(Vec::as_slice).collect();
        let line = line.map(|line| match line {
            Line::AlongX(y) => Line::AlongX(y - middle.1),
            Line::AlongY(x) => Line::AlongY(x - middle.0),
        });
        let states = States {
            tractions: &tractions,
            stick: states.stick.map(|_| &stick[..]),
            ..states.clone()
        };
        let points = Points::new(body, side, &coarse, states)?;
        Ok(Self {
            borders: points.borders(0, line),
            points,
            middle,
        })
    }

    /// Where in the coarser grid a place is, on the border nearest to it where it lies on one.
    fn place(&self, x: f64, y: f64, border: Option<&Border>) -> (f64, f64) {
        let (x, y) = (x - self.middle.0, y - self.middle.1);
        let same = self
            .borders
            .iter()
            .filter(|b| border.is_some_and(|own| own.zone == b.zone));
        let nearest = same.min_by(|a, b| {
            let away = |b: &Border| (b.x - x).hypot(b.y - y);
            away(a).total_cmp(&away(b))
        });
        nearest.map_or((x, y), |b| (b.x, b.y))
    }

    /// The stress at a place, on the nearest border of a zone where it lies on one \[Pa\].
    pub(super) fn stress(
        &self,
        (x, y, depth): Point,
        border: Option<&Border>,
    ) -> Result<StressTensor, Error> {
        let (x, y) = self.place(x, y, border);
        Ok(self.points.stress(&[(x, y, depth)])?[0][0])
    }

    /// The displacement at a place \[m\].
    pub(super) fn displacement(&self, x: f64, y: f64, depth: Depth) -> Result<[f64; 3], Error> {
        let (x, y) = self.place(x, y, None);
        Ok(self.points.displacement(&[(x, y, depth)])?[0][0])
    }
}
