//! `fret run`.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use contact_core::estimate::{BranchEnds, ErrorMethod, choose_increments, error_bars};
use contact_core::march::{Increment, March, Observer, Reached, solve};
use contact_core::{Error, Scene};
use contact_store::{StoreWriter, write_error_bars, write_no_error_bars};

use crate::failure::Failure;
use crate::out::Out;
use crate::printed::print;
use crate::progress::Progress;
use crate::scene_options::{SceneOptions, warn_of_scene};
use crate::terminal::print_message;
use crate::threads::Threads;
use crate::{json, summary};

/// Options of `fret run`.
#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    out: Out,
    /// Run the path again on coarser and finer grids and with fewer increments, for some times as
    /// long, and give every headline number with the error that cells, increments and solver leave;
    /// `--error=coarser` takes coarser grids alone: about twice the time of the run, and larger
    /// errors
    #[arg(long, value_name = "GRIDS", num_args = 0..=1, require_equals = true, default_missing_value = "finer")]
    error: Option<Grids>,
    #[command(flatten)]
    manner: RunOptions,
}

/// The grids that errors come from.
#[derive(Clone, Copy, ValueEnum)]
enum Grids {
    /// Coarser grids and a finer one
    Finer,
    /// Coarser grids alone
    Coarser,
}

impl From<Grids> for ErrorMethod {
    fn from(grids: Grids) -> Self {
        match grids {
            Grids::Finer => Self::FinerGrid,
            Grids::Coarser => Self::CoarserGrids,
        }
    }
}

/// Options of a run, for any scene.
#[derive(Args)]
pub(crate) struct RunOptions {
    /// Bring the store and its checkpoint up to date every so many seconds of the run, and at the
    /// ends of branches: what a crash may lose
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = seconds)]
    checkpoint: Duration,
    #[command(flatten)]
    pub(crate) threads: Threads,
    /// Print the summary as one JSON object, for programs
    #[arg(long)]
    pub(crate) json: bool,
    /// A summary with the work of the solvers
    #[arg(long, conflicts_with_all = ["quiet", "json"])]
    pub(crate) wide: bool,
    /// Show neither progress nor summary; with --json the summary alone
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Reads a number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "must be a number of seconds")?;
    Duration::try_from_secs_f64(seconds).map_err(|_| "must be a number of seconds >= 0".into())
}

/// Runs through the load path into a store: the command `fret run`.
pub(crate) fn run(options: &Options) -> Result<(), Failure> {
    let out = &options.out.path;
    let scene = options.scene.read().map_err(Failure::BadInput)?;
    scene.check_fit().map_err(Failure::BadInput)?;
    warn_of_scene(&scene);
    let manner = &options.manner;
    manner.threads.set();
    let scene = choose_increments(&scene, &Arc::default()).map_err(to_failure)?;
    let writer = StoreWriter::create(out, options.out.overwrite).map_err(Failure::BadInput)?;
    let (mut increments, mut tractions) = (Vec::new(), Vec::new());
    let held = options.error.is_some() && manner.json;
    let stop = manner.watch(&scene, out, writer, Vec::new(), held, |watcher| {
        let mut ends = BranchEnds::new(watcher);
        increments = solve(&scene, &mut ends)?;
        tractions = ends.tractions;
        Ok(increments.clone())
    })?;
    if let Some(grids) = options.error {
        match error_bars(&scene, &increments, &tractions, grids.into(), &stop) {
            Ok(bars) => {
                write_error_bars(out, &bars).map_err(to_failure)?;
                if manner.json {
                    print(&json::pretty(json::run_to_json(
                        &scene,
                        &increments,
                        Some(&bars),
                    )))?;
                } else if !manner.quiet {
                    summary::error_table(&scene, &increments, &bars).print()?;
                }
            }
            Err(stopped @ Error::Interrupted { .. }) => return Err(to_failure(stopped)),
            Err(why) => {
                let doubt = write_no_error_bars(out, &why).map_err(to_failure)?;
                if manner.json {
                    print(&json::pretty(json::run_to_json(&scene, &increments, None)))?;
                }
                print_message(&format!("fret: warning: {doubt}"));
            }
        }
    }
    Ok(())
}

impl RunOptions {
    /// Runs a scene into the store `out`, which holds `increments` already, and prints how the run
    /// ended. Returns the flag that Ctrl-C raises. If `held`, the summary is printed only if the
    /// run fails, since error bars are added to it later.
    pub(crate) fn watch(
        &self,
        scene: &Scene,
        out: &Path,
        writer: StoreWriter,
        increments: Vec<Increment>,
        held: bool,
        run: impl FnOnce(&mut dyn Observer) -> Result<Vec<Increment>, Error>,
    ) -> Result<Arc<AtomicBool>, Failure> {
        let begun = Instant::now();
        let kept = Arc::new(AtomicBool::new(!increments.is_empty()));
        let mut watcher = Watcher {
            writer: writer.with_interval(self.checkpoint),
            progress: Progress::new(scene, self.quiet),
            stop: stop_on_interrupt(&kept),
            kept,
            increments,
        };
        let outcome = run(&mut watcher);
        let Watcher {
            writer,
            progress,
            increments,
            stop,
            ..
        } = watcher;
        progress.end();
        let mut printed = Ok(());
        let later = held && outcome.is_ok();
        if (!self.quiet || self.json) && !increments.is_empty() && !later {
            printed = if self.json {
                print(&json::pretty(json::run_to_json(scene, &increments, None)))
            } else {
                summary::table(scene, &increments, self.wide).print()
            };
            if !self.quiet {
                print_message(&summary::describe_time(
                    begun.elapsed(),
                    writer.checkpoints(),
                ));
            }
        }
        if outcome.is_ok() {
            for doubt in Reached::from_increments(&increments).doubts(scene) {
                print_message(&format!("fret: warning: {doubt}"));
            }
        }
        let stop = outcome.map(|_| stop).map_err(|error| {
            let kept = writer.kept();
            if kept > 0 {
                print_message(&format!(
                    "fret: {kept} of {} increments are kept in {}; `fret resume` goes on from there",
                    scene.path.increments(),
                    out.display()
                ));
            }
            to_failure(error)
        })?;
        printed.map(|()| stop)
    }
}

/// Converts an error to a failure with its exit code.
fn to_failure(error: Error) -> Failure {
    match error {
        Error::InvalidScene { .. }
        | Error::OffGrid { .. }
        | Error::GridTooSmall { .. }
        | Error::TooLarge { .. } => Failure::BadInput(error),
        error => Failure::EndedEarly(error),
    }
}

/// Passes every increment to the store and to the progress, and stops the run on request.
struct Watcher {
    writer: StoreWriter,
    progress: Progress,
    stop: Arc<AtomicBool>,
    /// True if an increment is kept.
    kept: Arc<AtomicBool>,
    increments: Vec<Increment>,
}

impl Observer for Watcher {
    /// Passes the increment to the store, and advances the bar.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.increments.push(*increment);
        self.kept.store(true, Ordering::Relaxed);
        self.writer.on_increment(march, increment)?;
        self.progress.on_increment(&self.increments);
        if self.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted {
                increment: increment.index,
            });
        }
        Ok(())
    }

    /// Passes the end of the run to the store.
    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.writer.on_end(march, failure)
    }

    /// The flag that Ctrl-C raises.
    fn stop(&self) -> Option<Arc<AtomicBool>> {
        Some(self.stop.clone())
    }
}

/// A flag that the first Ctrl-C raises; the second ends the process. While no increment is kept,
/// the first one ends the process, and nothing is written.
pub(crate) fn stop_on_interrupt(kept: &Arc<AtomicBool>) -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let (flag, kept) = (stop.clone(), kept.clone());
    let handler = move || {
        if !kept.load(Ordering::Relaxed) {
            print_message("fret: stopped before the first increment");
            std::process::exit(1);
        }
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(1);
        }
        print_message("fret: stopping (Ctrl-C again: at once)");
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        print_message(&format!("fret: Ctrl-C will end the run at once: {error}"));
    }
    stop
}
