//! How a command that failed ends.

use std::io::IsTerminal;

use clap::builder::styling::AnsiColor;
use contact_core::Error;

use crate::terminal::say;

/// How a command that failed ends.
pub(crate) enum Failure {
    /// The run ended early; what it had is kept.
    EndedEarly(Error),
    /// The scene or the command line has no meaning.
    BadInput(Error),
    /// Ctrl-C, and nothing is kept.
    Stopped,
}

impl Failure {
    pub(crate) fn report(&self) -> u8 {
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
        code
    }
}
