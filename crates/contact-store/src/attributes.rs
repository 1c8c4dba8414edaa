//! Attributes of a store that describe the run as a whole.

use contact_core::Error;
use contact_core::march::Reached;
use contact_core::plan::Plan;
use contact_core::scene::Scene;
use serde_json::{Map, Value, json};

use super::schema::{CONVENTIONS, DOUBTS, SCHEMA};

/// The attributes of a store when a run begins: scene, plan, scales for dimensionless results, status.
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

/// Attributes that the end of a run sets, [`conclude`] and its error bars. A process may die when
/// one of the two documents that hold them is written.
pub(super) const END_ATTRIBUTES: [&str; 4] = ["status", "path_error", DOUBTS, "error_bars"];

/// Adds what is known at the end of a run to its attributes: status, errors of the shear at the ends of the
/// branches, and doubts. `failure` is the error that ended it, if any.
pub(super) fn conclude(
    attributes: &mut Map<String, Value>,
    scene: &Scene,
    reached: &Reached,
    failure: Option<&Error>,
) {
    let mut set = |key: &str, value: Value| attributes.insert(key.to_owned(), value);
    set(
        "status",
        json!(failure.map_or("done".to_owned(), ToString::to_string)),
    );
    let errors: Option<Vec<f64>> = reached.shear_errors(scene).into_iter().collect();
    if let Some(errors) = errors {
        set("path_error", json!(errors));
    }
    let doubts = reached.all_doubts(scene);
    if !doubts.is_empty() {
        set(DOUBTS, json!(doubts.join("\n")));
    }
}
