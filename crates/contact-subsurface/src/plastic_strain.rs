//! The plastic strain of a state on the volume grid, and its growth over a cycle.

use contact_core::yielding::PlasticPoint;

use super::DoubledCells;

/// Components of a tensor, and the equivalent strain behind them.
const NUMBERS: usize = 7;
/// Net strain of a cycle over the strain that it adds up, from which a body ratchets.
pub const RATCHETS: f64 = 0.5;

/// Plastic strain on the smallest box of planes and cells that holds it; zero elsewhere.
#[derive(Debug)]
pub(super) struct PlasticStrain {
    /// The first plane and the first cells of the box along x and y, and how many there are.
    first: [usize; 3],
    n: [usize; 3],
    /// Cells of the whole grid along x and y.
    cells: [usize; 2],
    /// Components, and the equivalent strain added up over the path; a cycle holds many of them.
    values: Vec<[f32; NUMBERS]>,
}

impl PlasticStrain {
    /// Collects points that have yielded, at least one: plane, cell, with the strain in the axes of
    /// the scene.
    pub(super) fn from_points(points: &[(usize, usize, PlasticPoint)], cells: [usize; 2]) -> Self {
        let points = points.iter().map(|(plane, cell, point)| {
            let strain = point.strain.map(|e| e as f32);
            let [xx, yy, zz, xy, xz, yz] = strain;
            let numbers = [xx, yy, zz, xy, xz, yz, point.equivalent as f32];
            ([*plane, cell / cells[1], cell % cells[1]], numbers)
        });
        Self::sum(&points.collect::<Vec<_>>(), cells)
    }

    /// Adds up the numbers of points with the same plane and cell, in the smallest box that holds all points.
    fn sum(points: &[([usize; 3], [f32; NUMBERS])], cells: [usize; 2]) -> Self {
        let (mut first, mut last) = ([usize::MAX; 3], [0; 3]);
        for (at, _) in points {
            for a in 0..3 {
                first[a] = first[a].min(at[a]);
                last[a] = last[a].max(at[a]);
            }
        }
        let n = [0, 1, 2].map(|a| (last[a] + 1).saturating_sub(first[a]));
        let mut sums = Self {
            first,
            n,
            cells,
            values: vec![[0.0; NUMBERS]; n.iter().product()],
        };
        for (at, numbers) in points {
            if let Some(n) = sums.index(*at) {
                let values = sums.values[n].iter_mut().zip(numbers);
                values.for_each(|(sum, own)| *sum += own);
            }
        }
        sums
    }

    /// The strain on cells twice as large, by averages over pairs of cells, and on fewer planes: those with equal
    /// numbers in `of_plane` are averaged. Values are stored by plane, cell along x, cell along y.
    pub(super) fn coarsened(&self, cells: &DoubledCells, of_plane: &[usize]) -> Self {
        let planes_merged =
            |plane: usize| of_plane.iter().filter(|merged| **merged == plane).count();
        let points = (0..self.values.len()).map(|n| {
            let (row, j) = (n / self.n[2], n % self.n[2] + self.first[2]);
            let (plane, i) = (row / self.n[1], row % self.n[1] + self.first[1]);
            let plane = of_plane[plane + self.first[0]];
            let cell = cells.cell_of([i, j]);
            let part = (cells.fraction() / planes_merged(plane) as f64) as f32;
            let at = [plane, cell / cells.grid.ny, cell % cells.grid.ny];
            (at, self.values[n].map(|e| part * e))
        });
        Self::sum(&points.collect::<Vec<_>>(), [cells.grid.nx, cells.grid.ny])
    }

    /// Index of a plane and a cell in the box; none outside.
    fn index(&self, at: [usize; 3]) -> Option<usize> {
        let [plane, i, j] = [0, 1, 2].map(|a| at[a].wrapping_sub(self.first[a]));
        let inside = plane < self.n[0] && i < self.n[1] && j < self.n[2];
        inside.then(|| (plane * self.n[1] + i) * self.n[2] + j)
    }

    /// The strain in a cell of a plane; `None` outside the box.
    pub(super) fn strain(&self, plane: usize, i: usize, j: usize) -> Option<[f64; 6]> {
        let numbers = self.values[self.index([plane, i, j])?];
        Some(std::array::from_fn(|c| f64::from(numbers[c])))
    }

    /// Strain and equivalent strain at a plane and a cell counted from the middle of the grid, which stays when
    /// the grid grows; zero where nothing has yielded.
    fn around_middle(&self, [plane, i, j]: [isize; 3]) -> [f64; NUMBERS] {
        let whole = |a: usize, at: isize| at + (self.cells[a] / 2) as isize;
        let at = [plane, whole(0, i), whole(1, j)];
        let at = at.map(|at| usize::try_from(at).unwrap_or(usize::MAX));
        let stored = self.index(at).map(|n| self.values[n]);
        stored.unwrap_or_default().map(f64::from)
    }

    /// Planes and cells of the box, counted from the middle.
    fn places(&self) -> impl Iterator<Item = [isize; 3]> + '_ {
        (0..self.values.len()).map(|n| {
            let (row, j) = (n / self.n[2], n % self.n[2]);
            let (plane, i) = (row / self.n[1], row % self.n[1]);
            let along = |a: usize, at: usize| {
                (at + self.first[a + 1]) as isize - (self.cells[a] / 2) as isize
            };
            [(plane + self.first[0]) as isize, along(0, i), along(1, j)]
        })
    }
}

/// Largest increase of the plastic strain over a cycle, each at the point where it is largest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Growth {
    /// Equivalent strain added up over the cycle.
    pub added: f64,
    /// Equivalent strain of the net change.
    pub net: f64,
}

impl Growth {
    /// Compares two states of plastic strain, from `before` (nothing yielded by default) to `after`: largest
    /// added equivalent strain, and largest net change.
    pub(super) fn between(before: Option<&PlasticStrain>, after: &PlasticStrain) -> Self {
        let mut growth = Self::default();
        for place in after.places() {
            let (end, start) = (
                after.around_middle(place),
                before.map_or([0.0; NUMBERS], |before| before.around_middle(place)),
            );
            let change: [f64; NUMBERS] = std::array::from_fn(|c| end[c] - start[c]);
            let square = |c: std::ops::Range<usize>| change[c].iter().map(|e| e * e).sum::<f64>();
            growth.added = growth.added.max(change[NUMBERS - 1]);
            // sqrt(2/3 e : e).
            let net = (2.0 / 3.0 * (square(0..3) + 2.0 * square(3..6))).sqrt();
            growth.net = growth.net.max(net);
        }
        growth
    }

    /// Checks that the net change is so large that the cycle does not close.
    pub fn ratchets(&self) -> bool {
        self.added > 0.0 && self.net >= RATCHETS * self.added
    }
}

/// A point that has yielded, with this strain and equivalent strain.
#[cfg(test)]
pub(super) fn yielded(strain: [f64; 6], equivalent: f64) -> PlasticPoint {
    PlasticPoint {
        plane: 0,
        cell: 0,
        strain,
        equivalent,
        back: Default::default(),
        growth: [0.0; 6],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEAR: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 3e-3, 0.0];

    /// A grid of 4 x 6 cells that has grown by one cell at each side, and a point that has yielded since.
    #[test]
    fn a_cycle_adds_the_same_on_a_grid_that_has_grown() {
        let before = PlasticStrain::from_points(&[(3, 2 * 6 + 4, yielded(SHEAR, 0.02))], [4, 6]);
        let moved = |shear: f64| SHEAR.map(|e| shear * e);
        let point_with = |shear: f64, equivalent: f64| {
            let points = [
                (3, 3 * 8 + 5, yielded(moved(shear), equivalent)),
                (5, 3 * 8 + 1, yielded([0.0; 6], 1e-4)),
            ];
            Growth::between(Some(&before), &PlasticStrain::from_points(&points, [6, 8]))
        };
        let closed = point_with(1.0, 0.03);
        assert!((closed.added - 0.01).abs() < 1e-8 && closed.net == 0.0);
        assert!(!closed.ratchets());
        let open = point_with(2.0, 0.023);
        // sqrt(2/3 2 e_xz^2).
        assert!((open.net - 2.0 / 3f64.sqrt() * 3e-3).abs() < 1e-9);
        assert!(open.ratchets());
        assert_eq!(Growth::between(Some(&before), &before), Growth::default());
        assert!((Growth::between(None, &before).added - 0.02).abs() < 1e-8);
    }
}
