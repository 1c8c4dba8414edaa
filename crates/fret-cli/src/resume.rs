//! `fret resume`.

use std::path::PathBuf;

use clap::Args;
use contact_core::Error;
use contact_store::{Resumed, WearStore, resume as take_up};

use crate::failure::Failure;
use crate::run::RunOptions;
use crate::terminal::print_message;
use crate::wear;

/// Options of `fret resume`.
#[derive(Args)]
pub(crate) struct Options {
    /// Result store of the run that ended early
    store: PathBuf,
    #[command(flatten)]
    manner: RunOptions,
}

/// Continues the run of a store: the command `fret resume`.
pub(crate) fn resume(options: &Options) -> Result<(), Failure> {
    let manner = &options.manner;
    manner.threads.set();
    if WearStore::is_at(&options.store) {
        if manner.json || manner.wide {
            let allowed = "for runs through a load path; this store is one of wear";
            return Err(Failure::BadInput(Error::invalid(
                "option",
                if manner.json { "--json" } else { "--wide" },
                allowed,
            )));
        }
        let shown = if manner.quiet {
            wear::Display::Nothing
        } else {
            wear::Display::Table
        };
        return wear::resume(&options.store, None, shown);
    }
    let Some(Resumed {
        march,
        writer,
        increments,
    }) = take_up(&options.store, None).map_err(Failure::BadInput)?
    else {
        print_message(&format!("fret: {} is done", options.store.display()));
        return Ok(());
    };
    let scene = march.scene().clone();
    let before = increments.clone();
    manner
        .watch(
            &scene,
            &options.store,
            writer,
            increments,
            false,
            |watcher| march.run(before, watcher),
        )
        .map(drop)
}
