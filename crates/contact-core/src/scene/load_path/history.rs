//! Measured histories: tables of text whose titles are loads and motions.

use std::path::Path;

use super::LoadPath;
use super::waypoints::{Column, Increments, drives};
use crate::error::Error;
use crate::scene::Prescribed;
use crate::scene::files;
use crate::scene::number_files::{Kind, Table, of_titles, tolerant};

/// A table of loads and motions in SI units.
#[derive(Debug)]
pub(in crate::scene) struct History {
    /// Names of the columns.
    pub(super) names: Vec<String>,
    /// The numbers, row by row.
    pub(super) rows: Vec<f64>,
}

impl History {
    /// The history of a text; the error names line, column and what was found there.
    pub(super) fn of(text: &str) -> Result<Self, String> {
        let table = Table::of(text)?;
        if table.rows() == 0 {
            return Err("has no row of numbers".into());
        }
        let (names, units) = of_titles(&table.titles(), table.columns);
        if names.is_empty() {
            return Err(format!(
                "line {}: {} numbers come without names: the line above must name the columns, such as t, W, T_x",
                table.lines[0], table.columns
            ));
        }
        let mut scales = Vec::with_capacity(names.len());
        for (n, name) in names.iter().enumerate() {
            let column = Column::named(name).map_err(|e| e.to_string())?;
            scales.push(scale(name, column, units[n].as_deref())?);
        }
        if let Some(hole) = table.numbers.iter().position(|value| value.is_nan()) {
            let (row, column) = (hole / table.columns, hole % table.columns);
            return Err(format!(
                "line {}, column {}: {} has no number: must have one in every line",
                table.lines[row],
                column + 1,
                names[column]
            ));
        }
        let mut rows = table.numbers;
        for row in rows.chunks_exact_mut(names.len()) {
            row.iter_mut()
                .zip(&scales)
                .for_each(|(value, scale)| *value *= scale);
        }
        Ok(Self { names, rows })
    }

    /// The columns that drive: of a motion and its load the one that `drive` names.
    pub(super) fn driving(&self, drive: &[&str]) -> Result<Vec<usize>, String> {
        if let Some(absent) = drive
            .iter()
            .find(|name| !self.names.iter().any(|n| n == *name))
        {
            return Err(format!(
                "drive = {absent}: must be a column, of {}",
                self.names.join(", ")
            ));
        }
        let kept = |n: &usize| {
            let name = self.names[*n].as_str();
            let by_other = |other: &&str| *other != name && drives(other) == drives(name);
            drive.contains(&name) || !drive.iter().any(by_other)
        };
        let kept: Vec<usize> = (0..self.names.len()).filter(kept).collect();
        for (i, n) in kept.iter().enumerate() {
            let (name, others) = (&self.names[*n], &kept[..i]);
            let same = others
                .iter()
                .find(|other| drives(&self.names[**other]) == drives(name));
            if let Some(other) = same {
                let other = &self.names[*other];
                return Err(if other == name {
                    format!("two columns are called {name}: must be one")
                } else {
                    format!(
                        "{other} and {name} both stand in it, and the one follows from the other: say which drives, \
                         drive = \"{other}\" or drive = \"{name}\""
                    )
                });
            }
        }
        Ok(kept)
    }
}

impl LoadPath {
    /// A measured history: a table of text whose titles are the names of [`Self::waypoints`], with
    /// or without units, `T_x [kN]` or a row of them. Of a motion and its load, which both stand in
    /// the table of every measured loop, `drive` names the one that drives; the other is left out.
    pub fn from_csv(path: &Path, increments: Increments, drive: &[&str]) -> Result<Self, Error> {
        let failed = |message: String| Error::File {
            path: path.display().to_string(),
            message: message.split_whitespace().collect::<Vec<_>>().join(" "),
        };
        let history = tolerant(files::read(path)?).and_then(|text| History::of(&text));
        let history = history.map_err(failed)?;
        let kept = history.driving(drive).map_err(failed)?;
        let names: Vec<&str> = kept.iter().map(|n| history.names[*n].as_str()).collect();
        let rows = history.rows.chunks_exact(history.names.len());
        let rows: Vec<Vec<f64>> = rows
            .map(|row| kept.iter().map(|n| row[*n]).collect())
            .collect();
        Self::start()
            .waypoints(&names, &rows, increments)
            .map_err(|e| failed(e.to_string()))
    }
}

/// The size of the unit of a column in SI units.
fn scale(name: &str, column: Column, unit: Option<&str>) -> Result<f64, String> {
    let Some(word) = unit else {
        return Ok(1.0);
    };
    let (wanted, allowed) = match column {
        Column::Time => (Kind::Time, "a unit of time, such as s"),
        Column::Prescribed(of, Prescribed::Load(_)) if of.is_rotation() => {
            (Kind::Moment, "a unit of moments, such as N m")
        }
        Column::Prescribed(_, Prescribed::Load(_)) => {
            (Kind::Force, "a unit of force, such as N or kN")
        }
        Column::Prescribed(of, Prescribed::Motion(_)) if of.is_rotation() => {
            (Kind::Angle, "a unit of angles, such as rad")
        }
        Column::Prescribed(..) => (Kind::Length, "a unit of length, such as m or um"),
        Column::Other(_) if name == "rolled" => (Kind::Length, "a unit of length, such as m or um"),
        Column::Other(_) => (Kind::Stress, "a unit of stress, such as Pa or MPa"),
    };
    let size = wanted.size(word);
    size.ok_or_else(|| format!("column {name} is in `{word}`: must be {allowed}"))
}

#[cfg(test)]
mod tests {
    use super::History;

    #[test]
    fn titles_and_units_say_what_the_columns_are() {
        for text in [
            "t,W,T_x\n1,10,0\n2,10,2.5\n",
            "t;W;T_x\n1;10;0\n2;10;2,5\n",
            "t\tW\tT_x\n1\t10\t0\n2\t10\t2.5\n",
            "t,W,T_x\ns,N,N\n1,10,0\n2,10,2.5\n",
            "t [s], W [kN], T_x [mN]\n1,0.01,0\n2,0.01,2500\n",
            "rig of May\nt W T_x\nms N kN\n1000 10 0\n2000 10 0.0025\n",
            "# t,W,T_x\n1.0,10.0,0.0\n2.0,10.0,2.5\n",
        ] {
            let history = History::of(text).unwrap_or_else(|e| panic!("{text:?}: {e}"));
            assert_eq!(history.names, ["t", "W", "T_x"], "{text:?}");
            for (found, value) in history.rows.iter().zip([1.0, 10.0, 0.0, 2.0, 10.0, 2.5]) {
                assert!((found - value).abs() < 1e-12, "{text:?}");
            }
        }
        for (text, part) in [
            ("1,2\n3,4\n", "line 1: 2 numbers come without names"),
            ("W,T\n1,2\n", "the nearest is W"),
            ("W,T_x\n1,2\n3,\n", "line 3, column 2: T_x has no number"),
            (
                "W,T_x\n1,2\n3,2.5 N\n",
                "line 3, column 2: `2.5 N` is no number",
            ),
            (
                "W [ozf],T_x\n1,2\n",
                "W is in `ozf`: must be a unit of force",
            ),
            (
                "W,T_x [mm]\n1,2\n",
                "T_x is in `mm`: must be a unit of force",
            ),
        ] {
            let told = History::of(text).expect_err(text);
            assert!(told.contains(part), "{told}");
        }
    }

    #[test]
    fn of_a_load_and_its_motion_one_drives() {
        let loop_ = History::of("W,T_x,delta_x\n10,0,0\n10,1,1e-6\n").expect("a loop");
        let asked = loop_.driving(&[]).expect_err("which drives");
        assert!(
            asked.contains("T_x and delta_x both stand in it"),
            "{asked}"
        );
        assert_eq!(loop_.driving(&["delta_x"]), Ok(vec![0, 2]));
        assert_eq!(loop_.driving(&["T_x"]), Ok(vec![0, 1]));
        assert!(loop_.driving(&["delta_y"]).is_err());
    }
}
