//! Lives: from a stress or strain amplitude, or from the value of a criterion, to cycles.
//!
//! O. H. Basquin, Proc. ASTM 10 (1910) 625-630; L. F. Coffin, Trans. ASME 76 (1954) 931-950;
//! S. S. Manson, NACA TN 2933 (1953). Reversals are half cycles: 2 N.

use crate::error::Error;

/// Longest finite life: above it a life is infinite \[cycles\].
const ENDLESS: f64 = 1e15;

/// A curve of stress: amplitude = coefficient (2 N)^exponent \[Pa\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basquin {
    /// Fatigue strength coefficient s_f' \[Pa\], the amplitude at one reversal.
    pub coefficient: f64,
    /// Fatigue strength exponent b, negative.
    pub exponent: f64,
}

/// A curve of strain: amplitude = s_f'/E (2 N)^b + e_f' (2 N)^c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoffinManson {
    /// Young's modulus \[Pa\].
    pub E: f64,
    /// The elastic part.
    pub elastic: Basquin,
    /// Fatigue ductility coefficient e_f'.
    pub ductility: f64,
    /// Fatigue ductility exponent c, negative.
    pub exponent: f64,
}

impl Basquin {
    /// Amplitude at a life of N cycles \[Pa\].
    pub fn amplitude(&self, cycles: f64) -> f64 {
        self.coefficient * (2.0 * cycles).powf(self.exponent)
    }

    /// Cycles under an amplitude \[Pa\]; infinite for none.
    pub fn life(&self, amplitude: f64) -> f64 {
        if amplitude <= 0.0 {
            return f64::INFINITY;
        }
        cap_life(0.5 * (amplitude / self.coefficient).powf(1.0 / self.exponent))
    }

    /// Fails if a number is out of its range.
    pub fn check(&self) -> Result<(), Error> {
        check_positive("coefficient", self.coefficient)?;
        check_negative("exponent", self.exponent)
    }
}

impl CoffinManson {
    /// Strain amplitude at a life of N cycles.
    pub fn amplitude(&self, cycles: f64) -> f64 {
        self.sum([1.0, 1.0], cycles)
    }

    /// Cycles under a strain amplitude; infinite for none.
    pub fn life(&self, amplitude: f64) -> f64 {
        invert_curve(amplitude, |N| self.amplitude(N))
    }

    /// Value of Smith, Watson and Topper's criterion at a life of N cycles \[Pa\]: a fully reversed
    /// test has the stress amplitude s_f' (2 N)^b, so that
    /// s_n,max e_a = (s_f'^2/E) (2 N)^2b + s_f' e_f' (2 N)^(b + c).
    pub fn smith_watson_topper(&self, cycles: f64) -> f64 {
        self.elastic.amplitude(cycles) * self.amplitude(cycles)
    }

    /// Value of Fatemi and Socie's criterion at a life of N cycles, from the uniaxial curve: on the
    /// plane of the largest shear gamma_a = (1 + nu) e_a in its elastic and 3/2 e_a in its plastic
    /// part, and s_n,max half of the stress amplitude.
    pub fn fatemi_socie(&self, cycles: f64, nu: f64, k: f64, s_y: f64) -> f64 {
        let opening = 1.0 + k * self.elastic.amplitude(cycles) / (2.0 * s_y);
        self.sum([1.0 + nu, 1.5], cycles) * opening
    }

    /// Value of Brown and Miller's criterion at a life of N cycles, from the uniaxial curve: on the
    /// plane of the largest shear the normal strain has the range (1 - nu) e_a, with nu = 1/2 in
    /// the plastic part.
    pub fn brown_miller(&self, cycles: f64, nu: f64, S: f64) -> f64 {
        self.sum([1.0 + nu + S * (1.0 - nu), 1.5 + S / 2.0], cycles)
    }

    /// Fails if a number is out of its range.
    pub fn check(&self) -> Result<(), Error> {
        check_positive("E", self.E)?;
        self.elastic.check()?;
        check_positive("ductility", self.ductility)?;
        check_negative("ductility exponent", self.exponent)
    }

    /// Strain amplitude at a life of N cycles: the elastic and the plastic part of the curve, each with a
    /// weight.
    fn sum(&self, [elastic, plastic]: [f64; 2], cycles: f64) -> f64 {
        let elastic_strain = self.elastic.amplitude(cycles) / self.E;
        elastic * elastic_strain + plastic * self.ductility * (2.0 * cycles).powf(self.exponent)
    }
}

/// Finds the cycles at which a falling curve has the value, by bisection of the logarithm.
pub(crate) fn invert_curve(value: f64, curve: impl Fn(f64) -> f64) -> f64 {
    if value.is_nan() {
        return f64::NAN;
    }
    let (mut low, mut high) = ((1e-6_f64).ln(), ENDLESS.ln());
    if value <= curve(ENDLESS) {
        return f64::INFINITY;
    }
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if curve(middle.exp()) > value {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high).exp()
}

/// Makes a life beyond [`ENDLESS`] infinite.
fn cap_life(cycles: f64) -> f64 {
    if cycles > ENDLESS {
        f64::INFINITY
    } else {
        cycles
    }
}

/// Fails if a number is not positive.
fn check_positive(key: &str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::argument(key, value, "a positive number"))
}

/// Fails if a number is not negative.
fn check_negative(key: &str, value: f64) -> Result<(), Error> {
    if value < 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::argument(
        key,
        value,
        "a negative number: lives fall with the amplitude",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::definition::CRITERIA;

    /// SAE 1137 carbon steel, the form of the curve only.
    const CURVE: CoffinManson = CoffinManson {
        E: 209e9,
        elastic: Basquin {
            coefficient: 1006e6,
            exponent: -0.0809,
        },
        ductility: 1.104,
        exponent: -0.6207,
    };

    #[test]
    fn lives_invert_the_curves() {
        for N in [1.0, 1e3, 1e5, 1e7] {
            let assert_same =
                |computed: f64| assert!((computed / N - 1.0).abs() < 1e-9, "{computed} {N}");
            assert_same(CURVE.elastic.life(CURVE.elastic.amplitude(N)));
            assert_same(CURVE.life(CURVE.amplitude(N)));
            for definition in CRITERIA
                .iter()
                .filter(|d| d.unit == "1" || d.parameters.len() == 2)
            {
                let numbers = [210e9, 0.3, 0.9, 5e8];
                let value = (definition.curve)(&CURVE, numbers, N);
                assert_same(invert_curve(value, |N| {
                    (definition.curve)(&CURVE, numbers, N)
                }));
            }
        }
        assert!(CURVE.life(0.0).is_infinite() && CURVE.elastic.life(0.0).is_infinite());
    }
}
