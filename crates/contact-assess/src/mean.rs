//! The mean over a critical distance along a line: its largest value, and its error by the cells and by
//! the increments of the path.

use std::sync::Arc;

use contact_core::Error;
use contact_subsurface::{CycleSource, DoubledCells, Line, Moments, Yielding};
use fatigue::PointResult;

use super::average::{Distance, judge_means};
use super::by_criterion::CriterionJudge;
use super::site::Site;
use super::worst::COARSE_FACTOR;

/// The largest mean over a critical distance along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestMean {
    /// The judgement at the place of the largest sample.
    pub result: PointResult,
    /// The largest value, between samples.
    pub value: f64,
    /// Its place on the line \[m\].
    pub place: f64,
}

/// The largest value of the criterion on the stress averaged over the critical distance, along a line. `None`
/// if the averaged region fits nowhere on the grid.
pub fn largest_mean(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    judge: &CriterionJudge,
) -> Result<Option<LargestMean>, Error> {
    let means = judge_means(site, line, distance, judge)?;
    Ok(largest_at_vertex(&means, &line.places(site.grid)))
}

/// The error of the largest mean `value` along a line: the larger change on cells twice as large, paired in
/// both ways, and the error of the path. NaN if the region fits nowhere on the larger cells.
pub fn error_of_largest_mean(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    judge: &CriterionJudge,
    value: f64,
) -> Result<f64, Error> {
    let mut change = 0.0;
    for (means, places) in means_on_coarser(site, line, distance, judge)? {
        let coarse = largest_at_vertex(&means, &places).map_or(f64::NAN, |mean| mean.value);
        change = larger_or_nan(change, (value - coarse).abs());
    }
    Ok(COARSE_FACTOR * change + path_error_of(site, value))
}

/// Error of the mean at each place of the line: the larger change on cells twice as large, paired in both ways,
/// and the error of the path. NaN where the larger cells have no mean.
pub fn errors_of_means(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    judge: &CriterionJudge,
    means: &[Option<PointResult>],
) -> Result<Vec<f64>, Error> {
    let along = line.places(site.grid);
    let mut changes = vec![0.0; along.len()];
    for (coarse, places) in means_on_coarser(site, line, distance, judge)? {
        for ((change, mean), place) in changes.iter_mut().zip(means).zip(&along) {
            let value = mean.map_or(f64::NAN, |mean| mean.value);
            let off = value - interpolate(&coarse, &places, *place).unwrap_or(f64::NAN);
            *change = larger_or_nan(*change, off.abs());
        }
    }
    let values = means
        .iter()
        .map(|mean| mean.map_or(f64::NAN, |mean| mean.value));
    let error = |(change, value): (f64, f64)| COARSE_FACTOR * change + path_error_of(site, value);
    Ok(changes.into_iter().zip(values).map(error).collect())
}

/// The larger of two numbers; NaN if one of them is.
fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

/// The error of a value by the increments of the path; 0 if the increments were given.
fn path_error_of(site: &Site<'_>, value: f64) -> f64 {
    site.cycle.path_error().unwrap_or(0.0) * value.abs()
}

/// Means and their places on the line \[m\].
type Means = (Vec<Option<PointResult>>, Vec<f64>);

/// The means along the line on cells twice as large, for both ways to pair the cells.
fn means_on_coarser(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    judge: &CriterionJudge,
) -> Result<Vec<Means>, Error> {
    let pairings = DoubledCells::new_pair(site.grid);
    let means = |cells: &DoubledCells| {
        let coarser = Site {
            grid: &cells.grid,
            cycle: &CoarserCycle {
                cycle: site.cycle,
                cells,
            },
            stop: site.stop.clone(),
            cache: Arc::default(),
            ..*site
        };
        let (coarser_line, shift) = line.with_origin(cells.middle);
        let places = coarser_line
            .places(&cells.grid)
            .iter()
            .map(|s| s + shift)
            .collect();
        Ok((
            judge_means(&coarser, coarser_line, distance, judge)?,
            places,
        ))
    };
    pairings.iter().map(means).collect()
}

/// A cycle on cells twice as large.
struct CoarserCycle<'a> {
    cycle: &'a dyn CycleSource,
    cells: &'a DoubledCells,
}

impl CycleSource for CoarserCycle<'_> {
    /// Number of moments of the fine cycle.
    fn count(&self) -> usize {
        self.cycle.count()
    }

    /// Moments of the fine cycle, averaged onto the larger cells.
    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        Ok(self.cycle.moments(which)?.coarsened(self.cells))
    }

    /// The moment before the cycle, averaged onto the larger cells.
    fn start(&self) -> Result<Option<Moments>, Error> {
        Ok(self.cycle.start()?.map(|start| start.coarsened(self.cells)))
    }

    /// None: growth of plastic strain is judged on the fine cells.
    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        self.cycle.yielding()
    }
}

/// The value of the criterion at the place `at`, linear between the means at `places`; `None` beyond them or
/// beside a place without a mean.
fn interpolate(means: &[Option<PointResult>], places: &[f64], at: f64) -> Option<f64> {
    let n = places
        .partition_point(|place| *place < at)
        .clamp(1, places.len().checked_sub(1)?);
    let [low, high] = [n - 1, n].map(|n| means[n].map(|mean| mean.value));
    let part = (at - places[n - 1]) / (places[n] - places[n - 1]);
    (0.0..=1.0).contains(&part).then_some(())?;
    Some((1.0 - part) * low? + part * high?)
}

/// The largest mean along a line: the vertex of the parabola through the largest sample and the two beside it.
fn largest_at_vertex(means: &[Option<PointResult>], along: &[f64]) -> Option<LargestMean> {
    let value = |n: usize| means[n].map(|found| found.value);
    let judged = (0..means.len()).filter(|n| value(*n).is_some_and(|value| !value.is_nan()));
    let n = judged.max_by(|a, b| {
        value(*a)
            .partial_cmp(&value(*b))
            .unwrap_or(std::cmp::Ordering::Equal)
    })?;
    let (found, place) = (means[n]?, along[n]);
    let beside = (n > 0 && n + 1 < means.len())
        .then(|| value(n - 1).zip(value(n + 1)))
        .flatten();
    let (value, place) = match beside {
        Some((left, right)) => {
            let (rise, by) = vertex([left, found.value, right]);
            (found.value + rise, place + by * (along[n + 1] - place))
        }
        None => (found.value, place),
    };
    Some(LargestMean {
        result: found,
        value,
        place,
    })
}

/// Vertex of the parabola through three samples, the middle one being the largest: its height above
/// that sample, and its distance from it in steps.
fn vertex([left, middle, right]: [f64; 3]) -> (f64, f64) {
    let (slope, bend) = (0.5 * (right - left), left - 2.0 * middle + right);
    if bend < 0.0 {
        (-0.5 * slope * slope / bend, -slope / bend)
    } else {
        (0.0, 0.0)
    }
}
