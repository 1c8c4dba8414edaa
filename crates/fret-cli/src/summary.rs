//! A branch of the load path in a line, a run in a table.

use std::time::Duration;

use comfy_table::{CellAlignment, Table, presets};
use contact_core::Scene;
use contact_core::estimate::{Bar, ErrorBars};
use contact_core::march::{BranchSummary, Increment, summarise};
use contact_core::scene::{Branch, RigidMotion};

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
    let held = loads.given.motions();
    let others = OTHERS.iter().fold(String::new(), |text, of| {
        match (loads.forces()[of.index()], held[of.index()]) {
            // What keeps the bodies from turning says little.
            (0.0, _) | (_, Some(0.0)) => text,
            (load, _) => text + &format!(", {} = {load} {}", of.load(), units(*of).0),
        }
    });
    format!(
        "branch {}/{}: t = {t}, W = {} N, T_x = {} N{others}: contact radius {:.4} {}, \
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

/// Motions that most paths leave at zero, and their loads.
const OTHERS: [RigidMotion; 4] = [
    RigidMotion::DeltaY,
    RigidMotion::PhiX,
    RigidMotion::PhiY,
    RigidMotion::PhiZ,
];

/// The units of a load and of its motion.
fn units(of: RigidMotion) -> (&'static str, &'static str) {
    if of.is_rotation() {
        ("N m", "urad")
    } else {
        ("N", "um")
    }
}

/// A column of the table: title, and its cell for a branch that ended at path time t.
type Column = (String, Box<dyn Fn(&BranchSummary, f64) -> String>);

fn column(
    title: impl Into<String>,
    cell: impl Fn(&BranchSummary, f64) -> String + 'static,
) -> Column {
    (title.into(), Box::new(cell))
}

fn columns(scene: &Scene, increments: &[Increment]) -> Vec<Column> {
    let Measures { radius, pressure } = Measures::of(scene);
    let micro = |x: f64| format!("{:.4}", x * MICRO);
    let mut columns = vec![
        column("branch", |b, _| (b.branch + 1).to_string()),
        column("t", |_, t| t.to_string()),
        column("W\n[N]", |b, _| format!("{:.1}", b.loads.W)),
        column("T_x\n[N]", |b, _| format!("{:.1}", b.loads.T_x)),
        column(format!("contact\nradius\n[{}]", radius.0), move |b, _| {
            format!("{:.4}", b.contact_radius / radius.1)
        }),
        column("stick\nratio", |b, _| format!("{:.4}", b.stick_ratio)),
        column(format!("p_max\n\n[{}]", pressure.0), move |b, _| {
            format!("{:.4}", b.p_max / pressure.1)
        }),
        column("approach\ndelta_z\n[um]", move |b, _| {
            micro(b.motion.delta_z)
        }),
        column("shift\ndelta_x\n[um]", move |b, _| micro(b.motion.delta_x)),
    ];
    for of in OTHERS {
        let (k, (unit, motion_unit)) = (of.index(), units(of));
        let drives = |b: &Branch| b.to.prescribed(of).value() != 0.0;
        if !scene.path.branches.iter().any(drives) {
            continue;
        }
        let title = format!("{}\n[{unit}]", of.load());
        columns.insert(
            4,
            column(title, move |b, _| format!("{:.4}", b.loads.forces()[k])),
        );
        let title = format!("{}\n[{motion_unit}]", of.name());
        columns.push(column(title, move |b, _| micro(b.motion.motions()[k])));
    }
    columns.extend([
        column("dissipated\n\n[uJ]", |b, _| {
            format!("{:.3}", b.dissipated * MICRO)
        }),
        column("incre-\nments", |b, _| b.increments.to_string()),
        column("convo-\nlutions", |b, _| {
            format!("{:.0}", b.work.convolutions)
        }),
        column("passes\np, q", |b, _| b.work.alternations.to_string()),
        column("CG\np", |b, _| b.work.normal_iterations.to_string()),
        column("CG\nq", |b, _| b.work.tangential_iterations.to_string()),
    ]);
    let errors: Vec<Option<f64>> = scene.path.branches.iter().map(|b| b.path_error).collect();
    if errors.iter().any(Option::is_some) {
        columns.push(column("path\nerror\nof q", move |b, _| {
            let error = errors.get(b.branch).copied().flatten();
            error.map_or_else(String::new, |error| format!("{:.2} %", 100.0 * error))
        }));
    }
    if increments.iter().any(|i| i.work.parts > 1) {
        columns.push(column("pieces", |b, _| b.work.parts.to_string()));
    }
    columns
}

/// How long a run took, and what of that went to its checkpoints.
pub(crate) fn time(run: Duration, (count, spent): (usize, Duration)) -> String {
    let (run, spent) = (run.as_secs_f64(), spent.as_secs_f64());
    format!(
        "fret: {run:.2} s, of these {spent:.3} s ({:.1} %) for {count} checkpoints",
        100.0 * spent / run
    )
}

/// A number and its error, with as many decimals as the error has a say in.
fn with_error(value: f64, error: f64) -> String {
    let decimals = if error > 0.0 {
        (1.0 - error.log10().floor()).clamp(0.0, 9.0) as usize
    } else {
        6
    };
    format!("{value:.decimals$} +- {error:.decimals$}")
}

/// The headline numbers at the end of every branch with their errors, and what leaves them.
pub(crate) fn error_table(scene: &Scene, increments: &[Increment], bars: &[ErrorBars]) -> String {
    let Measures { radius, pressure } = Measures::of(scene);
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_BORDERS_ONLY_CONDENSED)
        .set_header([
            "branch".to_owned(),
            format!("contact radius\n[{}]", radius.0),
            "stick ratio".to_owned(),
            format!("p_max\n[{}]", pressure.0),
            "approach delta_z\n[um]".to_owned(),
            "shift delta_x\n[um]".to_owned(),
            "dissipated\n[uJ]".to_owned(),
            "p, field\n[%]".to_owned(),
            "q, field\n[%]".to_owned(),
        ]);
    for (of, bar) in summarise(increments).iter().zip(bars) {
        let numbers = [
            (of.contact_radius, bar.contact_radius, 1.0 / radius.1),
            (of.stick_ratio, bar.stick_ratio, 1.0),
            (of.p_max, bar.p_max, 1.0 / pressure.1),
            (of.motion.delta_z, bar.delta_z, MICRO),
            (of.motion.delta_x, bar.delta_x, MICRO),
            (of.dissipated, bar.dissipated, MICRO),
        ];
        let fields = [bar.p, bar.q];
        let number =
            |&(value, bar, unit): &(f64, Bar, f64)| with_error(value * unit, bar.total * unit);
        let field = |bar: &Bar| format!("+- {:.2}", 100.0 * bar.total);
        let branch = (of.branch + 1).to_string();
        table.add_row(
            std::iter::once(branch)
                .chain(numbers.iter().map(number))
                .chain(fields.iter().map(field)),
        );
        for (name, part) in
            [("cells", |b: Bar| b.cells), ("path", |b: Bar| b.path)] as [(&str, fn(Bar) -> f64); 2]
        {
            let numbers = numbers
                .iter()
                .map(|&(_, b, unit)| format!("{:.1e}", part(b) * unit));
            let fields = fields.iter().map(|&b| format!("{:.2}", 100.0 * part(b)));
            table.add_row(
                std::iter::once(name.to_owned())
                    .chain(numbers)
                    .chain(fields),
            );
        }
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!("errors, and the parts of them that cells and increments leave\n{table}")
}

/// One row per branch that has begun.
pub(crate) fn table(scene: &Scene, increments: &[Increment]) -> String {
    let columns = columns(scene, increments);
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_BORDERS_ONLY_CONDENSED)
        .set_header(columns.iter().map(|(title, _)| title));
    let mut done = 0;
    for branch in summarise(increments) {
        done += branch.increments;
        let t = increments[done - 1].point.t;
        table.add_row(columns.iter().map(|(_, cell)| cell(&branch, t)));
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}
