//! Cycles of growth by Paris' law with its threshold.

use super::Error;
use super::arrest::Verdict;
use super::curve::Curve;
use super::threshold::Threshold;

/// How the threshold enters the rate; none below it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Growth {
    /// dl/dN = C dK^m.
    #[default]
    Plain,
    /// dl/dN = C (dK^m - dK_th^m), K. J. Klesnil, P. Lukas (1972).
    Powers,
    /// dl/dN = C (dK - dK_th)^m, K. Donahue et al. (1972).
    Difference,
}

/// Paris' law, dl/dN over the equivalent range of K at R = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Coefficient \[m/cycle at dK = 1 Pa m^0.5\]; C in (MPa m^0.5)^-m times 10^(-6 m).
    pub C: f64,
    /// Exponent.
    pub m: f64,
    /// How the threshold enters.
    pub growth: Growth,
    /// If given, the law takes El Haddad's length l + a_0 in place of l: dK sqrt((l + a_0)/l).
    pub short: bool,
}

/// Cycles of growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Life {
    /// Cycles from the first length to the last; infinite where the rate goes to zero there.
    pub cycles: f64,
    /// First length \[m\].
    pub from: f64,
    /// Length where it ends \[m\].
    pub to: f64,
    /// Whether it ends because the crack stops.
    pub stopped: bool,
}

impl Rate {
    /// Fails at constants of Paris' law without meaning.
    fn check(&self) -> Result<(), Error> {
        for (key, value) in [("C", self.C), ("m", self.m)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::invalid(key, value, "above 0"));
            }
        }
        Ok(())
    }

    /// Growth dl/dN \[m/cycle\] at the equivalent range `dK` over the threshold `dK_th` \[Pa m^0.5\].
    pub fn growth_rate(&self, dK: f64, dK_th: f64) -> f64 {
        if dK <= dK_th {
            return 0.0;
        }
        match self.growth {
            Growth::Plain => self.C * dK.powf(self.m),
            Growth::Powers => self.C * (dK.powf(self.m) - dK_th.powf(self.m)),
            Growth::Difference => self.C * (dK - dK_th).powf(self.m),
        }
    }
}

/// Gauss's rule of six points on -1..1.
const RULE: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170_3),
    (-0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (-0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_3),
];
/// Parts of a piece of the curve.
const PARTS: usize = 4;

impl Curve {
    /// Cycles from the length `from` to `to` \[m\], or to where the crack stops.
    ///
    /// A crack that stops has finite cycles under [`Growth::Plain`], infinite ones where the rate
    /// goes to zero with the distance to the threshold. Fails for a crack that does not grow at
    /// all.
    pub fn life(
        &self,
        threshold: &Threshold,
        rate: &Rate,
        (from, to): (f64, f64),
    ) -> Result<Life, Error> {
        rate.check()?;
        self.check("last length of the crack", to)?;
        if !(from < to) {
            return Err(Error::invalid(
                "last length of the crack",
                to,
                format!("above {from} m"),
            ));
        }
        let (end, stopped) = match self.arrest(threshold, from)?.verdict {
            Verdict::Dormant => (from, true),
            Verdict::Stops(l) if l < to => (l, true),
            _ => (to, false),
        };
        let life = |cycles| Life {
            cycles,
            from,
            to: end,
            stopped,
        };
        if end == from {
            return Ok(life(f64::INFINITY));
        }
        if stopped && rate.growth != Growth::Plain {
            return Ok(life(f64::INFINITY));
        }
        let speed = |l: f64| {
            let short = if rate.short {
                (1.0 + threshold.a_0() / l).sqrt()
            } else {
                1.0
            };
            rate.growth_rate(
                threshold.equivalent(self.at(l)) * short,
                threshold.at_length(l) * short,
            )
        };
        let between = self
            .lengths()
            .iter()
            .copied()
            .filter(|l| *l > from && *l < end);
        let knots: Vec<f64> = [from].into_iter().chain(between).chain([end]).collect();
        let mut cycles = 0.0;
        for pair in knots.windows(2) {
            let part = (pair[1] / pair[0]).ln() / PARTS as f64;
            for n in 0..PARTS {
                let middle = pair[0].ln() + part * (n as f64 + 0.5);
                for (u, weight) in RULE {
                    let l = (middle + 0.5 * part * u).exp();
                    cycles += 0.5 * part * weight * l / speed(l);
                }
            }
        }
        Ok(life(cycles))
    }
}
