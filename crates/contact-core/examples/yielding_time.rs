//! What bodies that yield cost: passes, processor time and time of three paths, beside the same paths of
//! elastic bodies, as a table on the standard output.
//!
//! `indentation`: a rigid sphere on steel, 12 increments to six times the approach of first yield, 64 x 64
//! cells. `line`: a cylinder that frets, 100 increments, 128 cells. `paper`: the scene
//! `coated_fretting.toml` on 64 x 64 cells with chosen increments and a substrate that yields. Arguments:
//! names of paths, all without.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use contact_core::estimate::choose_increments;
use contact_core::march::March;
use contact_core::scene::{
    Body, Branch, Elastic, Friction, Grid, LoadPath, Loads, Plastic, PrescribedMotions, Scene,
    Shape,
};

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };

fn law(s_y: f64, hardening: f64) -> Plastic {
    Plastic {
        hardening,
        ..Plastic::perfect(s_y)
    }
}

fn yielding(shape: Shape, material: Elastic, law: Plastic) -> Body {
    let mut body = Body::homogeneous(material, shape);
    body.plastic = vec![Some(law)];
    body
}

fn path(branches: Vec<Branch>) -> LoadPath {
    LoadPath {
        branches,
        ..LoadPath::default()
    }
}

fn indentation() -> Scene {
    let given = PrescribedMotions {
        delta_z: Some(7.23e-6),
        ..PrescribedMotions::default()
    };
    let to = Loads {
        given,
        ..Loads::default()
    };
    Scene::new(
        Body::homogeneous(Elastic::RIGID, Shape::Sphere { R: 0.01 }),
        yielding(Shape::Flat, STEEL, law(1e9, 1e10)),
        Friction::coulomb(0.0),
        Grid::centred(7.8e-4, 64).expect("a grid"),
        path(vec![Branch::new(to, 12, 1.0)]),
    )
}

fn line() -> Scene {
    let to = |W: f64, T_x: f64| Loads {
        W,
        T_x,
        ..Loads::default()
    };
    let (W, T) = (1.08909e6, 3.48507e5);
    let branches = [
        (to(W, 0.0), 10),
        (to(W, T), 10),
        (to(W, -T), 20),
        (to(W, T), 20),
        (to(W, -T), 20),
        (to(W, T), 20),
    ];
    let mut t = 0.0;
    let branches = branches.map(|(to, increments)| {
        t += 0.1;
        Branch::new(to, increments, t)
    });
    let shape = Shape::Cylinder {
        R: 0.01,
        length: f64::INFINITY,
        angle: 0.0,
    };
    Scene::new(
        Body::homogeneous(STEEL, shape),
        yielding(Shape::Flat, STEEL, law(1e9, 1e10)),
        Friction::coulomb(0.4),
        Grid::strip(1.04e-3, 128, 1.0).expect("a grid"),
        path(branches.to_vec()),
    )
}

fn paper() -> Scene {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenes/coated_fretting.toml"
    );
    let mut scene = Scene::from_file(file, &[]).expect("a scene");
    let extent = scene.grid.extent().0;
    scene.grid = Grid::centred(extent, 64).expect("a grid");
    for branch in &mut scene.path.branches {
        branch.increments = None;
    }
    scene.body2.plastic = vec![None, Some(law(9e8, 5e9))];
    scene
}

/// Processor time of the process [s].
fn processor() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = text.rsplit(')').next().unwrap_or_default();
    let ticks = |n: usize| -> f64 {
        let field = after.split_whitespace().nth(n);
        field.and_then(|t| t.parse().ok()).unwrap_or(0.0)
    };
    (ticks(11) + ticks(12)) / 100.0
}

/// A scene by its name.
type Named = (&'static str, fn() -> Scene);

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let scenes: [Named; 3] = [
        ("indentation", indentation),
        ("line", line),
        ("paper", paper),
    ];
    println!("path,bodies,increments,passes,convolutions,largest strain,processor s,s");
    for (name, scene) in scenes {
        if !asked.is_empty() && !asked.iter().any(|asked| asked == name) {
            continue;
        }
        let scene = scene();
        for (bodies, scene) in [("yield", scene.clone()), ("elastic", scene.elastic())] {
            let (start, used) = (Instant::now(), processor());
            let stop = std::sync::Arc::default();
            let scene = choose_increments(&scene, &stop).expect("increments");
            let mut march = March::new(&scene).expect("a scene");
            let (mut increments, mut passes, mut convolutions, mut largest) = (0, 0, 0.0, 0.0_f64);
            while let Some(increment) = march.advance() {
                let increment = increment.expect("an increment");
                increments += 1;
                passes += increment.yielded.passes;
                convolutions += increment.work.convolutions;
                largest = largest.max(increment.yielded.largest);
            }
            println!(
                "{name},{bodies},{increments},{passes},{convolutions:.0},{largest:.4},{:.2},{:.2}",
                processor() - used,
                start.elapsed().as_secs_f64()
            );
        }
    }
}
