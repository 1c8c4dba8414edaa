//! Output of the commands for programs: SI units, names of the store.

use contact_core::estimate::ErrorBars;
use contact_core::march::{BranchSummary, Increment, Reached, Yield, summarise};
use contact_core::scene::{RigidMotion, Scene};
use contact_subsurface::{Cycle, CycleErrors, Direction, LoopPoint, loops};
use serde_json::{Map, Value, json};

use crate::words::{frictionless, state, word};

/// What the text begins with that stands in place of a missing number until it is written.
const MARK: char = '\u{0}';
/// Why a number is missing that nobody gave a reason for: one that is not finite, of a result.
const UNKNOWN: &str = "not known";

/// A number for [`pretty`] and [`line`]: one that is not finite keeps why.
pub(crate) fn number(x: f64) -> Value {
    match x {
        x if x.is_finite() => json!(x),
        f64::INFINITY => absent("infinite"),
        f64::NEG_INFINITY => absent("infinite, negative"),
        _ => absent(UNKNOWN),
    }
}

/// A number that there is not, and why.
pub(crate) fn absent(why: &str) -> Value {
    json!(format!("{MARK}{why}"))
}

/// A value, or why there is none.
pub(crate) fn or_why(value: Value, why: &str) -> Value {
    if value.is_null() { absent(why) } else { value }
}

/// What a command prints for programs, over several lines.
pub(crate) fn pretty(value: Value) -> String {
    format!("{:#}", written(value))
}

/// What a command prints for programs, in a line.
pub(crate) fn line(value: Value) -> String {
    written(value).to_string()
}

/// An answer whose numbers JSON has words for: one that is missing is null, and `NAME_why` beside
/// it is the reason. In a list the reasons of all stand in a list.
fn written(value: Value) -> Value {
    match value {
        Value::Object(of) => {
            let mut found = Map::new();
            for (name, value) in of {
                let why = reason(&value);
                found.insert(name.clone(), written(value));
                if let Some(why) = why {
                    found.insert(format!("{name}_why"), why);
                }
            }
            Value::Object(found)
        }
        Value::Array(of) => Value::Array(of.into_iter().map(written).collect()),
        value if reason(&value).is_some() => Value::Null,
        value => value,
    }
}

/// Why a number, or one of a list, is none.
fn reason(value: &Value) -> Option<Value> {
    match value {
        Value::Null => Some(json!(UNKNOWN)),
        Value::String(text) => text.strip_prefix(MARK).map(|why| json!(why)),
        Value::Array(of) => {
            let each: Vec<_> = of.iter().map(reason).collect();
            each.iter().any(Option::is_some).then(|| json!(each))
        }
        _ => None,
    }
}

/// Why a contact has neither a_H nor p_H.
pub(crate) const NO_HERTZ: &str = "no contact of Hertz";

/// A run: its branches and its cycles, and the error bars of the branches where there are any.
pub(crate) fn run(scene: &Scene, increments: &[Increment], bars: Option<&[ErrorBars]>) -> Value {
    let mut done = 0;
    let reached = Reached::from_increments(increments);
    let errors = reached.shear_errors(scene);
    let branches = summarise(increments);
    let branches: Vec<Value> = branches
        .iter()
        .map(|b| {
            let own = &increments[done..done + b.increments];
            done += b.increments;
            branch(scene, b, own, errors[b.branch])
        })
        .collect();
    let cycles: Vec<Value> = cycles(scene, increments)
        .iter()
        .map(|(direction, c)| cycle(scene, *direction, c, bars))
        .collect();
    let hertz = scene.hertz();
    json!({
        "title": scene.title,
        "mu": number(scene.friction.mu),
        "a_H": or_why(json!(hertz.map(|h| h.a)), NO_HERTZ),
        "p_H": or_why(json!(hertz.map(|h| h.p0)), NO_HERTZ),
        "increments": increments.len(),
        "units": units(scene),
        "branches": branches,
        "cycles": cycles,
        "error_bars": or_why(json!(bars), "the run has none: `fret run --error` estimates them"),
        "doubts": reached.all_doubts(scene),
    })
}

/// Units of forces, moments, energies and stiffnesses: of a line contact they are per metre.
fn units(scene: &Scene) -> Value {
    let of = |unit| scene.grid.unit_of(unit);
    json!({
        "force": of("N"),
        "moment": of("N m"),
        "energy": of("J"),
        "stiffness": of("N/m"),
        "torsional_stiffness": of("N m/rad"),
    })
}

/// The variable of the store that is the size of the contact.
fn length_of(scene: &Scene) -> &'static str {
    if scene.grid.plane_strain {
        "half_width"
    } else {
        "contact_radius"
    }
}

fn branch(scene: &Scene, b: &BranchSummary, own: &[Increment], error: Option<f64>) -> Value {
    let mut of = Map::new();
    let last = &own[own.len() - 1];
    let mut set = |key: &str, value: Value| of.insert(key.to_owned(), value);
    set("branch", json!(b.branch));
    set("t", json!(last.point.t));
    let (loads, motions) = (b.loads.forces(), b.motion.motions());
    for of in RigidMotion::ALL {
        set(of.load_name(), json!(loads[of.index()]));
        set(of.name(), json!(motions[of.index()]));
    }
    set(length_of(scene), json!(b.contact_radius));
    let sticks = (!frictionless(scene)).then_some(b.stick_ratio);
    set("stick_ratio", or_why(json!(sticks), "no friction"));
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
        set("plastic_work", json!(plastic_work(own)));
        set("plastic_volume", json!(volume));
        set("largest_plastic_strain", json!(largest));
        set("yield_ratio", json!(yield_ratio(own)));
    }
    set("increments", json!(b.increments));
    set("convolutions", json!(b.work.convolutions));
    set(
        "path_error",
        or_why(json!(error), "the increments of the branch were given"),
    );
    Value::Object(of)
}

fn cycle(scene: &Scene, direction: Direction, c: &Cycle, bars: Option<&[ErrorBars]>) -> Value {
    let errors = cycle_errors(direction, c, bars.unwrap_or_default());
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
        "energy_ratio": number(c.energy_ratio()),
        "energy_ratio_error": number(errors.energy_ratio),
        "sliding_ratio": number(c.sliding_ratio()),
        "sliding_ratio_error": number(errors.sliding_ratio),
    })
}

/// Errors of a cycle, from those of the branches where there are any.
pub(crate) fn cycle_errors(direction: Direction, c: &Cycle, bars: &[ErrorBars]) -> CycleErrors {
    let of_branches: Vec<[f64; 3]> = bars.iter().map(|bar| direction.errors_of(bar)).collect();
    c.errors(&of_branches)
}

/// Plastic work in increments \[J\].
pub(crate) fn plastic_work(own: &[Increment]) -> f64 {
    own.iter().map(|i| i.energy.plastic).sum()
}

/// Largest stress of von Mises in increments over the yield stress, 1 where a body yields.
pub(crate) fn yield_ratio(own: &[Increment]) -> f64 {
    own.iter().map(|i| i.yielded.reached).fold(0.0, f64::max)
}

/// The cycles of the motions that the path drives.
pub(crate) fn cycles(scene: &Scene, increments: &[Increment]) -> Vec<(Direction, Cycle)> {
    let driven = |of: RigidMotion| {
        let mut ends = scene.path.branches.iter().map(|b| &b.to);
        ends.any(|to| to.prescribed(of).value() != 0.0)
    };
    [
        (Direction::X, RigidMotion::DeltaX),
        (Direction::Y, RigidMotion::DeltaY),
        (Direction::Torsion, RigidMotion::PhiZ),
    ]
    .into_iter()
    .filter(|(_, of)| driven(*of))
    .flat_map(|(direction, _)| {
        let points: Vec<_> = increments
            .iter()
            .map(|i| LoopPoint::new(i, direction))
            .collect();
        loops(&scene.path, direction, &points)
            .into_iter()
            .map(move |c| (direction, c))
    })
    .collect()
}
