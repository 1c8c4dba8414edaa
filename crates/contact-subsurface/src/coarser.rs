//! The tractions of a contact on cells twice as large, and what has yielded on points twice as far apart: the
//! change of a value estimates the error of the cells.
//!
//! Cells are paired in two ways, and the larger of both changes is the estimate. Beside a rim a value
//! depends on where the rim lies in its cell, so that one change may vanish by chance.

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Grid};
use stress_tensor::StressTensor;

use super::{Border, Depth, Eigenstress, Line, Point, Points, Side, States, TwiceAsLarge};

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
        let seen = |left: &Option<Eigenstress>| left.as_ref().map(|left| left.on_coarser(cells));
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

    /// A place in the coordinates of the coarser grid; a place beside a border is as far from the
    /// nearest border there.
    fn place(&self, x: f64, y: f64, border: Option<&Border>) -> (f64, f64) {
        let (x, y) = (x - self.middle.0, y - self.middle.1);
        let Some(own) = border else {
            return (x, y);
        };
        let (from_x, from_y) = (own.x - self.middle.0, own.y - self.middle.1);
        let beside = self.points.borders_beside(from_x, from_y);
        let same = self.borders.iter().chain(&beside);
        let same = same.filter(|b| own.zone == b.zone);
        let nearest = same.min_by(|a, b| {
            let away = |b: &Border| (b.x - from_x).hypot(b.y - from_y);
            away(a).total_cmp(&away(b))
        });
        nearest.map_or((x, y), |b| (x + b.x - from_x, y + b.y - from_y))
    }

    /// The stress at a place, as far from a border of a zone as on its own grid \[Pa\].
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
