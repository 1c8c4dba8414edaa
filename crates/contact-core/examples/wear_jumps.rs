//! What jumps over cycles cost and miss: implicit and explicit ones, on one scene.
//!
//! Writes a table in Markdown to the standard output: `wear_jumps SCENE [KEY=VALUE ...]`. Errors are those
//! against the first run, which takes the shortest implicit jumps: of the deepest worn depth, of the worn
//! profile (root mean square over the deepest), of the worn volume, and of the pressure at the end (root mean
//! square over its own). Cycles solved are the work that does not jitter; times are those of the processor.
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use contact_core::Error;
use contact_core::wear::{Block, Jump, Jumps, Wear, WearRun};
use ndarray::Array2;

/// Tolerance of the run that the others are compared with.
const FINEST: f64 = 1e-3;
/// Numbers of jumps of equal length.
const IMPLICIT: [usize; 3] = [6, 12, 24];
const EXPLICIT: [usize; 4] = [30, 60, 120, 240];

/// A run that is done.
struct Done {
    last: Jump,
    block: Block,
    cycles_solved: usize,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("wear_jumps SCENE [KEY=VALUE ...]")?;
    let text = std::fs::read_to_string(&file)?;
    let settings: Vec<String> = arguments.collect();
    let (scene, wear) = Wear::from_toml_str(&text, &file, &settings)?;
    println!(
        "| jumps | number | cycles solved | processor time, s | deepest depth, um | off by, % | profile, % | \
         volume, % | pressure, % |\n|---|---|---|---|---|---|---|---|---|"
    );
    let tolerances = [FINEST, 0.01, 0.04].map(Jumps::Tolerance);
    let numbers = IMPLICIT.map(Jumps::Number).into_iter();
    let all = tolerances
        .into_iter()
        .chain(numbers)
        .chain(EXPLICIT.map(Jumps::Explicit));
    let mut finest: Option<Done> = None;
    for jumps in all {
        let wear = Wear {
            jumps,
            ..wear.clone()
        };
        let begun = processor_seconds();
        let done = run(&scene, &wear, begun)?;
        println!("{}", line(jumps, &done, finest.as_ref().unwrap_or(&done)));
        finest = finest.or(Some(done));
    }
    Ok(())
}

fn run(scene: &contact_core::Scene, wear: &Wear, begun: f64) -> Result<Done, Error> {
    let mut run = WearRun::new(scene, wear, &Arc::default())?;
    while let Some(jump) = run.advance() {
        jump?;
    }
    let last = run.history().last().cloned();
    Ok(Done {
        last: last.ok_or(Error::Interrupted { increment: 0 })?,
        block: run.block(),
        cycles_solved: run.work().1,
        seconds: processor_seconds() - begun,
    })
}

fn line(jumps: Jumps, done: &Done, finest: &Done) -> String {
    let name = match jumps {
        Jumps::Tolerance(tolerance) => format!("implicit, tolerance {tolerance}"),
        Jumps::Number(_) => "implicit, equal".to_owned(),
        Jumps::Explicit(_) => "explicit, equal".to_owned(),
    };
    let deepest = |done: &Done| done.last.depth[0].max(done.last.depth[1]);
    let volume = |done: &Done| done.last.volume[0] + done.last.volume[1];
    let both = |done: &Done| &done.block.worn1 + &done.block.worn2;
    let top = both(finest).iter().fold(0.0, |m: f64, w| m.max(*w));
    let root_mean_square = |f: &Array2<f64>| f.mapv(|x| x * x).mean().unwrap_or(0.0).sqrt();
    let profile = root_mean_square(&(both(done) - both(finest))) / top;
    let p = root_mean_square(&(&done.block.p - &finest.block.p));
    format!(
        "| {name} | {} | {} | {:.1} | {:.4} | {:+.2} | {:.2} | {:+.2} | {:.1} |",
        done.last.index,
        done.cycles_solved,
        done.seconds,
        1e6 * deepest(done),
        100.0 * (deepest(done) / deepest(finest) - 1.0),
        100.0 * profile,
        100.0 * (volume(done) / volume(finest) - 1.0),
        100.0 * p / root_mean_square(&finest.block.p)
    )
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
