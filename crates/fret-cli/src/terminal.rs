//! Messages on the standard error, and the abilities of the terminal.

use std::io::{self, IsTerminal, Write};

use clap::ColorChoice;
use contact_core::shown;

/// Writes a line to the standard error; escapes of the terminal are shown as text. A failure is
/// ignored.
pub(crate) fn print_message(line: &str) {
    print_coloured(&shown(line));
}

/// Writes a line with codes of colours, made by this program.
pub(crate) fn print_coloured(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Colours, unless declined (<https://no-color.org>), on terminals that support them.
pub(crate) fn colours() -> ColorChoice {
    let declined = std::env::var_os("NO_COLOR").is_some_and(|word| !word.is_empty());
    if follows_codes() && !declined {
        ColorChoice::Auto
    } else {
        ColorChoice::Never
    }
}

/// Checks that standard error is a terminal that moves its cursor, on which a bar can be drawn.
pub(crate) fn can_draw() -> bool {
    io::stderr().is_terminal() && follows_codes()
}

/// Checks that the terminal follows escape codes.
fn follows_codes() -> bool {
    cfg!(windows) || std::env::var_os("TERM").is_some_and(|term| !term.is_empty() && term != "dumb")
}
