//! Bulk stress: a uniform stress of a body along x, independent of the contact.
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
//! Fretting Fatigue (1994), sec. 5.3, for the homogeneous body). In the substrate s_xx is sigma_B.

use super::{Body, Loads, Scene};

impl Body {
    /// Strains eps_x, eps_y under the bulk stress `sigma_B` \[Pa\]; none of a rigid substrate.
    pub fn bulk_strain(&self, sigma_B: f64, plane_strain: bool) -> [f64; 2] {
        let (E, nu) = (self.substrate.E, self.substrate.nu);
        if plane_strain {
            [(1.0 - nu * nu) * sigma_B / E, 0.0]
        } else {
            [sigma_B / E, -nu * sigma_B / E]
        }
    }

    /// Stresses s_xx, s_yy \[Pa\] of a layer, their number for the substrate, under the bulk stress
    /// `sigma_B` \[Pa\] of the substrate; the other components are zero.
    pub fn bulk_stress(&self, sigma_B: f64, plane_strain: bool, layer: usize) -> [f64; 2] {
        let Some(coating) = self.coatings.get(layer) else {
            let transverse = if plane_strain { self.substrate.nu } else { 0.0 };
            return [sigma_B, transverse * sigma_B];
        };
        let (E, nu) = (coating.material.E, coating.material.nu);
        let [eps_x, eps_y] = self.bulk_strain(sigma_B, plane_strain);
        [(eps_x, eps_y), (eps_y, eps_x)]
            .map(|(own, other)| E * (own + nu * other) / (1.0 - nu * nu))
    }
}

impl Scene {
    /// Bulk strains eps_x, eps_y of body 2 minus body 1: their part of the gradients of u =
    /// u(2) - u(1).
    pub(crate) fn bulk_mismatch(&self, loads: &Loads) -> [f64; 2] {
        let bulk_strain = |body: &Body, sigma_B| body.bulk_strain(sigma_B, self.grid.plane_strain);
        let upper = bulk_strain(&self.body1, loads.sigma_B1);
        let lower = bulk_strain(&self.body2, loads.sigma_B);
        [lower[0] - upper[0], lower[1] - upper[1]]
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
                let [xx, yy] = body.bulk_stress(2e8, plane_strain, layer);
                let strains = [(xx - m.nu * yy) / m.E, (yy - m.nu * xx) / m.E];
                for (found_strain, strain) in strains.iter().zip(strain) {
                    assert!(
                        (found_strain - strain).abs() < 1e-16,
                        "{layer}: {found_strain} {strain}"
                    );
                }
            }
            // A layer of the substrate's material has the stress of the substrate.
            let [same, substrate] = [2, 3].map(|layer| body.bulk_stress(2e8, plane_strain, layer));
            for (same, of_substrate) in same.iter().zip(substrate) {
                assert!(
                    (same - of_substrate).abs() < 1e-6 * 2e8 * 1e-6,
                    "{same} {of_substrate}"
                );
            }
        }
    }
}
