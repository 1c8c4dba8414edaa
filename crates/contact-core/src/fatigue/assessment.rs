//! A criterion with its limit and its curve of lives, from the data of a material.

use super::criterion::Criterion;
use super::life::{Basquin, CoffinManson};
use super::material::Material;
use crate::error::Error;

/// Names of the criteria, as [`Criterion::name`] gives them.
pub const CRITERIA: [&str; 8] = [
    "crossland",
    "dang_van",
    "findley",
    "matake",
    "mcdiarmid",
    "smith_watson_topper",
    "fatemi_socie",
    "brown_miller",
];

/// A criterion and what its values mean for a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment {
    /// The criterion with the weights of the material.
    pub criterion: Criterion,
    /// What the values are compared with.
    pub judge: Judge,
}

/// What a value is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judge {
    /// A limit for endless life, in the unit of the value.
    Limit(f64),
    /// A curve of lives.
    Life(CoffinManson),
}

impl Assessment {
    /// The criterion `name` with the numbers of a material.
    ///
    /// The weights follow from the fatigue limits in fully reversed bending or tension s_D and
    /// torsion t_D, for which the criterion is to give the same (derived from its definition):
    ///
    /// ```text
    /// Crossland   alpha = 3 t_D/s_D - sqrt 3,         limit t_D
    /// Dang Van    alpha = 3 t_D/s_D - 3/2,            limit t_D
    /// Matake      k = 2 t_D/s_D - 1,                  limit t_D
    /// Findley     k/sqrt(1 + k^2) = 2 t_D/s_D - 1,    limit t_D sqrt(1 + k^2)
    /// McDiarmid   k = t_D/(2 s_u),                    limit t_D
    /// ```
    ///
    /// The other three take E, nu, s_y, k, S and the strain-life curve s_f, b, e_f, c.
    pub fn of(name: &str, material: &Material) -> Result<Self, Error> {
        let number = |name: &str| material.number(name);
        let limits = || Ok::<_, Error>((number("s_D")?, number("t_D")?));
        let (criterion, judge) = match name {
            "crossland" => {
                let (s_D, t_D) = limits()?;
                let alpha = 3.0 * t_D / s_D - 3.0_f64.sqrt();
                (Criterion::Crossland { alpha }, Judge::Limit(t_D))
            }
            "dang_van" => {
                let (s_D, t_D) = limits()?;
                let alpha = 3.0 * t_D / s_D - 1.5;
                (Criterion::DangVan { alpha }, Judge::Limit(t_D))
            }
            "matake" => {
                let (s_D, t_D) = limits()?;
                let k = 2.0 * t_D / s_D - 1.0;
                (Criterion::Matake { k }, Judge::Limit(t_D))
            }
            "findley" => {
                let (s_D, t_D) = limits()?;
                let sine = 2.0 * t_D / s_D - 1.0;
                if sine >= 1.0 {
                    let allowed = "below s_D: the limits fit no weight of Findley's";
                    return Err(Error::invalid("t_D", t_D, allowed));
                }
                let cosine = (1.0 - sine * sine).sqrt();
                let criterion = Criterion::Findley { k: sine / cosine };
                (criterion, Judge::Limit(t_D / cosine))
            }
            "mcdiarmid" => {
                let t_D = number("t_D")?;
                let k = t_D / (2.0 * number("s_u")?);
                (Criterion::McDiarmid { k }, Judge::Limit(t_D))
            }
            "smith_watson_topper" => {
                let (E, nu) = (number("E")?, number("nu")?);
                (
                    Criterion::SmithWatsonTopper { E, nu },
                    Judge::Life(strain_life(material)?),
                )
            }
            "fatemi_socie" => {
                let (E, nu) = (number("E")?, number("nu")?);
                let (k, s_y) = (number("k")?, number("s_y")?);
                (
                    Criterion::FatemiSocie { E, nu, k, s_y },
                    Judge::Life(strain_life(material)?),
                )
            }
            "brown_miller" => {
                let (E, nu, S) = (number("E")?, number("nu")?, number("S")?);
                (
                    Criterion::BrownMiller { E, nu, S },
                    Judge::Life(strain_life(material)?),
                )
            }
            _ => {
                let allowed = format!("one of {}", CRITERIA.join(", "));
                return Err(Error::invalid("criterion", name, allowed));
            }
        };
        criterion.check()?;
        Ok(Self { criterion, judge })
    }

    /// Limit over value: how often the stress may be multiplied; infinite where the value is not
    /// positive. NaN for criteria that give lives.
    pub fn safety_factor(&self, value: f64) -> f64 {
        match self.judge {
            Judge::Limit(_) if value <= 0.0 => f64::INFINITY,
            Judge::Limit(limit) => limit / value,
            Judge::Life(_) => f64::NAN,
        }
    }

    /// Cycles until a crack has started; for criteria with a limit, infinite below it and NaN above.
    pub fn life(&self, value: f64) -> f64 {
        let Judge::Life(curve) = self.judge else {
            let below = self.safety_factor(value) >= 1.0;
            return if below { f64::INFINITY } else { f64::NAN };
        };
        match self.criterion {
            Criterion::FatemiSocie { nu, k, s_y, .. } => curve.fatemi_socie_life(value, nu, k, s_y),
            Criterion::BrownMiller { nu, S, .. } => curve.brown_miller_life(value, nu, S),
            _ => curve.smith_watson_topper_life(value),
        }
    }
}

/// The strain-life curve of a material.
pub fn strain_life(material: &Material) -> Result<CoffinManson, Error> {
    let number = |name: &str| material.number(name);
    let curve = CoffinManson {
        E: number("E")?,
        elastic: Basquin {
            coefficient: number("s_f")?,
            exponent: number("b")?,
        },
        ductility: number("e_f")?,
        exponent: number("c")?,
    };
    curve.check()?;
    Ok(curve)
}
