//! A body under a cycle of a contact: its stress on lines and at points.

use std::collections::HashMap;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_subsurface::{
    CycleSource, Depth, DoubledCells, Line, Moments, Point, Points, Section, Side,
};
use ndarray::Axis;

use super::cache::{Cells, StateKey, StressCache, is_running};
use super::history::{History, Strains};

/// Moments whose stresses are computed together: the kernels of a depth cost as much as ten.
const MOMENTS_AT_ONCE: usize = 32;
/// Largest memory of the stress at a time \[bytes\].
const MOST_MEMORY: f64 = 256e6;
/// Memory of prepared points for each cell and moment: loads on cells and as points, and their
/// continuation to the rim \[bytes\].
const BYTES_OF_POINTS: usize = 120;
/// Most points whose stress is kept by prepared points.
const MOST_POINTS: usize = 2000;

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

/// Stress of the loads and strain at points under some moments.
pub(super) struct PreparedPoints {
    points: Points,
    moments: usize,
    strains: Strains,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
    /// Ends a computation of the stress.
    stop: Arc<AtomicBool>,
    /// Memory \[bytes\].
    bytes: usize,
    /// The stress of each moment at points, by the bits of x, y, z and the layer.
    computed: Mutex<HashMap<PointKey, Vec<[f64; 6]>>>,
}

/// A point by the bits of its numbers.
type PointKey = ([u64; 3], usize);

fn key_of(&(x, y, depth): &Point) -> PointKey {
    ([x, y, depth.z].map(f64::to_bits), depth.layer)
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

    /// The histories of the loads at depths below a line, with the plastic strain if `strain`.
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
            let now = self.moments(which)?;
            let strains = Strains::from_moments(&now, strain);
            now.with_states(Some(&ResidualStress::default()), &self.stop, |states| {
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

    /// Some moments of the cycle.
    pub(super) fn moments(&self, which: &[usize]) -> Result<Arc<Moments>, Error> {
        self.cache.moments(which, || self.cycle.moments(which))
    }

    /// Prepares the stress of the loads at points under some moments, by the tractions on `cells`.
    pub(super) fn prepare(
        &self,
        which: &[usize],
        cells: Cells,
    ) -> Result<Arc<PreparedPoints>, Error> {
        let key: StateKey = (which.to_vec(), cells);
        self.cache.points(&key, || {
            let moments = self.moments(which)?;
            match cells {
                Cells::Grid => self.prepare_on(self.grid, &moments, (0.0, 0.0)),
                Cells::Doubled(pairing) => {
                    let cells = &DoubledCells::new_pair(self.grid)[pairing];
                    self.prepare_on(&cells.grid, &moments.coarsened(cells), cells.middle)
                }
            }
        })
    }

    fn prepare_on(
        &self,
        grid: &Grid,
        moments: &Moments,
        middle: (f64, f64),
    ) -> Result<PreparedPoints, Error> {
        let none = ResidualStress::default();
        let points = moments.with_states(Some(&none), &self.stop, |states| {
            Points::new(self.body, self.side, grid, states)
        })?;
        let count = moments.tractions.len();
        Ok(PreparedPoints {
            points,
            moments: count,
            strains: Strains::from_moments(moments, true),
            middle,
            stop: self.stop.clone(),
            bytes: BYTES_OF_POINTS * count * grid.cells(),
            computed: Mutex::default(),
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

    /// The history of points over the whole cycle.
    pub(super) fn full_history(&self, points: &[Point]) -> Result<History, Error> {
        let all_moments: Vec<usize> = (0..self.cycle.count()).collect();
        let mut whole = History::zeros((all_moments.len(), points.len()), self.body.yields());
        for which in all_moments.chunks(MOMENTS_AT_ONCE) {
            let prepared = self.prepare(which, Cells::Grid)?;
            whole.copy_moments(which, &self.history(&prepared, points)?);
        }
        Ok(whole)
    }
}

impl PreparedPoints {
    /// Whether no interruption has ended their computation.
    pub(super) fn is_usable(&self) -> bool {
        is_running(&self.stop)
    }

    /// Their memory \[bytes\].
    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Number of moments.
    pub(super) fn moments(&self) -> usize {
        self.moments
    }

    /// Checks that a point of the surface lies beside an assumed rim.
    pub(super) fn rim_is_unknown(&self, (x, y, depth): Point) -> bool {
        let moved = (x - self.middle.0, y - self.middle.1, depth);
        self.points.rim_is_unknown(moved)
    }

    /// The history of the loads at points.
    fn history(&self, points: &[Point]) -> Result<History, Error> {
        let moved: Vec<Point> = points
            .iter()
            .map(|(x, y, depth)| (x - self.middle.0, y - self.middle.1, *depth))
            .collect();
        let stress = self.stress(&moved)?;
        let mut history = History::zeros((self.moments, points.len()), self.strains.is_present());
        history
            .stress
            .indexed_iter_mut()
            .for_each(|((t, n, c), s)| *s = stress[n][t][c]);
        let all_moments: Vec<usize> = (0..self.moments).collect();
        history.add_strains(&all_moments, &self.strains, &moved);
        Ok(history)
    }

    /// The stress of the loads at points in each moment; what was computed before is kept.
    fn stress(&self, points: &[Point]) -> Result<Vec<Vec<[f64; 6]>>, Error> {
        let lock = || self.computed.lock().unwrap_or_else(PoisonError::into_inner);
        let mut stress: Vec<Option<Vec<[f64; 6]>>> = {
            let computed = lock();
            let before = points.iter().map(|point| computed.get(&key_of(point)));
            before.map(Option::<&_>::cloned).collect()
        };
        let missing: Vec<usize> = (0..points.len()).filter(|n| stress[*n].is_none()).collect();
        if !missing.is_empty() {
            let new_points: Vec<Point> = missing.iter().map(|n| points[*n]).collect();
            let by_moment = self.points.stress(&new_points)?;
            let mut computed = lock();
            if computed.len() + missing.len() > MOST_POINTS {
                computed.clear();
            }
            for (k, n) in missing.into_iter().enumerate() {
                let of_point: Vec<_> = by_moment.iter().map(|moment| moment[k]).collect();
                computed.insert(key_of(&points[n]), of_point.clone());
                stress[n] = Some(of_point);
            }
        }
        Ok(stress.into_iter().map(Option::unwrap_or_default).collect())
    }
}
