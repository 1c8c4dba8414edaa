//! The motion of cells outside the contact before they enter it, from the solution on the old
//! contact.
//!
//! On the old contact (eq. (5)-(8) solved with p = q = 0 in all other cells) the gap of a cell
//! outside closes by c in the increment, and the cell moves by m relative to the rigid shift. The
//! ratio m/c depends on the distance of the cell from the edge of the contact, which approaches as
//! cells enter. While its gap closes by dg the cell moves by (m/c) dg, m/c being the ratio at its
//! distance at that moment. Before it enters, a cell of gap g moves by
//!
//! ```text
//! M = int_0^g (m/c) dg
//! ```
//!
//! Near the contact, where the edge moves in steps of cells, this is the sum over the entries of
//! the cells between ([`order`](super::order)); farther off it is integrated outwards from cell to
//! cell. Where gap and motion are proportional (similar bodies of nu = 0 under proportional loads)
//! m/c is uniform, and M exact in increments of any size.

use rayon::prelude::*;

use super::kept_contact::KeptContact;
use super::neighbours::TASK;
use super::order;
use super::view::View;

impl KeptContact {
    /// The motion of each cell outside before its entry \[m\]; of one that does not enter, in
    /// the whole increment.
    pub(super) fn motion_before_entry(
        &self,
        outside: impl Fn(usize) -> bool + Sync,
    ) -> [Vec<f64>; 2] {
        let enters = |n: &usize| outside(*n) && self.gap[*n] < self.closing[*n];
        let entering: Vec<usize> = (0..self.gap.len()).filter(enters).collect();
        let views = self.views(&entering, &outside);
        let (near, mut far): (Vec<usize>, Vec<usize>) = entering
            .into_iter()
            .partition(|&n| self.ordered && views[n].is_some());
        let mut views_of_cells = vec![None; self.gap.len()];
        for (&n, by) in near.iter().zip(order::moved(self, &views, &near)) {
            views_of_cells[n] = Some(by);
        }
        far.sort_by(|&n, &m| self.gap[n].total_cmp(&self.gap[m]));
        for n in far {
            views_of_cells[n] = Some(self.moved_farther_off(n, &views_of_cells));
        }
        let moved = |c: usize| {
            let by = |n: usize| match views_of_cells[n] {
                Some(by) => by[c],
                None if outside(n) => self.motion[c][n],
                None => 0.0,
            };
            (0..views_of_cells.len()).map(by).collect()
        };
        [moved(0), moved(1)]
    }

    /// The motion before entry of cell n that is far from the old contact, from its neighbours that enter
    /// before it (`known`): the motion of a neighbour, plus the mean of both m/c times the difference of the
    /// gaps, averaged with the squared slope of the gap as weight.
    fn moved_farther_off(&self, n: usize, known: &[Option<[f64; 2]>]) -> [f64; 2] {
        let ratio = |n: usize| [0, 1].map(|c| self.motion[c][n] / self.closing[n]);
        let (own, gap) = (ratio(n), self.gap[n]);
        let (mut sum, mut weights) = ([0.0; 2], 0.0);
        for near in self.cells.neighbours_within(n, 1) {
            let (m, [x, y]) = (near.cell, near.off);
            let Some(by) = known[m].filter(|_| self.gap[m] < gap) else {
                continue;
            };
            let (rise, other) = (gap - self.gap[m], ratio(m));
            let weight = rise * rise / (x * x + y * y);
            for (c, sign) in [1.0, near.sign].into_iter().enumerate() {
                let mean = 0.5 * (own[c] + sign * other[c]);
                sum[c] += weight * (sign * by[c] + mean * rise);
            }
            weights += weight;
        }
        if weights > 0.0 {
            sum.map(|sum| sum / weights)
        } else {
            own.map(|own| own * gap)
        }
    }

    /// The [`View`] of the contact from the entering cells and from the cells outside around them; none
    /// elsewhere.
    fn views(
        &self,
        entering: &[usize],
        outside: impl Fn(usize) -> bool + Sync,
    ) -> Vec<Option<View>> {
        let mut around = vec![false; self.gap.len()];
        for &n in entering {
            for near in self.cells.neighbours_within(n, order::FITTED) {
                around[near.cell] = outside(near.cell) && self.closing[near.cell] > 0.0;
            }
        }
        let view = |n: usize| {
            let view = || View::from_cell(n, &self.cells, |m| !outside(m));
            around[n].then(view).flatten()
        };
        let cells = 0..around.len();
        cells.into_par_iter().with_min_len(TASK).map(view).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::march::entry::kept_contact::KeptContact;
    use crate::march::entry::neighbours::Neighbours;
    use crate::march::entry::screened::Screened;
    use crate::march::entry::screened::tests::half_space;
    use crate::march::entry::view::REACH;
    use crate::plan::Mirror;
    use crate::scene::Grid;

    /// Closes the gaps up to this distance in one increment.
    const CLOSING: f64 = 10.0;

    /// A round contact in the middle of a grid, or its half y > 0: gap d^(3/2), closing d^(1/2),
    /// and radial motion that is `ratio(d^(1/2))` times the closing.
    fn round(ratio: impl Fn(f64) -> f64, mirror: Mirror) -> (KeptContact, Vec<[f64; 2]>) {
        let n = 64;
        let rows = mirror.rows(n);
        let middle = (n as f64 - 1.0) / 2.0;
        let position = |k: usize| {
            let (i, j) = (k / rows, k % rows + n - rows);
            [i as f64 - middle, j as f64 - middle]
        };
        let places: Vec<[f64; 2]> = (0..n * rows).map(position).collect();
        let beyond = |[x, y]: &[f64; 2]| (x.hypot(*y) - 20.0).max(0.0);
        let closing: Vec<f64> = places
            .iter()
            .map(|at| CLOSING * beyond(at).sqrt())
            .collect();
        let motion = |c: usize| {
            let motion_at = |at: &[f64; 2]| {
                let d = beyond(at);
                at[c] / at[0].hypot(at[1]) * CLOSING * d.sqrt() * ratio(d.sqrt())
            };
            places.iter().map(motion_at).collect()
        };
        let grid = Grid::centred(1.0, n).unwrap();
        let kernel = half_space(&grid);
        let contact = KeptContact {
            gap: places.iter().map(|at| beyond(at).powf(1.5)).collect(),
            motion: [motion(0), motion(1)],
            closing,
            cells: Neighbours::new(&grid, mirror, REACH, &kernel),
            screened: Screened::new(&grid, &kernel),
            ordered: true,
        };
        (contact, places)
    }

    #[test]
    fn cells_move_by_the_integral_of_the_ratio_over_their_gap() {
        let (contact, places) = round(|r| 0.3 - 0.05 * r + 0.003 * r * r, Mirror::None);
        let moved = contact.motion_before_entry(|n| contact.gap[n] > 0.0);
        let mut worst: f64 = 0.0;
        for (n, at) in places.iter().enumerate() {
            let d = at[0].hypot(at[1]) - 20.0;
            if !(1.5..9.5).contains(&d) {
                continue;
            }
            let mean = 0.3 - 3.0 / 4.0 * 0.05 * d.sqrt() + 3.0 / 5.0 * 0.003 * d;
            let exact = mean * contact.gap[n];
            for c in 0..2 {
                let off = moved[c][n] - exact * at[c] / at[0].hypot(at[1]);
                worst = worst.max(off.abs() / exact);
            }
        }
        // The steps that the cells make of the edge, of which these rates know nothing.
        assert!(worst < 0.013, "off by {worst} of the motion");
    }

    #[test]
    fn a_ratio_that_is_the_same_everywhere_is_that_of_all_ways() {
        let (mut contact, _) = round(|_| 0.0, Mirror::None);
        contact.motion =
            [0.2, -0.1].map(|ratio| contact.closing.iter().map(|c| ratio * c).collect());
        let moved = contact.motion_before_entry(|n| contact.gap[n] > 0.0);
        for n in (0..contact.gap.len()).filter(|&n| contact.gap[n] < contact.closing[n]) {
            let gap = contact.gap[n];
            let off = (moved[0][n] - 0.2 * gap).hypot(moved[1][n] + 0.1 * gap);
            assert!(off < 1e-10 * gap, "off by {off:e} of {gap:e}");
        }
    }

    #[test]
    fn the_half_of_a_mirrored_contact_moves_as_in_the_whole() {
        let ratio = |r: f64| 0.3 - 0.05 * r;
        let (whole, places) = round(ratio, Mirror::None);
        let (half, kept) = round(ratio, Mirror::Y);
        let in_whole = whole.motion_before_entry(|n| whole.gap[n] > 0.0);
        let in_half = half.motion_before_entry(|n| half.gap[n] > 0.0);
        let same = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 0.5;
        for (n, at) in kept.iter().enumerate() {
            let twin = places.iter().position(|place| same(place, at)).unwrap();
            for c in 0..2 {
                let off = (in_half[c][n] - in_whole[c][twin]).abs();
                assert!(off < 1e-10, "{at:?}: off by {off:e}");
            }
        }
    }
}
