//! What the documents say about files is what the code does.

#![allow(clippy::unwrap_used)]

use std::fs;

use contact_core::Scene;
use contact_core::scene::Settings;
use contact_store::{FIELDS, SCALARS};

fn document(name: &str) -> String {
    fs::read_to_string(format!("{}/../../docs/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The example reads as the paper's scene does up to its second branch, and the settings that it
/// calls defaults are the defaults.
#[test]
fn the_example_of_a_scene_file_is_one() {
    let text = document("scene_file.md");
    let example = text
        .split("```toml\n")
        .nth(1)
        .unwrap()
        .split("```")
        .next()
        .unwrap();
    let scene = Scene::from_toml_str(example, "docs/scene_file.md", &[]).unwrap();
    assert_eq!(scene.settings, Settings::default());
    let paper = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenes/coated_fretting.toml"
    );
    let mut paper = Scene::from_file(paper, &[]).unwrap();
    paper.path.branches.truncate(2);
    paper.title.clone_from(&scene.title);
    assert_eq!(scene, paper);
}

#[test]
fn every_variable_of_the_store_is_explained() {
    let text = document("result_store.md");
    let names = SCALARS
        .iter()
        .map(|s| s.name)
        .chain(FIELDS.iter().map(|f| f.name));
    for name in names {
        assert!(text.contains(&format!("`{name}`")), "{name}");
    }
}
