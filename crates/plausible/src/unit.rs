//! Units by their names: what each measures, and its size in SI.

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number without a unit.
    Number,
    /// Length.
    Length,
    /// Force of any contact; in a line contact per length.
    Force,
    /// Force of a contact that is no line.
    WholeForce,
    /// Force per length, of a line contact.
    ForcePerLength,
    /// Moment; in a line contact per length.
    Moment,
    /// Angle.
    Angle,
    /// Stress, pressure, modulus.
    Stress,
    /// Time.
    Time,
    /// Force per shift.
    Stiffness,
    /// Cycles per time.
    Frequency,
    /// Approach or slip of a bond per traction.
    Compliance,
    /// Stress intensity.
    Intensity,
    /// Energy per area.
    Toughness,
    /// Worn volume per force and way.
    Wear,
    /// Worn volume per energy.
    EnergyWear,
    /// Thermal conductivity.
    Conductivity,
    /// Heat capacity of a volume.
    HeatCapacity,
    /// Mass of a volume.
    Density,
    /// Heat capacity of a mass.
    SpecificHeat,
    /// Strain per temperature.
    Expansion,
    /// Length per cycle at 1 MPa m^0.5.
    Growth,
}

impl Kind {
    /// The unit of this kind in SI; empty for a number.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Number => "",
            Self::Length => "m",
            Self::Force | Self::WholeForce => "N",
            Self::Moment => "N m",
            Self::Angle => "rad",
            Self::Stress => "Pa",
            Self::Time => "s",
            Self::ForcePerLength | Self::Stiffness => "N/m",
            Self::Frequency => "Hz",
            Self::Compliance => "m/Pa",
            Self::Intensity => "Pa m^0.5",
            Self::Toughness => "J/m^2",
            Self::Wear => "m^2/N",
            Self::EnergyWear => "m^3/J",
            Self::Conductivity => "W/(m K)",
            Self::HeatCapacity => "J/(m^3 K)",
            Self::Density => "kg/m^3",
            Self::SpecificHeat => "J/(kg K)",
            Self::Expansion => "1/K",
            Self::Growth => "m/cycle at 1 MPa m^0.5",
        }
    }

    /// The name of this kind.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Length => "length",
            Self::Force => "force",
            Self::WholeForce => "force of a contact that is no line",
            Self::ForcePerLength => "force per length",
            Self::Moment => "moment",
            Self::Angle => "angle",
            Self::Stress => "stress",
            Self::Time => "time",
            Self::Stiffness => "stiffness",
            Self::Frequency => "frequency",
            Self::Compliance => "compliance",
            Self::Intensity => "stress intensity",
            Self::Toughness => "energy per area",
            Self::Wear => "wear coefficient",
            Self::EnergyWear => "energy wear coefficient",
            Self::Conductivity => "conductivity",
            Self::HeatCapacity => "heat capacity",
            Self::Density => "density",
            Self::SpecificHeat => "specific heat",
            Self::Expansion => "thermal expansion",
            Self::Growth => "crack growth",
        }
    }

    /// The size in SI of a unit of this kind, by its name.
    pub fn size(self, name: &str) -> Option<f64> {
        let (kind, size) = named(name)?;
        self.takes(kind).then_some(size)
    }

    /// Whether units of another kind measure this one: a force per length is a stiffness, too.
    fn takes(self, of: Self) -> bool {
        self == of
            || matches!(
                (self, of),
                (Self::Force | Self::Stiffness, Self::ForcePerLength)
                    | (Self::WholeForce, Self::Force)
            )
    }
}

/// A number of a unit in SI, rounded once: 20 um is 20/1e6 m, as a reader writes it, not 20 * 1e-6 m.
pub fn times(number: f64, size: f64) -> f64 {
    let parts = (1.0 / size).round();
    if parts > 1.0 && size == 1.0 / parts {
        number / parts
    } else {
        number * size
    }
}

/// A unit: what it measures, and its size in SI units. Forces and moments of line contacts are per
/// metre.
pub type Unit = (Kind, f64);

/// Pa m^0.5 in one N/mm^1.5: 1e6 sqrt(1e-3).
const PER_ROOT_MM: f64 = 31_622.776_601_683_795;

const UNITS: &[(&str, Kind, f64)] = {
    use Kind::{
        Angle, Compliance, Conductivity, Density, EnergyWear, Expansion, Force, ForcePerLength,
        Frequency, HeatCapacity, Intensity, Length, Moment, Number, SpecificHeat, Stiffness,
        Stress, Time, Toughness, Wear,
    };
    &[
        ("1/K", Expansion, 1.0),
        ("1/°C", Expansion, 1.0),
        ("um/(m K)", Expansion, 1e-6),
        ("ppm/K", Expansion, 1e-6),
        ("m", Length, 1.0),
        ("cm", Length, 1e-2),
        ("mm", Length, 1e-3),
        ("um", Length, 1e-6),
        ("micron", Length, 1e-6),
        ("microns", Length, 1e-6),
        ("micrometer", Length, 1e-6),
        ("micrometers", Length, 1e-6),
        ("micrometre", Length, 1e-6),
        ("micrometres", Length, 1e-6),
        ("nm", Length, 1e-9),
        ("pm", Length, 1e-12),
        ("å", Length, 1e-10),
        ("angstrom", Length, 1e-10),
        ("in", Length, 0.0254),
        ("inch", Length, 0.0254),
        ("mil", Length, 25.4e-6),
        ("mils", Length, 25.4e-6),
        ("N", Force, 1.0),
        ("uN", Force, 1e-6),
        ("mN", Force, 1e-3),
        ("kN", Force, 1e3),
        ("MN", Force, 1e6),
        ("newton", Force, 1.0),
        ("kgf", Force, 9.806_65),
        ("lbf", Force, 4.448_221_615_260_5),
        ("N/m", ForcePerLength, 1.0),
        ("N/mm", ForcePerLength, 1e3),
        ("kN/m", ForcePerLength, 1e3),
        ("kN/mm", ForcePerLength, 1e6),
        ("MN/m", ForcePerLength, 1e6),
        ("Nm", Moment, 1.0),
        ("N m", Moment, 1.0),
        ("N*m", Moment, 1.0),
        ("N.m", Moment, 1.0),
        ("mNm", Moment, 1e-3),
        ("Nmm", Moment, 1e-3),
        ("N mm", Moment, 1e-3),
        ("N*mm", Moment, 1e-3),
        ("kNm", Moment, 1e3),
        ("rad", Angle, 1.0),
        ("mrad", Angle, 1e-3),
        ("urad", Angle, 1e-6),
        ("deg", Angle, std::f64::consts::PI / 180.0),
        ("degree", Angle, std::f64::consts::PI / 180.0),
        ("degrees", Angle, std::f64::consts::PI / 180.0),
        ("°", Angle, std::f64::consts::PI / 180.0),
        ("Pa", Stress, 1.0),
        ("kPa", Stress, 1e3),
        ("MPa", Stress, 1e6),
        ("N/mm2", Stress, 1e6),
        ("N/mm^2", Stress, 1e6),
        ("N/mm²", Stress, 1e6),
        ("GPa", Stress, 1e9),
        ("kN/mm^2", Stress, 1e9),
        ("kN/mm2", Stress, 1e9),
        ("psi", Stress, 6_894.757_293_168),
        ("ksi", Stress, 6_894_757.293_168),
        ("s", Time, 1.0),
        ("sec", Time, 1.0),
        ("ms", Time, 1e-3),
        ("us", Time, 1e-6),
        ("min", Time, 60.0),
        ("h", Time, 3600.0),
        ("N/um", Stiffness, 1e6),
        ("kN/um", Stiffness, 1e9),
        ("N/nm", Stiffness, 1e9),
        ("Hz", Frequency, 1.0),
        ("kHz", Frequency, 1e3),
        ("1/s", Frequency, 1.0),
        ("1/min", Frequency, 1.0 / 60.0),
        ("m/Pa", Compliance, 1.0),
        ("um/MPa", Compliance, 1e-12),
        ("nm/MPa", Compliance, 1e-15),
        ("mm^3/N", Compliance, 1e-9),
        ("Pa m^0.5", Intensity, 1.0),
        ("MPa m^0.5", Intensity, 1e6),
        ("MPa*m^0.5", Intensity, 1e6),
        ("MPa√m", Intensity, 1e6),
        ("N/mm^1.5", Intensity, PER_ROOT_MM),
        ("J/m^2", Toughness, 1.0),
        ("J/m2", Toughness, 1.0),
        ("kJ/m^2", Toughness, 1e3),
        ("m^2/N", Wear, 1.0),
        ("mm^3/(N m)", Wear, 1e-9),
        ("mm^3/Nm", Wear, 1e-9),
        ("mm^2/N", Wear, 1e-6),
        ("m^3/J", EnergyWear, 1.0),
        ("mm^3/J", EnergyWear, 1e-9),
        ("um^3/J", EnergyWear, 1e-18),
        ("W/(m K)", Conductivity, 1.0),
        ("W/(mm K)", Conductivity, 1e3),
        ("J/(m^3 K)", HeatCapacity, 1.0),
        ("MJ/(m^3 K)", HeatCapacity, 1e6),
        ("kg/m^3", Density, 1.0),
        ("g/cm^3", Density, 1e3),
        ("J/(kg K)", SpecificHeat, 1.0),
        ("J/(g K)", SpecificHeat, 1e3),
        ("1", Number, 1.0),
        ("-", Number, 1.0),
        ("%", Number, 1e-2),
        ("cycles", Number, 1.0),
    ]
};

/// The unit of that name, if it is one; the micro sign may be u, the first letter of words for
/// lengths large.
pub fn named(name: &str) -> Option<Unit> {
    let plain = name.trim().replace(['µ', 'μ'], "u").replace('·', "*");
    let exact = UNITS.iter().find(|(word, ..)| *word == plain);
    let lower = plain.to_lowercase();
    let word = || {
        UNITS.iter().find(|(word, kind, _)| {
            let spelt = matches!(kind, Kind::Length | Kind::Force) && !word.contains('/');
            *word == lower && spelt && (word.len() > 3 || lower == "å")
        })
    };
    exact.or_else(word).map(|(_, kind, size)| (*kind, *size))
}

/// The names of the units of a kind.
pub fn names(kind: Kind) -> String {
    joined(|of| kind.takes(of))
}

/// The names of the units of several kinds, by the names of these.
pub fn names_of(kinds: &[&str]) -> String {
    joined(|of| kinds.iter().any(|name| is_taken(of, name)))
}

/// Whether a unit measures a kind, by their names.
pub fn measures(unit: &str, kind: &str) -> bool {
    named(unit).is_some_and(|(of, _)| is_taken(of, kind))
}

/// Whether units of a kind measure another one, by the name of that.
fn is_taken(of: Kind, name: &str) -> bool {
    UNITS
        .iter()
        .any(|row| row.1.name() == name && row.1.takes(of))
}

/// The names of the units of the chosen kinds, with commas between.
fn joined(which: impl Fn(Kind) -> bool) -> String {
    let names = UNITS.iter().filter(|(_, of, _)| which(*of));
    names.map(|(name, ..)| *name).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::{Kind, UNITS, named, names};

    #[test]
    fn a_name_is_one_unit() {
        for (n, (name, kind, size)) in UNITS.iter().enumerate() {
            assert_eq!(named(name), Some((*kind, *size)));
            assert!(UNITS[n + 1..].iter().all(|(other, ..)| other != name));
            assert!(names(*kind).contains(name));
        }
        assert_eq!(named("kN"), Some((Kind::Force, 1e3)));
        assert_eq!(named("µm"), named("um"));
        assert_eq!(named("Micrometer"), Some((Kind::Length, 1e-6)));
        assert!(named("counts").is_none() && named("mn").is_none() && named("mpa").is_none());
    }

    #[test]
    fn a_force_per_length_is_a_stiffness() {
        assert_eq!(Kind::Stiffness.size("N/mm"), Some(1e3));
        assert_eq!(Kind::Stiffness.size("N"), None);
        assert_eq!(Kind::Force.size("N/um"), None);
        assert_eq!(Kind::Force.size("N/mm"), Some(1e3));
        assert_eq!(Kind::WholeForce.size("N/mm"), None);
        assert_eq!(Kind::ForcePerLength.size("N"), None);
    }
}
