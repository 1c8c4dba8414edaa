//! Bad input is refused with key, value and what is allowed.

use std::sync::Arc;

use contact_wear::{Wear, WearRun};

const SCENE: &str = include_str!("../../../../scenes/wear_mccoll.toml");

fn refused(setting: &str) -> String {
    let settings = [setting.to_owned()];
    Wear::from_toml_str(SCENE, "scene.toml", &settings)
        .map(drop)
        .unwrap_err()
        .to_string()
}

#[test]
fn what_has_no_meaning_is_refused_by_name() {
    for (setting, key, allowed) in [
        ("wear.cycles=-3", "wear.cycles = -3", "1 to 1e15"),
        ("wear.cycles=nan", "wear.cycles = nan", "a number"),
        ("wear.first_branch=9", "wear.first_branch = 9", "1 to 3"),
        ("wear.first_branch=1", "path[3].", "where the cycle begins"),
        (
            "wear.cycling=\"rolling\"",
            "wear.cycling = \"rolling\"",
            "\"march\" or \"sliding\"",
        ),
        (
            "wear.tolerance=2.0",
            "wear.tolerance = 2",
            "between 1e-6 and 0.5",
        ),
        ("wear.jumps=0", "wear.jumps = 0", ">= 1"),
        (
            "wear.rig_stiffness=-1.0",
            "wear.rig_stiffness = -1",
            "above 0",
        ),
        ("wear.rig_stiffness=1e6", "wear.cycling", "spring"),
        (
            "wear.debris_kept=1.5",
            "wear.debris_kept = 1.5",
            "between 0 and 1",
        ),
        (
            "wear.event_depth_fraction=0.0",
            "wear.event_depth_fraction = 0",
            "above 0",
        ),
        ("wear.body1.k=-1.0", "wear.body1.k = -1", ">= 0"),
        (
            "wear.body1.share=1.5",
            "wear.body1.share = 1.5",
            "between 0 and 1",
        ),
        ("wear.body1.alpha=1e-14", "wear.body1.k", "either k"),
        (
            "wear.body2.thresholds=1.0",
            "wear.body2.thresholds",
            "wear.body2.threshold",
        ),
        (
            "wear.worn_through=\"die\"",
            "wear.worn_through",
            "\"stop\" or \"go_on\"",
        ),
        ("friction.mu=0", "friction.mu = 0", "above 0"),
        ("path.2.T_x=1.0", "path[2]", "path"),
    ] {
        let message = refused(setting);
        assert!(
            message.contains(key) && message.contains(allowed),
            "{setting}: {message}"
        );
    }
}

#[test]
fn a_coefficient_in_another_unit_is_told() {
    let text = include_str!("../../../../scenes/wear_partial_slip.toml");
    let settings = ["grid.n=16".to_owned(), "wear.body1.k=1.0".to_owned()];
    let (scene, wear) = Wear::from_toml_str(text, "scene.toml", &settings).unwrap();
    let mut run = WearRun::new(&scene, &wear, &Arc::default()).unwrap();
    let told = run.advance().unwrap().unwrap_err().to_string();
    assert!(
        told.contains("one cycle wears") && told.contains("m^2/N"),
        "{told}"
    );
}

#[test]
fn a_table_reads_back_to_what_was_written() {
    let (scene, wear) = Wear::from_toml_str(SCENE, "scene.toml", &[]).unwrap();
    let text = format!("{}{}", scene.to_toml(), wear.to_toml());
    let (again, worn) = Wear::from_toml_str(&text, "again.toml", &[]).unwrap();
    assert!(again == scene && format!("{worn:?}") == format!("{wear:?}"));
    // A scene with wear is a scene without it.
    assert!(contact_core::Scene::from_toml_str(SCENE, "scene.toml", &[]).is_ok());
}
