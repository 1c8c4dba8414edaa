//! Numbers on points of the contact plane: heights, friction.

use std::path::Path;
use std::sync::Arc;

use ndarray::{Array2, ArrayView2};

use super::Grid;
use super::centred::{Centred, centre};
use super::files;
use super::missing::{Missing, treat_holes};
use super::number_files::{FileOfNumbers, Heights, read_heights};
use crate::digits::short;
use crate::error::Error;

/// Smallest and largest side of a map of an instrument \[m\]: a scan of 0.1 um, a stage of 0.5 m.
const SIDES: (f64, f64) = (1e-7, 0.5);

/// Numbers on points of the contact plane; the middle of the map lies over the origin.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    /// Numbers, shape (points along x, along y).
    pub values: Arc<Array2<f64>>,
    /// Distance of the points along x and y \[m\].
    pub spacing: (f64, f64),
    /// Number of points that were not measured and have the mean of their neighbours.
    pub filled: usize,
}

/// Maps of the same numbers on the same points are equal.
impl PartialEq for SurfaceMap {
    fn eq(&self, other: &Self) -> bool {
        self.spacing == other.spacing && self.values == other.values
    }
}

impl SurfaceMap {
    /// Reads numbers from a `.npy` array, or from text: a table, one line per x, points x, y and
    /// height in any order, Gwyddion's export, an ESRI grid. `format` gives the facts that the file
    /// does not.
    pub fn from_file(path: &Path, format: &FileOfNumbers) -> Result<Self, Error> {
        // Readers may give several lines; an error is one sentence.
        let failed = |message: String| Error::File {
            path: path.display().to_string(),
            message: message.split_whitespace().collect::<Vec<_>>().join(" "),
        };
        let has_points = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("xyz"));
        let Heights { values, spacing } =
            read_heights(files::read(path)?, format, has_points).map_err(failed)?;
        let (values, filled) = treat_holes(values, format.missing).map_err(failed)?;
        let map = Self {
            values: Arc::new(values),
            spacing,
            filled,
        };
        map.check("map").map_err(|e| failed(e.to_string()))?;
        check_sides(map.values.dim(), spacing).map_err(failed)?;
        Ok(map)
    }

    /// Builds a map of numbers on points with a `spacing` \[m\]; `missing` is the treatment of NaN.
    pub fn new(values: Array2<f64>, spacing: (f64, f64), missing: Missing) -> Result<Self, Error> {
        let (values, filled) = treat_holes(values, missing)
            .map_err(|holes| Error::invalid("map", holes, "a number at every point"))?;
        let map = Self {
            values: Arc::new(values),
            spacing,
            filled,
        };
        map.check("map")?;
        Ok(map)
    }

    /// Builds a map of measured heights less their mean; returns its S_q as well.
    pub fn from_heights(
        heights: &ArrayView2<'_, f64>,
        spacing: (f64, f64),
        missing: Missing,
    ) -> Result<(Self, f64), Error> {
        let Centred { values, holes, rms } = centre(heights).map_err(|(i, j)| {
            Error::invalid(
                format!("map.z[{i}, {j}]"),
                heights[(i, j)],
                "a finite number",
            )
        })?;
        if holes > 0 || values.is_empty() {
            let map = Self::new(values, spacing, missing)?;
            let rms = map.rms();
            return Ok((map, rms));
        }
        let map = Self {
            values: Arc::new(values),
            spacing,
            filled: 0,
        };
        map.check_spacing("map")?;
        Ok((map, rms))
    }

    /// Root of the mean square about the mean over the points: S_q of heights, after ISO 25178-2.
    pub fn rms(&self) -> f64 {
        let z = &self.values;
        let mean = z.mean().unwrap_or_default();
        // `fold` follows the order of the memory, which `iter` does not.
        let square = z.fold(0.0, |sum, z| sum + (z - mean).powi(2));
        (square / z.len() as f64).sqrt()
    }

    /// Largest less smallest number: S_z of heights, after ISO 25178-2.
    pub fn peak_to_valley(&self) -> f64 {
        let range = (f64::INFINITY, f64::NEG_INFINITY);
        let range = (self.values).fold(range, |(low, high), z| (low.min(*z), high.max(*z)));
        range.1 - range.0
    }

    /// The number at (x, y), linear between the points, level beyond the border.
    pub(crate) fn interpolate(&self, x: f64, y: f64) -> f64 {
        let (nx, ny) = self.values.dim();
        let (i, s) = index_and_fraction(x / self.spacing.0, nx);
        let (j, t) = index_and_fraction(y / self.spacing.1, ny);
        let (k, l) = ((i + 1).min(nx - 1), (j + 1).min(ny - 1));
        let z = &self.values;
        (1.0 - s) * ((1.0 - t) * z[(i, j)] + t * z[(i, l)])
            + s * ((1.0 - t) * z[(k, j)] + t * z[(k, l)])
    }

    /// Fails if it holds no number, one that is not finite, or has no spacing; `key` is the key of the map.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        if self.values.is_empty() {
            return Err(Error::invalid(
                format!("{key}.z"),
                "empty",
                "at least one number",
            ));
        }
        let infinite = |first: Option<f64>, z: &f64| first.or((!z.is_finite()).then_some(*z));
        if let Some(z) = self.values.fold(None, infinite) {
            return Err(Error::invalid(format!("{key}.z"), z, "finite numbers"));
        }
        self.check_spacing(key)
    }

    /// Fails if a distance of the points is not a positive length.
    fn check_spacing(&self, key: &str) -> Result<(), Error> {
        for d in [self.spacing.0, self.spacing.1] {
            if !(d > 0.0 && d.is_finite()) {
                return Err(Error::invalid(
                    format!("{key}.spacing"),
                    d,
                    "a positive length in m",
                ));
            }
        }
        Ok(())
    }

    /// Fails if the map does not cover the grid; the error suggests the largest grid that it covers.
    pub(crate) fn check_on(&self, grid: &Grid, key: &str) -> Result<(), Error> {
        let (nx, ny) = self.values.dim();
        let covers = |n: usize, d: f64, cells: usize, cell: f64| {
            n as f64 * d >= cells as f64 * cell * (1.0 - 1e-9)
        };
        let (x, y) = self.spacing;
        if covers(nx, x, grid.nx, grid.dx) && covers(ny, y, grid.ny, grid.dy) {
            return Ok(());
        }
        let size = (nx as f64 * x, ny as f64 * y);
        let suggestion = grid.fit_into(size).map_or(String::new(), |grid| {
            let ((x, y), (nx, ny)) = (grid.extent(), (grid.nx, grid.ny));
            let (x, y) = (round_down(x), round_down(y));
            if grid.plane_strain {
                return format!(": with these cells that is Grid.strip(extent={x:e}, n={nx}) at most");
            }
            format!(
                ": with these cells that is Grid.centred(width=({x:e}, {y:e}), n=({nx}, {ny})) at most, in a \
                 scene file extent = [{x:e}, {y:e}] and n = [{nx}, {ny}]"
            )
        });
        Err(Error::invalid(
            key,
            format!("{:e} m by {:e} m", size.0, size.1),
            format!("at least as large as the grid{suggestion}"),
        ))
    }
}

/// Refuses a map of a file that is larger or smaller than any instrument measures; its unit is another one.
pub fn check_sides(shape: (usize, usize), spacing: (f64, f64)) -> Result<(), String> {
    for (axis, count, step) in [("x", shape.0, spacing.0), ("y", shape.1, spacing.1)] {
        let side = count as f64 * step;
        if count > 1 && !(SIDES.0..=SIDES.1).contains(&side) {
            return Err(format!(
                "the map is {} m long in {axis}, {count} points that are {} m apart: must be {:e} to {} m. \
                 The unit of its lengths is likely another one. If you know the distance of the points, \
                 give spacing = 2e-6, in m",
                short(side),
                short(step),
                SIDES.0,
                SIDES.1
            ));
        }
    }
    Ok(())
}

/// Rounds a length down to six digits.
fn round_down(length: f64) -> f64 {
    let shift = 5 - length.log10().floor() as i32;
    let (up, down) = (10f64.powi(shift.max(0)), 10f64.powi((-shift).max(0)));
    (length * up / down * (1.0 + 1e-12)).floor() * down / up
}

/// Index of the point before a position (in spacings from the middle), and the fraction of the spacing beyond it.
fn index_and_fraction(position: f64, n: usize) -> (usize, f64) {
    let position = (position + (n - 1) as f64 / 2.0).clamp(0.0, (n - 1) as f64);
    (position.floor() as usize, position.fract())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use ndarray::Array2;

    use super::SurfaceMap;

    #[test]
    fn a_plane_is_interpolated_exactly() {
        let values = Array2::from_shape_fn((5, 4), |(i, j)| 2.0 * i as f64 - 3.0 * j as f64);
        let map = SurfaceMap {
            values: Arc::new(values),
            spacing: (0.5, 0.25),
            filled: 0,
        };
        let (middle_i, middle_j) = (2.0, 1.5);
        for (x, y) in [(0.0, 0.0), (0.3, -0.1), (-0.99, 0.37)] {
            let expected = 2.0 * (x / 0.5 + middle_i) - 3.0 * (y / 0.25 + middle_j);
            assert!((map.interpolate(x, y) - expected).abs() < 1e-13);
        }
        let beyond = map.interpolate(-9.0, -9.0);
        assert!(beyond.abs() < 1e-15, "{beyond}");
    }
}
