//! Results that fit into the window: wrapped lines, and tables whose columns go on below.
//!
//! `comfy-table` aligns cells. It does not split a table that is wider than the window; cells would
//! be folded in the middle of a number.

use clap::builder::styling::Style;
use comfy_table::{
    CellAlignment, ContentArrangement, ContentLineStyle, LineStyle, Table, TableStyle,
};
use contact_core::shown;

use crate::failure::Failure;
use crate::printed::write_lines;
use crate::terminal::{result_width, results_are_coloured};
use crate::wrapping::{wrap, wrap_behind};

/// Spaces between columns.
const GAP: usize = 2;
/// Columns of the subjects of descriptions.
const SUBJECT: usize = 14;
/// Columns and a line below their titles, without borders.
const STYLE: TableStyle = TableStyle::new()
    .header_lines(ContentLineStyle::none())
    .header_separator(LineStyle::none().fill('-').junction('-'))
    .content_lines(ContentLineStyle::none());

/// A column of a table: its title, of several lines, and its cells.
pub(crate) struct Column {
    pub(crate) title: String,
    pub(crate) cells: Vec<String>,
}

impl Column {
    /// Number of characters of the widest line.
    fn width(&self) -> usize {
        let texts = std::iter::once(&self.title).chain(&self.cells);
        let lines = texts.flat_map(|text| text.lines());
        lines.map(textwrap::core::display_width).max().unwrap_or(0)
    }

    /// The side at which the cells of a column stand: numbers right, texts left.
    fn alignment(&self) -> CellAlignment {
        let is_number = |cell: &String| {
            let cell = cell.trim();
            let sign = cell.starts_with(['+', '-', '.', '(']);
            sign || cell.is_empty()
                || cell.starts_with(|c: char| c.is_ascii_digit())
                || ["nan", "inf"].contains(&cell)
        };
        let texts = self.cells.iter().filter(|cell| !is_number(cell)).count();
        if 2 * texts > self.cells.len() {
            CellAlignment::Left
        } else {
            CellAlignment::Right
        }
    }
}

/// The result of a command for people.
pub(crate) struct Page {
    width: usize,
    heads: Style,
    lines: Vec<String>,
}

impl Page {
    /// Returns an empty page for the standard output.
    pub(crate) fn new() -> Self {
        let heads = if results_are_coloured() {
            Style::new().bold()
        } else {
            Style::new()
        };
        Self::with_width(result_width(), heads)
    }

    /// An empty page of this width, with the heads in this style.
    fn with_width(width: usize, heads: Style) -> Self {
        Self {
            width,
            heads,
            lines: Vec::new(),
        }
    }

    /// Adds a line, which is emphasized on a terminal.
    pub(crate) fn head(&mut self, text: &str) {
        let lines = wrap(&shown(text), self.width);
        let lines: Vec<String> = lines.iter().map(|line| self.bold(line)).collect();
        self.lines.extend(lines);
    }

    /// Adds lines.
    pub(crate) fn text(&mut self, text: &str) {
        let lines = text.lines().flat_map(|line| wrap(&shown(line), self.width));
        self.lines.extend(lines);
    }

    /// Adds a subject and its text beside it.
    pub(crate) fn description(&mut self, subject: &str, text: &str) {
        let first = format!("{subject:<SUBJECT$}");
        let lines = wrap_behind(&shown(text), self.width, SUBJECT);
        for (n, line) in lines.iter().enumerate() {
            let line = &line[SUBJECT.min(line.len())..];
            let before = if n == 0 {
                self.bold(&first)
            } else {
                " ".repeat(SUBJECT)
            };
            self.lines.push(before + line);
        }
    }

    /// Adds a table. Columns that do not fit stand below, beside the first `keys` columns again.
    pub(crate) fn table(&mut self, columns: &[Column], keys: usize) {
        for line in table_lines(columns, keys, self.width) {
            self.lines.push(match line {
                Line::Title(text) => self.bold(&text),
                Line::Row(text) => text,
            });
        }
    }

    /// The text in the style of heads.
    fn bold(&self, text: &str) -> String {
        let style = self.heads;
        format!("{style}{text}{style:#}")
    }

    /// Writes the page to the standard output.
    pub(crate) fn print(&self) -> Result<(), Failure> {
        write_lines(&self.lines)
    }
}

/// A line of a table.
pub(crate) enum Line {
    /// A line of the titles.
    Title(String),
    /// A line below the titles.
    Row(String),
}

/// The lines of a table of at most `width` characters. The first `keys` columns are repeated in each block.
pub(crate) fn table_lines(columns: &[Column], keys: usize, width: usize) -> Vec<Line> {
    let widths: Vec<usize> = columns.iter().map(|column| column.width() + GAP).collect();
    let mut lines = Vec::new();
    let blocks = blocks(&widths, keys.min(columns.len()), width + GAP);
    for (n, block) in blocks.iter().enumerate() {
        if n > 0 {
            lines.push(Line::Row(String::new()));
        }
        let block: Vec<&Column> = block.iter().map(|&k| &columns[k]).collect();
        lines.extend(block_lines(&block, width));
    }
    lines
}

/// The lines of columns that stand side by side. Texts are folded if the columns together are wider than
/// `width`.
fn block_lines(columns: &[&Column], width: usize) -> Vec<Line> {
    let mut table = Table::new();
    table
        .load_style(STYLE)
        .set_header(columns.iter().map(|column| &column.title));
    let total: usize = columns.iter().map(|column| column.width() + GAP).sum();
    if total > width + GAP {
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(u16::try_from(width).unwrap_or(u16::MAX));
    }
    let rows = columns.iter().map(|column| column.cells.len()).max();
    for row in 0..rows.unwrap_or(0) {
        let cell = |column: &&Column| column.cells.get(row).cloned().unwrap_or_default();
        table.add_row(columns.iter().map(cell));
    }
    for (n, column) in table.column_iter_mut().enumerate() {
        column.set_cell_alignment(columns[n].alignment());
        // One more space is the place of a border.
        column.set_padding((0, u16::from(n + 1 < columns.len())));
    }
    let mut is_title = true;
    let lines = table.lines().map(|line| {
        let line = shown(line.trim_end()).into_owned();
        is_title &= line.is_empty() || !line.trim_matches('-').is_empty();
        if is_title {
            Line::Title(line)
        } else {
            Line::Row(line)
        }
    });
    lines.collect()
}

/// A table as text: titles, then rows, in blocks of at most `width` characters that repeat the first `keys`
/// columns.
#[must_use]
pub fn table_text(titles: &[String], rows: &[Vec<String>], keys: usize, width: usize) -> String {
    let cell = |row: &Vec<String>, n: usize| row.get(n).cloned().unwrap_or_default();
    let columns: Vec<Column> = titles
        .iter()
        .enumerate()
        .map(|(n, title)| Column {
            title: title.clone(),
            cells: rows.iter().map(|row| cell(row, n)).collect(),
        })
        .collect();
    let lines = table_lines(&columns, keys, width);
    let lines = lines.into_iter().map(|line| match line {
        Line::Title(text) | Line::Row(text) => text,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Indices of the columns of each block of a table: the first `keys`, and others as they fit.
fn blocks(widths: &[usize], keys: usize, total: usize) -> Vec<Vec<usize>> {
    let of_keys: usize = widths[..keys].iter().sum();
    let mut blocks: Vec<Vec<usize>> = vec![(0..keys).collect()];
    let mut used = of_keys;
    for (k, width) in widths.iter().enumerate().skip(keys) {
        let is_begun = blocks.last().is_some_and(|block| block.len() > keys);
        if is_begun && used + width > total {
            blocks.push((0..keys).collect());
            used = of_keys;
        }
        used += width;
        if let Some(block) = blocks.last_mut() {
            block.push(k);
        }
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Vec<Column> {
        let numbers = |n: usize| vec![format!("{}.{n}e-5", n * n), "-1.5e-12".to_owned()];
        (0..14)
            .map(|n| Column {
                title: format!("quantity{n}\n[um]"),
                cells: numbers(n),
            })
            .collect()
    }

    #[test]
    fn no_line_of_a_table_is_wider_than_the_window_and_no_column_is_lost() {
        for width in [40, 60, 80, 120, 400] {
            let mut page = Page::with_width(width, Style::new());
            page.table(&columns(), 1);
            let text = page.lines.join("\n");
            for line in &page.lines {
                assert!(line.chars().count() <= width, "{width}: {line}");
            }
            for n in 1..14 {
                let title = format!("quantity{n} ");
                let count = (text.clone() + " ")
                    .replace('\n', " \n")
                    .matches(&title)
                    .count();
                assert_eq!(count, 1, "{width}: {title}");
            }
            assert_eq!(
                text.matches("quantity0").count(),
                text.matches("---\n").count()
            );
        }
    }

    #[test]
    fn descriptions_hang_behind_their_subject() {
        let mut page = Page::with_width(40, Style::new());
        page.description(
            "plan",
            "kept: normal-tangential coupling (the bodies differ)",
        );
        assert_eq!(page.lines[0], "plan          kept: normal-tangential");
        assert!(page.lines[1].starts_with(&" ".repeat(SUBJECT)));
    }

    #[test]
    fn escapes_of_a_title_are_text() {
        let mut page = Page::with_width(60, Style::new());
        page.head("a \u{1b}[31mred title");
        assert!(!page.lines[0].contains('\u{1b}'));
    }
}
