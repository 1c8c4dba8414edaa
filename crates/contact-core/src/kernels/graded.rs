//! Coatings whose properties change with depth, as stacks of thin homogeneous layers.

use crate::error::Error;
use crate::scene::{Coating, Elastic};

/// Largest number of layers in place of a coating: the error falls with the square of their number, and
/// a thousand layers have a millionth of it.
const MOST_LAYERS: usize = 10_000;

/// Variation of a property from the surface of a graded coating to its bottom.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// Constant over the depth.
    Constant(f64),
    /// v = top + (bottom - top) s with s = z/h from 0 to 1.
    Linear {
        /// Value at the surface.
        top: f64,
        /// Value at the bottom.
        bottom: f64,
    },
    /// v = top + (bottom - top) s^exponent.
    Power {
        /// Value at the surface.
        top: f64,
        /// Value at the bottom.
        bottom: f64,
        /// Exponent, positive.
        exponent: f64,
    },
    /// v = top (bottom/top)^s.
    Exponential {
        /// Value at the surface, of the same sign as the value at the bottom.
        top: f64,
        /// Value at the bottom.
        bottom: f64,
    },
    /// Linear between the points (s, v), s rising from 0 to 1.
    Table(Vec<(f64, f64)>),
}

impl Profile {
    /// The value at the fraction s = z/h of the thickness, from 0 at the top to 1 at the bottom.
    pub fn value_at(&self, s: f64) -> f64 {
        match self {
            Self::Constant(v) => *v,
            Self::Linear { top, bottom } => top + (bottom - top) * s,
            Self::Power {
                top,
                bottom,
                exponent,
            } => top + (bottom - top) * s.powf(*exponent),
            Self::Exponential { top, bottom } => top * (bottom / top).powf(s),
            Self::Table(points) => {
                let upper = points
                    .partition_point(|p| p.0 < s)
                    .clamp(1, points.len() - 1);
                let ((s0, v0), (s1, v1)) = (points[upper - 1], points[upper]);
                v0 + (v1 - v0) * (s - s0) / (s1 - s0)
            }
        }
    }

    /// Fails with `key` at a profile without meaning: an exponent that is not positive, ends of different sign,
    /// a table that does not rise from 0 to 1.
    fn check(&self, key: &str) -> Result<(), Error> {
        match self {
            Self::Power { exponent, .. } if !(*exponent > 0.0 && exponent.is_finite()) => Err(
                Error::invalid(format!("{key}.exponent"), exponent, "positive"),
            ),
            Self::Exponential { top, bottom } if (top * bottom).is_nan() || top * bottom <= 0.0 => {
                Err(Error::invalid(
                    format!("{key}.bottom"),
                    bottom,
                    "of the sign of the value at the surface, and not zero",
                ))
            }
            Self::Table(points) => {
                let is_increasing = points.windows(2).all(|p| p[0].0 < p[1].0);
                let end_points = [points.first(), points.last()].map(|p| p.map(|p| p.0.to_bits()));
                let covers_coating =
                    end_points == [Some(0.0_f64.to_bits()), Some(1.0_f64.to_bits())];
                if is_increasing && covers_coating {
                    return Ok(());
                }
                let allowed = "at least two points (z/h, value), z/h rising from 0 to 1";
                Err(Error::invalid(
                    format!("{key}.table"),
                    format!("{points:?}"),
                    allowed,
                ))
            }
            _ => Ok(()),
        }
    }
}

/// A coating graded in depth.
#[derive(Clone, Debug, PartialEq)]
pub struct Graded {
    /// Young's modulus E \[Pa\] over the depth.
    pub E: Profile,
    /// Poisson's ratio over the depth.
    pub nu: Profile,
    /// Thickness h \[m\].
    pub thickness: f64,
    /// Number of layers in place of it; the error falls with its square.
    pub layers: usize,
}

impl Graded {
    /// The stack of equally thick layers, outermost first, each with the properties of its middle.
    pub fn coatings(&self) -> Result<Vec<Coating>, Error> {
        self.E.check("E")?;
        self.nu.check("nu")?;
        if !(1..=MOST_LAYERS).contains(&self.layers) {
            let allowed = format!("1 to {MOST_LAYERS}");
            return Err(Error::invalid("layers", self.layers, allowed));
        }
        if !(self.thickness > 0.0 && self.thickness.is_finite()) {
            let allowed = "a positive length in m";
            return Err(Error::invalid("thickness", self.thickness, allowed));
        }
        let layer = |i: usize| {
            let s = (i as f64 + 0.5) / self.layers as f64;
            Ok(Coating {
                material: Elastic::new(self.E.value_at(s), self.nu.value_at(s))?,
                thickness: self.thickness / self.layers as f64,
            })
        };
        (0..self.layers).map(layer).collect()
    }
}
