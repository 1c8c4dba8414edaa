//! What is left out changes nothing: every rule of the plan against the run without it.

#![allow(clippy::unwrap_used)]

use contact_core::kernels::{Quadrant, influence_coefficients, pair_coefficients};
use contact_core::march::{Fields, Increment, March, Observer, solve};
use contact_core::plan::KernelSet;
use contact_core::plan::{Plan, PlanLine};
use contact_core::{Error, Scene};
use ndarray::Array2;

/// A sphere on a plane of its own material, once round a loop.
const SIMILAR: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 48, extent = { a_H = 2.4 } }
solver.tolerance = 1e-9
path = [
    { W = 1000.0, increments = 3 },
    { T_x = { mu_W = 0.8 }, increments = 4 },
    { T_x = { mu_W = -0.8 }, increments = 5 },
    { T_x = { mu_W = 0.5 }, increments = 4 },
]
"#;

#[derive(Default)]
struct Ends(Vec<(Increment, Fields)>);

impl Observer for Ends {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if increment.point.ends_branch {
            self.0.push((*increment, march.fields()));
        }
        Ok(())
    }
}

fn scene(settings: &[&str]) -> Scene {
    let settings: Vec<_> = settings.iter().map(|&s| s.to_owned()).collect();
    Scene::from_toml_str(SIMILAR, "similar.toml", &settings).unwrap()
}

/// The line of the plan about a subject, found by a word of it.
fn line(scene: &Scene, word: &str) -> PlanLine {
    let lines = Plan::new(scene).lines;
    let found: Vec<_> = lines.iter().filter(|l| l.subject.contains(word)).collect();
    assert_eq!(found.len(), 1, "{word} in {lines:?}");
    found[0].clone()
}

fn norm(f: &Array2<f64>) -> f64 {
    f.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Runs a scene with and without a rule; the tractions at the ends of the branches are the same.
///
/// A solver's tolerance is a length. Waves of the grid, of which a displacement of the approach
/// needs some hundred p_max, turn it into as much more traction.
fn same_without(settings: &[&str], off: &str) -> [Vec<Increment>; 2] {
    let run = |settings: &[&str]| {
        let (scene, mut ends) = (scene(settings), Ends::default());
        let increments = solve(&scene, &mut ends).unwrap();
        (increments, ends.0)
    };
    let with = run(settings);
    let without = run(&[settings, &[off]].concat());
    assert_eq!(with.1.len(), without.1.len());
    for ((a, a_fields), (b, b_fields)) in with.1.iter().zip(&without.1) {
        let (p, q) = (
            norm(&b_fields.p),
            norm(&b_fields.q_x).max(1e-6 * norm(&b_fields.p)),
        );
        if p == 0.0 {
            assert!(norm(&a_fields.p) <= 0.0);
            continue;
        }
        assert!(norm(&(&a_fields.p - &b_fields.p)) < 1e-7 * p);
        assert!(norm(&(&a_fields.q_x - &b_fields.q_x)) < 1e-6 * q);
        assert!(norm(&(&a_fields.q_y - &b_fields.q_y)) < 1e-6 * q);
        assert!((a.motion.delta_z / b.motion.delta_z - 1.0).abs() < 1e-8);
        let scale = b.motion.delta_z;
        assert!((a.motion.delta_x - b.motion.delta_x).abs() < 1e-7 * scale);
    }
    [with.0, without.0]
}

/// The coefficients of a set are those of all six, to the bit; the others are not there.
#[test]
fn kernels_that_are_not_needed() {
    let coated = "body2.coatings=[{ E = 4e11, nu = 0.25, thickness = { a_H = 0.5 } }]";
    for (settings, set) in [
        (&["friction.mu=0.0"][..], KernelSet::Normal),
        (
            &["friction.mu=0.0", coated, "grid.n=[48, 33]"],
            KernelSet::Normal,
        ),
        (&["grid.n=[33, 48]"], KernelSet::Uncoupled),
        (&["body2.E=70e9"], KernelSet::All),
        (&[coated], KernelSet::All),
    ] {
        let scene = scene(settings);
        assert_eq!(Plan::new(&scene).kernels(), set, "{settings:?}");
        let bodies = (&scene.body1, &scene.body2);
        let pair = |set| {
            let kernel = &scene.settings.kernel;
            pair_coefficients(bodies, &scene.grid, kernel, true, set, None).unwrap()
        };
        let (some, all) = (pair(set), pair(KernelSet::All));
        let same = |some: &Quadrant, all: &Quadrant, needed: bool| {
            assert!(if needed { some == all } else { some.is_empty() });
        };
        let (shear, coupling) = (set != KernelSet::Normal, set == KernelSet::All);
        same(&some.zz, &all.zz, true);
        same(&some.xx, &all.xx, shear);
        same(&some.yy, &all.yy, shear);
        same(&some.xy, &all.xy, shear);
        same(&some.xz, &all.xz, coupling);
        same(&some.yz, &all.yz, coupling);
    }
}

/// Bodies of the same layers share their coefficients.
#[test]
fn kernels_of_the_same_body() {
    let coatings = "coatings=[{ E = 4e11, nu = 0.25, thickness = 2e-4 }]";
    let both = ["body1.", "body2."].map(|body| body.to_owned() + coatings);
    let alike = scene(&[&both[0], &both[1]]);
    assert!(line(&alike, "coefficients").skipped);
    assert!(!line(&scene(&[&both[0]]), "coefficients").skipped);
    let (grid, kernel) = (&alike.grid, &alike.settings.kernel);
    let of = |body| influence_coefficients(body, grid, kernel, true, None).unwrap();
    let bodies = (&alike.body1, &alike.body2);
    let once = pair_coefficients(bodies, grid, kernel, true, KernelSet::All, None).unwrap();
    assert_eq!(once, of(bodies.1).pair(&of(bodies.0)));
}

#[test]
fn coupling_of_similar_bodies() {
    assert!(line(&scene(&[]), "coupling").skipped);
    assert!(!line(&scene(&["skip.coupling=false"]), "coupling").skipped);
    same_without(&[], "skip.coupling=false");
}

#[test]
fn the_mirrored_half() {
    assert!(line(&scene(&[]), "half").skipped);
    assert!(!line(&scene(&["skip.mirror=false"]), "half").skipped);
    same_without(&[], "skip.mirror=false");
}

#[test]
fn a_coating_like_its_substrate() {
    let coated =
        "body2.coatings=[{ E = { E_substrate = 1.0 }, nu = 0.3, thickness = { a_H = 0.5 } }]";
    let [with, _] = same_without(&[coated], "skip.equal_layers=false");
    let bare = solve(&scene(&[]), &mut ()).unwrap();
    assert_eq!(with, bare);
}

#[test]
fn increments_whose_way_does_not_count() {
    let isotropic = [
        "body1.nu=0.0",
        "body2.nu=0.0",
        "skip.path_independent_branches=true",
    ];
    assert!(line(&scene(&isotropic), "increments").skipped);
    let [with, without] = same_without(&isotropic, "skip.path_independent_branches=false");
    assert_eq!((with.len(), without.len()), (4, 16));
    // A cell slips at its bound: what one increment dissipates is known without the way, too.
    let many = [
        "skip.path_independent_branches=false",
        "path.1.increments=64",
        "path.2.increments=64",
        "path.3.increments=64",
    ];
    let many = solve(&scene(&[&isotropic[..], &many].concat()), &mut ()).unwrap();
    for branch in 1..4 {
        let of = |run: &[Increment]| -> f64 {
            let within = run.iter().filter(|i| i.point.branch == branch);
            within.map(|i| i.energy.dissipated).sum()
        };
        assert!(
            (of(&with) / of(&many) - 1.0).abs() < 1e-3,
            "{} {}",
            of(&with),
            of(&many)
        );
    }

    // Where slip turns, the indentation alone is direct.
    let path = "skip.path_independent_branches=true";
    let mixed = line(&scene(&[path]), "increments");
    assert!(mixed.skipped && mixed.subject.contains("1 of 4"), "{mixed}");
    let [with, without] = same_without(&[path], "skip.path_independent_branches=false");
    assert_eq!((with.len(), without.len()), (14, 16));

    // Without friction any path of normal loads is.
    let [with, _] = same_without(
        &[
            path,
            "friction.mu=0.0",
            "path=[{ W = 500.0, increments = 3 }, { W = 1500.0, increments = 3 }, { W = 1000.0, increments = 2 }]",
        ],
        "skip.path_independent_branches=false",
    );
    assert_eq!(with.len(), 3);
}

/// Where the way counts, or is asked for, every increment is solved.
#[test]
fn increments_whose_way_counts() {
    let isotropic = [
        "body1.nu=0.0",
        "body2.nu=0.0",
        "skip.path_independent_branches=true",
    ];
    for setting in [
        "body2.E=70e9",
        "path.2.T_y=100.0",
        "path.2.W=900.0",
        "output.save=\"all\"",
    ] {
        let scene = scene(&[&isotropic[..], &[setting]].concat());
        let kept = Plan::new(&scene).points(&scene);
        let third = kept.iter().filter(|p| p.branch == 2).count();
        assert_eq!(third, 5, "{setting}: {}", line(&scene, "increments"));
    }
}

/// Down to the tolerance at which single precision serves, the answer is as near to that of a far
/// finer tolerance as the one in double precision.
#[test]
fn digits_that_the_tolerance_does_not_need() {
    let coated = "body2.coatings=[{ E = 4e11, nu = 0.25, thickness = { a_H = 0.5 } }]";
    for tolerance in ["1e-4", "1e-6"] {
        let asked = format!("solver.tolerance={tolerance}");
        let single = scene(&[coated, &asked]);
        assert!(line(&single, "digits").skipped);
        let double = scene(&[coated, &asked, "skip.single_precision=false"]);
        assert!(!line(&double, "digits").skipped);
        let exact = scene(&[coated]);
        assert!(!line(&exact, "digits").skipped);
        let mut ends = [Ends::default(), Ends::default(), Ends::default()];
        let run = |scene: &Scene, ends: &mut Ends| solve(scene, ends).unwrap();
        let with = run(&single, &mut ends[0]);
        let without = run(&double, &mut ends[1]);
        run(&exact, &mut ends[2]);
        let work = |run: &[Increment]| run.iter().map(|i| i.work.convolutions).sum::<f64>();
        // Now and then displacements are computed anew, with a second look at the solution.
        assert!(
            work(&with) < work(&without) + 2.0 * with.len() as f64,
            "{} {}",
            work(&with),
            work(&without)
        );
        let [with, without, exact] = ends.map(|ends| ends.0);
        for ((with, without), exact) in with.iter().zip(&without).zip(&exact) {
            let off = |of: &(Increment, Fields)| norm(&(&of.1.q_x - &exact.1.q_x));
            let allowed = 1.5 * off(without).max(1e-5 * norm(&exact.1.q_x));
            assert!(
                off(with) < allowed,
                "{tolerance}: {:e} of {allowed:e}",
                off(with)
            );
        }
    }
}

/// A small contact on a wide grid; contacts that appear far from the first, on the crests of waves;
/// a contact that is lost and found again, smaller; an odd grid and an ellipse.
#[test]
fn cells_far_from_the_contact() {
    let coated = "body2.coatings=[{ E = 4e11, nu = 0.25, thickness = { a_H = 0.5 } }]";
    let wide = "grid={ n = 96, extent = { a_H = 6.0 } }";
    let waves = "body1.shape={ sphere = { R = 0.018 }, waviness = { amplitude = 2e-6, wavelength = 6e-4 } }";
    let ellipse = "body1.shape={ ellipsoid = { R_x = 0.018, R_y = 0.05, angle = 0.4 } }";
    let again = "path=[{ W = 900.0, increments = 3 }, { T_x = 100.0, increments = 2 }, \
                 { W = 0.0, T_x = 0.0, increments = 2 }, { W = 500.0, increments = 2 }]";
    for settings in [
        &[wide, coated][..],
        &[wide, waves],
        &[wide, coated, again],
        &[
            "grid={ n = [71, 93], extent = { a_H = 8.0 } }",
            ellipse,
            coated,
        ],
    ] {
        let windowed = scene(settings);
        assert!(line(&windowed, "far").skipped);
        let whole = scene(&[settings, &["skip.contact_window=false"]].concat());
        assert!(!line(&whole, "far").skipped);
        let [with, without] = same_without(settings, "skip.contact_window=false");
        let pairs = with.iter().zip(&without);
        for (a, b) in pairs.filter(|(a, _)| a.contact_area > 0.0) {
            assert!((a.contact_area / b.contact_area - 1.0).abs() < 1e-6);
            assert!((a.stick_area - b.stick_area).abs() < 1e-6 * b.contact_area);
        }
    }
}
