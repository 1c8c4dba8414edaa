//! Text of others, as it is shown: what would act on a screen stands as an escape.

use std::borrow::Cow;
use std::fmt::Write as _;

/// A text without control codes and without marks that turn the direction of reading: these stand
/// as `\u001b`, `\u202e`, as in JSON, which stays JSON. Lines stay lines, and tabs tabs.
///
/// Everything that a person reads and that holds a title or a name goes through here: output on a
/// terminal, summaries, errors, progress bars, reports, figures.
pub fn shown(text: &str) -> Cow<'_, str> {
    if !text.chars().any(acts) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        // Writing to a String does not fail.
        if acts(c) {
            for unit in c.encode_utf16(&mut [0; 2]) {
                let _ = write!(escaped, "\\u{unit:04x}");
            }
        } else {
            escaped.push(c);
        }
    }
    Cow::Owned(escaped)
}

/// Whether a character acts on what shows it: controls (C0, C1, delete), marks of direction and
/// isolates, separators of lines and paragraphs, characters without width, tags.
fn acts(c: char) -> bool {
    matches!(c,
        '\0'..='\u{8}' | '\u{b}'..='\u{1f}' | '\u{7f}'..='\u{9f}'
        | '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
        | '\u{e0000}'..='\u{e007f}'
    )
}

/// Characters of a text from outside that a message repeats.
const LONGEST_ECHO: usize = 200;

/// A text from outside as a message repeats it: the first 200 characters, with the
/// number of the characters that are left out.
///
/// # Examples
///
/// ```
/// use contact_core::abridge;
///
/// assert_eq!(abridge("friction.mu"), "friction.mu");
/// assert!(abridge(&"k".repeat(5000)).ends_with("kk... (4800 more characters)"));
/// ```
pub fn abridge(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(LONGEST_ECHO) {
        None => Cow::Borrowed(text),
        Some((end, _)) => {
            let omitted = text[end..].chars().count();
            Cow::Owned(format!("{}... ({omitted} more characters)", &text[..end]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn what_acts_on_a_screen_is_escaped() {
        assert_eq!(
            shown("a\u{1b}[2J\u{1b}]0;owned\u{7}b\u{202e}c\rd\u{9b}e"),
            r"a\u001b[2J\u001b]0;owned\u0007b\u202ec\u000dd\u009be"
        );
        assert_eq!(shown("µ, τ, 接触\n\tq"), "µ, τ, 接触\n\tq");
    }
}
