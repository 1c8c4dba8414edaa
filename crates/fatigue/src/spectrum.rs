//! Cycles of a stationary Gaussian process, from its one-sided spectral density per Hz.
//!
//! With the spectral moments m_j, the integral of f^j G(f) over f:
//!
//! - up-crossings of the mean per second nu_0 = sqrt(m_2/m_0), peaks per second nu_p =
//!   sqrt(m_4/m_2) (S. O. Rice, Bell Syst. Tech. J. 23 (1944) 282-332, 24 (1945) 46-156);
//! - a narrow band has Rayleigh's distribution of amplitudes a, with the cycles nu_0:
//!   P(a > s) = exp(-s^2/(2 m_0)) (J. S. Bendat, NASA CR-33 (1964));
//! - Dirlik's distribution of the ranges that rainflow counting gives, with the cycles nu_p
//!   (T. Dirlik, Application of computers in fatigue analysis, thesis, University of Warwick (1985)).
//!   With Z = a/sqrt(m_0):
//!
//! ```text
//! P(Z > z) = D_1 exp(-z/Q) + D_2 exp(-z^2/(2 R^2)) + D_3 exp(-z^2/2)
//! gamma = m_2/sqrt(m_0 m_4),  x = m_1/m_0 sqrt(m_2/m_4)
//! D_1 = 2 (x - gamma^2)/(1 + gamma^2),  R = (gamma - x - D_1^2)/(1 - gamma - D_1 + D_1^2)
//! D_2 = (1 - gamma - D_1 + D_1^2)/(1 - R),  D_3 = 1 - D_1 - D_2
//! Q = 1.25 (gamma - D_3 - D_2 R)/D_1
//! ```

use crate::error::Error;

/// Distance of gamma from 1 below which a band is narrow, and Dirlik's quotients are 0/0.
const NARROW: f64 = 1e-6;
/// Abscissae and weights of Gauss' rule of three points, exact to the fifth degree.
const GAUSS: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];

/// Distribution of the cycles of a process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CycleDistribution {
    /// Rayleigh's, of a narrow band.
    Rayleigh,
    /// Dirlik's, of any band (default).
    #[default]
    Dirlik,
}

/// Spectral moments of a process, from which its cycles follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralMoments {
    /// m_0, m_1, m_2 and m_4, in the squared unit of the process times Hz^j.
    m: [f64; 4],
}

impl SpectralMoments {
    /// Integrates a one-sided density per Hz, linear between its frequencies \[Hz\].
    ///
    /// Fails with the row if a frequency does not grow, or a density is negative.
    pub fn from_density(frequencies: &[f64], density: &[f64]) -> Result<Self, Error> {
        if frequencies.len() != density.len() || frequencies.len() < 2 {
            let allowed = format!(
                "as many as the frequencies, {}, and 2 at least",
                frequencies.len()
            );
            return Err(Error::argument(
                "values of the density",
                density.len(),
                allowed,
            ));
        }
        for (row, (f, G)) in frequencies.iter().zip(density).enumerate() {
            let key = |name: &str| format!("{name}[{row}]");
            if !(f.is_finite() && *f >= 0.0) || (row > 0 && *f <= frequencies[row - 1]) {
                let allowed = "a frequency of 0 Hz or more, above the one before";
                return Err(Error::argument(key("frequency"), f, allowed));
            }
            if !(G.is_finite() && *G >= 0.0) {
                let allowed = "0 or more: a density is the mean square per Hz";
                return Err(Error::argument(key("density"), G, allowed));
            }
        }
        let mut m = [0.0; 4];
        for (f, G) in frequencies.windows(2).zip(density.windows(2)) {
            let half = 0.5 * (f[1] - f[0]);
            for (place, weight) in GAUSS {
                let part = 0.5 * (1.0 + place);
                let (x, y) = (f[0] + 2.0 * half * part, G[0] + (G[1] - G[0]) * part);
                for (sum, power) in m.iter_mut().zip([0, 1, 2, 4]) {
                    *sum += weight * half * y * x.powi(power);
                }
            }
        }
        if !m.iter().all(|m| m.is_finite() && *m > 0.0) {
            let allowed = "above 0 at some frequency above 0 Hz";
            return Err(Error::argument("density", m[0], allowed));
        }
        Ok(Self { m })
    }

    /// m_0, m_1, m_2, m_4.
    pub fn moments(&self) -> [f64; 4] {
        self.m
    }

    /// Up-crossings of the mean per second.
    pub fn up_crossings(&self) -> f64 {
        (self.m[2] / self.m[0]).sqrt()
    }

    /// Peaks per second.
    pub fn peaks(&self) -> f64 {
        (self.m[3] / self.m[2]).sqrt()
    }

    /// Up-crossings over peaks: 1 for a narrow band.
    pub fn irregularity(&self) -> f64 {
        self.m[2] / (self.m[0] * self.m[3]).sqrt()
    }

    /// Cycles per second of a distribution: up-crossings for Rayleigh's, peaks for Dirlik's.
    pub fn rate(&self, distribution: CycleDistribution) -> f64 {
        match distribution {
            CycleDistribution::Rayleigh => self.up_crossings(),
            CycleDistribution::Dirlik => self.peaks(),
        }
    }

    /// Part of the cycles whose amplitude (half of the range) is larger.
    pub fn exceedance(&self, distribution: CycleDistribution, amplitude: f64) -> f64 {
        let z = amplitude.max(0.0) / self.m[0].sqrt();
        self.terms(distribution)
            .iter()
            .map(|term| term.weight * (-term.argument(z)).exp())
            .sum()
    }

    /// Mean of amplitude^k over the cycles; Miner's damage of a straight line N s^k = C is the number of
    /// cycles times this mean over C.
    pub fn mean_power(&self, distribution: CycleDistribution, k: f64) -> f64 {
        let sum: f64 = self
            .terms(distribution)
            .iter()
            .map(|term| {
                let (scale, gamma) = if term.squared {
                    (std::f64::consts::SQRT_2 * term.scale, 1.0 + 0.5 * k)
                } else {
                    (term.scale, 1.0 + k)
                };
                term.weight * scale.powf(k) * libm::tgamma(gamma)
            })
            .sum();
        sum * self.m[0].powf(0.5 * k)
    }

    /// The probability density of amplitudes as a sum of exponentials in Z, the amplitude over its scale.
    fn terms(&self, distribution: CycleDistribution) -> Vec<Term> {
        let rayleigh = |weight| Term {
            weight,
            scale: 1.0,
            squared: true,
        };
        let gamma = self.irregularity();
        if distribution == CycleDistribution::Rayleigh || 1.0 - gamma < NARROW {
            return vec![rayleigh(1.0)];
        }
        let [m_0, m_1, m_2, m_4] = self.m;
        let x = m_1 / m_0 * (m_2 / m_4).sqrt();
        let D_1 = 2.0 * (x - gamma * gamma) / (1.0 + gamma * gamma);
        let quotient = 1.0 - gamma - D_1 + D_1 * D_1;
        let R = (gamma - x - D_1 * D_1) / quotient;
        let D_2 = quotient / (1.0 - R);
        let D_3 = 1.0 - D_1 - D_2;
        let Q = 1.25 * (gamma - D_3 - D_2 * R) / D_1;
        let mut terms = vec![rayleigh(D_3)];
        if R.abs() > 0.0 && R.is_finite() {
            terms.push(Term {
                weight: D_2,
                scale: R.abs(),
                squared: true,
            });
        }
        if Q > 0.0 && Q.is_finite() {
            terms.push(Term {
                weight: D_1,
                scale: Q,
                squared: false,
            });
        }
        terms
    }
}

/// weight exp(-z/scale), or weight exp(-(z/scale)^2/2).
struct Term {
    weight: f64,
    scale: f64,
    squared: bool,
}

impl Term {
    /// The argument of the exponential at z.
    fn argument(&self, z: f64) -> f64 {
        let ratio = z / self.scale;
        if self.squared {
            0.5 * ratio * ratio
        } else {
            ratio
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat() -> SpectralMoments {
        SpectralMoments::from_density(&[0.0, 100.0], &[0.04, 0.04]).unwrap()
    }

    #[test]
    fn a_flat_band_has_the_moments_of_its_powers() {
        let flat = flat();
        assert!((flat.moments()[0] - 4.0).abs() < 1e-12);
        assert!((flat.up_crossings() - 100.0 / 3.0_f64.sqrt()).abs() < 1e-9);
        assert!((flat.peaks() - 100.0 * (3.0_f64 / 5.0).sqrt()).abs() < 1e-9);
        assert!((flat.irregularity() - 5.0_f64.sqrt() / 3.0).abs() < 1e-12);
    }

    #[test]
    fn distributions_begin_at_one_and_fall() {
        for distribution in [CycleDistribution::Rayleigh, CycleDistribution::Dirlik] {
            let part = |z: f64| flat().exceedance(distribution, 2.0 * z);
            assert!((part(0.0) - 1.0).abs() < 1e-12);
            assert!((1..60).all(|k| part(0.1 * f64::from(k)) <= part(0.1 * f64::from(k - 1))));
            // The mean power is the integral of k s^(k-1) P(a > s).
            let step = 1e-3;
            let integral: f64 = (0..20_000)
                .map(|n| {
                    let s = (f64::from(n) + 0.5) * step;
                    3.0 * s * s * flat().exceedance(distribution, s) * step
                })
                .sum();
            let exact = flat().mean_power(distribution, 3.0);
            assert!((integral / exact - 1.0).abs() < 1e-4, "{integral} {exact}");
        }
    }

    #[test]
    fn a_narrow_band_is_rayleighs() {
        let narrow =
            SpectralMoments::from_density(&[50.0, 50.01], &[160_000.0, 160_000.0]).unwrap();
        let [rayleigh, dirlik] = [CycleDistribution::Rayleigh, CycleDistribution::Dirlik]
            .map(|d| narrow.rate(d) * narrow.mean_power(d, 5.0));
        assert!((dirlik / rayleigh - 1.0).abs() < 1e-3);
    }

    #[test]
    fn wrong_densities_are_refused_with_their_row() {
        let refused =
            |f: &[f64], G: &[f64]| SpectralMoments::from_density(f, G).unwrap_err().to_string();
        assert!(refused(&[1.0, 2.0], &[1.0, -1.0]).starts_with("density[1] = -1"));
        assert!(refused(&[1.0, 1.0], &[1.0, 1.0]).starts_with("frequency[1] = 1"));
        assert!(refused(&[1.0, 2.0], &[0.0, 0.0]).contains("above 0"));
        assert!(refused(&[1.0], &[1.0]).contains("2 at least"));
    }
}
