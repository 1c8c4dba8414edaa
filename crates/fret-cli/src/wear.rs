//! `fret wear`.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use clap::Args;
use contact_core::Error;
use contact_core::output::{WearStore, resume_wear};
use contact_core::scene::Reach;
use contact_core::wear::{Event, EventKind, Jump, Wear, WearRun};
use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::Failure;
use crate::run::stop_on_interrupt;
use crate::scene_options::SceneOptions;
use crate::terminal::{print, say};

const TEMPLATE: &str = "{bar:20} {pos}/{len} cycles, {elapsed} elapsed, {eta} left  {msg}";

/// Options of `fret wear`.
#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// Result store to write (a Zarr folder)
    #[arg(short, long, value_name = "STORE")]
    out: PathBuf,
    /// Replace a result store that exists
    #[arg(long)]
    overwrite: bool,
    /// Go on with a run of this scene that ended early, in its store
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Show neither progress nor summary
    #[arg(short, long)]
    quiet: bool,
}

/// Wears the surfaces of a scene.
pub(crate) fn wear(options: &Options) -> Result<(), Failure> {
    let kept = Arc::new(AtomicBool::new(options.resume));
    let stop = stop_on_interrupt(&kept);
    let reach = if options.scene.allow_outside {
        Reach::Anywhere
    } else {
        Reach::Folder
    };
    let read = Wear::from_file(&options.scene.scene, &options.scene.settings, reach);
    let (scene, wear) = read.map_err(Failure::BadInput)?;
    let (mut run, mut store) = if options.resume {
        let found = resume_wear(&options.out, Some((&scene, &wear)), &stop);
        let Some(found) = found.map_err(Failure::BadInput)? else {
            say(&format!("fret: {} is done", options.out.display()));
            return Ok(());
        };
        found
    } else {
        let store =
            WearStore::create(&options.out, options.overwrite).map_err(Failure::BadInput)?;
        (WearRun::new(&scene, &wear, &stop).map_err(ended)?, store)
    };
    let begun = Instant::now();
    let bar = if options.quiet {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(run.wear().cycles as u64)
    };
    if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
        bar.set_style(style);
    }
    let mut told = run.state().events.len();
    let outcome = loop {
        match run.advance() {
            None => break Ok(()),
            Some(Err(error)) => break Err(error),
            Some(Ok(jump)) => {
                bar.set_position(jump.cycles as u64);
                bar.set_message(format!(
                    "{:.3} um deep",
                    1e6 * jump.depth[0].max(jump.depth[1])
                ));
                for event in &run.state().events[told..] {
                    bar.suspend(|| say(&told_of(event)));
                }
                told = run.state().events.len();
                if let Err(error) = store.write(&mut run) {
                    break Err(error);
                }
                kept.store(true, Ordering::Relaxed);
            }
        }
    };
    bar.finish_and_clear();
    let status = outcome
        .as_ref()
        .err()
        .map_or("done".to_owned(), ToString::to_string);
    if !run.history().is_empty() {
        store.finish(&run, &status).map_err(ended)?;
        if !options.quiet {
            print(&table(run.history()));
            say(&format!(
                "{} jumps in {:.1} s",
                run.history().len(),
                begun.elapsed().as_secs_f64()
            ));
        }
    }
    outcome.map_err(|error| {
        if !run.history().is_empty() {
            let out = options.out.display();
            say(&format!(
                "fret: what is done is kept in {out}; `fret wear ... --resume` goes on from there"
            ));
        }
        ended(error)
    })
}

/// What an error means for the exit code.
fn ended(error: Error) -> Failure {
    match error {
        Error::InvalidScene { .. } | Error::OffGrid { .. } | Error::TooLarge { .. } => {
            Failure::BadInput(error)
        }
        error => Failure::EndedEarly(error),
    }
}

fn told_of(event: &Event) -> String {
    let (body, cycles) = (event.body, event.cycles);
    let place = format!("at x = {:.3e} m, y = {:.3e} m", event.x, event.y);
    match event.kind {
        EventKind::Thinned => format!(
            "fret: after {cycles:.0} cycles body {body} has lost a part of its coatings' thickness that \
             counts {place}: their response is that of the whole thickness"
        ),
        EventKind::WornThrough => format!(
            "fret: after {cycles:.0} cycles coating {} of body {body} is worn through {place}; the response \
             stays that of the whole layer",
            event.coating
        ),
    }
}

/// A line for every few jumps.
fn table(jumps: &[Jump]) -> String {
    let mut lines = vec![format!(
        "{:>12} {:>11} {:>11} {:>12} {:>12} {:>12} {:>10} {:>8}",
        "cycles",
        "depth1 um",
        "depth2 um",
        "volume1 m3",
        "volume2 m3",
        "energy J",
        "p_max MPa",
        "error"
    )];
    let every = jumps.len().div_ceil(20);
    let last = jumps.len() - 1;
    for (i, j) in jumps
        .iter()
        .enumerate()
        .filter(|(i, _)| i % every == 0 || *i == last)
    {
        let _ = i;
        lines.push(format!(
            "{:12.1} {:11.4} {:11.4} {:12.4e} {:12.4e} {:12.4e} {:10.1} {:8.1e}",
            j.cycles,
            1e6 * j.depth[0],
            1e6 * j.depth[1],
            j.volume[0],
            j.volume[1],
            j.dissipated,
            j.p_max / 1e6,
            j.depth_error
        ));
    }
    lines.join("\n")
}
