//! The scenes that the methods are switched off on, and the finer path that each is measured
//! against.

use contact_core::Error;
use contact_core::estimate::choose_increments;
use contact_core::scene::Scene;

/// A scene, and the same with more increments.
pub(crate) struct Trial {
    pub(crate) name: &'static str,
    pub(crate) scene: Scene,
    pub(crate) reference: Scene,
}

/// The paper's scene, E1/E2 = 2.
const PAPER: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3, coatings = [{ E = { E_substrate = 2.0 }, nu = 0.3, thickness = { a_H = 1.0 } }] }
friction.mu = 0.3
grid = { n = 128, extent = { a_H = 2.4 } }
path = [
    { W = 1000.0, spacing = "equal_radius" },
    { T_x = { mu_W = 0.9 } }, { T_x = { mu_W = -0.9 } }, { T_x = { mu_W = 0.9 } },
    { T_x = { mu_W = -0.9 } }, { T_x = { mu_W = 0.9 } },
]
"#;

/// Dissimilar bodies under W alone.
const INDENTATION: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = inf, nu = 0.3 }
friction.mu = 0.5
grid = { n = 128, extent = { a_H = 2.2 } }
path = [{ W = 1000.0, spacing = "equal_radius" }]
"#;

/// A coated sphere with two waves: contact in spots.
const SPOTS: &str = r"
schema = 1
friction.mu = 0.3
grid = { n = 128, extent = { a_H = 2.6 } }
path = [{ W = 300.0 }, { T_x = { mu_W = 0.9 } }, { T_x = { mu_W = -0.9 } }, { T_x = { mu_W = 0.9 } }]
[body1]
shape = { sphere = { R = 0.018 }, waviness = { amplitude = 1.5e-6, wavelength = 1.3e-4, phase = 1.0 } }
E = 210e9
nu = 0.3
[body2]
shape = { waviness = { amplitude = 1e-6, wavelength = 1e-4, angle = 1.5707963267948966 } }
E = 210e9
nu = 0.3
coatings = [{ E = { E_substrate = 2.0 }, nu = 0.3, thickness = 5e-5 }]
";

/// Torsion of a Hertz contact to a stick zone of half its radius and back.
const TORSION: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 128, extent = { a_H = 2.2 } }
path = [{ W = 1000.0 }, { M_z = MOMENT }, { M_z = -MOMENT }, { M_z = MOMENT }]
"#;

/// A rigid sphere on a body with nu = 0 under much friction: mu times Dundurs' beta is 1.
const STRONG: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = inf, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.0 }
friction.mu = 2.0
grid = { n = 64, extent = { a_H = 4.0 } }
path = [{ W = 1000.0, spacing = "equal_radius" }, { T_x = { mu_W = 0.5 } }, { T_x = { mu_W = -0.5 } }]
"#;

/// Branches of so many increments.
fn with(text: &str, increments: &[usize]) -> Result<Scene, Error> {
    let settings: Vec<String> = increments
        .iter()
        .enumerate()
        .map(|(branch, n)| format!("path.{branch}.increments={n}"))
        .collect();
    Scene::from_toml_str(text, "ablation", &settings)
}

fn trial(
    name: &'static str,
    text: &str,
    increments: Option<&[usize]>,
    finer: &[usize],
) -> Result<Trial, Error> {
    let scene = if let Some(increments) = increments {
        with(text, increments)?
    } else {
        let open: Vec<String> = (0..finer.len())
            .map(|branch| format!("path.{branch}.increments=\"auto\""))
            .collect();
        let scene = Scene::from_toml_str(text, "ablation", &open)?;
        choose_increments(&scene, &std::sync::Arc::default())?
    };
    let mut reference = with(text, finer)?;
    reference.settings.solver.tolerance = Some(1e-7);
    Ok(Trial {
        name,
        scene,
        reference,
    })
}

/// All of them.
pub(crate) fn trials() -> Result<Vec<Trial>, Error> {
    let finer = [400, 200, 400, 400, 400, 400];
    let (twenty, thousand) = ([20; 6], [100, 100, 200, 200, 200, 200]);
    // M/(mu W a) = 0.53: the stick zone has half the contact radius (Lubkin).
    let torsion = TORSION.replace("MOMENT", "0.0762");
    Ok(vec![
        trial("paper's scene, chosen increments", PAPER, None, &finer)?,
        trial(
            "paper's scene, 256 x 256 cells, 20 increments a branch",
            &PAPER.replace("n = 128", "n = 256"),
            Some(&twenty),
            &finer,
        )?,
        trial(
            "paper's scene, 1000 increments",
            PAPER,
            Some(&thousand),
            &finer,
        )?,
        trial(
            "coupled indentation, chosen increments",
            INDENTATION,
            None,
            &[400],
        )?,
        trial(
            "contact in spots",
            SPOTS,
            Some(&[30, 15, 30, 30]),
            &[300, 100, 200, 200],
        )?,
        trial(
            "torsion",
            &torsion,
            Some(&[1, 5, 10, 10]),
            &[1, 60, 120, 120],
        )?,
        trial(
            "strong coupling",
            STRONG,
            Some(&[20, 10, 20]),
            &[200, 100, 200],
        )?,
    ])
}
