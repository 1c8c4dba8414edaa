//! Elastic materials, alone, as layers and in pairs.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use material_table::{Material, find, materials, nearest};

use crate::error::Error;

/// Number of materials listed in the message for an unknown name.
const NEAREST: usize = 3;

/// A homogeneous isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus E \[Pa\], positive; infinite for a rigid material.
    pub E: f64,
    /// Poisson's ratio nu, -1 < nu <= 1/2.
    pub nu: f64,
}

impl Elastic {
    /// A material that does not deform.
    pub const RIGID: Self = Self {
        E: f64::INFINITY,
        nu: 0.0,
    };

    /// A material, checked: `E > 0` and `-1 < nu <= 1/2`.
    pub fn new(E: f64, nu: f64) -> Result<Self, Error> {
        let material = Self { E, nu };
        material.check("material")?;
        Ok(material)
    }

    /// The material of a name in the table that comes with the program, such as `Ti-6Al-4V`.
    ///
    /// # Errors
    ///
    /// There is no such material, or the table has no modulus or no Poisson's ratio of it.
    pub fn named(name: &str) -> Result<Self, Error> {
        let row = in_table("material", name)?;
        let number = |key: &str| {
            let number = row.number(key);
            number.map_err(|_| {
                let allowed = format!("a material whose {key} is in the table: give {key}");
                Error::invalid("material", name, allowed)
            })
        };
        Self::new(number("E")?, number("nu")?)
    }

    /// Shear modulus G = E / (2 (1 + nu)) \[Pa\].
    pub fn G(&self) -> f64 {
        self.E / (2.0 * (1.0 + self.nu))
    }

    /// Whether the material does not deform.
    pub fn is_rigid(&self) -> bool {
        self.E == f64::INFINITY
    }

    /// Fails if a property is out of its range; `key` is the key of the material in the scene.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        if self.E.is_nan() || self.E <= 0.0 {
            return Err(Error::invalid(
                format!("{key}.E"),
                self.E,
                "a positive modulus in Pa",
            ));
        }
        if !(self.nu > -1.0 && self.nu <= 0.5) {
            return Err(Error::invalid(
                format!("{key}.nu"),
                self.nu,
                "-1 < nu <= 0.5",
            ));
        }
        Ok(())
    }
}

/// The row of a name in the table of materials; `key` is the key of the name.
///
/// # Errors
///
/// There is none; the message has the nearest names.
pub(crate) fn in_table(key: &str, name: &str) -> Result<&'static Material, Error> {
    static TABLE: LazyLock<BTreeMap<String, Material>> = LazyLock::new(materials);
    find(&TABLE, name).ok_or_else(|| {
        let near = nearest(&TABLE, name, NEAREST).join(", ");
        let allowed = format!("the name of a material of the table; the nearest are {near}");
        Error::invalid(key, format!("{name:?}"), allowed)
    })
}

/// The bond of a layer to the one below it: springs under the traction there.
///
/// The upper side moves against the lower one by compliance times traction; tension and pressure
/// count alike, so that a bond that pulls apart holds until its strength is judged elsewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bond {
    /// Approach per pressure \[m/Pa\] (default 0, perfect).
    pub normal: f64,
    /// Slip per shear traction \[m/Pa\] (default 0, perfect); a large one is a frictionless
    /// interface.
    pub shear: f64,
}

impl Bond {
    /// A rigid bond.
    pub const PERFECT: Self = Self {
        normal: 0.0,
        shear: 0.0,
    };

    /// Bond that replaces a thin layer of a material of the thickness `h` \[m\].
    pub fn of_layer(material: Elastic, h: f64) -> Self {
        let (G, nu) = (material.G(), material.nu);
        Self {
            normal: h * (1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu)),
            shear: h / G,
        }
    }

    /// Fails if a compliance is negative or not finite; `key` is the key of the bond.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        for (name, value) in [("normal", self.normal), ("shear", self.shear)] {
            if !(value >= 0.0 && value.is_finite()) {
                let allowed = "a compliance in m/Pa, 0 (perfect) or more";
                return Err(Error::invalid(format!("{key}_{name}"), value, allowed));
            }
        }
        Ok(())
    }
}

/// A layer of constant thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coating {
    /// Material of the layer.
    pub material: Elastic,
    /// Thickness h \[m\], positive.
    pub thickness: f64,
}

impl Coating {
    /// A layer of the thickness `thickness` \[m\], checked: finite and positive.
    pub fn new(material: Elastic, thickness: f64) -> Result<Self, Error> {
        let coating = Self {
            material,
            thickness,
        };
        coating.check("coating")?;
        Ok(coating)
    }

    /// Fails if the material or the thickness is out of its range; `key` is the key of the coating.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        self.material.check(key)?;
        if !(self.thickness > 0.0 && self.thickness.is_finite()) {
            return Err(Error::invalid(
                format!("{key}.thickness"),
                self.thickness,
                "a positive length in m",
            ));
        }
        if self.material.is_rigid() {
            return Err(Error::invalid(
                format!("{key}.E"),
                self.material.E,
                "a finite modulus (a rigid layer makes the whole body rigid)",
            ));
        }
        Ok(())
    }
}

/// Dundurs' parameter beta of the pair: the coupling of normal and tangential directions.
///
/// beta = \[(1 - 2 nu1)/G1 - (1 - 2 nu2)/G2\] / (2 \[(1 - nu1)/G1 + (1 - nu2)/G2\]); zero for
/// similar bodies, at most 1/2 in size, negative when the bodies change places.
pub fn dundurs_beta(body1: Elastic, body2: Elastic) -> f64 {
    let coupling = |m: Elastic| (1.0 - 2.0 * m.nu) / m.G();
    let compliance = |m: Elastic| (1.0 - m.nu) / m.G();
    (coupling(body1) - coupling(body2)) / (2.0 * (compliance(body1) + compliance(body2)))
}
