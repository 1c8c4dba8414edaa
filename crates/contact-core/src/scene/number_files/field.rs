//! Fields of a line of text, and the numbers in them.

use std::borrow::Cow;

/// The separator of the fields of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parting {
    /// One character.
    Mark(char),
    /// Any number of blanks and tabs.
    Blanks,
}

/// Lines at either end of a text from which the separator is determined.
const SAMPLE: usize = 100;

impl Parting {
    /// What parts most of the lines into numbers, two or more in each. Blanks come before commas,
    /// which between digits may be decimal ones.
    pub(super) fn of(lines: &[(usize, &str)]) -> Self {
        let order = [
            Self::Mark(';'),
            Self::Mark('\t'),
            Self::Blanks,
            Self::Mark(','),
        ];
        let ends = lines.iter().take(SAMPLE);
        let ends = ends.chain(lines.iter().skip(SAMPLE).rev().take(SAMPLE));
        let sample: Vec<&str> = ends.map(|(_, line)| *line).collect();
        let score = |parting: &Self| {
            let (mut whole, mut numbers, mut rest) = (0, 0, 0);
            for line in &sample {
                let (mut fields, mut good) = (0, 0);
                for field in parting.fields(line) {
                    fields += 1;
                    good += usize::from(number(&field).is_some());
                }
                if fields > 1 && good == fields {
                    whole += 1;
                    numbers += good;
                } else if fields > 1 {
                    rest += good;
                }
            }
            (whole, numbers, if whole == 0 { rest } else { 0 })
        };
        // The first of the best.
        let best = order.into_iter().rev().max_by_key(score);
        best.unwrap_or(Self::Blanks)
    }

    /// The fields of a line; one in quotes may hold the mark.
    pub(super) fn fields(self, line: &str) -> Vec<Cow<'_, str>> {
        let mark = match self {
            Self::Blanks => return line.split_whitespace().map(unquoted).collect(),
            Self::Mark(mark) => mark,
        };
        if !line.contains('"') {
            return line.split(mark).map(|field| field.trim().into()).collect();
        }
        let (mut fields, mut begin, mut quoted) = (Vec::new(), 0, false);
        for (at, c) in line.char_indices() {
            if c == '"' {
                quoted = !quoted;
            } else if c == mark && !quoted {
                fields.push(unquoted(&line[begin..at]));
                begin = at + c.len_utf8();
            }
        }
        fields.push(unquoted(&line[begin..]));
        fields
    }
}

/// A field without the blanks and the quotes around it.
fn unquoted(field: &str) -> Cow<'_, str> {
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

/// Whether the field says that there is no number.
pub(super) fn is_missing(field: &str) -> bool {
    field.len() <= 9 && MISSING.iter().any(|word| field.eq_ignore_ascii_case(word))
}

/// The number of a field, NaN for one that was not measured; `None` if it is no finite number. The
/// decimal sign may be a comma, the minus sign that of typesetting, the exponent one of Fortran.
pub(super) fn number(field: &str) -> Option<f64> {
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
    use super::{Parting, number};

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
            assert_eq!(number(field), Some(value), "{field}");
        }
        for field in ["", "NaN", "n/a", "--", "-1.#IND"] {
            assert!(number(field).is_some_and(f64::is_nan), "{field}");
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
            assert_eq!(number(field), None, "{field}");
        }
    }

    #[test]
    fn lines_are_parted_by_what_parts_numbers() {
        use Parting::{Blanks, Mark};
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
                Parting::of(&[(1, "height, of 3 May"), (2, line)]),
                parting,
                "{line}"
            );
        }
    }
}
