//! Shapes of the undeformed surfaces.

use crate::error::Error;

/// The undeformed surface of a body, as the height it falls back from the contact plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The contact plane itself.
    Flat,
    /// A sphere of radius R \[m\], taken as the paraboloid r^2/(2R) as in Hertz's theory.
    Sphere {
        /// Radius \[m\], positive.
        R: f64,
    },
}

impl Shape {
    /// Distance of the surface from the contact plane at (x, y) \[m\], zero at the apex.
    pub fn fall(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Sphere { R } => (x * x + y * y) / (2.0 * R),
        }
    }

    /// Curvature 1/R at the apex \[1/m\], zero for a flat.
    pub fn curvature(&self) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Sphere { R } => 1.0 / R,
        }
    }

    /// Whether the surface is its own mirror image under y -> -y.
    pub fn is_mirror_symmetric_in_y(&self) -> bool {
        match self {
            Self::Flat | Self::Sphere { .. } => true,
        }
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), Error> {
        match self {
            Self::Sphere { R } if !(R.is_finite() && *R != 0.0) => Err(Error::invalid(
                format!("{key}.sphere.R"),
                R,
                "a finite radius in m, not zero",
            )),
            _ => Ok(()),
        }
    }
}
