//! The range of K below which a crack does not grow.

use std::f64::consts::PI;

use super::Error;
use super::curve::Extremes;

/// How growth depends on the load ratio R = K_min/K_max at R > 0; at R <= 0 the crack is closed
/// for a part of the cycle, and only the positive part of K counts: R = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LoadRatio {
    /// The range of K alone decides.
    #[default]
    None,
    /// The range dK acts like dK (1 - R)^(gamma - 1) at R = 0; gamma in 0..=1.
    ///
    /// K. Walker, ASTM STP 462 (1970) 1-14.
    Walker {
        /// Exponent: 1 no dependence, 0 the largest K alone decides.
        gamma: f64,
    },
    /// Threshold at R over that at R = 0, linear between rows of (R, ratio), constant beyond them.
    Table(Vec<(f64, f64)>),
}

/// Threshold range of K and how it depends on the length of the crack and on the load ratio.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// Threshold of long cracks, positive part of the range at R <= 0 \[Pa m^0.5\].
    pub dK_th: f64,
    /// Range of stress (its positive part) at the fatigue limit of a smooth body \[Pa\]; with it
    /// short cracks have El Haddad's threshold, without it the constant one.
    pub dS_0: Option<f64>,
    /// Geometry factor Y in El Haddad's a_0.
    pub Y: f64,
    /// Dependence on the load ratio.
    pub ratio: LoadRatio,
}

impl Threshold {
    /// Fails at values that no material has.
    pub fn check(&self) -> Result<(), Error> {
        let positive = |key: &str, value: f64, unit: &str| {
            if value > 0.0 && value.is_finite() {
                return Ok(());
            }
            Err(Error::invalid(key, value, format!("above 0{unit}")))
        };
        positive("dK_th", self.dK_th, " Pa m^0.5")?;
        positive("Y", self.Y, "")?;
        if let Some(dS_0) = self.dS_0 {
            positive("dS_0", dS_0, " Pa")?;
        }
        match &self.ratio {
            LoadRatio::None => Ok(()),
            LoadRatio::Walker { gamma } if (0.0..=1.0).contains(gamma) => Ok(()),
            LoadRatio::Walker { gamma } => Err(Error::invalid("gamma", gamma, "0 to 1")),
            LoadRatio::Table(rows) => {
                let ascending = rows.windows(2).all(|w| w[0].0 < w[1].0);
                let allowed =
                    |(r, ratio): &(f64, f64)| *r < 1.0 && *ratio > 0.0 && ratio.is_finite();
                if rows.is_empty() || !ascending || !rows.iter().all(allowed) {
                    let rule = "rows of (R, ratio) with R ascending below 1 and ratios above 0";
                    return Err(Error::invalid("table of R", format!("{rows:?}"), rule));
                }
                Ok(())
            }
        }
    }

    /// a_0 = (dK_th/(Y dS_0))^2/pi \[m\], 0 for the constant threshold.
    ///
    /// M. H. El Haddad, K. N. Smith, T. H. Topper, J. Eng. Mater. Technol. 101 (1979) 42-46.
    pub fn a_0(&self) -> f64 {
        self.dS_0
            .map_or(0.0, |dS_0| (self.dK_th / (self.Y * dS_0)).powi(2) / PI)
    }

    /// Threshold of a crack of the length `l` \[m\] at R = 0: dK_th sqrt(l/(l + a_0)) \[Pa m^0.5\].
    pub fn at_length(&self, l: f64) -> f64 {
        self.dK_th * (l / (l + self.a_0())).sqrt()
    }

    /// The range of K \[Pa m^0.5\] that acts alike at the load ratio R = 0.
    pub fn equivalent(&self, k: Extremes) -> f64 {
        let (range, R) = (k.range(), k.ratio());
        match &self.ratio {
            LoadRatio::None => range,
            LoadRatio::Walker { gamma } => range * (1.0 - R).powf(gamma - 1.0),
            LoadRatio::Table(rows) => range / interpolated(rows, R),
        }
    }
}

/// The threshold at the load ratio R, linear between the rows of a table.
fn interpolated(rows: &[(f64, f64)], R: f64) -> f64 {
    let after = rows.partition_point(|row| row.0 < R);
    match (after.checked_sub(1).map(|n| rows[n]), rows.get(after)) {
        (Some((r0, f0)), Some((r1, f1))) => f0 + (f1 - f0) * (R - r0) / (r1 - r0),
        (Some((_, f)), None) | (None, Some(&(_, f))) => f,
        (None, None) => 1.0,
    }
}
