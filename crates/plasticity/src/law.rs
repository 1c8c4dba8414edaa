//! The numbers of a material that yields, and what they make of its yield stress.
//!
//! ```text
//! R(p) = s_y + H p + Q (1 - exp(-b p)) + s_y [(1 + p/e_0)^n - 1]
//! ```
//!
//! A law of isotropic hardening is a row of [`ISOTROPIC`], a number of a material one of [`NUMBERS`].

use serde::{Deserialize, Serialize};

/// A number that is not allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key} = {value}: allowed is {allowed}")]
pub struct Error {
    /// Its place.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// Allowed values.
    pub allowed: &'static str,
}

/// Most back stresses with recall.
pub const BACK_STRESSES: usize = 3;

/// Yielding after von Mises, with isotropic and kinematic hardening.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plastic {
    /// Yield stress s_y \[Pa\], positive.
    pub s_y: f64,
    /// Linear isotropic hardening H: growth of the yield stress per equivalent plastic strain \[Pa\], 0 or
    /// more (default 0).
    pub hardening: f64,
    /// Growth Q of the yield stress at which Voce's hardening saturates \[Pa\], 0 or more (default 0).
    pub voce_Q: f64,
    /// Rate b of Voce's hardening, positive with Q (default 0).
    pub voce_b: f64,
    /// Strain e_0 of Swift's hardening, positive with n (default 0).
    pub swift_e_0: f64,
    /// Exponent n of Swift's hardening, 0 to 1 (default 0).
    pub swift_n: f64,
    /// Linear kinematic hardening: back stress 2/3 C e_p \[Pa\], 0 or more (default 0).
    pub kinematic: f64,
    /// Moduli C_i of Chaboche's back stresses \[Pa\], 0 or more (default none).
    pub chaboche_C: [f64; BACK_STRESSES],
    /// Their rates of recall gamma_i; C_i/gamma_i is the back stress at which one saturates. 0 is linear.
    pub chaboche_gamma: [f64; BACK_STRESSES],
}

/// A law of isotropic hardening: a term of R(p).
#[derive(Clone, Copy, Debug)]
pub struct Isotropic {
    /// Name.
    pub name: &'static str,
    /// The term.
    pub equation: &'static str,
    /// Its source.
    pub source: &'static str,
    /// Growth of the yield stress at p \[Pa\].
    pub growth: fn(&Plastic, f64) -> f64,
    /// Its derivative \[Pa\].
    pub slope: fn(&Plastic, f64) -> f64,
    /// Its integral from 0 to p \[Pa\].
    pub integral: fn(&Plastic, f64) -> f64,
    /// The largest that it comes to \[Pa\].
    pub most: fn(&Plastic) -> f64,
}

/// All laws of isotropic hardening; their terms add.
pub const ISOTROPIC: [Isotropic; 3] = [
    Isotropic {
        name: "linear",
        equation: "H p",
        source: "J. Lemaitre, J.-L. Chaboche, Mechanics of Solid Materials, 1990, section 5.4",
        growth: |law, p| law.hardening * p,
        slope: |law, _| law.hardening,
        integral: |law, p| 0.5 * law.hardening * p * p,
        most: |law| unbounded(law.hardening > 0.0),
    },
    Isotropic {
        name: "voce",
        equation: "Q (1 - exp(-b p))",
        source: "E. Voce, J. Inst. Met. 74 (1948) 537-562",
        growth: |law, p| -law.voce_Q * (-law.voce_b * p).exp_m1(),
        slope: |law, p| law.voce_Q * law.voce_b * (-law.voce_b * p).exp(),
        integral: |law, p| {
            if law.voce_b > 0.0 {
                law.voce_Q * (p + (-law.voce_b * p).exp_m1() / law.voce_b)
            } else {
                0.0
            }
        },
        most: |law| law.voce_Q,
    },
    Isotropic {
        name: "swift",
        equation: "s_y [(1 + p/e_0)^n - 1]",
        source: "H. W. Swift, J. Mech. Phys. Solids 1 (1952) 1-18",
        growth: |law, p| {
            if law.swift_n > 0.0 {
                law.s_y * (law.swift_n * (p / law.swift_e_0).ln_1p()).exp_m1()
            } else {
                0.0
            }
        },
        slope: |law, p| {
            if law.swift_n > 0.0 {
                let n = law.swift_n;
                law.s_y * n / law.swift_e_0 * (1.0 + p / law.swift_e_0).powf(n - 1.0)
            } else {
                0.0
            }
        },
        integral: |law, p| {
            if law.swift_n > 0.0 {
                let (n, e_0) = (law.swift_n, law.swift_e_0);
                let whole = e_0 / (n + 1.0) * ((n + 1.0) * (p / e_0).ln_1p()).exp_m1();
                law.s_y * (whole - p)
            } else {
                0.0
            }
        },
        most: |law| unbounded(law.swift_n > 0.0),
    },
];

/// The limit of a stress that grows without bound if `grows`, else 0.
fn unbounded(grows: bool) -> f64 {
    if grows { f64::INFINITY } else { 0.0 }
}

/// A number of a material that yields.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Its name in scene files and arguments.
    pub name: &'static str,
    /// Allowed values.
    pub allowed: &'static str,
    /// Whether it is allowed.
    pub is_allowed: fn(f64) -> bool,
    /// Its values: one, or one for each back stress.
    pub of: fn(&mut Plastic) -> &mut [f64],
}

const STRESS: &str = "a finite modulus in Pa, 0 (none) or more";
const RATE: &str = "a finite number, 0 (none) or more";

/// All numbers, in the order in which they are written.
pub const NUMBERS: [Number; 9] = [
    Number {
        name: "s_y",
        allowed: "a positive, finite yield stress in Pa",
        is_allowed: |value| value > 0.0 && value.is_finite(),
        of: |law| std::slice::from_mut(&mut law.s_y),
    },
    Number {
        name: "hardening",
        allowed: STRESS,
        is_allowed: not_negative,
        of: |law| std::slice::from_mut(&mut law.hardening),
    },
    Number {
        name: "voce_Q",
        allowed: "a finite stress in Pa, 0 (none) or more",
        is_allowed: not_negative,
        of: |law| std::slice::from_mut(&mut law.voce_Q),
    },
    Number {
        name: "voce_b",
        allowed: RATE,
        is_allowed: not_negative,
        of: |law| std::slice::from_mut(&mut law.voce_b),
    },
    Number {
        name: "swift_e_0",
        allowed: RATE,
        is_allowed: not_negative,
        of: |law| std::slice::from_mut(&mut law.swift_e_0),
    },
    Number {
        name: "swift_n",
        allowed: "0 (none) to 1",
        is_allowed: |value| (0.0..=1.0).contains(&value),
        of: |law| std::slice::from_mut(&mut law.swift_n),
    },
    Number {
        name: "kinematic",
        allowed: STRESS,
        is_allowed: not_negative,
        of: |law| std::slice::from_mut(&mut law.kinematic),
    },
    Number {
        name: "chaboche_C",
        allowed: STRESS,
        is_allowed: not_negative,
        of: |law| &mut law.chaboche_C,
    },
    Number {
        name: "chaboche_gamma",
        allowed: RATE,
        is_allowed: not_negative,
        of: |law| &mut law.chaboche_gamma,
    },
];

/// Whether a number is finite and not negative.
fn not_negative(value: f64) -> bool {
    value >= 0.0 && value.is_finite()
}

impl Plastic {
    /// Without hardening; the base of all others.
    pub const fn perfect(s_y: f64) -> Self {
        Self {
            s_y,
            hardening: 0.0,
            voce_Q: 0.0,
            voce_b: 0.0,
            swift_e_0: 0.0,
            swift_n: 0.0,
            kinematic: 0.0,
            chaboche_C: [0.0; BACK_STRESSES],
            chaboche_gamma: [0.0; BACK_STRESSES],
        }
    }

    /// Fails at a number without meaning, and where one of a pair is missing; `key` is its place.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        let fail = |name: String, value: f64, allowed: &'static str| {
            let key = format!("{key}.{name}");
            Err(Error {
                key,
                value,
                allowed,
            })
        };
        let mut law = *self;
        for number in &NUMBERS {
            let values = (number.of)(&mut law);
            let several = values.len() > 1;
            for (n, value) in values.iter().enumerate() {
                if !(number.is_allowed)(*value) {
                    let index = if several {
                        format!("[{n}]")
                    } else {
                        String::new()
                    };
                    return fail(format!("{}{index}", number.name), *value, number.allowed);
                }
            }
        }
        let positive = "positive, since the other number of this hardening is given";
        for (name, value, other) in [
            ("voce_b", self.voce_b, self.voce_Q),
            ("voce_Q", self.voce_Q, self.voce_b),
            ("swift_e_0", self.swift_e_0, self.swift_n),
            ("swift_n", self.swift_n, self.swift_e_0),
        ] {
            if other > 0.0 && value == 0.0 {
                return fail(name.to_owned(), value, positive);
            }
        }
        for (n, (C, gamma)) in self.chaboche_C.iter().zip(self.chaboche_gamma).enumerate() {
            if *C == 0.0 && gamma > 0.0 {
                return fail(format!("chaboche_C[{n}]"), *C, positive);
            }
        }
        Ok(())
    }

    /// R(p) \[Pa\].
    pub fn yield_stress(&self, p: f64) -> f64 {
        self.s_y + ISOTROPIC.iter().map(|of| (of.growth)(self, p)).sum::<f64>()
    }

    /// dR/dp \[Pa\].
    pub fn slope(&self, p: f64) -> f64 {
        ISOTROPIC.iter().map(|of| (of.slope)(self, p)).sum()
    }

    /// Integral of R from p to q \[Pa\].
    pub fn integral(&self, p: f64, q: f64) -> f64 {
        let of = |of: &Isotropic| (of.integral)(self, q) - (of.integral)(self, p);
        self.s_y * (q - p) + ISOTROPIC.iter().map(of).sum::<f64>()
    }

    /// The largest stress of von Mises that it comes to \[Pa\]; infinite where hardening has no end.
    pub fn most(&self) -> f64 {
        let pairs = self.chaboche_C.iter().zip(self.chaboche_gamma);
        let recalled = pairs.filter(|(C, _)| **C > 0.0).map(|(C, gamma)| C / gamma);
        let isotropic = ISOTROPIC.iter().map(|of| (of.most)(self));
        self.s_y + unbounded(self.kinematic > 0.0) + recalled.sum::<f64>() + isotropic.sum::<f64>()
    }
}
