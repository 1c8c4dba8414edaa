//! `fret check`.

use contact_core::Scene;
use contact_core::memory::available_memory;
use contact_core::plan::Plan;

use crate::{Failure, SceneOptions, print};

/// Says what the scene means and what its solution needs.
pub(crate) fn check(options: &SceneOptions) -> Result<(), Failure> {
    let scene = options.read().map_err(Failure::BadInput)?;
    let plan = Plan::new(&scene);
    print(&description(&scene, &plan));
    plan.check_memory(&scene).map_err(Failure::BadInput)
}

fn description(scene: &Scene, plan: &Plan) -> String {
    let grid = &scene.grid;
    let (length_x, length_y) = grid.extent();
    let mut lines = vec![scene.title.clone()];
    let mut line = |subject: &str, text: String| lines.push(format!("{subject:<14}{text}"));
    match scene.hertz() {
        None => line(
            "a_H, p_H",
            "none: no Hertz contact of the uncoated bodies".into(),
        ),
        Some(hertz) => {
            let cells = (hertz.a / grid.dx, hertz.a / grid.dy);
            line("a_H", format!("{:.6e} m", hertz.a));
            line("p_H", format!("{:.6e} Pa", hertz.p0));
            line(
                "cells per a_H",
                format!("{:.2} along x, {:.2} along y", cells.0, cells.1),
            );
        }
    }
    line(
        "grid",
        format!(
            "{} x {} cells on {length_x:.4e} m x {length_y:.4e} m",
            grid.nx, grid.ny
        ),
    );
    line(
        "load path",
        format!(
            "{} branches, {}, W up to {} N",
            scene.path.branches.len(),
            increments(scene),
            scene.path.W_max()
        ),
    );
    let (needed, available) = (plan.memory(scene), available_memory());
    line(
        "memory",
        format!("about {:.0} MB of {:.0} MB", needed / 1e6, available / 1e6),
    );
    for rule in &plan.lines {
        line("plan", rule.to_string());
    }
    lines.join("\n")
}

/// The increments of the path, or what they are chosen for.
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
