//! The table `[wear]` of a scene file.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::{Fault, Reach, Scene, Section, read_scene_and, read_text};
use toml::{Table, Value};

use super::aerated::Aerated;
use super::law::{Archard, BodyWear, CellCycle, DissipatedEnergy, Law};
use super::settings::{Cycling, Jumps, Wear, WornThrough};
use super::third_body_table::{air, bed, write_third_body};
use super::variable::FactorVariable;
use super::varying::{Factor, Varying};

const KEYS: [&str; 18] = [
    "cycles",
    "first_branch",
    "branch_counts",
    "cycling",
    "frequency",
    "rig_stiffness",
    "tolerance",
    "jumps",
    "explicit_jumps",
    "worn_through",
    "debris_kept",
    "air",
    "bed",
    "closed_below",
    "yield_stress",
    "event_depth_fraction",
    "body1",
    "body2",
];
const BODY: [&str; 7] = [
    "k",
    "alpha",
    "starved",
    "threshold",
    "factor",
    "laws",
    "share",
];
const LAW: [&str; 6] = ["k", "alpha", "starved", "threshold", "factor", "own"];

impl Wear {
    /// Reads and checks a scene file with a table `[wear]`, as [`Scene::from_file_reaching`].
    pub fn from_file(
        path: impl AsRef<Path>,
        settings: &[String],
        reach: Reach,
    ) -> Result<(Scene, Self), Error> {
        let (text, file) = read_text(path.as_ref())?;
        read(&text, &file, settings, reach)
    }

    /// Reads and checks a scene and its table `[wear]`, if it has one. All mistakes of both are
    /// reported at once.
    pub fn scene_and_wear(
        text: &str,
        file: &str,
        settings: &[String],
        reach: Reach,
    ) -> Result<(Scene, Option<Self>), Error> {
        let check_both = |root: &Section<'_>, scene: &Scene| {
            let Some(section) = root.section("wear", &KEYS)? else {
                return Ok(None);
            };
            let (wear, rig) = (wear(&section)?, rig_stiffness(&section)?);
            let mut scene = scene.clone();
            scene.path.rig_stiffness = rig.or(scene.path.rig_stiffness);
            wear.check_settings(&scene)?;
            if !has_history(root) {
                wear.check(&scene)?;
            }
            Ok(Some((wear, scene)))
        };
        let (scene, wear) = read_scene_and(text, file, settings, reach, check_both)?;
        Ok(wear.map_or((scene, None), |(wear, scene)| (scene, Some(wear))))
    }

    /// Reads and checks a scene with a table `[wear]`; `file` is its name in errors.
    pub fn from_toml_str(
        text: &str,
        file: &str,
        settings: &[String],
    ) -> Result<(Scene, Self), Error> {
        read(text, file, settings, Reach::Folder)
    }

    /// Reads the wear of a scene from a table `[wear]`, and the scene with its rig if the table has
    /// one. Laws of the user, `{ own = true }`, are taken in turn from `own` for each body.
    pub fn from_table(
        scene: &Scene,
        table: &Table,
        own: &[Vec<Arc<dyn Law>>; 2],
    ) -> Result<(Scene, Self), Error> {
        let root = Table::from_iter([("wear".to_owned(), Value::Table(table.clone()))]);
        let read_both = || {
            let section = Section::root(&root, &["wear"])?.require_section("wear", &KEYS)?;
            Ok((wear(&section)?, rig_stiffness(&section)?))
        };
        let (mut wear, rig) = read_both().map_err(Fault::into_error)?;
        wear.set_laws(own);
        let mut scene = scene.clone();
        scene.path.rig_stiffness = rig.or(scene.path.rig_stiffness);
        Ok((scene, wear))
    }

    /// Reads a scene and its wear from a store. The laws of the user are given for the bodies that
    /// have them.
    pub fn from_store(
        text: &str,
        file: &str,
        own: &[Vec<Arc<dyn Law>>; 2],
    ) -> Result<(Scene, Self), Error> {
        let (scene, mut wear, _) = read_unchecked(text, file, &[], Reach::Folder)?;
        wear.set_laws(own);
        wear.check(&scene)?;
        Ok((scene, wear))
    }

    /// Puts the user's own laws in the place of their placeholders.
    fn set_laws(&mut self, own: &[Vec<Arc<dyn Law>>; 2]) {
        let bodies = self.bodies.iter_mut().zip(own);
        bodies.for_each(|(body, own)| body.set_user_laws(own));
    }

    /// Writes the table `[wear]` in SI, every number in full. A law of the user, which a file
    /// cannot represent, is written `{ own = true }`. It has to be given again to read the file.
    pub fn to_toml(&self) -> String {
        let mut text = format!("\n[wear]\ncycles = {:?}\n", self.cycles);
        if let Some(first) = self.first_branch {
            let _ = writeln!(text, "first_branch = {first}");
        }
        if !self.branch_counts.is_empty() {
            let _ = writeln!(text, "branch_counts = {:?}", self.branch_counts);
        }
        if let Some(frequency) = self.frequency {
            let _ = writeln!(text, "frequency = {frequency:?}");
        }
        let cycling = match self.cycling {
            Cycling::Auto => "auto",
            Cycling::March => "march",
            Cycling::Sliding => "sliding",
        };
        let through = match self.worn_through {
            WornThrough::Stop => "stop",
            WornThrough::GoOn => "go_on",
        };
        // Writing to a text cannot fail.
        let _ = writeln!(
            text,
            "cycling = \"{cycling}\"\nworn_through = \"{through}\"\ndebris_kept = {:?}\nevent_depth_fraction = {:?}",
            self.debris_kept, self.event_depth_fraction
        );
        let _ = match self.jumps {
            Jumps::Tolerance(tolerance) => writeln!(text, "tolerance = {tolerance:?}"),
            Jumps::Number(n) => writeln!(text, "jumps = {n}"),
            Jumps::Explicit(n) => writeln!(text, "explicit_jumps = {n}"),
        };
        if self.air.is_some() || self.bed.is_some() {
            text.push_str(&write_third_body(self));
        }
        for (name, body) in ["body1", "body2"].into_iter().zip(&self.bodies) {
            if body.laws.is_empty() {
                continue;
            }
            let placeholder = || "{ own = true }".to_owned();
            let laws = body
                .laws
                .iter()
                .map(|law| law.to_toml().unwrap_or_else(placeholder));
            let laws: Vec<String> = laws.collect();
            let _ = writeln!(text, "\n[wear.{name}]\nlaws = [{}]", laws.join(", "));
            if let Some(share) = body.share {
                let _ = writeln!(text, "share = {share:?}");
            }
        }
        text
    }
}

/// Reads and checks a scene and its wear. A cycle that follows from a load history is not checked.
fn read(text: &str, file: &str, settings: &[String], reach: Reach) -> Result<(Scene, Wear), Error> {
    let (scene, wear, has_history) = read_unchecked(text, file, settings, reach)?;
    wear.check_settings(&scene)?;
    if !has_history {
        wear.check(&scene)?;
    }
    Ok((scene, wear))
}

/// Whether the cycle of a scene follows from its load history, so that its path has none.
fn has_history(root: &Section<'_>) -> bool {
    root.get("history").is_some()
}

/// The scene, with the rig of `[wear]` where it has one, its wear, and whether it has a history.
fn read_unchecked(
    text: &str,
    file: &str,
    settings: &[String],
    reach: Reach,
) -> Result<(Scene, Wear, bool), Error> {
    let read_both = |root: &Section<'_>, _: &Scene| {
        let section = root.require_section("wear", &KEYS)?;
        Ok((wear(&section)?, rig_stiffness(&section)?, has_history(root)))
    };
    let (mut scene, (wear, rig, has_history)) =
        read_scene_and(text, file, settings, reach, read_both)?;
    scene.path.rig_stiffness = rig.or(scene.path.rig_stiffness);
    Ok((scene, wear, has_history))
}

/// Reads the spring of the rig, which may stand in `[wear]` instead of `[rig]`.
fn rig_stiffness(wear: &Section<'_>) -> Result<Option<f64>, Fault> {
    let K = wear.number_if("rig_stiffness", &[])?;
    if let Some(K) = K.filter(|K| !(*K > 0.0)) {
        let key = wear.path("rig_stiffness");
        return Err(Error::invalid(key, K, "above 0 N/m").into());
    }
    Ok(K.filter(|K| K.is_finite()))
}

/// Reads the table `[wear]`, not yet checked for meaning.
fn wear(section: &Section<'_>) -> Result<Wear, Fault> {
    let bodies = [body(section, "body1")?, body(section, "body2")?];
    let cycles = section.number("cycles", "a number of cycles above 0", &[])?;
    let default = Wear::new(bodies, cycles);
    let jump_keys = ["tolerance", "jumps", "explicit_jumps"];
    let mut keys_present = jump_keys.iter().filter(|key| section.get(key).is_some());
    let jumps = match keys_present.next() {
        None => default.jumps,
        Some(&"tolerance") => Jumps::Tolerance(section.number("tolerance", "a number", &[])?),
        Some(&"jumps") => Jumps::Number(section.count("jumps", 1)?),
        Some(_) => Jumps::Explicit(section.count("explicit_jumps", 1)?),
    };
    if let Some(other) = keys_present.next() {
        let key = section.path(other);
        let message = format!("{key}: one of {} at most", jump_keys.join(", "));
        return Err(Fault::new(key, message));
    }
    Ok(Wear {
        first_branch: match section.get("first_branch") {
            Some(_) => Some(section.count("first_branch", 1)?),
            None => None,
        },
        branch_counts: branch_counts(section)?,
        frequency: section.number_if("frequency", &[])?,
        cycling: section.choice(
            "cycling",
            &[
                ("auto", Cycling::Auto),
                ("march", Cycling::March),
                ("sliding", Cycling::Sliding),
            ],
        )?,
        jumps,
        worn_through: section.choice(
            "worn_through",
            &[("stop", WornThrough::Stop), ("go_on", WornThrough::GoOn)],
        )?,
        debris_kept: section.number_or("debris_kept", default.debris_kept, &[])?,
        air: air(section)?,
        bed: bed(section)?,
        closed_below: section.number_or("closed_below", default.closed_below, &[])?,
        yield_stress: section.number_if("yield_stress", &[])?,
        event_depth_fraction: section.number_or(
            "event_depth_fraction",
            default.event_depth_fraction,
            &[],
        )?,
        ..default
    })
}

/// Reads how often a cycle passes its branches.
fn branch_counts(section: &Section<'_>) -> Result<Vec<f64>, Fault> {
    let Some(value) = section.get("branch_counts") else {
        return Ok(Vec::new());
    };
    let number = |value: &Value| match value {
        Value::Integer(count) => Some(*count as f64),
        Value::Float(count) => Some(*count),
        _ => None,
    };
    let counts = value
        .as_array()
        .and_then(|counts| counts.iter().map(number).collect::<Option<Vec<f64>>>());
    counts.filter(|counts| !counts.is_empty()).ok_or_else(|| {
        let key = section.path("branch_counts");
        let message =
            format!("{key} = {value}: must be a list of numbers, one for each branch of the cycle");
        Fault::new(&key, message)
    })
}

/// Reads the laws of a body: one for all its layers, or a list.
fn body(wear: &Section<'_>, name: &str) -> Result<BodyWear, Fault> {
    let Some(section) = wear.section(name, &BODY)? else {
        return Ok(BodyWear::default());
    };
    let share = section.number_if("share", &[])?;
    let laws = section.sections("laws", &LAW)?;
    if laws.is_empty() {
        return Ok(BodyWear {
            laws: vec![law(&section)?],
            share,
        });
    }
    if let Some(key) = LAW.iter().find(|key| section.get(key).is_some()) {
        let key = section.path(key);
        return Err(Fault::new(
            &key,
            format!("{key}: not beside `laws`, which has one law per layer"),
        ));
    }
    let laws = laws.iter().map(law).collect::<Result<_, _>>()?;
    Ok(BodyWear { laws, share })
}

/// Reads a law of wear: Archard's by `k`, of the dissipated energy by `alpha`, or a placeholder for a user's
/// law.
fn law(section: &Section<'_>) -> Result<Arc<dyn Law>, Fault> {
    if section.get("own").is_some() {
        return Ok(Arc::new(LawPlaceholder));
    }
    let threshold = section.number_or("threshold", 0.0, &[])?;
    let starved = section.number_if("starved", &[])?;
    let law: Arc<dyn Law> = match (
        section.number_if("k", &[])?,
        section.number_if("alpha", &[])?,
    ) {
        (Some(k), None) => in_air(k, starved, |k| Archard { k, threshold }),
        (None, Some(alpha)) => in_air(alpha, starved, |alpha| DissipatedEnergy {
            alpha,
            threshold,
        }),
        _ => {
            let key = section.path("k");
            let choice = "either k (Archard, m^2/N) or alpha (dissipated energy, m^3/J)";
            return Err(Fault::new(&key, format!("{key}: give {choice}")));
        }
    };
    Ok(match factor(section)? {
        Some(factor) => Arc::new(Varying { law, factor }),
        None => law,
    })
}

/// A law with a coefficient; with `starved` it is weighted with a second one for cells without oxygen.
fn in_air<L: Law + 'static>(
    coefficient: f64,
    starved: Option<f64>,
    law: impl Fn(f64) -> L,
) -> Arc<dyn Law> {
    let aerated = Arc::new(law(coefficient));
    match starved {
        Some(starved) => Arc::new(Aerated {
            law: aerated,
            starved_law: Arc::new(law(starved)),
            coefficients: [coefficient, starved],
        }),
        None => aerated,
    }
}

/// Reads the factor of a law that depends on a variable; none without one.
fn factor(law: &Section<'_>) -> Result<Option<Factor>, Fault> {
    let Some(section) = law.section("factor", &["of", "table"])? else {
        return Ok(None);
    };
    let variable = section.choice("of", &FactorVariable::ALL)?;
    let table = section.pairs("table", "a list of pairs [value, factor]")?;
    Ok(Some(Factor { variable, table }))
}

/// Placeholder in a file for a law of the user.
#[derive(Debug)]
struct LawPlaceholder;

impl Law for LawPlaceholder {
    /// Cannot be called: such a law fails its check.
    fn depth(&self, _: &CellCycle<'_>, _: &mut [f64]) -> Result<(), Error> {
        self.check("wear")
    }

    /// Fails: the law has to be given again with the run.
    fn check(&self, key: &str) -> Result<(), Error> {
        let allowed = "given again with the run: a function, which no file can hold";
        Err(Error::invalid(format!("{key}.laws"), "own", allowed))
    }
}
