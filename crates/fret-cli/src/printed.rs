//! Results on the standard output: for programs as they are, for people by [`crate::layout`].

use std::io::{self, ErrorKind, Write};

use contact_core::{Error, shown};

use crate::failure::Failure;

/// Writes to the standard output; escapes of the terminal are shown as text. A closed pipe is no
/// failure, a full disk is one.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    check_written(writeln!(out, "{}", shown(text)).and_then(|()| out.flush()))
}

/// Writes lines of text and of this program's own codes of colours to the standard output.
pub(crate) fn write_lines(lines: &[String]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let written = lines.iter().try_for_each(|line| writeln!(out, "{line}"));
    check_written(written.and_then(|()| out.flush()))
}

/// Converts the outcome of writing to the standard output: a closed pipe is no failure.
pub(crate) fn check_written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Unwritten(Error::File {
                path: "standard output".into(),
                message: error.to_string(),
            }))
        }
        _ => Ok(()),
    }
}
