//! Load paths from waypoints: ellipses, measured histories, tables.

use std::f64::consts::TAU;
use std::path::Path;

use super::{Branch, Given, LOADS, LoadPath, Loads, MOTIONS, Spacing};
use crate::error::Error;

/// How many increments lie between two waypoints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Increments {
    /// The same number for each.
    Each(usize),
    /// As many as the change needs if the whole range of a load or motion takes this many; the one
    /// that needs most decides.
    PerRange(usize),
}

impl Increments {
    /// The increments of each of the steps, whose changes are given by load or motion.
    fn of(self, steps: &[Vec<f64>], ranges: &[f64]) -> Vec<usize> {
        let per_range = match self {
            Self::Each(n) => return vec![n; steps.len()],
            Self::PerRange(n) => n as f64,
        };
        let needed = |change: f64, range: f64| {
            if range > 0.0 {
                // Rounding must not cost an increment.
                (per_range * change.abs() / range - 1e-9).ceil() as usize
            } else {
                0
            }
        };
        let of_step = |step: &Vec<f64>| {
            let each = step.iter().zip(ranges).map(|(c, r)| needed(*c, *r));
            each.max().unwrap_or(0).max(1)
        };
        steps.iter().map(of_step).collect()
    }
}

/// What a column of a table may say beside the path time `t`.
fn column(loads: &mut Loads, name: &str, value: f64) -> bool {
    match name {
        "sigma_B" => loads.sigma_B = value,
        "sigma_B1" => loads.sigma_B1 = value,
        "rolled" => loads.rolled = value,
        _ => {
            let (mut forces, mut motions) = (loads.forces(), loads.given.motions());
            if let Some(k) = LOADS.iter().position(|load| *load == name) {
                (forces[k], motions[k]) = (value, None);
            } else if let Some(k) = MOTIONS.iter().position(|motion| *motion == name) {
                (forces[k], motions[k]) = (0.0, Some(value));
            } else {
                return false;
            }
            *loads = loads.with_forces(forces, Given::from_motions(motions));
        }
    }
    true
}

impl LoadPath {
    /// Presses with the normal forces `W` \[N\] in turn, as [`Self::tangential`] visits its values:
    /// radial fretting, mode II.
    #[must_use]
    pub fn radial(self, W: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(
            W,
            increments.into(),
            |at| at.W,
            |at, W| {
                at.given.delta_z = None;
                at.W = W;
            },
        )
    }

    /// Visits values of a motion in turn, by its place in [`MOTIONS`](super::MOTIONS), as
    /// [`Self::tangential`] visits forces; a motion that was free counts from 0.
    #[must_use]
    pub fn moved(self, motion: usize, to: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(
            to,
            increments.into(),
            |at| at.given.motions()[motion].unwrap_or(0.0),
            |at, value| {
                let (mut forces, mut motions) = (at.forces(), at.given.motions());
                (forces[motion], motions[motion]) = (0.0, Some(value));
                *at = at.with_forces(forces, Given::from_motions(motions));
            },
        )
    }

    /// Visits values of a load in turn, by its place in [`LOADS`](super::LOADS).
    #[must_use]
    pub fn loaded(self, load: usize, to: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(
            to,
            increments.into(),
            |at| at.forces()[load],
            |at, value| {
                let (mut forces, mut motions) = (at.forces(), at.given.motions());
                (forces[load], motions[load]) = (value, None);
                *at = at.with_forces(forces, Given::from_motions(motions));
            },
        )
    }

    /// Stays where it is for some increments, one unit of path time: what friction makes of its
    /// history goes on.
    #[must_use]
    pub fn hold(self, increments: usize) -> Self {
        self.to(|_| (), increments)
    }

    /// The values of `n` cycles of an amplitude: to it, then `n` times to its opposite and back.
    pub fn cycle(amplitude: f64, n: usize) -> Vec<f64> {
        let cycles = std::iter::repeat_n([-amplitude, amplitude], n);
        std::iter::once(amplitude).chain(cycles.flatten()).collect()
    }

    /// Turns the tangential force around an ellipse of the semi-axes `T_x`, `T_y` \[N\] with its
    /// middle where the path stands, from (T_x, 0) on towards (0, T_y), `turns` times. It goes
    /// there in `increments` and takes as many for a turn, each a branch of its own, since the path
    /// bends at each.
    #[must_use]
    pub fn ellipse(mut self, (T_x, T_y): (f64, f64), turns: usize, increments: usize) -> Self {
        let (middle, t0) = self.last();
        let at = |angle: f64| Loads {
            T_x: middle.T_x + T_x * angle.cos(),
            T_y: middle.T_y + T_y * angle.sin(),
            given: Given {
                delta_x: None,
                delta_y: None,
                ..middle.given
            },
            ..middle
        };
        let branch = |to: Loads, increments: usize, t_end: f64| Branch {
            to,
            increments: Some(increments),
            spacing: Spacing::Uniform,
            t_end,
            path_error: None,
        };
        self.branches.push(branch(at(0.0), increments, t0 + 1.0));
        for i in 1..=turns * increments {
            let part = i as f64 / increments as f64;
            let t = t0 + 1.0 + part;
            self.branches.push(branch(at(TAU * part), 1, t));
        }
        self
    }

    /// Goes straight from waypoint to waypoint, a branch for each. `names` are those of loads and
    /// motions, `sigma_B`, `sigma_B1`, `rolled` and the path time `t`; each row has a value for
    /// each. What has no column stays as it is.
    pub fn waypoints(
        mut self,
        names: &[&str],
        rows: &[Vec<f64>],
        increments: Increments,
    ) -> Result<Self, Error> {
        let mut sink = Loads::default();
        if let Some(name) = names
            .iter()
            .find(|n| **n != "t" && !column(&mut sink, n, 0.0))
        {
            let others = ["sigma_B", "sigma_B1", "rolled", "t"];
            let known = [&LOADS[..], &MOTIONS[..], &others].concat();
            let nearest = known
                .iter()
                .min_by_key(|known| strsim::damerau_levenshtein(name, known));
            let nearest = nearest.copied().unwrap_or_default();
            let allowed = format!("one of {}; the nearest is {nearest}", known.join(", "));
            return Err(Error::invalid("path column", name, allowed));
        }
        if let Some(row) = rows.iter().position(|row| row.len() != names.len()) {
            return Err(Error::invalid(
                format!("path row {}", row + 1),
                format!("{} values", rows[row].len()),
                format!(
                    "{} values, one for each of {}",
                    names.len(),
                    names.join(", ")
                ),
            ));
        }
        let (start, mut t) = self.last();
        let mut to = start;
        let mut branches = Vec::with_capacity(rows.len());
        for row in rows {
            let mut t_end = t + 1.0;
            for (name, &value) in names.iter().zip(row) {
                if *name == "t" {
                    t_end = value;
                } else {
                    column(&mut to, name, value);
                }
            }
            t = t_end;
            branches.push((to, t_end));
        }
        let value_of = |loads: &Loads, name: &str| {
            let k = |names: [&str; 6]| names.iter().position(|n| *n == name);
            match name {
                "sigma_B" => loads.sigma_B,
                "sigma_B1" => loads.sigma_B1,
                "rolled" => loads.rolled,
                _ => k(LOADS).map_or_else(
                    || {
                        k(MOTIONS)
                            .and_then(|k| loads.given.motions()[k])
                            .unwrap_or(0.0)
                    },
                    |k| loads.forces()[k],
                ),
            }
        };
        let loads: Vec<&str> = names.iter().copied().filter(|n| *n != "t").collect();
        let visited: Vec<Loads> = std::iter::once(start)
            .chain(branches.iter().map(|b| b.0))
            .collect();
        let range = |name: &&str| {
            let values = visited.iter().map(|l| value_of(l, name));
            let ends = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            });
            ends[1] - ends[0]
        };
        let ranges: Vec<f64> = loads.iter().map(range).collect();
        let change = |pair: &[Loads]| -> Vec<f64> {
            let change = |name: &&str| value_of(&pair[1], name) - value_of(&pair[0], name);
            loads.iter().map(change).collect()
        };
        let steps: Vec<Vec<f64>> = visited.windows(2).map(change).collect();
        let counts = increments.of(&steps, &ranges);
        for ((to, t_end), increments) in branches.into_iter().zip(counts) {
            self.branches.push(Branch {
                to,
                increments: Some(increments),
                spacing: Spacing::Uniform,
                t_end,
                path_error: None,
            });
        }
        Ok(self)
    }

    /// A measured history: a table of numbers parted by commas, its first line the names of
    /// [`Self::waypoints`].
    pub fn from_csv(path: &Path, increments: Increments) -> Result<Self, Error> {
        let failed = |message: String| Error::File {
            path: path.display().to_string(),
            message,
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_path(path)
            .map_err(|e| failed(e.to_string()))?;
        let names = reader.headers().map_err(|e| failed(e.to_string()))?.clone();
        let rows = reader.deserialize::<Vec<f64>>();
        let rows: Vec<Vec<f64>> = rows
            .collect::<Result<_, _>>()
            .map_err(|e| failed(e.to_string()))?;
        let names: Vec<&str> = names.iter().collect();
        Self::start()
            .waypoints(&names, &rows, increments)
            .map_err(|e| failed(e.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::{Branch, Increments, LoadPath};

    #[test]
    fn a_table_is_a_path() {
        let rows = [
            vec![0.5, 100.0, 0.0],
            vec![1.0, 100.0, 20.0],
            vec![2.0, 50.0, -20.0],
        ];
        let names = ["t", "W", "T_x"];
        let path = LoadPath::start().waypoints(&names, &rows, Increments::PerRange(8));
        let path = path.expect("a path");
        let counts: Vec<usize> = path.branches.iter().map(Branch::count).collect();
        assert_eq!(counts, [8, 4, 8]);
        let (points, end) = (path.points(), path.branches[2].to);
        assert_eq!((points[7].loads.W, points[9].loads.T_x), (100.0, 10.0));
        assert_eq!((end.W, end.T_x, points[19].t), (50.0, -20.0, 2.0));
        for (names, rows, part) in [
            (["t", "w", "T_x"], &rows[..], "the nearest is W"),
            (["t", "W", "T_x"], &[vec![1.0]][..], "path row 1 = 1 values"),
        ] {
            let refused = LoadPath::start().waypoints(&names, rows, Increments::Each(1));
            let text = refused.expect_err("refused").to_string();
            assert!(text.contains(part), "{text}");
        }
    }

    #[test]
    fn an_ellipse_closes() {
        let path = LoadPath::start().normal(10.0, 1).ellipse((2.0, 1.0), 2, 12);
        let points = path.points();
        assert_eq!(points.len(), 1 + 12 + 24);
        for point in &points[12..] {
            let (x, y) = (point.loads.T_x / 2.0, point.loads.T_y);
            assert!((x.hypot(y) - 1.0).abs() < 1e-14 && (point.loads.W - 10.0).abs() < 1e-14);
        }
        let (first, last) = (points[12].loads, points[36].loads);
        assert!((first.T_x - last.T_x).abs() + (first.T_y - last.T_y).abs() < 1e-13);
    }
}
