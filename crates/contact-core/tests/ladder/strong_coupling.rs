//! Friction times coupling beyond what plain alternation of pressure and shear contracts well.

use std::sync::Arc;

use contact_core::march::March;
use contact_core::plan::Plan;
use contact_core::scene::Scene;

/// A rigid sphere pressed and sheared on a body with nu = 0, mu = 2.
const STRONG: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = inf, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.0 }
friction.mu = 2.0
grid = { n = 64, extent = { a_H = 3.0 } }
path = [
    { W = 1000.0, increments = 10, spacing = "equal_radius" },
    { T_x = { mu_W = 0.9 }, increments = 10 },
    { T_x = { mu_W = -0.9 }, increments = 10 },
]
"#;

/// Convolutions of the whole path.
fn work(anderson: bool) -> f64 {
    let scene = Scene::from_toml_str(STRONG, "strong coupling", &[] as &[String]).expect("a scene");
    let mut plan = Plan::new(&scene);
    plan.methods.anderson = anderson;
    let mut march = March::planned(&scene, plan, &Arc::default()).expect("a march");
    let mut convolutions = 0.0;
    while let Some(increment) = march.advance() {
        convolutions += increment.expect("an increment").work.convolutions;
    }
    convolutions
}

#[test]
fn anderson_acceleration_halves_the_work_at_least() {
    let (with, without) = (work(true), work(false));
    assert!(
        with < 0.5 * without,
        "{with} convolutions, {without} without"
    );
}
