//! Load paths from waypoints: measured histories, tables.

use std::f64::consts::TAU;

use super::{Branch, LoadPath};
use crate::error::Error;
use crate::scene::{Loads, Prescribed, RigidMotion};

/// Fewest points of a period of a sine.
const FEWEST_POINTS: usize = 4;

/// Number of increments between two waypoints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Increments {
    /// Equal numbers for all.
    Each(usize),
    /// The number that the change needs if the whole range of a load or motion takes this number; the
    /// largest number over loads and motions counts.
    PerRange(usize),
    /// The number that the tolerance on the path needs,
    /// [`choose_increments`](crate::estimate::choose_increments).
    Chosen,
}

impl Increments {
    /// Number of increments of each step, given the changes of loads or motions in it; none where
    /// they are not yet chosen.
    fn per_step(self, steps: &[Vec<f64>], ranges: &[f64]) -> Vec<Option<usize>> {
        let per_range = match self {
            Self::Each(n) => return vec![Some(n); steps.len()],
            Self::Chosen => return vec![None; steps.len()],
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
        let increments_of_step = |step: &Vec<f64>| {
            let counts = step.iter().zip(ranges).map(|(c, r)| needed(*c, *r));
            Some(counts.max().unwrap_or(0).max(1))
        };
        steps.iter().map(increments_of_step).collect()
    }
}

/// A column of a table of waypoints.
#[derive(Clone, Copy)]
pub(super) enum Column {
    /// Path time.
    Time,
    /// A load, or the motion in its place.
    Prescribed(RigidMotion, Prescribed),
    /// `sigma_B`, `sigma_B1`, `rolled`.
    Other(fn(&mut Loads) -> &mut f64),
}

/// Columns other than loads and motions.
const OTHERS: [(&str, Column); 4] = [
    ("sigma_B", Column::Other(|loads| &mut loads.sigma_B)),
    ("sigma_B1", Column::Other(|loads| &mut loads.sigma_B1)),
    ("rolled", Column::Other(|loads| &mut loads.rolled)),
    ("t", Column::Time),
];

impl Column {
    /// The column of a name; the error gives all names and the nearest one.
    pub(super) fn from_name(name: &str) -> Result<Self, Error> {
        let other_column = OTHERS.iter().find(|(other, _)| *other == name);
        let motion_column =
            RigidMotion::from_quantity(name, 0.0).map(|(of, kind)| Self::Prescribed(of, kind));
        motion_column
            .or(other_column.map(|(_, column)| *column))
            .ok_or_else(|| {
                let names = [&RigidMotion::names()[..], &OTHERS.map(|(name, _)| name)].concat();
                let nearest = names
                    .iter()
                    .min_by_key(|known| strsim::damerau_levenshtein(name, known));
                let nearest = nearest.copied().unwrap_or_default();
                let allowed = format!("one of {}; the nearest is {nearest}", names.join(", "));
                Error::invalid("path column", name, allowed)
            })
    }

    /// Writes a value of the column into the loads, or into the path time `t`.
    fn set(self, loads: &mut Loads, t: &mut f64, value: f64) {
        match self {
            Self::Time => *t = value,
            Self::Prescribed(of, kind) => loads.prescribe(of, kind.map(|_| value)),
            Self::Other(field) => *field(loads) = value,
        }
    }

    /// Value of the column at a waypoint; zero where a motion is not prescribed, and of path
    /// time.
    fn value(self, mut loads: Loads) -> f64 {
        match self {
            Self::Time => 0.0,
            Self::Prescribed(of, Prescribed::Load(_)) => loads.forces()[of.index()],
            Self::Prescribed(of, Prescribed::Motion(_)) => {
                loads.given.motions()[of.index()].unwrap_or(0.0)
            }
            Self::Other(field) => *field(&mut loads),
        }
    }
}

/// Identifies the motion that a column drives by itself or by its load.
pub(super) fn driven_motion(name: &str) -> (Option<usize>, &str) {
    match RigidMotion::from_quantity(name, 0.0) {
        Some((of, _)) => (Some(of.index()), ""),
        None => (None, name),
    }
}

impl LoadPath {
    /// Goes straight from waypoint to waypoint, one branch each. `names` are names of loads and
    /// motions, `sigma_B`, `sigma_B1`, `rolled` and the path time `t`, which grows from row to row;
    /// each row has a value for each. Quantities without a column stay as they are.
    pub fn waypoints(
        mut self,
        names: &[&str],
        rows: &[Vec<f64>],
        increments: Increments,
    ) -> Result<Self, Error> {
        let columns: Vec<Column> = names
            .iter()
            .map(|name| Column::from_name(name))
            .collect::<Result<_, _>>()?;
        for (n, name) in names.iter().enumerate() {
            if let Some(other) = names[..n]
                .iter()
                .find(|other| driven_motion(other) == driven_motion(name))
            {
                let allowed = format!("left out, since {other} is the same quantity");
                return Err(Error::invalid("path column", name, allowed));
            }
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
        let mut waypoints = vec![self.end_point()];
        for (n, row) in rows.iter().enumerate() {
            let (mut to, t) = waypoints[waypoints.len() - 1];
            let mut t_end = t + 1.0;
            for (column, value) in columns.iter().zip(row) {
                column.set(&mut to, &mut t_end, *value);
            }
            if !(t_end > t && t_end.is_finite()) {
                return Err(Error::invalid(
                    format!("t of path row {}", n + 1),
                    t_end,
                    format!(
                        "a time after {t}, the time of the row before or of the start: rows in the order of time"
                    ),
                ));
            }
            waypoints.push((to, t_end));
        }
        let range_of_column = |column: &Column| {
            let values = waypoints.iter().map(|(loads, _)| column.value(*loads));
            let extremes = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            });
            extremes[1] - extremes[0]
        };
        let ranges: Vec<f64> = columns.iter().map(range_of_column).collect();
        let changes = |pair: &[(Loads, f64)]| -> Vec<f64> {
            let change = |column: &Column| column.value(pair[1].0) - column.value(pair[0].0);
            columns.iter().map(change).collect()
        };
        let steps: Vec<Vec<f64>> = waypoints.windows(2).map(changes).collect();
        let counts = increments.per_step(&steps, &ranges);
        for ((to, t_end), increments) in waypoints.into_iter().skip(1).zip(counts) {
            self.branches.push(Branch::new(to, increments, t_end));
        }
        Ok(self)
    }
}

/// A load, motion or bulk stress that swings: its column, amplitude and phase \[rad\].
pub type Swing<'a> = (&'a str, f64, f64);

/// Distance of a turning point from a point of the period, over the distance of two points, up to which they are
/// the same: the amplitude is right to `(2 pi 1e-3/points)^2/2`, 1e-6 of it at four points.
const SAME_POINT: f64 = 1e-3;

/// Positions of the points of a period, in order: 0 to `points` - 1, and the turning points at the fractions
/// `turns` of the period, unless they coincide with a point.
fn with_turns(points: usize, turns: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut positions: Vec<f64> = (0..points).map(|n| n as f64).collect();
    for turn in turns {
        let turn = turn.rem_euclid(1.0) * points as f64;
        let is_apart = |position: &f64| {
            let distance = (turn - position).abs();
            distance.min(points as f64 - distance) > SAME_POINT
        };
        if positions.iter().all(is_apart) {
            positions.push(turn);
        }
    }
    positions.sort_by(f64::total_cmp);
    positions
}

/// Fewest points of a period of loads that swing out of phase. Between its points the path is straight, and its
/// error is of second order in their distance: with 16 points the energy of a cycle is up to 4 % too small, with 64
/// points 0.3 %.
const OUT_OF_PHASE: usize = 64;

/// Whether some loads do not reach zero together.
fn out_of_phase(swings: &[Swing<'_>]) -> bool {
    let mut phases = (swings.iter())
        .filter(|(_, amplitude, _)| *amplitude != 0.0)
        .map(|(_, _, phase)| phase);
    let first = phases.next().copied().unwrap_or(0.0);
    phases.any(|phase| (phase - first).sin().abs() > 1e-9)
}

impl LoadPath {
    /// Swings about where the path stands: `mean + amplitude sin(2 pi n/points + phase)` at n = 0, 1, ... to
    /// `periods` whole periods, and at the turning points of every swing. Loads out of phase get 64 points or more, a
    /// multiple of `points`. It is straight from point to point, in one unit of path time a period. Before, it goes
    /// to n = 0, if that is elsewhere.
    pub fn sine(
        self,
        swings: &[Swing<'_>],
        (periods, points): (usize, usize),
        increments: Increments,
    ) -> Result<Self, Error> {
        Self::check_points(points, periods)?;
        let points = if out_of_phase(swings) {
            points * OUT_OF_PHASE.div_ceil(points)
        } else {
            points
        };
        // Turning points of the sine: a quarter and three quarters of a period.
        let turns = (swings.iter())
            .filter(|(_, amplitude, _)| *amplitude != 0.0)
            .flat_map(|(_, _, phase)| [0.25, 0.75].map(|turn| turn - phase / TAU));
        let positions = with_turns(points, turns);
        let count = positions.len();
        let (start, t) = self.end_point();
        let mut names = vec!["t"];
        let mut means = Vec::new();
        for (name, ..) in swings {
            means.push(Column::from_name(name)?.value(start));
            names.push(name);
        }
        let row = |n: usize| {
            // The same bits in every period.
            let fraction = positions[n % count] / points as f64;
            let values = swings
                .iter()
                .zip(&means)
                .map(|((_, amplitude, phase), mean)| {
                    let sin = (TAU * fraction + phase).sin();
                    // The sine of half a turn is 1e-16 in floating point, and no load.
                    let is_zero = sin.abs() < 4.0 * f64::EPSILON;
                    mean + amplitude * if is_zero { 0.0 } else { sin }
                });
            let time = t + 1.0 + (n / count) as f64 + fraction;
            std::iter::once(time).chain(values).collect::<Vec<f64>>()
        };
        let mut rows: Vec<Vec<f64>> = (0..=periods * count).map(row).collect();
        let moves =
            swings
                .iter()
                .zip(&means)
                .zip(&rows[0][1..])
                .any(|(((name, ..), mean), value)| {
                    let motion = RigidMotion::from_quantity(name, 0.0);
                    motion.is_some_and(|(of, kind)| {
                        kind.is_motion() != start.prescribed(of).is_motion()
                    }) || mean != value
                });
        if !moves {
            rows.remove(0);
        }
        self.waypoints(&names, &rows, increments)
    }
}

/// Part of its range by which a periodic function may miss its start.
const CLOSES: f64 = 1e-6;
/// Part of its range by which a column exceeds its points before its turning point counts.
const EXCEEDS: f64 = 1e-6;
/// Golden sections to find a turning point between two points: to 1e-5 of their distance.
const SECTIONS: usize = 24;

/// Samples of a periodic function: times from 0 to the period, and a row of its columns for each.
pub type Samples = (Vec<f64>, Vec<Vec<f64>>);

/// Samples a periodic function at `points` points of a period, at its end, and at the turning points of its columns
/// between them (golden-section search; J. Kiefer, Proc. Am. Math. Soc. 4 (1953) 502-506).
pub fn sample_period<E>(
    mut function: impl FnMut(f64) -> Result<Vec<f64>, E>,
    (period, points): (f64, usize),
) -> Result<Samples, E> {
    let time = |position: f64| period * position / points.max(1) as f64;
    let mut rows = Vec::new();
    for n in 0..=points {
        rows.push(function(time(n as f64))?);
    }
    let columns = rows[0].len();
    let mut turns = Vec::new();
    for k in (0..columns).filter(|_| points >= FEWEST_POINTS) {
        let value = |n: usize| rows[n % points][k];
        let (low, high) = rows
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), row| {
                (low.min(row[k]), high.max(row[k]))
            });
        for n in 0..points {
            let [before, after] = [value(n) - value(n + points - 1), value(n + 1) - value(n)];
            if before * after > 0.0 || before == after {
                continue;
            }
            let sign = if before - after > 0.0 { 1.0 } else { -1.0 };
            let mut height = |position: f64| -> Result<f64, E> {
                Ok(sign * function(time(position.rem_euclid(points as f64)))?[k])
            };
            let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
            let (mut a, mut b) = (n as f64 - 1.0, n as f64 + 1.0);
            let (mut c, mut d) = (b - golden * (b - a), a + golden * (b - a));
            let (mut height_c, mut height_d) = (height(c)?, height(d)?);
            for _ in 0..SECTIONS {
                if height_c > height_d {
                    (b, d, height_d) = (d, c, height_c);
                    c = b - golden * (b - a);
                    height_c = height(c)?;
                } else {
                    (a, c, height_c) = (c, d, height_d);
                    d = a + golden * (b - a);
                    height_d = height(d)?;
                }
            }
            if height_c.max(height_d) - sign * value(n) > EXCEEDS * (high - low) {
                turns.push(if height_c > height_d { c } else { d } / points as f64);
            }
        }
    }
    let mut times = Vec::new();
    let mut sampled = Vec::new();
    for position in with_turns(points, turns.into_iter()) {
        times.push(time(position));
        sampled.push(function(time(position))?);
    }
    times.push(time(points as f64));
    sampled.extend(rows.pop());
    Ok((times, sampled))
}

impl LoadPath {
    /// Fails at too few points of a period, or at more than a path may have.
    pub fn check_points(points: usize, periods: usize) -> Result<(), Error> {
        if points < FEWEST_POINTS {
            let allowed = format!("at least {FEWEST_POINTS} points of a period");
            return Err(Error::invalid("points", points, allowed));
        }
        Self::check_branches(periods.max(1).saturating_mul(points))
    }

    /// Follows the samples of a period, the first of which is the start and the last the end, `periods` times.
    /// The period is the `period` of path time. Fails if a column does not return.
    pub fn periodic(
        self,
        names: &[&str],
        (times, rows): &Samples,
        (periods, period): (usize, f64),
        increments: Increments,
    ) -> Result<Self, Error> {
        let points = rows.len().saturating_sub(1);
        Self::check_points(points, periods)?;
        if !(period > 0.0 && period.is_finite()) {
            return Err(Error::invalid("period", period, "a positive path time"));
        }
        for (k, name) in names.iter().enumerate() {
            let column = || rows.iter().map(|row| row[k]);
            let range =
                column().fold(f64::NEG_INFINITY, f64::max) - column().fold(f64::INFINITY, f64::min);
            let miss = (rows[points][k] - rows[0][k]).abs();
            if !(miss <= CLOSES * range.max(f64::MIN_POSITIVE)) {
                let value = format!("{} after a period", rows[points][k]);
                return Err(Error::invalid(
                    *name,
                    value,
                    format!("{}, as at its start", rows[0][k]),
                ));
            }
        }
        let (_, t) = self.end_point();
        let columns: Vec<&str> = std::iter::once("t").chain(names.iter().copied()).collect();
        let row = |n: usize| {
            let time = t + period * (1 + n / points) as f64 + times[n % points];
            std::iter::once(time)
                .chain(rows[n % points].iter().copied())
                .collect()
        };
        let rows: Vec<Vec<f64>> = (0..=periods * points).map(row).collect();
        self.waypoints(&columns, &rows, increments)
    }
}

#[cfg(test)]
mod tests {
    use super::{Branch, Increments, LoadPath};

    #[test]
    fn a_sine_has_its_periods() {
        let swings = [("T_x", 3.0, 0.0), ("delta_y", 1e-6, 1.0)];
        let path = LoadPath::start().normal(10.0, 1);
        let path = path
            .sine(&swings, (2, 16), Increments::Each(1))
            .expect("a path");
        // Out of phase: 64 points. The first turns at two of them, the second between points.
        assert_eq!(path.branches.len(), 1 + 1 + 132);
        assert_eq!(path.cycles(), [(2, 67), (68, 133)]);
        let shifts = || path.branches[2..].iter().map(|b| b.to.given.delta_y);
        let largest = shifts().flatten().fold(0.0, f64::max);
        assert!((largest - 1e-6).abs() < 1e-18);
        let path =
            LoadPath::start()
                .normal(10.0, 1)
                .sine(&swings[..1], (2, 16), Increments::Each(1));
        assert_eq!(path.expect("a path").cycles(), [(1, 16), (17, 32)]);
        let few = LoadPath::start().sine(&swings, (2, 3), Increments::Each(1));
        assert!(few.expect_err("refused").to_string().contains("points"));
    }

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
            (
                ["t", "W", "T_x"],
                &[vec![2.0, 1.0, 0.0], vec![1.0, 1.0, 0.0]][..],
                "t of path row 2 = 1: must be a time after 2",
            ),
            (
                ["t", "W", "T_x"],
                &[vec![f64::NAN, 1.0, 0.0]][..],
                "t of path row 1 = NaN",
            ),
        ] {
            let result = LoadPath::start().waypoints(&names, rows, Increments::Each(1));
            let text = result.expect_err("refused").to_string();
            assert!(text.contains(part), "{text}");
        }
    }

    #[test]
    fn increments_of_waypoints_and_ellipses_are_left_to_be_chosen() {
        let rows = [vec![100.0, 0.0], vec![100.0, 20.0]];
        let path = LoadPath::start().waypoints(&["W", "T_x"], &rows, Increments::Chosen);
        let path = path.expect("a path").ellipse((2.0, 1.0), 2, None);
        assert!(path.branches.iter().all(|b| b.increments.is_none()));
        let (ends, points) = (path.branches.len() - 3, path.points());
        assert!(ends.is_multiple_of(2) && points.len() == ends + 3);
        for point in &points[2..] {
            let x = (point.loads.T_x - 20.0) / 2.0;
            assert!((x.hypot(point.loads.T_y) - 1.0).abs() < 1e-13);
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
