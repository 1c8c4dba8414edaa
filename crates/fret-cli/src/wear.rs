//! `fret wear`.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use clap::Args;
use contact_core::Error;
use contact_core::digits::with_error;
use contact_core::scene::{Grid, Scene};
use contact_store::{WearStore, read_worn, resume_wear};
use contact_wear::{Event, EventKind, Jump, Wear, WearRun};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use crate::failure::Failure;
use crate::json::pretty;
use crate::layout::{Column, Page};
use crate::out::Out;
use crate::printed::print;
use crate::run::stop_on_interrupt;
use crate::scene_options::{SceneOptions, warn_of_doubts};
use crate::terminal::{can_draw, print_message};
use crate::threads::Threads;
use crate::units::um;

const TEMPLATE: &str = "{bar:10} {pos}/{len} cycles, {elapsed}, {eta} left  {wide_msg}";
/// Remedy for a scene with a load history.
const WITHOUT_HISTORY: &str = "left out: `fret damage SCENE --block FILE` writes a scene with the loops of its history, \
     which fret wear takes";

/// Options of `fret wear`.
#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    out: Out,
    /// Go on with a run of this scene that ended early, in its store
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    threads: Threads,
    /// Show neither progress nor summary
    #[arg(short, long)]
    quiet: bool,
    /// Write jumps and events as JSON to standard output, instead of the table
    #[arg(long)]
    json: bool,
    /// Begin on the surfaces that a run of wear in this store has left
    #[arg(long, value_name = "STORE", conflicts_with = "resume")]
    start: Option<PathBuf>,
}

/// Display of a run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Display {
    /// A bar and a table.
    Table,
    /// A bar and JSON.
    Json,
    /// Nothing.
    Nothing,
}

impl Options {
    /// The display while it runs and at the end.
    fn shown(&self) -> Display {
        match (self.json, self.quiet) {
            (true, _) => Display::Json,
            (false, true) => Display::Nothing,
            (false, false) => Display::Table,
        }
    }
}

/// Wears the surfaces of a scene.
pub(crate) fn wear(options: &Options) -> Result<(), Failure> {
    options.threads.set();
    let reach = options.scene.reach();
    let read = Wear::from_file(&options.scene.scene, &options.scene.settings, reach);
    let (scene, wear) = read.map_err(Failure::BadInput)?;
    if options.scene.has_history().map_err(Failure::BadInput)? {
        let error = Error::invalid("history", "given", WITHOUT_HISTORY);
        return Err(Failure::BadInput(error));
    }
    warn_of_doubts(&wear.doubts());
    warn_of_doubts(wear.doubt_of_grid(&scene).as_slice());
    let out = &options.out.path;
    if options.resume {
        return resume(out, Some((&scene, &wear)), options.shown());
    }
    let kept = Arc::new(AtomicBool::new(false));
    let stop = stop_on_interrupt(&kept);
    let store = WearStore::create(out, options.out.overwrite).map_err(Failure::BadInput)?;
    let run = match &options.start {
        Some(from) => {
            let start = read_worn(from).map_err(Failure::BadInput)?;
            WearRun::from_worn(&scene, &wear, &start, &stop)
        }
        None => WearRun::new(&scene, &wear, &stop),
    };
    let run = run.map_err(to_failure)?;
    to_end(run, store, out, &kept, options.shown())
}

/// Continues the run of a store. If a scene and its wear are given, they must agree with the
/// store.
pub(crate) fn resume(
    out: &Path,
    expected: Option<(&Scene, &Wear)>,
    shown: Display,
) -> Result<(), Failure> {
    let kept = Arc::new(AtomicBool::new(true));
    let stop = stop_on_interrupt(&kept);
    let run_and_store = resume_wear(out, expected, &stop).map_err(Failure::BadInput)?;
    if let Some((run, store)) = run_and_store {
        return to_end(run, store, out, &kept, shown);
    }
    print_message(&format!("fret: {} is done", out.display()));
    Ok(())
}

/// Runs jump by jump into the store, with a bar, and prints the summary. Raises `kept` after the first jump,
/// from when on an interrupt leaves a store.
fn to_end(
    mut run: WearRun,
    mut store: WearStore,
    out: &Path,
    kept: &AtomicBool,
    shown: Display,
) -> Result<(), Failure> {
    let begun = Instant::now();
    let bar = bar(run.wear().cycles, shown == Display::Nothing);
    let mut reported = run.state().events.len();
    let mut step = || -> Option<Result<(), Error>> {
        let jump = match run.advance()? {
            Ok(jump) => jump,
            Err(error) => return Some(Err(error)),
        };
        let deepest = jump.depth[0].max(jump.depth[1]);
        bar.set_position(jump.cycles as u64);
        bar.set_message(format!("{:.3} um deep", 1e6 * deepest));
        for event in &run.state().events[reported..] {
            bar.suspend(|| print_message(&describe_event(event)));
        }
        reported = run.state().events.len();
        let written = store.write(&mut run);
        kept.store(
            written.is_ok() || kept.load(Ordering::Relaxed),
            Ordering::Relaxed,
        );
        Some(written)
    };
    let outcome = loop {
        match step() {
            None => break Ok(()),
            Some(Ok(())) => {}
            Some(Err(error)) => break Err(error),
        }
    };
    bar.finish_and_clear();
    let jumps = run.history();
    if jumps.is_empty() {
        return outcome.map_err(to_failure);
    }
    let status = outcome
        .as_ref()
        .map_or_else(ToString::to_string, |()| "done".to_owned());
    store.finish(&run, &status).map_err(to_failure)?;
    let mut printed = Ok(());
    if shown == Display::Json {
        let document = json!({ "jumps": jumps, "events": run.state().events, "status": status });
        printed = print(&pretty(document));
    }
    if shown == Display::Table {
        printed = table(jumps, &run.scene().grid).print();
        let seconds = begun.elapsed().as_secs_f64();
        print_message(&format!("{} jumps in {seconds:.1} s", jumps.len()));
    }
    outcome.map_err(|error| {
        print_message(&format!(
            "fret: what is done is kept in {}; `fret resume` goes on from there",
            out.display()
        ));
        Failure::EndedEarly(error)
    })?;
    printed
}

/// A bar over the cycles; none if `quiet`.
fn bar(cycles: f64, quiet: bool) -> ProgressBar {
    let bar = if quiet || !can_draw() {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(cycles as u64)
    };
    match ProgressStyle::with_template(TEMPLATE) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Converts an error to a failure with its exit code.
fn to_failure(error: Error) -> Failure {
    match error {
        Error::InvalidScene { .. } | Error::OffGrid { .. } | Error::TooLarge { .. } => {
            Failure::BadInput(error)
        }
        error => Failure::EndedEarly(error),
    }
}

/// An event in words: a coating worn through, or a depth reached.
fn describe_event(event: &Event) -> String {
    let body = event.body;
    let cycles = with_error(event.cycles, Some(event.cycles_error));
    let place_text = format!("at x = {}, y = {}", um(event.x), um(event.y));
    match event.kind {
        EventKind::Thinned => format!(
            "fret: after {cycles} cycles body {body} has lost a part of its coatings' thickness that \
             counts {place_text}: their response belongs to the whole thickness"
        ),
        EventKind::WornThrough => format!(
            "fret: after {cycles} cycles coating {} of body {body} is worn through {place_text}; the response \
             is still computed with the whole layer",
            event.coating + 1
        ),
    }
}

/// The largest pressure \[MPa\] with its error; none in partial slip on worn surfaces.
fn p_max(jump: &Jump) -> String {
    if jump.p_max_error.is_infinite() {
        "singular".to_owned()
    } else {
        let p = jump.p_max / 1e6;
        with_error(p, Some(jump.p_max_error * p))
    }
}

/// Depths and volumes of the last jump, and a line for every few jumps.
fn table(jumps: &[Jump], grid: &Grid) -> Page {
    let mut page = Page::new();
    let last = jumps.len() - 1;
    let end = &jumps[last];
    for body in (0..2).filter(|&body| end.volume[body] > 0.0) {
        let depth = 1e6 * end.depth[body];
        page.head(&format!(
            "body {}: {} um deep after {:.1} cycles",
            body + 1,
            with_error(depth, Some(end.depth_error * depth)),
            end.cycles
        ));
    }
    let every = jumps.len().div_ceil(20);
    let shown: Vec<&Jump> = (0..=last)
        .filter(|i| i % every == 0 || *i == last)
        .map(|i| &jumps[i])
        .collect();
    let column = |title: &str, unit: &str, cell: &dyn Fn(&Jump) -> String| Column {
        title: format!("{title}\n[{unit}]"),
        cells: shown.iter().map(|jump| cell(jump)).collect(),
    };
    let (volume, energy) = (grid.unit_of("m^3"), grid.unit_of("J"));
    let columns = [
        column("cycles", "1", &|j| format!("{:.1}", j.cycles)),
        column("depth1", "um", &|j| format!("{:.4}", 1e6 * j.depth[0])),
        column("depth2", "um", &|j| format!("{:.4}", 1e6 * j.depth[1])),
        column("error", "1", &|j| format!("{:.1e}", j.depth_error)),
        column("p_max", "MPa", &p_max),
        column("volume1", volume, &|j| format!("{:.4e}", j.volume[0])),
        column("volume2", volume, &|j| format!("{:.4e}", j.volume[1])),
        column("energy", energy, &|j| format!("{:.4e}", j.dissipated)),
    ];
    page.table(&columns, 1);
    page
}
