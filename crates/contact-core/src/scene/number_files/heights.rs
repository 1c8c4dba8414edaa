//! Interpretation of the numbers of a file: a map, points on a lattice, a profile.

use ndarray::Array2;

use super::npy;
use super::points::Lattice;
use super::profile::profile_message;
use super::raster::{EsriGrid, Header};
use super::table::Table;
use super::text::decode_any;
use super::unit::{self, Kind};
use crate::scene::Missing;

/// Facts about a file of numbers that the file may leave open.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileOfNumbers {
    /// Distance of the points along x and y \[m\]; `None` where the file gives it.
    pub spacing: Option<(f64, f64)>,
    /// Unit of the numbers, also of x and y in a list of points, such as "um"; `None` for the unit of
    /// the file, or SI where it has none.
    pub unit: Option<String>,
    /// Column of the numbers in a list of points, by its title or its number from 1, or
    /// the name of the channel in Gwyddion's text; `None` where there is only one.
    pub channel: Option<String>,
    /// Treatment of points without a number.
    pub missing: Missing,
}

/// Numbers of a file with the distance of their points \[m\].
#[derive(Debug)]
pub(in crate::scene) struct Heights {
    /// Shape (points along x, along y), in SI units; NaN where there is no number.
    pub(in crate::scene) values: Array2<f64>,
    pub(in crate::scene) spacing: (f64, f64),
}

/// Lines from which on two columns are a profile.
const PROFILE: usize = 8;
/// Lines from which on three columns are points.
const POINTS: usize = 16;
/// Relative difference of two lengths that are the same: headers have few digits.
const SAME: f64 = 1e-3;

/// Reads the heights in a file; the error gives the fault and its remedy. `has_points` is true for the
/// extension `.xyz`.
pub(in crate::scene) fn read_heights(
    bytes: Vec<u8>,
    format: &FileOfNumbers,
    has_points: bool,
) -> Result<Heights, String> {
    let reader = Interpreter {
        format,
        unit: format.unit.as_deref().map(unit_of_length).transpose()?,
    };
    if npy::is_npy(&bytes) {
        let values = npy::read(bytes)?;
        return reader.place_array(values, None);
    }
    let text = decode_any(bytes)?;
    if let Some(grid) = EsriGrid::parse(&text) {
        let EsriGrid {
            values,
            pitch: (x, y),
        } = grid?;
        let scale = reader.unit.unwrap_or(1.0);
        return reader.place_with_pitch(values * scale, (x * scale, y * scale));
    }
    let mut table = Table::parse(&text)?;
    if table.rows() == 0 {
        return Err("holds no number".into());
    }
    if let Some(header) = Header::parse(&table.comments)? {
        return reader.place_picture(&table, &header);
    }
    table.leave_out_index()?;
    let (names, units) = unit::names_and_units(&table.titles(), table.columns);
    if let Some(columns) = Columns::find(&table, &names, format, has_points)? {
        return reader.place_points(&table, &columns, &units);
    }
    check_map(&table, &names)?;
    let unit = units.iter().flatten().next();
    if let Some(other) = units.iter().flatten().find(|other| Some(*other) != unit) {
        let first = unit.map_or("", String::as_str);
        return Err(format!(
            "columns in `{first}` and in `{other}` are no map of one quantity"
        ));
    }
    let shape = (table.rows(), table.columns);
    let unit = unit.cloned();
    let unit = unit.or_else(|| unit::unit_of_table(&table.titles(), &table.comments));
    let values = Array2::from_shape_vec(shape, table.numbers).map_err(|e| e.to_string())?;
    reader.place_array(values, unit.as_deref())
}

/// The size of a unit of length, such as `um`, in m.
fn unit_of_length(word: &str) -> Result<f64, String> {
    let length_unit = unit::named(word).filter(|(kind, _)| *kind == Kind::Length);
    let allowed = || {
        format!(
            "unit = `{word}`: must be one of {}",
            unit::names(Kind::Length)
        )
    };
    length_unit.map(|(_, size)| size).ok_or_else(allowed)
}

/// Fails if rows and columns are no map: a profile, points on no even grid, or numbers beside an index.
fn check_map(table: &Table, names: &[String]) -> Result<(), String> {
    let (rows, columns) = (table.rows(), table.columns);
    let is_evenly_spaced = |n: usize| {
        let x: Vec<f64> = table.column(n).collect();
        let mean = (x[rows - 1] - x[0]) / (rows - 1).max(1) as f64;
        mean > 0.0
            && x.windows(2)
                .all(|pair| (pair[1] - pair[0] - mean).abs() < 0.1 * mean)
    };
    let narrow = rows.min(columns);
    let is_profile = narrow == 1
        || narrow == 2 && rows.max(columns) >= PROFILE
        || columns == 2
            && (names.iter().any(|name| is_axis(name, 'x'))
                || rows > 2 && (is_evenly_spaced(0) || is_evenly_spaced(1)));
    if is_profile {
        return Err(profile_message(rows.max(columns)));
    }
    let is_constant = |n: usize| {
        let mut column = table.column(n);
        let first = column.next();
        column.all(|x| Some(x) == first)
    };
    if columns == 3 && rows >= PROFILE && (is_constant(0) || is_constant(1)) {
        return Err(profile_message(rows));
    }
    if columns == 3 && rows >= POINTS {
        return Err(format!(
            "{rows} lines of three numbers are points x, y and height on no even grid. Each place of an even grid must \
             have one point along x and y. Interpolate them to such a grid"
        ));
    }
    table.check_no_index()
}

/// Whether a title names an axis: `x`, `X_pos`, `x-position`.
fn is_axis(name: &str, axis: char) -> bool {
    let mut letters = name.trim().chars();
    letters
        .next()
        .is_some_and(|c| c.eq_ignore_ascii_case(&axis))
        && letters.next().is_none_or(|c| !c.is_alphanumeric())
}

/// The columns of a list of points, and the lattice they lie on.
struct Columns {
    x: usize,
    y: usize,
    value: usize,
    lattice: Lattice,
}

impl Columns {
    /// Finds the columns of x, y and the value, if the table is a list of points on a lattice; none if it is a
    /// map.
    fn find(
        table: &Table,
        names: &[String],
        format: &FileOfNumbers,
        has_points: bool,
    ) -> Result<Option<Self>, String> {
        let (rows, columns) = (table.rows(), table.columns);
        let axis_column = |axis| names.iter().position(|name| is_axis(name, axis));
        let lattice = |x, y| Lattice::find(table.column(x), table.column(y), rows);
        let with_values = |x, y, lattice| {
            let value = value_column(columns, (x, y), names, format)?;
            Ok(Some(Self {
                x,
                y,
                value,
                lattice,
            }))
        };
        if let (Some(x), Some(y), true) = (axis_column('x'), axis_column('y'), columns > 2) {
            let lattice = lattice(x, y).ok_or_else(|| no_lattice_message((x, y), rows))?;
            return with_values(x, y, lattice);
        }
        let pairs: &[(usize, usize)] = match columns {
            3 if rows >= 4 => &[(0, 1), (0, 2), (1, 2)],
            4..10 if rows >= 9 => &[(0, 1)],
            _ => &[],
        };
        let points_on_lattice = pairs
            .iter()
            .find_map(|&(x, y)| Some((x, y, lattice(x, y)?)));
        if let Some((x, y, lattice)) = points_on_lattice {
            return with_values(x, y, lattice);
        }
        let is_near_lattice =
            |&&(x, y): &&(usize, usize)| Lattice::is_near(table.column(x), table.column(y), rows);
        match pairs.iter().find(is_near_lattice) {
            Some((x, y)) => Err(no_lattice_message((*x, *y), rows)),
            None if has_points => Err(no_lattice_message((0, 1), rows)),
            None => Ok(None),
        }
    }
}

/// The message for `rows` points x, y that lie on no lattice.
fn no_lattice_message((x, y): (usize, usize), rows: usize) -> String {
    format!(
        "columns {} and {}: {rows} points x and y on no even grid. Each place of an even grid must have \
         one point, at most a tenth of a step off it. Interpolate them to such a grid",
        x + 1,
        y + 1
    )
}

/// Column of the values in a list of points with the columns x and y.
fn value_column(
    columns: usize,
    (x, y): (usize, usize),
    names: &[String],
    format: &FileOfNumbers,
) -> Result<usize, String> {
    let candidates: Vec<usize> = (0..columns).filter(|n| *n != x && *n != y).collect();
    let name = |n: usize| {
        names
            .get(n)
            .map_or_else(|| (n + 1).to_string(), Clone::clone)
    };
    if let Some(channel) = &format.channel {
        let by_name = candidates.iter().find(|n| name(**n) == *channel);
        let by_number = channel.parse::<usize>().ok().map(|n| n.wrapping_sub(1));
        let by_number = by_number.filter(|n| candidates.contains(n));
        if let Some(n) = by_name.copied().or(by_number) {
            return Ok(n);
        }
    } else if let [only] = candidates[..] {
        return Ok(only);
    } else {
        let is_height = |n: &&usize| {
            matches!(
                name(**n).to_lowercase().as_str(),
                "z" | "height" | "heights" | "h"
            )
        };
        let mut height_columns = candidates.iter().filter(is_height);
        if let (Some(only), None) = (height_columns.next(), height_columns.next()) {
            return Ok(*only);
        }
    }
    let names_of_all: Vec<String> = candidates
        .iter()
        .map(|n| format!("`{}`", name(*n)))
        .collect();
    let missing_channel = format
        .channel
        .as_ref()
        .map_or_else(String::new, |channel| format!("none is `{channel}`; "));
    Err(format!(
        "points with {} columns beside x and y: {}: {missing_channel}choose one with channel",
        candidates.len(),
        names_of_all.join(", ")
    ))
}

/// Interpretation of numbers of one kind or another with the facts from the caller.
struct Interpreter<'a> {
    format: &'a FileOfNumbers,
    /// Size of the unit from the caller.
    unit: Option<f64>,
}

impl Interpreter<'_> {
    /// The size in m of the unit of a file, from the user's unit and the `word` in the file, which must agree.
    fn unit_size(&self, word: Option<&str>) -> Result<f64, String> {
        let Some(word) = word else {
            return Ok(self.unit.unwrap_or(1.0));
        };
        let requested = self.format.unit.as_deref().unwrap_or_default();
        match (unit::named(word), self.unit) {
            (Some((Kind::Length, size)), None) => Ok(size),
            (Some((Kind::Length, size)), Some(unit)) if is_close(size, unit) => Ok(size),
            (Some((Kind::Length, _)), Some(_)) => Err(format!(
                "has numbers in {word}, but unit = `{requested}`: leave unit out, or correct the file"
            )),
            (None, Some(unit)) => Ok(unit),
            _ => Err(format!(
                "has numbers in `{word}`, which is no unit of length: must be one of {}. If they \
                 are lengths all the same, give their unit with unit",
                unit::names(Kind::Length)
            )),
        }
    }

    /// Fails for a channel that the file does not have: only a list of points, or a text of Gwyddion, has channels.
    fn check_channel(&self, has: Option<&str>) -> Result<(), String> {
        match (&self.format.channel, has) {
            (Some(wanted), Some(has)) if wanted != has => {
                Err(format!("has the channel `{has}`, none `{wanted}`"))
            }
            (Some(wanted), None) => Err(format!("has one channel without a name, none `{wanted}`")),
            _ => Ok(()),
        }
    }

    /// Scales an array of numbers and gives it the spacing of the format.
    fn place_array(&self, values: Array2<f64>, unit: Option<&str>) -> Result<Heights, String> {
        self.check_channel(None)?;
        let spacing = self.format.spacing.ok_or_else(|| {
            let (nx, ny) = values.dim();
            format!("{nx} by {ny} plain numbers need the distance of the points in m, such as spacing = 2e-6")
        })?;
        let scale = self.unit_size(unit)?;
        Ok(Heights {
            values: values * scale,
            spacing,
        })
    }

    /// Interprets numbers of a file that gives the distance of its points \[m\].
    fn place_with_pitch(&self, values: Array2<f64>, pitch: (f64, f64)) -> Result<Heights, String> {
        let spacing = match self.format.spacing {
            None => pitch,
            Some(given) if is_close(given.0, pitch.0) && is_close(given.1, pitch.1) => given,
            Some((x, y)) => {
                return Err(format!(
                    "has points {:.6e} m by {:.6e} m apart, but spacing = ({x:e} m, {y:e} m). \
                     Either leave spacing out or give the unit of the file with unit",
                    pitch.0, pitch.1
                ));
            }
        };
        Ok(Heights { values, spacing })
    }

    /// Scales the rows below a header of Gwyddion, which has their extent and unit.
    fn place_picture(&self, table: &Table, header: &Header) -> Result<Heights, String> {
        if let Some(channel) = &header.channel {
            self.check_channel(Some(channel))?;
        }
        let values = Header::values(table)?;
        let (nx, ny) = values.dim();
        let scale = self.unit_size(header.unit.as_deref().filter(|unit| !unit.is_empty()))?;
        let pitch = (header.size.0 / nx as f64, header.size.1 / ny as f64);
        self.place_with_pitch(values * scale, pitch)
    }

    /// Arranges a list of points x, y, value on their lattice, with the units of the three columns.
    fn place_points(
        &self,
        table: &Table,
        columns: &Columns,
        units: &[Option<String>],
    ) -> Result<Heights, String> {
        let Columns {
            x,
            y,
            value,
            lattice,
        } = columns;
        let unit = |n: usize| units[n].as_deref();
        let rows = table.numbers.chunks_exact(table.columns);
        let points = rows.map(|row| [row[*x], row[*y], row[*value]]);
        let values = lattice.arrange(points).map_err(|(first, second)| {
            format!(
                "lines {} and {} are points at one place: must be one height for each",
                table.lines[first], table.lines[second]
            )
        })?;
        let values = values * self.unit_size(unit(*value))?;
        let pitch = lattice.pitch();
        let x_and_y_count =
            is_close(pitch.0, 1.0) && is_close(pitch.1, 1.0) && unit(*x).or(unit(*y)).is_none();
        match self.format.spacing {
            Some(spacing) if x_and_y_count => Ok(Heights { values, spacing }),
            None if x_and_y_count && self.unit.is_none() => Err(
                "x and y of its points count them: give their distance in m, such as spacing = 2e-6, or their unit, \
                 such as unit = um"
                    .into(),
            ),
            _ => {
                let pitch = (pitch.0 * self.unit_size(unit(*x))?, pitch.1 * self.unit_size(unit(*y))?);
                self.place_with_pitch(values, pitch)
            }
        }
    }
}

/// Whether two numbers agree to rounding.
fn is_close(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * b.abs()
}
