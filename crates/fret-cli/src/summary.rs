//! A branch of the load path in a line, a run in a table.

use comfy_table::{CellAlignment, Table, presets};
use contact_core::Scene;
use contact_core::march::{BranchSummary, Increment, summarise};

/// Micrometres, or microjoules, per SI unit.
const MICRO: f64 = 1e6;

/// Unit of length and pressure of a column: Hertz's where there is a Hertz contact.
struct Measures {
    radius: (&'static str, f64),
    pressure: (&'static str, f64),
}

impl Measures {
    fn of(scene: &Scene) -> Self {
        scene.hertz().map_or(
            Self {
                radius: ("um", 1.0 / MICRO),
                pressure: ("MPa", 1e6),
            },
            |hertz| Self {
                radius: ("a_H", hertz.a),
                pressure: ("p_H", hertz.p0),
            },
        )
    }
}

/// One line for a branch that has ended at path time `t`.
pub(crate) fn line(scene: &Scene, branch: &BranchSummary, t: f64) -> String {
    let Measures { radius, pressure } = Measures::of(scene);
    let loads = branch.loads;
    let T_y = if loads.T_y == 0.0 {
        String::new()
    } else {
        format!(", T_y = {} N", loads.T_y)
    };
    format!(
        "branch {}/{}: t = {t}, W = {} N, T_x = {} N{T_y}: contact radius {:.4} {}, \
         stick ratio {:.4}, p_max {:.4} {}",
        branch.branch + 1,
        scene.path.branches.len(),
        loads.W,
        loads.T_x,
        branch.contact_radius / radius.1,
        radius.0,
        branch.stick_ratio,
        branch.p_max / pressure.1,
        pressure.0,
    )
}

/// One row per branch that has begun.
pub(crate) fn table(scene: &Scene, increments: &[Increment]) -> String {
    let Measures { radius, pressure } = Measures::of(scene);
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_BORDERS_ONLY_CONDENSED)
        .set_header([
            "branch".to_owned(),
            "t".to_owned(),
            "W\n[N]".to_owned(),
            "T_x\n[N]".to_owned(),
            "T_y\n[N]".to_owned(),
            format!("contact\nradius\n[{}]", radius.0),
            "stick\nratio".to_owned(),
            format!("p_max\n[{}]", pressure.0),
            "delta_z\n[um]".to_owned(),
            "delta_x\n[um]".to_owned(),
            "delta_y\n[um]".to_owned(),
            "dissipated\n[uJ]".to_owned(),
            "incre-\nments".to_owned(),
            "convo-\nlutions".to_owned(),
            "alter-\nnations".to_owned(),
            "CG\nnormal".to_owned(),
            "CG\ntangential".to_owned(),
        ]);
    let mut done = 0;
    for branch in summarise(increments) {
        done += branch.increments;
        let t = increments[done - 1].point.t;
        let BranchSummary {
            loads,
            motion,
            work,
            ..
        } = branch;
        table.add_row([
            (branch.branch + 1).to_string(),
            format!("{t:.4}"),
            format!("{:.2}", loads.W),
            format!("{:.2}", loads.T_x),
            format!("{:.2}", loads.T_y),
            format!("{:.4}", branch.contact_radius / radius.1),
            format!("{:.4}", branch.stick_ratio),
            format!("{:.4}", branch.p_max / pressure.1),
            format!("{:.4}", motion.delta_z * MICRO),
            format!("{:.4}", motion.delta_x * MICRO),
            format!("{:.4}", motion.delta_y * MICRO),
            format!("{:.3}", branch.dissipated * MICRO),
            branch.increments.to_string(),
            format!("{:.0}", work.convolutions),
            work.alternations.to_string(),
            work.normal_iterations.to_string(),
            work.tangential_iterations.to_string(),
        ]);
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}
