//! `fret check`.

use clap::Args;
use contact_core::Scene;
use contact_core::memory::available_memory;
use contact_core::plan::Plan;
use contact_core::scene::{Body, Bond, Elastic};
use serde_json::{Map, Value, json};

use crate::failure::Failure;
use crate::printed::print;
use crate::scene_options::{SceneOptions, say_doubts};
use crate::units::{mega, um};
use contact_core::digits::short;

/// Options of `fret check`.
#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
}

/// Prints the interpretation of the scene and the needs of its solution.
pub(crate) fn check(options: &Options) -> Result<(), Failure> {
    let scene = options.scene.read().map_err(Failure::BadInput)?;
    scene.check_fit().map_err(Failure::BadInput)?;
    let plan = Plan::new(&scene);
    let lines = description(&scene, &plan);
    if options.json {
        let mut object = Map::new();
        object.insert("title".into(), json!(scene.title));
        object.insert("a_H".into(), json!(scene.hertz().map(|h| h.a)));
        object.insert("p_H".into(), json!(scene.hertz().map(|h| h.p0)));
        for (subject, text) in &lines {
            let entry = object.entry(*subject).or_insert_with(|| json!([]));
            if let Value::Array(list) = entry {
                list.push(json!(text));
            }
        }
        object.insert("doubts".into(), json!(scene.doubts()));
        print(&format!("{:#}", Value::Object(object)))?;
    } else {
        let lines = lines
            .iter()
            .map(|(subject, text)| format!("{subject:<14}{text}"));
        let all: Vec<String> = std::iter::once(scene.title.clone()).chain(lines).collect();
        print(&all.join("\n"))?;
    }
    say_doubts(&scene);
    plan.check_memory(&scene).map_err(Failure::BadInput)
}

/// Subjects and their text.
fn description(scene: &Scene, plan: &Plan) -> Vec<(&'static str, String)> {
    let grid = &scene.grid;
    let (length_x, length_y) = grid.extent();
    let mut lines = Vec::new();
    let mut line = |subject: &'static str, text: String| lines.push((subject, text));
    line("body 1", body(&scene.body1, grid.dx.min(grid.dy)));
    line("body 2", body(&scene.body2, grid.dx.min(grid.dy)));
    match scene.hertz() {
        None => line(
            "a_H, p_H",
            "none: no Hertz contact of the uncoated bodies".into(),
        ),
        Some(hertz) => {
            let cells = (hertz.a / grid.dx, hertz.a / grid.dy);
            line("a_H", um(hertz.a));
            line("p_H", mega(hertz.p0, "Pa"));
            let along_x = format!("{:.2} along x", cells.0);
            let along_y = format!(", {:.2} along y", cells.1);
            line(
                "cells per a_H",
                along_x + if grid.plane_strain { "" } else { &along_y },
            );
            line(
                "contact",
                format!("about {:.0} cells across, uncoated", 2.0 * cells.0),
            );
        }
    }
    line(
        "grid",
        if grid.plane_strain {
            format!(
                "{} cells on {}, plane strain; forces and energies {}",
                grid.nx,
                um(length_x),
                match grid.unit_of("N") {
                    "N/m" => "per metre".to_owned(),
                    _ => format!("on a width of {}", um(length_y)),
                }
            )
        } else {
            let (nx, ny) = (grid.nx, grid.ny);
            format!("{nx} x {ny} cells on {} x {}", um(length_x), um(length_y))
        },
    );
    line(
        "load path",
        format!(
            "{} branches, {}, W up to {} {}",
            scene.path.branches.len(),
            increments(scene),
            short(scene.path.W_max()),
            grid.unit_of("N")
        ),
    );
    line("work", work(scene, plan));
    let (needed, available) = (plan.memory(scene), available_memory());
    line(
        "memory",
        format!("about {:.0} MB of {:.0} MB", needed / 1e6, available / 1e6),
    );
    for rule in &plan.lines {
        line("plan", rule.to_string());
    }
    lines
}

/// The materials of a body from the surface down, its layers in metres and in cells.
fn body(body: &Body, cell: f64) -> String {
    let material = |m: &Elastic| {
        if m.is_rigid() {
            "rigid".to_owned()
        } else {
            format!("E = {} GPa, nu = {}", short(m.E / 1e9), m.nu)
        }
    };
    let layers = body.coatings.iter().enumerate().map(|(n, c)| {
        let Bond { normal, shear } = body.bond(n);
        let bond = if (normal, shear) == (0.0, 0.0) {
            String::new()
        } else {
            format!("bonded by {normal:e} and {shear:e} m/Pa (normal, shear) ")
        };
        format!(
            "{} ({:.3} um = {:.2} cells) {bond}on ",
            material(&c.material),
            1e6 * c.thickness,
            c.thickness / cell
        )
    });
    layers.collect::<String>() + &material(&body.substrate)
}

/// The increments of the path, or the tolerance that they are chosen for.
fn increments(scene: &Scene) -> String {
    let given: usize = scene
        .path
        .branches
        .iter()
        .filter_map(|b| b.increments)
        .sum();
    if scene.path.is_open() {
        let tolerance = 100.0 * scene.settings.solver.path_tolerance;
        let others = if given > 0 {
            format!("{given} increments and as many")
        } else {
            "as many increments".to_owned()
        };
        format!("{others} as a path error of {tolerance} % of the shear asks for")
    } else {
        format!("{given} increments")
    }
}

/// Increments of a branch where they are chosen, at least and at most as a rule.
const CHOSEN: [usize; 2] = [12, 60];
/// Convolutions of an increment, at least and at most as a rule: where pressure and shear act on
/// one another, and where they do not.
const COUPLED: [usize; 2] = [8, 60];
const UNCOUPLED: [usize; 2] = [3, 12];

/// Time and memory of a solution, as a rule.
fn work(scene: &Scene, plan: &Plan) -> String {
    let branches = &scene.path.branches;
    let [least, most] = CHOSEN.map(|chosen| -> usize {
        let counts = branches.iter().map(|b| b.increments.unwrap_or(chosen));
        counts.sum()
    });
    let increments = if scene.path.is_open() {
        format!("some {least} to {most} increments")
    } else {
        format!("{least} increments")
    };
    let [few, many] = if plan.coupling { COUPLED } else { UNCOUPLED };
    let (nx, ny) = (scene.grid.nx, scene.grid.ny);
    format!(
        "{increments} of {few} to {many} convolutions each, {} to {} of {nx} x {ny} cells",
        least * few,
        most * many
    )
}
