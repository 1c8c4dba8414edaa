//! Elastic materials.

use crate::error::Error;

/// A homogeneous isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus E \[Pa\], positive; infinite for a rigid material.
    pub E: f64,
    /// Poisson's ratio nu, -1 < nu < 1/2.
    pub nu: f64,
}

impl Elastic {
    /// A material that does not deform.
    pub const RIGID: Self = Self {
        E: f64::INFINITY,
        nu: 0.0,
    };

    /// A material, checked: `E > 0` and `-1 < nu < 1/2`.
    pub fn new(E: f64, nu: f64) -> Result<Self, Error> {
        let material = Self { E, nu };
        material.check("material")?;
        Ok(material)
    }

    /// Shear modulus G = E / (2 (1 + nu)) \[Pa\].
    pub fn G(&self) -> f64 {
        self.E / (2.0 * (1.0 + self.nu))
    }

    /// Whether the material does not deform.
    pub fn is_rigid(&self) -> bool {
        self.E == f64::INFINITY
    }

    /// Fails if a property is out of its range; `key` says where the material stands in the scene.
    pub(crate) fn check(&self, key: &str) -> Result<(), Error> {
        if self.E.is_nan() || self.E <= 0.0 {
            return Err(Error::invalid(
                format!("{key}.E"),
                self.E,
                "a positive modulus in Pa",
            ));
        }
        if !(self.nu > -1.0 && self.nu < 0.5) {
            return Err(Error::invalid(
                format!("{key}.nu"),
                self.nu,
                "-1 < nu < 0.5",
            ));
        }
        Ok(())
    }
}
