//! Units that stand in files.

/// The quantity of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) enum Kind {
    Length,
    Force,
    Moment,
    Angle,
    Stress,
    Time,
    Stiffness,
    Frequency,
}

impl Kind {
    /// Its unit in SI.
    pub(in crate::scene) fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Force => "N",
            Self::Moment => "N m",
            Self::Angle => "rad",
            Self::Stress => "Pa",
            Self::Time => "s",
            Self::Stiffness => "N/m",
            Self::Frequency => "Hz",
        }
    }

    /// The size in SI of a unit of this kind, by its name; a force per length is a stiffness, too.
    pub(in crate::scene) fn size(self, name: &str) -> Option<f64> {
        let (kind, size) = named(name)?;
        let per_length = (kind, self) == (Self::Force, Self::Stiffness) && name.contains('/');
        (kind == self || per_length).then_some(size)
    }
}

/// A unit: what it measures, and its size in SI units. Forces and moments of line contacts are per
/// metre.
pub(in crate::scene) type Unit = (Kind, f64);

const UNITS: [(&str, Kind, f64); 57] = {
    use Kind::{Angle, Force, Frequency, Length, Moment, Stiffness, Stress, Time};
    [
        ("m", Length, 1.0),
        ("cm", Length, 1e-2),
        ("mm", Length, 1e-3),
        ("um", Length, 1e-6),
        ("micron", Length, 1e-6),
        ("microns", Length, 1e-6),
        ("micrometer", Length, 1e-6),
        ("micrometre", Length, 1e-6),
        ("nm", Length, 1e-9),
        ("pm", Length, 1e-12),
        ("å", Length, 1e-10),
        ("angstrom", Length, 1e-10),
        ("in", Length, 0.0254),
        ("inch", Length, 0.0254),
        ("N", Force, 1.0),
        ("uN", Force, 1e-6),
        ("mN", Force, 1e-3),
        ("kN", Force, 1e3),
        ("MN", Force, 1e6),
        ("N/m", Force, 1.0),
        ("N/mm", Force, 1e3),
        ("kN/m", Force, 1e3),
        ("kN/mm", Force, 1e6),
        ("MN/m", Force, 1e6),
        ("Nm", Moment, 1.0),
        ("N m", Moment, 1.0),
        ("N*m", Moment, 1.0),
        ("N.m", Moment, 1.0),
        ("mNm", Moment, 1e-3),
        ("Nmm", Moment, 1e-3),
        ("N mm", Moment, 1e-3),
        ("N*mm", Moment, 1e-3),
        ("kNm", Moment, 1e3),
        ("rad", Angle, 1.0),
        ("mrad", Angle, 1e-3),
        ("urad", Angle, 1e-6),
        ("deg", Angle, std::f64::consts::PI / 180.0),
        ("°", Angle, std::f64::consts::PI / 180.0),
        ("Pa", Stress, 1.0),
        ("kPa", Stress, 1e3),
        ("MPa", Stress, 1e6),
        ("N/mm2", Stress, 1e6),
        ("N/mm^2", Stress, 1e6),
        ("N/mm²", Stress, 1e6),
        ("GPa", Stress, 1e9),
        ("s", Time, 1.0),
        ("sec", Time, 1.0),
        ("ms", Time, 1e-3),
        ("min", Time, 60.0),
        ("h", Time, 3600.0),
        ("N/um", Stiffness, 1e6),
        ("kN/um", Stiffness, 1e9),
        ("N/nm", Stiffness, 1e9),
        ("Hz", Frequency, 1.0),
        ("kHz", Frequency, 1e3),
        ("1/s", Frequency, 1.0),
        ("1/min", Frequency, 1.0 / 60.0),
    ]
};

/// The unit of that name, if it is one; the micro sign may be u, the first letter of words for
/// lengths large.
pub(in crate::scene) fn named(name: &str) -> Option<Unit> {
    let plain = name.trim().replace(['µ', 'μ'], "u").replace('·', "*");
    let exact = UNITS.iter().find(|(word, ..)| *word == plain);
    let lower = plain.to_lowercase();
    let word = || {
        UNITS
            .iter()
            .find(|(word, ..)| *word == lower && (word.len() > 3 || lower == "å"))
    };
    exact.or_else(word).map(|(_, kind, size)| (*kind, *size))
}

/// The names of the units of a kind.
pub(in crate::scene) fn names(kind: Kind) -> String {
    let names = UNITS.iter().filter(|(_, of, _)| *of == kind);
    names.map(|(name, ..)| *name).collect::<Vec<_>>().join(", ")
}

/// The name and the unit of a title such as `T_x [N]`, `height (um)`, `X_(microns)`; without
/// brackets all is name.
pub(in crate::scene) fn of_title(title: &str) -> (&str, Option<&str>) {
    let title = title.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some(rest) = title.strip_suffix(close)
            && let Some((name, unit)) = rest.rsplit_once(open)
        {
            return (name.trim_end_matches(['_', ' ']), Some(unit.trim()));
        }
    }
    (title, None)
}

const BRACKETS: [char; 4] = ['[', ']', '(', ')'];

/// Whether every field of a line of titles that says something is a unit.
fn is_row_of_units(fields: &[String]) -> bool {
    let words = fields.iter().map(|field| field.trim_matches(BRACKETS));
    let mut words = words.filter(|word| !is_none(word)).peekable();
    words.peek().is_some() && words.all(|word| named(word).is_some())
}

/// Words for a number without a unit.
fn is_none(unit: &str) -> bool {
    matches!(unit.trim(), "" | "-" | "1")
}

/// The names of the columns and the words for their units, from lines of titles of which the last
/// may be one of units alone.
pub(in crate::scene) fn of_titles(
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
        let in_row = row.map(|row| row[n].trim_matches(BRACKETS));
        let in_title = || names.and_then(|names| of_title(&names[n]).1);
        let word = in_row.or_else(in_title);
        word.filter(|word| !is_none(word)).map(ToOwned::to_owned)
    };
    let units = (0..columns).map(unit).collect();
    let names = names.into_iter().flat_map(|line| line.iter());
    (
        names.map(|title| of_title(title).0.to_owned()).collect(),
        units,
    )
}

/// The unit of length in brackets at the end of the one title of a whole table, such as `z [um]`
/// above a map, or of its last comment, in which NumPy writes a title.
pub(in crate::scene) fn of_whole(titles: &[Vec<String>], comments: &[String]) -> Option<String> {
    let only = |line: &Vec<String>| -> Option<String> {
        let mut words = line.iter().filter(|word| !word.trim().is_empty());
        words.next().filter(|_| words.next().is_none()).cloned()
    };
    let title = titles.iter().rev().find_map(only);
    // A number in a comment is a setting, and its unit not that of the heights.
    let comment = || {
        comments
            .last()
            .filter(|text| !text.contains(char::is_numeric))
    };
    let title = title.or_else(|| comment().cloned())?;
    let unit = of_title(&title).1?;
    named(unit).filter(|(kind, _)| *kind == Kind::Length)?;
    Some(unit.to_owned())
}

#[cfg(test)]
mod tests {
    use super::{Kind, named, of_titles, of_whole};

    fn line(words: &str) -> Vec<String> {
        words.split(',').map(ToOwned::to_owned).collect()
    }

    #[test]
    fn a_title_above_a_map_says_its_unit() {
        let comments = |text: &str| vec![text.to_owned()];
        for (titles, comments) in [
            (vec![line("z [um]")], vec![]),
            (vec![line("Scan of May"), line("Höhe (µm),,")], vec![]),
            (vec![], comments("heights [um]")),
        ] {
            let unit = of_whole(&titles, &comments).expect("a unit");
            assert_eq!(named(&unit), Some((Kind::Length, 1e-6)));
        }
        for (titles, comments) in [
            (vec![line("Scan (May)")], vec![]),
            (vec![line("x [mm],y [mm]")], vec![]),
            (vec![], comments("pitch 2 [um]")),
            (vec![line("force [N]")], vec![]),
        ] {
            assert_eq!(of_whole(&titles, &comments), None);
        }
    }

    #[test]
    fn units_stand_in_titles_or_below_them() {
        for titles in [
            &[line("x [mm],y (mm),z_(µm)")][..],
            &[line("x,y,z"), line("mm,mm,um")],
            &[line("Scan of May"), line("x,y,z"), line("[mm],[mm],[um]")],
        ] {
            let (names, units) = of_titles(titles, 3);
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
        let (names, units) = of_titles(&[line("a,b")], 2);
        assert!(names == ["a", "b"] && units == [None, None]);
        assert_eq!(named("kN"), Some((Kind::Force, 1e3)));
        assert_eq!(named("Micrometer"), Some((Kind::Length, 1e-6)));
        assert!(named("counts").is_none() && named("mn").is_none());
    }
}
