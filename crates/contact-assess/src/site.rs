//! A body under a cycle of a contact: its stress on lines and at points.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_subsurface::{
    Depth, Line, Moments, OverCycle, Point, Points, Section, Side, TwiceAsLarge,
};
use ndarray::Axis;

use super::history::{History, Strains};

/// Moments whose stresses are computed together: the kernels of a depth cost as much as ten.
const TOGETHER: usize = 32;
/// Largest memory of the stress at a time \[bytes\].
const MOST_MEMORY: f64 = 256e6;

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

/// Stress and strain at points under some moments.
pub(super) struct At {
    points: Points,
    moments: usize,
    strains: Strains,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
}

impl Site<'_> {
    /// Hands the histories on a line to `f`, those of a few depths at a time, in order: the number
    /// of the first of them and a history for each, with the plastic strain if asked for.
    pub(super) fn on_line(
        &self,
        (line, depths): (Line, &[Depth]),
        strain: bool,
        mut f: impl FnMut(usize, &[History]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (moments, along) = (self.cycle.count(), line.places(self.grid));
        let (places, strain) = (along.len(), strain && self.body.yields());
        let each = if strain { 96.0 } else { 48.0 } * moments as f64 * places as f64;
        let chunk = (MOST_MEMORY / each).max(1.0) as usize;
        let all: Vec<usize> = (0..moments).collect();
        for (n, some) in depths.chunks(chunk).enumerate() {
            let mut histories = vec![History::zeros((moments, places), strain); some.len()];
            for which in all.chunks(TOGETHER) {
                let now = self.cycle.moments(which)?;
                let strains = Strains::of(&now, strain);
                now.with_states(Some(self.residual), &self.stop, |states| {
                    let section = Section::new(self.body, self.side, self.grid, line, states)?;
                    section.pass_stress(some, &mut histories, |history, depth, stresses| {
                        for (k, stress) in which.iter().zip(stresses) {
                            let mut now = history.stress.index_axis_mut(Axis(0), *k);
                            now.assign(&stress.t());
                        }
                        let points = along.iter().map(|s| line.point(*s, depth));
                        history.add(which, &strains, &points.collect::<Vec<_>>());
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
            strains: Strains::of(moments, true),
            middle,
        })
    }

    /// The history of points over the whole cycle.
    pub(super) fn whole(&self, points: &[Point]) -> Result<History, Error> {
        let all: Vec<usize> = (0..self.cycle.count()).collect();
        let mut whole = History::zeros((all.len(), points.len()), self.body.yields());
        for which in all.chunks(TOGETHER) {
            let now = self.cycle.moments(which)?;
            whole.take(which, &self.under(&now)?.history(points)?);
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
        let mut found = History::zeros((self.moments, points.len()), self.strains.are_known());
        found
            .stress
            .indexed_iter_mut()
            .for_each(|((t, n, c), s)| *s = stress[t][n][c]);
        let all: Vec<usize> = (0..self.moments).collect();
        found.add(&all, &self.strains, &moved);
        Ok(found)
    }
}
