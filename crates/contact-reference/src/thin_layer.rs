//! A sphere on a layer much thinner than the contact, bonded to a rigid base.

use std::f64::consts::PI;

use contact_core::scene::Elastic;

/// Axisymmetric indentation of a thin layer by a sphere of radius R.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinLayerContact {
    /// Contact radius a \[m\].
    pub a: f64,
    /// Peak pressure \[Pa\].
    pub p0: f64,
    /// Approach \[m\].
    pub delta_z: f64,
}

/// Modulus of a layer whose sideways strain is held, M = 2 G (1 - nu)/(1 - 2 nu) \[Pa\].
pub fn confined_modulus(layer: Elastic) -> f64 {
    2.0 * layer.G() * (1.0 - layer.nu) / (1.0 - 2.0 * layer.nu)
}

/// Rigid frictionless sphere of radius `R` on a compressible layer of thickness `h` \[m\] under
/// `W` \[N\], for a >> h: each column carries p = (M/h) (delta_z - r^2/(2 R)) for itself, so
/// a^2 = 2 R delta_z and W = pi M a^4/(4 h R). K. L. Johnson, Contact Mechanics (1985), sec. 5.8;
/// M is [`confined_modulus`].
pub fn thin_compressible_layer(R: f64, layer: Elastic, h: f64, W: f64) -> ThinLayerContact {
    let M = confined_modulus(layer);
    let a = (4.0 * h * R * W / (PI * M)).sqrt().sqrt();
    let delta_z = a * a / (2.0 * R);
    ThinLayerContact {
        a,
        p0: M / h * delta_z,
        delta_z,
    }
}

/// Rigid frictionless sphere of radius `R` on an incompressible layer (nu -> 1/2) of shear modulus
/// `G` \[Pa\] and thickness `h` \[m\] under `W` \[N\], for a >> h (derived): the material can only
/// flow sideways, -(h^3/(3 G)) laplace(p) = delta_z - r^2/(2 R) with p and its slope zero at the
/// edge, so p = p0 (1 - r^2/a^2)^2, p0 = 3 G a^4/(32 R h^3), W = pi G a^6/(32 R h^3), delta_z =
/// a^2/(4 R).
pub fn thin_incompressible_layer(R: f64, G: f64, h: f64, W: f64) -> ThinLayerContact {
    let a = (32.0 * R * h.powi(3) * W / (PI * G)).cbrt().sqrt();
    ThinLayerContact {
        a,
        p0: 3.0 * G * a.powi(4) / (32.0 * R * h.powi(3)),
        delta_z: a * a / (4.0 * R),
    }
}
