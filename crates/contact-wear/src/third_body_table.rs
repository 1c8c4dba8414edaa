//! The tables `[wear.air]` and `[wear.bed]` of a scene file.

use std::fmt::Write as _;

use contact_core::scene::{Fault, Section};

use super::air::{Air, Reaction, check_positive};
use super::debris_bed::DebrisBed;
use super::settings::Wear;

const AIR: [&str; 11] = [
    "distance",
    "diffusivity",
    "reaction",
    "power_density",
    "power_exponent",
    "pressure",
    "pressure_exponent",
    "frequency",
    "frequency_exponent",
    "threshold",
    "ambient",
];
const BED: [&str; 4] = [
    "kappa",
    "volume_ratio",
    "starved_yield",
    "protecting_thickness",
];

/// Reads the air. The oxygen distance may stand as D and r at the reference state instead, of which
/// only the ratio enters.
pub(super) fn air(wear: &Section<'_>) -> Result<Option<Air>, Fault> {
    let Some(section) = wear.section("air", &AIR)? else {
        return Ok(None);
    };
    let threshold = section.number_or("threshold", Air::THRESHOLD, &[])?;
    let ambient = section.number_or("ambient", Air::AMBIENT, &[])?;
    let distance = match (
        section.number_if("distance", &[])?,
        section.number_if("diffusivity", &[])?,
        section.number_if("reaction", &[])?,
    ) {
        (Some(distance), None, None) => distance,
        (None, Some(D), Some(r)) => {
            check_positive("wear.air.diffusivity", D, "m^2/s")?;
            check_positive("wear.air.reaction", r, "1/s")?;
            (D / r).sqrt() / Air::decay_length(ambient, threshold)
        }
        _ => {
            let key = section.path("distance");
            let message = format!(
                "{key}: give either the oxygen distance (m), or diffusivity (m^2/s) and reaction (1/s)"
            );
            return Err(Fault::new(&key, message));
        }
    };
    let power = section.number_if("power_density", &[])?;
    let reaction = match (power, section.get("pressure").is_some()) {
        (Some(power_density), false) => Reaction::Power {
            power_density,
            power_exponent: section.number("power_exponent", "a number >= 0", &[])?,
        },
        (None, true) => Reaction::Loading {
            pressure: section.number("pressure", "a pressure in Pa", &[])?,
            pressure_exponent: section.number("pressure_exponent", "a number >= 0", &[])?,
            frequency: section.number("frequency", "a frequency in Hz", &[])?,
            frequency_exponent: section.number("frequency_exponent", "a number >= 0", &[])?,
        },
        _ => {
            let key = section.path("power_density");
            let message = format!(
                "{key}: give the reference state as either power_density (W/m^2) and power_exponent, or pressure (Pa), \
                 frequency (Hz) and their exponents"
            );
            return Err(Fault::new(&key, message));
        }
    };
    let air = Air {
        distance,
        reaction,
        threshold,
        ambient,
    };
    air.check()?;
    Ok(Some(air))
}

/// Reads the bed.
pub(super) fn bed(wear: &Section<'_>) -> Result<Option<DebrisBed>, Fault> {
    let Some(section) = wear.section("bed", &BED)? else {
        return Ok(None);
    };
    let default = DebrisBed::new(section.number("kappa", "a number >= 0 per cycle", &[])?);
    let bed = DebrisBed {
        volume_ratio: section.number_or("volume_ratio", default.volume_ratio, &[])?,
        starved_yield: section.number_or("starved_yield", default.starved_yield, &[])?,
        protecting_thickness: section.number_if("protecting_thickness", &[])?,
        ..default
    };
    bed.check()?;
    Ok(Some(bed))
}

/// Writes both tables and the gap that is closed to the air.
pub(super) fn write_third_body(wear: &Wear) -> String {
    // Writing to a text cannot fail.
    let mut text = format!("closed_below = {:?}\n", wear.closed_below);
    if let Some(yield_stress) = wear.yield_stress {
        let _ = writeln!(text, "yield_stress = {yield_stress:?}");
    }
    if let Some(air) = &wear.air {
        let _ = writeln!(
            text,
            "\n[wear.air]\ndistance = {:?}\nthreshold = {:?}\nambient = {:?}",
            air.distance, air.threshold, air.ambient
        );
        let _ = match air.reaction {
            Reaction::Power {
                power_density,
                power_exponent,
            } => writeln!(
                text,
                "power_density = {power_density:?}\npower_exponent = {power_exponent:?}"
            ),
            Reaction::Loading {
                pressure,
                pressure_exponent,
                frequency,
                frequency_exponent,
            } => writeln!(
                text,
                "pressure = {pressure:?}\npressure_exponent = {pressure_exponent:?}\nfrequency = {frequency:?}\n\
                 frequency_exponent = {frequency_exponent:?}"
            ),
        };
    }
    if let Some(bed) = &wear.bed {
        let _ = writeln!(
            text,
            "\n[wear.bed]\nkappa = {:?}\nvolume_ratio = {:?}\nstarved_yield = {:?}",
            bed.kappa, bed.volume_ratio, bed.starved_yield
        );
        if let Some(h) = bed.protecting_thickness {
            let _ = writeln!(text, "protecting_thickness = {h:?}");
        }
    }
    text
}
