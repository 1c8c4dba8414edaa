//! The ascent to the worst point of a layer: points beside a place along the line and in depth are
//! judged, with smaller and smaller steps.

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::Grid;
use contact_subsurface::{Border, Depth, Line, Moments, Point, TwiceAsLarge, Zone, borders};
use ndarray::Array2;

use super::history::History;
use super::judged::{Judge, Judged};
use super::site::{At, Site};

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
/// Distance beyond the samples over their length at which the bulk stress alone is left: the net
/// force of a line contact adds 1/FAR of its mean pressure.
const FAR: f64 = 1e3;
/// A point is on a border if it is at most this many cells from it.
const ON_BORDER: f64 = 0.1;
/// Contact cells times moments up to which every point of the ascent is judged by the whole
/// history.
const CHEAP: usize = 100_000;
/// Moments that represent a longer history during the ascent.
const STAND_FOR: usize = 32;
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
    /// The tops of the samples over the depths, the worst first, with their scores.
    pub(super) fn hills(&self, judged: &Judged<J::Found>) -> Vec<(Place, f64)> {
        let tops: Vec<(Place, f64)> = judged
            .depths
            .iter()
            .zip(&judged.found)
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

    /// The judgement of a sample.
    pub(super) fn sample(&self, judged: &Judged<J::Found>, [s, z]: Place) -> Option<J::Found> {
        let at_depth = |d: &Depth| d.z == z && d.layer == self.layer;
        let row = judged.depths.iter().position(at_depth)?;
        let n = judged.along.iter().position(|along| *along == s)?;
        judged.found[row].as_ref().map(|found| found[n])
    }

    /// Where the line crosses the rims and stick borders of moments of the cycle, each once.
    pub(super) fn borders(&self) -> Result<Vec<Border>, Error> {
        let count = self.site.cycle.count();
        let step = count.div_ceil(BORDER_MOMENTS).max(1);
        let which: Vec<usize> = (0..count).rev().step_by(step).collect();
        let moments = self.site.cycle.moments(&which)?;
        let mut all: Vec<Border> = Vec::new();
        for (tractions, stick) in moments.tractions.iter().zip(&moments.stick) {
            for border in borders_of(self.site.grid, tractions, stick, self.line)? {
                let apart = |b: &Border| (self.along(b) - self.along(&border)).abs();
                if !all.iter().any(|b| apart(b) < ON_BORDER / 2.0 * self.cell()) {
                    all.push(border);
                }
            }
        }
        Ok(all)
    }

    /// The borders beside which the samples of the surface are worst, as places.
    pub(super) fn beside(&self, known: &[Border], judged: &Judged<J::Found>) -> Vec<Place> {
        let at_surface = |d: &Depth| d.z <= 0.0 && d.layer == 0;
        let surface = judged.depths.iter().position(at_surface);
        let Some(found) = surface.and_then(|n| judged.found[n].as_ref()) else {
            return Vec::new();
        };
        let near = |s: f64| {
            let away = |n: &usize| (judged.along[*n] - s).abs();
            let nearest = (0..judged.along.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
            nearest.map_or(f64::NAN, |n| self.judge.score(&found[n]))
        };
        let scored = known.iter().map(|b| (self.along(b), near(self.along(b))));
        let mut by_score: Vec<_> = scored.filter(|(_, score)| !score.is_nan()).collect();
        by_score.sort_by(|a, b| b.1.total_cmp(&a.1));
        by_score
            .iter()
            .take(BORDERS)
            .map(|(s, _)| [*s, 0.0])
            .collect()
    }

    /// All moments of the cycle, or of a long one those whose stress at a place is farthest apart.
    pub(super) fn moments(&self, place: Place) -> Result<Moments, Error> {
        let count = self.site.cycle.count();
        let all: Vec<usize> = (0..count).collect();
        let last = self.site.cycle.moments(&[count - 1])?;
        let touching = last.tractions[0][2].iter().filter(|p| **p > 0.0).count();
        if touching * count <= CHEAP || count <= STAND_FOR {
            return self.site.cycle.moments(&all);
        }
        let history = self.site.whole(&[self.point(place)])?;
        let away = |a: usize, b: usize| -> f64 {
            (0..6)
                .map(|c| (history.stress[(a, 0, c)] - history.stress[(b, 0, c)]).powi(2))
                .sum()
        };
        let mut chosen = vec![0];
        let mut nearest: Vec<f64> = all.iter().map(|n| away(*n, 0)).collect();
        while chosen.len() < STAND_FOR {
            let farthest = (0..count).max_by(|a, b| nearest[*a].total_cmp(&nearest[*b]));
            let Some(next) = farthest.filter(|n| nearest[*n] > 0.0) else {
                break;
            };
            chosen.push(next);
            for n in 0..count {
                nearest[n] = nearest[n].min(away(n, next));
            }
        }
        self.site.cycle.moments(&chosen)
    }

    /// Ascends from a place: the top, and the drop of the score at the last steps along the line
    /// and in depth.
    pub(super) fn climbed(
        &self,
        at: &At,
        (mut place, mut score): (Place, f64),
        first: [f64; 2],
        [top, deepest]: [f64; 2],
    ) -> Result<(Place, [f64; 2]), Error> {
        // The representative moments may score less than the whole history of the sample.
        score = self.scores(at, &[place])?.first().copied().unwrap_or(score);
        let (samples, ends) = (self.ends(0.0), self.ends(BEYOND));
        let (mut steps, mut left) = (first, [0.0; 2]);
        for _ in 0..MOST_ROUNDS {
            let mut beside: Vec<(usize, Place)> = Vec::new();
            for axis in 0..2 {
                for by in [-steps[axis], steps[axis]] {
                    let mut next = place;
                    let (low, high) = if axis == 0 {
                        (ends[0], ends[1])
                    } else {
                        (top, deepest)
                    };
                    next[axis] = (next[axis] + by).clamp(low, high);
                    if next != place {
                        beside.push((axis, next));
                    }
                }
            }
            let places: Vec<Place> = beside.iter().map(|(_, place)| *place).collect();
            let scores = self.scores(at, &places)?;
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
                    left[axis] = (best.1 - nearest).abs();
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
        Ok((place, left))
    }

    /// The places so far beyond the samples: the stress is known there as well.
    fn ends(&self, beyond: f64) -> [f64; 2] {
        let reach = self.line.places(self.site.grid);
        let (first, last) = (reach[0], reach[reach.len() - 1]);
        [
            first - beyond * (last - first),
            last + beyond * (last - first),
        ]
    }

    /// Places half way to the ends of the ascent and at them, at some depths.
    pub(super) fn far(&self, depths: [f64; 2]) -> Vec<Place> {
        let of_ends = [0.5 * BEYOND, BEYOND].map(|beyond| self.ends(beyond));
        let places = of_ends.into_iter().flatten();
        let mut far: Vec<Place> = places.flat_map(|s| depths.map(|z| [s, z])).collect();
        far.dedup();
        far
    }

    /// Of a place at the end of the ascent, how much more the score is where the bulk stress is
    /// alone.
    pub(super) fn more_far_away(&self, at: &At, [s, z]: Place, score: f64) -> Result<f64, Error> {
        let near = ON_BORDER * self.cell();
        let [first, last] = self.ends(BEYOND);
        if s > first + near && s < last - near {
            return Ok(0.0);
        }
        let far = self.ends(FAR).map(|s| [s, z]);
        let scores = self.scores(at, &far)?.into_iter();
        Ok(scores.map(|far| far - score).fold(0.0, f64::max))
    }

    pub(super) fn scores(&self, at: &At, places: &[Place]) -> Result<Vec<f64>, Error> {
        if places.is_empty() {
            return Ok(Vec::new());
        }
        let points: Vec<Point> = places.iter().map(|place| self.point(*place)).collect();
        let found = self.judged(&points, &at.history(&points)?)?;
        Ok(found.iter().map(|f| self.judge.score(f)).collect())
    }

    pub(super) fn judged(
        &self,
        points: &[Point],
        history: &History,
    ) -> Result<Vec<J::Found>, Error> {
        let z: Vec<f64> = points.iter().map(|(_, _, depth)| depth.z).collect();
        self.judge
            .judge(self.layer, &z, &history.view(), &self.site.stop)
    }

    /// The largest change of a score by tractions on cells twice as large, paired in both ways; on the
    /// same border if the place lies on one.
    pub(super) fn change_on_coarser_cells(
        &self,
        ([s, z], score): (Place, f64),
        border: Option<&Border>,
        moments: &Moments,
    ) -> Result<Option<f64>, Error> {
        let mut change: Option<f64> = None;
        for cells in TwiceAsLarge::both(self.site.grid) {
            if cells.grid.nx < 4 {
                return Ok(None);
            }
            let there = match border {
                None => None,
                Some(border) => self.on_coarser_border(border, moments, &cells)?,
            };
            let at = self.site.under_coarser(&cells, moments)?;
            let scores = self.scores(&at, &[[there.unwrap_or(s), z]])?;
            let largest = scores.iter().map(|coarse| (score - coarse).abs());
            change = largest.chain(change).reduce(f64::max);
        }
        Ok(change)
    }

    /// The nearest border of the same zone on cells twice as large.
    fn on_coarser_border(
        &self,
        border: &Border,
        moments: &Moments,
        cells: &TwiceAsLarge,
    ) -> Result<Option<f64>, Error> {
        let s = self.along(border);
        let (line, shift) = self.line.seen_from(cells.middle);
        let coarse = moments.on_coarser(cells);
        let mut nearest: Option<f64> = None;
        for (tractions, stick) in coarse.tractions.iter().zip(&coarse.stick) {
            for other in borders_of(&cells.grid, tractions, stick, line)? {
                let at = line.along(other.x, other.y) + shift;
                let nearer = nearest.is_none_or(|known| (at - s).abs() < (known - s).abs());
                if other.zone == border.zone && nearer {
                    nearest = Some(at);
                }
            }
        }
        Ok(nearest.filter(|at| (at - s).abs() < 4.0 * self.cell()))
    }

    /// The border that a place lies on.
    pub(super) fn on_border<'b>(&self, [s, z]: Place, known: &'b [Border]) -> Option<&'b Border> {
        let near = ON_BORDER * self.cell();
        let mut on = known.iter().filter(|b| (self.along(b) - s).abs() <= near);
        let first = on.next().filter(|_| z <= near && self.layer == 0)?;
        // Where both zones end together the rim is reported.
        Some(
            on.find(|b| b.zone == Zone::Contact)
                .filter(|_| first.zone == Zone::Stick)
                .unwrap_or(first),
        )
    }

    fn along(&self, border: &Border) -> f64 {
        self.line.along(border.x, border.y)
    }

    /// Distance of the samples along the line \[m\].
    pub(super) fn cell(&self) -> f64 {
        self.line.step(self.site.grid)
    }

    pub(super) fn point(&self, [s, z]: Place) -> Point {
        let depth = Depth {
            z,
            layer: self.layer,
        };
        self.line.point(s, depth)
    }
}

/// The crossings of a line with the borders of a moment.
fn borders_of(
    grid: &Grid,
    [q_x, q_y, p]: &[Array2<f64>; 3],
    stick: &Array2<bool>,
    line: Line,
) -> Result<Vec<Border>, Error> {
    let tractions = Tractions {
        q_x: q_x.as_slice(),
        q_y: q_y.as_slice(),
        p: p.as_slice(),
    };
    borders(grid, &tractions, stick.as_slice(), Some(line))
}
