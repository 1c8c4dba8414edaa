//! Indentation: with friction of dissimilar bodies, and without friction of a coated body.

use contact_reference as core;
use contact_reference::domain::{between, positive};

use super::{Curved, Numbers, Values, map, pair, pair_of};
use crate::argument::Answer;
use crate::material::{Coating, Elastic, Material};
use crate::prelude::*;

/// Dundurs' parameter beta of the pair: the coupling of normal and tangential directions.
///
/// beta = [(1 - 2 nu1)/G1 - (1 - 2 nu2)/G2] / (2 [(1 - nu1)/G1 + (1 - nu2)/G2])
#[pyfunction]
pub(crate) fn dundurs_beta(body1: Material, body2: Material) -> PyResult<f64> {
    let (body1, body2) = pair((body1, body2))?;
    Ok(core::dundurs_beta(body1, body2))
}

/// Stick over contact radius of an indentation with friction, after Goodman and Spence.
///
/// (1/(2 c)) ln[(1 + c)/(1 - c)] = (mu/abs(beta)) K(sqrt(1 - c^2)); the effect of the shear on the
/// pressure is neglected.
#[pyfunction]
#[pyo3(signature = (*, beta: "float", mu: "float"))]
pub(crate) fn goodman_stick_ratio(
    #[pyo3(from_py_with = number)] beta: f64,
    #[pyo3(from_py_with = number)] mu: f64,
) -> PyResult<f64> {
    check(beta, mu)?;
    Ok(core::goodman_stick_ratio(beta, mu))
}

/// Checks Dundurs' parameter and the coefficient of friction.
fn check(beta: f64, mu: f64) -> Answer<()> {
    let beta = between("beta", beta, (-0.5, 0.5));
    Ok(beta.and(positive("mu", mu)).map(drop)?)
}

/// Indentation with friction of dissimilar bodies, fully coupled, in numbers without load.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CoupledIndentation {
    found: core::CoupledIndentation,
    /// Dundurs' parameter.
    #[pyo3(get)]
    beta: f64,
    /// Friction coefficient.
    #[pyo3(get)]
    mu: f64,
}

made!(CoupledIndentation by "coupled_indentation": beta, mu);

attributes!(CoupledIndentation, self:
    /// Stick radius over contact radius.
    stick_ratio: f64 = self.found.stick_ratio;
    /// Central pressure over 3 W / (2 pi a^2).
    p0: f64 = self.found.p0;
    /// Approach over a^2/R.
    delta_z: f64 = self.found.delta_z;
    /// Normal force over 4 E* a^3 / (3 R).
    W: f64 = self.found.W;
);

/// Indentation by a sphere for Dundurs' `beta` and friction `mu` > 0.
///
/// The problem is D. A. Spence's, J. Elasticity 5 (1975) 297: the contact grows without changing
/// its shape.
#[pyfunction]
#[pyo3(signature = (*, beta: "float", mu: "float"))]
pub(crate) fn coupled_indentation(
    #[pyo3(from_py_with = number)] beta: f64,
    #[pyo3(from_py_with = number)] mu: f64,
) -> PyResult<CoupledIndentation> {
    check(beta, mu)?;
    let solution = core::coupled_indentation(beta, mu);
    Ok(CoupledIndentation {
        found: solution,
        beta,
        mu,
    })
}

/// Frictionless contact of a sphere with a body that has one coating.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CoatedIndentation {
    found: core::CoatedIndentation,
    /// Radius of the sphere [m].
    #[pyo3(get)]
    R: f64,
    /// Material of the sphere.
    #[pyo3(get)]
    indenter: Elastic,
    /// The coating.
    #[pyo3(get)]
    coating: Coating,
    /// Material below the coating.
    #[pyo3(get)]
    substrate: Elastic,
    /// Normal force [N].
    #[pyo3(get)]
    W: f64,
}

made!(CoatedIndentation by "coated_indentation": R, indenter, coating, substrate, W);

#[pymethods]
impl CoatedIndentation {
    /// Pressure at distance `r` [m] from the middle [Pa].
    fn p<'py>(&self, r: Numbers<'py>) -> Values<'py> {
        map(&r, |r| self.found.p(r))
    }
}

attributes!(CoatedIndentation, self:
    /// Contact radius [m].
    a: f64 = self.found.a;
    /// Approach [m].
    delta_z: f64 = self.found.delta_z;
);

/// Contact of a sphere of radius `R` [m] with a coated body under `W` [N], without friction.
#[pyfunction]
#[pyo3(signature = (*, R: "Radius", indenter, coating, substrate, W: "PointForce"))]
pub(crate) fn coated_indentation(
    #[pyo3(from_py_with = Given::R)] R: f64,
    indenter: Material,
    coating: Coating,
    substrate: Material,
    #[pyo3(from_py_with = Given::point_W)] W: f64,
) -> Answer<CoatedIndentation> {
    positive("R", R).and(positive("W", W))?;
    pair_of(Curved::Sphere(R), (indenter, substrate))?;
    let film = Material::without_shape(coating.layer.material);
    let bare = |body: Material| Material::without_shape(body.0);
    pair((bare(indenter), film))?;
    pair((film, bare(substrate)))?;
    let film = coating.clone();
    let (indenter, coating, substrate) = (indenter.0, coating.layer, substrate.0);
    positive("coating.thickness", coating.thickness)?;
    let solution = core::coated_indentation(R, indenter, coating, substrate, W);
    Ok(CoatedIndentation {
        found: solution?,
        R,
        indenter: Elastic(indenter, None),
        coating: film,
        substrate: Elastic(substrate, None),
        W,
    })
}
