//! The range of a life or of a safety factor: the worst point, and the mean over the critical
//! distance of the material.

use contact_core::Error;
use contact_core::digits::short;
use fatigue::{Assessment, LONGEST, LifeRange, Material, Range};

use super::by_criterion::from_fatigue;

/// Highest over lowest life from which a note gives the main cause.
const WIDE: f64 = 10.0;

/// Options of the range of a life.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RangeOptions {
    /// Highest over lowest by the scatter of the material, which replaces the default.
    pub scatter: Option<f64>,
    /// Critical distance \[m\], which replaces the value of the material.
    pub length: Option<f64>,
    /// Half the width of the contact along the section \[m\], for a note on a distance that is not
    /// small against it; none is written for 0.
    pub half_width: f64,
}

/// The range of a life or of a safety factor.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginRange {
    /// The range and its parts.
    pub range: LifeRange,
    /// The range at the worst point, with the scatter of the material.
    pub point: Range,
    /// Critical distance of the mean \[m\]; `None` for the value at the worst point.
    pub length: Option<f64>,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

/// Computes the range of a margin. `worst` is the value at the worst point with its error. `mean`
/// returns the largest mean over a distance, with its error if the flag is set. If a distance is
/// refused (the inner error), the value at the point counts, which is on the safe side.
pub fn margin_range<E: From<Error>>(
    assessment: &Assessment,
    material: Option<&Material>,
    worst: (f64, f64),
    options: &RangeOptions,
    mut mean: impl FnMut(f64, bool) -> Result<Result<(f64, f64), Error>, E>,
) -> Result<MarginRange, E> {
    let (factor, note) = assessment
        .scatter(material, options.scatter)
        .map_err(from_fatigue)?;
    let (mut value, mut error) = worst;
    let part = if value > 0.0 { error / value } else { 0.0 };
    let material_length = material.and_then(|material| material.critical_distance().ok());
    let mut notes: Vec<_> = assessment.mean_stress_note(material).into_iter().collect();
    let (mut distance, mut length) = (None, options.length.or(material_length));
    if let Some(L) = length {
        // A distance that is given has no scatter; a distance of the material has.
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
                let (at, material_length) = means[0];
                // Where larger cells have no mean, the error at the point is used.
                (value, error) = (
                    at,
                    if material_length.is_nan() {
                        part * at
                    } else {
                        material_length
                    },
                );
                notes.extend(note_on_depth(L, options.half_width));
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
                    "the value belongs to a point, it is no mean over a distance: {refused}"
                ));
            }
        }
    }
    notes.extend(note);
    let range = assessment.life_range(assessment.margins(value, error), factor, distance);
    notes.extend(note_on_width(assessment, &range));
    let point = assessment.point_range(worst.0, worst.1, factor);
    Ok(MarginRange {
        range,
        point,
        length,
        notes,
    })
}

/// A note if the mean over L \[m\] goes deeper than half the width of the contact, over which stresses decay;
/// none otherwise.
fn note_on_depth(L: f64, half_width: f64) -> Option<String> {
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

/// A note on a life that ends beyond the tests, or whose range is wider than [`WIDE`] by its distance; none
/// otherwise.
fn note_on_width(assessment: &Assessment, of: &LifeRange) -> Option<String> {
    let Range { low, high, .. } = of.range;
    if !assessment.gives_lives() || of.stress.best.is_infinite() {
        return None;
    }
    if high.is_infinite() {
        return Some(format!(
            "strain-life curves have no tests beyond {LONGEST:e} cycles: a longer life is not printed"
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
