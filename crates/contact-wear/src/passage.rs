//! Worn depth within a jump: the parabola through its start, middle and end.

use super::loss::Worn;

/// A cell has reached a depth from this relative distance below it. A jump that ends there misses
/// the depth by rounding.
pub const DEPTH_ROUNDING: f64 = 1e-9;

/// The depth of every cell within a jump \[m\]: `w_0 + (4 m - e) s + (2 e - 4 m) s^2` at the part s
/// of the jump, m and e being the losses in its first half and in all. Both are of second order,
/// and so is the parabola.
pub(crate) struct Passage<'a> {
    pub(crate) worn: &'a Worn,
    /// Loss in the first half, and in all \[m\].
    pub(crate) half: &'a [Vec<f64>; 2],
    pub(crate) whole: &'a [Vec<f64>; 2],
}

impl Passage<'_> {
    /// Finds when a body first reaches a depth \[m\] within the jump: the part of the jump that has
    /// passed, and the cell.
    pub(crate) fn first_reached(&self, b: usize, depth: f64) -> Option<(f64, usize)> {
        let cells = 0..self.whole[b].len();
        let reached = cells.filter_map(|c| {
            let (from, half, whole) = (self.worn.depth[b][c], self.half[b][c], self.whole[b][c]);
            let reaches = from + whole >= depth * (1.0 - DEPTH_ROUNDING);
            reaches.then(|| (part_at_loss(depth - from, half, whole), c))
        });
        reached.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// The part of a jump after which the loss is `target`, by the parabola through the loss `half` after its first
/// half and `whole` after all.
fn part_at_loss(target: f64, half: f64, whole: f64) -> f64 {
    if !(target > 0.0 && whole > 0.0) {
        return 0.0;
    }
    // The loss is monotone: the vertex of the parabola must not lie within the jump.
    let half = half.clamp(0.25 * whole, 0.75 * whole);
    let (slope, bend) = (4.0 * half - whole, 2.0 * whole - 4.0 * half);
    let root = (slope * slope + 4.0 * bend * target).max(0.0).sqrt();
    (2.0 * target / (slope + root)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::{Passage, part_at_loss};
    use crate::loss::Worn;

    #[test]
    fn a_parabola_is_met_where_it_is() {
        for (a, b) in [(1.0, 0.0), (0.2, 0.8), (2.0, -1.0), (0.0, 1.0)] {
            let at = |s: f64| a * s + b * s * s;
            for s in [0.1, 0.5, 0.9, 1.0] {
                assert!(
                    (part_at_loss(at(s), at(0.5), at(1.0)) - s).abs() < 1e-7,
                    "{a} {b} {s}"
                );
            }
        }
        assert_eq!(part_at_loss(0.0, 0.5, 1.0), 0.0);
    }

    #[test]
    fn a_jump_that_ends_at_a_depth_reaches_it() {
        let depth = 1.5e-6_f64;
        let worn = Worn {
            depth: [vec![0.0], vec![0.4e-6]],
            ..Worn::unworn(1)
        };
        let [none, short] = [vec![0.0], vec![depth.next_down() - 0.4e-6]];
        let half = [none.clone(), vec![0.5 * short[0]]];
        let whole = [none, short];
        let passage = Passage {
            worn: &worn,
            half: &half,
            whole: &whole,
        };
        let (part, cell) = passage.first_reached(1, depth).expect("reached");
        assert!(part > 1.0 - 1e-9 && cell == 0);
        assert!(passage.first_reached(1, 1.001 * depth).is_none());
    }
}
