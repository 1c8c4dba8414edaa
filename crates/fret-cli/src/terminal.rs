//! Messages on the standard error, and the width and abilities of the terminal.

use std::io::{self, IsTerminal, Write};

use clap::ColorChoice;
use clap::builder::styling::{AnsiColor, Style};
use contact_core::shown;
use terminal_size::{Width, terminal_size_of};

use crate::wrapping::wrap;

/// Columns of results that go to a file or a pipe.
const USUAL: usize = 80;
/// Columns that are used at least.
const LEAST: usize = 40;
/// Columns of help at most.
const HELP: usize = 100;

/// Columns of a line of results: COLUMNS, else the window, else 80.
pub(crate) fn result_width() -> usize {
    let window = || window(terminal_size_of(io::stdout()));
    named_width().or_else(window).unwrap_or(USUAL).max(LEAST)
}

/// Columns of a line of help.
pub(crate) fn help_width() -> usize {
    result_width().min(HELP)
}

/// Columns of a line of messages: COLUMNS, else the window. In a file each message is one line,
/// which can be searched for.
pub(crate) fn message_width() -> Option<usize> {
    let window = || window(terminal_size_of(io::stderr()));
    let usual = || io::stderr().is_terminal().then_some(USUAL);
    let width = named_width().or_else(window).or_else(usual)?;
    Some(width.max(LEAST))
}

/// Columns that the variable COLUMNS names.
fn named_width() -> Option<usize> {
    let text = std::env::var("COLUMNS").ok()?;
    text.parse().ok().filter(|width| *width > 0)
}

/// The width of a terminal in characters; none if it is unknown or zero.
fn window(size: Option<(Width, terminal_size::Height)>) -> Option<usize> {
    size.map(|(Width(width), _)| usize::from(width))
        .filter(|width| *width > 0)
}

/// Writes a line to the standard error; escapes of the terminal are shown as text. A failure is
/// ignored.
pub(crate) fn print_message(line: &str) {
    let warning = AnsiColor::Yellow.on_default().bold();
    match line.strip_prefix("fret: warning:") {
        Some(text) => print_marked("fret: warning:", warning, text),
        None => print_marked("", Style::new(), line),
    }
}

/// Writes the line of an error.
pub(crate) fn print_error(line: &str) {
    print_marked(
        "fret:",
        AnsiColor::Red.on_default().bold(),
        &format!(" {line}"),
    );
}

/// Writes a line that begins with a mark, which has a colour on a terminal.
fn print_marked(mark: &str, style: Style, line: &str) {
    let lines = wrap_message(&shown(&format!("{mark}{line}")));
    let coloured = io::stderr().is_terminal() && colours() != ColorChoice::Never;
    let text = match lines.strip_prefix(mark) {
        Some(text) if coloured => format!("{style}{mark}{style:#}{text}"),
        _ => lines,
    };
    let _ = writeln!(io::stderr(), "{text}");
}

/// Wraps a message to the window.
pub(crate) fn wrap_message(text: &str) -> String {
    let Some(width) = message_width() else {
        return text.to_owned();
    };
    let lines = text.lines().flat_map(|line| wrap(line, width));
    lines.collect::<Vec<_>>().join("\n")
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

/// Checks that results go to a terminal with colours.
pub(crate) fn results_are_coloured() -> bool {
    io::stdout().is_terminal() && colours() != ColorChoice::Never
}

/// Checks that standard error is a terminal that moves its cursor, on which a bar can be drawn.
pub(crate) fn can_draw() -> bool {
    io::stderr().is_terminal() && follows_codes()
}

/// Checks that the terminal follows escape codes.
fn follows_codes() -> bool {
    cfg!(windows) || std::env::var_os("TERM").is_some_and(|term| !term.is_empty() && term != "dumb")
}
