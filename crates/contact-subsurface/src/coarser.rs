//! The tractions of a contact on cells twice as large: the change of a value estimates the error of
//! the cells.
//!
//! Cells are paired in two ways, and the larger of both changes is the estimate. Beside a rim a value
//! depends on where the rim lies in its cell, so that one change may vanish by chance.

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Grid};
use stress_tensor::StressTensor;

use super::{Border, Depth, Eigenstress, Line, Point, Points, Side, States};

/// Cells of twice the length along each axis.
pub struct TwiceAsLarge {
    fine: Grid,
    /// Cells by which their grid begins before the finer one.
    before: usize,
    /// Its grid.
    pub grid: Grid,
    /// The middle of their grid \[m\]; beyond a grid of an odd number of cells there are no
    /// tractions.
    pub middle: (f64, f64),
}

impl TwiceAsLarge {
    /// The cells twice as large as those of a grid, paired in both ways: from the first cell on, and
    /// from the second.
    pub fn both(fine: &Grid) -> [Self; 2] {
        [0, 1].map(|before| Self::new(fine, before))
    }

    fn new(fine: &Grid, before: usize) -> Self {
        let across = if fine.ny == 1 { 1 } else { 2 };
        let before_y = before * (across - 1);
        let nx = (fine.nx + before).div_ceil(2);
        let ny = (fine.ny + before_y).div_ceil(across);
        let grid = Grid {
            nx,
            ny,
            dx: 2.0 * fine.dx,
            dy: across as f64 * fine.dy,
            ..*fine
        };
        // Half of the cells beyond the end less half of those before the start.
        let off = |cells: usize, own: usize, before: usize, d: f64| {
            ((cells - own) as f64 - 2.0 * before as f64) * 0.5 * d
        };
        let middle = (
            off(2 * nx, fine.nx, before, fine.dx),
            off(across * ny, fine.ny, before_y, fine.dy),
        );
        Self {
            fine: *fine,
            before,
            grid,
            middle,
        }
    }

    fn across(&self) -> usize {
        if self.fine.ny == 1 { 1 } else { 2 }
    }

    /// The cells of the finer grid that make cell n.
    fn cells(&self, n: usize) -> impl Iterator<Item = usize> {
        let (across, Grid { nx, ny, .. }) = (self.across(), self.fine);
        let of = |n: usize, times: usize, count: usize| {
            let (from, before) = (times * n, self.before * (times - 1));
            from.saturating_sub(before)..(from + times - before).min(count)
        };
        let rows = of(n % self.grid.ny, across, ny);
        of(n / self.grid.ny, 2, nx).flat_map(move |i| rows.clone().map(move |j| i * ny + j))
    }

    /// The mean over each cell.
    pub(crate) fn mean(&self, field: &[f64]) -> Vec<f64> {
        let part = 1.0 / (2 * self.across()) as f64;
        let of = |n: usize| part * self.cells(n).map(|m| field[m]).sum::<f64>();
        (0..self.grid.cells()).map(of).collect()
    }

    /// For each cell whether any part of it is marked.
    pub(crate) fn any(&self, mask: &[bool]) -> Vec<bool> {
        let of = |n: usize| self.cells(n).any(|m| mask[m]);
        (0..self.grid.cells()).map(of).collect()
    }
}

/// A body under the tractions of the first of some states on cells twice as large.
pub(super) struct Coarser {
    points: Points,
    borders: Vec<Border>,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
}

impl Coarser {
    /// On cells paired in both ways.
    pub(super) fn both(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Option<Line>,
        states: &States<'_>,
    ) -> Result<[Self; 2], Error> {
        let [first, second] = TwiceAsLarge::both(grid);
        Ok([
            Self::new(body, side, &first, line, states)?,
            Self::new(body, side, &second, line, states)?,
        ])
    }

    fn new(
        body: &Body,
        side: Side,
        cells: &TwiceAsLarge,
        line: Option<Line>,
        states: &States<'_>,
    ) -> Result<Self, Error> {
        let middle = cells.middle;
        let own = states.tractions.first().copied().unwrap_or_default();
        let mean = |field: Option<&[f64]>| field.map(|field| cells.mean(field));
        let [p, q_x, q_y] = [own.p, own.q_x, own.q_y].map(mean);
        let tractions = [Tractions {
            p: p.as_deref(),
            q_x: q_x.as_deref(),
            q_y: q_y.as_deref(),
        }];
        let stick = states.stick.and_then(|stick| stick.first());
        let stick: Option<Vec<bool>> = stick.map(|stick| cells.any(stick));
        let stick: Vec<&[bool]> = stick.iter().map(Vec::as_slice).collect();
        let line = line.map(|line| line.seen_from(middle).0);
        let eigenstress = states.eigenstress.iter().take(1);
        let seen = |left: &Option<Eigenstress>| left.as_ref().map(|left| left.seen_from(middle));
        let eigenstress: Vec<_> = eigenstress.map(seen).collect();
        let states = States {
            tractions: &tractions,
            stick: states.stick.map(|_| &stick[..]),
            eigenstress: &eigenstress,
            ..states.clone()
        };
        let points = Points::new(body, side, &cells.grid, states)?;
        Ok(Self {
            borders: points.borders(0, line),
            points,
            middle,
        })
    }

    /// A place in the coordinates of the coarser grid; a place on a border is moved to the nearest
    /// border there.
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
