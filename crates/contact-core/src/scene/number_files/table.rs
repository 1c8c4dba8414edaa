//! Text to rows of numbers.

use std::borrow::Cow;

use super::field::{Separator, is_missing, parse_number};

/// A table of text: comments, titles, rows of numbers.
#[derive(Debug, Default)]
pub(in crate::scene) struct Table {
    /// Lines that begin with #, without it.
    pub(in crate::scene) comments: Vec<String>,
    /// Lines before the first number in which no field is one.
    pub(super) titles: Vec<Vec<String>>,
    /// The numbers, row by row; NaN where there is none.
    pub(in crate::scene) numbers: Vec<f64>,
    /// Numbers in a row.
    pub(in crate::scene) columns: usize,
    /// The line of each row, from 1.
    pub(in crate::scene) lines: Vec<usize>,
}

/// Lines of a text that are not empty, without comments.
pub(super) struct Lines<'a> {
    pub(super) comments: Vec<String>,
    pub(super) lines: Vec<(usize, &'a str)>,
}

impl<'a> Lines<'a> {
    /// Splits a text into comments (without `#`) and lines with their numbers; empty lines are left out.
    pub(super) fn split(text: &'a str) -> Self {
        let mark = if text.contains('\n') { '\n' } else { '\r' };
        let (mut comments, mut lines) = (Vec::new(), Vec::new());
        for (n, line) in text.split(mark).enumerate() {
            // A tab at an end separates an empty field.
            let line = line.trim_matches([' ', '\r', '\u{c}', '\u{a0}', '\u{feff}']);
            if let Some(comment) = line.trim_start().strip_prefix('#') {
                comments.push(comment.trim().to_owned());
            } else if !line.trim().is_empty() {
                lines.push((n + 1, line));
            }
        }
        Self { comments, lines }
    }
}

impl Table {
    /// Parses a table; the error gives line, column and the text found there.
    pub(in crate::scene) fn parse(text: &str) -> Result<Self, String> {
        let Lines { comments, lines } = Lines::split(text);
        let parting = Separator::detect(&lines);
        let mut table = Self {
            comments,
            ..Self::default()
        };
        let (mut blank_ends, mut signs) = (true, DecimalSigns::default());
        let mut remaining = lines.as_slice();
        while let Some((&(_, line), after)) = remaining.split_first() {
            let fields = parting.fields(line);
            let is_number = |field: &Cow<'_, str>| parse_number(field).is_some();
            let words = fields.iter().filter(|field| !is_missing(field));
            if words.clone().next().is_none() || words.clone().any(is_number) {
                break;
            }
            let titles = fields.into_iter().map(Cow::into_owned).collect();
            table.titles.push(match parting {
                Separator::Blanks => join_units(titles),
                Separator::Mark(_) => titles,
            });
            remaining = after;
        }
        for &(n, line) in remaining {
            let fields = parting.fields(line);
            if table.lines.is_empty() {
                table.columns = fields.len();
            } else if fields.len() != table.columns {
                return Err(format!(
                    "line {n} has {} numbers: must have {}, as line {}",
                    fields.len(),
                    table.columns,
                    table.lines[0]
                ));
            }
            for (column, field) in fields.iter().enumerate() {
                signs.check(n, field)?;
                let number =
                    parse_number(field).ok_or_else(|| no_number_message(n, column, field))?;
                table.numbers.push(number);
            }
            blank_ends &= fields.last().is_some_and(|field| field.is_empty());
            table.lines.push(n);
        }
        // A mark at the end of every line separates nothing.
        if blank_ends && table.columns > 1 {
            table.remove_last_column();
        }
        Ok(table)
    }

    /// Returns the lines of titles; without any the last comment, if it has a word for each column, as
    /// NumPy writes them.
    pub(in crate::scene) fn titles(&self) -> Vec<Vec<String>> {
        if !self.titles.is_empty() {
            return self.titles.clone();
        }
        let to_strings = |words: Vec<&str>| words.into_iter().map(ToOwned::to_owned).collect();
        let has_all_columns = |words: &Vec<String>| words.len() == self.columns;
        let split_at_marks = |comment: &String| -> Vec<String> {
            to_strings(comment.split([',', ';', '\t']).map(str::trim).collect())
        };
        let split_at_blanks = |comment: &String| -> Vec<String> {
            join_units(to_strings(comment.split_whitespace().collect()))
        };
        let last = self.comments.last();
        let words = last.map(split_at_marks).filter(has_all_columns);
        words
            .or(last.map(split_at_blanks).filter(has_all_columns))
            .into_iter()
            .collect()
    }

    /// Number of rows.
    pub(in crate::scene) fn rows(&self) -> usize {
        self.lines.len()
    }

    /// A column, from 0.
    pub(in crate::scene) fn column(&self, n: usize) -> impl Iterator<Item = f64> {
        self.numbers
            .iter()
            .skip(n)
            .step_by(self.columns.max(1))
            .copied()
    }

    /// Removes the last column, of numbers and of titles.
    fn remove_last_column(&mut self) {
        let columns = self.columns;
        self.remove_column(columns - 1);
        for titles in &mut self.titles {
            titles.truncate(columns - 1);
        }
    }

    /// Removes the first column, of numbers and of titles.
    pub(super) fn remove_first_column(&mut self) {
        let columns = self.columns;
        self.remove_column(0);
        for titles in &mut self.titles {
            if titles.len() == columns {
                titles.remove(0);
            }
        }
    }

    /// Removes the numbers of a column.
    fn remove_column(&mut self, column: usize) {
        let columns = self.columns;
        let mut index = 0;
        self.numbers.retain(|_| {
            index += 1;
            (index - 1) % columns != column
        });
        self.columns -= 1;
    }
}

/// Joins each title of a line split at blanks with the unit in brackets after it.
fn join_units(words: Vec<String>) -> Vec<String> {
    let mut titles: Vec<String> = Vec::with_capacity(words.len());
    for word in words {
        match titles.last_mut() {
            Some(title) if word.starts_with(['[', '(']) => {
                title.push(' ');
                title.push_str(&word);
            }
            _ => titles.push(word),
        }
    }
    titles
}

/// Message for a text in place of a number.
pub(super) fn no_number_message(line: usize, column: usize, field: &str) -> String {
    let shown: String = field.chars().take(40).collect();
    format!(
        "line {line}, column {}: `{shown}` is no number. A line of titles holds no number, a comment begins \
         with #, and a point that was not measured is empty or nan",
        column + 1
    )
}

/// Lines of the first decimal point and of the first decimal comma: a file may have only one of the two.
#[derive(Default)]
pub(super) struct DecimalSigns {
    point: Option<usize>,
    comma: Option<usize>,
}

impl DecimalSigns {
    /// Notes the decimal sign of a field; fails if the table has both points and commas.
    pub(super) fn check(&mut self, line: usize, field: &str) -> Result<(), String> {
        if field.contains('.') && !is_missing(field) {
            self.point.get_or_insert(line);
        } else if field.contains(',') {
            self.comma.get_or_insert(line);
        } else {
            return Ok(());
        }
        match (self.point, self.comma) {
            (Some(point), Some(comma)) => Err(format!(
                "line {point} has decimal points and line {comma} decimal commas: must have one of them, and \
                 nothing between thousands"
            )),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn tables_are_read_whatever_parts_their_numbers() {
        for text in [
            "1,2.5\n3,-4e-1\n",
            "x,y\n1,2.5\n3,-4e-1\n",
            "x;y\nmm;um\n1;2,5\n3;-0,4\n",
            "1;2.5;\n3;-0.4;\n",
            "# heights in m\n1\t2.5\r\n3\t-0.4\r\n",
            "  1   2.5\n  3  -0.4\n\n",
            "1 2,5\n3 -0,4\n",
            "\"1\",2.5\n3,-.4",
            "\"1\",\"2,5\"\n3,\"-0,4\"",
            "1 2.5\r3 -0.4\r",
            "1,2.5\n3,\u{2212}0.4",
        ] {
            let table = Table::parse(text).unwrap_or_else(|e| panic!("{text:?}: {e}"));
            assert_eq!((table.rows(), table.columns), (2, 2), "{text:?}");
            assert_eq!(table.numbers, [1.0, 2.5, 3.0, -0.4], "{text:?}");
        }
        let holes = Table::parse("nan,,\n1,2,\n3,nan,\n").expect("holes");
        assert_eq!((holes.rows(), holes.columns), (3, 2));
        assert_eq!(holes.numbers.iter().filter(|z| z.is_nan()).count(), 3);
        let tabs = Table::parse("1\t2\t3\n\t4\t\n").expect("holes at both ends");
        assert!(tabs.numbers[3].is_nan() && tabs.numbers[4] == 4.0 && tabs.numbers[5].is_nan());
    }

    #[test]
    fn texts_in_place_of_numbers_are_named() {
        for (text, part) in [
            ("1,2\n3,four\n", "line 2, column 2: `four` is no number"),
            ("7 8 z\n1 2 3\n", "line 1, column 3: `z` is no number"),
            (
                "a,b\n1,2\n3\n",
                "line 3 has 1 numbers: must have 2, as line 2",
            ),
            (
                "a,b\n1,2\nmm,mm\n3,4\n",
                "line 3, column 1: `mm` is no number",
            ),
            ("1,2\n3,inf\n", "`inf` is no number"),
            (
                "1;0.5\n2;0,5\n",
                "line 1 has decimal points and line 2 decimal commas",
            ),
        ] {
            let message = Table::parse(text).expect_err(text);
            assert!(message.contains(part), "{message}");
        }
        assert_eq!(Table::parse("").expect("nothing").rows(), 0);
    }
}
