//! What the commands say: results on the standard output, all else on the standard error.

use std::io::Write;

/// Writes a line to the standard error; if nobody listens, nobody is told.
pub(crate) fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Writes to the standard output, the same way.
pub(crate) fn print(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}
