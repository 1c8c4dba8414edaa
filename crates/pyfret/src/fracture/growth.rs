//! Arrest and life of a crack from its K over the length.

use ::fracture as of_cracks;

use crate::error::Answer;
use crate::prelude::*;

/// The curve of K over lengths \[m\], from the largest and smallest K_I of the cycle \[Pa m^0.5\].
fn curve(lengths: List<f64>, K_max: List<f64>, K_min: List<f64>) -> Answer<of_cracks::Curve> {
    if K_max.len() != K_min.len() {
        refuse!("K_max and K_min: must be of the same length");
    }
    let extremes = K_max.into_iter().zip(K_min);
    let extremes = extremes.map(|(K_max, K_min)| of_cracks::Extremes { K_max, K_min });
    Ok(of_cracks::Curve::new(lengths.0, extremes.collect())?)
}

/// Threshold as its numbers: dK_th, dS_0, Y, Walker's exponent, table of R.
type Numbers = (f64, Option<f64>, f64, Option<f64>, Option<Vec<(f64, f64)>>);

/// The threshold of growth from its numbers: range of K, limit of the stress range, geometry factor, and
/// Walker's exponent or a table for the load ratio.
fn threshold((dK_th, dS_0, Y, walker, table): Numbers) -> Answer<of_cracks::Threshold> {
    let ratio = match (walker, table) {
        (None, None) => of_cracks::LoadRatio::None,
        (Some(gamma), None) => of_cracks::LoadRatio::Walker { gamma },
        (None, Some(rows)) => of_cracks::LoadRatio::Table(rows),
        _ => refuse!("walker and table: give one of both"),
    };
    let threshold = of_cracks::Threshold {
        dK_th,
        dS_0,
        Y,
        ratio,
    };
    threshold.check()?;
    Ok(threshold)
}

/// Threshold range of K at R = 0 [Pa m^0.5] at lengths [m], and El Haddad's a_0 [m].
#[pyfunction]
#[pyo3(signature = (threshold_: "tuple[float, float | None, float, float | None, list[tuple[float, float]] | None]", lengths: "Sequence[float]"))]
pub(crate) fn threshold_at(
    #[pyo3(from_py_with = number)] threshold_: Numbers,
    lengths: List<f64>,
) -> PyResult<(Vec<f64>, f64)> {
    let threshold_law = threshold(threshold_)?;
    Ok((
        lengths
            .iter()
            .map(|l| threshold_law.at_length(*l))
            .collect(),
        threshold_law.a_0(),
    ))
}

/// Equivalent range of K at R = 0 [Pa m^0.5] of extremes of K.
#[pyfunction]
#[pyo3(signature = (threshold_: "tuple[float, float | None, float, float | None, list[tuple[float, float]] | None]", K_max: "Sequence[float]", K_min: "Sequence[float]"))]
pub(crate) fn equivalent_range(
    #[pyo3(from_py_with = number)] threshold_: Numbers,
    K_max: List<f64>,
    K_min: List<f64>,
) -> PyResult<Vec<f64>> {
    let threshold_law = threshold(threshold_)?;
    let pairs = K_max.into_iter().zip(K_min);
    let range = |(K_max, K_min)| threshold_law.equivalent(of_cracks::Extremes { K_max, K_min });
    Ok(pairs.map(range).collect())
}

/// Verdict, length where it stops, crossings, range of K over its threshold at the start, margin and
/// its length.
type Arrested = (&'static str, Option<f64>, Vec<f64>, f64, f64, f64);

/// Arrest or growth of a crack.
///
/// Verdict, length where it stops, crossings, range of K over its threshold at the start, margin
/// and its length.
#[pyfunction]
#[pyo3(signature = (lengths: "Sequence[float]", K_max: "Sequence[float]", K_min: "Sequence[float]", threshold_: "tuple[float, float | None, float, float | None, list[tuple[float, float]] | None]", start: "float") -> "tuple[Literal['dormant', 'stops', 'grows'], float | None, list[float], float, float, float]")]
pub(crate) fn arrest(
    lengths: List<f64>,
    K_max: List<f64>,
    K_min: List<f64>,
    #[pyo3(from_py_with = number)] threshold_: Numbers,
    #[pyo3(from_py_with = number)] start: f64,
) -> Answer<Arrested> {
    let arrest = curve(lengths, K_max, K_min)?.arrest(&threshold(threshold_)?, start)?;
    let (verdict, length) = match arrest.verdict {
        of_cracks::Verdict::Dormant => ("dormant", Some(start)),
        of_cracks::Verdict::Stops(l) => ("stops", Some(l)),
        of_cracks::Verdict::Grows => ("grows", None),
    };
    Ok((
        verdict,
        length,
        arrest.crossings,
        arrest.at_start,
        arrest.margin,
        arrest.margin_at,
    ))
}

/// Cycles of growth by Paris' law, where it ends [m] and whether it stops there.
#[pyfunction]
#[pyo3(signature = (lengths: "Sequence[float]", K_max: "Sequence[float]", K_min: "Sequence[float]", threshold_: "tuple[float, float | None, float, float | None, list[tuple[float, float]] | None]", *, C: "float", m: "float", growth, short, start: "float", end: "float"))]
pub(crate) fn crack_life(
    lengths: List<f64>,
    K_max: List<f64>,
    K_min: List<f64>,
    #[pyo3(from_py_with = number)] threshold_: Numbers,
    #[pyo3(from_py_with = number)] C: f64,
    #[pyo3(from_py_with = number)] m: f64,
    growth: &str,
    short: bool,
    #[pyo3(from_py_with = number)] start: f64,
    #[pyo3(from_py_with = number)] end: f64,
) -> Answer<(f64, f64, bool)> {
    let growth = match growth {
        "plain" => of_cracks::Growth::Plain,
        "powers" => of_cracks::Growth::Powers,
        "difference" => of_cracks::Growth::Difference,
        other => refuse!("threshold_in = {other:?}: must be 'plain', 'powers' or 'difference'"),
    };
    let rate = of_cracks::Rate {
        C,
        m,
        growth,
        short,
    };
    let life = curve(lengths, K_max, K_min)?.life(&threshold(threshold_)?, &rate, (start, end))?;
    Ok((life.cycles, life.to, life.stopped))
}
