//! Lines that fit into the window.
//!
//! `textwrap` breaks lines between words. Here is where no line may end: between a number, its
//! symbol, its error and its unit.

use textwrap::{Options, WordSplitter};

/// Wraps the lines of a text that are wider than `width`.
#[must_use]
pub fn wrap_text(text: &str, width: usize) -> String {
    let lines = text.split('\n').flat_map(|line| wrap(line, width));
    lines.collect::<Vec<_>>().join("\n")
}

/// Lines of at most `width` characters; those that follow the first are two characters further in.
pub(crate) fn wrap(line: &str, width: usize) -> Vec<String> {
    let indent = line.len() - line.trim_start_matches(' ').len();
    if textwrap::core::display_width(line) <= width {
        return vec![line.to_owned()];
    }
    let indent = " ".repeat((indent + 2).min(width / 2));
    wrap_glued(line, options(width).subsequent_indent(&indent))
}

/// Lines of at most `width` characters, all of which begin behind `indent` spaces.
pub(crate) fn wrap_behind(line: &str, width: usize, indent: usize) -> Vec<String> {
    let indent = " ".repeat(indent);
    let options = options(width).initial_indent(&indent);
    wrap_glued(line, options.subsequent_indent(&indent))
}

/// A space within a number with its symbol, error and unit, where no line ends.
const GLUE: &str = "\u{a0}";
/// Units that stand behind a number.
const UNITS: [&str; 29] = [
    "%", "GB", "GPa", "Hz", "J", "K", "MB", "MPa", "N", "Pa", "W", "a_H", "cells", "cycles", "deg",
    "degrees", "kN", "m", "mJ", "mN", "mm", "nm", "p_H", "pm", "rad", "s", "uJ", "um", "µm",
];

/// Wraps a line between its words, not within `x = 1.5 +- 0.1 um`.
fn wrap_glued(line: &str, options: Options<'_>) -> Vec<String> {
    let mut words = line.split(' ');
    let mut text = words.next().unwrap_or_default().to_owned();
    for (before, word) in line.split(' ').zip(words) {
        let is_sign = |word: &str| ["=", "+-"].contains(&word);
        let is_unit = UNITS.contains(&word.trim_end_matches([',', ':', ';', ')', '.']))
            || word.contains(['/', '^']) && !word.starts_with('/');
        let is_number = before.ends_with(|c: char| c.is_ascii_digit());
        let is_whole = is_sign(before) || is_sign(word) || is_number && is_unit;
        text += if is_whole { GLUE } else { " " };
        text += word;
    }
    textwrap::wrap(&text, options)
        .iter()
        .map(|line| line.replace(GLUE, " "))
        .collect()
}

/// Words are broken if they are wider than a line, and never at the sign of a number.
fn options(width: usize) -> Options<'static> {
    Options::new(width).word_splitter(WordSplitter::NoHyphenation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_wrapped_between_words_and_numbers_stay_whole() {
        let line = "  stiffness (1.070 +- 0.011)e8 N/m and a shift of -3.5e-12 m beside a/very/long/name/of/a/file at 33.4 µm";
        for width in [40, 60] {
            let lines = wrap(line, width);
            assert!(
                lines.iter().all(|line| line.chars().count() <= width),
                "{lines:?}"
            );
            assert!(lines.iter().any(|line| line.contains("-3.5e-12 m")));
            assert!(
                lines
                    .iter()
                    .any(|line| line.contains("(1.070 +- 0.011)e8 N/m"))
            );
            assert!(lines.iter().any(|line| line.contains("33.4 µm")));
            assert!(lines[1].starts_with("    "));
        }
    }
}
