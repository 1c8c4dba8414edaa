//! Gross slip: the normal problem alone, at every place of the stroke.

use std::f64::consts::PI;
use std::sync::Arc;
use std::time::Instant;

use contact_core::scene::*;
use contact_core::wear::*;

pub(crate) fn steel() -> Elastic {
    Elastic { E: 200e9, nu: 0.3 }
}

pub(crate) fn archard(k: f64) -> BodyWear {
    BodyWear::of(Archard { k, threshold: 0.0 })
}

/// A path that presses with W and slides to and fro by +-`stroke` in `places` increments a way.
pub(crate) fn to_and_fro(W: f64, stroke: f64, places: usize) -> LoadPath {
    let slide = |to: f64, places: usize| {
        move |path: LoadPath| path.to(|at| at.given.delta_x = Some(to), places)
    };
    let path = LoadPath::start().normal(W, 1);
    [(stroke, 1), (-stroke, places), (stroke, places)]
        .into_iter()
        .fold(path, |path, (to, places)| slide(to, places)(path))
}

pub(crate) fn scene(shape: Shape, grid: Grid, path: LoadPath, mu: f64) -> Scene {
    Scene {
        title: String::new(),
        body1: Body::homogeneous(steel(), shape),
        body2: Body::homogeneous(steel(), Shape::Flat),
        friction: Friction::coulomb(mu),
        grid,
        path,
        settings: Settings::default(),
    }
}

pub(crate) fn sliding(bodies: [BodyWear; 2], cycles: f64) -> Wear {
    Wear {
        first_branch: 2,
        cycling: Cycling::Sliding,
        ..Wear::new(bodies, cycles)
    }
}

/// Runs to the end; every jump is checked.
pub(crate) fn run(scene: &Scene, wear: &Wear) -> (WearRun, Vec<Jump>) {
    let t = Instant::now();
    let mut run = WearRun::new(scene, wear, &Arc::default()).unwrap();
    let mut jumps: Vec<Jump> = Vec::new();
    while let Some(jump) = run.advance() {
        let jump = jump.unwrap();
        if std::env::var("SHOW").is_ok() {
            println!(
                "{:3} N {:9.1} (+{:8.1}, {} retries) error {:.1e} {:.1e} depth {:.4} {:.4} um p_max {:.1} MPa stick {:.3} {:.3e}",
                jump.index,
                jump.cycles,
                jump.length,
                jump.retries,
                jump.error,
                jump.pressure_error,
                jump.depth[0] * 1e6,
                jump.depth[1] * 1e6,
                jump.p_max / 1e6,
                jump.stick_ratio,
                jump.depth_error
            );
        }
        jumps.push(jump);
    }
    if std::env::var("SHOW").is_ok() {
        println!("{:?}, work {:?}", t.elapsed(), run.work());
    }
    (run, jumps)
}

fn line(cells: usize, extent: f64, W: f64, stroke: f64, places: usize, R: f64, mu: f64) -> Scene {
    let cylinder = Shape::Cylinder {
        R,
        length: f64::INFINITY,
        angle: 0.0,
    };
    let grid = Grid::strip(extent, cells, 1.0).unwrap();
    scene(cylinder, grid, to_and_fro(W, stroke, places), mu)
}

/// Width between the outermost places that are worn by more than a part of the deepest.
fn width(worn: &ndarray::Array2<f64>, d: f64) -> f64 {
    let row: Vec<f64> = worn.column(worn.ncols() / 2).to_vec();
    let deepest = row.iter().fold(0.0, |m: f64, w| m.max(*w));
    row.iter().filter(|w| **w > 1e-3 * deepest).count() as f64 * d
}

#[test]
fn mccoll_ding_leen() {
    // R. McColl, J. Ding, S. B. Leen, Wear 256 (2004) 1114-1127.
    let n = std::env::var("N").map_or(640, |v| v.parse().unwrap());
    let per = std::env::var("PER").map_or(10, |v| v.parse().unwrap());
    let tol = std::env::var("TOL").map_or(0.005, |v| v.parse().unwrap());
    let scene = line(n, 0.72e-3, 18.5e3, 25e-6, per, 6e-3, 0.9);
    let mut wear = sliding([archard(1.9e-14), archard(2.9e-14)], 18e3);
    wear.rig_stiffness = 0.9 * 18.5e3 / 0.72e-6;
    wear.jumps = Jumps::Tolerance(tol);
    if let Ok(number) = std::env::var("JUMPS") {
        wear.jumps = Jumps::Number(number.parse().unwrap());
    }
    let (run, jumps) = run(&scene, &wear);
    let block = run.block();
    println!(
        "{} jumps; flat {:.4} um, cylinder {:.4} um; scar {:.4} mm; area {:.4e} mm2",
        jumps.len(),
        jumps.last().unwrap().depth[1] * 1e6,
        jumps.last().unwrap().depth[0] * 1e6,
        width(&block.worn2, scene.grid.dx) * 1e3,
        jumps.last().unwrap().volume[1] * 1e6
    );
}

#[test]
fn late_gross_slip_of_a_cylinder_has_its_closed_form() {
    let (R, W, stroke, k): (f64, f64, f64, f64) = (6e-3, 18.5e3, 1e-6, 2e-13);
    let cycles = 200e3;
    // Both bodies together: k s with s = 4 stroke per cycle, W per length.
    let b = (1.5 * R * k * W * 4.0 * stroke * cycles).cbrt();
    let scene = line(512, 2.6 * b, W, stroke, 1, R, 0.9);
    let wear = sliding([archard(0.5 * k), archard(0.5 * k)], cycles);
    let (run, jumps) = run(&scene, &wear);
    let block = run.block();
    let depth = (&block.worn1 + &block.worn2)
        .iter()
        .fold(0.0, |m: f64, w| m.max(*w));
    println!(
        "b {b:e}, a/b {:.3}, depth {:.4}, width {:.4}, jumps {}",
        scene.hertz().unwrap().a / b,
        depth / (b * b / 2.0 / R),
        width(&block.worn1, scene.grid.dx) / 2.0 / b,
        jumps.len()
    );
}

#[test]
fn late_gross_slip_of_a_sphere_has_its_closed_form() {
    let (R, W, stroke, k) = (6e-3, 20.0, 1e-6, 2e-13);
    let cycles = 2e6;
    let b = (4.0 * R * k * W * 4.0 * stroke * cycles / PI).powf(0.25);
    let grid = Grid::centred(2.6 * b, 64).unwrap();
    let scene = scene(Shape::Sphere { R }, grid, to_and_fro(W, stroke, 1), 0.9);
    let wear = sliding([archard(0.5 * k), archard(0.5 * k)], cycles);
    let (run, jumps) = run(&scene, &wear);
    let block = run.block();
    let depth = (&block.worn1 + &block.worn2)
        .iter()
        .fold(0.0, |m: f64, w| m.max(*w));
    println!(
        "b {b:e}, a/b {:.3}, depth {:.4}, width {:.4}, jumps {}",
        scene.hertz().unwrap().a / b,
        depth / (b * b / 2.0 / R),
        width(&block.worn1, scene.grid.dx) / 2.0 / b,
        jumps.len()
    );
}
