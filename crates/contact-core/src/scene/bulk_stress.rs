//! Bulk stress: the stress of a body as a whole along its axis, independent of the contact: a membrane stress, or
//! bending about a neutral plane.
//!
//! Layers that are bonded to the substrate are stretched as it is, and no traction acts on planes
//! z = const. So the strains eps_x, eps_y are equal at every depth, and each layer
//! has the stress that belongs to them with s_zz = s_xz = s_yz = 0 (derived from Hooke's law):
//!
//! ```text
//! eps_x = sigma_B/E,  eps_y = -nu sigma_B/E                   free to contract along y
//! eps_x = (1 - nu^2) sigma_B/E,  eps_y = 0                    plane strain
//! s_xx = E' (eps_x + nu' eps_y)/(1 - nu'^2),  s_yy = E' (eps_y + nu' eps_x)/(1 - nu'^2)
//! ```
//!
//! with E and nu of the substrate, E' and nu' of the layer (D. A. Hills, D. Nowell, Mechanics of
//! Fretting Fatigue (1994), sec. 5.3, for the homogeneous body). In the substrate s_xx is sigma_B. Here x is the
//! direction of the bulk stress, of the azimuth a. With c = cos a, s = sin a the components of the scene are
//!
//! ```text
//! xx = s_1 c^2 + s_2 s^2,   yy = s_1 s^2 + s_2 c^2,   xy = (s_1 - s_2) s c
//! ```
//!
//! of stresses and of strains alike. In bending all of them are 1 - z/z_n times the ones at the surface, z_n being
//! the depth of the neutral plane.

use super::{Body, Loads, Scene, Shape};
use crate::error::Error;

/// Components xx, yy, xy of a plane tensor with these principal values along and across an azimuth \[rad\].
fn turned([along, across]: [f64; 2], azimuth: f64) -> [f64; 3] {
    if azimuth == 0.0 {
        return [along, across, 0.0];
    }
    let (s, c) = azimuth.sin_cos();
    [
        along * c * c + across * s * s,
        along * s * s + across * c * c,
        (along - across) * s * c,
    ]
}

impl Body {
    /// Azimuth of the bulk stress \[rad\]: the given one, the azimuth of the axis of a cylinder, else 0.
    pub fn bulk_azimuth(&self, plane_strain: bool) -> f64 {
        if plane_strain {
            return 0.0;
        }
        let axis = match self.shape {
            // The axis is y turned by the angle.
            Shape::Cylinder { angle, .. }
            | Shape::CrownedRoller { angle, .. }
            | Shape::Ridges { angle, .. } => std::f64::consts::FRAC_PI_2 + angle,
            _ => 0.0,
        };
        let azimuth = self.bulk.azimuth.unwrap_or(axis);
        // Along x without the rounding of half a turn.
        let turns = azimuth / std::f64::consts::PI;
        if (turns - turns.round()).abs() < 1e-15 {
            0.0
        } else {
            azimuth
        }
    }

    /// Fails at a direction or a neutral plane that has no meaning.
    pub(crate) fn check_bulk(&self, key: &str, plane_strain: bool) -> Result<(), Error> {
        if let Some(azimuth) = self.bulk.azimuth
            && (!azimuth.is_finite() || (plane_strain && azimuth != 0.0))
        {
            let allowed = if plane_strain {
                "0 in plane strain: along x"
            } else {
                "a finite angle in rad"
            };
            return Err(Error::invalid(
                format!("{key}.bulk_azimuth"),
                azimuth,
                allowed,
            ));
        }
        match self.bulk.neutral_depth {
            Some(depth) if depth == 0.0 || !depth.is_finite() => Err(Error::invalid(
                format!("{key}.bulk_neutral_depth"),
                depth,
                "a depth in m other than 0: the surface has the bulk stress",
            )),
            _ => Ok(()),
        }
    }

    /// Bulk stress at a depth \[m\] over its value at the surface.
    fn bulk_course(&self, z: f64) -> f64 {
        self.bulk
            .neutral_depth
            .map_or(1.0, |neutral| 1.0 - z / neutral)
    }

    /// Strains along and across the bulk stress `sigma_B` \[Pa\] at the surface; none of a rigid substrate.
    pub fn bulk_strain(&self, sigma_B: f64, plane_strain: bool) -> [f64; 2] {
        let (E, nu) = (self.substrate.E, self.substrate.nu);
        if plane_strain {
            [(1.0 - nu * nu) * sigma_B / E, 0.0]
        } else {
            [sigma_B / E, -nu * sigma_B / E]
        }
    }

    /// Stresses s_xx, s_yy, s_xy \[Pa\] at a depth \[m\] in a layer, its number for the substrate, under the
    /// bulk stress `sigma_B` \[Pa\] of the substrate at the surface; the other components are zero.
    pub fn bulk_stress(
        &self,
        sigma_B: f64,
        plane_strain: bool,
        (layer, z): (usize, f64),
    ) -> [f64; 3] {
        let principal = match self.coatings.get(layer) {
            None => {
                let across = if plane_strain { self.substrate.nu } else { 0.0 };
                [sigma_B, across * sigma_B]
            }
            Some(coating) => {
                let (E, nu) = (coating.material.E, coating.material.nu);
                let [along, across] = self.bulk_strain(sigma_B, plane_strain);
                [(along, across), (across, along)]
                    .map(|(one, two)| E * (one + nu * two) / (1.0 - nu * nu))
            }
        };
        let course = self.bulk_course(z);
        turned(principal, self.bulk_azimuth(plane_strain)).map(|s| course * s)
    }
}

impl Scene {
    /// Bulk strains eps_xx, eps_yy, eps_xy at the surface of body 2 less the strains of body 1: their part of the
    /// gradients of u = u(2) - u(1).
    pub(crate) fn bulk_mismatch(&self, loads: &Loads) -> [f64; 3] {
        let plane_strain = self.grid.plane_strain;
        let strain = |body: &Body, sigma_B| {
            turned(
                body.bulk_strain(sigma_B, plane_strain),
                body.bulk_azimuth(plane_strain),
            )
        };
        let upper = strain(&self.body1, loads.sigma_B1);
        let lower = strain(&self.body2, loads.sigma_B);
        std::array::from_fn(|k| lower[k] - upper[k])
    }

    /// Whether a bulk stress of the path acts neither along x nor along y.
    pub(crate) fn has_oblique_bulk_stress(&self) -> bool {
        self.path.branches.iter().any(|branch| {
            let to = &branch.to;
            [(to.sigma_B1, &self.body1), (to.sigma_B, &self.body2)]
                .iter()
                .any(|(sigma_B, body)| {
                    let [_, _, xy] = turned([1.0, 0.0], body.bulk_azimuth(self.grid.plane_strain));
                    *sigma_B != 0.0 && xy.abs() > 1e-12
                })
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Body, Coating, Elastic, Shape};

    /// Inverts Hooke's law: every layer has the strains of the substrate.
    #[test]
    fn layers_are_stretched_alike() {
        let mut body = Body::homogeneous(Elastic { E: 210e9, nu: 0.3 }, Shape::Flat);
        for (E, nu) in [(600e9, 0.2), (3e9, 0.45), (210e9, 0.3)] {
            let material = Elastic { E, nu };
            let thickness = 1e-5;
            body.coatings.push(Coating {
                material,
                thickness,
            });
        }
        for plane_strain in [false, true] {
            let strain = body.bulk_strain(2e8, plane_strain);
            for layer in 0..4 {
                let m = body
                    .coatings
                    .get(layer)
                    .map_or(body.substrate, |c| c.material);
                let [xx, yy, _] = body.bulk_stress(2e8, plane_strain, (layer, 0.0));
                let computed = [(xx - m.nu * yy) / m.E, (yy - m.nu * xx) / m.E];
                for (computed, strain) in computed.iter().zip(strain) {
                    assert!(
                        (computed - strain).abs() < 1e-16,
                        "{layer}: {computed} {strain}"
                    );
                }
            }
            // A layer of the substrate's material is no layer.
            let [same, own] = [2, 3].map(|layer| body.bulk_stress(2e8, plane_strain, (layer, 0.0)));
            for (same, own) in same.iter().zip(own) {
                assert!((same - own).abs() < 1e-6 * 2e8 * 1e-6, "{same} {own}");
            }
        }
    }

    /// The closed transformation: along the axis of a cylinder sigma_B, across it and on it nothing.
    #[test]
    fn the_stress_acts_along_the_axis() {
        for angle in [0.0_f64, 0.4, 1.0, -2.0] {
            for given in [None, Some(0.3)] {
                let shape = Shape::Cylinder {
                    R: 1e-3,
                    length: f64::INFINITY,
                    angle,
                };
                let mut body = Body::homogeneous(Elastic { E: 210e9, nu: 0.3 }, shape);
                body.bulk.azimuth = given;
                body.bulk.neutral_depth = Some(1e-3);
                let azimuth = given.unwrap_or(angle + std::f64::consts::FRAC_PI_2);
                let (s, c) = azimuth.sin_cos();
                for (z, course) in [(0.0, 1.0), (0.25e-3, 0.75), (2e-3, -1.0)] {
                    let [xx, yy, xy] = body.bulk_stress(4e8, false, (0, z));
                    let along = xx * c * c + 2.0 * xy * s * c + yy * s * s;
                    let across = xx * s * s - 2.0 * xy * s * c + yy * c * c;
                    let shear = (yy - xx) * s * c + xy * (c * c - s * s);
                    for (computed, right) in [(along, course * 4e8), (across, 0.0), (shear, 0.0)] {
                        assert!(
                            (computed - right).abs() < 1e-6 * 4e8,
                            "{angle}: {computed} {right}"
                        );
                    }
                }
            }
        }
    }
}
