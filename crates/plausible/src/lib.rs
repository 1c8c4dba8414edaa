//! The range in which a number is meant: one row per quantity.
//!
//! A number outside its range is allowed and doubted: nearly always its unit is another one. Scene,
//! wear, heat, fatigue, cracks and fits take their doubts from this table, in Rust, in Python and on
//! the command line. What is compared with another number of the scene, such as a contact radius with
//! the grid, has no row here.

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// Unit; empty for a number.
    pub unit: &'static str,
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

const fn below(
    name: &'static str,
    unit: &'static str,
    least: f64,
    outside: &'static str,
    usual: &'static str,
) -> Quantity {
    Quantity {
        name,
        unit,
        least,
        most: f64::INFINITY,
        outside,
        usual,
    }
}

const fn above(
    name: &'static str,
    unit: &'static str,
    most: f64,
    outside: &'static str,
    usual: &'static str,
) -> Quantity {
    Quantity {
        name,
        unit,
        least: 0.0,
        most,
        outside,
        usual,
    }
}

/// All rows.
pub const QUANTITIES: &[Quantity] = &[
    below(
        "modulus",
        "Pa",
        1e3,
        "less than that of the softest gel",
        UNITS,
    ),
    above("radius", "m", 1.0, "large", UNITS),
    above(
        "friction",
        "",
        3.0,
        "more than surfaces have",
        "it is a number, not per cent: 30 % is 0.3",
    ),
    below(
        "bulk stress",
        "Pa",
        1e4,
        "less than any fatigue load",
        STRESSES,
    ),
    below(
        "residual stress",
        "Pa",
        1e4,
        "less than any process leaves",
        STRESSES,
    ),
    below(
        "material stress",
        "Pa",
        1e5,
        "less than any solid has",
        STRESSES,
    ),
    below(
        "strength",
        "Pa",
        1e3,
        "less than any interface has",
        STRESSES,
    ),
    below(
        "threshold",
        "Pa m^0.5",
        1e3,
        "less than any solid has",
        "4 MPa m^0.5 is 4e6 Pa m^0.5",
    ),
    above(
        "toughness",
        "J/m^2",
        1e7,
        "more than any solid has",
        "an energy per area: 90 J/m^2 is 90",
    ),
    above(
        "wear coefficient",
        "m^2/N",
        1e-10,
        "more than any surface wears by",
        WEAR,
    ),
    above(
        "energy wear coefficient",
        "m^3/J",
        1e-10,
        "more than any surface wears by",
        WEAR,
    ),
    below(
        "conductivity",
        "W/(m K)",
        0.1,
        "less than any solid has that bears a contact",
        "0.045 W/(mm K) is 45 W/(m K)",
    ),
    below(
        "heat capacity",
        "J/(m^3 K)",
        1e4,
        "less than any solid has",
        "density times specific heat: steel has 7850 kg/m^3 times 460 J/(kg K), 3.6e6",
    ),
    below(
        "density",
        "kg/m^3",
        50.0,
        "less than any solid has",
        "7.85 g/cm^3 is 7850 kg/m^3",
    ),
    below(
        "specific heat",
        "J/(kg K)",
        10.0,
        "less than any solid has",
        "0.46 J/(g K) is 460 J/(kg K)",
    ),
];

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
    /// The doubt of a value, if it lies outside the range; `key` is its name where it was given.
    pub fn doubt(&self, key: &str, value: f64) -> Option<String> {
        let size = value.abs();
        let meant = size == 0.0 || !size.is_finite() || (self.least <= size && size <= self.most);
        let unit = if self.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", self.unit)
        };
        let value = if (1e-3..1e6).contains(&size) {
            value.to_string()
        } else {
            format!("{value:e}")
        };
        (!meant).then(|| format!("{key} = {value}{unit} is {}: {}", self.outside, self.usual))
    }
}

/// The doubt of a value of a quantity.
///
/// # Panics
///
/// As [`quantity`].
pub fn doubt(name: &str, key: &str, value: f64) -> Option<String> {
    quantity(name).doubt(key, value)
}

#[cfg(test)]
mod tests {
    use super::{QUANTITIES, doubt};

    #[test]
    fn every_row_doubts_what_lies_outside_and_nothing_else() {
        for row in QUANTITIES {
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
                let told = row.doubt("x", value).unwrap();
                assert!(
                    told.contains(row.unit) && told.starts_with("x = "),
                    "{told}"
                );
            }
            for value in [0.0, f64::INFINITY, f64::NAN] {
                assert_eq!(row.doubt("x", value), None);
            }
            assert_eq!(QUANTITIES.iter().filter(|q| q.name == row.name).count(), 1);
        }
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
        ] {
            assert_eq!(doubt(name, "x", meant), None, "{name}");
            assert!(doubt(name, "x", slip).is_some(), "{name}");
        }
    }
}
