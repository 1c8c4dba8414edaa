//! Lines and columns that number the lines and columns of a table: spreadsheets write them beside the numbers.

use super::table::Table;

/// Titles of a column that numbers the lines, in small letters: pandas, R.
const INDEX: [&str; 4] = ["", "index", "unnamed: 0", "rownames"];
/// Lines or columns from which on a line that counts is no accident.
const FEWEST: usize = 3;

impl Table {
    /// Leaves out an index that can be recognized: a first column that counts, below an empty
    /// title, and a first line that counts, beside it. A column below an empty title that does not count fails.
    pub(super) fn leave_out_index(&mut self) -> Result<(), String> {
        let (rows, columns) = (self.rows(), self.columns);
        if columns < 2 || rows < 1 {
            return Ok(());
        }
        let first: Vec<f64> = self.column(0).collect();
        let line: Vec<f64> = self.numbers[..columns].to_vec();
        let index_title = |titles: &Vec<String>| {
            let (head, other_titles) = match titles.len() {
                n if n == columns => (titles[0].trim().to_lowercase(), &titles[1..]),
                // R writes no title above it.
                n if n + 1 == columns => (String::new(), &titles[..]),
                _ => return None,
            };
            let is_index = INDEX.contains(&head.as_str())
                && other_titles.iter().all(|title| !title.trim().is_empty());
            is_index.then_some(head)
        };
        if let Some(head) = self.titles.iter().find_map(index_title) {
            if counts_from_0_or_1(&first) {
                self.remove_first_column();
            } else if head.is_empty() && self.titles.iter().any(|titles| titles.len() == columns) {
                return Err(format!(
                    "column 1 has no title, where the other {} have one. An index is no height: leave it out, as \
                     to_csv(index=False) does, or give it a title",
                    columns - 1
                ));
            }
            return Ok(());
        }
        let has_empty_corner =
            self.titles.is_empty() && line[0].is_nan() && rows > 1 && columns > 2;
        if has_empty_corner && !line[1..].iter().chain(&first[1..]).any(|n| n.is_nan()) {
            if counts_from_0_or_1(&line[1..]) && counts_from_0_or_1(&first[1..]) {
                self.remove_first_column();
                self.numbers.drain(..columns - 1);
                self.lines.remove(0);
            } else if is_increasing(&line[1..]) && is_increasing(&first[1..]) {
                return Err(
                    "line 1 and column 1, which meet in an empty field, are places and no heights. Leave them out, \
                     and give the distance of the points with spacing"
                        .into(),
                );
            }
        }
        Ok(())
    }

    /// Fails if one line or one column of a map counts and no other does.
    pub(super) fn check_no_index(&self) -> Result<(), String> {
        let (rows, columns) = (self.rows(), self.columns);
        if rows < FEWEST || columns < FEWEST {
            return Ok(());
        }
        let only_the_first_counts = |lists: &[Vec<f64>]| {
            counts_from_0_or_1(&lists[0]) && !lists[1..].iter().any(|other| has_steps_of_one(other))
        };
        let column_numbers: Vec<Vec<f64>> =
            (0..columns).map(|n| self.column(n).collect()).collect();
        if only_the_first_counts(&column_numbers) {
            return Err(format!(
                "column 1 counts the {rows} lines: an index is no height; leave it out, as to_csv(index=False) does"
            ));
        }
        let line_numbers: Vec<Vec<f64>> =
            self.numbers.chunks(columns).map(<[f64]>::to_vec).collect();
        if only_the_first_counts(&line_numbers) {
            return Err(format!(
                "line {} counts the {columns} columns: titles are no heights; leave them out, as to_csv(header=False) \
                 does",
                self.lines[0]
            ));
        }
        Ok(())
    }
}

/// Whether numbers count from 0 or 1.
fn counts_from_0_or_1(numbers: &[f64]) -> bool {
    numbers.first().is_some_and(|n| *n == 0.0 || *n == 1.0) && has_steps_of_one(numbers)
}

/// Whether each number is the one before plus one.
fn has_steps_of_one(numbers: &[f64]) -> bool {
    numbers.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
}

/// Whether each number is larger than the one before.
fn is_increasing(numbers: &[f64]) -> bool {
    numbers.windows(2).all(|pair| pair[1] > pair[0])
}

#[cfg(test)]
mod tests {
    use super::super::table::Table;

    #[test]
    fn an_index_is_left_out_or_named() {
        let read = |text: &str| {
            let mut table = Table::parse(text).expect(text);
            table.leave_out_index()?;
            table.check_no_index()?;
            Ok::<_, String>((table.rows(), table.columns, table.numbers))
        };
        let heights = vec![0.5, 1.5, 2.5, 3.5, 4.5, 7.5];
        for text in [
            ",a,b\n0,.5,1.5\n1,2.5,3.5\n2,4.5,7.5\n",
            "\"\",\"V1\",\"V2\"\n\"1\",.5,1.5\n\"2\",2.5,3.5\n\"3\",4.5,7.5\n",
            "\"V1\" \"V2\"\n\"1\" .5 1.5\n\"2\" 2.5 3.5\n\"3\" 4.5 7.5\n",
            ";a;b\n0;0,5;1,5\n1;2,5;3,5\n2;4,5;7,5\n",
            "\ta\tb\n0\t.5\t1.5\n1\t2.5\t3.5\n2\t4.5\t7.5\n",
            "Unnamed: 0,a,b\n0,.5,1.5\n1,2.5,3.5\n2,4.5,7.5\n",
            ",0,1\n0,.5,1.5\n1,2.5,3.5\n2,4.5,7.5\n",
            ".5,1.5\n2.5,3.5\n4.5,7.5\n",
        ] {
            assert_eq!(read(text), Ok((3, 2, heights.clone())), "{text}");
        }
        for (text, part) in [
            (",a,b\n.1,.5,1.5\n.2,2.5,3.5\n", "column 1 has no title"),
            (",.1,.2\n.1,.5,1.5\n.2,2.5,3.5\n", "are places"),
            ("0,.5,1.5\n1,2.5,3.5\n2,4.5,7.5\n", "column 1 counts"),
            ("0,1,2\n.5,1.5,2\n3,3,3\n", "line 1 counts the 3 columns"),
        ] {
            let message = read(text).expect_err(text);
            assert!(message.contains(part), "{message}");
        }
        // A ramp, and numbers in their order, are heights.
        for text in ["0,1,2\n1,2,3\n2,3,4\n", "0,1,2\n3,4,5\n6,7,8\n"] {
            assert_eq!(
                read(text).map(|(rows, columns, _)| (rows, columns)),
                Ok((3, 3))
            );
        }
    }
}
