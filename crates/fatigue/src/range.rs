//! A life is a range: from the error of the stress, the scatter of the material and its critical
//! distance.
//!
//! The logarithms of the three parts are independent, so they add as squares. With the best value m
//! and the ends m_i of part i, ln(m/low)^2 = sum_i ln(m/m_i)^2, and likewise for the high end.

use material_table::{Known, Material};

use crate::assessment::{Assessment, LONGEST};
use crate::error::Error;

/// Numbers of a material that a strain-life curve has.
const CURVE: [&str; 4] = ["s_f", "b", "e_f", "c"];
/// Numbers that single criteria of lives have beside it.
const OWN: [&str; 3] = ["k", "s_y", "S"];
/// Numbers of criteria with a limit.
const LIMITS: [&str; 2] = ["s_D", "t_D"];
/// A number and the range that it lies in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The lowest.
    pub low: f64,
    /// The best estimate.
    pub best: f64,
    /// The highest.
    pub high: f64,
}

/// A life \[cycles\] or a safety factor: its range of 10 to 90 %, and the parts of the range.
#[derive(Clone, Debug, PartialEq)]
pub struct LifeRange {
    /// Low, best and high.
    pub range: Range,
    /// The part of the error of the stress.
    pub stress: Range,
    /// Highest over lowest by the scatter of the material.
    pub material: f64,
    /// The part of the critical distance; `None` for a value at a point.
    pub distance: Option<Range>,
}

impl LifeRange {
    /// Combines the parts. `material` is the highest over the lowest by its scatter.
    pub fn of(stress: Range, material: f64, distance: Option<Range>) -> Self {
        let (best, half) = (stress.best, 0.5 * material.ln());
        let parts = || std::iter::once(stress).chain(distance);
        let least = |of: Range| of.low.min(of.best).min(of.high);
        let most = |of: Range| of.low.max(of.best).max(of.high);
        let sum = |of: &dyn Fn(Range) -> f64| parts().map(|r| of(r).powi(2)).sum::<f64>();
        let down = (half.powi(2) + sum(&|r| ratio(best, least(r)))).sqrt();
        let up = (half.powi(2) + sum(&|r| ratio(most(r), best))).sqrt();
        // A life without end has the least end of its parts.
        let low = if best.is_finite() {
            best * (-down).exp()
        } else {
            parts().map(least).fold(f64::INFINITY, f64::min) * (-half).exp()
        };
        let high = best * up.exp();
        Self {
            range: Range { low, best, high },
            stress,
            material,
            distance,
        }
    }
}

impl Range {
    /// What is told of a life: nothing beyond [`LONGEST`]. A life without any end stays that.
    fn told(self) -> Self {
        let end = |life: f64| if life > LONGEST { f64::INFINITY } else { life };
        let low = if self.low.is_finite() {
            self.low.min(LONGEST)
        } else {
            self.low
        };
        Self {
            low,
            best: end(self.best),
            high: end(self.high),
        }
    }
}

/// Logarithm of a ratio, 0 or more; infinite where the larger number is.
fn ratio(larger: f64, smaller: f64) -> f64 {
    if larger <= smaller {
        0.0
    } else if larger.is_infinite() || smaller <= 0.0 {
        f64::INFINITY
    } else {
        (larger / smaller).ln()
    }
}

/// Life, or strength, that 90 % of the specimens reach less than over that which 10 % do: defaults
/// where no scatter was measured.
fn scatter(lives: bool, kind: Known) -> f64 {
    match (lives, kind) {
        (true, Known::Known) => 3.0,
        (true, _) => 5.0,
        (false, Known::Known) => 1.2,
        (false, _) => 1.5,
    }
}

impl Assessment {
    /// The margin of a value of the criterion with its error: the lowest is that of value + error. Lives
    /// beyond [`LONGEST`] are those of the curve, for [`Self::told`].
    pub fn margins(&self, value: f64, error: f64) -> Range {
        Range {
            low: self.extrapolated(value + error),
            best: self.extrapolated(value),
            high: self.extrapolated((value - error).max(0.0)),
        }
    }

    /// The margin of a value with its error, as a reader is given it: the low end of a life beyond
    /// [`LONGEST`] is that number, and the others are infinite. NaN ends without a finite error.
    pub fn range(&self, value: f64, error: f64) -> Range {
        if !error.is_finite() {
            let best = self.margin(value);
            return Range {
                low: f64::NAN,
                best,
                high: f64::NAN,
            };
        }
        let found = self.margins(value, error);
        if self.gives_lives() {
            found.told()
        } else {
            found
        }
    }

    /// The range of 10 to 90 % of the margin of a value at a point: of its error and of the scatter of the
    /// material, `factor`. NaN ends without a finite error.
    pub fn at_a_point(&self, value: f64, error: f64, factor: f64) -> Range {
        if error.is_finite() {
            self.told(self.margins(value, error), factor, None).range
        } else {
            self.range(value, error)
        }
    }

    /// The range of a margin from its parts, as [`LifeRange::of`]. A life beyond [`LONGEST`] is without
    /// end.
    pub fn told(&self, stress: Range, material: f64, distance: Option<Range>) -> LifeRange {
        let mut found = LifeRange::of(stress, material, distance);
        if self.gives_lives() {
            found.range = found.range.told();
        }
        found
    }

    /// Highest over lowest margin by the scatter of a material, and a note where numbers of it are
    /// not from a source. `given` takes the place of the default.
    pub fn scatter(
        &self,
        material: Option<&Material>,
        given: Option<f64>,
    ) -> Result<(f64, Option<String>), Error> {
        if let Some(given) = given.filter(|given| !(*given >= 1.0 && given.is_finite())) {
            let allowed = "1 or more, the highest over the lowest";
            return Err(Error::argument("scatter", given, allowed));
        }
        let lives = self.gives_lives();
        let names: Vec<&str> = if lives {
            let own = OWN.into_iter();
            let own = own.filter(|name| self.criterion.number(name).is_some());
            CURVE.into_iter().chain(own).collect()
        } else {
            LIMITS.to_vec()
        };
        let kind = material.map_or(Known::Known, |material| material.known(&names));
        let factor = given.unwrap_or_else(|| scatter(lives, kind));
        let note = material.and_then(|material| material.estimate_of(&names));
        Ok((factor, note))
    }
}
