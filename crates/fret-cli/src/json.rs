//! Output of the commands for programs: SI units, names of the store.

use contact_core::estimate::ErrorBars;
use contact_core::march::{BranchSummary, Increment, Reached, Yield, summarise};
use contact_core::scene::{RigidMotion, Scene};
use contact_subsurface::{Cycle, CycleErrors, Direction, LoopPoint, loops};
use serde_json::{Map, Value, json};

use crate::words::{frictionless, state, word};

/// First character of a text that replaces a missing number until it is written.
const MARK: char = '\u{0}';
/// Reason for a missing number without a stated reason: a result that is not finite.
const UNKNOWN: &str = "not known";

/// A number for [`pretty`] and [`line`]; for inf and NaN the reason is kept, which they print beside null.
pub(crate) fn number(x: f64) -> Value {
    match x {
        x if x.is_finite() => json!(x),
        f64::INFINITY => missing("infinite"),
        f64::NEG_INFINITY => missing("infinite, negative"),
        _ => missing(UNKNOWN),
    }
}

/// A missing number with its reason.
pub(crate) fn missing(why: &str) -> Value {
    json!(format!("{MARK}{why}"))
}

/// A value, or the reason why there is none.
pub(crate) fn or_missing(value: Value, why: &str) -> Value {
    if value.is_null() { missing(why) } else { value }
}

/// Output for programs over several lines.
pub(crate) fn pretty(value: Value) -> String {
    format!("{:#}", replace_missing(value))
}

/// Output for programs in one line.
pub(crate) fn line(value: Value) -> String {
    replace_missing(value).to_string()
}

/// Replaces missing numbers by null, with the reason beside them as `NAME_why`. In a list the
/// reasons stand in a list.
fn replace_missing(value: Value) -> Value {
    match value {
        Value::Object(entries) => {
            let mut replaced = Map::new();
            for (name, value) in entries {
                let why = reason_if_missing(&value);
                replaced.insert(name.clone(), replace_missing(value));
                if let Some(why) = why {
                    replaced.insert(format!("{name}_why"), why);
                }
            }
            Value::Object(replaced)
        }
        Value::Array(entries) => Value::Array(entries.into_iter().map(replace_missing).collect()),
        value if reason_if_missing(&value).is_some() => Value::Null,
        value => value,
    }
}

/// Reason why a number, or a number of a list, is missing.
fn reason_if_missing(value: &Value) -> Option<Value> {
    match value {
        Value::Null => Some(json!(UNKNOWN)),
        Value::String(text) => text.strip_prefix(MARK).map(|why| json!(why)),
        Value::Array(values) => {
            let reasons: Vec<_> = values.iter().map(reason_if_missing).collect();
            reasons.iter().any(Option::is_some).then(|| json!(reasons))
        }
        _ => None,
    }
}

/// Reason why a contact has neither a_H nor p_H.
pub(crate) const NO_HERTZ: &str = "no contact of Hertz";

/// A run: its branches and its cycles, and the error bars of the branches, if any.
pub(crate) fn run_to_json(
    scene: &Scene,
    increments: &[Increment],
    bars: Option<&[ErrorBars]>,
) -> Value {
    let mut done = 0;
    let reached = Reached::from_increments(increments);
    let errors = reached.shear_errors(scene);
    let branches = summarise(increments);
    let branches: Vec<Value> = branches
        .iter()
        .map(|b| {
            let increments_of_branch = &increments[done..done + b.increments];
            done += b.increments;
            branch_to_json(scene, b, increments_of_branch, errors[b.branch])
        })
        .collect();
    let cycles: Vec<Value> = cycles(scene, increments)
        .iter()
        .map(|(direction, c)| cycle_to_json(scene, *direction, c, bars))
        .collect();
    let hertz = scene.hertz();
    json!({
        "title": scene.title,
        "mu": number(scene.friction.mu),
        "a_H": or_missing(json!(hertz.map(|h| h.a)), NO_HERTZ),
        "p_H": or_missing(json!(hertz.map(|h| h.p0)), NO_HERTZ),
        "increments": increments.len(),
        "units": units(scene),
        "branches": branches,
        "cycles": cycles,
        "error_bars": or_missing(json!(bars), "the run has none: `fret run --error` estimates them"),
        "doubts": reached.all_doubts(scene),
    })
}

/// Units of forces, moments, energies and stiffnesses: of a line contact they are per metre.
fn units(scene: &Scene) -> Value {
    let unit_of = |unit| scene.grid.unit_of(unit);
    json!({
        "force": unit_of("N"),
        "moment": unit_of("N m"),
        "energy": unit_of("J"),
        "stiffness": unit_of("N/m"),
        "torsional_stiffness": unit_of("N m/rad"),
    })
}

/// The variable of the store that is the size of the contact.
fn size_variable(scene: &Scene) -> &'static str {
    if scene.grid.plane_strain {
        "half_width"
    } else {
        "contact_radius"
    }
}

/// The numbers at the end of a branch, with the `error` of its shear.
fn branch_to_json(
    scene: &Scene,
    b: &BranchSummary,
    increments: &[Increment],
    error: Option<f64>,
) -> Value {
    let mut object = Map::new();
    let last = &increments[increments.len() - 1];
    let mut set = |key: &str, value: Value| object.insert(key.to_owned(), value);
    set("branch", json!(b.branch));
    set("t", json!(last.point.t));
    let (loads, motions) = (b.loads.forces(), b.motion.motions());
    for motion in RigidMotion::ALL {
        set(motion.load_name(), json!(loads[motion.index()]));
        set(motion.name(), json!(motions[motion.index()]));
    }
    set(size_variable(scene), json!(b.contact_radius));
    let sticks = (!frictionless(scene)).then_some(b.stick_ratio);
    let why = sticks.map_or("no friction", |_| "no contact");
    set("stick_ratio", or_missing(json!(sticks), why));
    set(
        "status",
        json!(state(frictionless(scene), last.status).replace(' ', "_")),
    );
    set("p_max", json!(b.p_max));
    set("dissipated", json!(b.dissipated));
    if scene.yields() {
        let Yield {
            volume, largest, ..
        } = last.yielded;
        set("plastic_work", json!(plastic_work(increments)));
        set("plastic_volume", json!(volume));
        set("largest_plastic_strain", json!(largest));
        set("yield_ratio", json!(yield_ratio(increments)));
    }
    set("increments", json!(b.increments));
    set("convolutions", json!(b.work.convolutions));
    set(
        "path_error",
        or_missing(json!(error), "the increments of the branch were given"),
    );
    Value::Object(object)
}

/// The numbers of the loop of a cycle, with their errors if the branches have error bars.
fn cycle_to_json(
    scene: &Scene,
    direction: Direction,
    c: &Cycle,
    bars: Option<&[ErrorBars]>,
) -> Value {
    let errors = cycle_errors(scene, direction, c, bars.unwrap_or_default());
    json!({
        "direction": word(direction),
        "first_branch": c.branches.0,
        "last_branch": c.branches.1,
        "status": state(frictionless(scene), c.status).replace(' ', "_"),
        "dissipated": c.dissipated,
        "dissipated_error": number(errors.dissipated),
        "T": c.T,
        "delta": c.delta,
        "stiffness": number(c.stiffness),
        "stiffness_error": number(c.stiffness_error),
        "opening": number(c.checked_opening()),
        "opening_error": number(errors.opening),
        "energy_ratio": number(c.energy_ratio()),
        "energy_ratio_error": number(errors.energy_ratio),
        "sliding_ratio": number(c.sliding_ratio()),
        "sliding_ratio_error": number(errors.sliding_ratio),
    })
}

/// Errors of a cycle, from the errors of the branches, if any.
pub(crate) fn cycle_errors(
    scene: &Scene,
    direction: Direction,
    c: &Cycle,
    bars: &[ErrorBars],
) -> CycleErrors {
    let of_branches: Vec<[f64; 3]> = bars.iter().map(|bar| direction.errors_of(bar)).collect();
    c.errors(&of_branches, scene.grid.plane_strain)
}

/// Plastic work in increments \[J\].
pub(crate) fn plastic_work(increments: &[Increment]) -> f64 {
    increments.iter().map(|i| i.energy.plastic).sum()
}

/// Largest stress of von Mises in increments over the yield stress, 1 where a body yields.
pub(crate) fn yield_ratio(increments: &[Increment]) -> f64 {
    increments
        .iter()
        .map(|i| i.yielded.reached)
        .fold(0.0, f64::max)
}

/// The loops of all cycles of the path, for each motion that the path drives.
pub(crate) fn cycles(scene: &Scene, increments: &[Increment]) -> Vec<(Direction, Cycle)> {
    let driven = |motion: RigidMotion| {
        let mut ends = scene.path.branches.iter().map(|b| &b.to);
        ends.any(|to| to.prescribed(motion).value() != 0.0)
    };
    [
        (Direction::X, RigidMotion::DeltaX),
        (Direction::Y, RigidMotion::DeltaY),
        (Direction::Torsion, RigidMotion::PhiZ),
    ]
    .into_iter()
    .filter(|(_, motion)| driven(*motion))
    .flat_map(|(direction, _)| {
        let points: Vec<_> = increments
            .iter()
            .map(|i| LoopPoint::new(i, &scene.grid, direction))
            .collect();
        loops(&scene.path, direction, &points)
            .into_iter()
            .map(move |c| (direction, c))
    })
    .collect()
}
