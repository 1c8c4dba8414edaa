//! Closed forms of `contact_reference`.

mod cattaneo_mindlin;
mod hertz_contact;
mod hertz_stress;
mod indentation;
mod lubkin;
mod plane_strain;
mod springs;

use contact_core::Error;
use contact_core::scene as core;
use contact_reference::domain;
use ndarray::{ArrayD, IxDyn};
use numpy::PyArrayDyn;

use crate::argument::Answer;
use crate::arguments::must_fit;
use crate::hints;
use crate::material::Material;
use crate::prelude::*;

pub(crate) use cattaneo_mindlin::CattaneoMindlin;
pub(crate) use hertz_contact::{Hertz, HertzEllipse, hertz, hertz_ellipse};
pub(crate) use hertz_stress::HertzStress;
pub(crate) use indentation::{
    CoatedIndentation, CoupledIndentation, coated_indentation, coupled_indentation, dundurs_beta,
    goodman_stick_ratio,
};
pub(crate) use lubkin::Lubkin;
pub(crate) use plane_strain::{LineContact, line_contact};
pub(crate) use springs::Springs;

/// A number, a sequence or an array of any shape.
type Numbers<'py> = Array<'py, IxDyn>;

/// Numbers in the shape of those that came in.
type Values<'py> = hints::Numbers<'py>;

/// Applies `f` to every number.
fn map<'py>(x: &Numbers<'py>, f: impl Fn(f64) -> f64) -> Values<'py> {
    x.as_array().mapv(f).to_pyarray(x.py()).into()
}

/// Applies `f` to every number, after `check`.
fn map_checked<'py>(
    x: &Numbers<'py>,
    check: impl Fn(f64) -> Result<f64, Error>,
    f: impl Fn(f64) -> f64,
) -> Answer<Values<'py>> {
    checked(x, check)?;
    Ok(map(x, f))
}

/// Fails at the first number that `check` refuses; NaN passes.
fn checked(x: &Numbers<'_>, check: impl Fn(f64) -> Result<f64, Error>) -> Answer<()> {
    let array = x.as_array();
    let mut numbers = array.iter().filter(|x| !x.is_nan());
    Ok(numbers.try_for_each(|x| check(*x).map(drop))?)
}

/// Broadcasts arrays to their common shape, as numpy does; the names are for the error.
fn together<const N: usize>(places: [(&str, &Numbers<'_>); N]) -> Answer<[ArrayD<f64>; N]> {
    let rank = places.iter().map(|(_, of)| of.as_array().ndim()).max();
    let mut shape = vec![1; rank.unwrap_or(0)];
    for (_, of) in places {
        let array = of.as_array();
        for (whole, &n) in shape.iter_mut().rev().zip(array.shape().iter().rev()) {
            if *whole == 1 {
                *whole = n;
            }
        }
    }
    must_fit(shape.iter().product(), 8.0)?;
    let whole = |(name, of): (&str, &Numbers<'_>)| {
        let array = of.as_array();
        let broadcast = array.broadcast(IxDyn(&shape)).map(|whole| whole.to_owned());
        broadcast.ok_or_else(|| {
            PyValueError::new_err(format!(
                "{name} has the shape {:?}: must fit the shape of the other places, {shape:?}",
                array.shape()
            ))
        })
    };
    let arrays: Vec<_> = places.into_iter().map(whole).collect::<PyResult<_>>()?;
    Ok(arrays.try_into().expect("one for each place"))
}

/// Splits stresses into an array for each component.
fn rows<'py, const N: usize>(
    py: Python<'py>,
    stress: &ArrayD<[f64; N]>,
) -> [Bound<'py, PyArrayDyn<f64>>; N] {
    std::array::from_fn(|row| stress.mapv(|of| of[row]).to_pyarray(py))
}

/// Part of a radius by which the shapes of bodies may differ from it.
const SAME_RADIUS: f64 = 1e-6;

/// A relative radius as a closed form takes it: of spheres, or of parallel cylinders.
#[derive(Clone, Copy)]
enum Curved {
    Sphere(f64),
    Cylinder(f64),
}

/// The elastic constants of two bodies. Fails if their curvatures (xx, xy, yy, the second part of each) do not
/// add up to the radius of the closed form, `curved`; flat bodies and materials alone fit any.
fn pair_of(curved: Curved, bodies: (Material, Material)) -> Answer<(core::Elastic, core::Elastic)> {
    let [xx, xy, yy]: [f64; 3] = std::array::from_fn(|i| bodies.0.1[i] + bodies.1.1[i]);
    let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    let shapes = [mean + half, mean - half];
    let (R, expected, form) = match curved {
        Curved::Sphere(R) => (R, [1.0 / R, 1.0 / R], "spheres"),
        Curved::Cylinder(R) => (R, [1.0 / R, 0.0], "parallel cylinders"),
    };
    let differs = |(shape, expected): (&f64, &f64)| (shape - expected).abs() * R > SAME_RADIUS;
    if shapes.iter().any(|k| *k != 0.0) && shapes.iter().zip(&expected).any(differs) {
        let radius = |k: f64| {
            if k.abs() * R < SAME_RADIUS {
                "infinite".into()
            } else {
                format!("{:.6e} m", 1.0 / k)
            }
        };
        refuse!(
            "R = {R:e} m: differs from the radius of the bodies. Their shapes have the relative radii {} and {}, and this form is \
             of {form}. Give R of the shapes, or the materials alone (body.substrate). Other forms: hertz is of spheres, \
             line_contact of cylinders with W in N/m, hertz_ellipse of two radii",
            radius(shapes[0]),
            radius(shapes[1])
        );
    }
    pair(bodies)
}

/// Takes two materials; fails if both are rigid.
fn pair((body1, body2): (Material, Material)) -> Answer<(core::Elastic, core::Elastic)> {
    Ok(domain::pair((body1.0, body2.0))?)
}
