//! Failures of a command and their exit codes.

use contact_core::Error;

use crate::terminal::print_error;

/// A failure of a command.
pub(crate) enum Failure {
    /// The run ended early; its increments so far are kept.
    EndedEarly(Error),
    /// The scene or the command line is not valid.
    BadInput(Error),
    /// Number of doubts about a scene; none is allowed.
    Doubted(usize),
    /// Ctrl-C; nothing is kept.
    Stopped,
    /// The output could not be written.
    Unwritten(Error),
}

impl Failure {
    /// Prints the error and returns the exit code.
    pub(crate) fn report(&self) -> u8 {
        let (error, code) = match self {
            Self::EndedEarly(error) => (error.to_string(), 1),
            Self::BadInput(error) => (error.to_string(), 2),
            Self::Unwritten(error) => (error.to_string(), 3),
            Self::Doubted(doubts) => (format!("{doubts} of its values are doubtful (--strict)"), 1),
            Self::Stopped => ("stopped, nothing was written".to_owned(), 1),
        };
        error.lines().for_each(print_error);
        code
    }
}
