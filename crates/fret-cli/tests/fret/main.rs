//! The binary as a user meets it: what it says, where, and how it ends.

// What is read back is what was written: equality is meant to the bit.
#![allow(clippy::unwrap_used, clippy::float_cmp)]

#[path = "../../../contact-core/tests/files/mod.rs"]
mod files;
mod interrupted;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use contact_store::Store;
use files::files;

/// A scene of the repository, made small enough for a moment.
const SCENE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/cattaneo_mindlin.toml"
);
const SMALL: [&str; 4] = ["--set", "grid.n=24", "--set", "path.3.increments=8"];

/// Runs the command in a window that is wide enough for every line.
fn fret(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fret"))
        .args(arguments)
        .env("COLUMNS", "4000")
        .output()
        .unwrap()
}

/// A path in the build folder that is free.
fn free(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    path
}

fn run(out: &Path, more: &[&str]) -> Output {
    let mut arguments = vec!["run", SCENE, "-o", out.to_str().unwrap()];
    arguments.extend(SMALL);
    arguments.extend(more);
    fret(&arguments)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Exit code 2, one sentence on the standard error with all the words, nothing elsewhere.
#[track_caller]
fn assert_bad_input(output: &Output, words: &[&str]) {
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(output.stdout.is_empty());
    for word in words {
        assert!(error.contains(word), "{error:?} lacks {word:?}");
    }
}

#[test]
fn error_bars_stand_in_the_summary_and_in_the_store() {
    let out = free("error.zarr");
    let output = run(&out, &["--error"]);
    let told = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    // Six numbers at the end of each of four branches, and two fields; those of cycles have their own.
    let of_cycle = |line: &&str| {
        let begins = ["cycle", "  sliding ratio", "  stiffness"];
        begins.iter().any(|word| line.starts_with(word))
    };
    let of_branches = told.lines().filter(|line| !of_cycle(line));
    let bars: usize = of_branches.map(|line| line.matches("+- ").count()).sum();
    // Nothing moves along the plane in the indentation: two numbers are 0, exactly.
    assert_eq!(bars, 4 * 8 - 2, "{told}");
    let of_path = told.lines().filter(|line| line.starts_with("path "));
    assert_eq!(of_path.count(), 4, "{told}");
    // Energy, energy ratio and sliding ratio of the cycle, below the table.
    let cycle = told.lines().rfind(|line| line.starts_with("cycle"));
    assert_eq!(
        cycle.map(|line| line.matches("+- ").count()),
        Some(3),
        "{told}"
    );
    Store::open(&out).unwrap();
    let attributes = fs::read_to_string(out.join(".zattrs")).unwrap();
    assert_eq!(attributes.matches("\"contact_radius\"").count(), 4);

    let output = run(&free("few.zarr"), &["--error", "--set", "grid.n=12"]);
    // The run is kept, and told is why it has no error bars.
    let told = text(&output.stderr);
    assert!(output.status.success(), "{told}");
    let why = told.lines().last().unwrap_or_default();
    for part in ["no error bars", "grid.n", "[12, 12]", "20 or more cells"] {
        assert!(why.contains(part), "{told}");
    }
}

#[test]
fn a_line_contact_is_told_per_metre() {
    let scene = Path::new(env!("CARGO_TARGET_TMPDIR")).join("line.toml");
    fs::write(
        &scene,
        "schema = 1\nbody1 = { shape.cylinder.R = 0.02, E = 210e9, nu = 0.3 }\n\
         body2 = { shape = \"flat\", E = 210e9, nu = 0.3 }\nfriction.mu = 0.3\n\
         grid = { n = [64, 1], extent = 3e-4, plane_strain = true }\n\
         path = [{ W = 3e4, increments = 1 }, { T_x = 4500.0, increments = 4 }, \
         { T_x = -4500.0, increments = 8 }, { T_x = 4500.0, increments = 8 }]\n",
    )
    .unwrap();
    let scene = scene.to_str().unwrap();
    let checked = text(&fret(&["check", scene]).stdout);
    for part in [
        "W up to 30000 N/m",
        "plane strain; forces and energies per metre",
    ] {
        assert!(checked.contains(part), "{checked}");
    }
    let out = free("line.zarr");
    let output = fret(&["run", scene, "-o", out.to_str().unwrap()]);
    let (told, error) = (text(&output.stdout), text(&output.stderr));
    assert!(
        error.contains("W = 30000 N/m, T_x = 4500 N/m: half width"),
        "{error}"
    );
    for part in ["[N/m]", "half", "[mJ/m]", "N/m per m"] {
        assert!(told.contains(part), "{told}");
    }
    for part in ["[N]", "radius", "uJ"] {
        assert!(!told.contains(part), "{told}");
    }
    // Cattaneo's cycle of amplitude T = mu W/2 (Johnson, Contact Mechanics, 7.2.4) sticks on
    // sqrt(1/2) of the width; the JSON has names and units of the store.
    let out = free("line_json.zarr");
    let output = fret(&["run", scene, "-o", out.to_str().unwrap(), "--json"]);
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["units"]["force"], "N/m");
    assert_eq!(told["units"]["stiffness"], "N/m per m");
    let branch = &told["branches"][3];
    let a = (4.0 * 3e4 * 0.02 * 1.82 / (std::f64::consts::PI * 210e9)).sqrt();
    let half = branch["half_width"].as_f64().unwrap();
    assert!((half / a - 1.0).abs() < 0.5 * 3e-4 / 64.0 / a, "{half}");
    let stick = branch["stick_ratio"].as_f64().unwrap();
    assert!((stick - 0.5_f64.sqrt()).abs() < 0.02, "{stick}");
}

#[test]
fn a_run_says_what_it_does_and_leaves_a_store() {
    let out = free("run.zarr");
    let output = run(&out, &[]);
    let (told, error) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{error}");
    let branches: Vec<_> = error.lines().filter(|l| l.starts_with("branch ")).collect();
    assert_eq!(branches.len(), 4, "{error}");
    assert!(branches[1].starts_with("branch 2/4: t = 2, W = 1000 N, T_x = 270 N: contact radius"));
    for title in ["stick", "p_max", "delta_x", "dissip.", "state"] {
        assert!(told.contains(title), "{told}");
    }
    assert_eq!(
        told.lines().filter(|line| line.contains(" 1000 ")).count(),
        4
    );

    let store = Store::open(&out).unwrap();
    assert_eq!(store.status(), "done");
    assert_eq!(store.increments(), 1 + 10 + 20 + 8);
    assert_eq!(store.scene().grid.nx, 24);
}

#[test]
fn quiet_is_quiet() {
    let output = run(&free("quiet.zarr"), &["--quiet"]);
    assert!(output.status.success());
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
}

/// The same bits with one, two and four threads, and from run to run: unlike bodies, a coating, a
/// grid that is no power of two, large enough for sums to be shared out.
#[test]
fn results_are_the_same_bits_for_any_number_of_threads() {
    let scene = SCENE.replace("cattaneo_mindlin", "coated_small");
    let store = |threads: &str| {
        let out = free("threads.zarr");
        let arguments = ["run", &scene, "-o", out.to_str().unwrap(), "--quiet"];
        let small = ["--set", "grid.n=[66, 130]", "--set", "path.0.increments=4"];
        let rest = [
            "--set",
            "path.1.increments=3",
            "--set",
            "path.2.increments=3",
        ];
        let output = fret(&[&arguments[..], &small, &rest, &["--threads", threads]].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        files(&out)
    };
    let one = store("1");
    for threads in ["2", "4", "2"] {
        assert!(store(threads) == one, "{threads} threads");
    }
    let about = String::from_utf8(one[Path::new(".zattrs")].clone()).unwrap();
    for key in [
        "\"version\"",
        "\"scene\"",
        "[solver]",
        "\"plan\"",
        "\"status\": \"done\"",
    ] {
        assert!(about.contains(key), "{about} lacks {key}");
    }
    for counter in ["convolutions", "alternations", "normal_iterations", "parts"] {
        assert!(one.contains_key(&Path::new(counter).join("0")), "{counter}");
    }
}

/// A scene reads what came with it; to read more it has to be allowed.
#[test]
fn a_scene_reads_no_file_outside_its_folder() {
    let folder = free("folder");
    fs::create_dir_all(folder.join("scene")).unwrap();
    let heights = "0, 0, 0\n0, 1e-6, 0\n0, 0, 0\n";
    fs::write(folder.join("outside.csv"), heights).unwrap();
    fs::write(folder.join("scene/inside.csv"), heights).unwrap();
    let path = folder.join("scene/scene.toml");
    let check = |file: &str, more: &[&str]| {
        let scene = format!(
            "schema = 1\nfriction.mu = 0.3\ngrid = {{ n = 8, extent = 3e-3 }}\n\
             path = [{{ W = 1.0, increments = 1 }}]\n\
             body1 = {{ shape.height_map = {{ spacing = 1e-3, file = '{file}' }}, E = 2e11, nu = 0.3 }}\n\
             body2 = {{ shape = \"flat\", E = 2e11, nu = 0.3 }}\n"
        );
        fs::write(&path, scene).unwrap();
        fret(&[&["check", path.to_str().unwrap()], more].concat())
    };
    assert!(check("inside.csv", &[]).status.success());
    let outside = folder.join("outside.csv");
    for file in ["../outside.csv", outside.to_str().unwrap(), "/etc/passwd"] {
        assert_bad_input(
            &check(file, &[]),
            &["outside the folder", "--allow-outside"],
        );
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&outside, folder.join("scene/link.csv")).unwrap();
        assert_bad_input(&check("link.csv", &[]), &["outside the folder"]);
    }
    let allowed = check("../outside.csv", &["--allow-outside"]);
    assert!(allowed.status.success(), "{}", text(&allowed.stderr));
}

/// The number stands in the refusal, and `fret check` announces it.
#[test]
fn a_scene_that_needs_more_memory_than_there_is_is_refused() {
    let output = fret(&["check", SCENE]);
    let told = text(&output.stdout);
    let memory = told.lines().find(|l| l.starts_with("memory")).unwrap();
    assert!(memory.contains(" MB of "), "{memory}");
    // The load path alone would take 160 GB; should a machine have them, the grid takes more.
    let many = ["--set", "path.0.increments=99000000"];
    let huge = ["--set", "grid.n=16384"];
    for more in [&many[..], &huge[..]] {
        let out = free("huge.zarr");
        let out = ["-o", out.to_str().unwrap(), "--quiet"];
        let output = fret(&[&["run", SCENE][..], more, &out].concat());
        assert_bad_input(&output, &["MB of memory", "are available"]);
    }
}

#[test]
fn bad_input_is_refused_before_anything_is_written() {
    let out = free("bad.zarr");
    for (setting, words) in [
        ("friction.mu=-0.3", &["friction.mu = -0.3", ">= 0"][..]),
        ("body1.E=-1.0", &["body1.E = -1", "a positive modulus"]),
        ("body2.nu=0.6", &["body2.nu = 0.6", "-1 < nu <= 0.5"]),
        ("grid.n=0", &["grid.n = 0", ">= 1"]),
        (
            "path.1.T_x.mu_W=1.5",
            &["path[1].T_x = 450", "|T| <= mu W = 300,"],
        ),
        ("grid.m=3", &["grid.m", "`grid.n`"]),
        // The contact leaves the grid.
        (
            "grid.extent.a_H=1.0",
            &["does not fit on the grid", "should be about"],
        ),
    ] {
        let output = run(&out, &["--quiet", "--set", setting]);
        assert_bad_input(&output, words);
        assert!(!out.exists(), "{setting}");
    }
}

#[test]
fn a_bad_file_is_named_with_its_line() {
    let scene = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bad_scene.toml");
    let good = fs::read_to_string(SCENE).unwrap();
    fs::write(&scene, good.replace("[friction]", "[frction]")).unwrap();
    let output = fret(&["check", scene.to_str().unwrap()]);
    assert_bad_input(&output, &["bad_scene.toml:16: ", "`frction`", "`friction`"]);
    let output = fret(&["check", "no/such/scene.toml"]);
    assert_bad_input(&output, &["no/such/scene.toml: "]);
}

#[test]
fn a_store_is_overwritten_only_on_demand() {
    let out = free("twice.zarr");
    assert!(run(&out, &["--quiet"]).status.success());
    assert_bad_input(&run(&out, &[]), &["twice.zarr", "exists", "--overwrite"]);
    assert!(run(&out, &["--quiet", "--overwrite"]).status.success());
    let bad = run(&out, &["--overwrite", "--set", "friction.mu=-1"]);
    assert_bad_input(&bad, &["friction.mu"]);
    assert_eq!(Store::open(&out).unwrap().increments(), 39);
}

#[test]
fn a_run_that_does_not_converge_keeps_what_it_has() {
    let out = free("stuck.zarr");
    // Twelve gradients do for the pressure and not for the shear.
    let few = [
        "--set",
        "solver.preset=spinu2020",
        "--set",
        "solver.max_iterations=12",
        "--set",
        "solver.tolerance=1e-8",
    ];
    let output = run(&out, &few);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("increments are kept in"), "{error}");
    let last = error.lines().last().unwrap();
    assert!(
        last.contains("the tangential solver stopped at residual"),
        "{error}"
    );
    assert!(text(&output.stdout).contains(" 1000 "));
    let store = Store::open(&out).unwrap();
    assert!(store.increments() >= 1);
    assert_eq!(format!("fret: {}", store.status()), last);
}

#[test]
fn check_solves_nothing() {
    let mut arguments = vec!["check", SCENE];
    arguments.extend(SMALL);
    let output = fret(&arguments);
    let told = text(&output.stdout);
    assert!(output.status.success());
    for words in [
        "a_H           504.7 um",
        "p_H           187",
        "cells per a_H 10.00 along x, 10.00 along y",
        "24 x 24 cells",
        "4 branches, 39 increments",
        "memory        about 17 MB",
        "skipped: normal-tangential coupling",
    ] {
        assert!(told.contains(words), "{told:?} lacks {words:?}");
    }
}

/// A run of wear goes on as the scene that it was begun with, or not at all.
#[test]
fn wear_is_resumed_for_its_own_scene() {
    let (out, scene) = (
        free("wear.zarr"),
        SCENE.replace("cattaneo_mindlin", "wear_mccoll"),
    );
    let wear = |more: &[&str]| {
        let small = ["--set", "grid.n=64", "--set", "wear.cycles=500"];
        let begins = ["wear", &scene, "-o", out.to_str().unwrap()];
        fret(&[&begins[..], &small, more].concat())
    };
    let begun = wear(&[]);
    assert!(begun.status.success(), "{}", text(&begun.stderr));
    assert!(text(&begun.stdout).contains("500"));
    let whole = files(&out);
    let done = wear(&["--resume"]);
    assert!(done.status.success() && text(&done.stderr).contains("is done"));
    let other = wear(&["--resume", "--set", "friction.mu=0.5"]);
    assert_eq!(other.status.code(), Some(2));
    assert!(text(&other.stderr).contains("belongs to another scene"));
    let store = out.to_str().unwrap();
    let resumed = fret(&["resume", store]);
    assert!(resumed.status.success() && text(&resumed.stderr).contains("is done"));
    let json = fret(&["resume", store, "--json"]);
    assert_eq!(json.status.code(), Some(2));
    assert!(text(&json.stderr).contains("--json: must be for runs through a load path"));
    assert!(files(&out) == whole);
}
