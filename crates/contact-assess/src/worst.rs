//! The worst point of a layer on a section, between the samples and on borders of the contact.
//!
//! Starting points are the local maxima of the samples (hills), the places where the rim of the
//! contact and the border of the stick zone cross the line, and places beyond the samples. From the
//! worst of these the search ascends ([`Climb`]). Every value belongs to a history at a point. None
//! is extrapolated, and none is below the worst sample.

use contact_core::Error;
use contact_subsurface::{Errors, Extremum};

use super::cache::Cells;
use super::climb::Climb;
use super::judged::{Judge, Judged};
use super::site::Site;

/// Hills below this part of the highest are ignored.
const LOWEST: f64 = 0.8;
/// First step along the line in cells, and in depth over the distance to the neighbouring one.
const STEP: f64 = 0.5;

/// Error of a score over the largest change to cells twice as large: in line rigs on 40 to 128 cells
/// across 2.6 a it is 1.1 at most.
pub(super) const COARSE_FACTOR: f64 = 1.25;

/// The worst point of a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPoint<F> {
    /// The judgement there.
    pub judgement: F,
    /// Its score and place.
    pub extremum: Extremum,
}

/// Finds the worst point of a layer from the judgements on a section; `None` if the layer has no
/// number.
pub fn find_worst_point<J: Judge>(
    site: &Site<'_>,
    judged: &Judged<J::Judgement>,
    judge: &J,
    layer: usize,
) -> Result<Option<WorstPoint<J::Judgement>>, Error> {
    let climb = Climb {
        site,
        judge,
        layer,
        line: judged.line,
    };
    let mut starts = climb.hills(judged);
    let Some(highest) = starts.first().copied() else {
        return Ok(None);
    };
    starts.retain(|(_, score)| *score >= LOWEST * highest.1);
    let of_layer = || {
        judged
            .depths
            .iter()
            .filter(|d| d.layer == layer)
            .map(|d| d.z)
    };
    let top = of_layer().fold(f64::INFINITY, f64::min);
    let deepest = of_layer().fold(0.0, f64::max);
    let borders = climb.borders()?;
    let which = climb.representative_moments(highest.0)?;
    let prepared = site.prepare(judged.line, &which, Cells::Grid)?;
    if layer == 0 && top <= 0.0 {
        let places_beside = climb.worst_borders(&borders, judged);
        let scores = climb.scores(&prepared, &places_beside)?;
        starts.extend(places_beside.into_iter().zip(scores));
    }
    // Beside the contact a bulk stress may outweigh it, though the samples fall towards their ends.
    let places_beyond = climb.places_beyond([top, highest.0[1]]);
    let scores = climb.scores(&prepared, &places_beyond)?;
    starts.extend(
        places_beyond
            .into_iter()
            .zip(scores)
            .filter(|(_, score)| !score.is_nan()),
    );
    let whole = prepared.moments() == site.cycle.count();
    let best = starts.iter().copied().fold(
        highest,
        |best, start| if start.1 > best.1 { start } else { best },
    );
    // The neighbouring depths of the start.
    let gap = of_layer()
        .map(|z| (z - best.0[1]).abs())
        .filter(|gap| *gap > 0.0)
        .fold(f64::INFINITY, f64::min);
    let half_cell = STEP * climb.cell();
    let steps = [half_cell, if gap.is_finite() { STEP * gap } else { 0.0 }];
    let (place, drops) = climb.ascend(&prepared, best, steps, [top, deepest])?;
    let point = climb.point(place);
    let history = if whole {
        site.history(&prepared, &[point])?
    } else {
        site.full_history(judged.line, &[point])?
    };
    let Some(mut judgement) = climb.judge_points(&[point], &history)?.first().copied() else {
        return Ok(None);
    };
    let (mut place, mut point, mut score) = (place, point, judge.score(&judgement));
    // A sample is the stress of the whole section: the point may lie below it where rims within the
    // cells or steps of the tractions count.
    let missing = (highest.1 - score).max(0.0);
    if missing > 0.0
        && let Some(sample) = climb.judgement_of_sample(judged, highest.0)
    {
        (place, point) = (highest.0, climb.point(highest.0));
        (judgement, score) = (sample, highest.1);
    }
    let border = climb.border_at(place, &borders);
    let change = climb.coarser_change((place, score), border, &which)?;
    // An assumed rim may be half a cell off; a border that was extrapolated is where it is.
    let on_extrapolated_border = border.is_some_and(|border| border.within_cell);
    let places_beside = if !on_extrapolated_border && prepared.rim_is_unknown(point) {
        [-half_cell, half_cell]
            .map(|by| [place[0] + by, place[1]])
            .into()
    } else {
        Vec::new()
    };
    let places_beside = climb.scores(&prepared, &places_beside)?.into_iter();
    let changes = places_beside.map(|places_beside| (score - places_beside).abs());
    let beyond = climb.gain_far_away(&prepared, place, score)?;
    let along = changes.fold(drops[0].max(missing).max(beyond), f64::max);
    let extremum = Extremum {
        value: score,
        x: point.0,
        y: point.1,
        depth: point.2,
        at: border.map(|b| b.zone),
        error: Errors {
            tractions: change.map(|change| COARSE_FACTOR * change),
            solution: site.cycle.path_error().map(|error| error * score.abs()),
            ..Errors::from_search(judged.line, [along, 0.0, drops[1]])
        },
    };
    let (length, width) = site.grid.extent();
    Ok(Some(WorstPoint {
        judgement,
        extremum: extremum.snapped_to_zero(length.max(width)),
    }))
}
