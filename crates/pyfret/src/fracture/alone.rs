//! A crack under any stress.

use ::fracture as of_cracks;
use contact_assess::crack as core;
use ndarray::{Array1, Array2, Ix3};

use super::names::{named, set_path};
use crate::error::Answer;
use crate::hints::Numbers;
use crate::prelude::*;

/// Takes the components in the plane of the crack from a stress over (time, points, 6).
fn history(stress: Array<'_, Ix3>, points: usize) -> PyResult<Vec<Vec<of_cracks::PlaneStress>>> {
    let stress = stress.as_array();
    let (_, found, components) = stress.dim();
    if found != points || components != 6 {
        refuse!(
            "stress has the shape {:?}: must be (time, {points}, 6)",
            stress.dim()
        );
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
/// interfaces : list of float
///     Depths at which the stress jumps or has a kink [m]. The points beside them are added to
///     :attr:`points`, and the quadrature is split there.
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
pub(crate) struct Crack(of_cracks::Crack, Vec<f64>);

parts!(Crack: legs, x, interfaces);

#[pymethods]
impl Crack {
    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        crate::parts::equal(slf.as_any(), other, Self::PARTS)
    }

    #[new]
    #[pyo3(signature = (*, legs: "Sequence[tuple[float, float]]", x: "float" = 0.0, interfaces: "Sequence[float]" = List(Vec::new())))]
    fn new(
        legs: List<(f64, f64)>,
        #[pyo3(from_py_with = number)] x: f64,
        interfaces: List<f64>,
    ) -> Answer<Self> {
        let path = of_cracks::Path::kinked(x, &legs);
        let crack = of_cracks::Crack::new(path)?.with_interfaces(&interfaces);
        Ok(Self(crack, interfaces.0))
    }

    /// Depths at which the stress jumps [m].
    #[getter]
    fn interfaces(&self) -> Vec<f64> {
        self.1.clone()
    }

    /// Length [m] and angle [rad] of each leg.
    #[getter]
    fn legs(&self) -> Vec<(f64, f64)> {
        let legs = self.0.path().legs.iter();
        legs.map(|leg| (leg.length(), leg.end())).collect()
    }

    /// Points at which the stress is wanted, tip to mouth: x and depth [m], (points, 2).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Numbers<'py> {
        let points = self.0.points();
        let coordinate = |(n, c): (usize, usize)| if c == 0 { points[n].x } else { points[n].z };
        Array2::from_shape_fn((points.len(), 2), coordinate)
            .into_pyarray(py)
            .into()
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
    #[pyo3(signature = (stress, *, friction: "float | None" = None) -> "dict[str, NDArray[np.float64]]")]
    fn intensity<'py>(
        &self,
        py: Python<'py>,
        stress: Array<'_, Ix3>,
        #[pyo3(from_py_with = number)] friction: Option<f64>,
    ) -> Answer<Bound<'py, PyDict>> {
        let history = history(stress, self.0.points().len())?;
        let start = of_cracks::Faces::new(&self.0, friction.unwrap_or(0.0))?;
        let mut faces = start;
        let (mut found, mut open) = (Vec::new(), Vec::new());
        for plane in history {
            if friction.is_some() {
                faces = faces.next(&plane)?;
                found.push(faces.intensity);
                open.push(faces.open_share()?);
            } else {
                found.push(self.0.intensity(&plane)?);
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
    /// Pieces are curved so that at the end of each the crack has no reason to turn. Their number
    /// doubles until the tip moves less than the tolerance.
    ///
    /// Parameters
    /// ----------
    /// stress : callable
    ///     Takes points, x and depth [m], in an array of shape (points, 2). Gives the stress there
    ///     of the body without the crack over the instants of the cycle [Pa], shape (time, points,
    ///     6).
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
    ///     Of the tips on the way ``length``, ``x``, ``z`` [m] and ``angle`` [rad]. Over (time,
    ///     tips) ``K_I``, ``K_II`` and their ``error`` [Pa m^0.5]. ``path_error`` is how far the
    ///     last tip may be off [m]. ``end`` is the reason for the end. "reached": the crack has its
    ///     length. "closed": nothing opens it. "surface": it came back to the surface. "kinks": its
    ///     direction jumps.
    #[pyo3(signature = (stress: "Callable[[NDArray[np.float64]], ArrayLike]", *, end: "float", direction: "Literal['tangential_stress', 'opening_intensity']" = "tangential_stress", friction: "float" = 0.0, tolerance: "float" = 1e-2) -> "dict[str, Any]")]
    fn grow<'py>(
        &self,
        py: Python<'py>,
        stress: &Bound<'py, PyAny>,
        #[pyo3(from_py_with = number)] end: f64,
        direction: &str,
        #[pyo3(from_py_with = number)] friction: f64,
        #[pyo3(from_py_with = number)] tolerance: f64,
    ) -> Answer<Bound<'py, PyDict>> {
        let growing = of_cracks::Growing {
            direction: core::direction_named(direction)?,
            to: end,
            friction,
            tolerance,
        };
        let at = |crack: &of_cracks::Crack| -> Answer<Vec<Vec<of_cracks::PlaneStress>>> {
            let points = Self(crack.clone(), Vec::new()).points(py);
            let values = stress.call1((points,))?;
            Ok(history(values.extract()?, crack.points().len())?)
        };
        let growth = of_cracks::grow(self.0.path(), &growing, &self.1, at)?;
        let tips: Vec<_> = growth.tips.iter().map(|tip| tip.at).collect();
        let times = growth.tips.first().map_or(0, |tip| tip.cycle.len());
        let table = |f: &dyn Fn(&of_cracks::Intensity) -> f64| {
            let value = |(n, l): (usize, usize)| f(&growth.tips[l].cycle[n]);
            Array2::from_shape_fn((times, growth.tips.len()), value).into_pyarray(py)
        };
        let result = PyDict::new(py);
        result.set_item("K_I", table(&|k| k.K_I))?;
        result.set_item("K_II", table(&|k| k.K_II))?;
        result.set_item("error", table(&|k| k.error))?;
        set_path(py, &result, &tips)?;
        result.set_item("path_error", growth.error)?;
        result.set_item("end", named(growth.end))?;
        Ok(result)
    }

    fn __repr__(&self) -> String {
        let interfaces = if self.1.is_empty() {
            String::new()
        } else {
            format!(", interfaces={:?}", self.1)
        };
        format!(
            "Crack(legs={:?}, x={:?}{interfaces})",
            self.legs(),
            self.x()
        )
    }
}

attributes!(Crack, self:
    /// Place of the mouth [m].
    x: f64 = self.0.path().mouth;
    /// Length along the crack [m].
    length: f64 = self.0.length();
);
