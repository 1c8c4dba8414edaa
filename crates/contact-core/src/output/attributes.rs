//! Attributes of a store that describe the run as a whole.

use serde_json::{Map, Value, json};

use super::schema::{CONVENTIONS, SCHEMA};
use crate::plan::Plan;
use crate::scene::Scene;

/// Description of a run: scene, plan, scales, status.
pub fn group_attributes(scene: &Scene, plan: &Plan) -> Map<String, Value> {
    let plan: Vec<_> = plan.lines.iter().map(ToString::to_string).collect();
    let mut attributes = Map::new();
    let mut set = |key: &str, value: Value| attributes.insert(key.to_owned(), value);
    set("Conventions", json!(CONVENTIONS));
    set("title", json!(scene.title));
    set("schema", json!(SCHEMA));
    set("version", json!(env!("CARGO_PKG_VERSION")));
    set("scene", json!(scene.to_toml()));
    set("plan", json!(plan));
    set("mu", json!(scene.friction.mu));
    if let Some(hertz) = scene.hertz() {
        set("a_H", json!(hertz.a));
        set("p_H", json!(hertz.p0));
        let R = if scene.grid.plane_strain {
            1.0 / scene.principal_curvatures().0
        } else {
            hertz.a * hertz.a / hertz.delta_z
        };
        set("R", json!(R));
    }
    set("status", json!("running"));
    attributes
}
