//! The range of a life or of a safety factor: the worst point, and the mean over the critical
//! distance of the material.

use contact_core::Error;
use contact_subsurface::Line;
use fatigue::{Assessment, AtPoint, LONGEST, LifeRange, Material, Range};

use super::average::{Distance, average};
use super::by_criterion::{ByCriterion, of_criteria};
use super::site::Site;

/// Highest over lowest life from which a note says what makes it so.
const WIDE: f64 = 10.0;

/// The largest mean over a critical distance along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestMean {
    /// The judgement at the place of the largest sample.
    pub found: AtPoint,
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
    let found = average(site, line, distance, of)?;
    let along = line.places(site.grid);
    let samples: Vec<_> = found.iter().zip(&along).collect();
    let value = |n: usize| samples[n].0.map(|found| found.value);
    let judged = (0..samples.len()).filter(|n| value(*n).is_some());
    let Some(n) = judged.max_by(|a, b| {
        value(*a)
            .partial_cmp(&value(*b))
            .unwrap_or(std::cmp::Ordering::Equal)
    }) else {
        return Ok(None);
    };
    let (Some(found), place) = (*samples[n].0, *samples[n].1) else {
        return Ok(None);
    };
    let beside = (n > 0 && n + 1 < samples.len())
        .then(|| value(n - 1).zip(value(n + 1)))
        .flatten();
    let (value, place) = match beside {
        Some((left, right)) => {
            let (rise, by) = vertex([left, found.value, right]);
            (found.value + rise, place + by * (along[n + 1] - place))
        }
        None => (found.value, place),
    };
    Ok(Some(LargestMean {
        found,
        value,
        place,
    }))
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

/// What the range of a life is asked for with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RangeOptions {
    /// Highest over lowest by the scatter of the material, in place of the default.
    pub scatter: Option<f64>,
    /// Critical distance \[m\], in place of that of the material.
    pub length: Option<f64>,
}

/// The range of a life or of a safety factor.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeOfLife {
    /// The range and its parts.
    pub of: LifeRange,
    /// Critical distance of the mean \[m\]; `None` for the value at the worst point.
    pub length: Option<f64>,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

/// The range of a margin. `worst` is the value at the worst point with its error, `mean` the largest
/// mean over a distance. If a distance is refused (the inner error), the value at the point counts,
/// which is on the safe side.
pub fn range_of_life<E: From<Error>>(
    assessment: &Assessment,
    material: Option<&Material>,
    worst: (f64, f64),
    options: &RangeOptions,
    mut mean: impl FnMut(f64) -> Result<Result<f64, Error>, E>,
) -> Result<RangeOfLife, E> {
    let (factor, note) = assessment
        .scatter(material, options.scatter)
        .map_err(of_criteria)?;
    let (mut value, error) = worst;
    let part = if value > 0.0 { error / value } else { 0.0 };
    let own = material.and_then(|material| material.critical_distance().ok());
    let mut notes = Vec::new();
    let (mut distance, mut length) = (None, options.length.or(own));
    if let Some(L) = length {
        let step = material.map_or(2.0, Material::scatter_of_distance).sqrt();
        let mut three = || -> Result<Result<[f64; 3], Error>, E> {
            let mut values = [0.0; 3];
            for (value, L) in values.iter_mut().zip([L / step, L, L * step]) {
                match mean(L)? {
                    Ok(found) => *value = found,
                    Err(refused) => return Ok(Err(refused)),
                }
            }
            Ok(Ok(values))
        };
        match three()? {
            Ok([short, at, long]) => {
                value = at;
                distance = Some(Range {
                    low: assessment.extrapolated(short),
                    best: assessment.extrapolated(at),
                    high: assessment.extrapolated(long),
                });
            }
            Err(refused) => {
                length = None;
                notes.push(format!(
                    "the value is that at a point, no mean over a distance: {refused}"
                ));
            }
        }
    }
    notes.extend(note);
    let of = assessment.told(assessment.margins(value, part * value), factor, distance);
    notes.extend(wide(assessment, &of));
    Ok(RangeOfLife { of, length, notes })
}

/// A note on a life whose range says little: beyond the tests, or wider than [`WIDE`] by its distance.
fn wide(assessment: &Assessment, of: &LifeRange) -> Option<String> {
    let Range { low, high, .. } = of.range;
    if !assessment.gives_lives() || of.stress.best.is_infinite() {
        return None;
    }
    if high.is_infinite() {
        return Some(format!(
            "strain-life curves have no tests beyond {LONGEST:e} cycles: no longer life is told"
        ));
    }
    let part = of.distance.map(|of| of.high / of.low)?;
    (high > WIDE * low && part > of.material).then(|| {
        format!(
            "the life is known to a factor of {:.0}, mostly from the critical distance: measure \
             dK_th, the threshold of cracks, or give L",
            high / low
        )
    })
}
