//! A criterion with its limit and its curve of lives, from the data of a material.

use material_table::Material;

use crate::criterion::Criterion;
use crate::definition::Definition;
use crate::error::Error;
use crate::judge::Judge;
use crate::life::invert_curve;

/// Longest life that is reported \[cycles\]. A strain-life curve is not reliable beyond the cycles
/// of its tests. The tables of materials do not have that limit, so this is a stated default.
pub const LONGEST: f64 = 1e7;

/// A criterion with the limit or the curve of lives of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment {
    /// The criterion with the weights of the material.
    pub criterion: Criterion,
    /// The limit or the curve.
    pub judge: Judge,
}

impl Assessment {
    /// Looks up a criterion of [`crate::CRITERIA`] by its name, with the numbers of a material.
    pub fn from_name(name: &str, material: &Material) -> Result<Self, Error> {
        let definition = Definition::find(name)?;
        let (numbers, judge) = (definition.from_material)(material)?;
        let criterion = Criterion::from_ordered(definition, numbers)?;
        Ok(Self { criterion, judge })
    }

    /// Limit over value: the factor by which the stress may be multiplied; infinite where the value
    /// is not positive. NaN for criteria that give lives.
    pub fn safety_factor(&self, value: f64) -> f64 {
        match self.judge {
            Judge::Limit(_) if value <= 0.0 => f64::INFINITY,
            Judge::Limit(limit) => limit / value,
            Judge::Life(_) => f64::NAN,
        }
    }

    /// Cycles until a crack has started; for criteria with a limit, infinite below it and NaN
    /// above.
    pub fn life(&self, value: f64) -> f64 {
        let Judge::Life(curve) = self.judge else {
            let below = self.safety_factor(value) >= 1.0;
            return if below { f64::INFINITY } else { f64::NAN };
        };
        let (curve_value, numbers) = (
            self.criterion.definition().curve,
            self.criterion.ordered_numbers(),
        );
        invert_curve(value, |N| curve_value(&curve, numbers, N))
    }

    /// Life, or safety factor for criteria with a limit. A life beyond [`LONGEST`] is infinite.
    pub fn margin(&self, value: f64) -> f64 {
        let margin = self.uncapped_margin(value);
        if self.gives_lives() && margin > LONGEST {
            f64::INFINITY
        } else {
            margin
        }
    }

    /// Margin without the cap at [`LONGEST`], for sums and comparisons of margins.
    pub fn uncapped_margin(&self, value: f64) -> f64 {
        match self.judge {
            Judge::Limit(_) => self.safety_factor(value),
            Judge::Life(_) => self.life(value),
        }
    }

    /// Whether [`Self::margin`] is a life \[cycles\].
    pub fn gives_lives(&self) -> bool {
        matches!(self.judge, Judge::Life(_))
    }
}
