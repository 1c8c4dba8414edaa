//! Units in titles of files.

pub(in crate::scene) use plausible::unit::{Kind, named, names};

/// Splits a title such as `T_x [N]`, `height (um)`, `X_(microns)` into name and unit; without
/// brackets all of it is the name.
pub(in crate::scene) fn split_title(title: &str) -> (&str, Option<&str>) {
    let title = title.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some(inside) = title.strip_suffix(close)
            && let Some((name, unit)) = inside.rsplit_once(open)
        {
            return (name.trim_end_matches(['_', ' ']), Some(unit.trim()));
        }
    }
    (title, None)
}

const BRACKETS: [char; 4] = ['[', ']', '(', ')'];

/// Whether every field of a line of titles that is not empty is a unit.
fn is_row_of_units(fields: &[String]) -> bool {
    let words = fields.iter().map(|field| field.trim_matches(BRACKETS));
    let kinds = words
        .filter(|word| !is_no_unit(word))
        .map(|word| Some(named(word)?.0));
    let kinds: Option<Vec<Kind>> = kinds.collect();
    kinds.is_some_and(|kinds| kinds.iter().any(|kind| *kind != Kind::Number))
}

/// Words for a number without a unit.
fn is_no_unit(unit: &str) -> bool {
    matches!(unit.trim(), "" | "-" | "1")
}

/// Returns the names of the columns and the words for their units, from lines of titles of which the last
/// may have units alone.
pub(in crate::scene) fn names_and_units(
    titles: &[Vec<String>],
    columns: usize,
) -> (Vec<String>, Vec<Option<String>>) {
    let fitting: Vec<_> = titles.iter().filter(|line| line.len() == columns).collect();
    let (row, names) = match fitting.split_last() {
        Some((last, before)) if is_row_of_units(last) => (Some(*last), before.last()),
        Some((last, _)) => (None, Some(last)),
        None => (None, None),
    };
    let unit = |n: usize| {
        let from_row = row.map(|row| row[n].trim_matches(BRACKETS));
        let from_title = || names.and_then(|names| split_title(&names[n]).1);
        let word = from_row.or_else(from_title);
        word.filter(|word| !is_no_unit(word)).map(ToOwned::to_owned)
    };
    let units = (0..columns).map(unit).collect();
    let names = names.into_iter().flat_map(|line| line.iter());
    (
        names.map(|title| split_title(title).0.to_owned()).collect(),
        units,
    )
}

/// Unit of length in brackets at the end of the only title of a table, such as `z [um]`
/// above a map, or of its last comment, in which NumPy writes a title.
pub(in crate::scene) fn unit_of_table(
    titles: &[Vec<String>],
    comments: &[String],
) -> Option<String> {
    let single_title = |line: &Vec<String>| -> Option<String> {
        let mut words = line.iter().filter(|word| !word.trim().is_empty());
        words.next().filter(|_| words.next().is_none()).cloned()
    };
    let title = titles.iter().rev().find_map(single_title);
    // A number in a comment is a setting, and its unit does not belong to the heights.
    let comment = || {
        comments
            .last()
            .filter(|text| !text.contains(char::is_numeric))
    };
    let title = title.or_else(|| comment().cloned())?;
    let unit = split_title(&title).1?;
    named(unit).filter(|(kind, _)| *kind == Kind::Length)?;
    Some(unit.to_owned())
}

#[cfg(test)]
mod tests {
    use super::{Kind, named, names_and_units, unit_of_table};

    fn line(words: &str) -> Vec<String> {
        words.split(',').map(ToOwned::to_owned).collect()
    }

    #[test]
    fn a_title_above_a_map_gives_its_unit() {
        let comments = |text: &str| vec![text.to_owned()];
        for (titles, comments) in [
            (vec![line("z [um]")], vec![]),
            (vec![line("Scan of May"), line("Höhe (µm),,")], vec![]),
            (vec![], comments("heights [um]")),
        ] {
            let unit = unit_of_table(&titles, &comments).expect("a unit");
            assert_eq!(named(&unit), Some((Kind::Length, 1e-6)));
        }
        for (titles, comments) in [
            (vec![line("Scan (May)")], vec![]),
            (vec![line("x [mm],y [mm]")], vec![]),
            (vec![], comments("pitch 2 [um]")),
            (vec![line("force [N]")], vec![]),
        ] {
            assert_eq!(unit_of_table(&titles, &comments), None);
        }
    }

    #[test]
    fn units_stand_in_titles_or_below_them() {
        for titles in [
            &[line("x [mm],y (mm),z_(µm)")][..],
            &[line("x,y,z"), line("mm,mm,um")],
            &[line("Scan of May"), line("x,y,z"), line("[mm],[mm],[um]")],
        ] {
            let (names, units) = names_and_units(titles, 3);
            assert_eq!(names, ["x", "y", "z"]);
            let sizes = units
                .iter()
                .flatten()
                .map(|word| named(word).map(|unit| unit.1));
            assert_eq!(
                sizes.collect::<Vec<_>>(),
                [Some(1e-3), Some(1e-3), Some(1e-6)]
            );
        }
        let (names, units) = names_and_units(&[line("a,b")], 2);
        assert!(names == ["a", "b"] && units == [None, None]);
    }
}
