//! Changes of good files into bad ones.

use proptest::prelude::*;

/// Numbers at the ends of what a number may be, and beyond.
const NUMBERS: [&str; 24] = [
    "0",
    "-1",
    "1",
    "2",
    "3",
    "7",
    "64",
    "65537",
    "9223372036854775807",
    "99999999999999999999",
    "0.5",
    "0.4999999",
    "-0.9999999",
    "1e-9",
    "1e9",
    "1e75",
    "1e-75",
    "1e308",
    "-1e308",
    "1e-320",
    "5e-324",
    "nan",
    "inf",
    "-inf",
];
/// Scraps of the formats.
const SCRAPS: [&str; 24] = [
    "=", "[", "]]", "\"", "{", "}", "[[path]]", "\n", ".", "é", "true", "a_H", "#", "'''", "T_x",
    "null", ",", ":", "(", ")", "\u{0}", "flat", "sum", "../",
];

/// One change of a file.
#[derive(Clone, Debug)]
pub(crate) enum Change {
    /// The n-th number becomes another.
    Number(usize, &'static str),
    /// Some bytes give way to a scrap.
    Scrap(usize, usize, &'static str),
    /// A byte gets another value.
    Byte(usize, u8),
    /// The rest is gone.
    Cut(usize),
    /// A line is moved to another place, and stays where it was.
    Line(usize, usize),
}

pub(crate) fn change() -> impl Strategy<Value = Change> {
    use proptest::sample::select;
    let place = || any::<u32>().prop_map(|n| n as usize);
    prop_oneof![
        6 => (place(), select(&NUMBERS)).prop_map(|(n, text)| Change::Number(n, text)),
        3 => (place(), 0..6_usize, select(&SCRAPS)).prop_map(|(n, l, text)| Change::Scrap(n, l, text)),
        2 => (place(), any::<u8>()).prop_map(|(n, byte)| Change::Byte(n, byte)),
        1 => place().prop_map(Change::Cut),
        1 => (place(), place()).prop_map(|(n, to)| Change::Line(n, to)),
    ]
}

/// Applies a change; places count round.
pub(crate) fn apply(bytes: &mut Vec<u8>, change: &Change) {
    let length = bytes.len().max(1);
    match *change {
        Change::Number(n, text) => {
            let numbers = numbers(bytes);
            if let Some(place) = numbers.get(n % numbers.len().max(1)) {
                bytes.splice(place.clone(), text.bytes());
            }
        }
        Change::Scrap(n, removed, text) => {
            let from = n % length;
            let to = (from + removed).min(bytes.len());
            bytes.splice(from.min(to)..to, text.bytes());
        }
        Change::Byte(n, byte) => {
            if let Some(place) = bytes.get_mut(n % length) {
                *place = byte;
            }
        }
        Change::Cut(n) => bytes.truncate(n % length),
        Change::Line(n, to) => {
            let mut lines: Vec<_> = bytes.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
            let line = lines[n % lines.len()].clone();
            lines.insert(to % lines.len(), line);
            *bytes = lines.join(&b'\n');
        }
    }
}

/// Where numbers stand.
fn numbers(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut n = 0;
    while n < bytes.len() {
        let word = n > 0 && (bytes[n - 1].is_ascii_alphabetic() || bytes[n - 1] == b'_');
        if bytes[n].is_ascii_digit() && !word {
            let part = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'e' | b'-' | b'+');
            let length = bytes[n..].iter().take_while(|b| part(b)).count();
            found.push(n..n + length);
            n += length;
        } else {
            n += 1;
        }
    }
    found
}
