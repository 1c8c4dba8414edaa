//! First yield and elastic shakedown, as factors on the load.
//!
//! Melan: a body shakes down to elastic cycles if a constant self-equilibrated stress exists with
//! which the elastic stress of the cycle stays within the yield surface everywhere. At a point, the
//! constant deviatoric stress that serves best is the opposite of the centre of the smallest sphere
//! round its path; von Mises' surface has the radius s_y/sqrt 3 there. That this stress balances
//! itself from point to point is not asked, so the factor is an upper bound of the shakedown load.
//!
//! E. Melan, Ing.-Arch. 9 (1938) 116-126; K. L. Johnson, Contact Mechanics (1985) section 9.2.

use std::sync::atomic::AtomicBool;

use ndarray::ArrayView3;
use stress_tensor::{StressTensor, tresca, von_mises};

use crate::ball::Search as Balls;
use crate::error::Error;
use crate::evaluate::over_points;
use crate::history::History;
use crate::invariants::{sphere, tensor};

/// Load factors of a point: the loads times the factor just reach the limit; infinite without
/// stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yield {
    /// To first yield by von Mises' condition, constant stresses not scaled.
    pub von_mises: f64,
    /// To first yield by Tresca's condition.
    pub tresca: f64,
    /// To the end of elastic shakedown, by von Mises' condition; an upper bound.
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
    let alone = tresca(constant);
    if alone > s_y {
        let allowed = format!("within the yield stress {s_y:e} Pa by Tresca's condition");
        return Err(Error::argument(
            "constant stress",
            format!("{alone:e} Pa"),
            allowed,
        ));
    }
    History::elastic(stress).check()?;
    let points = over_points(stress, None, stop, |balls: &mut Balls<5>, of| {
        let path = &of.stress;
        // Everything in the unit of the path.
        let unit = path.unit();
        let (s_y, constant) = (s_y / unit, constant.map(|s| s / unit));
        let least = |equivalent: fn(&StressTensor) -> f64| {
            let factors = path
                .instants()
                .map(|s| factor(&s, &constant, s_y, equivalent));
            factors.fold(f64::INFINITY, f64::min)
        };
        let sphere = sphere(path, balls);
        Yield {
            von_mises: least(von_mises),
            tresca: least(tresca),
            shakedown: s_y / 3.0_f64.sqrt() / sphere.radius,
            residual: tensor(sphere.centre).map(|s| -unit * s),
        }
    })?;
    let never = Yield {
        von_mises: f64::INFINITY,
        tresca: f64::INFINITY,
        shakedown: f64::INFINITY,
        residual: [0.0; 6],
    };
    Ok(points.into_iter().map(|p| p.unwrap_or(never)).collect())
}

/// The smallest positive f for which the equivalent stress of constant + f s is s_y. Equivalent
/// stresses are convex along f and at most s_y at f = 0.
fn factor(
    s: &StressTensor,
    constant: &StressTensor,
    s_y: f64,
    equivalent: fn(&StressTensor) -> f64,
) -> f64 {
    let (own, held) = (equivalent(s), equivalent(constant));
    if own <= 0.0 {
        return f64::INFINITY;
    }
    // By the triangle inequality the factor lies between these.
    let (mut low, mut high) = ((s_y - held) / own, (s_y + held) / own);
    if held <= 0.0 {
        return low;
    }
    let at = |f: f64| equivalent(&std::array::from_fn(|c| constant[c] + f * s[c]));
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if at(middle) > s_y {
            high = middle;
        } else {
            low = middle;
        }
    }
    f64::midpoint(low, high)
}
