//! The ascent to the worst point of a layer. It judges points beside a place along the line and in
//! depth, with smaller and smaller steps.

use std::sync::Arc;

use contact_core::Error;
use contact_subsurface::{Border, Depth, DoubledCells, Line, Point, Zone};

use super::cache::Cells;
use super::history::History;
use super::judged::{Judge, Judged};
use super::prepared_points::PreparedPoints;
use super::site::Site;

/// Most hills and most places on borders that are judged before the ascent.
const HILLS: usize = 3;
const BORDERS: usize = 6;
/// Factor of a step with gain beyond the samples, where the stress is smooth: a place far away is
/// reached in a few rounds.
const FARTHER: f64 = 2.0;
/// Divisor of a step without gain; steps below SHORTEST times the first end the ascent.
const CLOSER: f64 = 3.0;
const SHORTEST: f64 = 0.01;
/// Most rounds of the ascent.
const MOST_ROUNDS: usize = 16;
/// Least relative gain of a step.
const GAIN: f64 = 1e-6;
/// How far beyond the samples the ascent may go, over their length.
const BEYOND: f64 = 0.5;
/// Distance beyond the samples over their length at which only the bulk stress is left. There the
/// net force of a line contact adds 1/FAR of its mean pressure.
const FAR: f64 = 1e3;
/// A point is on a border if it is at most this many cells from it.
const ON_BORDER: f64 = 0.1;
/// Borders on cells twice as large are beside a border within this many cells.
const BESIDE: f64 = 4.0;
/// Contact cells times moments up to which every point of the ascent is judged by the whole
/// history.
const CHEAP: usize = 100_000;
/// Moments that represent a longer history during the ascent.
const REPRESENTATIVES: usize = 32;
/// Moments whose borders are used as starting points.
const BORDER_MOMENTS: usize = 16;

/// A point of a section: place on the line and depth \[m\].
pub(super) type Place = [f64; 2];

/// The search in a layer of a section.
pub(super) struct Climb<'a, J> {
    pub(super) site: &'a Site<'a>,
    pub(super) judge: &'a J,
    pub(super) layer: usize,
    pub(super) line: Line,
}

impl<J: Judge> Climb<'_, J> {
    /// Places and scores of the worst samples: the largest over the line at each depth, where it is largest
    /// over depth, too; at most [`HILLS`], the worst first.
    pub(super) fn hills(&self, judged: &Judged<J::Judgement>) -> Vec<(Place, f64)> {
        let tops: Vec<(Place, f64)> = judged
            .depths
            .iter()
            .zip(&judged.judgements)
            .filter(|(depth, _)| depth.layer == self.layer)
            .filter_map(|(depth, found)| {
                let scores = found.as_ref()?.iter().map(|f| self.judge.score(f));
                let numbers = scores.enumerate().filter(|(_, score)| !score.is_nan());
                let (n, score) = numbers.max_by(|a, b| a.1.total_cmp(&b.1))?;
                Some(([judged.along[n], depth.z], score))
            })
            .collect();
        let is_top = |n: &usize| {
            let beside = [n.checked_sub(1), Some(n + 1)];
            let mut beside = beside.into_iter().flatten().filter_map(|m| tops.get(m));
            beside.all(|other| other.1 <= tops[*n].1)
        };
        let mut hills: Vec<_> = (0..tops.len()).filter(is_top).map(|n| tops[n]).collect();
        hills.sort_by(|a, b| b.1.total_cmp(&a.1));
        hills.truncate(HILLS);
        hills
    }

    /// The judgement of the sample nearest to a place.
    pub(super) fn judgement_of_sample(
        &self,
        judged: &Judged<J::Judgement>,
        [s, z]: Place,
    ) -> Option<J::Judgement> {
        let is_depth = |d: &Depth| d.z == z && d.layer == self.layer;
        let row = judged.depths.iter().position(is_depth)?;
        let n = judged.along.iter().position(|along| *along == s)?;
        judged.judgements[row].as_ref().map(|found| found[n])
    }

    /// Crossings of the line with the rims and stick borders of moments of the cycle, each once.
    pub(super) fn borders(&self) -> Result<Arc<Vec<Border>>, Error> {
        let count = self.site.cycle.count();
        let step = count.div_ceil(BORDER_MOMENTS).max(1);
        let which: Vec<usize> = (0..count).rev().step_by(step).collect();
        let key = (self.line, which.clone(), Cells::Grid);
        self.site.cache.borders(key, || self.find_borders(&which))
    }

    /// Finds the crossings of the line with the borders of some moments. Crossings closer together than half of
    /// [`ON_BORDER`] cells count once.
    fn find_borders(&self, which: &[usize]) -> Result<Vec<Border>, Error> {
        let of_moments = self.site.borders(self.line, which, Cells::Grid)?;
        let mut borders: Vec<Border> = Vec::new();
        for border in of_moments.into_iter().flatten() {
            let distance =
                |b: &Border| (self.distance_along(b) - self.distance_along(&border)).abs();
            if !borders
                .iter()
                .any(|b| distance(b) < ON_BORDER / 2.0 * self.cell())
            {
                borders.push(border);
            }
        }
        Ok(borders)
    }

    /// Places on the surface at the borders beside which the samples are worst.
    pub(super) fn worst_borders(
        &self,
        borders: &[Border],
        judged: &Judged<J::Judgement>,
    ) -> Vec<Place> {
        let is_surface = |d: &Depth| d.z <= 0.0 && d.layer == 0;
        let surface = judged.depths.iter().position(is_surface);
        let Some(surface_judgements) = surface.and_then(|n| judged.judgements[n].as_ref()) else {
            return Vec::new();
        };
        let nearest_sample = |s: f64| {
            let distance_to = |n: &usize| (judged.along[*n] - s).abs();
            let nearest =
                (0..judged.along.len()).min_by(|a, b| distance_to(a).total_cmp(&distance_to(b)));
            nearest.map_or(f64::NAN, |n| self.judge.score(&surface_judgements[n]))
        };
        let scored = borders.iter().map(|b| {
            (
                self.distance_along(b),
                nearest_sample(self.distance_along(b)),
            )
        });
        let mut by_score: Vec<_> = scored.filter(|(_, score)| !score.is_nan()).collect();
        by_score.sort_by(|a, b| b.1.total_cmp(&a.1));
        by_score
            .iter()
            .take(BORDERS)
            .map(|(s, _)| [*s, 0.0])
            .collect()
    }

    /// Numbers of the moments of the cycle that are followed. Of a long cycle these are the ones whose stresses
    /// at a place differ most.
    pub(super) fn representative_moments(&self, place: Place) -> Result<Vec<usize>, Error> {
        let count = self.site.cycle.count();
        let all_moments: Vec<usize> = (0..count).collect();
        let last = self.site.moments(&[count - 1], Cells::Grid)?;
        let touching = last.tractions[0][2].iter().filter(|p| **p > 0.0).count();
        if touching * count <= CHEAP || count <= REPRESENTATIVES {
            return Ok(all_moments);
        }
        let history = self.site.full_history(self.line, &[self.point(place)])?;
        let difference = |a: usize, b: usize| -> f64 {
            (0..6)
                .map(|c| (history.stress[(a, 0, c)] - history.stress[(b, 0, c)]).powi(2))
                .sum()
        };
        let mut chosen = vec![0];
        let mut nearest: Vec<f64> = all_moments.iter().map(|n| difference(*n, 0)).collect();
        while chosen.len() < REPRESENTATIVES {
            let farthest = (0..count).max_by(|a, b| nearest[*a].total_cmp(&nearest[*b]));
            let Some(next) = farthest.filter(|n| nearest[*n] > 0.0) else {
                break;
            };
            chosen.push(next);
            for n in 0..count {
                nearest[n] = nearest[n].min(difference(n, next));
            }
        }
        Ok(chosen)
    }

    /// Ascends from a place with a score, in first steps `first` along the line and in depth, between two
    /// depths. Returns the top, and how far the score falls at the last steps in both directions.
    pub(super) fn ascend(
        &self,
        points: &PreparedPoints,
        (mut place, mut score): (Place, f64),
        first: [f64; 2],
        [top, deepest]: [f64; 2],
    ) -> Result<(Place, [f64; 2]), Error> {
        // The representative moments may score less than the whole history of the sample.
        score = self
            .scores(points, &[place])?
            .first()
            .copied()
            .unwrap_or(score);
        let (samples, ends) = (self.ends_beyond(0.0), self.ends_beyond(BEYOND));
        let (mut steps, mut drops) = (first, [0.0; 2]);
        for _ in 0..MOST_ROUNDS {
            let mut beside: Vec<(usize, Place)> = Vec::new();
            for axis in 0..2 {
                for by in [-steps[axis], steps[axis]] {
                    let mut candidate = place;
                    let (low, high) = if axis == 0 {
                        (ends[0], ends[1])
                    } else {
                        (top, deepest)
                    };
                    candidate[axis] = (candidate[axis] + by).clamp(low, high);
                    if candidate != place {
                        beside.push((axis, candidate));
                    }
                }
            }
            let places: Vec<Place> = beside.iter().map(|(_, place)| *place).collect();
            let scores = self.scores(points, &places)?;
            let mut best = (place, score, None);
            for ((axis, place), beside) in beside.iter().zip(&scores) {
                if *beside > best.1 {
                    best = (*place, *beside, Some(*axis));
                }
            }
            for axis in 0..2 {
                let of_axis = beside.iter().zip(&scores).filter(|((a, _), _)| *a == axis);
                let nearest = of_axis.map(|(_, s)| *s).fold(f64::NEG_INFINITY, f64::max);
                if nearest.is_finite() {
                    drops[axis] = (best.1 - nearest).abs();
                }
                let outside = best.0[0] <= samples[0] || best.0[0] >= samples[1];
                steps[axis] *= match best.2 {
                    Some(of) if of == axis && outside => FARTHER,
                    Some(of) if of == axis => 1.0,
                    _ => 1.0 / CLOSER,
                };
            }
            let gained = best.1 - score > GAIN * score.abs();
            (place, score) = (best.0, best.1);
            let short = (0..2).all(|axis| steps[axis] <= SHORTEST * first[axis]);
            if short || (!gained && scores.is_empty()) {
                break;
            }
        }
        Ok((place, drops))
    }

    /// The distances s at the length `beyond` before the first sample and after the last; the stress is known
    /// there as well.
    fn ends_beyond(&self, beyond: f64) -> [f64; 2] {
        let reach = self.line.places(self.site.grid);
        let (first, last) = (reach[0], reach[reach.len() - 1]);
        [
            first - beyond * (last - first),
            last + beyond * (last - first),
        ]
    }

    /// Places half way to the ends of the ascent and at them, at some depths.
    pub(super) fn places_beyond(&self, depths: [f64; 2]) -> Vec<Place> {
        let of_ends = [0.5 * BEYOND, BEYOND].map(|beyond| self.ends_beyond(beyond));
        let places = of_ends.into_iter().flatten();
        let mut far: Vec<Place> = places.flat_map(|s| depths.map(|z| [s, z])).collect();
        far.dedup();
        far
    }

    /// Increase of the score from a place at the end of the ascent to a place with the bulk stress
    /// alone.
    pub(super) fn gain_far_away(
        &self,
        prepared: &PreparedPoints,
        [s, z]: Place,
        score: f64,
    ) -> Result<f64, Error> {
        let near = ON_BORDER * self.cell();
        let [first, last] = self.ends_beyond(BEYOND);
        if s > first + near && s < last - near {
            return Ok(0.0);
        }
        let far = self.ends_beyond(FAR).map(|s| [s, z]);
        let scores = self.scores(prepared, &far)?.into_iter();
        Ok(scores.map(|far| far - score).fold(0.0, f64::max))
    }

    /// Scores of the judgements at some places.
    pub(super) fn scores(
        &self,
        prepared: &PreparedPoints,
        places: &[Place],
    ) -> Result<Vec<f64>, Error> {
        if places.is_empty() {
            return Ok(Vec::new());
        }
        let points: Vec<Point> = places.iter().map(|place| self.point(*place)).collect();
        let judgements = self.judge_points(&points, &self.site.history(prepared, &points)?)?;
        Ok(judgements.iter().map(|f| self.judge.score(f)).collect())
    }

    /// Judges the histories of points in the layer.
    pub(super) fn judge_points(
        &self,
        points: &[Point],
        history: &History,
    ) -> Result<Vec<J::Judgement>, Error> {
        let z: Vec<f64> = points.iter().map(|(_, _, depth)| depth.z).collect();
        self.judge
            .judge(self.layer, &z, &history.view(), &self.site.stop)
    }

    /// The largest change of a score by tractions on cells twice as large, for both ways to pair cells; none
    /// where these have no value. A place on a `border` is the worst of the borders of all moments, so it is
    /// compared with the worst of the borders beside it on the larger cells.
    pub(super) fn coarser_change(
        &self,
        ([s, z], score): (Place, f64),
        border: Option<&Border>,
        which: &[usize],
    ) -> Result<Option<f64>, Error> {
        let mut change: Option<f64> = None;
        for (pairing, cells) in DoubledCells::new_pair(self.site.grid).iter().enumerate() {
            if cells.grid.nx < 4 {
                return Ok(None);
            }
            let there = match border {
                None => vec![s],
                Some(border) => self.coarser_borders(border, which, pairing)?,
            };
            let at = self
                .site
                .prepare(self.line, which, Cells::Doubled(pairing))?;
            let places: Vec<Place> = there.into_iter().map(|s| [s, z]).collect();
            let scores = self.scores(&at, &places)?.into_iter();
            let coarse = scores.fold(f64::NEG_INFINITY, f64::max);
            if coarse.is_finite() {
                change = Some(change.unwrap_or(0.0).max((score - coarse).abs()));
            }
        }
        Ok(change)
    }

    /// Distances s of the borders beside one border, on cells twice as large, over all moments; the border
    /// itself where there are none.
    fn coarser_borders(
        &self,
        border: &Border,
        which: &[usize],
        pairing: usize,
    ) -> Result<Vec<f64>, Error> {
        let s = self.distance_along(border);
        let key = (self.line, which.to_vec(), Cells::Doubled(pairing));
        let borders = self.site.cache.borders(key, || {
            let of_moments = self
                .site
                .borders(self.line, which, Cells::Doubled(pairing))?;
            Ok(of_moments.into_iter().flatten().collect())
        })?;
        let places = borders.iter().map(|other| self.distance_along(other));
        let mut beside: Vec<f64> = places
            .filter(|at| (at - s).abs() < BESIDE * self.cell())
            .collect();
        beside.sort_by(f64::total_cmp);
        beside.dedup_by(|a, b| (*a - *b).abs() < ON_BORDER * self.cell());
        if beside.is_empty() {
            beside.push(s);
        }
        Ok(beside)
    }

    /// The border that a place lies on.
    pub(super) fn border_at<'b>(&self, [s, z]: Place, borders: &'b [Border]) -> Option<&'b Border> {
        let near = ON_BORDER * self.cell();
        let mut on = borders
            .iter()
            .filter(|b| (self.distance_along(b) - s).abs() <= near);
        let first = on.next().filter(|_| z <= near && self.layer == 0)?;
        // Where both zones end together the rim is reported.
        Some(
            on.find(|b| b.zone == Zone::Contact)
                .filter(|_| first.zone == Zone::Stick)
                .unwrap_or(first),
        )
    }

    /// Distance s of a border along the line \[m\].
    fn distance_along(&self, border: &Border) -> f64 {
        self.line.nearest_distance(border.x, border.y)
    }

    /// Distance of the samples along the line \[m\].
    pub(super) fn cell(&self) -> f64 {
        self.line.step(self.site.grid)
    }

    /// The point of the layer at the distance s along the line and the depth z \[m\].
    pub(super) fn point(&self, [s, z]: Place) -> Point {
        let depth = Depth {
            z,
            layer: self.layer,
        };
        self.line.point(s, depth)
    }
}
