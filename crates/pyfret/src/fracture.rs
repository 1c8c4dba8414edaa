//! Cracks: stress intensity, arrest, growth.

use std::sync::Arc;

use ::fracture as of_cracks;
use contact_core::assess::crack as core;
use contact_core::convolution::Tractions;
use contact_core::fields::States;
use ndarray::{Array1, Array2, Ix3};
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Array, List, Mask, side};
use crate::error::to_python;
use crate::interruptible::interruptible;
use crate::material::Elastic;
use crate::parts::parts;
use crate::scene::{Body, Grid};

fn refused(error: of_cracks::Error) -> PyErr {
    to_python(core::refused(error))
}

/// What a function of the caller raised, or the crack refused.
struct Raised(PyErr);

impl From<PyErr> for Raised {
    fn from(error: PyErr) -> Self {
        Self(error)
    }
}

impl From<of_cracks::Error> for Raised {
    fn from(error: of_cracks::Error) -> Self {
        Self(refused(error))
    }
}

/// Stress in the plane over (time, points) from all of its components.
fn history(stress: Array<'_, Ix3>, points: usize) -> PyResult<Vec<Vec<of_cracks::PlaneStress>>> {
    let stress = stress.as_array();
    let (_, found, components) = stress.dim();
    if found != points || components != 6 {
        return Err(PyValueError::new_err(format!(
            "stress has the shape {:?}: must be (time, {points}, 6)",
            stress.dim(),
        )));
    }
    let plane = |s: ndarray::ArrayView1<'_, f64>| [s[0], s[2], s[4]];
    let instants = stress.outer_iter();
    Ok(instants
        .map(|of| of.outer_iter().map(plane).collect())
        .collect())
}

/// A crack from the surface of a half-plane: where stress is wanted, what it does at the tip.
///
/// Plane strain; nothing here knows of contacts. K_I + i K_II = lim sqrt(2 pi r) (s_nn + i s_tn)
/// ahead of the tip, t along the crack, n = +x for a crack along the depth.
///
/// Parameters
/// ----------
/// x : float
///     Place of the mouth [m].
/// legs : list of (float, float)
///     Length [m] and angle [rad] of each straight leg from the mouth on; angles are from the
///     inward normal, positive towards +x.
///
/// Examples
/// --------
/// >>> crack = Crack(legs=[(1e-4, 0.0)])
/// >>> tension = np.zeros((1, len(crack.points), 6))
/// >>> tension[..., 0] = 100e6
/// >>> K = crack.intensity(tension).get("K_I").item(0)
/// >>> round(K / (100e6 * np.sqrt(np.pi * 1e-4)), 4)
/// 1.1215
#[pyclass(frozen, module = "pyfret.fracture")]
#[derive(Clone)]
pub(crate) struct Crack(of_cracks::Crack);

parts!(Crack: legs, x);

#[pymethods]
impl Crack {
    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        crate::parts::equal(slf.as_any(), other, Self::PARTS)
    }

    #[new]
    #[pyo3(signature = (*, legs, x = 0.0))]
    fn new(legs: List<(f64, f64)>, x: f64) -> PyResult<Self> {
        let path = of_cracks::Path::kinked(x, &legs);
        of_cracks::Crack::new(path).map(Self).map_err(refused)
    }

    /// Place of the mouth [m].
    #[getter]
    fn x(&self) -> f64 {
        self.0.path().mouth
    }

    /// Length [m] and angle [rad] of each leg.
    #[getter]
    fn legs(&self) -> Vec<(f64, f64)> {
        let legs = self.0.path().legs.iter();
        legs.map(|leg| (leg.length(), leg.end())).collect()
    }

    /// Length along the crack [m].
    #[getter]
    fn length(&self) -> f64 {
        self.0.length()
    }

    /// Points at which the stress is wanted, tip to mouth: x and depth [m], (points, 2).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Bound<'py, numpy::PyArray2<f64>> {
        let points = self.0.points();
        let of = |(n, c): (usize, usize)| if c == 0 { points[n].x } else { points[n].z };
        Array2::from_shape_fn((points.len(), 2), of).into_pyarray(py)
    }

    /// K over the instants of a history of stress at :attr:`points`.
    ///
    /// Parameters
    /// ----------
    /// stress : array of shape (time, points, 6)
    ///     Stress of the body without the crack [Pa]: xx, yy, zz, xy, xz, yz, z the depth.
    /// friction : float, optional
    ///     Coefficient of friction between faces in contact; by default faces may pass through
    ///     each other, and K is linear in the stress.
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``K_I``, ``K_II`` and their ``error`` [Pa m^0.5], ``open``, the share of the crack that
    ///     is open, each over time.
    #[pyo3(signature = (stress, *, friction = None))]
    fn intensity<'py>(
        &self,
        py: Python<'py>,
        stress: Array<'_, Ix3>,
        friction: Option<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let history = history(stress, self.0.points().len())?;
        let start = of_cracks::Faces::new(&self.0, friction.unwrap_or(0.0)).map_err(refused)?;
        let mut faces = start;
        let (mut found, mut open) = (Vec::new(), Vec::new());
        for plane in history {
            if friction.is_some() {
                faces = faces.next(&plane).map_err(refused)?;
                found.push(faces.intensity);
                open.push(faces.open_share().map_err(refused)?);
            } else {
                found.push(self.0.intensity(&plane).map_err(refused)?);
                open.push(1.0);
            }
        }
        let row = |f: &dyn Fn(&of_cracks::Intensity) -> f64| -> Array1<f64> {
            found.iter().map(f).collect()
        };
        let result = PyDict::new(py);
        result.set_item("K_I", row(&|k| k.K_I).into_pyarray(py))?;
        result.set_item("K_II", row(&|k| k.K_II).into_pyarray(py))?;
        result.set_item("error", row(&|k| k.error).into_pyarray(py))?;
        result.set_item("open", Array1::from(open).into_pyarray(py))?;
        Ok(result)
    }

    /// Grow the crack in the direction of the largest range over a cycle of stress.
    ///
    /// Pieces are curved so that at the end of each the crack has no reason to turn; their number
    /// doubles until the tip moves less than the tolerance.
    ///
    /// Parameters
    /// ----------
    /// stress : callable
    ///     Takes points, x and depth [m] in an array of shape (points, 2), and gives the stress of
    ///     the body without the crack there over the instants of the cycle [Pa], shape
    ///     (time, points, 6).
    /// end : float
    ///     Length to grow to [m].
    /// direction : {"tangential_stress", "opening_intensity"}
    ///     Largest range of the tangential stress ahead of the tip, or of K_I of a small kink.
    /// friction : float
    ///     Coefficient of friction between faces in contact.
    /// tolerance : float
    ///     Distance by which the last tip may be off over the length grown.
    ///
    /// Returns
    /// -------
    /// dict
    ///     Of the tips on the way ``length``, ``x``, ``z`` [m], ``angle`` [rad], over (time, tips)
    ///     ``K_I``, ``K_II`` and their ``error`` [Pa m^0.5]; ``path_error``, how far the last tip
    ///     may be off [m]; ``end``: "reached" the length, "closed", as nothing opens the crack,
    ///     "surface", to which it came back, "kinks", where its direction jumps.
    #[pyo3(signature = (stress, *, end, direction = "tangential_stress", friction = 0.0, tolerance = 1e-2))]
    fn grow<'py>(
        &self,
        py: Python<'py>,
        stress: &Bound<'py, PyAny>,
        end: f64,
        direction: &str,
        friction: f64,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let growing = of_cracks::Growing {
            direction: core::direction_named(direction).map_err(to_python)?,
            to: end,
            friction,
            tolerance,
        };
        let at = |crack: &of_cracks::Crack| -> Result<Vec<Vec<of_cracks::PlaneStress>>, Raised> {
            let points = Self(crack.clone()).points(py);
            let found = stress.call1((points,))?;
            Ok(history(found.extract()?, crack.points().len())?)
        };
        let found = of_cracks::grow(self.0.path(), &growing, at).map_err(|Raised(error)| error)?;
        let tips: Vec<_> = found.tips.iter().map(|tip| tip.at).collect();
        let times = found.tips.first().map_or(0, |tip| tip.cycle.len());
        let table = |f: &dyn Fn(&of_cracks::Intensity) -> f64| {
            let of = |(n, l): (usize, usize)| f(&found.tips[l].cycle[n]);
            Array2::from_shape_fn((times, found.tips.len()), of).into_pyarray(py)
        };
        let result = PyDict::new(py);
        result.set_item("K_I", table(&|k| k.K_I))?;
        result.set_item("K_II", table(&|k| k.K_II))?;
        result.set_item("error", table(&|k| k.error))?;
        set_path(py, &result, &tips)?;
        result.set_item("path_error", found.error)?;
        result.set_item("end", named(found.end))?;
        Ok(result)
    }

    fn __repr__(&self) -> String {
        format!("Crack(legs={:?}, x={:?})", self.legs(), self.x())
    }
}

/// States of a contact above cracks, as arrays over (state, x, y).
#[derive(FromPyObject)]
pub(crate) struct ContactStates<'py> {
    #[pyo3(item)]
    p: Array<'py, Ix3>,
    #[pyo3(item)]
    q_x: Array<'py, Ix3>,
    #[pyo3(item)]
    q_y: Array<'py, Ix3>,
    #[pyo3(item)]
    stick: Mask<'py, Ix3>,
    #[pyo3(item)]
    sigma_B: List<f64>,
    #[pyo3(item)]
    residual: Option<List<f64>>,
}

/// What `f` finds below a contact in its states.
fn below_contact<T: Send>(
    py: Python<'_>,
    (body, body_number): (&Body, u8),
    grid: &Grid,
    given: ContactStates<'_>,
    f: impl FnOnce(&core::Below<'_>, &States<'_>) -> Result<T, contact_core::Error> + Send,
) -> PyResult<T> {
    let shape = (given.sigma_B.len(), grid.0.nx, grid.0.ny);
    let fields = [&given.q_x, &given.q_y, &given.p].map(|field| field.as_array());
    if fields.iter().any(|s| s.dim() != shape) || given.stick.as_array().dim() != shape {
        return Err(PyValueError::new_err(format!(
            "p, q_x, q_y and stick must be of the shape {shape:?}, that of the states and the grid"
        )));
    }
    let cells = grid.0.cells();
    let fields = fields.map(|f| f.iter().copied().collect::<Vec<_>>());
    let stick: Vec<bool> = given.stick.as_array().iter().copied().collect();
    let of = |state: usize, field: usize| &fields[field][state * cells..(state + 1) * cells];
    let tractions = |n: usize| Tractions {
        q_x: Some(of(n, 0)),
        q_y: Some(of(n, 1)),
        p: Some(of(n, 2)),
    };
    let tractions: Vec<_> = (0..shape.0).map(tractions).collect();
    let stick: Vec<&[bool]> = stick.chunks(cells).collect();
    let residual = given.residual.unwrap_or_default();
    let residual =
        contact_core::fields::residual_of_layers(&body.0, &residual).map_err(to_python)?;
    let below = core::Below {
        body: &body.0,
        side: side(body_number)?,
        grid: &grid.0,
    };
    let sigma_B = given.sigma_B.0;
    let stop = Arc::default();
    let found = interruptible(py, &stop, || {
        let states = States {
            tractions: &tractions,
            sigma_B: &sigma_B,
            residual: &residual,
            stick: Some(&stick),
            stop: stop.clone(),
        };
        f(&below, &states)
    })?;
    found.map_err(to_python)
}

/// K over (state, length), as named arrays.
fn tables<'py>(py: Python<'py>, found: &[core::OverCycle]) -> PyResult<Bound<'py, PyDict>> {
    let states = found.first().map_or(0, |over| over.faces.len());
    let table = |f: &dyn Fn(&core::OverCycle, usize) -> f64| {
        Array2::from_shape_fn((states, found.len()), |(n, l)| f(&found[l], n)).into_pyarray(py)
    };
    let result = PyDict::new(py);
    result.set_item("K_I", table(&|c, n| c.faces[n].K_I))?;
    result.set_item("K_II", table(&|c, n| c.faces[n].K_II))?;
    result.set_item("K_I_linear", table(&|c, n| c.linear[n].K_I))?;
    result.set_item("K_II_linear", table(&|c, n| c.linear[n].K_II))?;
    result.set_item("error", table(&|c, n| c.faces[n].error))?;
    result.set_item("open", table(&|c, n| c.open[n]))?;
    Ok(result)
}

/// K of cracks below a contact in several of its states; use :meth:`pyfret.Result.crack`.
#[pyfunction]
#[pyo3(signature = (body, grid, states, *, x, lengths, angle = 0.0, kink = None, azimuth = 0.0, friction = 0.0, body_number = 2))]
pub(crate) fn crack_of_states<'py>(
    py: Python<'py>,
    body: Body,
    grid: Grid,
    states: ContactStates<'_>,
    x: f64,
    lengths: List<f64>,
    angle: f64,
    kink: Option<(f64, f64)>,
    azimuth: f64,
    friction: f64,
    body_number: u8,
) -> PyResult<Bound<'py, PyDict>> {
    let cracks = core::Cracks {
        x,
        angle,
        kink,
        azimuth,
        lengths: lengths.0,
        friction,
    };
    let found = below_contact(py, (&body, body_number), &grid, states, |below, states| {
        core::over_cycle(below, states, &cracks)
    })?;
    tables(py, &found)
}

/// A crack that grows below a contact; use :meth:`pyfret.Result.grow_crack`.
#[pyfunction]
#[pyo3(signature = (body, grid, states, *, x, start, end, direction, tolerance, angle = 0.0, azimuth = 0.0, friction = 0.0, body_number = 2))]
pub(crate) fn crack_growth_of_states<'py>(
    py: Python<'py>,
    body: Body,
    grid: Grid,
    states: ContactStates<'_>,
    x: f64,
    start: f64,
    end: f64,
    direction: &str,
    tolerance: f64,
    angle: f64,
    azimuth: f64,
    friction: f64,
    body_number: u8,
) -> PyResult<Bound<'py, PyDict>> {
    let growth = core::Growth {
        x,
        angle,
        azimuth,
        start,
        growing: of_cracks::Growing {
            direction: core::direction_named(direction).map_err(to_python)?,
            to: end,
            friction,
            tolerance,
        },
    };
    let found = below_contact(py, (&body, body_number), &grid, states, |below, states| {
        core::grown(below, states, &growth)
    })?;
    let result = tables(py, &found.over)?;
    set_path(py, &result, &found.tips)?;
    result.set_item("path_error", found.error)?;
    result.set_item("end", named(found.end))?;
    Ok(result)
}

/// Why a crack ends, in a word.
fn named(end: of_cracks::End) -> &'static str {
    match end {
        of_cracks::End::Reached => "reached",
        of_cracks::End::Closed => "closed",
        of_cracks::End::Surface => "surface",
        of_cracks::End::Kinks => "kinks",
    }
}

/// Adds the tips on the way: length, x and depth [m], angle [rad].
fn set_path(py: Python<'_>, result: &Bound<'_, PyDict>, tips: &[of_cracks::Point]) -> PyResult<()> {
    let row =
        |f: &dyn Fn(&of_cracks::Point) -> f64| -> Array1<f64> { tips.iter().map(f).collect() };
    result.set_item("length", row(&|tip| tip.s).into_pyarray(py))?;
    result.set_item("x", row(&|tip| tip.x).into_pyarray(py))?;
    result.set_item("z", row(&|tip| tip.z).into_pyarray(py))?;
    result.set_item("angle", row(&|tip| tip.angle).into_pyarray(py))
}

/// A curve of K over lengths [m] from the largest and smallest K_I of the cycle [Pa m^0.5].
fn curve(lengths: List<f64>, K_max: List<f64>, K_min: List<f64>) -> PyResult<of_cracks::Curve> {
    if K_max.len() != K_min.len() {
        return Err(PyValueError::new_err(
            "K_max and K_min: must be of the same length",
        ));
    }
    let extremes = K_max.into_iter().zip(K_min);
    let extremes = extremes.map(|(K_max, K_min)| of_cracks::Extremes { K_max, K_min });
    of_cracks::Curve::new(lengths.0, extremes.collect()).map_err(refused)
}

/// Threshold as its numbers: dK_th, dS_0, Y, Walker's exponent, table of R.
type Numbers = (f64, Option<f64>, f64, Option<f64>, Option<Vec<(f64, f64)>>);

fn threshold((dK_th, dS_0, Y, walker, table): Numbers) -> PyResult<of_cracks::Threshold> {
    let ratio = match (walker, table) {
        (None, None) => of_cracks::LoadRatio::None,
        (Some(gamma), None) => of_cracks::LoadRatio::Walker { gamma },
        (None, Some(rows)) => of_cracks::LoadRatio::Table(rows),
        _ => return Err(PyValueError::new_err("walker and table: give one of both")),
    };
    let threshold = of_cracks::Threshold {
        dK_th,
        dS_0,
        Y,
        ratio,
    };
    threshold.check().map_err(refused)?;
    Ok(threshold)
}

/// Threshold range of K at R = 0 [Pa m^0.5] at lengths [m], and El Haddad's a_0 [m].
#[pyfunction]
pub(crate) fn threshold_at(threshold_: Numbers, lengths: List<f64>) -> PyResult<(Vec<f64>, f64)> {
    let of = threshold(threshold_)?;
    Ok((lengths.iter().map(|l| of.at(*l)).collect(), of.a_0()))
}

/// Equivalent range of K at R = 0 [Pa m^0.5] of extremes of K.
#[pyfunction]
pub(crate) fn equivalent_range(
    threshold_: Numbers,
    K_max: List<f64>,
    K_min: List<f64>,
) -> PyResult<Vec<f64>> {
    let of = threshold(threshold_)?;
    let pairs = K_max.into_iter().zip(K_min);
    let range = |(K_max, K_min)| of.equivalent(of_cracks::Extremes { K_max, K_min });
    Ok(pairs.map(range).collect())
}

/// Verdict, length where it stops, crossings, margin and its length.
type Arrested = (&'static str, Option<f64>, Vec<f64>, f64, f64);

/// What becomes of a crack: verdict, length where it stops, crossings, margin and its length.
#[pyfunction]
pub(crate) fn arrest(
    lengths: List<f64>,
    K_max: List<f64>,
    K_min: List<f64>,
    threshold_: Numbers,
    start: f64,
) -> PyResult<Arrested> {
    let found = curve(lengths, K_max, K_min)?
        .arrest(&threshold(threshold_)?, start)
        .map_err(refused)?;
    let (verdict, length) = match found.verdict {
        of_cracks::Verdict::Dormant => ("dormant", Some(start)),
        of_cracks::Verdict::Stops(l) => ("stops", Some(l)),
        of_cracks::Verdict::Grows => ("grows", None),
    };
    Ok((
        verdict,
        length,
        found.crossings,
        found.margin,
        found.margin_at,
    ))
}

/// Cycles of growth by Paris' law, where it ends [m] and whether it stops there.
#[pyfunction]
#[pyo3(signature = (lengths, K_max, K_min, threshold_, *, C, m, growth, short, start, end))]
pub(crate) fn crack_life(
    lengths: List<f64>,
    K_max: List<f64>,
    K_min: List<f64>,
    threshold_: Numbers,
    C: f64,
    m: f64,
    growth: &str,
    short: bool,
    start: f64,
    end: f64,
) -> PyResult<(f64, f64, bool)> {
    let growth = match growth {
        "plain" => of_cracks::Growth::Plain,
        "powers" => of_cracks::Growth::Powers,
        "difference" => of_cracks::Growth::Difference,
        other => {
            return Err(PyValueError::new_err(format!(
                "threshold_in = {other:?}: must be 'plain', 'powers' or 'difference'"
            )));
        }
    };
    let rate = of_cracks::Rate {
        C,
        m,
        growth,
        short,
    };
    let life = curve(lengths, K_max, K_min)?
        .life(&threshold(threshold_)?, &rate, (start, end))
        .map_err(refused)?;
    Ok((life.cycles, life.to, life.stopped))
}

/// Factor from the plane K to the deepest point of a semi-elliptic crack of the aspect a/c <= 1.
///
/// Newman and Raju's K under uniform tension over that of a straight front: an estimate, which
/// takes the stress as constant along the front. J. C. Newman, I. S. Raju, NASA TM 85793 (1984).
#[pyfunction]
pub(crate) fn ellipse_factor(aspect: f64) -> PyResult<f64> {
    of_cracks::ellipse_factor(aspect).map_err(refused)
}

/// A film on another material: materials of both.
fn film(film: Elastic, below: Elastic) -> PyResult<of_cracks::Film> {
    let pair = |m: Elastic| (m.0.E, m.0.nu);
    of_cracks::Film::of(pair(film), pair(below)).map_err(refused)
}

/// Factor g of a channel crack in a film; use :func:`pyfret.fracture.channel_release`.
#[pyfunction]
pub(crate) fn channel_crack(py: Python<'_>, film_: Elastic, below: Elastic) -> PyResult<f64> {
    let film = film(film_, below)?;
    py.detach(|| film.channel()).map_err(refused)
}

/// Factor F of a crack with its tip in a film; use :func:`pyfret.fracture.film_intensity`.
#[pyfunction]
pub(crate) fn partial_crack(
    py: Python<'_>,
    film_: Elastic,
    below: Elastic,
    depth: f64,
) -> PyResult<f64> {
    let film = film(film_, below)?;
    py.detach(|| film.partial(depth)).map_err(refused)
}
