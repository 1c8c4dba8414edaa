//! Material data for the criteria, every number with its source.

use std::collections::BTreeMap;

use crate::allowed::Allowed;
use crate::error::Error;

/// A number of a material that a criterion may need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Name, as in the file.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Description.
    pub long_name: &'static str,
    /// Its values.
    pub allowed: Allowed,
}

/// A positive quantity with its unit and meaning.
const fn quantity(name: &'static str, unit: &'static str, long_name: &'static str) -> Quantity {
    Quantity {
        name,
        unit,
        long_name,
        allowed: Allowed::Positive,
    }
}

/// A negative exponent without a unit.
const fn exponent(name: &'static str, long_name: &'static str) -> Quantity {
    Quantity {
        name,
        unit: "1",
        long_name,
        allowed: Allowed::Negative,
    }
}

/// All quantities of a file of materials.
pub const QUANTITIES: &[Quantity] = &[
    quantity("E", "Pa", "Young's modulus"),
    Quantity {
        allowed: Allowed::Poisson,
        ..quantity("nu", "1", "Poisson's ratio")
    },
    quantity("s_y", "Pa", "yield stress"),
    quantity("s_u", "Pa", "tensile strength"),
    quantity(
        "s_D",
        "Pa",
        "fatigue limit, amplitude of fully reversed tension or bending",
    ),
    quantity(
        "t_D",
        "Pa",
        "fatigue limit, amplitude of fully reversed torsion",
    ),
    quantity("s_f", "Pa", "fatigue strength coefficient"),
    exponent("b", "fatigue strength exponent"),
    quantity("e_f", "1", "fatigue ductility coefficient"),
    exponent("c", "fatigue ductility exponent"),
    quantity(
        "k",
        "1",
        "weight of the normal stress in Fatemi and Socie's criterion",
    ),
    quantity(
        "S",
        "1",
        "weight of the normal strain in Brown and Miller's criterion",
    ),
    quantity(
        "dK_th",
        "Pa m^0.5",
        "threshold range of the stress intensity, R = -1",
    ),
    quantity(
        "paris_C",
        "m/cycle at 1 MPa m^0.5",
        "coefficient of Paris' combination, R = 0",
    ),
    quantity("paris_m", "1", "exponent of Paris' law"),
    quantity(
        "walker",
        "1",
        "exponent gamma of Walker's dependence of crack growth on R",
    ),
    quantity("alpha_T", "1/K", "thermal expansion"),
    quantity("density", "kg/m^3", "density"),
    quantity("specific_heat", "J/(kg K)", "specific heat"),
    quantity("conductivity", "W/(m K)", "thermal conductivity"),
    quantity(
        "hardness",
        "Pa",
        "indentation hardness, force over area (1 HV is 9.807 MPa)",
    ),
];

/// A number and its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Sourced {
    /// Value, in the unit of its quantity.
    pub value: f64,
    /// Publication or test.
    pub source: String,
}

impl Sourced {
    /// A number of [`QUANTITIES`] by its name; fails with the reason.
    pub(crate) fn of(
        name: &str,
        value: f64,
        source: String,
    ) -> Result<(&'static str, Self), String> {
        let quantity = known(name)?;
        Ok((quantity.name, Self::new(value, source, quantity)?))
    }

    /// Fails with the reason at a value that the quantity cannot have, and without a source.
    pub(crate) fn new(value: f64, source: String, quantity: &Quantity) -> Result<Self, String> {
        if source.trim().is_empty() {
            return Err("has no source".into());
        }
        if !quantity.allowed.holds(value) {
            return Err(format!("{value}: must be {}", quantity.allowed.wanted()));
        }
        Ok(Self { value, source })
    }
}

/// The data of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the table.
    pub name: String,
    /// Description.
    pub title: String,
    /// Kind: steel, metal, ceramic, coating, polymer; empty where nothing is given.
    pub kind: String,
    /// Other names that it is found by.
    pub also: Vec<String>,
    /// Its numbers by the names of [`QUANTITIES`].
    pub numbers: BTreeMap<&'static str, Sourced>,
}

impl Material {
    /// A material of the user; every number with its name of [`QUANTITIES`], value and source.
    pub fn new(
        name: &str,
        title: &str,
        numbers: impl IntoIterator<Item = (String, f64, String)>,
    ) -> Result<Self, Error> {
        let mut material = Self {
            name: name.to_owned(),
            title: title.to_owned(),
            kind: String::new(),
            also: Vec::new(),
            numbers: BTreeMap::new(),
        };
        for (key, value, source) in numbers {
            let found = Sourced::of(&key, value, source).map_err(|why| Error::Material {
                material: name.to_owned(),
                key,
                why,
            })?;
            material.numbers.insert(found.0, found.1);
        }
        Ok(material)
    }

    /// Warnings for numbers that seem to be in another unit.
    pub fn doubts(&self) -> Vec<String> {
        let doubt = |(name, of): (&&str, &Sourced)| {
            let key = format!("material {}: {name}", self.name);
            plausible::doubt_of(name, &key, of.value)
        };
        self.numbers.iter().filter_map(doubt).collect()
    }

    /// A number; fails with the missing name and the known ones.
    pub fn number(&self, name: &str) -> Result<f64, Error> {
        if let Some(sourced) = self.numbers.get(name) {
            return Ok(sourced.value);
        }
        let meaning = QUANTITIES.iter().find(|q| q.name == name);
        let meaning = meaning.map_or("", |q| q.long_name);
        let known: Vec<_> = self.numbers.keys().copied().collect();
        Err(Error::Material {
            material: self.name.clone(),
            key: name.to_owned(),
            why: format!(
                "is missing ({meaning}); known of it are {}",
                known.join(", ")
            ),
        })
    }
}

/// The quantity of a name; fails with the nearest one.
pub(crate) fn known(key: &str) -> Result<&'static Quantity, String> {
    if let Some(quantity) = QUANTITIES.iter().find(|q| q.name == key) {
        return Ok(quantity);
    }
    let near = QUANTITIES
        .iter()
        .map(|q| (strsim::jaro_winkler(q.name, key), q.name));
    let near = near
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map_or("", |(_, name)| name);
    let names: Vec<_> = QUANTITIES.iter().map(|q| q.name).collect();
    Err(format!(
        "unknown; nearest is {near}; there are title, kind, also, family, {}",
        names.join(", ")
    ))
}
