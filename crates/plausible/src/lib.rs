//! The range in which a number is meant: one row per quantity.
//!
//! A number outside its range is allowed and doubted: nearly always its unit is another one. Scene,
//! wear, heat, fatigue, cracks and fits take their doubts from this table, in Rust, in Python and on
//! the command line; and so do the texts with units that a number may be given as ([`mod@unit`]). What is
//! compared with another number of the scene, such as a contact radius with the grid, has no row here.

pub mod unit;

use unit::Kind;

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// What it measures, and so its units.
    pub kind: Kind,
    /// Its keys: last names of keys of a scene file, parameters of functions, with what stands before
    /// them where the last name alone has several meanings: `body2.k`, `Archard.k`.
    pub keys: &'static [&'static str],
    /// Smallest size that is meant; 0 where any is. Zero itself is not doubted.
    pub least: f64,
    /// Largest size that is meant; infinite where any is.
    pub most: f64,
    /// What a number outside the range is, as the end of "is ...".
    pub outside: &'static str,
    /// How the unit is meant.
    pub usual: &'static str,
}

/// Units of a scene, as the end of a doubt.
pub const UNITS: &str =
    "lengths are in m, moduli in Pa, forces in N: 3 um is 3e-6, 114 GPa is 114e9";
const STRESSES: &str = "stresses are in Pa: 300 MPa is 300e6";
const WEAR: &str = "1e-5 mm^3/(N m) is 1e-14 m^2/N, and 1e-5 mm^3/J is 1e-14 m^3/J";
const ANY: f64 = f64::INFINITY;

/// A quantity that may have any size.
const fn any(name: &'static str, kind: Kind, keys: &'static [&'static str]) -> Quantity {
    of(name, kind, keys, (0.0, ANY), "", "")
}

/// A row of the table: name, kind, keys in scene files, plausible range, and the words for values outside and
/// for the usual ones.
const fn of(
    name: &'static str,
    kind: Kind,
    keys: &'static [&'static str],
    (least, most): (f64, f64),
    outside: &'static str,
    usual: &'static str,
) -> Quantity {
    Quantity {
        name,
        kind,
        keys,
        least,
        most,
        outside,
        usual,
    }
}

/// All rows.
pub const QUANTITIES: &[Quantity] = &[
    of(
        "modulus",
        Kind::Stress,
        &["E"],
        (1e3, ANY),
        "less than the softest gel's",
        UNITS,
    ),
    of(
        "radius",
        Kind::Length,
        &["R", "R_x", "R_y"],
        (0.0, 1.0),
        "large",
        UNITS,
    ),
    any(
        "length",
        Kind::Length,
        &[
            "length",
            "crown",
            "radius",
            "Hertz.a",
            "HertzStress.a",
            "Lubkin.q.c",
            "middle",
            "dx",
            "dy",
            "width",
            "edge",
            "amplitude",
            "wavelength",
            "rms",
            "longest",
            "shortest",
            "depth",
            "extent",
            "L",
            "z",
            "start",
            "end",
            "spacing",
            "delta_x",
            "delta_y",
            "delta_z",
            "rolled",
            "bulk_neutral_depth",
            "Air.distance",
            "air.distance",
            "closed_below",
            "protecting_thickness",
            "friction.bed.thickness",
            "grow_by_history.x",
        ],
    ),
    any("depth over a_H", Kind::Number, &["stress_maps.depth"]),
    of(
        "thickness",
        Kind::Length,
        &["thickness"],
        (0.0, 0.1),
        "more than any layer's",
        UNITS,
    ),
    of(
        "measured shift",
        Kind::Length,
        &["Loops.delta", "Indentation.delta_z", "Scar.depth"],
        (0.0, 5e-3),
        "far for a contact",
        UNITS,
    ),
    of(
        "place on a scar",
        Kind::Length,
        &["Scar.x"],
        (0.0, 0.1),
        "far for a contact",
        UNITS,
    ),
    of(
        "length of a crack",
        Kind::Length,
        &["lengths", "Crack.length"],
        (0.0, 0.1),
        "long for a crack",
        "lengths are in m: 10 um is 1e-5",
    ),
    of(
        "angle",
        Kind::Angle,
        &[
            "angle",
            "azimuth",
            "bulk_azimuth",
            "phase",
            "phi_x",
            "phi_y",
            "phi_z",
        ],
        (0.0, 6.5),
        "more than a turn",
        "angles are in radians: 45 degrees is 0.785",
    ),
    any("force", Kind::Force, &["W", "T_x", "T_y"]),
    // What the loads of a closed form measure depends on its contact.
    any(
        "load of a closed form",
        Kind::WholeForce,
        &["Hertz.W", "CattaneoMindlin.T"],
    ),
    any(
        "load of a line contact",
        Kind::ForcePerLength,
        &["line_contact.W", "LineContact.T"],
    ),
    any("contact modulus", Kind::Stress, &["E_star"]),
    any(
        "peak pressure",
        Kind::Stress,
        &["p0", "Air.pressure", "air.pressure"],
    ),
    any("moment", Kind::Moment, &["M_x", "M_y", "M_z"]),
    of(
        "stiffness",
        Kind::Stiffness,
        &["stiffness", "rig_stiffness"],
        (100.0, ANY),
        "less than any rig has",
        "20 N/um is 20e6 N/m",
    ),
    any("frequency", Kind::Frequency, &["frequency"]),
    any("time", Kind::Time, &["t"]),
    of(
        "friction",
        Kind::Number,
        &["mu", "mu_y", "kinetic", "friction", "layers"],
        (0.0, 3.0),
        "more than surfaces have",
        "it is a number, not per cent: 30 % is 0.3",
    ),
    of(
        "compliance of a bond",
        Kind::Compliance,
        &["bond_normal", "Bond.normal"],
        (0.0, 1e-6),
        "more than any joint has",
        "1 um/MPa is 1e-12 m/Pa",
    ),
    // A large one is an interface without friction.
    any(
        "compliance of a bond in shear",
        Kind::Compliance,
        &["bond_shear", "Bond.shear"],
    ),
    of(
        "bulk stress",
        Kind::Stress,
        &["sigma_B", "sigma_B1"],
        (1e4, ANY),
        "less than any fatigue load",
        STRESSES,
    ),
    of(
        "stress history",
        Kind::Stress,
        &["evaluate_margin.stress"],
        (1e3, ANY),
        "less than any fatigue load",
        STRESSES,
    ),
    of(
        "residual stress",
        Kind::Stress,
        &["residual"],
        (1e4, ANY),
        "less than any process leaves",
        STRESSES,
    ),
    of(
        "depth of a residual stress",
        Kind::Length,
        &["residual.depth"],
        (0.0, 5e-3),
        "deep for the second point of a process",
        "depths are in m: 50 um is 5e-5",
    ),
    of(
        "deepest residual stress",
        Kind::Length,
        &["residual.deepest"],
        (0.0, 0.1),
        "deeper than any process",
        "depths are in m: 50 um is 5e-5",
    ),
    of(
        "material stress",
        Kind::Stress,
        &[
            "s_y",
            "s_u",
            "s_D",
            "t_D",
            "s_f",
            "dS_0",
            "hardening",
            "kinematic",
            "voce_Q",
            "chaboche_C",
            "stress_amplitude",
            "hardness",
            "yield_stress",
        ],
        (1e5, ANY),
        "less than any solid has",
        STRESSES,
    ),
    of(
        "strength",
        Kind::Stress,
        &["peel_strength", "shear_strength"],
        (1e3, ANY),
        "less than any interface has",
        STRESSES,
    ),
    of(
        "threshold",
        Kind::Intensity,
        &["dK_th"],
        (1e3, ANY),
        "less than any solid has",
        "4 MPa m^0.5 is 4e6 Pa m^0.5",
    ),
    of(
        "toughness",
        Kind::Toughness,
        &["toughness"],
        (0.0, 1e7),
        "more than any solid has",
        "an energy per area: 90 J/m^2 is 90",
    ),
    of(
        "crack growth",
        Kind::Growth,
        &["Paris.C", "paris_C"],
        (1e-16, 1e-6),
        "outside of what solids have",
        "it is the growth at 1 MPa m^0.5: 5e-9 mm per cycle is 5e-12",
    ),
    of(
        "wear coefficient",
        Kind::Wear,
        &[
            "Archard.k",
            "Archard.starved",
            "body1.k",
            "body2.k",
            "laws.k",
        ],
        (0.0, 1e-10),
        "more than any surface wears by",
        WEAR,
    ),
    of(
        "energy wear coefficient",
        Kind::EnergyWear,
        &[
            "DissipatedEnergy.alpha",
            "DissipatedEnergy.starved",
            "body1.alpha",
            "body2.alpha",
            "laws.alpha",
        ],
        (0.0, 1e-10),
        "more than any surface wears by",
        WEAR,
    ),
    of(
        "thermal expansion",
        Kind::Expansion,
        &["alpha_T", "alpha_coating", "alpha_substrate"],
        (0.0, 1e-3),
        "more than any solid has",
        "9.4 um/(m K) is 9.4e-6 1/K",
    ),
    of(
        "conductivity",
        Kind::Conductivity,
        &["conductivity"],
        (0.1, ANY),
        "less than any solid has that bears a contact",
        "0.045 W/(mm K) is 45 W/(m K)",
    ),
    of(
        "heat capacity",
        Kind::HeatCapacity,
        &["heat_capacity"],
        (1e4, ANY),
        "less than any solid has",
        "density times specific heat: steel has 7850 kg/m^3 times 460 J/(kg K), 3.6e6",
    ),
    of(
        "density",
        Kind::Density,
        &["density"],
        (50.0, ANY),
        "less than any solid has",
        "7.85 g/cm^3 is 7850 kg/m^3",
    ),
    of(
        "specific heat",
        Kind::SpecificHeat,
        &["specific_heat"],
        (10.0, ANY),
        "less than any solid has",
        "0.46 J/(g K) is 460 J/(kg K)",
    ),
];

/// The row of a key such as `body2.coatings[0].E`, `Archard.k`: the row of the longest end that is
/// known.
pub fn of_key(key: &str) -> Option<&'static Quantity> {
    let parts = key.split('[').enumerate();
    let plain: String = parts
        .map(|(n, part)| {
            if n == 0 {
                part
            } else {
                part.split_once(']').map_or("", |of| of.1)
            }
        })
        .collect();
    let ends = |end: &&str| {
        plain
            .strip_suffix(*end)
            .is_some_and(|before| before.is_empty() || before.ends_with('.'))
    };
    let length = |q: &&Quantity| {
        q.keys
            .iter()
            .filter(|end| ends(end))
            .map(|end| end.len())
            .max()
    };
    QUANTITIES
        .iter()
        .filter(|q| length(q).is_some())
        .max_by_key(length)
}

/// A warning that a value is implausible for its key; none if it is plausible. `shown` is its name for the
/// user.
pub fn doubt_of(key: &str, shown: &str, value: f64) -> Option<String> {
    of_key(key)?.doubt(shown, value)
}

/// The row of a name.
///
/// # Panics
///
/// There is no such row: names are part of the program.
pub fn quantity(name: &str) -> &'static Quantity {
    let row = QUANTITIES.iter().find(|q| q.name == name);
    row.unwrap_or_else(|| panic!("no quantity {name}"))
}

impl Quantity {
    /// A warning that a value lies outside the plausible range; none if it does not. `key` is its name for the
    /// user.
    pub fn doubt(&self, key: &str, value: f64) -> Option<String> {
        let size = value.abs();
        let meant = size == 0.0 || !size.is_finite() || (self.least <= size && size <= self.most);
        let unit = match self.kind.unit() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        let value = if (1e-3..1e6).contains(&size) {
            value.to_string()
        } else {
            format!("{value:e}")
        };
        (!meant).then(|| {
            let degrees = match self.kind {
                Kind::Angle => {
                    let radians = size.to_radians();
                    format!(". If {value} are degrees, write \"{value} deg\" or {radians:.6}")
                }
                _ => String::new(),
            };
            let (outside, usual) = (self.outside, self.usual);
            format!("{key} = {value}{unit} is {outside}: {usual}{degrees}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{QUANTITIES, of_key, quantity};

    #[test]
    fn every_row_doubts_what_lies_outside_and_nothing_else() {
        for row in QUANTITIES
            .iter()
            .filter(|q| q.least > 0.0 || q.most.is_finite())
        {
            let inside = [row.least, row.most].into_iter().filter(|v| v.is_finite());
            assert!(
                inside.clone().all(|v| row.doubt("x", v).is_none()),
                "{row:?}"
            );
            let outside = if row.least > 0.0 {
                0.99 * row.least
            } else {
                1.01 * row.most
            };
            for value in [outside, -outside] {
                let text = row.doubt("x", value).unwrap();
                assert!(
                    text.contains(row.kind.unit()) && text.starts_with("x = "),
                    "{text}"
                );
            }
            for value in [0.0, f64::INFINITY, f64::NAN] {
                assert_eq!(row.doubt("x", value), None);
            }
        }
    }

    #[test]
    fn a_name_and_a_key_have_one_row() {
        for row in QUANTITIES {
            assert_eq!(QUANTITIES.iter().filter(|q| q.name == row.name).count(), 1);
            for key in row.keys {
                assert_eq!(of_key(key), Some(row), "{key}");
                assert_eq!(of_key(&format!("a.b[3].{key}[1]")), Some(row), "{key}");
                assert_ne!(of_key(&format!("un{key}")), Some(row), "{key}");
            }
        }
        // The same name elsewhere has another meaning.
        assert_eq!(of_key("Criterion.findley.k"), None);
        assert_eq!(of_key("path.1.delta_x").unwrap().name, "length");
        assert_eq!(
            of_key("Indentation.delta_z").unwrap().name,
            "measured shift"
        );
        assert_eq!(of_key("nu"), None);
    }

    #[test]
    fn the_usual_slips_are_doubted_and_usual_numbers_are_not() {
        for (name, meant, slip) in [
            ("modulus", 210e9, 210.0),
            ("radius", 0.01, 10.0),
            ("friction", 0.3, 30.0),
            ("bulk stress", -200e6, -200.0),
            ("residual stress", -2e9, -2.0),
            ("material stress", 500e6, 500.0),
            ("strength", 3e8, 300.0),
            ("threshold", 4e6, 4.0),
            ("wear coefficient", 1e-14, 1e-5),
            ("energy wear coefficient", 1e-14, 1e-5),
            ("conductivity", 45.0, 0.045),
            ("heat capacity", 3.6e6, 3.6e-3),
            ("density", 7850.0, 7.85),
            ("specific heat", 460.0, 0.46),
            ("stiffness", 2e7, 20.0),
            ("thickness", 3e-6, 3.0),
            ("length of a crack", 1e-5, 10.0),
            ("thermal expansion", 9.4e-6, 9.4),
            ("compliance of a bond", 1e-12, 1.0),
            ("measured shift", 1e-5, 10.0),
            ("angle", 0.785, 45.0),
        ] {
            assert_eq!(quantity(name).doubt("x", meant), None, "{name}");
            assert!(quantity(name).doubt("x", slip).is_some(), "{name}");
        }
    }
}
