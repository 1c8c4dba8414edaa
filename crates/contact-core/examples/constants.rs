//! Work and errors of the scenes of `examples/ablation`, for a scan of the constants in the
//! methods.
//!
//! `constants FOLDER` prints a line per scene: name, convolutions, errors of the shear after the
//! first branch and at the ends, of the radii of contact and stick zone in cells; or what failed.
//! The finer runs that these are measured against are kept in the folder, so that a build with
//! another constant finds those of the present ones. `tools/constants.py` makes the builds
//! (`make constants`).
#![allow(clippy::print_stdout)]

#[path = "ablation/scenes.rs"]
mod scenes;

use std::path::Path;
use std::sync::Arc;

use contact_core::Error;
use contact_core::estimate::choose_increments_like;
use contact_core::march::March;
use contact_core::scene::{Grid, Scene};

use scenes::{Trial, trials};

/// The cells each way: errors of the path hardly depend on them.
const CELLS: usize = 64;

/// The ends of the branches: contact and stick area, then q_x and q_y of every cell.
type Ends = Vec<Vec<f64>>;

/// The convolutions of a run, and the ends of its branches.
fn run(scene: &Scene) -> Result<(f64, Ends), Error> {
    let mut march = March::until(scene, &Arc::default())?;
    let (mut convolutions, mut ends) = (0.0, Ends::new());
    while let Some(increment) = march.advance() {
        let increment = increment?;
        convolutions += increment.work.convolutions;
        if increment.point.ends_branch {
            let [_, q_x, q_y] = march.tractions();
            let areas = [increment.contact_area, increment.stick_area];
            ends.push(areas.into_iter().chain(q_x).chain(q_y).collect());
        }
    }
    Ok((convolutions, ends))
}

/// The finer run of a scene, kept in a file.
fn reference(scene: &Scene, file: &Path) -> Result<Ends, Error> {
    if let Ok(bytes) = std::fs::read(file) {
        let numbers = bytes
            .as_chunks::<8>()
            .0
            .iter()
            .map(|b| f64::from_le_bytes(*b));
        let numbers: Vec<f64> = numbers.collect();
        return Ok(numbers
            .chunks(2 + 2 * CELLS * CELLS)
            .map(<[f64]>::to_vec)
            .collect());
    }
    let (_, ends) = run(scene)?;
    let bytes: Vec<u8> = ends
        .iter()
        .flatten()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    std::fs::write(file, bytes).map_err(|e| Error::File {
        path: file.display().to_string(),
        message: e.to_string(),
    })?;
    Ok(ends)
}

/// Errors as in `examples/ablation`.
fn errors(ends: &Ends, truth: &Ends, cell: f64) -> [f64; 4] {
    let norm = |v: &[f64]| v[2..].iter().map(|q| q * q).sum::<f64>().sqrt();
    let largest = truth.iter().map(|end| norm(end)).fold(0.0, f64::max);
    let pairs: Vec<(&Vec<f64>, &Vec<f64>)> = ends.iter().zip(truth).collect();
    let off = |(a, b): &(&Vec<f64>, &Vec<f64>)| {
        let change: Vec<f64> = a.iter().zip(*b).map(|(a, b)| a - b).collect();
        norm(&change) / largest
    };
    let radius = |k: usize| {
        let of = |area: f64| (area / std::f64::consts::PI).sqrt() / cell;
        let off = pairs.iter().map(|(a, b)| (of(a[k]) - of(b[k])).abs());
        off.fold(0.0, f64::max)
    };
    let later = pairs.iter().skip(1).map(off).fold(0.0, f64::max);
    [off(&pairs[0]), later, radius(0), radius(1)]
}

/// A sphere on a soft coating, pressed and sheared.
const SOFT: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3, coatings = [{ E = { E_substrate = 0.5 }, nu = 0.4, thickness = { a_H = 0.5 } }] }
friction.mu = 0.2
grid = { n = 64, extent = { a_H = 2.6 } }
path = [{ W = 1000.0, spacing = "equal_radius" }, { T_x = { mu_W = 0.7 } }, { T_x = { mu_W = -0.7 } }]
"#;

/// An indentation on the path grid, and increments of a neighbouring scene.
fn more_trials() -> Result<[Trial; 2], Error> {
    let soft = |increments: [&str; 3], set: &[&str]| {
        let of = |(k, n)| format!("path.{k}.increments={n}");
        let of_branches = increments.iter().enumerate().map(of);
        let set: Vec<String> = of_branches
            .chain(set.iter().map(ToString::to_string))
            .collect();
        Scene::from_toml_str(SOFT, "constants", &set)
    };
    let reference = soft(
        ["168", "80", "160"],
        &["solver.tolerance=1e-7", "solver.path_grid=same"],
    )?;
    let on_path_grid = soft(["21", "10", "20"], &["solver.path_grid=32"])?;
    let open = |set: &[&str]| soft(["\"auto\""; 3], set);
    let neighbour = open(&["friction.mu=0.21"])?;
    let chosen = choose_increments_like(&open(&[])?, &neighbour, &Arc::default())?;
    let trial = |name, scene| Trial {
        name,
        scene,
        reference: reference.clone(),
    };
    Ok([
        trial("indentation on a path grid", on_path_grid),
        trial("increments of a neighbour", chosen),
    ])
}

fn coarse(scene: &Scene) -> Scene {
    let (along_x, along_y) = scene.grid.extent();
    let mut coarse = scene.clone();
    coarse.grid = Grid {
        nx: CELLS,
        ny: CELLS,
        dx: along_x / CELLS as f64,
        dy: along_y / CELLS as f64,
        ..scene.grid
    };
    coarse
}

fn main() -> Result<(), Error> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let all = trials()?.into_iter().chain(more_trials()?);
    for (k, trial) in all.enumerate() {
        if ["1000", "256"].iter().any(|n| trial.name.contains(n)) {
            continue;
        }
        let (scene, finer) = (coarse(&trial.scene), coarse(&trial.reference));
        let truth = reference(&finer, &Path::new(&folder).join(format!("{k}.bin")))?;
        match run(&scene) {
            Ok((convolutions, ends)) => {
                let [first, later, a, c] = errors(&ends, &truth, scene.grid.dx);
                println!(
                    "{}|{convolutions:.1}|{first:.3e}|{later:.3e}|{a:.4}|{c:.4}",
                    trial.name
                );
            }
            Err(failure) => println!("{}|{failure}", trial.name),
        }
    }
    Ok(())
}
