//! A body under a cycle of a contact: its stress on lines and at points.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_subsurface::{
    Depth, Line, Moments, OverCycle, Point, Points, Section, Side, TwiceAsLarge,
};
use ndarray::{Array3, Axis};

/// Moments whose stresses are computed together: the kernels of a depth cost as much as ten.
const TOGETHER: usize = 32;
/// Largest memory of the stress at a time \[bytes\].
const MOST_MEMORY: f64 = 256e6;

/// Stress over the moments of a cycle \[Pa\], of shape (moments, points, 6).
pub(super) type History = Array3<f64>;

/// A body under a cycle of a contact.
pub struct Site<'a> {
    /// The body.
    pub body: &'a Body,
    /// Which one it is.
    pub side: Side,
    /// Grid of the contact.
    pub grid: &'a Grid,
    /// Residual stress of the layers.
    pub residual: &'a ResidualStress,
    /// The states over the cycle.
    pub cycle: &'a dyn OverCycle,
    /// Once raised, ends the computation with [`Error::Interrupted`].
    pub stop: Arc<AtomicBool>,
}

/// The stress at points under some moments.
pub(super) struct At {
    points: Points,
    moments: usize,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
}

impl Site<'_> {
    /// Hands the histories on a line to `f`, those of a few depths at a time, in order: the number
    /// of the first of them and a history for each.
    pub fn on_line(
        &self,
        line: Line,
        depths: &[Depth],
        mut f: impl FnMut(usize, &[History]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (moments, places) = (self.cycle.count(), line.places(self.grid).len());
        let each = 48.0 * moments as f64 * places as f64;
        let chunk = (MOST_MEMORY / each).max(1.0) as usize;
        let all: Vec<usize> = (0..moments).collect();
        for (n, some) in depths.chunks(chunk).enumerate() {
            let mut histories = vec![Array3::zeros((moments, places, 6)); some.len()];
            for which in all.chunks(TOGETHER) {
                let now = self.cycle.moments(which)?;
                now.with_states(Some(self.residual), &self.stop, |states| {
                    let section = Section::new(self.body, self.side, self.grid, line, states)?;
                    section.pass_stress(some, &mut histories, |history, _, stresses| {
                        for (k, stress) in which.iter().zip(stresses) {
                            history.index_axis_mut(Axis(0), *k).assign(&stress.t());
                        }
                    })
                })?;
            }
            f(n * chunk, &histories)?;
        }
        Ok(())
    }

    /// The stress at points under some moments, for repeated use.
    pub(super) fn under(&self, moments: &Moments) -> Result<At, Error> {
        self.at(self.grid, moments, (0.0, 0.0))
    }

    /// The same of the tractions on cells twice as large.
    pub(super) fn under_coarser(
        &self,
        cells: &TwiceAsLarge,
        moments: &Moments,
    ) -> Result<At, Error> {
        self.at(&cells.grid, &moments.on_coarser(cells), cells.middle)
    }

    fn at(&self, grid: &Grid, moments: &Moments, middle: (f64, f64)) -> Result<At, Error> {
        let points = moments.with_states(Some(self.residual), &self.stop, |states| {
            Points::new(self.body, self.side, grid, states)
        })?;
        Ok(At {
            points,
            moments: moments.tractions.len(),
            middle,
        })
    }

    /// The history of points over the whole cycle.
    pub(super) fn whole(&self, points: &[Point]) -> Result<History, Error> {
        let all: Vec<usize> = (0..self.cycle.count()).collect();
        let mut whole = Array3::zeros((all.len(), points.len(), 6));
        for which in all.chunks(TOGETHER) {
            let now = self.cycle.moments(which)?;
            let part = self.under(&now)?.history(points)?;
            for (k, now) in which.iter().zip(part.outer_iter()) {
                whole.index_axis_mut(Axis(0), *k).assign(&now);
            }
        }
        Ok(whole)
    }
}

impl At {
    /// Whether a point of the surface lies beside an assumed rim.
    pub(super) fn rim_is_unknown(&self, (x, y, depth): Point) -> bool {
        let moved = (x - self.middle.0, y - self.middle.1, depth);
        self.points.rim_is_unknown(moved)
    }

    pub(super) fn history(&self, points: &[Point]) -> Result<History, Error> {
        let moved: Vec<Point> = points
            .iter()
            .map(|(x, y, depth)| (x - self.middle.0, y - self.middle.1, *depth))
            .collect();
        let stress = self.points.stress(&moved)?;
        Ok(Array3::from_shape_fn(
            (self.moments, points.len(), 6),
            |(t, n, c)| stress[t][n][c],
        ))
    }
}
