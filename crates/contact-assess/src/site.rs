//! A body under a cycle of a contact: its stress on lines and at points.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_subsurface::{
    CycleSource, Depth, DoubledCells, Line, Moments, Point, Points, Section, Side,
};
use ndarray::Axis;

use super::history::{History, Strains};

/// Moments whose stresses are computed together: the kernels of a depth cost as much as ten.
const MOMENTS_AT_ONCE: usize = 32;
/// Largest memory of the stress at a time \[bytes\].
const MOST_MEMORY: f64 = 256e6;

/// A body under a cycle of a contact.
pub struct Site<'a> {
    /// The body.
    pub body: &'a Body,
    /// The body, upper or lower.
    pub side: Side,
    /// Grid of the contact.
    pub grid: &'a Grid,
    /// Residual stress of the layers.
    pub residual: &'a ResidualStress,
    /// The states over the cycle.
    pub cycle: &'a dyn CycleSource,
    /// Once raised, ends the computation with [`Error::Interrupted`].
    pub stop: Arc<AtomicBool>,
}

/// Stress and strain at points under some moments.
pub(super) struct PreparedPoints {
    points: Points,
    moments: usize,
    strains: Strains,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
}

impl Site<'_> {
    /// Calls `f` with the histories on a line, a few depths at a time, in order. Its arguments are
    /// the number of the first depth and a history for each, with the plastic strain if `strain`.
    pub(super) fn for_each_depth(
        &self,
        (line, depths): (Line, &[Depth]),
        strain: bool,
        mut f: impl FnMut(usize, &[History]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (moments, along) = (self.cycle.count(), line.places(self.grid));
        let (places, strain) = (along.len(), strain && self.body.yields());
        let bytes_per_depth = if strain { 96.0 } else { 48.0 } * moments as f64 * places as f64;
        let chunk = (MOST_MEMORY / bytes_per_depth).max(1.0) as usize;
        let all_moments: Vec<usize> = (0..moments).collect();
        for (n, some) in depths.chunks(chunk).enumerate() {
            let mut histories = vec![History::zeros((moments, places), strain); some.len()];
            for which in all_moments.chunks(MOMENTS_AT_ONCE) {
                let now = self.cycle.moments(which)?;
                let strains = Strains::from_moments(&now, strain);
                now.with_states(Some(self.residual), &self.stop, |states| {
                    let section = Section::new(self.body, self.side, self.grid, line, states)?;
                    section.pass_stress(some, &mut histories, |history, depth, stresses| {
                        for (k, stress) in which.iter().zip(stresses) {
                            let mut now = history.stress.index_axis_mut(Axis(0), *k);
                            now.assign(&stress.t());
                        }
                        let points = along.iter().map(|s| line.point(*s, depth));
                        history.add_strains(which, &strains, &points.collect::<Vec<_>>());
                    })
                })?;
            }
            f(n * chunk, &histories)?;
        }
        Ok(())
    }

    /// Prepares the stress at points under some moments, for repeated use.
    pub(super) fn prepare(&self, moments: &Moments) -> Result<PreparedPoints, Error> {
        self.prepare_on(self.grid, moments, (0.0, 0.0))
    }

    /// Prepares the stress by the tractions on cells twice as large.
    pub(super) fn prepare_coarser(
        &self,
        cells: &DoubledCells,
        moments: &Moments,
    ) -> Result<PreparedPoints, Error> {
        self.prepare_on(&cells.grid, &moments.coarsened(cells), cells.middle)
    }

    fn prepare_on(
        &self,
        grid: &Grid,
        moments: &Moments,
        middle: (f64, f64),
    ) -> Result<PreparedPoints, Error> {
        let points = moments.with_states(Some(self.residual), &self.stop, |states| {
            Points::new(self.body, self.side, grid, states)
        })?;
        Ok(PreparedPoints {
            points,
            moments: moments.tractions.len(),
            strains: Strains::from_moments(moments, true),
            middle,
        })
    }

    /// The history of points over the whole cycle.
    pub(super) fn full_history(&self, points: &[Point]) -> Result<History, Error> {
        let all_moments: Vec<usize> = (0..self.cycle.count()).collect();
        let mut whole = History::zeros((all_moments.len(), points.len()), self.body.yields());
        for which in all_moments.chunks(MOMENTS_AT_ONCE) {
            let now = self.cycle.moments(which)?;
            whole.copy_moments(which, &self.prepare(&now)?.history(points)?);
        }
        Ok(whole)
    }
}

impl PreparedPoints {
    /// Checks that a point of the surface lies beside an assumed rim.
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
        let mut history = History::zeros((self.moments, points.len()), self.strains.is_present());
        history
            .stress
            .indexed_iter_mut()
            .for_each(|((t, n, c), s)| *s = stress[t][n][c]);
        let all_moments: Vec<usize> = (0..self.moments).collect();
        history.add_strains(&all_moments, &self.strains, &moved);
        Ok(history)
    }
}
