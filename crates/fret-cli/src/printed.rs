//! Results on the standard output.

use std::io::{self, ErrorKind, Write};

use contact_core::{Error, shown};

use crate::failure::Failure;

/// Writes to the standard output, what would act on the terminal as escapes. That nobody reads on is no failure, a full disk is one.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    written(writeln!(out, "{}", shown(text)).and_then(|()| out.flush()))
}

/// Outcome of writing to the standard output.
pub(crate) fn written(result: io::Result<()>) -> Result<(), Failure> {
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
