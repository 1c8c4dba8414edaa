//! The range of a life: from the error of the stress, the scatter of the material and its critical
//! distance.
//!
//! The logarithms of the three parts are independent, so they add as squares. With the best value m
//! and the ends m_i of part i, ln(m/low)^2 = sum_i ln(m/m_i)^2, and likewise for the high end.

use material_table::{Allowed, Known, Material};

use crate::assessment::{Assessment, LONGEST};
use crate::error::Error;

/// Names of the material's numbers in a strain-life curve.
const CURVE: [&str; 4] = ["s_f", "b", "e_f", "c"];
/// Names of further numbers, which some strain-life criteria use.
const CRITERION_NUMBERS: [&str; 3] = ["k", "s_y", "S"];
/// Names of the material's numbers for criteria with a limit.
const LIMITS: [&str; 2] = ["s_D", "t_D"];
/// Weight of the mean stress that counts as none.
const NO_WEIGHT: f64 = 1e-9;

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
    /// Range by the error of the stress.
    pub stress: Range,
    /// Highest over lowest by the scatter of the material.
    pub material: f64,
    /// Range by the critical distance; `None` for a value at a point.
    pub distance: Option<Range>,
}

impl LifeRange {
    /// Combines three causes of scatter: the error of the `stress`, the ratio `material` of the highest to the
    /// lowest margin by the material, and the critical `distance`.
    pub fn combine(stress: Range, material: f64, distance: Option<Range>) -> Self {
        let (best, half) = (stress.best, 0.5 * material.ln());
        let parts = || std::iter::once(stress).chain(distance);
        let lowest = |range: Range| range.low.min(range.best).min(range.high);
        let highest = |range: Range| range.low.max(range.best).max(range.high);
        let sum = |range: &dyn Fn(Range) -> f64| parts().map(|r| range(r).powi(2)).sum::<f64>();
        let down = (half.powi(2) + sum(&|r| log_ratio(best, lowest(r)))).sqrt();
        let up = (half.powi(2) + sum(&|r| log_ratio(highest(r), best))).sqrt();
        // A life without end has the least end of its parts.
        let low = if best.is_finite() {
            best * (-down).exp()
        } else {
            parts().map(lowest).fold(f64::INFINITY, f64::min) * (-half).exp()
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
    /// Caps a finite life at [`LONGEST`]; a longer one has no upper end. An infinite life stays
    /// infinite.
    fn cap_at_longest(self) -> Self {
        let cap = |life: f64| if life > LONGEST { f64::INFINITY } else { life };
        let low = if self.low.is_finite() {
            self.low.min(LONGEST)
        } else {
            self.low
        };
        Self {
            low,
            best: cap(self.best),
            high: cap(self.high),
        }
    }
}

/// Logarithm of a ratio, at least 0; infinite if `larger` is infinite.
fn log_ratio(larger: f64, smaller: f64) -> f64 {
    if larger <= smaller {
        0.0
    } else if larger.is_infinite() || smaller <= 0.0 {
        f64::INFINITY
    } else {
        (larger / smaller).ln()
    }
}

/// Default ratio of the 90th to the 10th percentile, of life if `lives`, else of strength, by how the numbers
/// are known.
fn default_scatter(lives: bool, kind: Known) -> f64 {
    match (lives, kind) {
        (true, Known::Known) => 3.0,
        (true, _) => 5.0,
        (false, Known::Known) => 1.2,
        (false, _) => 1.5,
    }
}

impl Assessment {
    /// Margins of a value of the criterion with its error: the lowest is the margin of value +
    /// error. Lives beyond [`LONGEST`] follow the curve; [`Self::life_range`] caps them.
    pub fn margins(&self, value: f64, error: f64) -> Range {
        Range {
            low: self.uncapped_margin(value + error),
            best: self.uncapped_margin(value),
            high: self.uncapped_margin((value - error).max(0.0)),
        }
    }

    /// Margin of a value with its error. The low end of a life beyond [`LONGEST`] is that number,
    /// and the other ends are infinite. The ends are NaN without a finite error.
    pub fn margin_range(&self, value: f64, error: f64) -> Range {
        if !error.is_finite() {
            let best = self.margin(value);
            return Range {
                low: f64::NAN,
                best,
                high: f64::NAN,
            };
        }
        let margins = self.margins(value, error);
        if self.gives_lives() {
            margins.cap_at_longest()
        } else {
            margins
        }
    }

    /// Range of 10 to 90 % of the margin of a value at a point, from its error and from the scatter
    /// of the material, `factor`. The ends are NaN without a finite error.
    pub fn point_range(&self, value: f64, error: f64, factor: f64) -> Range {
        if error.is_finite() {
            self.life_range(self.margins(value, error), factor, None)
                .range
        } else {
            self.margin_range(value, error)
        }
    }

    /// Combines the parts of a margin as [`LifeRange::combine`]. A life beyond [`LONGEST`] is
    /// infinite.
    pub fn life_range(&self, stress: Range, material: f64, distance: Option<Range>) -> LifeRange {
        let mut combined = LifeRange::combine(stress, material, distance);
        if self.gives_lives() {
            combined.range = combined.range.cap_at_longest();
        }
        combined
    }

    /// Note on a criterion whose weight of the mean stress is 0, as t_D = s_D/sqrt 3 makes the weight
    /// of Crossland's criterion. A residual stress changes nothing then.
    pub fn mean_stress_note(&self, material: Option<&Material>) -> Option<String> {
        let parameters = self.criterion.definition().parameters.iter();
        let numbers = self.criterion.numbers();
        let weights = parameters
            .zip(numbers)
            .filter(|(p, _)| p.allowed == Allowed::Weight);
        let weights: Vec<_> = weights.map(|(_, number)| number).collect();
        if weights.is_empty() || weights.iter().any(|(_, weight)| *weight > NO_WEIGHT) {
            return None;
        }
        let (name, criterion) = (weights[0].0, self.criterion.name());
        let cause = material
            .filter(|m| m.known(&["t_D"]) == Known::Estimate)
            .map_or_else(String::new, |m| {
                format!(", since t_D of {} is an estimate, s_D/sqrt 3", m.name)
            });
        Some(format!(
            "{criterion} has the weight {name} = 0 of the mean stress{cause}: mean stress and residual stress \
             (peening) do not change this number. Give a measured t_D, or use dang_van, whose weight is {:.2} with \
             the same limits",
            3.0f64.sqrt() - 1.5
        ))
    }

    /// Ratio of the 90th to the 10th percentile of the margin by the scatter of a material, `measured` or by
    /// default. Also returns a note if some of its numbers are estimates.
    pub fn scatter(
        &self,
        material: Option<&Material>,
        measured: Option<f64>,
    ) -> Result<(f64, Option<String>), Error> {
        if let Some(measured) =
            measured.filter(|measured| !(*measured >= 1.0 && measured.is_finite()))
        {
            let allowed = "1 or more, the highest over the lowest";
            return Err(Error::argument("scatter", measured, allowed));
        }
        let lives = self.gives_lives();
        let names: Vec<&str> = if lives {
            let further = CRITERION_NUMBERS.into_iter();
            let further = further.filter(|name| self.criterion.number(name).is_some());
            CURVE.into_iter().chain(further).collect()
        } else {
            LIMITS.to_vec()
        };
        let kind = material.map_or(Known::Known, |material| material.known(&names));
        let factor = measured.unwrap_or_else(|| default_scatter(lives, kind));
        let note = material.and_then(|material| material.estimate_of(&names));
        Ok((factor, note))
    }
}
