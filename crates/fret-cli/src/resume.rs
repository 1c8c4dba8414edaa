//! `fret resume`.

use std::path::PathBuf;

use clap::Args;
use contact_core::output::{Resumed, resume as take_up};

use crate::failure::Failure;
use crate::run::Manner;
use crate::terminal::say;

/// Options of `fret resume`.
#[derive(Args)]
pub(crate) struct Options {
    /// Result store of the run that ended early
    store: PathBuf,
    #[command(flatten)]
    manner: Manner,
}

/// Goes on with a run.
pub(crate) fn resume(options: &Options) -> Result<(), Failure> {
    options.manner.use_threads();
    let Some(Resumed {
        march,
        writer,
        increments,
    }) = take_up(&options.store, None).map_err(Failure::BadInput)?
    else {
        say(&format!("fret: {} is done", options.store.display()));
        return Ok(());
    };
    let scene = march.scene().clone();
    let before = increments.clone();
    options
        .manner
        .watch(&scene, &options.store, writer, increments, |watcher| {
            march.run(before, watcher)
        })
        .map(drop)
}
