// A measure is one product, and a scene read back is the same: equality is meant to the bit.
#![allow(clippy::float_cmp)]

use super::*;
use crate::scene::{Elastic, KernelMethod, LoadPath, Preset, SaveFields, Spacing};

pub(super) const FILE: &str = "scene.toml";
pub(super) const GOOD: &str = r#"schema = 1
title = "A \"test\" scene"

[body1]
shape.sphere.R = 0.018
E = 210e9
nu = 0.3

[body2]
shape = "flat"
E = 210e9
nu = 0.3

[[body2.coatings]]
E = { E_substrate = 2.0 }
nu = 0.3
thickness = { a_H = 1.0 }

[friction]
mu = 0.3

[grid]
n = 32
extent = { a_H = 2.4 }

[[path]]
W = 1000.0
increments = 10
t = 0.1

[[path]]
T_x = { mu_W = 0.9 }
increments = 10
"#;

pub(super) fn with_settings(settings: &[&str]) -> Result<Scene, Error> {
    let settings: Vec<_> = settings.iter().map(|&s| s.to_owned()).collect();
    Scene::from_toml_str(GOOD, FILE, &settings)
}

/// The good scene with one line changed.
pub(super) fn with_change(from: &str, to: &str) -> Result<Scene, Error> {
    assert!(GOOD.contains(from), "{from}");
    Scene::from_toml_str(&GOOD.replacen(from, to, 1), FILE, &[])
}

pub(super) fn error_text(result: Result<Scene, Error>) -> String {
    result.unwrap_err().to_string()
}

/// The complaint is one line that starts with the file and the line and holds all the parts.
#[track_caller]
pub(super) fn assert_refused(result: Result<Scene, Error>, line: usize, parts: &[&str]) {
    let text = error_text(result);
    let prefix = format!("scene.toml:{line}: ");
    assert!(text.starts_with(&prefix), "{text:?} is not at line {line}");
    assert_eq!(text.lines().count(), 1, "{text}");
    for part in parts {
        assert!(text.contains(part), "{text:?} lacks {part:?}");
    }
}

#[test]
fn measures_become_si() {
    let scene = with_settings(&[]).unwrap();
    let hertz = scene.hertz().unwrap();
    let coating = scene.body2.coatings[0];
    assert_eq!(coating.material.E, 420e9);
    assert_eq!(coating.thickness, hertz.a);
    assert_eq!(scene.grid.dx, 2.4 * hertz.a / 32.0);
    assert_eq!(scene.path.branches[1].to.W, 1000.0);
    assert_eq!(scene.path.branches[1].to.T_x, 0.9 * (0.3 * 1000.0));
    assert_eq!(scene.path.branches[1].t_end, 1.1);
    assert_eq!(scene.title, "A \"test\" scene");
}

#[test]
fn a_star_stands_for_every_element_of_a_list() {
    let scene = with_settings(&["path.*.W=500", "body2.coatings[*].nu=0.25"]).unwrap();
    assert!(scene.path.branches.iter().all(|b| b.to.W == 500.0));
    assert_eq!(scene.body2.coatings[0].material.nu, 0.25);
    for (setting, part) in [
        ("grid.*.n=3", "setting grid.*.n=3: grid is no list"),
        ("pat.*.W=3", "pat is no list"),
        ("path.*.W=-1", "path.*.W=-1"),
        ("path.*.X=1", "path.*.X=1"),
    ] {
        let text = error_text(with_settings(&[setting]));
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn settings_change_the_scene() {
    let scene = with_settings(&[
        "friction.mu=0.5",
        "body2.coatings.0.E.E_substrate=4",
        "body2.coatings[0].thickness = 1e-3",
        "grid.n=[64, 48]",
        "grid.extent = 0.002",
        "solver.preset=spinu2020",
        "kernel.method={ inverse_fft = { lambda = 4 } }",
        "output.save=[1, 3]",
        "path.0.spacing=equal_radius",
        "title=plain",
    ])
    .unwrap();
    assert_eq!(scene.friction.mu, 0.5);
    assert_eq!(scene.body2.coatings[0].material.E, 840e9);
    assert_eq!(scene.body2.coatings[0].thickness, 1e-3);
    assert_eq!((scene.grid.nx, scene.grid.ny), (64, 48));
    assert_eq!(scene.grid.dy, 0.002 / 48.0);
    assert_eq!(scene.settings.solver.preset, Preset::Spinu2020);
    let inverse_fft = KernelMethod::InverseFft {
        lambda: 4,
        aliases: 0,
    };
    assert_eq!(scene.settings.kernel.method, inverse_fft);
    assert_eq!(scene.settings.save, SaveFields::Indices(vec![1, 3]));
    assert_eq!(scene.path.branches[0].spacing, Spacing::EqualRadius);
    assert_eq!(scene.title, "plain");
}

/// A scene whose bodies and layers have the numbers of their materials written out.
#[test]
fn a_material_that_is_set_replaces_the_numbers_of_the_old_one() {
    let titanium = Elastic::named("Ti-6Al-4V").unwrap();
    let material_of = |key: &str, scene: &Scene| match key {
        "body1" => scene.body1.substrate,
        "body2" => scene.body2.substrate,
        _ => scene.body2.coatings[0].material,
    };
    for key in ["body1", "body2", "body2.coatings.0"] {
        let material = |scene: &Scene| material_of(key, scene);
        let setting = format!("{key}.material=\"Ti-6Al-4V\"");
        assert_eq!(
            material(&with_settings(&[&setting]).unwrap()),
            titanium,
            "{key}"
        );
        // What is set in the same call stays, whatever the order.
        let modulus = format!("{key}.E=1e11");
        for settings in [[&setting, &modulus], [&modulus, &setting]] {
            let scene = with_settings(&settings.map(String::as_str)).unwrap();
            let right = Elastic {
                E: 1e11,
                nu: titanium.nu,
            };
            assert_eq!(material(&scene), right, "{key}");
        }
        let yields = GOOD
            .replace(
                "E = 210e9\nnu = 0.3\n",
                "E = 210e9\nnu = 0.3\nplastic.s_y = 1e9\nplastic.hardening = 5e9\n",
            )
            .replace("thickness = {", "plastic.s_y = 2e9\nthickness = {");
        let read = |settings: &[String]| Scene::from_toml_str(&yields, FILE, settings);
        let text = error_text(read(std::slice::from_ref(&setting)));
        assert!(text.contains(&format!("set {key}.plastic.s_y")), "{text}");
        let scene = read(&[setting.clone(), format!("{key}.plastic.s_y=9e8")]).unwrap();
        let plastic = scene
            .body1
            .plastic
            .iter()
            .chain(&scene.body2.plastic)
            .flatten();
        assert!(
            plastic
                .clone()
                .any(|law| law.s_y == 9e8 && law.hardening == 0.0),
            "{key}"
        );
    }
    let every = with_settings(&["body2.coatings.*.material=\"Ti-6Al-4V\""]).unwrap();
    assert_eq!(every.body2.coatings[0].material, titanium);
}

#[test]
fn a_setting_may_change_the_measure() {
    let scene_by_stress = with_settings(&["body2.coatings.0.E.p_H=100"]).unwrap();
    let p_H = scene_by_stress.hertz().unwrap().p0;
    assert_eq!(scene_by_stress.body2.coatings[0].material.E, 100.0 * p_H);
    let from_number =
        with_settings(&["path.0.W=500", "path.1.T_x=10", "path.1.T_x.mu_W=0.5"]).unwrap();
    assert_eq!(from_number.path.branches[1].to.T_x, 0.5 * (0.3 * 500.0));
}

#[test]
fn a_line_contact_has_a_hertz_half_width() {
    let line = GOOD
        .replace("sphere", "cylinder")
        .replace("n = 32", "n = 32\nplane_strain = true");
    let read = |line: &str| Scene::from_toml_str(line, FILE, &[]).unwrap();
    let per_metre = read(&line);
    let a = per_metre.hertz().unwrap().a;
    // a^2 = 4 W R/(pi E*) with W per metre, Johnson eq. (4.43).
    let E_star = 210e9 / (2.0 * (1.0 - 0.3 * 0.3));
    let johnson = (4.0 * 1000.0 * 0.018 / (std::f64::consts::PI * E_star)).sqrt();
    assert!((a / johnson - 1.0).abs() < 1e-12, "{a:e} {johnson:e}");
    assert_eq!(
        (per_metre.grid.dx, per_metre.grid.dy),
        (2.4 * a / 32.0, 1.0)
    );
    // On a row of 4 m the same force is a quarter of the load per metre.
    let long = read(&line.replace("{ a_H = 2.4 }", "[{ a_H = 2.4 }, 4.0]"));
    assert_eq!(long.grid.dy, 4.0);
    assert!((long.grid.dx / per_metre.grid.dx - 0.5).abs() < 1e-12);
    let not_finite = line.replace("{ a_H = 2.4 }", "[{ a_H = 2.4 }, 0.0]");
    assert!(Scene::from_toml_str(&not_finite, FILE, &[]).is_err());
}

#[test]
fn a_scene_written_reads_back_equal() {
    let mut scene = with_settings(&["body1.E=rigid", "body1.nu=0.0", "grid.n=[33, 47]"]).unwrap();
    let read = |scene: &Scene| Scene::from_toml_str(&scene.to_toml(), FILE, &[]).unwrap();
    assert_eq!(read(&scene), scene);
    scene.title = "two\nlines, a \u{1} and \\ \"quotes\" '''".into();
    scene.path = LoadPath::start()
        .normal(1e3 / 3.0, 7)
        .tangential(&[90.0, -90.0, 1e-300], 33);
    scene.path.branches[0].spacing = Spacing::EqualRadius;
    scene.settings.kernel.method = KernelMethod::InverseFft {
        lambda: 3,
        aliases: 2,
    };
    scene.settings.kernel.tolerance = 1e-7;
    scene.settings.solver.preset = Preset::Spinu2020;
    scene.settings.solver.tolerance = Some(1.0 / 3.0);
    scene.settings.skip.mirror = false;
    scene.settings.save = SaveFields::Indices(vec![3, 5]);
    assert_eq!(read(&scene), scene);
    scene.settings.kernel.method = KernelMethod::FrequencyDomain { lambda: 2 };
    scene.settings.save = SaveFields::All;
    assert_eq!(read(&scene), scene);
}

/// Reads the scenes of the repository and checks their main numbers.
#[test]
fn the_scenes_of_the_repository_are_good() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let scene = Scene::from_file(entry.unwrap().path(), &[]).unwrap();
        assert!(!scene.title.is_empty());
        count += 1;
    }
    assert!(count >= 4);

    let paper = Scene::from_file(folder.join("coated_fretting.toml"), &[]).unwrap();
    assert_eq!((paper.grid.nx, paper.grid.ny), (256, 256));
    assert_eq!(paper.path.increments(), 1000);
    let ends: Vec<_> = paper
        .path
        .branches
        .iter()
        .map(|b| (b.t_end, b.to.T_x))
        .collect();
    let T = 0.9 * (0.3 * 1000.0);
    let figure_4 = [
        (0.1, 0.0),
        (0.2, T),
        (0.4, -T),
        (0.6, T),
        (0.8, -T),
        (1.0, T),
    ];
    assert_eq!(ends, figure_4);
    let settings = ["body2.coatings.0.E.E_substrate=0.5".to_owned()];
    let scene = Scene::from_file(folder.join("coated_fretting.toml"), &settings).unwrap();
    assert_eq!(scene.body2.coatings[0].material.E, 105e9);
}

#[test]
fn a_missing_file_is_named() {
    let text = error_text(Scene::from_file("no/such/scene.toml", &[]));
    assert!(text.starts_with("no/such/scene.toml: "), "{text}");
}

/// Text of any kind gives a scene that reads back equal, or a line for each mistake; nothing panics.
#[test]
fn hostile_text_is_survived() {
    // Knuth's 64-bit congruential generator: the same texts every time.
    let mut state = 1_u64;
    let mut random = move |n: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % n
    };
    let scraps = "|=|[|]]|\"|{|}|0|-1|1e308|nan|inf|1e-320|[[path]]|\n|.|é|9223372036854775807|true|a_H|#|'''|99999999999999999999|T_x";
    let scraps: Vec<_> = scraps.split('|').collect();
    let (mut good, mut bad) = (0, 0);
    for _ in 0..20_000 {
        let mut text = GOOD.to_owned();
        for _ in 0..=random(2) {
            let from = random(text.len());
            let to = (from + random(5)).min(text.len());
            if text.is_char_boundary(from) && text.is_char_boundary(to) {
                text.replace_range(from..to, scraps[random(scraps.len())]);
            }
        }
        let [key, value] = [0; 2].map(|_| scraps[random(scraps.len())]);
        let settings = [format!("path.1.{key}={value}")];
        let settings = &settings[..usize::from(random(8) == 0)];
        match Scene::from_toml_str(&text, FILE, settings) {
            Ok(scene) => {
                let reread = Scene::from_toml_str(&scene.to_toml(), FILE, &[]).unwrap();
                assert_eq!(reread, scene);
                good += 1;
            }
            Err(error) => {
                let sentence = error.to_string();
                assert!(
                    sentence.lines().all(|line| line.contains(": ")),
                    "{sentence}"
                );
                bad += 1;
            }
        }
    }
    assert!(good > 100 && bad > 100, "{good} good, {bad} bad");
}

#[test]
fn a_branch_gives_loads_or_motions() {
    let scene = with_change("T_x = { mu_W = 0.9 }", "delta_x = 1e-6\nM_z = 0.5").unwrap();
    let to = scene.path.branches[1].to;
    assert_eq!(
        to.given.motions(),
        [None, Some(0.0), Some(0.0), Some(1e-6), None, None]
    );
    assert_eq!((to.W, to.T_x, to.M_z), (1000.0, 0.0, 0.5));
    assert_eq!(
        Scene::from_toml_str(&scene.to_toml(), FILE, &[]).unwrap(),
        scene
    );
    let points = scene.path.points();
    assert!(points[10].loads.T_x.is_nan() && points[19].loads.M_z.to_bits() == 0.5_f64.to_bits());
    let both_given = with_change("T_x = { mu_W = 0.9 }", "T_x = 10.0\ndelta_x = 1e-6");
    assert_refused(
        both_given,
        33,
        &["path[1].T_x", "path[1].delta_x", "both given"],
    );
    let lifted = with_change("T_x = { mu_W = 0.9 }", "W = 0.0\nM_y = 0.5");
    assert_refused(lifted, 33, &["path[1].M_y = 0.5", "W = 0"]);
}

#[test]
fn a_material_has_the_numbers_of_its_name() {
    let titanium = Elastic::named("titanium_6Al4V").unwrap();
    let nitride = Elastic::named("TiN").unwrap();
    let numbers =
        "E = 210e9\nnu = 0.3\n\n[[body2.coatings]]\nE = { E_substrate = 2.0 }\nnu = 0.3\n";
    let by_name = "material = \"Ti-6Al-4V\"\n\n[[body2.coatings]]\nmaterial = \"TiN\"\n";
    let scene = with_change(numbers, by_name).unwrap();
    assert_eq!(scene.body2.substrate, titanium);
    assert_eq!(scene.body2.coatings[0].material, nitride);
    // A material that is set from outside replaces E and nu of the file.
    let changed = with_settings(&["body1.material=Ti64"]).unwrap();
    assert_eq!(changed.body1.substrate, titanium);
    // The file that is written has the numbers.
    let written = scene.to_toml();
    assert_eq!(Scene::from_toml_str(&written, FILE, &[]).unwrap(), scene);
    assert!(!written.contains("material"), "{written}");
}

#[test]
fn a_number_beside_a_material_replaces_the_tabulated_one() {
    let nitride = Elastic::named("TiN").unwrap();
    let film = "E = { E_substrate = 2.0 }\nnu = 0.3\nthickness";
    let coating_with = |text: &str| {
        let scene = with_change(film, &format!("material = \"TiN\"\n{text}\nthickness")).unwrap();
        scene.body2.coatings[0].material
    };
    assert_eq!(coating_with("nu = 0.2"), Elastic { nu: 0.2, ..nitride });
    assert_eq!(
        coating_with("E = \"300 GPa\""),
        Elastic {
            E: 300e9,
            ..nitride
        }
    );
    assert_eq!(coating_with("E = { E_substrate = 3.0 }").E, 630e9);
}

#[test]
fn a_material_that_is_unknown_has_its_nearest() {
    let film = "E = { E_substrate = 2.0 }\nnu = 0.3\nthickness";
    for (name, near) in [("Ti-6Al-V4", "titanium_6Al4V"), ("TiiN", "TiN")] {
        let film_of = format!("material = \"{name}\"\nthickness");
        assert_refused(
            with_change(film, &film_of),
            15,
            &["body2.coatings[0].material", name, "nearest", near],
        );
    }
    assert_refused(
        with_change(film, "material = 3\nthickness"),
        15,
        &["body2.coatings[0].material = 3", "the name of a material"],
    );
    // A number that the table does not have is asked for.
    let bare = material_table::materials();
    let bare = bare
        .values()
        .find(|material| !material.numbers.contains_key("nu"));
    let name = &bare.unwrap().name;
    let film_of = format!("material = \"{name}\"\nthickness");
    let parts = ["body2.coatings[0].nu is missing", name, "Poisson's ratio"];
    let text = error_text(with_change(film, &film_of));
    assert!(parts.iter().all(|part| text.contains(part)), "{text}");
}
