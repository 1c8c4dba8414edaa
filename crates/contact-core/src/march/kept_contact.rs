//! What cells outside the contact move before they enter it, from a contact kept to its old cells.
//!
//! With the contact kept, in p and in q, the gap over a cell outside closes by c in the increment
//! and the cell moves by m relative to the rigid shift. Both depend on how far the cell is from the
//! edge of the contact, and the edge comes nearer: what closes the gap by dg moves the cell by
//! (m/c) dg, with the m/c of the cells between it and the edge through whose gaps its own goes. When
//! it enters, a cell of gap g has moved by
//!
//! ```text
//! M = int_0^g (m/c) dg
//! ```
//!
//! At a distance d from the edge of a growing contact c and m are series in d^(1/2) that begin with
//! this power, and the gap goes like d^(3/2): m/c is a series in g^(1/3). Its first terms are fitted to
//! the cells around, so that the steps that the grid makes of the edge leave little in M. A cell at
//! the edge, whose own m/c tells of these steps, moves by that until the first cell beside it enters;
//! in small increments that is all its way. Where gap and motion are alike (proportional loads on
//! similar bodies of nu = 0) m/c is the same everywhere, and M exact in increments of any size.

use crate::convolution::Mirror;
use crate::solvers::{inverse, product, set, size};

/// How far the cells around reach that m/c is fitted to, in cells.
const AROUND: isize = 4;
/// Cells whose gap is less than so many times what it closes by tell of the way through the gap.
const NEAR: f64 = 1.5;
/// Regularisation of the terms that are not constant, which few cells need not tell apart.
const RIDGE: f64 = 1e-6;

/// An increment with the contact kept to its old cells.
pub(super) struct KeptContact {
    /// Gap at the start \[m\].
    pub(super) gap: Vec<f64>,
    /// How far the gap closes \[m\].
    pub(super) closing: Vec<f64>,
    /// Motion relative to the rigid shift \[m\].
    pub(super) motion: [Vec<f64>; 2],
    /// Cells along y.
    pub(super) rows: usize,
    pub(super) mirror: Mirror,
}

/// A cell near another one.
struct Neighbour {
    cell: usize,
    /// Columns and rows to it.
    off: [f64; 2],
    /// What its motion along y counts as: it may be a mirror image.
    sign: f64,
}

impl KeptContact {
    /// The motion of each cell outside before its entry \[m\]; of one that does not enter, that of the
    /// whole increment.
    pub(super) fn moved(&self, outside: impl Fn(usize) -> bool + Sync) -> [Vec<f64>; 2] {
        let cells = self.gap.len();
        let near = |n: usize| outside(n) && self.gap[n] < NEAR * self.closing[n];
        let root = |n: usize| near(n).then(|| self.gap[n].cbrt());
        let roots: Vec<Option<f64>> = (0..cells).map(root).collect();
        let mut moved = [vec![0.0; cells], vec![0.0; cells]];
        let [x, y] = &mut moved;
        let [motion_x, motion_y] = &self.motion;
        let from = [&self.gap[..], &self.closing, motion_x, motion_y];
        set(from, [x, y], |n, [gap, closing, x, y], _| {
            let motion = [x, y];
            if !outside(n) {
                [0.0; 2]
            } else if gap < closing {
                let alone = self.alone(n, &outside);
                let mean = self.mean_ratio(n, &roots);
                [0, 1].map(|c| alone * motion[c] + (gap - alone * closing) * mean[c])
            } else {
                motion
            }
        });
        moved
    }

    /// The part of the increment for which a cell at the edge moves before one beside it enters, or
    /// it itself; zero elsewhere.
    fn alone(&self, n: usize, outside: impl Fn(usize) -> bool) -> f64 {
        let mut at_edge = false;
        let mut alone = self.gap[n] / self.closing[n];
        for beside in self.around(n, 1) {
            let m = beside.cell;
            if !outside(m) {
                at_edge |= beside.off.contains(&0.0);
            } else if self.closing[m] > 0.0 {
                alone = alone.min(self.gap[m] / self.closing[m]);
            }
        }
        if at_edge { alone } else { 0.0 }
    }

    /// The mean of m/c over the gaps up to that of cell n, which the cube `roots` are of: from
    ///
    /// ```text
    /// m/c = A + B u + C u^2 + D s,   u = (g/g_n)^(1/3), s the way along the edge,
    /// ```
    ///
    /// by least squares of m over the cells around, nearer ones with more weight.
    fn mean_ratio(&self, n: usize, roots: &[Option<f64>]) -> [f64; 2] {
        let mut gram = [[0.0; 4]; 4];
        let mut right = [[0.0; 4]; 2];
        let along = self.along_edge(n);
        let own = roots[n].filter(|own| *own > 0.0);
        for near in self.around(n, AROUND) {
            let m = near.cell;
            let Some(root) = roots[m] else { continue };
            let u = own.map_or(1.0, |own| root / own);
            let [x, y] = near.off;
            let terms = [1.0, u, u * u, along[0] * x + along[1] * y];
            let weight = 1.0 - (x * x + y * y) / (AROUND as f64 + 0.5).powi(2);
            let closing = self.closing[m] / self.closing[n];
            let motion = [self.motion[0][m], near.sign * self.motion[1][m]];
            let motion = motion.map(|m| m / self.closing[n]);
            for (i, term) in terms.into_iter().enumerate() {
                let weighted = weight * closing * term;
                for (entry, other) in gram[i].iter_mut().zip(terms) {
                    *entry += weighted * closing * other;
                }
                for (right, motion) in right.iter_mut().zip(motion) {
                    right[i] += weighted * motion;
                }
            }
        }
        for (i, row) in gram.iter_mut().enumerate().skip(1) {
            row[i] *= 1.0 + RIDGE;
        }
        let inverse = inverse(gram, [true; 4]);
        right.map(|right| {
            let [a, b, c, _] = product(&inverse, right);
            a + 3.0 / 4.0 * b + 3.0 / 5.0 * c
        })
    }

    /// The direction along the edge at a cell outside, in which the gap does not change.
    fn along_edge(&self, n: usize) -> [f64; 2] {
        let mut slope = [0.0; 2];
        for beside in self.around(n, 1) {
            // Goes with the distance from the edge.
            let level = self.gap[beside.cell].cbrt().powi(2);
            for c in 0..2 {
                slope[c] += beside.off[c] * level;
            }
        }
        let steep = size(slope).max(f64::MIN_POSITIVE);
        [-slope[1] / steep, slope[0] / steep]
    }

    /// The cells not further from cell n than `reach` and half a cell, in columns and rows.
    fn around(&self, n: usize, reach: isize) -> impl Iterator<Item = Neighbour> {
        let rows = self.rows as isize;
        let columns = self.gap.len() as isize / rows;
        let (i, j) = (n as isize / rows, n as isize % rows);
        let within = (reach * reach + reach) as f64 + 0.25;
        let square = (-reach..=reach).flat_map(move |x| (-reach..=reach).map(move |y| (x, y)));
        square.filter_map(move |(x, y)| {
            let off = [x as f64, y as f64];
            let (j, sign) = match self.mirror {
                Mirror::Y if j + y < 0 => (-1 - (j + y), -1.0),
                _ => (j + y, 1.0),
            };
            let inside = (0..columns).contains(&(i + x)) && (0..rows).contains(&j);
            let near = off[0] * off[0] + off[1] * off[1] < within;
            (inside && near).then(|| Neighbour {
                cell: ((i + x) * rows + j) as usize,
                off,
                sign,
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::KeptContact;
    use crate::convolution::Mirror;

    /// A round contact in the middle of a grid, or its half y > 0: gap d^(3/2), closing d^(1/2), and
    /// radial motion that is `ratio(d^(1/2))` times the closing.
    fn round(ratio: impl Fn(f64) -> f64, mirror: Mirror) -> (KeptContact, Vec<[f64; 2]>) {
        let n = 64;
        let rows = mirror.rows(n);
        let middle = (n as f64 - 1.0) / 2.0;
        let place = |k: usize| {
            let (i, j) = (k / rows, k % rows + n - rows);
            [i as f64 - middle, j as f64 - middle]
        };
        let places: Vec<[f64; 2]> = (0..n * rows).map(place).collect();
        let beyond = |[x, y]: &[f64; 2]| (x.hypot(*y) - 20.0).max(0.0);
        let closing: Vec<f64> = places.iter().map(|at| 4.0 * beyond(at).sqrt()).collect();
        let motion = |c: usize| {
            let of = |at: &[f64; 2]| {
                let d = beyond(at);
                at[c] / at[0].hypot(at[1]) * 4.0 * d.sqrt() * ratio(d.sqrt())
            };
            places.iter().map(of).collect()
        };
        let contact = KeptContact {
            gap: places.iter().map(|at| beyond(at).powf(1.5)).collect(),
            motion: [motion(0), motion(1)],
            closing,
            rows,
            mirror,
        };
        (contact, places)
    }

    #[test]
    fn cells_move_by_the_integral_of_the_ratio_over_their_gap() {
        let (contact, places) = round(|r| 0.3 - 0.05 * r + 0.003 * r * r, Mirror::None);
        let moved = contact.moved(|n| contact.gap[n] > 0.0);
        for (n, at) in places.iter().enumerate() {
            let d = at[0].hypot(at[1]) - 20.0;
            if !(1.5..3.5).contains(&d) {
                continue;
            }
            let mean = 0.3 - 3.0 / 4.0 * 0.05 * d.sqrt() + 3.0 / 5.0 * 0.003 * d;
            let exact = mean * contact.gap[n];
            for c in 0..2 {
                let off = moved[c][n] - exact * at[c] / at[0].hypot(at[1]);
                assert!(
                    off.abs() < 0.01 * exact,
                    "{at:?}: off by {off:e} of {exact:e}"
                );
            }
        }
    }

    #[test]
    fn a_ratio_that_is_the_same_everywhere_is_that_of_all_ways() {
        let (mut contact, _) = round(|_| 0.0, Mirror::None);
        contact.motion =
            [0.2, -0.1].map(|ratio| contact.closing.iter().map(|c| ratio * c).collect());
        let moved = contact.moved(|n| contact.gap[n] > 0.0);
        for n in (0..contact.gap.len()).filter(|&n| contact.gap[n] < contact.closing[n]) {
            let gap = contact.gap[n];
            let off = (moved[0][n] - 0.2 * gap).hypot(moved[1][n] + 0.1 * gap);
            assert!(off < 1e-12 * gap, "off by {off:e} of {gap:e}");
        }
    }

    #[test]
    fn the_half_of_a_mirrored_contact_moves_as_in_the_whole() {
        let ratio = |r: f64| 0.3 - 0.05 * r;
        let (whole, places) = round(ratio, Mirror::None);
        let (half, kept) = round(ratio, Mirror::Y);
        let in_whole = whole.moved(|n| whole.gap[n] > 0.0);
        let in_half = half.moved(|n| half.gap[n] > 0.0);
        let same = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 0.5;
        for (n, at) in kept.iter().enumerate() {
            let twin = places.iter().position(|place| same(place, at)).unwrap();
            for c in 0..2 {
                let off = (in_half[c][n] - in_whole[c][twin]).abs();
                assert!(off < 1e-11, "{at:?}: off by {off:e}");
            }
        }
    }
}
