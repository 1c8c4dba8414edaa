//! Damage of counted loops, and cycles of a spectrum.

use fatigue as core;
use ndarray::{Array1, Array2, Ix1, Ix4};

use super::Assessment;
use crate::error::Answer;
use crate::prelude::*;

/// Builds the damage curve of an assessment; `below` is the rule below the knee.
fn damage_curve(
    assessment: &Assessment,
    below: &str,
    knee: f64,
    exponent: Option<f64>,
) -> Answer<core::DamageCurve> {
    let below = match below {
        "original" => core::BelowKnee::Original,
        "elementary" => core::BelowKnee::Elementary,
        "haibach" => core::BelowKnee::Haibach,
        _ => refuse!("below = {below:?}: must be \"original\", \"elementary\" or \"haibach\""),
    };
    Ok(core::DamageCurve::new(
        &assessment.0,
        below,
        knee,
        exponent,
    )?)
}

/// Damage of one loop for each value of a criterion.
///
/// `knee` are the cycles at the knee, `exponent` is the exponent of the lives above a limit.
#[pyfunction]
#[pyo3(signature = (assessment, values, *, below: "str", knee: "float", exponent: "float | None") -> "NDArray[np.float64]")]
pub(crate) fn damage_of_values<'py>(
    py: Python<'py>,
    assessment: Assessment,
    values: Array<'py, Ix1>,
    below: &str,
    #[pyo3(from_py_with = number)] knee: f64,
    #[pyo3(from_py_with = number)] exponent: Option<f64>,
) -> Answer<Bound<'py, numpy::PyArray1<f64>>> {
    let curve = damage_curve(&assessment, below, knee, exponent)?;
    let damage: Array1<f64> = values.as_array().iter().map(|v| curve.damage(*v)).collect();
    Ok(damage.into_pyarray(py))
}

/// Miner's damage of loops on the worst planes of points.
///
/// `stress` has the shape (loops, instants, points, 6). Arrays over the points: `damage`, `missed`
/// and `normal`; `parts` and `values` over (points, loops).
#[pyfunction]
#[pyo3(signature = (assessment, stress, counts, *, below: "str", knee: "float", exponent: "float | None", bounded: "bool") -> "dict[str, NDArray[np.float64]]")]
#[expect(clippy::too_many_arguments, reason = "the numbers of the curve")]
pub(crate) fn damage_on<'py>(
    py: Python<'py>,
    assessment: Assessment,
    stress: Array<'py, Ix4>,
    counts: Array<'py, Ix1>,
    below: &str,
    #[pyo3(from_py_with = number)] knee: f64,
    #[pyo3(from_py_with = number)] exponent: Option<f64>,
    bounded: bool,
) -> Answer<Bound<'py, PyDict>> {
    let curve = damage_curve(&assessment, below, knee, exponent)?;
    let (view, stop) = (stress.as_array(), Arc::default());
    let counts = counts.as_array().to_vec();
    let work = || core::sum_damage(&curve, &view, &counts, bounded, &stop);
    let points = interruptible(py, &stop, work)??;
    let fields = PyDict::new(py);
    let (count, loops) = (points.len(), counts.len());
    let scalar = |number: fn(&core::PointDamage) -> f64| -> Array1<f64> {
        points.iter().map(number).collect()
    };
    fields.set_item("damage", scalar(|p| p.damage).into_pyarray(py))?;
    fields.set_item("missed", scalar(|p| p.missed).into_pyarray(py))?;
    let normal = Array2::from_shape_fn((count, 3), |(n, d)| points[n].normal[d]);
    fields.set_item("normal", normal.into_pyarray(py))?;
    let parts = Array2::from_shape_fn((count, loops), |(n, k)| points[n].parts[k]);
    fields.set_item("parts", parts.into_pyarray(py))?;
    let values = Array2::from_shape_fn((count, loops), |(n, k)| points[n].values[k]);
    fields.set_item("values", values.into_pyarray(py))?;
    Ok(fields)
}

/// Cycles of a Gaussian process with a one-sided density per Hz, by "rayleigh" or "dirlik".
///
/// `moments` are m_0, m_1, m_2 and m_4. `rates` are up-crossings, peaks and cycles per second.
/// `exceedance` is the part of the cycles that exceeds each of `amplitudes`. `mean_power` is the
/// mean of amplitude^k over the cycles for every k of `powers`.
#[pyfunction]
#[pyo3(signature = (frequencies, density, distribution, amplitudes, powers) -> "dict[str, NDArray[np.float64]]")]
pub(crate) fn spectral_cycles<'py>(
    py: Python<'py>,
    frequencies: Array<'py, Ix1>,
    density: Array<'py, Ix1>,
    distribution: &str,
    amplitudes: Array<'py, Ix1>,
    powers: Array<'py, Ix1>,
) -> Answer<Bound<'py, PyDict>> {
    let by = match distribution {
        "rayleigh" => core::CycleDistribution::Rayleigh,
        "dirlik" => core::CycleDistribution::Dirlik,
        _ => refuse!("distribution = {distribution:?}: must be \"rayleigh\" or \"dirlik\""),
    };
    let (f, G) = (frequencies.as_array().to_vec(), density.as_array().to_vec());
    let moments = core::SpectralMoments::from_density(&f, &G)?;
    let cycles = PyDict::new(py);
    let list = |values: Vec<f64>| Array1::from(values).into_pyarray(py);
    cycles.set_item("moments", list(moments.moments().to_vec()))?;
    let rates = vec![moments.up_crossings(), moments.peaks(), moments.rate(by)];
    cycles.set_item("rates", list(rates))?;
    let part = |a: &f64| moments.exceedance(by, *a);
    cycles.set_item(
        "exceedance",
        list(amplitudes.as_array().iter().map(part).collect()),
    )?;
    let mean = |k: &f64| moments.mean_power(by, *k);
    cycles.set_item(
        "mean_power",
        list(powers.as_array().iter().map(mean).collect()),
    )?;
    Ok(cycles)
}
