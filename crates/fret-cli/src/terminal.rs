//! What the commands say on the standard error, and what the terminal shows.

use std::io::{self, IsTerminal, Write};

use clap::ColorChoice;

/// Writes a line to the standard error; if nobody listens, nobody is told.
pub(crate) fn say(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Colours for people who have not declined them (<https://no-color.org>), on terminals that show them.
pub(crate) fn colours() -> ColorChoice {
    let declined = std::env::var_os("NO_COLOR").is_some_and(|word| !word.is_empty());
    if follows_codes() && !declined {
        ColorChoice::Auto
    } else {
        ColorChoice::Never
    }
}

/// Whether standard error is a terminal that moves its cursor, on which a bar can be drawn.
pub(crate) fn draws() -> bool {
    io::stderr().is_terminal() && follows_codes()
}

/// Whether the terminal follows escape codes.
fn follows_codes() -> bool {
    cfg!(windows) || std::env::var_os("TERM").is_some_and(|term| !term.is_empty() && term != "dumb")
}
