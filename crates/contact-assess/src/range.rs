//! The range of a life or of a safety factor: the worst point, and the mean over the critical
//! distance of the material.

use contact_core::Error;
use contact_core::digits::short;
use fatigue::{Assessment, LONGEST, LifeRange, Material, Range};

use super::by_criterion::of_criteria;

/// Highest over lowest life from which a note says what makes it so.
const WIDE: f64 = 10.0;

/// What the range of a life is asked for with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RangeOptions {
    /// Highest over lowest by the scatter of the material, in place of the default.
    pub scatter: Option<f64>,
    /// Critical distance \[m\], in place of that of the material.
    pub length: Option<f64>,
    /// Half the width of the contact along the section \[m\], for a note on a distance that is not
    /// small against it; none is written for 0.
    pub half_width: f64,
}

/// The range of a life or of a safety factor.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeOfLife {
    /// The range and its parts.
    pub of: LifeRange,
    /// The range of the value at the worst point, of the scatter of the material, too.
    pub point: Range,
    /// Critical distance of the mean \[m\]; `None` for the value at the worst point.
    pub length: Option<f64>,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

/// The range of a margin. `worst` is the value at the worst point with its error, `mean` the largest
/// mean over a distance, with its error if asked for. If a distance is refused (the inner error), the
/// value at the point counts, which is on the safe side.
pub fn range_of_life<E: From<Error>>(
    assessment: &Assessment,
    material: Option<&Material>,
    worst: (f64, f64),
    options: &RangeOptions,
    mut mean: impl FnMut(f64, bool) -> Result<Result<(f64, f64), Error>, E>,
) -> Result<RangeOfLife, E> {
    let (factor, note) = assessment
        .scatter(material, options.scatter)
        .map_err(of_criteria)?;
    let (mut value, mut error) = worst;
    let part = if value > 0.0 { error / value } else { 0.0 };
    let own = material.and_then(|material| material.critical_distance().ok());
    let mut notes = Vec::new();
    let (mut distance, mut length) = (None, options.length.or(own));
    if let Some(L) = length {
        // A distance that is given is what it is; that of a material has its scatter.
        let scatter = material.map_or(2.0, Material::scatter_of_distance).sqrt();
        let others = [1.0 / scatter, scatter].map(|part| part * L);
        let others = others.iter().filter(|_| options.length.is_none());
        let mut means = || -> Result<Result<Vec<(f64, f64)>, Error>, E> {
            let mut means = Vec::new();
            for L in std::iter::once(&L).chain(others.clone()) {
                match mean(*L, means.is_empty())? {
                    Ok(found) => means.push(found),
                    Err(refused) => return Ok(Err(refused)),
                }
            }
            Ok(Ok(means))
        };
        match means()? {
            Ok(means) => {
                let (at, own) = means[0];
                // Where larger cells have no mean the value at the point says how well the stress is known.
                (value, error) = (at, if own.is_nan() { part * at } else { own });
                notes.extend(deep(L, options.half_width));
                if let [_, (short, _), (long, _)] = means[..] {
                    distance = Some(Range {
                        low: assessment.uncapped_margin(short),
                        best: assessment.uncapped_margin(at),
                        high: assessment.uncapped_margin(long),
                    });
                }
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
    let of = assessment.life_range(assessment.margins(value, error), factor, distance);
    notes.extend(wide(assessment, &of));
    let point = assessment.point_range(worst.0, worst.1, factor);
    Ok(RangeOfLife {
        of,
        point,
        length,
        notes,
    })
}

/// A note on a mean that goes deeper than half the width of the contact: stresses below a contact fall
/// within this depth.
fn deep(L: f64, half_width: f64) -> Option<String> {
    let um = |x: f64| short(1e6 * x);
    (half_width > 0.0 && 2.0 * L > half_width).then(|| {
        format!(
            "L = {} um is not small against the contact: the mean goes {} um deep, and half the width of the \
             contact is {} um. The value at the worst point is on the safe side",
            um(L),
            um(2.0 * L),
            um(half_width),
        )
    })
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
