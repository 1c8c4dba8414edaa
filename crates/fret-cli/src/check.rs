//! `fret check`.

use std::sync::Arc;

use clap::Args;
use contact_core::estimate::first_yield;
use contact_core::memory::available_memory;
use contact_core::plan::Plan;
use contact_core::scene::{Body, Bond, Elastic};
use contact_core::{Error, Scene};
use contact_wear::{Cycling, Wear};
use serde_json::{Map, Value, json};

use crate::answer_memory::AnswerMemory;
use crate::failure::Failure;
use crate::json::{NO_HERTZ, or_missing, pretty};
use crate::layout::Page;
use crate::printed::print;
use crate::scene_options::{SceneOptions, warn_of_doubts};
use crate::units::{mega, um};
use contact_core::digits::short;

/// Options of `fret check`.
#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// Print one JSON object, for programs: numbers in SI units, and the lines of the text
    #[arg(long)]
    json: bool,
    /// Exit with 1 where something is doubtful
    #[arg(long)]
    strict: bool,
}

/// Prints how the scene is understood and what its solution needs: the command `fret check`.
pub(crate) fn check(options: &Options) -> Result<(), Failure> {
    let read = options.scene.read_whole();
    let read = read.and_then(|(scene, wear)| scene.check_fit().map(|()| (scene, wear)));
    if let (Err(error), true) = (&read, options.json) {
        print(&pretty(errors_to_json(error)))?;
    }
    let (scene, wear) = read.map_err(Failure::BadInput)?;
    let mut doubts = scene.doubts();
    let sliding = wear.as_ref().filter(|of| of.cycling == Cycling::Sliding);
    // The places of a stroke replace open numbers of increments.
    let settled = sliding.and_then(|wear| wear.complete(&scene, &Arc::default()).ok());
    let scene = settled.map_or(scene, |(settled, _)| settled);
    let plan = Plan::new(&scene);
    let work = Work::estimate(&scene, plan.coupling && sliding.is_none());
    let mut lines = description(&scene, &plan, &work);
    lines.extend(wear.as_ref().map(|wear| ("wear", describe_wear(wear))));
    doubts.extend(wear.iter().flat_map(Wear::doubts));
    if options.json {
        print(&pretty(numbers(&scene, &plan, &work, &lines, &doubts)))?;
    } else {
        let mut page = Page::new();
        page.head(&scene.title);
        for (subject, text) in &lines {
            page.description(subject, text);
        }
        page.print()?;
    }
    warn_of_doubts(&doubts);
    plan.check_memory(&scene).map_err(Failure::BadInput)?;
    match doubts.len() {
        0 => Ok(()),
        _ if !options.strict => Ok(()),
        doubts => Err(Failure::Doubted(doubts)),
    }
}

/// The errors of an invalid scene and its doubts, as JSON.
fn errors_to_json(error: &Error) -> Value {
    let (errors, doubts) = match error {
        Error::SceneFaults { errors, doubts } => (&errors[..], &doubts[..]),
        error => (std::slice::from_ref(error), &[][..]),
    };
    let objects = errors.iter().map(|error| match error {
        Error::SceneFile {
            file,
            line,
            message,
        } => json!({ "file": file, "line": line, "message": message }),
        Error::Setting { setting, message } => json!({ "setting": setting, "message": message }),
        other => json!({ "message": other.to_string() }),
    });
    json!({ "errors": objects.collect::<Vec<_>>(), "doubts": doubts })
}

/// The numbers of a scene in SI units as JSON, with the printed `lines`.
fn numbers(
    scene: &Scene,
    plan: &Plan,
    work: &Work,
    lines: &[(&'static str, String)],
    doubts: &[String],
) -> Value {
    let (grid, hertz) = (&scene.grid, scene.hertz());
    let (length_x, length_y) = grid.extent();
    let mut text = Map::new();
    for (subject, line) in lines {
        let entry = text.entry(*subject).or_insert_with(|| json!([]));
        if let Value::Array(list) = entry {
            list.push(json!(line));
        }
    }
    json!({
        "title": scene.title,
        "errors": [],
        "doubts": doubts,
        "units": {
            "a_H": "m",
            "p_H": "Pa",
            "cells_per_a_H": "1",
            "grid.n": "1",
            "grid.extent": "m",
            "grid.spacing": "m",
            "path.branches": "1",
            "path.increments": "1",
            "path.W_max": grid.unit_of("N"),
            "convolutions": "1",
            "memory.needed": "bytes",
            "memory.available": "bytes",
            "memory.answers.cycle": "bytes",
            "memory.answers.sections": "bytes",
            "memory.answers.kernels": "bytes",
        },
        "a_H": or_missing(json!(hertz.map(|h| h.a)), NO_HERTZ),
        "p_H": or_missing(json!(hertz.map(|h| h.p0)), NO_HERTZ),
        "cells_per_a_H": or_missing(json!(hertz.map(|h| [h.a / grid.dx, h.a / grid.dy])), NO_HERTZ),
        "grid": {
            "n": [grid.nx, grid.ny],
            "extent": [length_x, length_y],
            "spacing": [grid.dx, grid.dy],
            "plane_strain": grid.plane_strain,
        },
        "path": {
            "branches": scene.path.branches.len(),
            "increments": work.increments,
            "W_max": scene.path.W_max(),
        },
        "convolutions": work.convolutions,
        "memory": {
            "needed": plan.memory(scene),
            "available": available_memory(),
            "answers": or_missing(
                json!(AnswerMemory::estimate(scene, work.increments[1]).as_ref().map(AnswerMemory::to_json)),
                NO_HERTZ,
            ),
        },
        "text": text,
    })
}

/// The printed text: pairs of a subject and a text on it.
fn description(scene: &Scene, plan: &Plan, work: &Work) -> Vec<(&'static str, String)> {
    let grid = &scene.grid;
    let (length_x, length_y) = grid.extent();
    let mut lines = Vec::new();
    let mut line = |subject: &'static str, text: String| lines.push((subject, text));
    line("body 1", describe_body(&scene.body1, grid.dx.min(grid.dy)));
    line("body 2", describe_body(&scene.body2, grid.dx.min(grid.dy)));
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
            describe_increments(scene),
            short(scene.path.W_max()),
            grid.unit_of("N")
        ),
    );
    if let Some(text) = describe_yielding(scene) {
        line("yielding", text);
    }
    line("work", work.describe(scene));
    let (needed, available) = (plan.memory(scene), available_memory());
    line(
        "memory",
        format!("about {:.0} MB of {:.0} MB", needed / 1e6, available / 1e6),
    );
    for text in AnswerMemory::estimate(scene, work.increments[1])
        .iter()
        .flat_map(AnswerMemory::describe)
    {
        line("answers", text);
    }
    for rule in &plan.lines {
        line("plan", rule.to_string());
    }
    lines
}

/// Describes the wear: the bodies and the number of cycles.
fn describe_wear(wear: &Wear) -> String {
    let bodies = wear.bodies.iter().enumerate();
    let worn: Vec<_> = bodies
        .filter(|(_, body)| !body.laws.is_empty())
        .map(|(n, _)| format!("body {}", n + 1))
        .collect();
    let how = match wear.cycling {
        Cycling::Auto => ", in sliding or a march by the stroke beside the contact",
        Cycling::March => "",
        Cycling::Sliding => ", in sliding: the mean pressure of every increment",
    };
    format!(
        "{} over {} cycles{how}",
        worn.join(" and "),
        short(wear.cycles)
    )
}

/// Load at which yielding begins; `None` if no body may yield.
fn describe_yielding(scene: &Scene) -> Option<String> {
    if !scene.yields() {
        return None;
    }
    let description = match first_yield(scene) {
        Ok(description) => description?,
        Err(error) => {
            return Some(format!(
                "the load at which it begins was not found: {error}"
            ));
        }
    };
    let body = [&scene.body1, &scene.body2][description.body - 1];
    let layer = body.layer_name(description.layer);
    Some(format!(
        "begins at about W = {:.3} {} without friction, in body {}, {layer}, {} deep",
        description.W,
        scene.grid.unit_of("N"),
        description.body,
        um(description.depth),
    ))
}

/// The materials of a body from the surface down, its layers in metres and in cells.
fn describe_body(body: &Body, cell: f64) -> String {
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

/// The increments of the path, or the tolerance of the path error.
fn describe_increments(scene: &Scene) -> String {
    let fixed: usize = scene
        .path
        .branches
        .iter()
        .filter_map(|b| b.increments)
        .sum();
    if scene.path.has_open_increments() {
        let tolerance = 100.0 * scene.settings.solver.path_tolerance;
        let chosen = if fixed > 0 {
            format!("{fixed} increments and as many")
        } else {
            "as many increments".to_owned()
        };
        format!("{chosen} as a path error of {tolerance} % of the shear asks for")
    } else {
        format!("{fixed} increments")
    }
}

/// Increments of a branch that are chosen, usual minimum and maximum.
const CHOSEN_INCREMENTS: [usize; 2] = [12, 60];
/// Convolutions of an increment, usual minimum and maximum: for coupled pressure and shear, and for
/// uncoupled ones.
const COUPLED: [usize; 2] = [8, 60];
const UNCOUPLED: [usize; 2] = [3, 12];

/// Work of a solution: usual minimum and maximum.
struct Work {
    increments: [usize; 2],
    /// Convolutions of an increment.
    per_increment: [usize; 2],
    convolutions: [usize; 2],
}

impl Work {
    /// Estimates the work of a run. With `coupling`, pressure and shear are solved in turn.
    fn estimate(scene: &Scene, coupling: bool) -> Self {
        let branches = &scene.path.branches;
        let increments = CHOSEN_INCREMENTS.map(|chosen| {
            let counts = branches.iter().map(|b| b.increments.unwrap_or(chosen));
            counts.sum()
        });
        let per_increment @ [few, many] = if coupling { COUPLED } else { UNCOUPLED };
        Self {
            increments,
            per_increment,
            convolutions: [increments[0] * few, increments[1] * many],
        }
    }

    /// The estimated work as a sentence.
    fn describe(&self, scene: &Scene) -> String {
        let ([least_increments, most_increments], [few, many]) =
            (self.increments, self.per_increment);
        let increments = if scene.path.has_open_increments() {
            format!("some {least_increments} to {most_increments} increments")
        } else {
            format!("{least_increments} increments")
        };
        let [fewest, most_convolutions] = self.convolutions;
        let (nx, ny) = (scene.grid.nx, scene.grid.ny);
        format!(
            "{increments} of {few} to {many} convolutions each, {fewest} to {most_convolutions} of {nx} x {ny} cells"
        )
    }
}
