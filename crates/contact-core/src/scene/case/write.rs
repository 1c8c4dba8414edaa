//! A scene as a scene file in SI: every value in full, so that it reads back to an equal scene.

use std::fmt::Write as _;

use plasticity::NUMBERS;
use toml::Value;

use super::read::SCHEMA;
use crate::scene::{Body, Bond, Elastic, Loads, Plastic, Profile, RigidMotion, Scene, Spacing};

impl Scene {
    /// The scene in the format of the scene file, every number in SI, nothing left to a default.
    pub fn to_toml(&self) -> String {
        let mut text = format!("schema = {SCHEMA}\ntitle = {}\n", quote(&self.title));
        let mut line = |line: std::fmt::Arguments<'_>| {
            // Writing to a text cannot fail.
            let _ = writeln!(text, "{line}");
        };
        for (name, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            line(format_args!("\n[{name}]\n{}", substrate_text(body)));
            for (n, coating) in body.coatings.iter().enumerate() {
                line(format_args!("\n[[{name}.coatings]]"));
                line(format_args!("{}", material(coating.material)));
                line(format_args!("thickness = {:?}", coating.thickness));
                let bond = body.bond(n);
                if bond != Bond::PERFECT {
                    line(format_args!("bond_normal = {:?}", bond.normal));
                    line(format_args!("bond_shear = {:?}", bond.shear));
                }
                if let Some(law) = body.plastic(n) {
                    line(format_args!("{}", plastic_text(law)));
                }
                if let Some(text) = residual_text(body, n) {
                    line(format_args!("{text}"));
                }
            }
        }
        line(format_args!(
            "\n[friction]\n{}",
            super::friction::to_text(&self.friction)
        ));
        let grid = &self.grid;
        line(format_args!("\n[grid]\nn = [{}, {}]", grid.nx, grid.ny));
        line(format_args!("spacing = [{:?}, {:?}]", grid.dx, grid.dy));
        line(format_args!("plane_strain = {}", grid.plane_strain));
        for branch in &self.path.branches {
            line(format_args!("\n[[path]]"));
            for motion in RigidMotion::ALL {
                let prescribed = branch.to.prescribed(motion);
                let (name, value) = (prescribed.name(motion), prescribed.value());
                line(format_args!("{name} = {value:?}"));
            }
            let Loads {
                sigma_B,
                sigma_B1,
                rolled,
                ..
            } = branch.to;
            line(format_args!(
                "sigma_B = {sigma_B:?}\nsigma_B1 = {sigma_B1:?}"
            ));
            line(format_args!("rolled = {rolled:?}"));
            match branch.increments {
                Some(n) => line(format_args!("increments = {n}")),
                None => line(format_args!("increments = \"auto\"")),
            }
            if let Some(error) = branch.path_error {
                line(format_args!("path_error = {error:?}"));
            }
            line(format_args!("t = {:?}", branch.t_end));
            let spacing = match branch.spacing {
                Spacing::Uniform => "uniform",
                Spacing::EqualRadius => "equal_radius",
                Spacing::ShortFirst => "short_first",
            };
            line(format_args!("spacing = \"{spacing}\""));
        }
        if let Some(K) = self.path.rig_stiffness {
            line(format_args!("\n[rig]\nstiffness = {K:?}"));
        }
        if let Some(period) = self.path.period {
            line(format_args!("\n[cycle]\nperiod = {period:?}"));
        }
        text += &super::settings::to_text(&self.settings);
        text
    }
}

/// Writes all numbers that are not zero; lists without their trailing zeros.
fn plastic_text(mut law: Plastic) -> String {
    let mut entries = Vec::new();
    for number in &NUMBERS {
        let values = (number.of)(&mut law);
        let slots = values.len();
        let last_nonzero = values.iter().rposition(|value| *value != 0.0);
        match last_nonzero {
            None => {}
            Some(_) if slots == 1 => entries.push(format!("{} = {:?}", number.name, values[0])),
            Some(last) => entries.push(format!("{} = {:?}", number.name, &values[..=last])),
        }
    }
    format!("plastic = {{ {} }}", entries.join(", "))
}

/// The line of the residual stress of a layer, if it has any.
fn residual_text(body: &Body, layer: usize) -> Option<String> {
    let Profile { rows } = body.residual.get(layer)?;
    match rows.as_slice() {
        [] => None,
        [[_, xx, yy]] if xx == yy => Some(format!("residual = {xx:?}")),
        rows => Some(format!("residual = {rows:?}")),
    }
}

/// A text as a TOML string.
fn quote(text: &str) -> String {
    Value::String(text.to_owned()).to_string()
}

/// The lines of a body without its coatings: material, shape, plastic law, residual stress, bulk stress,
/// hardness.
fn substrate_text(body: &Body) -> String {
    let shape = super::shape::to_text(&body.shape);
    let law = body.plastic(body.coatings.len());
    let law = law.map_or_else(String::new, |law| format!("\n{}", plastic_text(law)));
    let residual = residual_text(body, body.coatings.len());
    let residual = residual.map_or_else(String::new, |text| format!("\n{text}"));
    let number = |key: &str, value: Option<f64>| {
        value.map_or_else(String::new, |value| {
            format!(
                "
{key} = {value:?}"
            )
        })
    };
    let bulk = number("bulk_azimuth", body.bulk.azimuth)
        + &number("bulk_neutral_depth", body.bulk.neutral_depth);
    let hardness = number("hardness", Some(body.hardness).filter(|h| h.is_finite()));
    format!(
        "shape = {shape}
{}{law}{residual}{bulk}{hardness}",
        material(body.substrate)
    )
}

/// The lines E and nu of a material.
fn material(material_text: Elastic) -> String {
    let E = if material_text.is_rigid() {
        "\"rigid\"".to_owned()
    } else {
        format!("{:?}", material_text.E)
    };
    format!("E = {E}\nnu = {:?}", material_text.nu)
}
