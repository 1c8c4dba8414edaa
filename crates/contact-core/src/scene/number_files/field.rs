//! Fields of a line of text, and the numbers in them.

use std::borrow::Cow;

/// Separator of the fields of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    /// One character.
    Mark(char),
    /// Any number of blanks and tabs.
    Blanks,
}

/// Lines at either end of a text from which the separator is determined.
const SAMPLE_LINES: usize = 100;

impl Separator {
    /// Detects the separator that splits most lines into two or more numbers. Blanks come before commas,
    /// which between digits may be decimal commas.
    pub(super) fn detect(lines: &[(usize, &str)]) -> Self {
        let order = [
            Self::Mark(';'),
            Self::Mark('\t'),
            Self::Blanks,
            Self::Mark(','),
        ];
        let first_lines = lines.iter().take(SAMPLE_LINES);
        let first_and_last_lines =
            first_lines.chain(lines.iter().skip(SAMPLE_LINES).rev().take(SAMPLE_LINES));
        let sample: Vec<&str> = first_and_last_lines.map(|(_, line)| *line).collect();
        let score = |parting: &Self| {
            let (mut good_lines, mut numbers, mut other_numbers) = (0, 0, 0);
            for line in &sample {
                let (mut fields, mut numeric) = (0, 0);
                for field in parting.fields(line) {
                    fields += 1;
                    numeric += usize::from(parse_number(&field).is_some());
                }
                if fields > 1 && numeric == fields {
                    good_lines += 1;
                    numbers += numeric;
                } else if fields > 1 {
                    other_numbers += numeric;
                }
            }
            (
                good_lines,
                numbers,
                if good_lines == 0 { other_numbers } else { 0 },
            )
        };
        // The first of the best.
        let best = order.into_iter().rev().max_by_key(score);
        best.unwrap_or(Self::Blanks)
    }

    /// Splits a line into its fields; a field in quotes may hold the mark.
    pub(super) fn fields(self, line: &str) -> Vec<Cow<'_, str>> {
        let mark = match self {
            Self::Blanks => return line.split_whitespace().map(unquote).collect(),
            Self::Mark(mark) => mark,
        };
        if !line.contains('"') {
            return line.split(mark).map(|field| field.trim().into()).collect();
        }
        let (mut fields, mut begin, mut quoted) = (Vec::new(), 0, false);
        for (position, c) in line.char_indices() {
            if c == '"' {
                quoted = !quoted;
            } else if c == mark && !quoted {
                fields.push(unquote(&line[begin..position]));
                begin = position + c.len_utf8();
            }
        }
        fields.push(unquote(&line[begin..]));
        fields
    }
}

/// Removes the blanks and the quotes around a field.
fn unquote(field: &str) -> Cow<'_, str> {
    field.trim().trim_matches('"').trim().into()
}

/// Words for a number that was not measured.
const MISSING: [&str; 20] = [
    "",
    "nan",
    "-nan",
    "na",
    "n/a",
    "#n/a",
    "#na",
    "null",
    "none",
    "bad",
    "nodata",
    "-",
    "--",
    "---",
    "*",
    "***",
    "nan(ind)",
    "-nan(ind)",
    "1.#qnan",
    "-1.#ind",
];

/// Whether the field stands for a missing number.
pub(super) fn is_missing(field: &str) -> bool {
    field.len() <= 9 && MISSING.iter().any(|word| field.eq_ignore_ascii_case(word))
}

/// Parses a field: NaN for a number that was not measured, `None` for anything but a finite number. The
/// decimal sign may be a comma, the minus sign typographic, the exponent one of Fortran.
pub(super) fn parse_number(field: &str) -> Option<f64> {
    // Letters alone, such as `infinity`, are no number.
    let digits = field.bytes().any(|b| b.is_ascii_digit());
    if !digits {
        return is_missing(field).then_some(f64::NAN);
    }
    if let Ok(number) = field.parse::<f64>() {
        return Some(number).filter(|number| number.is_finite());
    }
    if is_missing(field) {
        return Some(f64::NAN);
    }
    let mut plain = field.replace(['\u{2212}', '\u{2013}'], "-");
    if let Some(comma) = plain.find(',') {
        let digit = |at: Option<usize>| plain.as_bytes().get(at?).filter(|b| b.is_ascii_digit());
        digit(comma.checked_sub(1)).and(digit(Some(comma + 1)))?;
        plain.replace_range(comma..=comma, ".");
    }
    let exponent = plain.rfind(['D', 'd']);
    if let Some(at) = exponent {
        plain.replace_range(at..=at, "e");
    } else if let Some(at) = plain.rfind(['+', '-'])
        && plain[..at].contains('.')
        && plain.len() - at == 4
        && plain.as_bytes()[at - 1].is_ascii_digit()
    {
        plain.insert(at, 'e');
    }
    plain
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::{Separator, parse_number};

    #[test]
    fn numbers_are_read_as_they_are_written() {
        for (field, value) in [
            ("1.5", 1.5),
            ("-.5", -0.5),
            ("1,5", 1.5),
            ("+2,5E-3", 2.5e-3),
            ("1.5D-06", 1.5e-6),
            ("1.5d+2", 150.0),
            ("1.5-106", 1.5e-106),
            ("\u{2212}2", -2.0),
        ] {
            assert_eq!(parse_number(field), Some(value), "{field}");
        }
        for field in ["", "NaN", "n/a", "--", "-1.#IND"] {
            assert!(parse_number(field).is_some_and(f64::is_nan), "{field}");
        }
        for field in [
            "z",
            "1.234,5",
            "1,234.5",
            "12:30",
            "2024-05-06",
            "inf",
            "1e999",
            "1,",
            ",5",
            "2-3",
            "e5",
            "0x10",
        ] {
            assert_eq!(parse_number(field), None, "{field}");
        }
    }

    #[test]
    fn lines_are_parted_by_what_parts_numbers() {
        use Separator::{Blanks, Mark};
        for (line, parting) in [
            ("1,2", Mark(',')),
            ("1, 2", Mark(',')),
            ("1 ,2", Mark(',')),
            ("0,5 1,5", Blanks),
            ("0,5;1,5", Mark(';')),
            ("0,5\t1,5", Mark('\t')),
            ("1\t\t2", Mark('\t')),
            ("  1  2", Blanks),
            ("\"1,5\",\"2,5\"", Mark(',')),
        ] {
            assert_eq!(
                Separator::detect(&[(1, "height, of 3 May"), (2, line)]),
                parting,
                "{line}"
            );
        }
    }
}
