//! Numbers of a material by published rules, where no test of it is at hand.
//!
//! An estimate has a source that begins with [`MARK`], so that nobody takes it for a test. Known
//! numbers stay. With s_u the tensile strength \[Pa\], E Young's modulus:
//!
//! - strain-life curve: the uniform material law (A. Baeumel, T. Seeger, Materials Data for Cyclic
//!   Loading, Supplement 1, Elsevier 1990; here after its statement in other works). Steels:
//!   s_f' = 1.5 s_u, b = -0.087, e_f' = 0.59 psi, c = -0.58, psi = 1 for s_u/E <= 0.003, else
//!   1.375 - 125 s_u/E. Alloys of aluminium and titanium: s_f' = 1.67 s_u, b = -0.095, e_f' = 0.35,
//!   c = -0.69.
//! - s_D: the elastic part of the strain-life curve at 10^6 cycles, s_f' (2 10^6)^b.
//! - t_D = s_D/sqrt 3, von Mises' condition for amplitudes.
//! - k of Fatemi and Socie's criterion: with it s_D and t_D have the same value of the criterion on
//!   the plane of the largest shear, 2 t_D = s_D (1 + k s_D/(2 s_y)).
//! - dK_th of steels: 3.3e-3 (HV + 120) area^(1/6) MPa m^0.5 at sqrt(area) = 1000 um, where the law
//!   ends (Y. Murakami, Metal Fatigue: Effects of Small Defects and Nonmetallic Inclusions, Elsevier
//!   2002; here after its statement in other works), with HV = s_u/3.3 MPa.
//! - dK_th of all: 5.8e-5 m^0.5 E, the ratio of the aluminium alloy of J. A. Araujo, D. Nowell,
//!   Int. J. Fatigue 21 (1999) 947-956, taken over in proportion to E. Of steels the smaller of the
//!   two counts: a shorter critical distance is on the safe side.

use crate::error::Error;
use crate::material::{Material, Sourced};

/// Begin of the source of an estimate.
pub const MARK: &str = "estimate: ";

/// Cycles at which a fatigue limit is read off a strain-life curve.
const ENDLESS: f64 = 1e6;
/// Tensile strength over Vickers hardness \[Pa\].
const STRENGTH_OF_HARDNESS: f64 = 3.3e6;
/// Largest root of the area of a defect in Murakami's law \[um\].
const LARGEST_DEFECT: f64 = 1000.0;
/// Threshold over Young's modulus \[m^0.5\].
const THRESHOLD_OF_MODULUS: f64 = 5.8e-5;

/// A family of alloys: which rules hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Steels; high alloys and nickel alloys follow the same curve with more scatter.
    Steel,
    /// Alloys of aluminium.
    Aluminium,
    /// Alloys of titanium.
    Titanium,
    /// Alloys of nickel: the curve of steels, the threshold by the modulus.
    Nickel,
}

impl Family {
    /// All of them, by name.
    pub const ALL: [(&'static str, Self); 4] = [
        ("steel", Self::Steel),
        ("aluminium", Self::Aluminium),
        ("titanium", Self::Titanium),
        ("nickel", Self::Nickel),
    ];

    /// The family of a name.
    pub fn named(name: &str) -> Result<Self, Error> {
        let found = Self::ALL.iter().find(|(of, _)| *of == name);
        found.map(|(_, family)| *family).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|(of, _)| *of).collect();
            Error::Family {
                name: name.to_owned(),
                allowed: names.join(", "),
            }
        })
    }

    /// Whether the curve belongs to steels.
    fn of_steel(self) -> bool {
        matches!(self, Self::Steel | Self::Nickel)
    }
}

/// The material with the numbers that it lacks, where rules give them: a strain-life curve from
/// its strength `s_u`, limits from the curve, a threshold.
pub fn estimated(material: &Material, family: Family) -> Material {
    let mut found = material.clone();
    if let (Ok(s_u), Ok(E)) = (found.number("s_u"), found.number("E")) {
        let law = "uniform material law of the tensile strength (A. Baeumel, T. Seeger, 1990)";
        let (factor, b, e_f, c) = if family.of_steel() {
            let psi = if s_u / E <= 0.003 {
                1.0
            } else {
                1.375 - 125.0 * s_u / E
            };
            (1.5, -0.087, 0.59 * psi, -0.58)
        } else {
            (1.67, -0.095, 0.35, -0.69)
        };
        // A curve has its four numbers from one place.
        let curve = [("s_f", factor * s_u), ("b", b), ("e_f", e_f), ("c", c)];
        if curve.iter().all(|(name, _)| found.number(name).is_err()) {
            for (name, value) in curve {
                fill(&mut found, name, value, law);
            }
        }
    }
    if let (Ok(s_f), Ok(b)) = (found.number("s_f"), found.number("b")) {
        let value = s_f * (2.0 * ENDLESS).powf(b);
        fill(
            &mut found,
            "s_D",
            value,
            "elastic strain-life curve at 1e6 cycles",
        );
    }
    if let Ok(s_D) = found.number("s_D") {
        let value = s_D / 3f64.sqrt();
        fill(
            &mut found,
            "t_D",
            value,
            "s_D over the root of 3, von Mises",
        );
        if let (Ok(t_D), Ok(s_y)) = (found.number("t_D"), found.number("s_y")) {
            let k = 2.0 * s_y / s_D * (2.0 * t_D / s_D - 1.0);
            fill(
                &mut found,
                "k",
                k,
                "limits of tension and torsion on the plane of the largest shear",
            );
        }
    }
    if let Ok(E) = found.number("E") {
        let by_modulus = THRESHOLD_OF_MODULUS * E;
        let rule = "in proportion to E, from the aluminium alloy of J. A. Araujo, D. Nowell (1999)";
        let of_steel = match (family, found.number("s_u")) {
            (Family::Steel, Ok(s_u)) => {
                let of_hardness = s_u / STRENGTH_OF_HARDNESS + 120.0;
                3.3e3 * of_hardness * LARGEST_DEFECT.cbrt()
            }
            _ => f64::INFINITY,
        };
        if of_steel < by_modulus {
            let rule =
                "law of the root of the area at 1000 um (Y. Murakami, 2002), HV = s_u/3.3 MPa";
            fill(&mut found, "dK_th", of_steel, rule);
        } else {
            fill(&mut found, "dK_th", by_modulus, rule);
        }
    }
    found
}

/// Sets a missing number of a material to an estimate. An estimate that its quantity does not allow is left out.
fn fill(material: &mut Material, name: &str, value: f64, rule: &str) {
    if material.number(name).is_err()
        && let Ok((name, sourced)) = Sourced::of(name, value, format!("{MARK}{rule}"))
    {
        material.numbers.insert(name, sourced);
    }
}
