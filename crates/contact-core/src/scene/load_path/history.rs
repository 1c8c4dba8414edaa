//! Measured histories: tables of text whose titles are loads and motions.

use std::path::Path;

use super::waypoints::{Column, Increments, driven_motion};
use super::{ForceUnits, LoadPath};
use crate::error::Error;
use crate::scene::Prescribed;
use crate::scene::files;
use crate::scene::number_files::{Kind, Table, decode_any, names_and_units};

/// A table of loads and motions in SI units.
#[derive(Debug)]
pub(in crate::scene) struct History {
    /// Names of the columns.
    pub(super) names: Vec<String>,
    /// The numbers, row by row.
    pub(super) rows: Vec<f64>,
    /// The units of the columns of forces.
    pub(super) units: ForceUnits,
}

impl History {
    /// Parses the history in a text; the error gives line, column and the text found there.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let table = Table::parse(text)?;
        if table.rows() == 0 {
            return Err("has no row of numbers".into());
        }
        let (names, units) = names_and_units(&table.titles(), table.columns);
        if names.is_empty() {
            return Err(format!(
                "line {}: {} numbers come without names: the line above must name the columns, such as t, W, T_x",
                table.lines[0], table.columns
            ));
        }
        let mut scales = Vec::with_capacity(names.len());
        let mut force_units = ForceUnits::default();
        for (n, name) in names.iter().enumerate() {
            let column = Column::from_name(name).map_err(|e| e.to_string())?;
            let unit = units[n].as_deref();
            scales.push(si_scale(name, column, unit)?);
            if let (Column::Prescribed(motion, Prescribed::Load(_)), Some(word)) = (column, unit)
                && !motion.is_rotation()
            {
                force_units.add(ForceUnits::from_text(&format!("{name} [{word}]")));
            }
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
        Ok(Self {
            names,
            rows,
            units: force_units,
        })
    }

    /// Returns the columns that drive: of a motion and its load the one that `drive` names.
    pub(super) fn driving_columns(&self, drive: &[&str]) -> Result<Vec<usize>, String> {
        if let Some(absent) = drive
            .iter()
            .find(|name| !self.names.iter().any(|n| n == *name))
        {
            return Err(format!(
                "drive = {absent}: must be a column, of {}",
                self.names.join(", ")
            ));
        }
        let is_kept = |n: &usize| {
            let name = self.names[*n].as_str();
            let is_driven_by_other =
                |other: &&str| *other != name && driven_motion(other) == driven_motion(name);
            drive.contains(&name) || !drive.iter().any(is_driven_by_other)
        };
        let kept: Vec<usize> = (0..self.names.len()).filter(is_kept).collect();
        for (i, n) in kept.iter().enumerate() {
            let (name, others) = (&self.names[*n], &kept[..i]);
            let conflict = others
                .iter()
                .find(|other| driven_motion(&self.names[**other]) == driven_motion(name));
            if let Some(conflicting) = conflict {
                let conflicting = &self.names[*conflicting];
                return Err(if conflicting == name {
                    format!("two columns are called {name}: must be one")
                } else {
                    format!(
                        "{conflicting} and {name} both stand in it, and the one follows from the other: choose the one that drives, \
                         drive = \"{conflicting}\" or drive = \"{name}\""
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
        let history = decode_any(files::read(path)?).and_then(|text| History::parse(&text));
        let history = history.map_err(failed)?;
        let driving = history.driving_columns(drive).map_err(failed)?;
        let names: Vec<&str> = driving.iter().map(|n| history.names[*n].as_str()).collect();
        let rows = history.rows.chunks_exact(history.names.len());
        let rows: Vec<Vec<f64>> = rows
            .map(|row| driving.iter().map(|n| row[*n]).collect())
            .collect();
        let path = Self::start().waypoints(&names, &rows, increments);
        let path = path.map_err(|e| failed(e.to_string()))?;
        Ok(Self {
            units: history.units.clone(),
            ..path
        })
    }
}

/// The factor from the unit of a column to SI; 1 without a unit.
fn si_scale(name: &str, column: Column, unit: Option<&str>) -> Result<f64, String> {
    let Some(word) = unit else {
        return Ok(1.0);
    };
    let (kind, allowed) = match column {
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
    let size = kind.size(word);
    size.ok_or_else(|| format!("column {name} is in `{word}`: must be {allowed}"))
}

#[cfg(test)]
mod tests {
    use super::History;

    #[test]
    fn titles_and_units_identify_the_columns() {
        for text in [
            "t,W,T_x\n1,10,0\n2,10,2.5\n",
            "t;W;T_x\n1;10;0\n2;10;2,5\n",
            "t\tW\tT_x\n1\t10\t0\n2\t10\t2.5\n",
            "t,W,T_x\ns,N,N\n1,10,0\n2,10,2.5\n",
            "t [s], W [kN], T_x [mN]\n1,0.01,0\n2,0.01,2500\n",
            "rig of May\nt W T_x\nms N kN\n1000 10 0\n2000 10 0.0025\n",
            "# t,W,T_x\n1.0,10.0,0.0\n2.0,10.0,2.5\n",
        ] {
            let history = History::parse(text).unwrap_or_else(|e| panic!("{text:?}: {e}"));
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
            let message = History::parse(text).expect_err(text);
            assert!(message.contains(part), "{message}");
        }
    }

    #[test]
    fn either_a_load_or_its_motion_drives() {
        let loop_ = History::parse("W,T_x,delta_x\n10,0,0\n10,1,1e-6\n").expect("a loop");
        let message = loop_.driving_columns(&[]).expect_err("which drives");
        assert!(
            message.contains("T_x and delta_x both stand in it"),
            "{message}"
        );
        assert_eq!(loop_.driving_columns(&["delta_x"]), Ok(vec![0, 2]));
        assert_eq!(loop_.driving_columns(&["T_x"]), Ok(vec![0, 1]));
        assert!(loop_.driving_columns(&["delta_y"]).is_err());
    }
}
