//! `fret new`: a commented scene to begin with.

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use contact_core::Error;

use crate::failure::Failure;
use crate::printed::print;
use crate::terminal::print_message;

/// Options of `fret new`.
#[derive(Args)]
pub(crate) struct Options {
    /// Name of the scene
    template: Template,
    /// File to write; it must not exist (default: the standard output)
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// The scenes to start from.
#[derive(Clone, Copy, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Template {
    /// Steel ball on a steel flat under a tangential force
    UncoatedBall,
    /// Ball on a flat with two layers
    CoatedBall,
    /// Cylinder on a flat in plane strain with a bulk stress
    Cylinder,
    /// Flat punch on a rough flat
    Rough,
    /// Ball on a flat under a given shift
    Displacement,
    /// Ball on a multilayer
    ManyLayers,
    /// Ball on a coated flat over many cycles, for `fret wear`
    Wear,
}

impl Template {
    /// The text of this example.
    fn text(self) -> &'static str {
        match self {
            Self::UncoatedBall => include_str!("../templates/uncoated_ball.toml"),
            Self::CoatedBall => include_str!("../templates/coated_ball.toml"),
            Self::Cylinder => include_str!("../templates/cylinder.toml"),
            Self::Rough => include_str!("../templates/rough.toml"),
            Self::Displacement => include_str!("../templates/displacement.toml"),
            Self::ManyLayers => include_str!("../templates/many_layers.toml"),
            Self::Wear => include_str!("../templates/wear.toml"),
        }
    }
}

/// Name of the schema in the first line of each scene, which editors read.
const SCHEMA_FILE: &str = "scene.schema.json";

/// Writes an example of a scene file: the command `fret new`.
pub(crate) fn new(options: &Options) -> Result<(), Failure> {
    let text = options.template.text();
    let Some(out) = &options.out else {
        return print(text.trim_end());
    };
    let written = File::create_new(out).and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|e| {
        Failure::BadInput(Error::File {
            path: out.display().to_string(),
            message: e.to_string(),
        })
    })?;
    print_message(&format!(
        "fret: {} is written; fret check {0} explains it; fret schema -o {} lets editors complete it",
        out.display(),
        out.with_file_name(SCHEMA_FILE).display()
    ));
    Ok(())
}
