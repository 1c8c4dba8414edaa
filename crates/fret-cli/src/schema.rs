//! `fret schema`: the JSON Schema of the scene file, with which editors complete and check scenes.

use std::path::PathBuf;

use clap::Args;
use contact_core::Error;

use crate::failure::Failure;
use crate::printed::print;

/// The JSON Schema (draft 7) of the scene file: keys, units, ranges, defaults, one sentence each. A
/// test compares its keys and defaults with the reader.
const SCHEMA: &str = include_str!("scene.schema.json");

/// Options of `fret schema`.
#[derive(Args)]
pub(crate) struct Options {
    /// File to write (default: the standard output)
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Prints or writes the schema; a file at that place is replaced.
pub(crate) fn write_schema(options: &Options) -> Result<(), Failure> {
    let Some(out) = &options.out else {
        return print(SCHEMA.trim_end());
    };
    std::fs::write(out, SCHEMA).map_err(|e| {
        Failure::BadInput(Error::File {
            path: out.display().to_string(),
            message: e.to_string(),
        })
    })
}
