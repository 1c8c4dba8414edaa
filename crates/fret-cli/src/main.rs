//! `fret`: fretting contact of coated bodies from the command line.
//!
//! It reads a scene file, hands it to `contact_core` and shows what comes back; it computes
//! nothing itself.

#![forbid(unsafe_code)]

mod check;
mod json;
mod loads;
mod new;
mod progress;
mod resume;
mod run;
mod stress;
mod summary;
mod wear;

use std::io::{IsTerminal, Read, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, CommandFactory, Parser, Subcommand};
use contact_core::scene::Reach;
use contact_core::{Error, Scene};

/// Fretting contact of elastic bodies, homogeneous or coated.
#[derive(Parser)]
#[command(name = "fret", version, after_help = EXIT_CODES, styles = STYLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done; 1 the run ended early, everything so far is kept; \
                          2 bad scene or bad command line, nothing was written";

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

#[derive(Subcommand)]
enum Command {
    /// Write a commented scene to begin with
    New(new::Options),
    /// Run through the load path of a scene and write a result store
    Run(run::Options),
    /// Go on with a run that ended early; the result is that of the uninterrupted run, bit by bit
    Resume(resume::Options),
    /// Say what a scene means and what its solution needs; solve nothing
    Check(check::Options),
    /// Stress below the contact of a result: its largest values, and files of it
    Stress(stress::Options),
    /// Write the completions of a shell to the standard output
    Completions {
        /// Which shell
        shell: clap_complete::Shell,
    },
    /// Write the manual pages, one per command, into a folder
    Man {
        /// Folder; it is made if it does not exist
        folder: PathBuf,
    },
    /// Wear the surfaces of a scene with a table [wear] over many cycles
    Wear(wear::Options),
}

/// A scene file and what is changed in it.
#[derive(Args)]
struct SceneOptions {
    /// Scene file (TOML); - reads it from the standard input
    scene: PathBuf,
    /// Replace a value of the scene file, such as friction.mu=0.5 or
    /// body2.coatings.0.E.E_substrate=4
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    /// Let the scene name files outside its own folder
    #[arg(long)]
    allow_outside: bool,
}

impl SceneOptions {
    fn read(&self) -> Result<Scene, Error> {
        let reach = if self.allow_outside {
            Reach::Anywhere
        } else {
            Reach::Folder
        };
        if self.scene.as_os_str() == "-" {
            let mut text = String::new();
            std::io::stdin()
                .read_to_string(&mut text)
                .map_err(|e| Error::File {
                    path: "standard input".into(),
                    message: e.to_string(),
                })?;
            return Scene::from_toml_str_reaching(&text, "standard input", &self.settings, reach);
        }
        Scene::from_file_reaching(&self.scene, &self.settings, reach)
    }
}

/// How a command that failed ends.
enum Failure {
    /// The run ended early; what it had is kept.
    EndedEarly(Error),
    /// The scene or the command line has no meaning.
    BadInput(Error),
    /// Ctrl-C, and nothing is kept.
    Stopped,
}

impl Failure {
    fn report(&self) -> ExitCode {
        let (error, code) = match self {
            Self::EndedEarly(error) => (error.to_string(), 1),
            Self::BadInput(error) => (error.to_string(), 2),
            Self::Stopped => ("stopped, nothing was written".to_owned(), 1),
        };
        let stderr = std::io::stderr();
        // Colours for people, plain text for files and pipes (https://no-color.org).
        let coloured = stderr.is_terminal() && std::env::var_os("NO_COLOR").is_none();
        let red = AnsiColor::Red.on_default().bold();
        if coloured {
            say(&format!("{red}fret:{red:#} {error}"));
        } else {
            say(&format!("fret: {error}"));
        }
        ExitCode::from(code)
    }
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::New(options) => new::new(&options),
        Command::Run(options) => run::run(&options),
        Command::Resume(options) => resume::resume(&options),
        Command::Check(options) => check::check(&options),
        Command::Stress(options) => stress::stress(&options),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "fret", &mut script);
            print(String::from_utf8_lossy(&script).trim_end());
            Ok(())
        }
        Command::Man { folder } => manual(&folder),
        Command::Wear(options) => wear::wear(&options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Writes the manual pages.
fn manual(folder: &std::path::Path) -> Result<(), Failure> {
    let written = std::fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(Cli::command(), folder));
    written.map_err(|e| {
        Failure::BadInput(Error::File {
            path: folder.display().to_string(),
            message: e.to_string(),
        })
    })
}

/// Says what is allowed in a scene but hardly meant.
fn say_doubts(scene: &Scene) {
    for doubt in scene.doubts() {
        say(&format!("fret: warning: {doubt}"));
    }
}

/// Writes a line to the standard error; if nobody listens, nobody is told.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Writes to the standard output, the same way.
fn print(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}
