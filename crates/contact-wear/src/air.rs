//! Settings of the oxygen that reaches a contact.
//!
//! ```text
//! div(D grad P) = r P,   r = r_ref (p/p_ref)^a (f/f_ref)^b   or   r_ref (phi/phi_ref)^m
//! ```
//!
//! P is the partial pressure of oxygen, phi the power of friction per area in a cell, energy per cycle
//! times frequency (P. Arnaud, S. Baydoun, S. Fouvry, Tribol. Int. 161 (2021) 107077; the power law of
//! p and f: S. Baydoun, S. Fouvry, Tribol. Int. 147 (2020) 106266). D/r = lambda^2 alone enters. In a
//! wide strip P falls as 2 exp(-x/lambda) P_air, so that the oxygen distance is
//! `d = lambda ln(2 P_air/P_th)`.

use contact_core::Error;

/// State at which the reaction has its reference value, and the exponents of its power law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reaction {
    /// Pressure \[Pa\] and frequency \[Hz\].
    Loading {
        /// Reference pressure \[Pa\].
        pressure: f64,
        /// Exponent a.
        pressure_exponent: f64,
        /// Reference frequency \[Hz\].
        frequency: f64,
        /// Exponent b.
        frequency_exponent: f64,
    },
    /// Power of friction per area.
    Power {
        /// Reference power density \[W/m^2\].
        power_density: f64,
        /// Exponent m.
        power_exponent: f64,
    },
}

/// Oxygen that diffuses into the closed region and is consumed there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Oxygen distance of a wide strip at the reference state \[m\].
    pub distance: f64,
    /// How the reaction changes with the load.
    pub reaction: Reaction,
    /// Partial pressure of oxygen below which a surface is starved \[Pa\].
    pub threshold: f64,
    /// Partial pressure of oxygen of the ambient air \[Pa\].
    pub ambient: f64,
}

impl Air {
    /// Default of [`Self::threshold`] \[Pa\] (Arnaud et al. 2021).
    pub const THRESHOLD: f64 = 0.1;
    /// Default of [`Self::ambient`]: 0.21 of an atmosphere \[Pa\].
    pub const AMBIENT: f64 = 21_278.0;

    /// The decay length lambda of the reference state over the oxygen distance: 1/ln(2 P_air/P_th).
    pub fn decay_length(ambient: f64, threshold: f64) -> f64 {
        1.0 / (2.0 * ambient / threshold).ln()
    }

    /// Threshold over the ambient partial pressure.
    pub(crate) fn relative_threshold(&self) -> f64 {
        self.threshold / self.ambient
    }

    /// lambda^2 of a cell \[m^2\] under the pressure p \[Pa\] and the power density phi \[W/m^2\] at
    /// the frequency f \[Hz\]; infinite where nothing reacts.
    pub(crate) fn lambda_squared(&self, p: f64, phi: f64, f: f64) -> f64 {
        let lambda = self.distance * Self::decay_length(self.ambient, self.threshold);
        let power = |value: f64, exponent: f64| {
            if value > 0.0 {
                value.powf(exponent)
            } else {
                0.0
            }
        };
        let rate = match self.reaction {
            Reaction::Loading {
                pressure,
                pressure_exponent,
                frequency,
                frequency_exponent,
            } => power(p / pressure, pressure_exponent) * power(f / frequency, frequency_exponent),
            Reaction::Power {
                power_density,
                power_exponent,
            } => power(phi / power_density, power_exponent),
        };
        lambda * lambda / rate
    }

    /// Fails at constants without a meaning.
    pub(crate) fn check(&self) -> Result<(), Error> {
        check_positive("wear.air.distance", self.distance, "m")?;
        check_positive("wear.air.threshold", self.threshold, "Pa")?;
        check_positive("wear.air.ambient", self.ambient, "Pa")?;
        if self.threshold >= self.ambient {
            let allowed = format!("below the ambient partial pressure, {} Pa", self.ambient);
            return Err(Error::invalid(
                "wear.air.threshold",
                self.threshold,
                allowed,
            ));
        }
        let (references, exponents) = match self.reaction {
            Reaction::Loading {
                pressure,
                pressure_exponent,
                frequency,
                frequency_exponent,
            } => (
                vec![("pressure", pressure, "Pa"), ("frequency", frequency, "Hz")],
                vec![
                    ("pressure_exponent", pressure_exponent),
                    ("frequency_exponent", frequency_exponent),
                ],
            ),
            Reaction::Power {
                power_density,
                power_exponent,
            } => (
                vec![("power_density", power_density, "W/m^2")],
                vec![("power_exponent", power_exponent)],
            ),
        };
        for (key, value, unit) in references {
            check_positive(&format!("wear.air.{key}"), value, unit)?;
        }
        for (key, value) in exponents {
            if !(value >= 0.0 && value.is_finite()) {
                let key = format!("wear.air.{key}");
                return Err(Error::invalid(key, value, "a finite number >= 0"));
            }
        }
        Ok(())
    }
}

/// Fails unless a constant is above zero and finite.
pub(crate) fn check_positive(key: &str, value: f64, unit: &str) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    let allowed = format!("a finite number above 0 in {unit}");
    Err(Error::invalid(key, value, allowed))
}

#[cfg(test)]
mod tests {
    use super::{Air, Reaction};

    #[test]
    fn the_oxygen_distance_falls_as_measured() {
        // The law of Baydoun and Fouvry (2020): 1.51 mm (f/1 Hz)^-0.22 (p/100 MPa)^-0.32.
        let air = Air {
            distance: 1.51e-3,
            reaction: Reaction::Loading {
                pressure: 1e8,
                pressure_exponent: 0.64,
                frequency: 1.0,
                frequency_exponent: 0.44,
            },
            threshold: Air::THRESHOLD,
            ambient: Air::AMBIENT,
        };
        let distance = |p: f64, f: f64| {
            air.lambda_squared(p, f64::NAN, f).sqrt()
                / Air::decay_length(air.ambient, air.threshold)
        };
        for (p, f) in [(1e8, 1.0), (5e7, 1.0), (1e8, 8.0)] {
            let exact = 1.51e-3 * f64::powf(f, -0.22) * f64::powf(p / 1e8, -0.32);
            assert!((distance(p, f) / exact - 1.0).abs() < 1e-12);
        }
        assert_eq!(air.lambda_squared(0.0, 0.0, 1.0), f64::INFINITY);
        assert!(air.check().is_ok());
        let bad = Air {
            threshold: 3e4,
            ..air
        };
        assert!(bad.check().unwrap_err().to_string().contains("threshold"));
    }
}
