//! The criteria, a row each: name, parameters, equation, data of the material, lives.
//!
//! s_n is the normal stress on a plane, tension positive, its largest value over time s_n,max;
//! tau_a the shear amplitude there, the radius of the smallest circle round the path of the shear
//! stress, and gamma_a = tau_a/G with G = E/(2 (1 + nu)); p_h the hydrostatic stress; sqrt(J2,a)
//! the radius of the smallest sphere round the path of the deviatoric stress s, |s|^2 = s:s/2.
//! Strains are the elastic strain of the stress and the plastic strain. Where that changes, gamma_a is
//! the radius of the smallest circle round the path of the shear strain.
//!
//! Dang Van's tau is half of Tresca's stress of the difference between s and the centre of that
//! sphere, the stress of a grain that has shaken down. Of planes with equal tau_a, Matake's and
//! McDiarmid's criteria take the plane with the larger s_n,max, Brown and Miller's takes the plane
//! with the larger range. Smith, Watson and Topper's product is 0 without tension, Fatemi and
//! Socie's where the bracket is negative.

use material_table::{Allowed, Material};

use crate::ball::Ball;
use crate::combination::Combination;
use crate::error::Error;
use crate::invariants::{OfInvariants, crossland, dang_van};
use crate::judge::{Judge, strain_life};
use crate::life::CoffinManson;
use crate::path::Path;

/// A number of a criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its values.
    pub allowed: Allowed,
}

/// The numbers of a criterion in the order of its parameters, padded with 0.
pub(crate) type Numbers = [f64; 4];

/// A criterion without its numbers.
#[derive(Debug)]
pub struct Definition {
    /// Name, as in Python and on the command line.
    pub name: &'static str,
    /// Its title in figures.
    pub title: &'static str,
    /// The equation, with the unit of its value.
    pub equation: &'static str,
    /// Publication.
    pub source: &'static str,
    /// Unit of its value: Pa, or 1 for a strain.
    pub unit: &'static str,
    /// Its numbers.
    pub parameters: &'static [Parameter],
    /// Computes numbers and limit or curve from a material.
    pub(crate) from_material: fn(&Material) -> Result<(Numbers, Judge), Error>,
    /// Value in a uniaxial test of fully reversed strain that lasts for N cycles, for criteria that
    /// give lives.
    pub(crate) curve: fn(&CoffinManson, Numbers, f64) -> f64,
    /// Method of evaluation, for stresses in a unit \[Pa\].
    pub(crate) method: fn(Numbers, f64) -> Acts,
}

/// Method of evaluation of a criterion.
pub(crate) enum Acts {
    /// Evaluates the smallest sphere round the path of the deviatoric stress.
    OfInvariants(fn(&Path, &Ball<5>, Numbers) -> OfInvariants),
    /// Searches for the critical plane.
    OnPlanes(PlaneLaw),
}

/// A criterion on a plane: a law of two parts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneLaw {
    pub(crate) combination: Combination,
    /// The first part is tau_a if true, else the strain amplitude.
    pub(crate) shear: bool,
    /// The strain is the first number times s_n less the second times the sum of the normal
    /// stresses. The second part is s_n,max unless the strain amplitude is one and does not come
    /// first.
    pub(crate) strain: Option<[f64; 2]>,
    /// The value of the criterion divided by the value of the combination.
    pub(crate) factor: f64,
}

impl Definition {
    /// Looks up a criterion by its name.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        CRITERIA.iter().find(|d| d.name == name).ok_or_else(|| {
            let names: Vec<_> = CRITERIA.iter().map(|d| d.name).collect();
            Error::argument("criterion", name, format!("one of {}", names.join(", ")))
        })
    }
}

/// A number of a criterion, with the values that are allowed.
const fn parameter(name: &'static str, allowed: Allowed) -> Parameter {
    Parameter { name, allowed }
}

const ALPHA: Parameter = parameter("alpha", Allowed::Weight);
const K: Parameter = parameter("k", Allowed::Weight);
const MODULUS: Parameter = parameter("E", Allowed::Stress);
const NU: Parameter = parameter("nu", Allowed::Poisson);

/// All criteria.
///
/// The weights of those with a limit follow from the fatigue limits s_D in fully reversed bending
/// or tension and t_D in torsion, under both of which the criterion must equal its limit (derived
/// from its definition).
pub const CRITERIA: &[Definition] = &[
    Definition {
        name: "crossland",
        title: "Crossland",
        equation: "sqrt(J2,a) + alpha p_h,max [Pa]",
        source: "B. Crossland, Proc. Int. Conf. on Fatigue of Metals, IMechE, London (1956) 138-149",
        unit: "Pa",
        parameters: &[ALPHA],
        from_material: |m| {
            let (s_D, t_D) = limits(m)?;
            let alpha = 3.0 * t_D / s_D - 3.0_f64.sqrt();
            Ok(([alpha, 0.0, 0.0, 0.0], Judge::Limit(t_D)))
        },
        curve: without_lives,
        method: |_, _| {
            Acts::OfInvariants(|path, sphere, [alpha, ..]| crossland(path, sphere, alpha))
        },
    },
    Definition {
        name: "dang_van",
        title: "Dang Van",
        equation: "the largest tau(t) + alpha p_h(t) of the mesoscopic shear [Pa]",
        source: "K. Dang Van, ASTM STP 1191 (1993) 120-130",
        unit: "Pa",
        parameters: &[ALPHA],
        from_material: |m| {
            let (s_D, t_D) = limits(m)?;
            let alpha = 3.0 * t_D / s_D - 1.5;
            Ok(([alpha, 0.0, 0.0, 0.0], Judge::Limit(t_D)))
        },
        curve: without_lives,
        method: |_, _| {
            Acts::OfInvariants(|path, sphere, [alpha, ..]| dang_van(path, sphere, alpha))
        },
    },
    Definition {
        name: "findley",
        title: "Findley",
        equation: "the largest tau_a + k s_n,max of all planes [Pa]",
        source: "W. N. Findley, J. Eng. Ind. 81 (1959) 301-305",
        unit: "Pa",
        parameters: &[K],
        // k/sqrt(1 + k^2) = 2 t_D/s_D - 1, limit t_D sqrt(1 + k^2).
        from_material: |m| {
            let (s_D, t_D) = limits(m)?;
            let sine = 2.0 * t_D / s_D - 1.0;
            if sine >= 1.0 {
                let allowed = "below s_D: the limits fit no weight of Findley's";
                return Err(Error::argument("t_D", t_D, allowed));
            }
            let cosine = (1.0 - sine * sine).sqrt();
            Ok(([sine / cosine, 0.0, 0.0, 0.0], Judge::Limit(t_D / cosine)))
        },
        curve: without_lives,
        method: |[k, ..], unit| stress_on_planes(Combination::Sum(k), unit),
    },
    Definition {
        name: "matake",
        title: "Matake",
        equation: "tau_a + k s_n,max on the plane of the largest tau_a [Pa]",
        source: "T. Matake, Bull. JSME 20 (1977) 257-263",
        unit: "Pa",
        parameters: &[K],
        from_material: |m| {
            let (s_D, t_D) = limits(m)?;
            let k = 2.0 * t_D / s_D - 1.0;
            Ok(([k, 0.0, 0.0, 0.0], Judge::Limit(t_D)))
        },
        curve: without_lives,
        method: |[k, ..], unit| stress_on_planes(Combination::on_largest_first_part(k), unit),
    },
    Definition {
        name: "mcdiarmid",
        title: "McDiarmid",
        equation: "tau_a + k s_n,max on the plane of the largest tau_a, k = t_D/(2 s_u) [Pa]",
        source: "D. L. McDiarmid, Fatigue Fract. Eng. Mater. Struct. 14 (1991) 429-453",
        unit: "Pa",
        parameters: &[K],
        from_material: |m| {
            let t_D = m.number("t_D")?;
            let k = t_D / (2.0 * m.number("s_u")?);
            Ok(([k, 0.0, 0.0, 0.0], Judge::Limit(t_D)))
        },
        curve: without_lives,
        method: |[k, ..], unit| stress_on_planes(Combination::on_largest_first_part(k), unit),
    },
    Definition {
        name: "smith_watson_topper",
        title: "Smith-Watson-Topper",
        equation: "the largest s_n,max times half the range of the normal strain [Pa]",
        source: "K. N. Smith, P. Watson, T. H. Topper, J. Mater. 5 (1970) 767-778;\n\
                 D. F. Socie, J. Eng. Mater. Technol. 109 (1987) 293-298",
        unit: "Pa",
        parameters: &[MODULUS, NU],
        from_material: |m| {
            let numbers = [m.number("E")?, m.number("nu")?, 0.0, 0.0];
            Ok((numbers, Judge::Life(strain_life(m)?)))
        },
        curve: |curve, _, cycles| curve.smith_watson_topper(cycles),
        method: |[E, nu, ..], unit| {
            Acts::OnPlanes(PlaneLaw {
                combination: Combination::Product,
                shear: false,
                strain: Some([1.0 + nu, nu]),
                factor: unit * (unit / E),
            })
        },
    },
    Definition {
        name: "fatemi_socie",
        title: "Fatemi-Socie",
        equation: "the largest gamma_a (1 + k s_n,max/s_y) of all planes",
        source: "A. Fatemi, D. F. Socie, Fatigue Fract. Eng. Mater. Struct. 11 (1988) 149-165",
        unit: "1",
        parameters: &[MODULUS, NU, K, parameter("s_y", Allowed::Stress)],
        from_material: |m| {
            let numbers = [
                m.number("E")?,
                m.number("nu")?,
                m.number("k")?,
                m.number("s_y")?,
            ];
            Ok((numbers, Judge::Life(strain_life(m)?)))
        },
        curve: |curve, [_, nu, k, s_y], cycles| curve.fatemi_socie(cycles, nu, k, s_y),
        method: |[E, nu, k, s_y], unit| {
            Acts::OnPlanes(PlaneLaw {
                combination: Combination::Raised(k / s_y * unit),
                shear: true,
                strain: None,
                factor: 2.0 * (1.0 + nu) * (unit / E),
            })
        },
    },
    Definition {
        name: "brown_miller",
        title: "Brown-Miller",
        equation: "gamma_a + S times the range of the normal strain, where gamma_a is largest",
        source: "F. A. Kandil, M. W. Brown, K. J. Miller, The Metals Society Book 280 (1982) 203-210",
        unit: "1",
        parameters: &[MODULUS, NU, parameter("S", Allowed::Weight)],
        from_material: |m| {
            let numbers = [m.number("E")?, m.number("nu")?, m.number("S")?, 0.0];
            Ok((numbers, Judge::Life(strain_life(m)?)))
        },
        curve: |curve, [_, nu, S, _], cycles| curve.brown_miller(cycles, nu, S),
        // In multiples of tau/G: the normal strain over 2 (1 + nu)/E, whose range is twice the
        // amplitude.
        method: |[E, nu, S, _], unit| {
            Acts::OnPlanes(PlaneLaw {
                combination: Combination::on_largest_first_part(2.0 * S),
                shear: true,
                strain: Some([0.5, nu / (2.0 * (1.0 + nu))]),
                factor: 2.0 * (1.0 + nu) * (unit / E),
            })
        },
    },
];

/// Fatigue limits of a material in tension or bending and in torsion \[Pa\].
fn limits(material: &Material) -> Result<(f64, f64), Error> {
    Ok((material.number("s_D")?, material.number("t_D")?))
}

/// Combines tau_a and s_n,max.
fn stress_on_planes(combination: Combination, unit: f64) -> Acts {
    Acts::OnPlanes(PlaneLaw {
        combination,
        shear: true,
        strain: None,
        factor: unit,
    })
}

/// Curve of a criterion that has a limit: no life.
fn without_lives(_: &CoffinManson, _: Numbers, _: f64) -> f64 {
    f64::NAN
}
