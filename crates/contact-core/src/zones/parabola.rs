//! The parabola by which a level is extrapolated along a line.

/// Largest first second-difference of the level along a line (FIRST_BEND) and largest change of the
/// second difference from cell to cell (BEND), both over the first difference: larger ones indicate
/// another border there (of the stick zone before a reversal).
const FIRST_BEND: f64 = 0.4;
const BEND: f64 = 0.15;
/// The parabola is accepted if the cubic term moves the border by less than this \[cells\].
const MOVED: f64 = 0.2;
/// Largest difference of sampled levels from it in the skipped cells, over the rise per cell.
const SAMPLED: f64 = 0.01;

/// f = c_0 + c_1 s + c_2 s^2 along a line, s in cells from the first one that is not skipped.
#[derive(Clone, Copy)]
pub(crate) struct Parabola {
    c: [f64; 3],
    /// The place s of the outermost cell.
    pub(super) outermost: f64,
}

impl Parabola {
    /// Builds a parabola from c_0, c_1, c_2 with some cells skipped.
    pub(super) fn new(c: [f64; 3], skipped: usize) -> Self {
        Self {
            c,
            outermost: -(skipped as f64),
        }
    }

    /// Fits a parabola to the levels of the outermost cell and the next ones, without the first `skipped`: least squares
    /// through five, the parabola through three, or the straight line through two, whichever the
    /// smooth part of the line allows.
    pub(crate) fn fit(levels: &[f64], skipped: usize) -> Option<Self> {
        // The last skipped cell is tested too: a kink right behind it shows there.
        let extra = usize::from(skipped > 0);
        let (checked, used) = (levels.get(skipped - extra..)?, levels.get(skipped..)?);
        let &[y_1, y_2, ..] = checked else {
            return None;
        };
        let mut last_bend = None;
        let smooth = checked.windows(3).take_while(|y| {
            let bend = y[2] - 2.0 * y[1] + y[0];
            let (bend_before, limit) = match last_bend.replace(bend) {
                Some(before) => (before, BEND),
                None => (0.0, FIRST_BEND),
            };
            (bend - bend_before).abs() <= limit * (y_2 - y_1).abs()
        });
        // Cells before the first kink; a small zone is curved, but like a parabola.
        let cells = if Self::is_parabola(levels, skipped) {
            levels.len() - skipped
        } else {
            smooth.count() + 2 - extra
        };
        let c = match (cells, used) {
            // About the middle sample, with the orthogonal polynomials 1, s, s^2 - 2.
            (5.., &[a, b, c, d, e, ..]) => {
                let c_2 = (2.0 * (a + e) - (b + d) - 2.0 * c) / 14.0;
                let c_1 = (2.0 * (e - a) + d - b) / 10.0;
                let c_0 = (a + b + c + d + e) / 5.0 - 2.0 * c_2;
                [c_0 - 2.0 * c_1 + 4.0 * c_2, c_1 - 4.0 * c_2, c_2]
            }
            (3.., &[a, b, c, ..]) => [a, 2.0 * b - 1.5 * a - 0.5 * c, 0.5 * (a + c) - b],
            (2.., &[a, b, ..]) => [a, b - a, 0.0],
            // The straight line through the last skipped cell and the first used one.
            (_, &[a, ..]) => [a, y_2 - y_1, 0.0],
            (_, []) => return None,
        };
        Some(Self::new(c, skipped))
    }

    /// Whether the cubic term through five cells is small at the border, about half a cell outside
    /// the outermost cell.
    pub(crate) fn is_parabola(levels: &[f64], skipped: usize) -> bool {
        let Some(&[a, b, _, d, e, ..]) = levels.get(skipped..) else {
            return false;
        };
        // About the middle sample; the orthogonal polynomial 5/6 (s^3 - 3.4 s).
        let c_3 = (2.0 * (b - d) + e - a) / 10.0;
        let s = -2.5 - skipped as f64;
        let cubic = c_3 * 5.0 / 6.0 * s * (s * s - 3.4);
        cubic.abs() <= MOVED * (b - a)
    }

    /// The level s cells from the origin of the parabola.
    pub(crate) fn evaluate(self, s: f64) -> f64 {
        let [c_0, c_1, c_2] = self.c;
        c_0 + s * (c_1 + s * c_2)
    }

    /// Whether it passes through the skipped cells too: tractions sampled at the middles of the
    /// cells, not solved.
    pub(super) fn passes_through(self, levels: &[f64]) -> bool {
        let skipped = -self.outermost as usize;
        let rise = self.slope(self.outermost);
        let misses = |(k, level): (usize, &f64)| {
            (self.evaluate(self.outermost + k as f64) - level).abs() > SAMPLED * rise
        };
        skipped > 0 && !levels.iter().take(skipped).enumerate().any(misses)
    }

    /// Distance of the middle of the outermost cell from the border, inwards \[cells\].
    pub(crate) fn distance_inside(self) -> f64 {
        self.evaluate(self.outermost) / self.slope(self.outermost)
    }

    /// Half of the second derivative of the level by cells.
    pub(crate) fn bend(self) -> f64 {
        self.c[2]
    }

    /// Derivative of the level by cells, s cells from the origin.
    pub(crate) fn slope(self, s: f64) -> f64 {
        let [_, c_1, c_2] = self.c;
        c_1 + 2.0 * c_2 * s
    }
}
