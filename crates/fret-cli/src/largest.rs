//! The largest stress of a measure, as a line.

use contact_core::scene::{Body, Scene};
use contact_subsurface::{Errors, Extremum, Probe, Zone};
use serde_json::json;

use crate::json::{self, or_missing};
use crate::units::{mega, um};
use contact_core::digits::short;

/// Units of stresses and lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Units {
    /// MPa and um.
    Si,
    /// Over Hertz's pressure and radius, where the contact has them.
    Hertz,
}

/// Prints the largest values of an increment and their places.
pub(crate) struct Largest<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) body: &'a Body,
    pub(crate) increment: usize,
    /// Error bar of the stress, over it.
    pub(crate) error: Option<f64>,
    /// Whether lines are JSON objects, for programs.
    pub(crate) json: bool,
    /// Units of the lines.
    pub(crate) units: Units,
}

impl Largest<'_> {
    /// Describes the largest value of a probe with its error and its place; `axes` are the searched
    /// axes.
    pub(crate) fn line(&self, probe: &Probe, m: &Extremum, axes: &[&str]) -> String {
        let m = self.error.map_or(*m, |stress| m.with_error_bars(stress));
        let Extremum {
            value,
            depth,
            error,
            ..
        } = m;
        let along = |axis: &str| if axis == "x" { m.x } else { m.y };
        let on = m.at.map(|zone| match zone {
            Zone::Contact => "rim",
            Zone::Stick => "stick border",
        });
        if self.json {
            let Errors {
                x,
                y,
                z,
                tractions,
                solution,
            } = error;
            return json::line(json!({
                "increment": self.increment, "name": probe.name(), "unit": probe.unit(),
                "value": value, "error": error.total(),
                "errors": {
                    "x": x, "y": y, "z": z,
                    "tractions": or_missing(json!(tractions), "not computed"),
                    "solution": or_missing(json!(solution), "the run has no error bars"),
                },
                "x": m.x, "y": m.y, "z": depth.z, "layer": depth.layer,
                "at": or_missing(json!(on), "on no border"),
            }));
        }
        let places: Vec<_> = axes
            .iter()
            .map(|axis| format!("{axis} = {}", self.length(along(axis))))
            .collect();
        let coordinates = places.join(", ");
        let hertz = self
            .scene
            .hertz()
            .filter(|_| self.units == Units::Hertz && matches!(probe, Probe::Stress(_)));
        let total_error = error.total();
        let value = hertz.map_or_else(
            || {
                format!(
                    "{} +- {}",
                    mega(value, probe.unit()),
                    mega(total_error, probe.unit())
                )
            },
            |h| format!("{:.5} p_H +- {}", value / h.p0, short(total_error / h.p0)),
        );
        let z = self.length(depth.z);
        let layer = if self.body.coatings.is_empty() {
            String::new()
        } else {
            format!(", in {}", self.body.layer_name(depth.layer))
        };
        let on = on.map_or_else(String::new, |on| format!(", at the {on}"));
        let name = probe.name();
        let increment = self.increment;
        format!(
            "increment {increment}: largest {name} {value} at {coordinates}, z = {z}{layer}{on}"
        )
    }

    /// A length in a readable unit, or over a_H.
    fn length(&self, v: f64) -> String {
        match self.scene.hertz() {
            Some(hertz) if self.units == Units::Hertz => format!("{:.4} a_H", v / hertz.a),
            _ => um(v),
        }
    }
}
