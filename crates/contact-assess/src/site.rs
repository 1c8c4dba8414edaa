//! A body under a cycle of a contact: its stress on lines and at points.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_core::stop::unless;
use contact_subsurface::{
    Border, Continuation, CycleSource, Depth, DoubledCells, Line, Moments, Point, Points, Section,
    Side, States,
};
use ndarray::Axis;
use rayon::prelude::*;

use super::cache::{Cells, StateKey, StressCache};
use super::history::{History, Strains};
use super::prepared_points::PreparedPoints;

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
    /// Stress of this body and cycle that questions share.
    pub cache: Arc<StressCache>,
}

impl Site<'_> {
    /// Calls `f` with the histories on a line, a few depths at a time, in order. Its arguments are
    /// the number of the first depth and a history for each, with the plastic strain if `strain`.
    pub(super) fn for_each_depth(
        &self,
        (line, depths): (Line, &[Depth]),
        strain: bool,
        mut f: impl FnMut(usize, &[Arc<History>]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (moments, along) = (self.cycle.count(), line.places(self.grid));
        let (places, strain) = (along.len(), strain && self.body.yields());
        let bytes_per_depth = if strain { 96.0 } else { 48.0 } * moments as f64 * places as f64;
        let chunk = (MOST_MEMORY / bytes_per_depth).max(1.0) as usize;
        for (n, some) in depths.chunks(chunk).enumerate() {
            let kept = some
                .iter()
                .map(|depth| self.cache.history(&(line, *depth, strain)));
            let mut histories: Vec<Option<Arc<History>>> = kept.collect();
            let missing: Vec<usize> = (0..some.len())
                .filter(|k| histories[*k].is_none())
                .collect();
            let missing_depths: Vec<Depth> = missing.iter().map(|k| some[*k]).collect();
            let computed = self.histories_of_loads((line, &along), &missing_depths, strain)?;
            for (k, history) in missing.into_iter().zip(computed) {
                let history = Arc::new(history);
                self.cache.keep_history((line, some[k], strain), &history);
                histories[k] = Some(history);
            }
            let with_residual = |(history, depth): (Option<Arc<History>>, &Depth)| {
                self.with_residual(history.unwrap_or_default(), |_| *depth)
            };
            let histories: Vec<_> = histories.into_iter().zip(some).map(with_residual).collect();
            f(n * chunk, &histories)?;
        }
        Ok(())
    }

    /// The histories of the stress by the loads, without residual stress, on a line at some depths; with the
    /// plastic strain if `strain`.
    fn histories_of_loads(
        &self,
        (line, along): (Line, &[f64]),
        depths: &[Depth],
        strain: bool,
    ) -> Result<Vec<History>, Error> {
        let moments = self.cycle.count();
        let mut histories = vec![History::zeros((moments, along.len()), strain); depths.len()];
        if depths.is_empty() {
            return Ok(histories);
        }
        let all_moments: Vec<usize> = (0..moments).collect();
        for which in all_moments.chunks(MOMENTS_AT_ONCE) {
            let now = self.moments(which, Cells::Grid)?;
            let strains = Strains::from_moments(&now, strain);
            let continuations = &self.continuations(line, which, Cells::Grid)?;
            now.with_states(Some(&ResidualStress::default()), &self.stop, |states| {
                let states = States {
                    continuations,
                    ..states
                };
                let section = Section::new(self.body, self.side, self.grid, line, states)?;
                section.pass_stress(depths, &mut histories, |history, depth, stresses| {
                    for (k, stress) in which.iter().zip(stresses) {
                        let mut now = history.stress.index_axis_mut(Axis(0), *k);
                        now.assign(&stress.t());
                    }
                    let points = along.iter().map(|s| line.point(*s, depth));
                    history.add_strains(which, &strains, &points.collect::<Vec<_>>());
                })
            })?;
        }
        Ok(histories)
    }

    /// Adds the residual stress of the layers to a history of the loads at points of these depths.
    fn with_residual(
        &self,
        mut history: Arc<History>,
        depth: impl Fn(usize) -> Depth,
    ) -> Arc<History> {
        let points = history.stress.len_of(Axis(1));
        for n in 0..points {
            let Depth { z, layer } = depth(n);
            let [xx, yy] = self.residual.stress_at(layer, z);
            if xx != 0.0 || yy != 0.0 {
                let history = Arc::make_mut(&mut history);
                for mut stress in history.stress.index_axis_mut(Axis(1), n).outer_iter_mut() {
                    stress[0] += xx;
                    stress[1] += yy;
                }
            }
        }
        history
    }

    /// Some moments of the cycle, with the tractions on `cells`.
    pub(super) fn moments(&self, which: &[usize], cells: Cells) -> Result<Arc<Moments>, Error> {
        self.cache.moments((which, cells), || match cells {
            Cells::Grid => self.cycle.moments(which),
            Cells::Doubled(pairing) => {
                let moments = self.moments(which, Cells::Grid)?;
                Ok(moments.coarsened(&DoubledCells::new_pair(self.grid)[pairing]))
            }
        })
    }

    /// The grid of `cells`, and its middle \[m\].
    fn grid_of(&self, cells: Cells) -> (Grid, (f64, f64)) {
        match cells {
            Cells::Grid => (*self.grid, (0.0, 0.0)),
            Cells::Doubled(pairing) => {
                let cells = &DoubledCells::new_pair(self.grid)[pairing];
                (cells.grid, cells.middle)
            }
        }
    }

    /// The tractions of some moments within their `cells` below a line, each computed once.
    fn continuations(
        &self,
        line: Line,
        which: &[usize],
        cells: Cells,
    ) -> Result<Vec<Continuation>, Error> {
        let mut continued: Vec<Option<Continuation>> = which
            .iter()
            .map(|n| self.cache.continuation(&(line, *n, cells)))
            .collect();
        let missing: Vec<usize> = (0..which.len())
            .filter(|k| continued[*k].is_none())
            .collect();
        if !missing.is_empty() {
            let moments = self.moments(which, cells)?;
            let (grid, middle) = self.grid_of(cells);
            let line_on_grid = line.with_origin(middle).0;
            let compute = |k: &usize| {
                unless(&self.stop)?;
                let [q_x, q_y, p] = moments.tractions[*k]
                    .each_ref()
                    .map(|field| field.as_slice());
                let stick = moments.stick.get(*k).and_then(|stick| stick.as_slice());
                let tractions = Tractions { q_x, q_y, p };
                Continuation::new(line_on_grid, (self.body, &grid), &tractions, stick)
            };
            let computed: Vec<_> = missing
                .par_iter()
                .map(compute)
                .collect::<Result<_, Error>>()?;
            for (k, made) in missing.into_iter().zip(computed) {
                self.cache.keep_continuation((line, which[k], cells), &made);
                continued[k] = Some(made);
            }
        }
        Ok(continued.into_iter().flatten().collect())
    }

    /// The borders of contact and stick zone below a line at some moments, by the tractions on `cells`. Those of
    /// every moment stand in a list of their own.
    pub(super) fn borders(
        &self,
        line: Line,
        which: &[usize],
        cells: Cells,
    ) -> Result<Vec<Vec<Border>>, Error> {
        let (x_0, y_0) = self.grid_of(cells).1;
        let line_on_grid = line.with_origin((x_0, y_0)).0;
        let moved = |border: Border| Border {
            x: border.x + x_0,
            y: border.y + y_0,
            ..border
        };
        let continued = self.continuations(line, which, cells)?;
        let of_moment = |continued: &Continuation| {
            let borders = continued.borders(line_on_grid);
            borders.into_iter().map(moved).collect()
        };
        Ok(continued.iter().map(of_moment).collect())
    }

    /// Prepares the stress of the loads at points below a line under some moments, by the tractions on `cells`.
    pub(super) fn prepare(
        &self,
        line: Line,
        which: &[usize],
        cells: Cells,
    ) -> Result<Arc<PreparedPoints>, Error> {
        let key: StateKey = (line, which.to_vec(), cells);
        self.cache.points(&key, || {
            let moments = self.moments(which, cells)?;
            let continuations = &self.continuations(line, which, cells)?;
            let (grid, middle) = self.grid_of(cells);
            let none = ResidualStress::default();
            let points = moments.with_states(Some(&none), &self.stop, |states| {
                let states = States {
                    continuations,
                    ..states
                };
                let line = line.with_origin(middle).0;
                Points::new_below(line, (self.body, self.side), &grid, states)
            })?;
            let stop = self.stop.clone();
            Ok(PreparedPoints::new(points, &moments, middle, stop))
        })
    }

    /// The history of prepared points, with the residual stress of the layers.
    pub(super) fn history(
        &self,
        prepared: &PreparedPoints,
        points: &[Point],
    ) -> Result<History, Error> {
        let history = Arc::new(prepared.history(points)?);
        let history = self.with_residual(history, |n| points[n].2);
        Ok(Arc::unwrap_or_clone(history))
    }

    /// The history of points below a line over the whole cycle.
    pub(super) fn full_history(&self, line: Line, points: &[Point]) -> Result<History, Error> {
        let all_moments: Vec<usize> = (0..self.cycle.count()).collect();
        let mut whole = History::zeros((all_moments.len(), points.len()), self.body.yields());
        for which in all_moments.chunks(MOMENTS_AT_ONCE) {
            let prepared = self.prepare(line, which, Cells::Grid)?;
            whole.copy_moments(which, &self.history(&prepared, points)?);
        }
        Ok(whole)
    }
}
