//! The mean over a critical distance along a line: its largest value, and its error by the cells and by
//! the increments of the path.

use contact_core::Error;
use contact_subsurface::{Line, Moments, OverCycle, TwiceAsLarge, Yielding};
use fatigue::PointResult;

use super::average::{Distance, average};
use super::by_criterion::ByCriterion;
use super::site::Site;
use super::worst::OF_COARSE;

/// The largest mean over a critical distance along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestMean {
    /// The judgement at the place of the largest sample.
    pub found: PointResult,
    /// The largest value, between samples.
    pub value: f64,
    /// Its place on the line \[m\].
    pub place: f64,
}

/// The largest mean along a line; `None` if the region of the mean fits nowhere on the grid.
pub fn largest_mean(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    of: &ByCriterion,
) -> Result<Option<LargestMean>, Error> {
    let means = average(site, line, distance, of)?;
    Ok(largest(&means, &line.places(site.grid)))
}

/// The error of the largest mean along a line: the change of that value on cells twice as large, of the
/// larger of two pairings, and the error of the path. NaN if the region fits nowhere on the larger cells.
pub fn error_of_largest_mean(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    of: &ByCriterion,
    value: f64,
) -> Result<f64, Error> {
    let mut change = 0.0;
    for (means, places) in on_coarser(site, line, distance, of)? {
        let coarse = largest(&means, &places).map_or(f64::NAN, |mean| mean.value);
        change = larger(change, (value - coarse).abs());
    }
    Ok(OF_COARSE * change + of_path(site, value))
}

/// The errors of the `means` along a line, as [`error_of_largest_mean`] at each of its places, between
/// which the means on larger cells are linear; NaN where there is no mean on one of them.
pub fn errors_of_means(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    of: &ByCriterion,
    means: &[Option<PointResult>],
) -> Result<Vec<f64>, Error> {
    let along = line.places(site.grid);
    let mut changes = vec![0.0; along.len()];
    for (coarse, places) in on_coarser(site, line, distance, of)? {
        for ((change, mean), place) in changes.iter_mut().zip(means).zip(&along) {
            let value = mean.map_or(f64::NAN, |mean| mean.value);
            let off = value - between(&coarse, &places, *place).unwrap_or(f64::NAN);
            *change = larger(*change, off.abs());
        }
    }
    let values = means
        .iter()
        .map(|mean| mean.map_or(f64::NAN, |mean| mean.value));
    let error = |(change, value): (f64, f64)| OF_COARSE * change + of_path(site, value);
    Ok(changes.into_iter().zip(values).map(error).collect())
}

/// The larger of two; NaN if one is.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

/// The error of a value by the increments of the path; 0 where they were given.
fn of_path(site: &Site<'_>, value: f64) -> f64 {
    site.cycle.path_error().unwrap_or(0.0) * value.abs()
}

/// Means and their places on the line \[m\].
type Means = (Vec<Option<PointResult>>, Vec<f64>);

/// The means on cells twice as large, paired in both ways.
fn on_coarser(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    of: &ByCriterion,
) -> Result<Vec<Means>, Error> {
    let pairings = TwiceAsLarge::both(site.grid);
    let means = |cells: &TwiceAsLarge| {
        let coarser = Site {
            grid: &cells.grid,
            cycle: &OnCoarser {
                cycle: site.cycle,
                cells,
            },
            stop: site.stop.clone(),
            ..*site
        };
        let (there, more) = line.seen_from(cells.middle);
        let places = there.places(&cells.grid).iter().map(|s| s + more).collect();
        Ok((average(&coarser, there, distance, of)?, places))
    };
    pairings.iter().map(means).collect()
}

/// A cycle on cells twice as large.
struct OnCoarser<'a> {
    cycle: &'a dyn OverCycle,
    cells: &'a TwiceAsLarge,
}

impl OverCycle for OnCoarser<'_> {
    fn count(&self) -> usize {
        self.cycle.count()
    }

    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        Ok(self.cycle.moments(which)?.on_coarser(self.cells))
    }

    fn start(&self) -> Result<Option<Moments>, Error> {
        Ok(self
            .cycle
            .start()?
            .map(|start| start.on_coarser(self.cells)))
    }

    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        self.cycle.yielding()
    }
}

/// The value between two samples; `None` beyond the samples or beside one without a value.
fn between(means: &[Option<PointResult>], places: &[f64], at: f64) -> Option<f64> {
    let n = places
        .partition_point(|place| *place < at)
        .clamp(1, places.len().checked_sub(1)?);
    let [low, high] = [n - 1, n].map(|n| means[n].map(|mean| mean.value));
    let part = (at - places[n - 1]) / (places[n] - places[n - 1]);
    (0.0..=1.0).contains(&part).then_some(())?;
    Some((1.0 - part) * low? + part * high?)
}

/// The largest of some means, at the vertex of the parabola through it and the two beside it.
fn largest(means: &[Option<PointResult>], along: &[f64]) -> Option<LargestMean> {
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
        found,
        value,
        place,
    })
}

/// The vertex of the parabola through three samples of which the middle one is the largest: its
/// height above that one, and its place in steps from it.
fn vertex([left, middle, right]: [f64; 3]) -> (f64, f64) {
    let (slope, bend) = (0.5 * (right - left), left - 2.0 * middle + right);
    if bend < 0.0 {
        (-0.5 * slope * slope / bend, -slope / bend)
    } else {
        (0.0, 0.0)
    }
}
