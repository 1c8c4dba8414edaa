//! Bodies that may yield: where yielding begins in closed form, and what is refused.

use super::{KernelMethod, ResidualStress, Scene, Shape};
use crate::error::Error;

/// Largest pressure over the yield stress at which a body below a round contact begins to yield after von
/// Mises: a fit for nu = 0.2 to 0.5 (D. J. Chang et al., after K. L. Johnson, Contact Mechanics, 1985,
/// section 6.1: 1.60 for nu = 0.3).
fn first_yield_pressure_ratio(nu: f64) -> f64 {
    1.234 + 1.256 * nu
}

/// Hardness: largest mean pressure over the largest yield stress of a body whose hardening ends (D. Tabor,
/// The Hardness of Metals, 1951; K. L. Johnson, Contact Mechanics, 1985, section 6.3).
const HARDNESS_RATIO: f64 = 2.8;
/// Load at this mean pressure over the load of first yield: 0.94 (w/w_c)^1.263 at the
/// approach w = 110 w_c (L. Kogut, I. Etsion, J. Appl. Mech. 69 (2002) 657-662, eqs. 13, 14).
const FULLY_PLASTIC_LOAD_RATIO: f64 = 356.0;
/// Part of the shear yield stress s_y/sqrt(3) that the mean shear of a contact comes to where a surface without
/// hardening begins to flow: the pressure takes a part of the yield stress.
const FLOW_SHEAR_RATIO: f64 = 0.8;

/// First point that yields under a growing normal load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstYield {
    /// Normal force \[N\].
    pub W: f64,
    /// 1 or 2.
    pub body: usize,
    /// Layer from the surface down, from 0; the last one is the substrate.
    pub layer: usize,
    /// Depth of the point \[m\].
    pub depth: f64,
}

impl Scene {
    /// Fails where a layer may yield under loads or settings for which this is not computed.
    pub(super) fn check_yielding(&self) -> Result<(), Error> {
        let Some(number) = [&self.body1, &self.body2]
            .iter()
            .position(|body| body.yields())
        else {
            return Ok(());
        };
        let key = format!("body{}.plastic", number + 1);
        let refuse = |found: &str, allowed: &str| Err(Error::invalid(&key, found, allowed));
        for branch in &self.path.branches {
            if branch.to.rolled != 0.0 {
                return refuse("given, and path.rolled", "left out where the bodies roll");
            }
        }
        self.check_bulk_yielding()?;
        if self.settings.kernel.method != KernelMethod::Hankel {
            return refuse(
                "given, and another kernel.method",
                "left out, or kernel.method = \"hankel\"",
            );
        }
        self.check_mean_pressure(number + 1)
    }

    /// Fails where a bulk stress alone, with the residual stress, makes a layer yield as a whole: what yields must
    /// lie near the contact.
    fn check_bulk_yielding(&self) -> Result<(), Error> {
        for (i, branch) in self.path.branches.iter().enumerate() {
            let to = &branch.to;
            for (name, number, body, sigma_B) in [
                ("sigma_B1", 1, &self.body1, to.sigma_B1),
                ("sigma_B", 2, &self.body2, to.sigma_B),
            ] {
                if sigma_B == 0.0 || !body.yields() {
                    continue;
                }
                let residual = ResidualStress::from_body(body);
                let mut top = 0.0;
                for layer in 0..=body.coatings.len() {
                    let s_y = body.plastic(layer).map_or(f64::INFINITY, |law| law.s_y);
                    let bulk = body.bulk_stress(sigma_B, self.grid.plane_strain, (layer, top));
                    let [xx, yy] = residual.stress_at(layer, top);
                    let (xx, yy, xy) = (xx + bulk[0], yy + bulk[1], bulk[2]);
                    let von_mises = (xx * xx - xx * yy + yy * yy + 3.0 * xy * xy).sqrt();
                    if von_mises >= s_y {
                        let key = match body.coatings.get(layer) {
                            Some(_) => format!("body{number}.coatings[{layer}]"),
                            None => format!("body{number}"),
                        };
                        return Err(Error::invalid(
                            format!("path[{i}].{name}"),
                            format!(
                                "{sigma_B:.3e} Pa, in {key} a stress of von Mises of {von_mises:.3e} Pa"
                            ),
                            format!(
                                "such that this is below the yield stress, {s_y:.3e} Pa: the layer would yield as a \
                                 whole, and not near the contact alone"
                            ),
                        ));
                    }
                    top += body.coatings.get(layer).map_or(0.0, |c| c.thickness);
                }
            }
        }
        Ok(())
    }

    /// Returns the physical cause, as the end of a sentence, of an increment of yielding bodies without a
    /// solution: the mean shear \[Pa\] of the contact makes the surface flow. Empty if it is less.
    pub(crate) fn describe_shear_flow(&self, shear: f64) -> String {
        let surfaces = [&self.body1, &self.body2].map(|body| body.plastic(0));
        let strengths = surfaces
            .iter()
            .flatten()
            .map(|law| law.s_y / 3.0_f64.sqrt());
        let strength = strengths.fold(f64::INFINITY, f64::min);
        if shear < FLOW_SHEAR_RATIO * strength {
            return String::new();
        }
        format!(
            "; the surface flows in shear. The mean shear of the contact is {shear:.3e} Pa, {:.2} times the shear yield \
             stress s_y/sqrt(3) of the surface. No increment is small enough: lower the tangential load or mu, or give \
             more hardening",
            shear / strength
        )
    }

    /// Fails where the mean pressure is more than a homogeneous body without further hardening can bear.
    fn check_mean_pressure(&self, number: usize) -> Result<(), Error> {
        let bodies = [&self.body1, &self.body2];
        let largest_yield_stress = |number: usize| {
            let body = bodies[number - 1];
            let s_max = body.plastic(0).map(|law| law.most());
            let s = s_max.filter(|s_max| s_max.is_finite() && body.coatings.is_empty())?;
            Some((s, body.substrate.nu))
        };
        let Some((s_y, nu)) = largest_yield_stress(number) else {
            return Ok(());
        };
        let W = self.path.W_max();
        let fully_plastic_load = if let Some(radius) = self.punch_radius() {
            HARDNESS_RATIO * s_y * std::f64::consts::PI * radius * radius
        } else {
            let round = self
                .hertz()
                .filter(|_| !self.grid.plane_strain && self.is_round());
            let Some(hertz) = round else {
                return Ok(());
            };
            // Loads grow with the cube of the largest pressure.
            FULLY_PLASTIC_LOAD_RATIO
                * hertz.W
                * (first_yield_pressure_ratio(nu) * s_y / hertz.p0).powi(3)
        };
        if W <= fully_plastic_load {
            return Ok(());
        }
        Err(Error::invalid(
            format!("body{number}.plastic.hardening"),
            format!("0 (none), with a yield stress of at most {s_y:.3e} Pa, and W = {W:.3e} N"),
            format!(
                "above 0, or a W of at most {fully_plastic_load:.3e} N, where the mean pressure comes to {HARDNESS_RATIO} s_y of \
                 that stress. A body without more hardening bears no more"
            ),
        ))
    }

    /// Radius of a flat punch that is pressed on a flat \[m\].
    fn punch_radius(&self) -> Option<f64> {
        match (&self.body1.shape, &self.body2.shape) {
            (Shape::FlatPunch { radius, .. }, Shape::Flat)
            | (Shape::Flat, Shape::FlatPunch { radius, .. }) => Some(*radius),
            _ => None,
        }
    }

    /// Whether the two principal curvatures of the gap are equal.
    fn is_round(&self) -> bool {
        let (k_1, k_2) = self.principal_curvatures();
        k_1 - k_2 <= 1e-9 * k_1
    }
}
