//! The campaign in numbers, as Markdown.

use std::fmt::Write;
use std::ops::Range;

use super::audit::Violations;
use super::below;
use super::campaign::{Fate, Outcome};
use super::draw::{ROLLED, SHAPED};
use super::twins::{self, UNTURNED, has_twins};
use super::warm;

impl Outcome {
    /// Whether a result was given that is not one.
    pub(crate) fn is_silently_wrong(&self) -> bool {
        match &self.fate {
            Fate::Solved(violations, twins) => {
                let alike = twins.iter().all(|(_, distance)| *distance <= 1.0);
                !(violations.hold() && alike)
            }
            Fate::Panicked(_) => true,
            Fate::Refused | Fate::Unsolved(_) | Fate::Stopped | Fate::Failed(_) => false,
        }
    }
}

/// `seconds` is the time of all scenes, on so many `threads`.
pub(crate) fn report(outcomes: &[Outcome], seconds: f64, threads: usize) -> String {
    let mut text = String::new();
    let total = outcomes.len();
    let count = |kind: &dyn Fn(&Fate) -> bool| outcomes.iter().filter(|o| kind(&o.fate)).count();
    let solved = count(&|f| matches!(f, Fate::Solved(..)));
    let refused = count(&|f| matches!(f, Fate::Refused));
    let unsolved = count(&|f| matches!(f, Fate::Unsolved(_)));
    let failed = count(&|f| matches!(f, Fate::Failed(_) | Fate::Stopped));
    let of = |seeds: Range<u64>| outcomes.iter().filter(|o| seeds.contains(&o.seed)).count();
    let (shaped, rolled) = (of(SHAPED..ROLLED), of(ROLLED..u64::MAX));
    let below = |seed: &u64| below::is_looked_at(*seed);
    let is_solved = |o: &&Outcome| matches!(o.fate, Fate::Solved(..));
    let seeds = || outcomes.iter().filter(is_solved).map(|o| o.seed);
    let (below, warmed) = (
        seeds().filter(below).count(),
        seeds().filter(|seed| warm::is_warmed(*seed)).count(),
    );
    let panicked = count(&|f| matches!(f, Fate::Panicked(_)));
    let wrong = outcomes.iter().filter(|o| o.is_silently_wrong()).count() - panicked;
    let share = 100.0 * solved as f64 / (total - refused).max(1) as f64;
    let _ = writeln!(
        text,
        "| scenes, of these with another shape, that roll | {total}, {shaped}, {rolled} |\n|---|---|"
    );
    let _ = writeln!(
        text,
        "| solved to their tolerance | {solved} ({share:.2} % of those that have a solution) |"
    );
    let _ = writeln!(
        text,
        "| without a solution (force past mu W, contact beyond the grid or as wide as the bodies are round, gap narrowest at the border): refused with the reason | {refused} |"
    );
    let _ = writeln!(
        text,
        "| mu times the coupling of the bodies above 1, or an increment of more than 10 000 convolutions: refused with the residual that is left | {unsolved} |"
    );
    let _ = writeln!(
        text,
        "| ended with another error, or not in time | {failed} |"
    );
    let _ = writeln!(text, "| panics | {panicked} |");
    let _ = writeln!(
        text,
        "| solved but violating an equation, NaN or unlike a twin | {wrong} |"
    );
    let _ = writeln!(
        text,
        "| solved ones judged below the surface, warmed by friction | {below}, {warmed} |"
    );
    write_work(&mut text, outcomes, seconds, threads);
    write_worst(&mut text, outcomes);
    write_reasons(&mut text, outcomes);
    text
}

/// What it took.
fn write_work(text: &mut String, outcomes: &[Outcome], seconds: f64, threads: usize) {
    let total = outcomes.len();
    let sum = |f: &dyn Fn(&Outcome) -> f64| outcomes.iter().map(f).sum::<f64>();
    let _ = writeln!(
        text,
        "| increments, of these solved in pieces | {}, {} |",
        sum(&|o| o.increments as f64),
        sum(&|o| o.in_pieces as f64)
    );
    let _ = writeln!(
        text,
        "| convolutions per increment | {:.1} |",
        sum(&|o| o.convolutions) / sum(&|o| o.increments as f64)
    );
    let mut compared = [0, 0, 0];
    for outcome in outcomes.iter().filter(|o| has_twins(o.seed)) {
        if let Fate::Solved(_, twins) = &outcome.fate {
            compared[0] += twins.len();
            compared[1] += twins.iter().filter(|(name, _)| *name == UNTURNED).count();
            compared[2] += twins::twins(outcome.seed) - twins.len();
        }
    }
    let _ = writeln!(
        text,
        "| twins compared, of these without the turn of the slip, left out as solved in other pieces | {}, {}, {} |",
        compared[0], compared[1], compared[2]
    );
    let slowest = outcomes.iter().map(|o| o.seconds).fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "| time of a scene with its twins, mean and longest | {:.2} s, {slowest:.1} s |",
        sum(&|o| o.seconds) / total as f64
    );
    let _ = writeln!(
        text,
        "| time of all, on {threads} threads | {:.1} min |",
        seconds / 60.0
    );
}

/// The worst of each equation.
fn write_worst(text: &mut String, outcomes: &[Outcome]) {
    let _ = writeln!(
        text,
        "\n| equation | worst misfit over what the tolerance allows |\n|---|---|"
    );
    let mut worst = Violations::default();
    let mut twins = std::collections::BTreeMap::new();
    for outcome in outcomes {
        if let Fate::Solved(violations, of_twins) = &outcome.fate {
            worst.worse(violations);
            for (name, distance) in of_twins {
                let worst = twins.entry(*name).or_insert(0.0_f64);
                *worst = worst.max(*distance);
            }
        }
    }
    for (name, value) in Violations::NAMES.into_iter().zip(worst.0) {
        let _ = writeln!(text, "| {name} | {value:.1e} |");
    }
    for (name, distance) in twins {
        let _ = writeln!(text, "| {name} twin | {distance:.1e} |");
    }
}

/// What was not solved as asked, scene by scene.
fn write_reasons(text: &mut String, outcomes: &[Outcome]) {
    for outcome in outcomes {
        match &outcome.fate {
            Fate::Stopped => {
                let _ = writeln!(text, "\nSeed {} did not end in time.", outcome.seed);
            }
            Fate::Unsolved(reason) | Fate::Failed(reason) => {
                let _ = writeln!(text, "\nSeed {}: {reason}.", outcome.seed);
            }
            Fate::Panicked(reason) => {
                let _ = writeln!(text, "\nSeed {} panicked: {reason}.", outcome.seed);
            }
            Fate::Solved(violations, twins) if outcome.is_silently_wrong() => {
                let _ = writeln!(
                    text,
                    "\nSeed {}: {violations:.2?}, {twins:.2?}.",
                    outcome.seed
                );
            }
            _ => {}
        }
    }
}
