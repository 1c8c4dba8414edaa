//! What jumps over cycles cost: implicit ones against the explicit ones that are no less exact.
//!
//! `wear_jumps [DOCUMENT]` writes a table in Markdown to the standard output, and between the marks
//! of a document (`make wear-jumps`: docs/wear_evidence.md). Errors are those of the worn profile of both
//! bodies (root mean square over the deepest depth) and of the pressure at the end (over its own
//! root mean square) against a run of the shortest implicit jumps. Explicit jumps are halved until
//! neither error is larger than that of the implicit ones. Work that does not jitter: cycles
//! solved, or in gross slip two-dimensional transforms; times are those of the processor.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // a command of developers: a document that is not there ends it

#[path = "../../contact-core/tests/document/mod.rs"]
mod document;

use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::Reach;
use contact_wear::{Jumps, Wear, WearRun};
use ndarray::Array2;

/// Tolerance of the run that the others are compared with.
const FINEST: f64 = 1e-3;
/// Smaller errors of profile and pressure are those that the solvers leave, and count as these.
const LEAST: [f64; 2] = [1e-4, 1e-2];
/// Fewest explicit jumps, and processor time after which no more are tried \[s\].
const FEWEST: usize = 8;
const LONGEST: f64 = 25.0;
/// Title, scene and changes of it.
const CASES: [Case; 8] = [
    (
        "partial slip, 32 x 32 cells, 10 000 cycles",
        "wear_partial_slip",
        &["grid.n=32", "wear.cycles=1e4"],
    ),
    (
        "100 000 cycles",
        "wear_partial_slip",
        &["grid.n=32", "wear.cycles=1e5"],
    ),
    ("1 000 000 cycles", "wear_partial_slip", &["grid.n=32"]),
    (
        "64 x 64 cells, 100 000 cycles",
        "wear_partial_slip",
        &["wear.cycles=1e5"],
    ),
    (
        "coated, 64 x 64 cells, 18 000 cycles",
        "wear_coated",
        &["grid.n=64"],
    ),
    (
        "gross slip, 80 cells, 18 000 cycles",
        "wear_mccoll",
        &["grid.n=[80, 1]"],
    ),
    ("320 cells", "wear_mccoll", &["grid.n=[320, 1]"]),
    ("640 cells", "wear_mccoll", &[]),
];
/// Tolerances of the implicit jumps, the larger one first; 0.01 is the default.
const TOLERANCES: [f64; 2] = [0.04, 0.01];

type Case = (&'static str, &'static str, &'static [&'static str]);

/// A run that is done.
struct Done {
    jumps: usize,
    /// Depth worn off both bodies \[m\].
    worn: Array2<f64>,
    /// Pressure at the end \[Pa\].
    p: Array2<f64>,
    work: f64,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut table = "| case | tolerance | worn profile | pressure | implicit jumps | work | time | explicit jumps | work | time \
                     | jumps, explicit over implicit | work |\n|---|---|---|---|---|---|---|---|---|---|---|---|"
        .to_owned();
    println!("{table}");
    for case in CASES {
        for line in lines(case)? {
            println!("{line}");
            table = format!("{table}\n{line}");
        }
    }
    if let Some(file) = std::env::args().nth(1) {
        document::insert(&file, "jumps", &table);
    }
    Ok(())
}

/// A line for each tolerance.
fn lines((title, scene, settings): Case) -> Result<Vec<String>, Error> {
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    let file = format!("{}/../../scenes/{scene}.toml", env!("CARGO_MANIFEST_DIR"));
    let (scene, wear) = Wear::from_file(&file, &settings, Reach::Folder)?;
    let run = |jumps| {
        let wear = Wear {
            jumps,
            ..wear.clone()
        };
        run(&scene, &wear)
    };
    let finest = run(Jumps::Tolerance(FINEST))?;
    let mut implicit = Vec::new();
    for tolerance in TOLERANCES {
        let done = run(Jumps::Tolerance(tolerance))?;
        implicit.push((tolerance, finest.off(&done), done));
    }
    let mut explicit: Vec<([f64; 2], Done)> = Vec::new();
    for halvings in 0.. {
        let done = run(Jumps::Explicit(FEWEST << halvings))?;
        let error = finest.off(&done);
        let ends = implicit.iter().all(|(_, of, _)| as_small(error, *of));
        let ends = ends || done.seconds > LONGEST;
        explicit.push((error, done));
        if ends {
            break;
        }
    }
    let most = FEWEST << (explicit.len() - 1);
    let line = |(tolerance, error, done): &(f64, [f64; 2], Done)| {
        let as_exact = explicit.iter().find(|(of, _)| as_small(*of, *error));
        let beside = as_exact.map_or_else(
            || format!("more than {most} | | | | "),
            |(_, other)| {
                let jumps = other.jumps as f64 / done.jumps as f64;
                let work = other.work / done.work;
                format!("{} | {jumps:.1} | {work:.1}", other.numbers())
            },
        );
        let [worn, p] = error.map(|e| 100.0 * e);
        let numbers = done.numbers();
        format!("| {title} | {tolerance} | {worn:.2} % | {p:.1} % | {numbers} | {beside} |")
    };
    Ok(implicit.iter().map(line).collect())
}

/// Whether no error is larger than another.
fn as_small(error: [f64; 2], other: [f64; 2]) -> bool {
    error
        .iter()
        .zip(other)
        .all(|(error, other)| *error <= other)
}

impl Done {
    fn numbers(&self) -> String {
        format!("{} | {:.0} | {:.1} s", self.jumps, self.work, self.seconds)
    }

    /// Errors of the worn profile and of the pressure of another run, not below [`LEAST`].
    fn off(&self, other: &Self) -> [f64; 2] {
        let deepest = self.worn.iter().fold(0.0, |m: f64, w| m.max(*w));
        let worn = root_mean_square(&(&other.worn - &self.worn)) / deepest;
        let p = root_mean_square(&(&other.p - &self.p)) / root_mean_square(&self.p);
        [worn.max(LEAST[0]), p.max(LEAST[1])]
    }
}

fn root_mean_square(field: &Array2<f64>) -> f64 {
    field.mapv(|x| x * x).mean().unwrap_or(0.0).sqrt()
}

fn run(scene: &contact_core::Scene, wear: &Wear) -> Result<Done, Error> {
    let begun = processor_seconds();
    let mut run = WearRun::new(scene, wear, &Arc::default())?;
    while let Some(jump) = run.advance() {
        jump?;
    }
    let block = run.block();
    let (convolutions, cycles) = run.work();
    Ok(Done {
        jumps: run.history().len(),
        worn: block.worn1 + block.worn2,
        p: block.p,
        work: if cycles > 0 {
            cycles as f64
        } else {
            convolutions.count()
        },
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
