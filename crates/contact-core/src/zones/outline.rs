//! The region of a solved contact: its outline, its spots and the direction of its shear.
//!
//! Sections, cracks, rims, grids and figures all take it from here.

use super::continued::Continued;
use super::spots::{Spot, spots};
use crate::cells::Lattice;
use crate::convolution::Tractions;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Number of directions in which the extent of a contact is measured.
const DIRECTIONS: usize = 36;
/// Cells from the middle of the grid within which a contact lies in the middle.
const CENTRED: f64 = 0.25;
/// Smaller over larger principal value of the shear from which on it has no direction.
const ISOTROPIC: f64 = 0.9;

/// The outline of a contact.
#[derive(Clone, Debug)]
pub struct Outline {
    grid: Grid,
    continued: Continued,
    cells: Vec<(f64, f64)>,
    /// Centre of the area of all spots, 0 along an axis on which it lies in the middle of the grid
    /// \[m\].
    pub centre: (f64, f64),
    /// The spots, the largest first.
    pub spots: Vec<Spot>,
    /// Integrals of q_x^2, q_x q_y and q_y^2 over the contact \[N^2/m^2\].
    pub shear: [f64; 3],
}

impl Outline {
    /// Finds the outline of a contact from tractions on a grid, each of shape (nx, ny) \[Pa\]; `None` without a contact.
    pub fn new(grid: &Grid, tractions: &Tractions<'_>) -> Option<Self> {
        let p = tractions.p?;
        let contact: Vec<bool> = p.iter().map(|p| *p > 0.0).collect();
        let spots = spots(grid, &contact);
        if spots.is_empty() {
            return None;
        }
        let window = (0..grid.nx, 0..grid.ny);
        let pressure_alone = Tractions {
            p: Some(p),
            ..Tractions::default()
        };
        let centre_of_cell = |n: usize| (grid.x(n / grid.ny), grid.y(n % grid.ny));
        let cells: Vec<_> = (0..contact.len())
            .filter(|n| contact[*n])
            .map(centre_of_cell)
            .collect();
        let mean = |of: fn(&(f64, f64)) -> f64, cell: f64| {
            let mean = cells.iter().map(of).sum::<f64>() / cells.len() as f64;
            if mean.abs() < CENTRED * cell {
                0.0
            } else {
                mean
            }
        };
        let centre = (
            mean(|c| c.0, grid.dx),
            if grid.ny == 1 {
                0.0
            } else {
                mean(|c| c.1, grid.dy)
            },
        );
        let area = grid.dx * grid.dy;
        let value_at = |field: Option<&[f64]>, n: usize| field.map_or(0.0, |q| q[n]);
        let mut shear = [0.0; 3];
        for n in 0..contact.len() {
            let (x, y) = (value_at(tractions.q_x, n), value_at(tractions.q_y, n));
            for (sum, product) in shear.iter_mut().zip([x * x, x * y, y * y]) {
                *sum += product * area;
            }
        }
        Some(Self {
            grid: *grid,
            continued: Continued::new(grid, &pressure_alone, None, &window, false),
            cells,
            centre,
            spots,
            shear,
        })
    }

    /// Whether the outline belongs to a line contact.
    pub fn is_flat(&self) -> bool {
        self.grid.ny == 1
    }

    /// Centres of the cells at the rim \[m\].
    pub fn rim_cells(&self) -> Vec<(f64, f64)> {
        let inside = |n: usize| self.continued.presses((n / self.grid.ny, n % self.grid.ny));
        let contact: Vec<bool> = (0..self.grid.cells()).map(inside).collect();
        let border = Lattice::new(&self.grid, Mirror::None).border(&contact);
        let rim_cells = border.into_iter().filter(|n| contact[*n]);
        rim_cells
            .map(|n| (self.grid.x(n / self.grid.ny), self.grid.y(n % self.grid.ny)))
            .collect()
    }

    /// Ends of the contact on the line through its centre in a direction, backwards and
    /// forwards, from the centre \[m\].
    ///
    /// If the line misses all spots, the ends of the outermost cells along it are returned.
    pub fn border(&self, azimuth: f64) -> (f64, f64) {
        let (sin, cos) = azimuth.sin_cos();
        let half = 0.5
            * (cos.abs() * self.grid.dx
                + if self.grid.ny == 1 {
                    0.0
                } else {
                    sin.abs() * self.grid.dy
                });
        let position_along =
            |&(x, y): &(f64, f64)| (x - self.centre.0) * cos + (y - self.centre.1) * sin;
        let cells = self.cells.iter().map(position_along);
        let outermost = cells.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
            (low.min(s - half), high.max(s + half))
        });
        let (column, row) = self.to_cells(self.centre);
        let step = [
            cos / self.grid.dx,
            if self.grid.ny == 1 {
                0.0
            } else {
                sin / self.grid.dy
            },
        ];
        let size = step[0].hypot(step[1]);
        if size == 0.0 {
            return outermost;
        }
        let steps = (outermost.0.abs().max(outermost.1.abs()) * size + 2.0).ceil();
        let unit = step.map(|s| s / size);
        let crossings = self
            .continued
            .crossings_along([column, row], unit, [-steps, steps]);
        let places = crossings.iter().map(|crossing| {
            let (x, y) = self.to_metres(crossing.place);
            position_along(&(x, y))
        });
        let crossings_range = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
            (low.min(s), high.max(s))
        });
        if crossings_range.0 < crossings_range.1 {
            crossings_range
        } else {
            outermost
        }
    }

    /// Half of the width in a direction \[m\].
    pub fn half_width(&self, azimuth: f64) -> f64 {
        let (rear, front) = self.border(azimuth);
        0.5 * (front - rear)
    }

    /// Half of the largest and of the smallest width, and the direction of the largest \[m, m,
    /// rad\].
    pub fn half_widths(&self) -> (f64, f64, f64) {
        if self.grid.ny == 1 {
            let half = self.half_width(0.0);
            return (half, half, 0.0);
        }
        let angle = |n: usize| n as f64 * std::f64::consts::PI / DIRECTIONS as f64;
        let widths: Vec<f64> = (0..DIRECTIONS).map(|n| self.half_width(angle(n))).collect();
        let by_width = |a: &&usize, b: &&usize| widths[**a].total_cmp(&widths[**b]);
        let directions: Vec<usize> = (0..DIRECTIONS).collect();
        let [largest, smallest] = [
            directions.iter().max_by(by_width),
            directions.iter().min_by(by_width),
        ]
        .map(|n| n.copied().unwrap_or_default());
        (widths[largest], widths[smallest], angle(largest))
    }

    /// Returns the direction of an axis of the grid \[rad\] for a direction that is as good as parallel to it:
    /// over the contact their lines are less than half a cell apart. Other directions are returned as they are.
    #[must_use]
    pub fn snap_azimuth(&self, azimuth: f64) -> f64 {
        let (sin, cos) = azimuth.sin_cos();
        let half = self.half_width(azimuth);
        if half * sin.abs() < 0.5 * self.grid.dy {
            0.0
        } else if half * cos.abs() < 0.5 * self.grid.dx {
            std::f64::consts::FRAC_PI_2
        } else {
            azimuth
        }
    }

    /// Direction of the shear \[rad\], of the principal axis of [`Self::shear`]; `None` where the shear
    /// has no direction, as under a normal load alone.
    pub fn shear_azimuth(&self) -> Option<f64> {
        principal_azimuth(self.shear)
    }

    /// A point \[m\] in columns and rows of cells from the first.
    fn to_cells(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let Grid { nx, ny, dx, dy, .. } = self.grid;
        (
            x / dx + (nx - 1) as f64 / 2.0,
            y / dy + (ny - 1) as f64 / 2.0,
        )
    }

    /// A point in columns and rows of cells, in metres from the middle of the grid.
    fn to_metres(&self, [column, row]: [f64; 2]) -> (f64, f64) {
        let Grid { nx, ny, dx, dy, .. } = self.grid;
        (
            (column - (nx - 1) as f64 / 2.0) * dx,
            (row - (ny - 1) as f64 / 2.0) * dy,
        )
    }
}

/// Direction of the larger principal axis of second moments xx, xy, yy \[rad\], -pi/2 to pi/2;
/// `None` where both are about the same.
pub fn principal_azimuth([xx, xy, yy]: [f64; 3]) -> Option<f64> {
    let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    let has_direction = mean > 0.0 && (mean - half) < ISOTROPIC * (mean + half);
    has_direction.then(|| 0.5 * xy.atan2(0.5 * (xx - yy)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array2;

    /// The pressure of an elliptic contact of the semi-axes a, b, turned and moved.
    fn ellipse(
        n: usize,
        (a, b): (f64, f64),
        angle: f64,
        (x_0, y_0): (f64, f64),
    ) -> (Grid, Array2<f64>) {
        let grid = Grid::from_spacing((n, n), (3.0 / n as f64, 3.0 / n as f64)).expect("a grid");
        let (sin, cos) = angle.sin_cos();
        let p = grid.map(|x, y| {
            let (x, y) = (x - x_0, y - y_0);
            let (s, t) = ((x * cos + y * sin) / a, (y * cos - x * sin) / b);
            (1.0 - s * s - t * t).max(0.0).sqrt()
        });
        (grid, p)
    }

    #[test]
    fn an_ellipse_ends_where_it_ends_in_every_direction() {
        for (angle, place) in [(0.0, (0.0, 0.0)), (0.4, (0.21, -0.13)), (1.3, (-0.1, 0.2))] {
            let (a, b) = (1.1, 0.5);
            let (grid, p) = ellipse(64, (a, b), angle, place);
            let q = p.mapv(|p| 0.1 * p);
            let tractions = Tractions {
                p: p.as_slice(),
                q_x: q.as_slice(),
                q_y: q.as_slice(),
            };
            let outline = Outline::new(&grid, &tractions).expect("a contact");
            assert!((outline.centre.0 - place.0).hypot(outline.centre.1 - place.1) < 0.015);
            assert!((outline.shear_azimuth().expect("a direction") - 0.785).abs() < 1e-3);
            for n in 0..12 {
                let azimuth = 0.1 + 0.26 * f64::from(n);
                let relative_azimuth = azimuth - angle;
                let right = 1.0 / (relative_azimuth.cos() / a).hypot(relative_azimuth.sin() / b);
                let (rear, front) = outline.border(azimuth);
                let cell = grid.dx;
                assert!((front - right).abs() < 0.3 * cell, "{front} {right}");
                assert!((rear + right).abs() < 0.3 * cell, "{rear} {right}");
            }
            let (largest, smallest, direction) = outline.half_widths();
            assert!(
                (largest - a).abs() < 0.02 && (smallest - b).abs() < 0.02,
                "{largest} {smallest}"
            );
            let off = (direction - angle).rem_euclid(std::f64::consts::PI);
            assert!(off.min(std::f64::consts::PI - off) < 0.09, "{direction}");
            assert_eq!(outline.spots.len(), 1);
            let spot = &outline.spots[0];
            assert!((spot.semi_axes[0] - a).abs() < 0.02 && (spot.semi_axes[1] - b).abs() < 0.02);
            assert!(outline.rim_cells().len() > 40);
        }
    }

    #[test]
    fn shear_of_no_direction_has_none() {
        assert_eq!(principal_azimuth([1.0, 0.0, 1.0]), None);
        assert_eq!(principal_azimuth([0.0; 3]), None);
        assert_eq!(principal_azimuth([1.0, 0.0, 0.0]), Some(0.0));
        let grid = Grid::from_spacing((4, 4), (1.0, 1.0)).expect("a grid");
        let zeros = vec![0.0; 16];
        let tractions = Tractions {
            p: Some(&zeros),
            ..Tractions::default()
        };
        assert!(Outline::new(&grid, &tractions).is_none());
    }
}
