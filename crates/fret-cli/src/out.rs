//! The place of the result of a command.

use std::path::PathBuf;

use clap::Args;

/// The place of the result of a command.
#[derive(Args)]
pub(crate) struct Out {
    /// Result store to write (a Zarr folder)
    #[arg(id = "out", short, long = "out", value_name = "STORE")]
    pub(crate) path: PathBuf,
    /// Replace a result store that exists
    #[arg(long)]
    pub(crate) overwrite: bool,
}
