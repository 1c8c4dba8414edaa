//! Cells across the radius of the spots of a contact.
//!
//! A spot is a patch of cells in contact that touch, corners included. Its radius is the smaller
//! semi-axis of the ellipse with its second moments, 2 sqrt(m) with the smaller principal moment m
//! per area; of a patch that fills no ellipse (a ring, a net) half of its width, its area over its
//! perimeter. Lengths are counted in cells along each axis, so that oblong cells count with their
//! resolution. In plane strain the radius is the half-width.

use crate::cells::Lattice;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Smallest area of a spot over the area of the ellipse of its moments for which the ellipse gives its
/// radius: a disc has 1, a rectangle 3/pi = 0.95, half a disc 0.96, a ring as wide as a third of
/// its radius 0.52.
const ELLIPSE_FILL: f64 = 0.75;

/// A spot of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Centre of its area \[m\].
    pub centre: (f64, f64),
    /// Area of its cells \[m^2\].
    pub area: f64,
    /// Semi-axes of the ellipse with its second moments, the larger first \[m\].
    pub semi_axes: [f64; 2],
    /// Direction of the larger one \[rad\].
    pub azimuth: f64,
}

/// The spots of a contact on the whole grid, the largest first.
pub(super) fn spots(grid: &Grid, contact: &[bool]) -> Vec<Spot> {
    let (d_x, d_y) = (grid.dx, if grid.ny == 1 { 0.0 } else { grid.dy });
    let middle = |n: usize| 0.5 * (n - 1) as f64;
    let lattice = Lattice::new(grid, Mirror::None);
    let spot = |sums: Sums| {
        let [x, y] = sums.first.map(|sum| sum / sums.cells);
        let [xx, xy, yy] = sums.moments();
        let (xx, xy, yy) = (xx * d_x * d_x, xy * d_x * d_y, yy * d_y * d_y);
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        Spot {
            // Rows are counted from the lower side of the first, columns from its middle.
            centre: (
                (x - middle(grid.nx)) * d_x,
                (y - 0.5 - middle(grid.ny)) * d_y,
            ),
            area: sums.cells * grid.dx * grid.dy,
            semi_axes: [mean + half, mean - half].map(|m| 2.0 * m.max(0.0).sqrt()),
            azimuth: 0.5 * xy.atan2(0.5 * (xx - yy)),
        }
    };
    let mut spots: Vec<Spot> = sums_of_spots(lattice, contact)
        .into_iter()
        .map(spot)
        .collect();
    spots.sort_by(|a, b| b.area.total_cmp(&a.area));
    spots
}

/// A patch of cells in contact: its sums over the cells, and the faces to cells outside.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    cells: f64,
    first: [f64; 2],
    /// xx, xy, yy.
    second: [f64; 3],
    faces: f64,
    /// Whether it touches its mirror image.
    mirrored: bool,
}

/// A run of cells along a column, [from, to), and the spot it belongs to.
#[derive(Clone, Copy, Debug)]
struct Run {
    from: usize,
    to: usize,
    spot: usize,
}

/// Sizes of the spots of a contact, in cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SpotCount {
    /// Median of the radii of the spots, weighted by area; zero without a contact.
    pub(crate) radius: f64,
    /// Number of spots.
    pub(crate) spots: usize,
    /// Cells in contact.
    pub(crate) cells: f64,
    /// Cells of the largest spot.
    pub(crate) largest: f64,
    /// Its faces, as of all spots below.
    pub(crate) faces_of_largest: f64,
    /// Cells in contact that touch no other, corners included.
    pub(crate) lone: f64,
    /// Faces between a cell in contact and one that is not; of a line contact its ends.
    pub(crate) faces: f64,
}

/// Counts the spots of a contact.
pub(crate) fn count_spots(lattice: Lattice, contact: &[bool]) -> SpotCount {
    let flat = lattice.is_single_row;
    let mut count = SpotCount::default();
    let mut spots: Vec<(f64, f64)> = Vec::new();
    for spot in sums_of_spots(lattice, contact) {
        spots.push((spot.radius(flat), spot.cells));
        count.cells += spot.cells;
        let faces = if flat { 2.0 } else { spot.faces };
        if spot.cells > count.largest {
            (count.largest, count.faces_of_largest) = (spot.cells, faces);
        }
        count.lone += if spot.cells == 1.0 { 1.0 } else { 0.0 };
        count.faces += faces;
    }
    spots.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut below = 0.0;
    let middle = spots.iter().find(|(_, cells)| {
        below += cells;
        below >= 0.5 * count.cells
    });
    SpotCount {
        radius: middle.map_or(0.0, |(radius, _)| *radius),
        spots: spots.len(),
        ..count
    }
}

/// Sums over the spots of a contact, including the spots of the half that is not kept.
fn sums_of_spots(lattice: Lattice, contact: &[bool]) -> Vec<Sums> {
    let rows = lattice.rows();
    // For each run its spot, or an earlier run of the same spot (union-find).
    let (mut parent, mut sums) = (Vec::new(), Vec::new());
    let (mut previous_column, mut this_column) = (Vec::<Run>::new(), Vec::<Run>::new());
    for (i, column) in contact.chunks_exact(rows).enumerate() {
        this_column.clear();
        let mut j = 0;
        for cells in column.chunk_by(|a, b| a == b) {
            let (from, to) = (j, j + cells.len());
            j = to;
            if !cells[0] {
                continue;
            }
            let spot = sums.len();
            parent.push(spot);
            sums.push(Sums::from_run(i, from, to, lattice.is_mirrored()));
            this_column.push(Run { from, to, spot });
            for neighbour in previous_column
                .iter()
                .filter(|b| b.from <= to && from <= b.to)
            {
                let shared = to
                    .min(neighbour.to)
                    .saturating_sub(from.max(neighbour.from));
                sums[spot].faces -= 2.0 * shared as f64;
                let (first, second) = (
                    find_root(&mut parent, neighbour.spot),
                    find_root(&mut parent, spot),
                );
                parent[first.max(second)] = first.min(second);
            }
        }
        std::mem::swap(&mut previous_column, &mut this_column);
    }
    for run in (0..sums.len()).rev() {
        let (run_sums, to) = (sums[run], parent[run]);
        if to != run {
            sums[to].add(&run_sums);
        }
    }
    let roots = sums
        .into_iter()
        .enumerate()
        .filter(|(n, _)| parent[*n] == *n);
    roots
        .flat_map(|(_, spot)| spot.add_image(lattice.is_mirrored()))
        .collect()
}

/// Finds the first run of the spot of a run, with path compression.
fn find_root(parent: &mut [usize], mut run: usize) -> usize {
    while parent[run] != run {
        parent[run] = parent[parent[run]];
        run = parent[run];
    }
    run
}

impl Sums {
    /// Sums over the cells [from, to) of column i. Of a mirrored half the mirror is at row 0.
    fn from_run(i: usize, from: usize, to: usize, mirrored: bool) -> Self {
        let (n, x) = ((to - from) as f64, i as f64);
        let y = 0.5 * (from + to) as f64;
        Self {
            cells: n,
            first: [n * x, n * y],
            second: [n * x * x, n * x * y, n * (y * y + (n * n - 1.0) / 12.0)],
            faces: 2.0 * n + if mirrored && from == 0 { 1.0 } else { 2.0 },
            mirrored: mirrored && from == 0,
        }
    }

    /// Adds the sums over another part of the spot.
    fn add(&mut self, addend: &Self) {
        self.cells += addend.cells;
        self.faces += addend.faces;
        self.mirrored |= addend.mirrored;
        (self.first.iter_mut().zip(addend.first)).for_each(|(sum, part)| *sum += part);
        (self.second.iter_mut().zip(addend.second)).for_each(|(sum, part)| *sum += part);
    }

    /// Yields the sums over the whole spot, given its half on the kept side: one spot with its image if it
    /// touches the mirror, otherwise two.
    fn add_image(self, mirrored: bool) -> impl Iterator<Item = Self> {
        let whole = Self {
            cells: 2.0 * self.cells,
            first: [2.0 * self.first[0], 0.0],
            second: [2.0 * self.second[0], 0.0, 2.0 * self.second[2]],
            faces: 2.0 * self.faces,
            ..self
        };
        let images = if mirrored && !self.mirrored { 2 } else { 1 };
        std::iter::repeat_n(if self.mirrored { whole } else { self }, images)
    }

    /// Second moments about its centre over its area \[cells^2\].
    fn moments(&self) -> [f64; 3] {
        let [x, y] = self.first.map(|sum| sum / self.cells);
        let [xx, xy, yy] = self.second.map(|sum| sum / self.cells);
        // A cell by itself is a square.
        [xx - x * x + 1.0 / 12.0, xy - x * y, yy - y * y + 1.0 / 12.0]
    }

    /// Radius in cells.
    fn radius(&self, flat: bool) -> f64 {
        if flat {
            return 0.5 * self.cells;
        }
        let [xx, xy, yy] = self.moments();
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let [small, large] = [mean - half, mean + half].map(|m| 2.0 * m.max(0.0).sqrt());
        let ellipse = std::f64::consts::PI * small * large;
        if self.cells >= ELLIPSE_FILL * ellipse {
            return small;
        }
        // Averaged over the directions of a border, the faces of the cells are 4/pi times as long
        // as it.
        let perimeter = self.faces * std::f64::consts::FRAC_PI_4;
        (self.cells / perimeter).min(small)
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::*;

    fn radius(n: usize, mirror: Mirror, inside: impl Fn(f64, f64) -> bool) -> f64 {
        let grid = Grid::from_spacing((n, n), (1.0, 1.0)).expect("a grid");
        let whole = grid.map(|x, y| f64::from(u8::from(inside(x, y))));
        let is_inside: Vec<bool> = mirror.fold(&whole).iter().map(|f| *f > 0.0).collect();
        count_spots(Lattice::new(&grid, mirror), &is_inside).radius
    }

    #[test]
    fn a_disc_has_its_radius_and_an_ellipse_its_smaller_axis() {
        for mirror in [Mirror::None, Mirror::Y] {
            // Within 1.5 lie four cells, whose radius is 1.15: fewer than two cells are told to a
            // third.
            for r in [2.0, 3.3, 8.0, 20.0] {
                let disc = radius(64, mirror, |x, y| x.hypot(y) < r);
                assert!((disc - r).abs() < 0.06 * r + 0.05, "{r} {disc}");
                let ellipse = radius(64, mirror, |x, y| (x / 1.5).hypot(y) < r);
                assert!((ellipse - r).abs() < 0.06 * r + 0.05, "{r} {ellipse}");
            }
        }
        let tilted = radius(96, Mirror::None, |x, y| {
            let (s, t) = (0.6 * x + 0.8 * y, 0.8 * x - 0.6 * y);
            (s / 40.0).hypot(t / 7.0) < 1.0
        });
        assert!((tilted - 7.0).abs() < 0.2, "{tilted}");
    }

    #[test]
    fn a_ring_has_half_of_its_width() {
        for (outer, inner) in [(30.0, 24.0), (28.0, 18.0)] {
            for mirror in [Mirror::None, Mirror::Y] {
                let ring = radius(64, mirror, |x, y| (inner..outer).contains(&x.hypot(y)));
                let half: f64 = 0.5 * (outer - inner);
                assert!((ring - half).abs() < 0.15 * half, "{half} {ring}");
            }
        }
    }

    #[test]
    fn the_median_spot_by_area_counts() {
        let spots = |mirror| {
            radius(64, mirror, |x, y| {
                let is_near = |a: f64, b: f64, r: f64| (x - a).hypot(y.abs() - b) < r;
                is_near(-20.0, 20.0, 6.0) || is_near(20.0, 20.0, 4.0) || is_near(0.0, 10.0, 2.0)
            })
        };
        let [whole, half] = [Mirror::None, Mirror::Y].map(spots);
        assert!((whole - 6.0).abs() < 0.3, "{whole}");
        assert!((whole - half).abs() < 1e-12, "{whole} {half}");
        assert_eq!(radius(64, Mirror::None, |_, _| false), 0.0);
        assert!(
            (radius(64, Mirror::None, |x, y| x.abs() < 1.0 && y.abs() < 1.0) - 1.155).abs() < 1e-3
        );
    }

    #[test]
    fn a_strip_has_its_half_width() {
        let grid = Grid::strip(64.0, 64, 1.0).expect("a strip");
        let contact: Vec<bool> = (0..64).map(|i| (20..32).contains(&i)).collect();
        assert_eq!(
            count_spots(Lattice::new(&grid, Mirror::None), &contact).radius,
            6.0
        );
    }

    #[test]
    fn spots_are_counted_by_cells_and_faces() {
        let grid = Grid::from_spacing((16, 16), (1.0, 1.0)).expect("a grid");
        // A block of 2 x 3 cells, a pair that meets at a corner, and a lone cell; each twice.
        let inside = [
            (1, 0),
            (1, 1),
            (1, 2),
            (2, 0),
            (2, 1),
            (2, 2),
            (5, 4),
            (6, 5),
            (9, 6),
        ];
        let field = |mirror: Mirror| {
            let whole = Array2::from_shape_fn((16, 16), |(i, j)| {
                let row = if j >= 8 { j - 8 } else { 7 - j };
                f64::from(u8::from(inside.contains(&(i, row))))
            });
            let contact: Vec<bool> = mirror.fold(&whole).iter().map(|f| *f > 0.0).collect();
            count_spots(Lattice::new(&grid, mirror), &contact)
        };
        for mirror in [Mirror::None, Mirror::Y] {
            let count = field(mirror);
            assert_eq!((count.spots, count.cells), (5, 18.0), "{mirror:?}");
            assert_eq!((count.largest, count.lone), (12.0, 2.0), "{mirror:?}");
            assert_eq!(count.faces_of_largest, 16.0, "{mirror:?}");
            // The block touches its image: 2 x 6 cells have 16 faces.
            assert_eq!(count.faces, 16.0 + 2.0 * (8.0 + 4.0), "{mirror:?}");
        }
    }
}
