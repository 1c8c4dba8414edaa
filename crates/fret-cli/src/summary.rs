//! A branch of the load path in a line, a run in a table.

use std::time::Duration;

use contact_core::Scene;
use contact_core::digits::{short, with_error};
use contact_core::estimate::{Bar, ErrorBars};
use contact_core::march::{BranchSummary, Increment, Reached, summarise};
use contact_core::scene::{Branch, RigidMotion};
use contact_core::yielding::Rim;
use contact_subsurface::{Cycle, Direction};

use crate::json;
use crate::layout::{self, Page};
use crate::units::{mega, um};
use crate::words::{frictionless, state, word};

/// Micrometres, or microjoules, per SI unit.
const MICRO: f64 = 1e6;

/// Unit of length and pressure of a column: Hertz's for a Hertz contact.
struct Measures {
    radius: (&'static str, f64),
    pressure: (&'static str, f64),
}

impl Measures {
    /// The units of lengths and pressures: of the Hertz contact, or um and MPa without one.
    fn for_scene(scene: &Scene) -> Self {
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
    let Measures { radius, pressure } = Measures::for_scene(scene);
    let loads = branch.without_insignificant_values(scene).loads;
    let held = loads.given.motions();
    let force = scene.grid.unit_of("N");
    let others = SECONDARY_MOTIONS.iter().fold(String::new(), |text, of| {
        match (loads.forces()[of.index()], held[of.index()]) {
            // The moments that keep the bodies from turning are of little interest.
            (0.0, _) | (_, Some(0.0)) => text,
            (load, _) => {
                let unit = units(scene, *of).0;
                text + &format!(", {} = {} {unit}", of.load_name(), short(load))
            }
        }
    });
    format!(
        "branch {}/{}: t = {}, W = {} {force}, T_x = {} {force}{others}: {} {:.4} {}, \
         {}, p_max {:.4} {}",
        branch.branch + 1,
        scene.path.branches.len(),
        short(t),
        short(loads.W),
        short(loads.T_x),
        size_name(scene),
        branch.contact_radius / radius.1,
        radius.0,
        if frictionless(scene) {
            "no friction".to_owned()
        } else {
            stick_ratio_text(branch, "no contact", |ratio| {
                format!("stick ratio {ratio:.4}")
            })
        },
        branch.p_max / pressure.1,
        pressure.0,
    )
}

/// The stick ratio of a branch, or `missing` where the branch ends without contact.
fn stick_ratio_text(
    branch: &BranchSummary,
    missing: &str,
    format_ratio: impl Fn(f64) -> String,
) -> String {
    if branch.stick_ratio.is_nan() {
        missing.to_owned()
    } else {
        format_ratio(branch.stick_ratio)
    }
}

/// Motions that most paths leave at zero, and their loads.
const SECONDARY_MOTIONS: [RigidMotion; 4] = [
    RigidMotion::DeltaY,
    RigidMotion::PhiX,
    RigidMotion::PhiY,
    RigidMotion::PhiZ,
];

/// The units of a load and of its motion.
fn units(scene: &Scene, of: RigidMotion) -> (&'static str, &'static str) {
    let (load, motion) = if of.is_rotation() {
        ("N m", "urad")
    } else {
        ("N", "um")
    };
    (scene.grid.unit_of(load), motion)
}

/// Name of the size of the contact.
fn size_name(scene: &Scene) -> &'static str {
    if scene.grid.plane_strain {
        "half width"
    } else {
        "contact radius"
    }
}

/// Energies for people: microjoules, of line contacts millijoules per metre.
fn energy(scene: &Scene) -> (&'static str, f64) {
    match scene.grid.unit_of("J") {
        "J/m" => ("mJ/m", 1e3),
        _ => ("uJ", MICRO),
    }
}

/// The data of a row of the table: a branch, its last increment.
type Row<'a> = (&'a BranchSummary, &'a Increment);

/// Volumes for people: cubes of micrometres, in plane strain squares.
fn volume(scene: &Scene) -> (&'static str, f64) {
    if scene.grid.plane_strain {
        ("um^2", MICRO * MICRO)
    } else {
        ("um^3", MICRO * MICRO * MICRO)
    }
}

/// Columns of bodies that yield. If they never do, the distance from yielding stands below the
/// table.
fn yield_columns(scene: &Scene, increments: &[Increment]) -> Vec<Column> {
    let (joule, joules) = energy(scene);
    let (cube, per_cube) = volume(scene);
    let works: Vec<f64> = summarise(increments)
        .iter()
        .scan(0, |done, branch| {
            let increments_of_branch = &increments[*done..*done + branch.increments];
            *done += branch.increments;
            Some(json::plastic_work(increments_of_branch))
        })
        .collect();
    let first = increments.first().map_or(0, |i| i.point.branch);
    vec![
        column(format!("plastic\nwork [{joule}]"), move |b, _| {
            let work = works.get(b.branch - first).copied().unwrap_or_default();
            short(work * joules)
        }),
        column(format!("yielded\n[{cube}]"), move |_, last| {
            short(last.yielded.volume * per_cube)
        }),
        column("largest\nstrain [%]", |_, last| {
            short(100.0 * last.yielded.largest)
        }),
    ]
}

/// Note on a largest strain that does not converge.
fn strain_at_a_rim(increments: &[Increment]) -> Option<String> {
    let last = increments.last()?;
    (last.yielded.at_rim && last.yielded.largest > 0.0).then(|| Rim::TOLD.to_owned())
}

/// Note on the distance from yielding of bodies that may yield, if none has.
fn far_from_yield(scene: &Scene, increments: &[Increment]) -> Option<String> {
    let ratio = json::yield_ratio(increments);
    (scene.yields() && ratio < 1.0).then(|| {
        format!(
            "nothing yields: the largest stress of von Mises is {} of the yield stress (on the volume grid)",
            short(ratio)
        )
    })
}

/// A column of the table: title, and its cell for a branch.
type Column = (String, Box<dyn Fn(&Row<'_>) -> String>);

/// A column of a number of each branch.
fn column(
    title: impl Into<String>,
    cell: impl Fn(&BranchSummary, &Increment) -> String + 'static,
) -> Column {
    (
        title.into(),
        Box::new(move |(branch, last)| cell(branch, last)),
    )
}

/// The columns of a table of branches; `wide` adds those that are mostly left out.
fn columns(scene: &Scene, increments: &[Increment], wide: bool) -> Vec<Column> {
    let Measures { radius, pressure } = Measures::for_scene(scene);
    let bare = frictionless(scene);
    let micro = |x: f64| short(x * MICRO);
    let (force, (joule, joules)) = (scene.grid.unit_of("N"), energy(scene));
    let width = if scene.grid.plane_strain {
        "half\nwidth"
    } else {
        "radius"
    };
    let mut columns = vec![
        column("#", |b, _| (b.branch + 1).to_string()),
        column("t", |_, last| short(last.point.t)),
        column(format!("W\n[{force}]"), |b, _| short(b.loads.W)),
        column(format!("T_x\n[{force}]"), |b, _| short(b.loads.T_x)),
    ];
    for of in driven_motions(scene) {
        let title = format!("{}\n[{}]", of.load_name(), units(scene, of).0);
        let k = of.index();
        columns.push(column(title, move |b, _| short(b.loads.forces()[k])));
    }
    columns.extend([
        column(format!("{width}\n[{}]", radius.0), move |b, _| {
            short(b.contact_radius / radius.1)
        }),
        column("stick\nratio", move |b, _| {
            if bare {
                "-".into()
            } else {
                stick_ratio_text(b, "-", short)
            }
        }),
        column("state", move |_, last| state(bare, last.status).to_owned()),
        column(format!("p_max\n[{}]", pressure.0), move |b, _| {
            short(b.p_max / pressure.1)
        }),
        column("delta_z\n[um]", move |b, _| micro(b.motion.delta_z)),
        column("delta_x\n[um]", move |b, _| micro(b.motion.delta_x)),
    ]);
    for of in driven_motions(scene) {
        let title = format!("{}\n[{}]", of.name(), units(scene, of).1);
        let k = of.index();
        columns.push(column(title, move |b, _| micro(b.motion.motions()[k])));
    }
    columns.extend([
        column(format!("dissip.\n[{joule}]"), move |b, _| {
            short(b.dissipated * joules)
        }),
        column("incre-\nments", |b, _| b.increments.to_string()),
    ]);
    if scene.yields() && json::yield_ratio(increments) >= 1.0 {
        columns.extend(yield_columns(scene, increments));
    }
    let errors = Reached::from_increments(increments).shear_errors(scene);
    if errors.iter().any(Option::is_some) {
        columns.push(column("error of\nshear", move |b, _| {
            let error = errors.get(b.branch).copied().flatten();
            error.map_or_else(String::new, |error| format!("{:.2} %", 100.0 * error))
        }));
    }
    if wide {
        columns.extend(work_columns());
    }
    if increments.iter().any(|i| i.work.parts > 1) {
        columns.push(column("pieces", |b, _| b.work.parts.to_string()));
    }
    columns
}

/// Columns of the work of the solvers: convolutions, passes, iterations.
fn work_columns() -> [Column; 4] {
    [
        column("convo-\nlutions", |b, _| {
            format!("{:.0}", b.work.convolutions)
        }),
        column("passes\np, q", |b, _| b.work.alternations.to_string()),
        column("CG\np", |b, _| b.work.normal_iterations.to_string()),
        column("CG\nq", |b, _| b.work.tangential_iterations.to_string()),
    ]
}

/// The motions of [`SECONDARY_MOTIONS`] that the path drives.
fn driven_motions(scene: &Scene) -> impl Iterator<Item = RigidMotion> {
    SECONDARY_MOTIONS.into_iter().filter(|&of| {
        let drives = |b: &Branch| b.to.prescribed(of).value() != 0.0;
        scene.path.branches.iter().any(drives)
    })
}

/// Three lines for every cycle: state of the interface and energy, sliding ratio, stiffness.
fn cycle_lines(scene: &Scene, increments: &[Increment]) -> Vec<String> {
    let cycles = json::cycles(scene, increments);
    let (joule, joules) = energy(scene);
    let line = |(n, (direction, c)): (usize, &(Direction, Cycle))| {
        let stiffness = scene.grid.unit_of(if *direction == Direction::Torsion {
            "N m/rad"
        } else {
            "N/m"
        });
        format!(
            "cycle {} ({}): {}, {} {joule} dissipated, energy ratio {}\n  sliding ratio (slip/shift) {}\n  stiffness {}",
            n + 1,
            word(*direction),
            state(frictionless(scene), c.status),
            short(c.dissipated * joules),
            short(c.energy_ratio()),
            with_error(
                c.sliding_ratio(),
                Some(json::cycle_errors(scene, *direction, c, &[]).sliding_ratio),
            ),
            if c.stiffness.is_nan() {
                format!("not known: {}", Cycle::TOO_FEW)
            } else {
                format!(
                    "{} {stiffness}",
                    with_error(c.stiffness, Some(c.stiffness_error))
                )
            }
        )
    };
    cycles.iter().enumerate().map(line).collect()
}

/// Time of a run, and the part of its checkpoints.
pub(crate) fn describe_time(run: Duration, (count, spent): (usize, Duration)) -> String {
    let (run, spent) = (run.as_secs_f64(), spent.as_secs_f64());
    format!(
        "fret: {run:.2} s, of these {spent:.3} s ({:.1} %) for {count} checkpoints",
        100.0 * spent / run
    )
}

/// A number of a branch, its error and the unit.
type BranchNumber = Box<dyn Fn(&BranchSummary, &ErrorBars) -> (f64, Bar, f64)>;

/// A column of results besides the headline numbers.
struct ErrorColumn {
    title: String,
    number: BranchNumber,
}

/// Columns of the loads of given motions, and of the motions of loads that most paths leave out.
fn secondary_columns(scene: &Scene) -> Vec<ErrorColumn> {
    let ends = || scene.path.branches.iter().map(|branch| &branch.to);
    let is_given = |of: &RigidMotion| {
        ends().any(|to| to.given.motions()[of.index()].is_some_and(|motion| motion != 0.0))
    };
    let loads = RigidMotion::ALL
        .into_iter()
        .filter(is_given)
        .map(|of| ErrorColumn {
            title: format!("{}\n[{}]", of.load_name(), units(scene, of).0),
            number: Box::new(move |branch, bar| {
                (
                    branch.loads.forces()[of.index()],
                    bar.loads()[of.index()],
                    1.0,
                )
            }),
        });
    let is_loaded = |of: &RigidMotion| ends().any(|to| to.forces()[of.index()] != 0.0);
    let motions = SECONDARY_MOTIONS
        .into_iter()
        .filter(is_loaded)
        .map(|of| ErrorColumn {
            title: format!("{}\n[{}]", of.name(), units(scene, of).1),
            number: Box::new(move |branch, bar| {
                (
                    branch.motion.motions()[of.index()],
                    bar.motions()[of.index()],
                    MICRO,
                )
            }),
        });
    loads.chain(motions).collect()
}

/// The headline numbers at the end of every branch, with their errors and the sources of the
/// errors.
pub(crate) fn error_table(scene: &Scene, increments: &[Increment], bars: &[ErrorBars]) -> Page {
    let Measures { radius, pressure } = Measures::for_scene(scene);
    let answers = secondary_columns(scene);
    let (joule, joules) = energy(scene);
    let (cube, per_cube) = volume(scene);
    let yields = scene.yields() && json::yield_ratio(increments) >= 1.0;
    let of_yielding = [
        format!("plastic\nwork [{joule}]"),
        format!("yielded\n[{cube}]"),
        "largest\nstrain [%]".to_owned(),
    ];
    let of_yielding = of_yielding.into_iter().filter(|_| yields);
    let residual_column = yields.then(|| "residual\nstress [%]".to_owned());
    let mut titles = vec![
        "branch".to_owned(),
        format!("{}\n[{}]", size_name(scene).replace(' ', "\n"), radius.0),
        "stick\nratio".to_owned(),
        format!("p_max\n[{}]", pressure.0),
        "approach\ndelta_z\n[um]".to_owned(),
        "shift\ndelta_x\n[um]".to_owned(),
        format!("dissipated\n[{joule}]"),
    ];
    titles.extend(of_yielding);
    titles.extend(answers.iter().map(|answer| answer.title.clone()));
    titles.extend(["p, field\n[%]".to_owned(), "q, field\n[%]".to_owned()]);
    titles.extend(residual_column);
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (of, bar) in summarise(increments).iter().zip(bars) {
        let mut numbers = vec![
            (of.contact_radius, bar.contact_radius, 1.0 / radius.1),
            (of.stick_ratio, bar.stick_ratio, 1.0),
            (of.p_max, bar.p_max, 1.0 / pressure.1),
            (of.motion.delta_z, bar.delta_z, MICRO),
            (of.motion.delta_x, bar.delta_x, MICRO),
            (of.dissipated, bar.dissipated, joules),
        ];
        if yields {
            numbers.extend([
                (of.plastic_work, bar.plastic_work, joules),
                (of.plastic_volume, bar.plastic_volume, per_cube),
                (of.largest_plastic_strain, bar.largest_plastic_strain, 100.0),
            ]);
        }
        numbers.extend(answers.iter().map(|answer| (answer.number)(of, bar)));
        let mut fields = vec![bar.p, bar.q];
        fields.extend(yields.then_some(bar.residual_stress));
        let number = |&(value, bar, unit): &(f64, Bar, f64)| {
            with_error(value * unit, Some(bar.total * unit))
        };
        let field = |bar: &Bar| format!("+- {:.2}", 100.0 * bar.total);
        let mut row = vec![(of.branch + 1).to_string()];
        row.extend(numbers.iter().map(number));
        row.extend(fields.iter().map(field));
        rows.push(row);
        for (name, part) in
            [("cells", |b: Bar| b.cells), ("path", |b: Bar| b.path)] as [(&str, fn(Bar) -> f64); 2]
        {
            let numbers = numbers
                .iter()
                .map(|&(_, b, unit)| format!("{:.1e}", part(b) * unit));
            let fields = fields.iter().map(|&b| format!("{:.2}", 100.0 * part(b)));
            let mut row = vec![name.to_owned()];
            row.extend(numbers);
            row.extend(fields);
            rows.push(row);
        }
    }
    let mut page = Page::new();
    for (n, (direction, c)) in json::cycles(scene, increments).iter().enumerate() {
        let errors = json::cycle_errors(scene, *direction, c, bars);
        page.text(&format!(
            "cycle {} ({}): {} {joule} dissipated, energy ratio {}, sliding ratio (slip/shift) {}",
            n + 1,
            word(*direction),
            with_error(c.dissipated * joules, Some(errors.dissipated * joules)),
            with_error(c.energy_ratio(), Some(errors.energy_ratio)),
            with_error(c.sliding_ratio(), Some(errors.sliding_ratio)),
        ));
    }
    page.head("errors, and the parts of them that cells and increments leave");
    let columns: Vec<layout::Column> = titles
        .into_iter()
        .enumerate()
        .map(|(n, title)| layout::Column {
            title,
            cells: rows.iter().map(|row| row[n].clone()).collect(),
        })
        .collect();
    page.table(&columns, 1);
    page
}

/// The end of the path in SI units.
fn end_line(scene: &Scene, increments: &[Increment]) -> Option<String> {
    let (branch, last) = (summarise(increments).pop()?, increments.last()?);
    let bare = frictionless(scene);
    let stick = if bare {
        String::new()
    } else {
        format!(", stick ratio {}", short(branch.stick_ratio))
    };
    Some(format!(
        "at the end: {}{stick}, {} {}, p_max {}",
        state(bare, last.status),
        size_name(scene),
        um(branch.contact_radius),
        mega(branch.p_max, "Pa"),
    ))
}

/// The end of the path, one line per cycle, and one row per branch that has begun.
pub(crate) fn table(scene: &Scene, increments: &[Increment], wide: bool) -> Page {
    let mut page = Page::new();
    if let Some(line) = end_line(scene, increments) {
        page.head(&line);
    }
    let notes = far_from_yield(scene, increments)
        .into_iter()
        .chain(strain_at_a_rim(increments));
    for line in cycle_lines(scene, increments).into_iter().chain(notes) {
        page.text(&line);
    }
    let mut done = 0;
    let mut rows = Vec::new();
    for branch in summarise(increments) {
        done += branch.increments;
        let branch = branch.without_insignificant_values(scene);
        rows.push((branch, &increments[done - 1]));
    }
    let columns: Vec<layout::Column> = columns(scene, increments, wide)
        .into_iter()
        .map(|(title, cell)| layout::Column {
            title,
            cells: rows
                .iter()
                .map(|(branch, last)| cell(&(branch, last)))
                .collect(),
        })
        .collect();
    page.table(&columns, 1);
    page
}
