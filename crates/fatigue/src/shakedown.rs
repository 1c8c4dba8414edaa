//! First yield and elastic shakedown, as factors on the load.
//!
//! Melan: a body shakes down to elastic cycles if a constant self-equilibrated stress exists with
//! which the elastic stress of the cycle stays within the yield surface everywhere. At a point, the
//! constant deviatoric stress that serves best is the opposite of the centre of the smallest sphere
//! round its path; von Mises' surface has the radius s_y/sqrt 3 there. The equilibrium of this
//! stress from point to point is not required, so the factor is an upper bound of the shakedown
//! load.
//!
//! E. Melan, Ing.-Arch. 9 (1938) 116-126; K. L. Johnson, Contact Mechanics (1985) section 9.2.

use std::sync::atomic::AtomicBool;

use ndarray::ArrayView3;
use stress_tensor::{StressTensor, tresca, von_mises};

use crate::ball::Search as Balls;
use crate::error::Error;
use crate::evaluate::map_points;
use crate::history::History;
use crate::invariants::{deviatoric_sphere, from_deviatoric};

/// Load factors of a point: the loads times the factor just reach the limit; infinite without
/// stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yield {
    /// Factor of first yield by von Mises' condition, constant stresses not scaled.
    pub von_mises: f64,
    /// Factor of first yield by Tresca's condition.
    pub tresca: f64,
    /// Factor at the end of elastic shakedown, by von Mises' condition; an upper bound.
    pub shakedown: f64,
    /// The constant deviatoric stress that serves shakedown best, under the loads as they are
    /// \[Pa\].
    pub residual: StressTensor,
}

/// First yield and shakedown of stresses of shape (time, points, 6) \[Pa\] that grow with the load,
/// on top of one constant stress \[Pa\] (a residual stress) that does not.
///
/// Fails as [`crate::evaluate`] does, and if the yield stress `s_y` \[Pa\] is not positive or the
/// constant stress alone exceeds it.
pub fn yielding(
    stress: &ArrayView3<'_, f64>,
    s_y: f64,
    constant: &StressTensor,
    stop: &AtomicBool,
) -> Result<Vec<Yield>, Error> {
    if !(s_y > 0.0 && s_y.is_finite()) {
        return Err(Error::argument("s_y", s_y, "a positive yield stress in Pa"));
    }
    let constant_tresca = tresca(constant);
    if constant_tresca > s_y {
        let allowed = format!("within the yield stress {s_y:e} Pa by Tresca's condition");
        return Err(Error::argument(
            "constant stress",
            format!("{constant_tresca:e} Pa"),
            allowed,
        ));
    }
    History::elastic(stress).check()?;
    let points = map_points(stress, None, stop, |balls: &mut Balls<5>, histories| {
        let path = &histories.stress;
        // Everything in the unit of the path.
        let unit = path.unit();
        let (s_y, constant) = (s_y / unit, constant.map(|s| s / unit));
        let min_factor = |equivalent: fn(&StressTensor) -> f64| {
            let factors = path
                .instants()
                .map(|s| yield_factor(&s, &constant, s_y, equivalent));
            factors.fold(f64::INFINITY, f64::min)
        };
        let sphere = deviatoric_sphere(path, balls);
        Yield {
            von_mises: min_factor(von_mises),
            tresca: min_factor(tresca),
            shakedown: s_y / 3.0_f64.sqrt() / sphere.radius,
            residual: from_deviatoric(sphere.centre).map(|s| -unit * s),
        }
    })?;
    let no_yield = Yield {
        von_mises: f64::INFINITY,
        tresca: f64::INFINITY,
        shakedown: f64::INFINITY,
        residual: [0.0; 6],
    };
    Ok(points.into_iter().map(|p| p.unwrap_or(no_yield)).collect())
}

/// The smallest f > 0 for which the equivalent stress of constant + f s reaches s_y; infinite if none does.
/// Equivalent stresses are convex along f and at most s_y at f = 0.
fn yield_factor(
    s: &StressTensor,
    constant: &StressTensor,
    s_y: f64,
    equivalent: fn(&StressTensor) -> f64,
) -> f64 {
    let (varying, fixed) = (equivalent(s), equivalent(constant));
    if varying <= 0.0 {
        return f64::INFINITY;
    }
    // By the triangle inequality the factor lies between these.
    let (mut low, mut high) = ((s_y - fixed) / varying, (s_y + fixed) / varying);
    if fixed <= 0.0 {
        return low;
    }
    let equivalent_at = |f: f64| equivalent(&std::array::from_fn(|c| constant[c] + f * s[c]));
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if equivalent_at(middle) > s_y {
            high = middle;
        } else {
            low = middle;
        }
    }
    f64::midpoint(low, high)
}
