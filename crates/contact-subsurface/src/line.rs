//! A straight line on the surface, below which a section lies.

use super::depth::{Depth, Point};
use contact_core::scene::Grid;
use contact_core::zones::{Outline, principal_azimuth};

/// A straight line on the surface, through the centres of cells or anywhere between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    /// Along x at this y \[m\].
    AlongX(f64),
    /// Along y at this x \[m\].
    AlongY(f64),
    /// Through a point x, y \[m\] in a direction.
    Through {
        /// x of the point \[m\].
        x: f64,
        /// y of the point \[m\].
        y: f64,
        /// Angle of the direction to the x axis \[rad\].
        azimuth: f64,
    },
}

/// Sine or cosine of an angle to an axis below which a line runs along that axis.
const ALIGNED: f64 = 1e-3;

/// Smaller over larger half-width of a round contact, at least, and smaller over larger principal
/// value of a shear along one line, at most: then what is largest lies in the plane of the shear.
const ROUND: f64 = 0.8;
const ONE_WAY: f64 = 0.1;
/// Sine of the angle to an axis of the grid below which the section of a contact of several spots runs
/// along that axis. Such a contact has no plane of symmetry that a section would have to follow, and a
/// section along an axis is computed by transforms. A shear in all directions, as of a rough surface
/// that is pressed alone, gives no direction either.
const SCATTERED: f64 = 0.1;
/// Sine of the angle between a shear and a stress beside the contact that does not turn it.
const IN_LINE: f64 = 0.05;

impl Line {
    /// The sections in which a contact is looked at, from its outlines over a cycle, or from one.
    ///
    /// The first passes through the centre of the largest outline, along the shear of all of them, or
    /// along x where the shear has no direction. `beside` are the directions of bulk and residual
    /// stress \[rad\]. One section is enough for a round contact that is sheared to and fro along one
    /// line, with all other stress along that line: the largest stress lies in the plane of the shear.
    /// A second section stands across the first. Two more stand between them where a stress beside the
    /// contact has another direction than the shear: the worst plane then lies between the two.
    pub fn for_outlines(outlines: &[&Outline], beside: &[f64]) -> Vec<Self> {
        let area = |o: &&&Outline| o.spots.iter().map(|spot| spot.area).sum::<f64>();
        let Some(largest) = outlines.iter().max_by(|a, b| area(a).total_cmp(&area(b))) else {
            return vec![Self::AlongX(0.0)];
        };
        let mut shear = [0.0; 3];
        for outline in outlines {
            for (sum, one) in shear.iter_mut().zip(outline.shear) {
                *sum += one;
            }
        }
        let [xx, xy, yy] = shear;
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let is_along_one_line = mean - half <= ONE_WAY * (mean + half);
        let is_rough = largest.spots.len() > 1;
        let principal = principal_azimuth(shear);
        let azimuth = principal
            .filter(|_| is_along_one_line || !is_rough)
            .map(|azimuth| match azimuth.sin_cos() {
                (sin, _) if is_rough && sin.abs() < SCATTERED => 0.0,
                (_, cos) if is_rough && cos.abs() < SCATTERED => std::f64::consts::FRAC_PI_2,
                _ => largest.snap_azimuth(azimuth),
            });
        let main = Self::through(largest.centre, azimuth.unwrap_or(0.0));
        if largest.is_flat() {
            return vec![main];
        }
        let (a, b, _) = largest.half_widths();
        let one_way = principal.is_none() || is_along_one_line;
        let in_line = |direction: &f64| (direction - main.azimuth()).sin().abs() < IN_LINE;
        let in_line = beside.iter().all(in_line);
        if b >= ROUND * a && one_way && in_line {
            return vec![main];
        }
        let turns: &[f64] = if in_line { &[0.5] } else { &[0.5, 0.25, 0.75] };
        let turned = turns.iter().map(|turn| {
            let azimuth = main.azimuth() + turn * std::f64::consts::PI;
            Self::through(largest.centre, azimuth)
        });
        std::iter::once(main).chain(turned).collect()
    }

    /// A line through a point in a direction; along x or along y if the direction is an axis.
    pub fn through((x, y): (f64, f64), azimuth: f64) -> Self {
        let (sin, cos) = azimuth.sin_cos();
        if sin.abs() < ALIGNED {
            Self::AlongX(y)
        } else if cos.abs() < ALIGNED {
            Self::AlongY(x)
        } else {
            Self::Through { x, y, azimuth }
        }
    }

    /// Angle of the direction to the x axis \[rad\].
    pub fn azimuth(self) -> f64 {
        match self {
            Self::AlongX(_) => 0.0,
            Self::AlongY(_) => std::f64::consts::FRAC_PI_2,
            Self::Through { azimuth, .. } => azimuth,
        }
    }

    /// Unit vector along the line.
    pub fn direction(self) -> [f64; 2] {
        match self {
            Self::AlongX(_) => [1.0, 0.0],
            Self::AlongY(_) => [0.0, 1.0],
            Self::Through { azimuth, .. } => [azimuth.cos(), azimuth.sin()],
        }
    }

    /// Name of the place along the line: x, y, or s from the given point on.
    pub fn name(self) -> &'static str {
        match self {
            Self::AlongX(_) => "x",
            Self::AlongY(_) => "y",
            Self::Through { .. } => "s",
        }
    }

    /// x, y of the place where the distance s along the line is 0 \[m\].
    fn origin(self) -> (f64, f64) {
        match self {
            Self::AlongX(y) => (0.0, y),
            Self::AlongY(x) => (x, 0.0),
            Self::Through { x, y, .. } => (x, y),
        }
    }

    /// x, y at the distance s along the line and t to the left of it \[m\].
    pub fn offset_place(self, s: f64, t: f64) -> (f64, f64) {
        let ((x, y), [cos, sin]) = (self.origin(), self.direction());
        match self {
            Self::AlongX(_) => (s, y + t),
            Self::AlongY(_) => (x - t, s),
            Self::Through { .. } => (x + s * cos - t * sin, y + s * sin + t * cos),
        }
    }

    /// x, y at the distance s along the line \[m\].
    pub fn place(self, s: f64) -> (f64, f64) {
        self.offset_place(s, 0.0)
    }

    /// A point below a place of the line.
    pub fn point(self, s: f64, depth: Depth) -> Point {
        let (x, y) = self.place(s);
        (x, y, depth)
    }

    /// The distance s of the place on the line that is nearest to x, y \[m\].
    pub fn nearest_distance(self, x: f64, y: f64) -> f64 {
        match self {
            Self::AlongX(_) => x,
            Self::AlongY(_) => y,
            Self::Through {
                x: x_0,
                y: y_0,
                azimuth,
            } => (x - x_0) * azimuth.cos() + (y - y_0) * azimuth.sin(),
        }
    }

    /// A parallel line at a distance t to the left \[m\].
    #[must_use]
    pub fn parallel(self, t: f64) -> Self {
        let (x, y) = self.offset_place(self.nearest_distance(self.origin().0, self.origin().1), t);
        match self {
            Self::AlongX(_) => Self::AlongX(y),
            Self::AlongY(_) => Self::AlongY(x),
            Self::Through { azimuth, .. } => Self::Through { x, y, azimuth },
        }
    }

    /// This line in coordinates with another origin (x_0, y_0), and the s of this line \[m\] at which s of the
    /// returned line is 0.
    #[must_use]
    pub fn with_origin(self, (x_0, y_0): (f64, f64)) -> (Self, f64) {
        match self {
            Self::AlongX(y) => (Self::AlongX(y - y_0), x_0),
            Self::AlongY(x) => (Self::AlongY(x - x_0), y_0),
            Self::Through { x, y, azimuth } => {
                let (x, y) = (x - x_0, y - y_0);
                (Self::Through { x, y, azimuth }, 0.0)
            }
        }
    }

    /// Distance of samples on a grid \[m\]: the cell length for a line along an axis.
    pub fn step(self, grid: &Grid) -> f64 {
        match self {
            Self::AlongX(_) => grid.dx,
            Self::AlongY(_) => grid.dy,
            Self::Through { azimuth, .. } => {
                (azimuth.cos() * grid.dx).hypot(azimuth.sin() * grid.dy)
            }
        }
    }

    /// Distances s of the samples on a grid \[m\]: the middles of the cells for a line along an axis, otherwise
    /// equal steps from the given point to the borders of the grid.
    pub fn places(self, grid: &Grid) -> Vec<f64> {
        match self {
            Self::AlongX(_) => (0..grid.nx).map(|i| grid.x(i)).collect(),
            Self::AlongY(_) => (0..grid.ny).map(|j| grid.y(j)).collect(),
            Self::Through { x, y, .. } => {
                let (step, [cos, sin]) = (self.step(grid), self.direction());
                let (half_x, half_y) = (grid.extent().0 / 2.0, grid.extent().1 / 2.0);
                // The way to the border of the grid, forwards or backwards.
                let steps_to_border = |sign: f64| {
                    let distance_to = |v: f64, half: f64, part: f64| {
                        ((half - v * part.signum()) / part.abs()).max(0.0)
                    };
                    (distance_to(x, half_x, sign * cos).min(distance_to(y, half_y, sign * sin))
                        / step) as isize
                };
                (-steps_to_border(-1.0)..=steps_to_border(1.0))
                    .map(|n| n as f64 * step)
                    .collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The section of two spots of pressure with shear in a direction \[rad\], or in all directions.
    fn section_of_spots(centres: &[f64], azimuth: Option<f64>) -> Line {
        let grid = Grid::from_spacing((40, 40), (1.0, 1.0)).expect("a grid");
        let p = grid.map(|x, y| {
            let near = centres.iter().any(|c| (x - c).hypot(y - 0.3 * c) < 4.2);
            f64::from(u8::from(near))
        });
        let turned = |x: f64, y: f64| azimuth.unwrap_or(0.1 + if x * y > 0.0 { 0.0 } else { 1.2 });
        let cells = grid.map(turned);
        let q_x = ndarray::Zip::from(&p)
            .and(&cells)
            .map_collect(|p, a| 0.1 * p * a.cos());
        let q_y = ndarray::Zip::from(&p)
            .and(&cells)
            .map_collect(|p, a| 0.1 * p * a.sin());
        let tractions = contact_core::convolution::Tractions {
            p: p.as_slice(),
            q_x: q_x.as_slice(),
            q_y: q_y.as_slice(),
        };
        let outline = Outline::new(&grid, &tractions).expect("a contact");
        Line::for_outlines(&[&outline], &[])[0]
    }

    #[test]
    fn the_section_of_several_spots_runs_along_a_near_axis() {
        let along_x = |line: Line| matches!(line, Line::AlongX(_));
        let spots = [-9.0, 9.0];
        assert!(along_x(section_of_spots(&spots, Some(0.08))));
        assert!(matches!(
            section_of_spots(&spots, Some(1.53)),
            Line::AlongY(_)
        ));
        assert!(along_x(section_of_spots(&spots, None)));
        // A shear that is far from both axes keeps its direction, and so does the shear of a single spot.
        assert!(!along_x(section_of_spots(&spots, Some(0.7))));
        assert!(!along_x(section_of_spots(&[0.0], Some(0.2))));
    }

    #[test]
    fn a_line_finds_its_own_places() {
        let grid = Grid::from_spacing((40, 30), (1.0, 1.5)).expect("a grid");
        for line in [
            Line::AlongX(0.3),
            Line::AlongY(-2.0),
            Line::Through {
                x: 1.0,
                y: -0.5,
                azimuth: 0.7,
            },
            Line::Through {
                x: 0.0,
                y: 2.0,
                azimuth: -2.0,
            },
        ] {
            let places = line.places(&grid);
            assert!(places.len() > 20);
            assert!((places[1] - places[0] - line.step(&grid)).abs() < 1e-12);
            for s in places {
                let (x, y) = line.place(s);
                assert!((line.nearest_distance(x, y) - s).abs() < 1e-12);
                assert!(x.abs() <= 20.0 && y.abs() <= 22.5, "{x} {y}");
                let (moved, more) = line.with_origin((0.4, -0.2));
                let (u, v) = moved.place(s - more);
                assert!((u + 0.4 - x).abs() < 1e-12 && (v - 0.2 - y).abs() < 1e-12);
                let (u, v) = line.parallel(2.0).place(s);
                assert!(((u - x).hypot(v - y) - 2.0).abs() < 1e-12);
            }
        }
        assert_eq!(Line::through((1.0, 2.0), 1e-9), Line::AlongX(2.0));
        assert_eq!(
            Line::through((1.0, 2.0), std::f64::consts::FRAC_PI_2),
            Line::AlongY(1.0)
        );
    }
}
