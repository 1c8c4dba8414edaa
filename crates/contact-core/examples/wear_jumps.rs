//! What jumps over cycles cost: implicit ones against the explicit ones that are no less exact.
//!
//! `wear_jumps [DOCUMENT]` writes a table in Markdown to the standard output, and between the marks of a document
//! (`make wear-jumps`: docs/wear.md). The error is that of the worn profile of both bodies (root mean square over the
//! deepest depth) against the first run of a case, which takes the shortest implicit jumps. Explicit jumps are halved until
//! they are as exact as the implicit ones. Work that does not jitter: cycles solved, or in gross slip two-dimensional
//! transforms; times are those of the processor.
#![allow(clippy::print_stdout)]

#[path = "../tests/document/mod.rs"]
mod document;

use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::Reach;
use contact_core::wear::{Jumps, Wear, WearRun};
use ndarray::Array2;

/// Tolerance of the run that the others are compared with, over the smallest of those compared.
const FINER: f64 = 0.1;
/// Fewest explicit jumps, and processor time after which no more are tried \[s\].
const FEWEST: usize = 8;
const LONGEST: f64 = 120.0;
/// Title, scene, changes of it, tolerances of the implicit jumps (0.01 by default).
const CASES: [Case; 6] = [
    Case {
        title: "coated sphere, 64 x 64",
        scene: "wear_coated",
        settings: &["grid.n=64"],
        tolerances: &[0.04, 0.01],
    },
    Case {
        title: "the same, 128 x 128",
        scene: "wear_coated",
        settings: &[],
        tolerances: &[0.04, 0.01],
    },
    Case {
        title: "64 x 64, ten times as long",
        scene: "wear_coated",
        settings: &["grid.n=64", "wear.cycles=180000"],
        tolerances: &[0.04, 0.01],
    },
    Case {
        title: "64 x 64, a hundred times as long",
        scene: "wear_coated",
        settings: &["grid.n=64", "wear.cycles=1.8e6"],
        tolerances: &[0.04, 0.01],
    },
    Case {
        title: "gross slip of a cylinder, 160 cells",
        scene: "wear_mccoll",
        settings: &["grid.n=[160, 1]"],
        tolerances: &[0.04, 0.01],
    },
    Case {
        title: "the same, 320 cells",
        scene: "wear_mccoll",
        settings: &["grid.n=[320, 1]"],
        tolerances: &[0.04, 0.01],
    },
];

struct Case {
    title: &'static str,
    scene: &'static str,
    settings: &'static [&'static str],
    tolerances: &'static [f64],
}

/// A run that is done.
struct Done {
    jumps: usize,
    /// Depth worn off both bodies \[m\].
    worn: Array2<f64>,
    work: usize,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut table = "| case | error | implicit: tolerance | jumps | work | time | explicit: jumps | work | time | jumps, explicit \
                     over implicit | work |\n|---|---|---|---|---|---|---|---|---|---|---|"
        .to_owned();
    println!("{table}");
    for case in CASES {
        for line in case.lines()? {
            println!("{line}");
            table = format!("{table}\n{line}");
        }
    }
    if let Some(file) = std::env::args().nth(1) {
        document::insert(&file, "jumps", &table);
    }
    Ok(())
}

impl Case {
    /// A line for each tolerance.
    fn lines(&self) -> Result<Vec<String>, Error> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
        let settings: Vec<String> = self.settings.iter().map(ToString::to_string).collect();
        let file = format!("{folder}/{}.toml", self.scene);
        let (scene, wear) = Wear::from_file(&file, &settings, Reach::Folder)?;
        let run = |jumps| {
            run(
                &scene,
                &Wear {
                    jumps,
                    ..wear.clone()
                },
            )
        };
        let least = self
            .tolerances
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let finest = run(Jumps::Tolerance(FINER * least))?;
        let implicit = self
            .tolerances
            .iter()
            .map(|tolerance| run(Jumps::Tolerance(*tolerance)));
        let implicit = implicit.collect::<Result<Vec<Done>, Error>>()?;
        let errors: Vec<f64> = implicit.iter().map(|done| finest.off(done)).collect();
        let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
        let mut explicit: Vec<(Done, f64)> = Vec::new();
        let mut jumps = FEWEST;
        while explicit
            .last()
            .is_none_or(|(done, error)| *error > least && done.seconds < LONGEST)
        {
            let done = run(Jumps::Explicit(jumps))?;
            let error = finest.off(&done);
            explicit.push((done, error));
            jumps *= 2;
        }
        let lines = self.tolerances.iter().zip(implicit.iter().zip(&errors));
        Ok(lines
            .map(|(tolerance, (done, error))| {
                let as_exact = explicit.iter().find(|(_, of)| of <= error);
                self.line(*tolerance, done, *error, as_exact.map(|(done, _)| done))
            })
            .collect())
    }

    fn line(&self, tolerance: f64, done: &Done, error: f64, explicit: Option<&Done>) -> String {
        let numbers =
            |done: &Done| format!("{} | {} | {:.1} s", done.jumps, done.work, done.seconds);
        let over = |of: fn(&Done) -> usize, explicit| of(explicit) as f64 / of(done) as f64;
        let beside = match explicit {
            None => format!("none in {LONGEST:.0} s | | | |"),
            Some(explicit) => format!(
                "{} | {:.1} | {:.1}",
                numbers(explicit),
                over(|done| done.jumps, explicit),
                over(|done| done.work, explicit)
            ),
        };
        let (title, percent, implicit) = (self.title, 100.0 * error, numbers(done));
        format!("| {title} | {percent:.2} % | {tolerance} | {implicit} | {beside} |")
    }
}

impl Done {
    /// Distance of another worn profile (root mean square) over the deepest depth.
    fn off(&self, other: &Self) -> f64 {
        let deepest = self.worn.iter().fold(0.0, |m: f64, w| m.max(*w));
        let square = (&other.worn - &self.worn).mapv(|x| x * x).mean();
        square.unwrap_or(0.0).sqrt() / deepest
    }
}

fn run(scene: &contact_core::Scene, wear: &Wear) -> Result<Done, Error> {
    let begun = processor_seconds();
    let mut run = WearRun::new(scene, wear, &Arc::default())?;
    while let Some(jump) = run.advance() {
        jump?;
    }
    let block = run.block();
    let (transforms, cycles) = run.work();
    Ok(Done {
        jumps: run.history().len(),
        worn: block.worn1 + block.worn2,
        work: if cycles > 0 { cycles } else { transforms },
        seconds: processor_seconds() - begun,
    })
}

/// Seconds of the processor that this process has used, of all its threads (Linux; elsewhere zero).
fn processor_seconds() -> f64 {
    /// Ticks per second of the times in `/proc`.
    const TICKS: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let fields: Vec<f64> = after_name
        .split_whitespace()
        .skip(11)
        .take(2)
        .filter_map(|field| field.parse().ok())
        .collect();
    fields.iter().sum::<f64>() / TICKS
}
