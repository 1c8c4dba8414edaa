//! The path on a coarser grid: ends of branches, rows in between, resuming after any increment, and
//! the choice of the grid.

use std::sync::Arc;

use contact_core::Scene;
use contact_core::estimate::choose_increments;
use contact_core::march::{Increment, March, Reached, State};
use contact_core::scene::{PathGrid, SaveFields};
use ndarray::Array2;

/// The paper's scene with fewer branches.
const PAPER: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 128, extent = { a_H = 2.4 } }
path = [
    { W = 1000.0, increments = 8, spacing = "equal_radius" },
    { T_x = { mu_W = 0.9 }, increments = 9, spacing = "short_first" },
    { T_x = { mu_W = -0.9 }, increments = 13, spacing = "short_first" },
    { T_x = { mu_W = 0.9 }, increments = 13, spacing = "short_first" },
]

[body2]
shape = "flat"
E = 210e9
nu = 0.3

[[body2.coatings]]
E = { E_substrate = 2.0 }
nu = 0.3
thickness = { a_H = 1.0 }

[solver]
tolerance = 4e-5
"#;

fn scene(text: &str, set: &[&str]) -> Scene {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    Scene::from_toml_str(text, "path grid", &set).expect("a scene")
}

/// A run: its increments, and the shear where the fields are kept.
fn run(scene: &Scene) -> (Vec<Increment>, Vec<[Array2<f64>; 2]>) {
    let mut march = March::new(scene).expect("a march");
    let (mut increments, mut shears) = (Vec::new(), Vec::new());
    while let Some(increment) = march.advance() {
        let increment = increment.expect("an increment");
        if increment.point.ends_branch {
            shears.push(march.shear());
        }
        increments.push(increment);
    }
    (increments, shears)
}

fn norm(q: &[Array2<f64>; 2]) -> f64 {
    let square = |f: &Array2<f64>| f.iter().map(|f| f * f).sum::<f64>();
    (square(&q[0]) + square(&q[1])).sqrt()
}

/// The largest distance of shears, over the largest.
fn distance(of: &[[Array2<f64>; 2]], others: &[[Array2<f64>; 2]]) -> f64 {
    let largest = others.iter().map(norm).fold(0.0, f64::max);
    let pairs = of.iter().zip(others);
    let off = pairs.map(|(a, b)| norm(&[&a[0] - &b[0], &a[1] - &b[1]]));
    off.fold(0.0, f64::max) / largest
}

#[test]
fn ends_and_rows_are_those_of_the_grid_itself() {
    let (whole, q) = run(&scene(PAPER, &["solver.path_grid=same"]));
    let (rows, on_path) = run(&scene(PAPER, &["solver.path_grid=64"]));
    let off = distance(&on_path, &q);
    assert!(off < 2.5e-3, "the shear is {off:.1e} off");
    let fine = rows.iter().filter(|row| row.path_grid == 128).count();
    assert_eq!(fine, 4, "the ends of the branches");

    // Largest difference of the values of a column, over the largest value.
    let column = |name: &str, of: fn(&Increment) -> f64, allowed: f64| {
        let largest = whole.iter().map(|row| of(row).abs()).fold(0.0, f64::max);
        let off = rows.iter().zip(&whole).map(|(a, b)| (of(a) - of(b)).abs());
        let off = off.fold(0.0, f64::max) / largest;
        assert!(off < allowed, "{name} is {off:.1e} off");
    };
    column("delta_x", |row| row.motion.delta_x, 1e-3);
    column("delta_z", |row| row.motion.delta_z, 1e-4);
    // While the contact grows it has a few cells of the path grid.
    column("p_max", |row| row.p_max, 3e-3);
    // Beside a narrow slip ring the rim scatters by a quarter of a cell on the grid itself.
    let rim = 0.25 / rows[7].cells_per_radius;
    column("contact_area", |row| row.contact_area, 2.0 * rim);
    column("stick_ratio", Increment::stick_ratio, 3e-2);
    column("dissipated", |row| row.energy.dissipated, 1e-2);
    column("residual_energy", |row| 1.0 + row.residuals.energy, 1e-4);
    column("M_y", |row| row.point.loads.M_y, 1e-2);
    for (a, b) in rows.iter().zip(&whole) {
        let at = |row: &Increment| (row.index, row.point.t, row.point.loads.T_x);
        assert_eq!(at(a), at(b));
    }
}

#[test]
fn a_run_goes_on_from_any_increment_with_the_same_bits() {
    let scene = scene(PAPER, &["solver.path_grid=64", "grid.n=128"]);
    let mut march = March::new(&scene).expect("a march");
    let (mut states, mut increments): (Vec<State>, Vec<Increment>) = (Vec::new(), Vec::new());
    while let Some(increment) = march.advance() {
        increments.push(increment.expect("an increment"));
        states.push(march.state().clone());
    }
    let last = states.last().expect("a state");
    // While the contact grows, at the end of that, within branches and at an end.
    for done in [5, 8, 9, 16, 17, 35] {
        let mut march = March::resume(&scene, states[done - 1].clone()).expect("a march");
        for known in &increments[done..] {
            let again = march.advance().expect("an increment").expect("a solution");
            assert_eq!(&again, known, "after {done}");
        }
        assert_eq!(march.state(), last, "after {done}");
    }
}

#[test]
fn increments_that_keep_their_fields_are_solved_on_the_grid() {
    let mut scene = scene(PAPER, &["solver.path_grid=64"]);
    scene.settings.save = SaveFields::Indices(vec![3, 12, 25]);
    let (rows, _) = run(&scene);
    let fine: Vec<usize> = rows
        .iter()
        .filter(|row| row.path_grid == 128)
        .map(|row| row.index)
        .collect();
    assert_eq!(fine, [3, 8, 12, 17, 25, 30, 43]);
    scene.settings.save = SaveFields::All;
    let (rows, _) = run(&scene);
    assert!(rows.iter().all(|row| row.path_grid == 128));
}

#[test]
fn a_path_grid_divides_the_grid() {
    let refused: [(&[&str], &str); 3] = [
        (&["solver.path_grid=100"], "\"same\", 64, 32"),
        (&["solver.path_grid=32", "friction.kinetic=0.2"], "\"same\""),
        (
            &["solver.path_grid=32", "solver.preset=spinu2020"],
            "\"same\"",
        ),
    ];
    for (set, allowed) in refused {
        let set: Vec<String> = set.iter().map(ToString::to_string).collect();
        let scene = Scene::from_toml_str(PAPER, "path grid", &set);
        let error = scene
            .and_then(|scene| scene.check())
            .expect_err("a path grid");
        let said = error.to_string();
        assert!(
            said.contains("path_grid") && said.contains(allowed),
            "{said}"
        );
    }
}

/// The error that is estimated, over the true one, and the doubts of a run.
#[test]
fn a_path_grid_that_is_given_has_its_error() {
    let coarse = |n: usize, extent: f64, path: &str| {
        let (n, extent) = (
            format!("grid.n={n}"),
            format!("grid.extent={{ a_H = {extent} }}"),
        );
        scene(PAPER, &[&n, &extent, &format!("solver.path_grid={path}")])
    };
    for (n, extent, path, resolved) in [
        (64, 2.4, 32, true),
        (64, 5.0, 32, false),
        (64, 2.4, 16, false),
    ] {
        let (_, exact) = run(&coarse(n, extent, "\"same\""));
        let given = coarse(n, extent, &path.to_string());
        let known = choose_increments(&given, &Arc::default()).expect("an estimate");
        let (rows, q) = run(&known);
        let errors = known
            .path
            .branches
            .iter()
            .map(|b| b.path_error.expect("an error"));
        let (told, off) = (errors.fold(0.0, f64::max), distance(&q, &exact));
        assert!(
            told > 0.7 * off,
            "{off:.1e} off, {told:.1e} told, {n}/{path} cells on {extent} a"
        );
        let doubts = Reached::from_increments(&rows).doubts(&known);
        let few = doubts
            .iter()
            .any(|doubt| doubt.starts_with(&format!("solver.path_grid = {path}")));
        assert_eq!(few, !resolved, "{doubts:?}");
        assert_eq!(
            few,
            known
                .doubts()
                .iter()
                .any(|doubt| doubt.contains("path_grid"))
        );
    }
    // A path grid that is not used, since all fields are kept, has no error.
    let mut whole = coarse(64, 2.4, "16");
    whole.settings.save = SaveFields::All;
    let known = choose_increments(&whole, &Arc::default()).expect("the scene itself");
    assert_eq!(known, whole);
    assert!(
        known
            .doubts()
            .iter()
            .all(|doubt| !doubt.contains("path_grid"))
    );
    let refused = coarse(64, 20.0, "16")
        .check_fit()
        .expect_err("too few cells");
    assert!(
        refused.to_string().contains("solver.path_grid = 16"),
        "{refused}"
    );
}

/// Errors of the increments that are chosen contain that of a path grid that is given.
#[test]
fn chosen_increments_have_the_error_of_a_given_path_grid() {
    let open = PAPER
        .replace(", increments", "}, #")
        .replace("tolerance = 4e-5", "");
    let errors = |path: &str| {
        let scene = scene(&open, &["grid.n=64", path]);
        let chosen = choose_increments(&scene, &Arc::default()).expect("a choice");
        let errors = chosen
            .path
            .branches
            .iter()
            .map(|b| b.path_error.expect("an error"));
        errors.collect::<Vec<f64>>()
    };
    let (same, given) = (
        errors("solver.path_grid=\"same\""),
        errors("solver.path_grid=16"),
    );
    for (k, (same, given)) in same.iter().zip(&given).enumerate() {
        assert!(
            given >= same && (k == 0 || *given > 2.0 * same),
            "{same:.1e}, {given:.1e}"
        );
    }
}

/// The path grid that is chosen.
fn chosen(text: &str, set: &[&str]) -> PathGrid {
    let chosen = choose_increments(&scene(text, set), &Arc::default()).expect("a choice");
    chosen.settings.solver.path_grid
}

/// Rigid on nu = 0 and mu = 2; waves on the sphere; T_x, then T_y, then W again, then T_x.
#[test]
fn the_path_grid_is_chosen_by_its_error() {
    let text: String = PAPER
        .lines()
        .filter(|line| *line != "tolerance = 4e-5")
        .map(|line| match line.split_once(", increments") {
            Some((branch, _)) => format!("{branch} }},\n"),
            None => format!("{line}\n"),
        })
        .collect();
    for ratio in [0.5, 2.0, 4.0] {
        let coating = format!(
            "body2.coatings=[{{ E = {{ E_substrate = {ratio} }}, nu = 0.3, thickness = {{ a_H = 1.0 }} }}]"
        );
        let coarser = chosen(&text, &["grid.n=256", &coating]);
        assert_eq!(coarser, PathGrid::Cells(64), "E1/E2 = {ratio}");
    }
    assert_eq!(chosen(&text, &["grid.n=128"]), PathGrid::Same);
    assert_eq!(chosen(&text, &["grid.n=250"]), PathGrid::Same);
    let waves = "body1.shape={ sphere = { R = 0.018 }, waviness = { amplitude = 4e-7, wavelength = 8e-5 } }";
    assert_eq!(chosen(&text, &["grid.n=256", waves]), PathGrid::Same);
    let strong = [
        "grid.n=256",
        "grid.extent={ a_H = 3.0 }",
        "body1.E=inf",
        "body2.nu=0.0",
        "friction.mu=2.0",
        "body2.coatings=[]",
    ];
    assert_eq!(chosen(&text, &strong), PathGrid::Same);
    let round =
        "path=[{ W = 1000.0 }, { T_x = 200.0 }, { T_y = 150.0 }, { W = 1200.0 }, { T_x = -200.0 }]";
    assert_ne!(chosen(&text, &["grid.n=256", round]), PathGrid::Cells(64));
}

/// Half-spaces of unlike metals with wide and narrow rings of slip; the reference has eight times the
/// increments on the grid.
#[test]
fn an_indentation_on_the_path_grid_has_less_error_than_on_the_grid_itself() {
    let text = |n: usize, mu: f64| {
        format!(
            "schema = 1\nbody1 = {{ shape.sphere.R = 0.01, E = 210e9, nu = 0.3 }}\nfriction.mu = {mu}\n\
             grid = {{ n = {n}, extent = {{ a_H = 3.0 }} }}\nsolver.tolerance = 2e-5\n\
             path = [{{ W = 100.0, increments = 21, spacing = \"equal_radius\" }}]\n\
             [body2]\nshape = \"flat\"\nE = 70e9\nnu = 0.33\n"
        )
    };
    for mu in [0.08, 0.15, 0.2] {
        let end = |set: &[&str]| run(&scene(&text(128, mu), set)).1;
        let exact = end(&["path.0.increments=168", "solver.path_grid=same"]);
        let on_grid = end(&["solver.path_grid=same"]);
        let on_path = end(&["solver.path_grid=64"]);
        let errors = [on_grid, on_path].map(|q| distance(&q, &exact));
        assert!(errors[1] < 0.95 * errors[0], "mu = {mu}: {errors:?}");
    }
}

/// A stick zone of less than half of the contact says little of the ring around it.
#[test]
fn an_indentation_with_a_wide_ring_of_slip_is_that_of_the_grid_itself() {
    let text = "schema = 1\nbody1 = { shape.sphere.R = 0.01, E = 210e9, nu = 0.3 }\nfriction.mu = 0.05\n\
                grid = { n = 64, extent = { a_H = 2.6 } }\nsolver.tolerance = 2e-5\n\
                path = [{ W = 100.0, increments = 12, spacing = \"equal_radius\" }]\n\
                [body2]\nshape = \"flat\"\nE = 70e9\nnu = 0.33\n";
    let end = |path: &str| run(&scene(text, &[path]));
    let (rows, on_grid) = end("solver.path_grid=same");
    assert!(rows[11].stick_ratio() < 0.25, "{}", rows[11].stick_ratio());
    let (rows, on_path) = end("solver.path_grid=32");
    assert_eq!(rows[10].path_grid, 32);
    let off = distance(&on_path, &on_grid);
    assert!(off < 1e-4, "the shear is {off:.1e} off");
}

/// With a single pass of pressure and shear the end does not converge from what the stick zone remembers
/// of the path grid: the indentation is solved on the grid itself.
#[test]
fn an_end_that_does_not_converge_is_that_of_the_increments_on_the_grid() {
    let once = ["grid.n=64", "solver.max_alternations=1"];
    let solved = |path: &str| scene(PAPER, &[&once[..], &[path]].concat());
    let (whole, q) = run(&solved("solver.path_grid=same"));
    let given = solved("solver.path_grid=32");
    let (rows, on_path) = run(&given);
    let pieces: usize = whole[..8].iter().map(|row| row.work.parts).sum();
    assert!(rows[7].work.parts >= pieces && rows[7].path_grid == 64);
    assert_eq!(rows[6].path_grid, 32);
    let off = distance(&on_path[..1], &q[..1]);
    // In another window, within the tolerance of halved increments.
    assert!(off < 1e-3, "the shear is {off:.1e} off");
    let mut march = March::new(&given).expect("a march");
    for done in 0..10 {
        let mut again = March::resume(&given, march.state().clone()).expect("a march");
        for row in &rows[done..10] {
            let next = again.advance().expect("an increment").expect("a solution");
            assert_eq!(&next, row, "after {done}");
        }
        march.advance().expect("an increment").expect("a solution");
    }
}
