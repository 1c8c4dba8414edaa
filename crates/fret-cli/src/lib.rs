//! `fret`: fretting contact of coated bodies from the command line.
//!
//! It reads a scene file, hands it to `contact_core` and prints the results; it computes nothing
//! itself. The binary `fret` and the Python package, which contains the command, call
//! [`run_command`].

#![forbid(unsafe_code)]

mod answer_memory;
mod check;
mod failure;
mod json;
mod largest;
pub mod layout;
mod life;
mod loads;
mod new;
mod out;
mod printed;
mod progress;
mod python;
mod quantity;
mod resume;
mod run;
mod scene_options;
mod schema;
mod stress;
mod summary;
mod terminal;
mod threads;
mod units;
mod wear;
mod words;
pub mod wrapping;

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::path::PathBuf;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand};
use contact_core::Error;

use crate::failure::Failure;
use crate::printed::{check_written, print};
use crate::terminal::{colours, help_width, wrap_message};

/// Fretting contact of elastic bodies, homogeneous or coated.
#[derive(Parser)]
#[command(name = "fret", version, after_help = EXIT_CODES, styles = STYLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done; 1 the run ended early, everything so far is kept. \
                          2 bad scene or bad command line, nothing was written; 3 what was to be printed \
                          could not be written, such as to a full disk";

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

#[derive(Subcommand)]
enum Command {
    // Scenes and their solution.
    /// Write a commented scene to begin with
    New(new::Options),
    /// Write the JSON Schema of the scene file, for editors that complete and check keys
    Schema(schema::Options),
    /// Say what a scene means and what its solution needs; solve nothing
    Check(check::Options),
    /// Run through the load path of a scene and write a result store
    Run(run::Options),
    /// Go on with a run that ended early, through a load path or over cycles of wear; the result is
    /// the same as without the interruption, bit by bit
    Resume(resume::Options),
    // Commands on a result.
    /// Stress below the contact of a result: its largest values, and files of it
    Stress(stress::Options),
    /// Judge the stress below the contact of a result over a cycle by a fatigue criterion
    Life(life::Options),
    /// Sum the fatigue damage of a measured load history below a contact (needs the Python package)
    Damage(python::Options),
    /// Say whether a crack below the contact of a result grows or stops (needs the Python package)
    Crack(python::Options),
    /// Wear the surfaces of a scene with a table [wear] over many cycles
    Wear(wear::Options),
    /// Write a result as one page for a browser (needs the Python package)
    Report(python::Options),
    /// Write tractions, forces on a mesh or stress at points for another program (needs the Python
    /// package)
    Export(python::Options),
    /// Print a result as a table, or write it as text or for Excel (needs the Python package)
    Table(python::Options),
    // Many runs.
    /// Open a page that answers while parameters are dragged (needs the Python package)
    Explore(python::Options),
    /// Open the workbench in a browser: contact, answers, variants, measured files, reports (needs
    /// the Python package)
    Workbench(python::Options),
    /// Solve a scene for many values of its parameters (needs the Python package)
    Study(python::Options),
    /// Put bodies side by side in one scene, such as several coatings (needs the Python package)
    Compare(python::Options),
    /// Find the load at which a fatigue criterion reaches its limit (needs the Python package)
    Threshold(python::Options),
    /// Find unknowns of a scene (mu, a rig, a coating, wear) from a measured table (needs the
    /// Python package)
    Fit(python::Options),
    /// Print what a file is: format, units, axes, size, what is read of it, doubts (needs the Python
    /// package)
    Info(python::Options),
    // The program itself.
    /// Check this installation against closed forms in minutes (needs the Python package)
    Verify(python::Options),
    /// Print what to cite for a result (needs the Python package)
    Cite(python::Options),
    /// Write the completions of a shell to the standard output
    Completions {
        /// Name of the shell
        shell: clap_complete::Shell,
    },
    /// Write the manual pages, one per command, into a folder
    Man {
        /// Folder; it is made if it does not exist
        folder: PathBuf,
    },
}

/// Runs the command that the arguments name, the first of them being the program's name. Returns
/// the exit code: 0 done, 1 the run ended early, 2 bad scene or bad command line, 3 the output
/// could not be written.
pub fn run_command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let _ = survive_size_limit();
    let parsed = Cli::command()
        .color(colours())
        .term_width(help_width())
        .try_get_matches_from(arguments);
    let cli = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => {
            let printed = check_written(print_usage(&error));
            let code = u8::try_from(error.exit_code()).unwrap_or(2);
            return printed.map_or_else(|failure| failure.report(), |()| code);
        }
    };
    let outcome = match cli.command {
        Command::New(options) => new::new(&options),
        Command::Schema(options) => schema::write_schema(&options),
        Command::Run(options) => run::run(&options),
        Command::Resume(options) => resume::resume(&options),
        Command::Check(options) => check::check(&options),
        Command::Stress(options) => stress::stress(&options),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "fret", &mut script);
            print(String::from_utf8_lossy(&script).trim_end())
        }
        Command::Man { folder } => manual(&folder),
        Command::Wear(options) => wear::wear(&options),
        Command::Study(options) => return in_python("study", &options.arguments),
        Command::Explore(options) => return in_python("explore", &options.arguments),
        Command::Workbench(options) => return in_python("workbench", &options.arguments),
        Command::Compare(options) => return in_python("compare", &options.arguments),
        Command::Life(options) => life::life(&options),
        Command::Export(options) => return in_python("export", &options.arguments),
        Command::Damage(options) => return in_python("damage", &options.arguments),
        Command::Crack(options) => return in_python("crack", &options.arguments),
        Command::Report(options) => return in_python("report", &options.arguments),
        Command::Fit(options) => return in_python("fit", &options.arguments),
        Command::Threshold(options) => return in_python("threshold", &options.arguments),
        Command::Table(options) => return in_python("table", &options.arguments),
        Command::Info(options) => return in_python("info", &options.arguments),
        Command::Verify(options) => return in_python("verify", &options.arguments),
        Command::Cite(options) => return in_python("cite", &options.arguments),
    };
    match outcome {
        Ok(()) => 0,
        Err(failure) => failure.report(),
    }
}

/// Prints help or version, or the fault in the command line.
fn print_usage(error: &clap::Error) -> std::io::Result<()> {
    if !error.use_stderr() {
        return error.print().and_then(|()| std::io::stdout().flush());
    }
    let coloured = std::io::stderr().is_terminal() && colours() != ColorChoice::Never;
    let text = error.render();
    let text = if coloured {
        text.ansi().to_string()
    } else {
        text.to_string()
    };
    writeln!(std::io::stderr(), "{}", wrap_message(text.trim_end()))
}

/// Keeps the process alive at a limit of file sizes (`ulimit -f`): the writing that passes it fails
/// with an error instead, which names the file.
#[cfg(unix)]
fn survive_size_limit() -> std::io::Result<()> {
    const SIGXFSZ: i32 = 25;
    signal_hook::flag::register(SIGXFSZ, std::sync::Arc::default()).map(|_| ())
}

/// Other systems have no limit of file sizes.
#[cfg(not(unix))]
fn survive_size_limit() -> std::io::Result<()> {
    Ok(())
}

/// Runs the command of the Python package and returns its exit code.
fn in_python(command: &str, arguments: &[OsString]) -> u8 {
    python::run(command, arguments).unwrap_or_else(|failure| failure.report())
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
