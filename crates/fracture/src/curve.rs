//! K of a cycle over the length of a crack.

use super::Error;

/// Largest and smallest K_I of a cycle \[Pa m^0.5\]; below zero the crack is closed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// Largest.
    pub K_max: f64,
    /// Smallest.
    pub K_min: f64,
}

impl Extremes {
    /// Positive part of the range, max(K_max, 0) - max(K_min, 0) \[Pa m^0.5\].
    pub fn range(&self) -> f64 {
        self.K_max.max(0.0) - self.K_min.max(0.0)
    }

    /// Load ratio of the positive part, in 0..1; 0 where the crack closes.
    pub fn ratio(&self) -> f64 {
        if self.K_min > 0.0 {
            self.K_min / self.K_max
        } else {
            0.0
        }
    }
}

/// K over the length of a crack, from the lengths given; between them by cubics of K/sqrt(l) over
/// ln l.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    lengths: Vec<f64>,
    extremes: Vec<Extremes>,
}

/// Fewest lengths of a curve.
const FEWEST_LENGTHS: usize = 4;

impl Curve {
    /// A curve through the extremes of K at these lengths \[m\], ascending.
    pub fn new(lengths: Vec<f64>, extremes: Vec<Extremes>) -> Result<Self, Error> {
        let count = lengths.len();
        if count != extremes.len() {
            let found = format!("{count} and {} extremes of K", extremes.len());
            return Err(Error::invalid(
                "lengths",
                found,
                "one for each extreme of K",
            ));
        }
        if count < FEWEST_LENGTHS {
            let allowed = format!(
                "{FEWEST_LENGTHS} or more: between them K is a cubic. Compute the crack at more lengths, or \
                 leave `lengths` out for the default ones"
            );
            return Err(Error::invalid(
                "number of lengths of the crack",
                count,
                allowed,
            ));
        }
        let ascending = lengths.windows(2).all(|w| w[0] < w[1]);
        if !(ascending && lengths[0] > 0.0 && lengths.iter().all(|l| l.is_finite())) {
            return Err(Error::invalid(
                "lengths",
                format!("{lengths:?}"),
                "ascending, above 0 m",
            ));
        }
        for (l, k) in lengths.iter().zip(&extremes) {
            if !(k.K_max.is_finite() && k.K_min.is_finite() && k.K_min <= k.K_max) {
                let found = format!("{} to {}", k.K_min, k.K_max);
                let key = format!("K at the length {l} m");
                return Err(Error::invalid(key, found, "finite, the smaller one first"));
            }
        }
        Ok(Self { lengths, extremes })
    }

    /// The lengths \[m\].
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The extremes of K at the lengths.
    pub fn extremes(&self) -> &[Extremes] {
        &self.extremes
    }

    /// The extremes of K at a length \[m\] within the lengths of the curve.
    pub fn at(&self, l: f64) -> Extremes {
        let n = self.lengths.len();
        let after = self.lengths.partition_point(|at| *at < l);
        let first = after.saturating_sub(2).min(n - FEWEST_LENGTHS);
        let x = |k: usize| self.lengths[k].ln();
        let mut sum = Extremes::default();
        for k in first..first + FEWEST_LENGTHS {
            let others = (first..first + FEWEST_LENGTHS).filter(|j| *j != k);
            let weight: f64 = others.map(|j| (l.ln() - x(j)) / (x(k) - x(j))).product();
            let weight = weight * (l / self.lengths[k]).sqrt();
            sum.K_max += weight * self.extremes[k].K_max;
            sum.K_min += weight * self.extremes[k].K_min;
        }
        sum
    }

    /// Fails at a length beyond the curve; `key` names it.
    pub(crate) fn check(&self, key: &str, l: f64) -> Result<(), Error> {
        let (first, last) = (self.lengths[0], self.lengths[self.lengths.len() - 1]);
        if (first..=last).contains(&l) {
            return Ok(());
        }
        let allowed = format!("within the lengths of the crack, {first:.4e} to {last:.4e} m");
        Err(Error::invalid(key, l, allowed))
    }
}
