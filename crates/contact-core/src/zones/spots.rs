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

/// Area of a spot over that of the ellipse of its moments, at least, for the ellipse to give its
/// radius: a disc has 1, a rectangle 3/pi = 0.95, half a disc 0.96, a ring as wide as a third of
/// its radius 0.52.
const FILLS: f64 = 0.75;

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
    let mut all: Vec<Spot> = sums(lattice, contact).into_iter().map(spot).collect();
    all.sort_by(|a, b| b.area.total_cmp(&a.area));
    all
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

/// Cells across the radius of a contact: the median of the radii of its spots, weighted by area;
/// zero without a contact.
pub(crate) fn cells_per_radius(lattice: Lattice, contact: &[bool]) -> f64 {
    let mut spots: Vec<(f64, f64)> = sums(lattice, contact)
        .into_iter()
        .map(|spot| (spot.radius(lattice.flat), spot.cells))
        .collect();
    spots.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * spots.iter().map(|(_, cells)| cells).sum::<f64>();
    let mut below = 0.0;
    let middle = spots.iter().find(|(_, cells)| {
        below += cells;
        below >= half
    });
    middle.map_or(0.0, |(radius, _)| *radius)
}

/// The spots of a contact, those of the half that is not kept included.
fn sums(lattice: Lattice, contact: &[bool]) -> Vec<Sums> {
    let rows = lattice.rows();
    // For each run its spot, or an earlier run of the same spot (union-find).
    let (mut of, mut all) = (Vec::new(), Vec::new());
    let (mut last, mut here) = (Vec::<Run>::new(), Vec::<Run>::new());
    for (i, column) in contact.chunks_exact(rows).enumerate() {
        here.clear();
        let mut j = 0;
        for cells in column.chunk_by(|a, b| a == b) {
            let (from, to) = (j, j + cells.len());
            j = to;
            if !cells[0] {
                continue;
            }
            let spot = all.len();
            of.push(spot);
            all.push(Sums::of_run(i, from, to, lattice.is_mirrored()));
            here.push(Run { from, to, spot });
            for before in last.iter().filter(|b| b.from <= to && from <= b.to) {
                let shared = to.min(before.to).saturating_sub(from.max(before.from));
                all[spot].faces -= 2.0 * shared as f64;
                let (one, other) = (root(&mut of, before.spot), root(&mut of, spot));
                of[one.max(other)] = one.min(other);
            }
        }
        std::mem::swap(&mut last, &mut here);
    }
    for run in (0..all.len()).rev() {
        let (part, to) = (all[run], of[run]);
        if to != run {
            all[to].add(&part);
        }
    }
    let whole = all.into_iter().enumerate().filter(|(n, _)| of[*n] == *n);
    whole
        .flat_map(|(_, spot)| spot.with_image(lattice.is_mirrored()))
        .collect()
}

/// The first run of the spot of a run, with path compression.
fn root(of: &mut [usize], mut run: usize) -> usize {
    while of[run] != run {
        of[run] = of[of[run]];
        run = of[run];
    }
    run
}

impl Sums {
    /// The cells [from, to) of column i. Of a mirrored half the mirror is at row 0.
    fn of_run(i: usize, from: usize, to: usize, mirrored: bool) -> Self {
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

    fn add(&mut self, other: &Self) {
        self.cells += other.cells;
        self.faces += other.faces;
        self.mirrored |= other.mirrored;
        (self.first.iter_mut().zip(other.first)).for_each(|(sum, part)| *sum += part);
        (self.second.iter_mut().zip(other.second)).for_each(|(sum, part)| *sum += part);
    }

    /// With its mirror image: one spot where they touch, or two.
    fn with_image(self, mirrored: bool) -> impl Iterator<Item = Self> {
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

    /// In cells.
    fn radius(&self, flat: bool) -> f64 {
        if flat {
            return 0.5 * self.cells;
        }
        let [xx, xy, yy] = self.moments();
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let [small, large] = [mean - half, mean + half].map(|m| 2.0 * m.max(0.0).sqrt());
        let ellipse = std::f64::consts::PI * small * large;
        if self.cells >= FILLS * ellipse {
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
    use super::*;

    fn radius(n: usize, mirror: Mirror, inside: impl Fn(f64, f64) -> bool) -> f64 {
        let grid = Grid::from_spacing((n, n), (1.0, 1.0)).expect("a grid");
        let whole = grid.map(|x, y| f64::from(u8::from(inside(x, y))));
        let kept: Vec<bool> = mirror.fold(&whole).iter().map(|f| *f > 0.0).collect();
        cells_per_radius(Lattice::new(&grid, mirror), &kept)
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
    fn of_many_spots_the_one_in_the_middle_of_the_area_counts() {
        let spots = |mirror| {
            radius(64, mirror, |x, y| {
                let near = |a: f64, b: f64, r: f64| (x - a).hypot(y.abs() - b) < r;
                near(-20.0, 20.0, 6.0) || near(20.0, 20.0, 4.0) || near(0.0, 10.0, 2.0)
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
        let kept: Vec<bool> = (0..64).map(|i| (20..32).contains(&i)).collect();
        assert_eq!(
            cells_per_radius(Lattice::new(&grid, Mirror::None), &kept),
            6.0
        );
    }
}
