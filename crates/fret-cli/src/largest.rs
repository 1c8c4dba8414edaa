//! The largest stress of a measure, as a line.

use contact_core::fields::{Maximum, Probe};
use contact_core::scene::Scene;

use crate::summary::short;

/// Says what the largest values of an increment are and where.
pub(crate) struct Largest<'a> {
    pub(crate) scene: &'a Scene,
    /// Coatings of the body.
    pub(crate) layers: usize,
    pub(crate) increment: usize,
    /// Whether lines are JSON objects, for programs.
    pub(crate) json: bool,
}

impl Largest<'_> {
    /// The largest value of a probe with what the depths leave of an error, and where it is.
    pub(crate) fn line<const D: usize>(
        &self,
        probe: &Probe,
        m: &Maximum<D>,
        places: &[(&str, f64)],
    ) -> String {
        let Maximum {
            value,
            depth,
            error,
            ..
        } = *m;
        if self.json {
            let mut of = serde_json::json!({
                "increment": self.increment, "name": probe.name(), "unit": probe.unit(),
                "value": value, "error": error, "z": depth.z, "layer": depth.layer,
            });
            for (axis, place) in places {
                of[*axis] = (*place).into();
            }
            return of.to_string();
        }
        let places: Vec<_> = places
            .iter()
            .map(|(axis, place)| format!("{axis} = {}", self.length(*place)))
            .collect();
        let place = places.join(", ");
        let hertz = self
            .scene
            .hertz()
            .filter(|_| matches!(probe, Probe::Stress(_)));
        let value = hertz.map_or_else(
            || format!("{value:.5e} {} (depths +- {})", probe.unit(), short(error)),
            |h| {
                format!(
                    "{:.5} p_H (depths +- {})",
                    value / h.p0,
                    short(error / h.p0)
                )
            },
        );
        let z = self.length(depth.z);
        let layer = match (self.layers, depth.layer) {
            (0, _) => String::new(),
            (layers, n) if n == layers => ", in the substrate".into(),
            (_, n) => format!(", in coating {n}"),
        };
        let name = probe.name();
        let increment = self.increment;
        format!("increment {increment}: largest {name} {value} at {place}, z = {z}{layer}")
    }

    fn length(&self, v: f64) -> String {
        match self.scene.hertz() {
            Some(hertz) => format!("{:.4} a_H", v / hertz.a),
            None => format!("{v:.4e} m"),
        }
    }
}
