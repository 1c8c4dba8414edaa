//! Stress and displacement on coarser cells: the change of a value estimates the error of the
//! cells.
//!
//! The tractions of a contact are averaged over cells twice as large, and the plastic strain over
//! points twice as far apart. Cells are paired in two ways, and the larger of the two changes is
//! the estimate. Beside a rim a value depends on where the rim lies in its cell, so that one change
//! may vanish by chance.

use std::sync::Arc;

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Grid};
use stress_tensor::StressTensor;

use super::{Border, Depth, DoubledCells, Eigenstress, Line, Point, Points, Side, States};

/// A body under the tractions of the first of some states on cells twice as large.
pub(super) struct CoarserCells {
    points: Arc<Points>,
    borders: Vec<Border>,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
}

impl CoarserCells {
    /// Averages the first state onto cells twice as large, for both ways to pair the cells.
    pub(super) fn new_pair(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Option<Line>,
        states: &States<'_>,
    ) -> Result<[Self; 2], Error> {
        let [first, second] = DoubledCells::new_pair(grid);
        Ok([
            Self::new(body, side, &first, line, states)?,
            Self::new(body, side, &second, line, states)?,
        ])
    }

    /// Averages the first state of a run onto cells twice as large, for one way to pair them, and finds its
    /// borders. Places are then counted from the middle of these cells.
    fn new(
        body: &Body,
        side: Side,
        cells: &DoubledCells,
        line: Option<Line>,
        states: &States<'_>,
    ) -> Result<Self, Error> {
        let middle = cells.middle;
        let first_tractions = states.tractions.first().copied().unwrap_or_default();
        let mean = |field: Option<&[f64]>| field.map(|field| cells.mean(field));
        let [p, q_x, q_y] = [first_tractions.p, first_tractions.q_x, first_tractions.q_y].map(mean);
        let tractions = [Tractions {
            p: p.as_deref(),
            q_x: q_x.as_deref(),
            q_y: q_y.as_deref(),
        }];
        let stick = states.stick.and_then(|stick| stick.first());
        let stick: Option<Vec<bool>> = stick.map(|stick| cells.any(stick));
        let stick: Vec<&[bool]> = stick.iter().map(Vec::as_slice).collect();
        let line = line.map(|line| line.with_origin(middle).0);
        let eigenstress = states.eigenstress.iter().take(1);
        let coarsen = |left: &Option<Eigenstress>| left.as_ref().map(|left| left.coarsened(cells));
        let eigenstress: Vec<_> = eigenstress.map(coarsen).collect();
        let states = States {
            tractions: &tractions,
            stick: states.stick.map(|_| &stick[..]),
            eigenstress: &eigenstress,
            continuations: &[],
            ..states.clone()
        };
        let points = Arc::new(Points::new(body, side, &cells.grid, states)?);
        Ok(Self {
            borders: points.borders(0, line),
            points,
            middle,
        })
    }

    /// Keeps only the borders on a line of the fine grid.
    pub(super) fn on_line(&self, line: Line) -> Self {
        let line = line.with_origin(self.middle).0;
        Self {
            borders: self.points.borders(0, Some(line)),
            points: self.points.clone(),
            middle: self.middle,
        }
    }

    /// Converts a place x, y \[m\] of the fine grid to the coarse one, whose origin is `middle`. A place beside a
    /// `border` of the fine grid keeps its distance from the nearest border of the same zone on the coarse grid.
    fn convert_place(&self, x: f64, y: f64, border: Option<&Border>) -> (f64, f64) {
        let (x, y) = (x - self.middle.0, y - self.middle.1);
        let Some(fine_border) = border else {
            return (x, y);
        };
        let (from_x, from_y) = (fine_border.x - self.middle.0, fine_border.y - self.middle.1);
        let beside = self.points.borders_near(from_x, from_y);
        let same = self.borders.iter().chain(&beside);
        let same = same.filter(|b| fine_border.zone == b.zone);
        let nearest = same.min_by(|a, b| {
            let distance = |b: &Border| (b.x - from_x).hypot(b.y - from_y);
            distance(a).total_cmp(&distance(b))
        });
        nearest.map_or((x, y), |b| (x + b.x - from_x, y + b.y - from_y))
    }

    /// The stress at a place, at the same distance from a border of a zone as on the fine grid
    /// \[Pa\].
    pub(super) fn stress(
        &self,
        (x, y, depth): Point,
        border: Option<&Border>,
    ) -> Result<StressTensor, Error> {
        let (x, y) = self.convert_place(x, y, border);
        Ok(self.points.stress(&[(x, y, depth)])?[0][0])
    }

    /// The displacement at a place \[m\].
    pub(super) fn displacement(&self, x: f64, y: f64, depth: Depth) -> Result<[f64; 3], Error> {
        let (x, y) = self.convert_place(x, y, None);
        Ok(self.points.displacement(&[(x, y, depth)])?[0][0])
    }
}
