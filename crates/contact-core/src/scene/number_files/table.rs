//! Text to rows of numbers.

use std::borrow::Cow;

use super::field::{Parting, is_missing, number};

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

/// The lines of a text with something in them, comments apart.
pub(super) struct Lines<'a> {
    pub(super) comments: Vec<String>,
    pub(super) lines: Vec<(usize, &'a str)>,
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let mark = if text.contains('\n') { '\n' } else { '\r' };
        let (mut comments, mut lines) = (Vec::new(), Vec::new());
        for (n, line) in text.split(mark).enumerate() {
            // A tab at an end parts a field that is empty.
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
    /// The table of a text; the error names line, column and what was found there.
    pub(in crate::scene) fn of(text: &str) -> Result<Self, String> {
        let Lines { comments, lines } = Lines::of(text);
        let parting = Parting::of(&lines);
        let mut table = Self {
            comments,
            ..Self::default()
        };
        let (mut blank_ends, mut signs) = (true, Signs::default());
        let mut rest = lines.as_slice();
        while let Some((&(_, line), after)) = rest.split_first() {
            let fields = parting.fields(line);
            let is_number = |field: &Cow<'_, str>| number(field).is_some();
            let words = fields.iter().filter(|field| !is_missing(field));
            if words.clone().next().is_none() || words.clone().any(is_number) {
                break;
            }
            let owned = fields.into_iter().map(Cow::into_owned).collect();
            table.titles.push(match parting {
                Parting::Blanks => with_units(owned),
                Parting::Mark(_) => owned,
            });
            rest = after;
        }
        for &(n, line) in rest {
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
                signs.see(n, field)?;
                let number = number(field).ok_or_else(|| no_number(n, column, field))?;
                table.numbers.push(number);
            }
            blank_ends &= fields.last().is_some_and(|field| field.is_empty());
            table.lines.push(n);
        }
        // A mark at the end of every line parts nothing.
        if blank_ends && table.columns > 1 {
            table.leave_out_last_column();
        }
        Ok(table)
    }

    /// Lines of titles; where there are none the last comment, if it has a word for each column:
    /// NumPy writes them so.
    pub(in crate::scene) fn titles(&self) -> Vec<Vec<String>> {
        if !self.titles.is_empty() {
            return self.titles.clone();
        }
        let owned = |words: Vec<&str>| words.into_iter().map(ToOwned::to_owned).collect();
        let fits = |words: &Vec<String>| words.len() == self.columns;
        let parted = |comment: &String| -> Vec<String> {
            owned(comment.split([',', ';', '\t']).map(str::trim).collect())
        };
        let blanks = |comment: &String| -> Vec<String> {
            with_units(owned(comment.split_whitespace().collect()))
        };
        let last = self.comments.last();
        let words = last.map(parted).filter(fits);
        words
            .or(last.map(blanks).filter(fits))
            .into_iter()
            .collect()
    }

    /// Rows.
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

    fn leave_out_last_column(&mut self) {
        let columns = self.columns;
        self.leave_out(columns - 1);
        for titles in &mut self.titles {
            titles.truncate(columns - 1);
        }
    }

    pub(super) fn leave_out_first_column(&mut self) {
        let columns = self.columns;
        self.leave_out(0);
        for titles in &mut self.titles {
            if titles.len() == columns {
                titles.remove(0);
            }
        }
    }

    /// Leaves the numbers of a column out.
    fn leave_out(&mut self, column: usize) {
        let columns = self.columns;
        let mut place = 0;
        self.numbers.retain(|_| {
            place += 1;
            (place - 1) % columns != column
        });
        self.columns -= 1;
    }
}

/// Titles that blanks part, each together with the unit in brackets after it.
fn with_units(words: Vec<String>) -> Vec<String> {
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

/// The text in place of a number.
pub(super) fn no_number(line: usize, column: usize, field: &str) -> String {
    let shown: String = field.chars().take(40).collect();
    format!(
        "line {line}, column {}: `{shown}` is no number. A line of titles holds no number, a comment begins \
         with #, and a point that was not measured is empty or nan",
        column + 1
    )
}

/// The line of the first decimal point and of the first decimal comma: only one of the two is one.
#[derive(Default)]
pub(super) struct Signs {
    point: Option<usize>,
    comma: Option<usize>,
}

impl Signs {
    pub(super) fn see(&mut self, line: usize, field: &str) -> Result<(), String> {
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
            let table = Table::of(text).unwrap_or_else(|e| panic!("{text:?}: {e}"));
            assert_eq!((table.rows(), table.columns), (2, 2), "{text:?}");
            assert_eq!(table.numbers, [1.0, 2.5, 3.0, -0.4], "{text:?}");
        }
        let holes = Table::of("nan,,\n1,2,\n3,nan,\n").expect("holes");
        assert_eq!((holes.rows(), holes.columns), (3, 2));
        assert_eq!(holes.numbers.iter().filter(|z| z.is_nan()).count(), 3);
        let tabs = Table::of("1\t2\t3\n\t4\t\n").expect("holes at both ends");
        assert!(tabs.numbers[3].is_nan() && tabs.numbers[4] == 4.0 && tabs.numbers[5].is_nan());
    }

    #[test]
    fn what_is_no_number_is_named() {
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
            let told = Table::of(text).expect_err(text);
            assert!(told.contains(part), "{told}");
        }
        assert_eq!(Table::of("").expect("nothing").rows(), 0);
    }
}
