//! Points x, y and a value on an even lattice, in any order.

use ndarray::Array2;

/// Evenly spaced coordinates: the first, the distance, the number.
#[derive(Clone, Copy, Debug)]
struct Line {
    first: f64,
    pitch: f64,
    n: usize,
}

/// Fraction of the distance of two points by which a coordinate may be off the lattice: due to
/// rounding to few digits, or to the steps of a stage.
const OFF: f64 = 0.1;
/// Fraction for points that were meant to lie on a lattice, but are too far off it.
const NEAR: f64 = 0.35;
/// Least ratio of the distance of two lines over the scatter within one.
const SEPARATED: f64 = 1.5;
/// Fraction of the range below which two coordinates are equal.
const SAME: f64 = 1e-6;
/// Smallest fraction of a lattice that must have points.
const FILLED: f64 = 0.5;

impl Line {
    /// Fits a line to coordinates, each at most the fraction `off` of the distance away from it,
    /// or `None` if they are not evenly spaced.
    ///
    /// The coordinates of one line of the lattice scatter. The widths that separate lines are
    /// tried from the widest gap on.
    fn fit(coordinates: impl Iterator<Item = f64>, off: f64) -> Option<Self> {
        let mut sorted: Vec<f64> = coordinates.collect();
        if sorted.iter().any(|x| x.is_nan()) {
            return None;
        }
        sorted.sort_unstable_by(f64::total_cmp);
        let range = sorted.last()? - sorted.first()?;
        let mut gaps: Vec<f64> = sorted.windows(2).map(|pair| pair[1] - pair[0]).collect();
        gaps.retain(|gap| *gap > SAME * range);
        gaps.sort_unstable_by(|a, b| b.total_cmp(a));
        let narrowest = *gaps.last()?;
        let steps = gaps.windows(2).filter(|pair| pair[0] > SEPARATED * pair[1]);
        let gap_limits = steps.map(|pair| (pair[0] * pair[1]).sqrt());
        let mut gap_limits = gap_limits.chain([0.5 * narrowest]);
        gap_limits.find_map(|gap_limit| Self::fit_clusters(&sorted, gap_limit, off))
    }

    /// Fits a line to the middles of the clusters of sorted coordinates; gaps wider than `gap_limit` separate them.
    fn fit_clusters(sorted: &[f64], gap_limit: f64, off: f64) -> Option<Self> {
        let clusters = sorted.chunk_by(|a, b| b - a <= gap_limit);
        let middles: Vec<f64> = clusters
            .map(|cluster| 0.5 * (cluster[0] + cluster[cluster.len() - 1]))
            .collect();
        let range = middles.last()? - middles.first()?;
        let mut gaps: Vec<f64> = middles.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if gaps.is_empty() {
            return None;
        }
        let middle = gaps.len() / 2;
        let (_, median, _) = gaps.select_nth_unstable_by(middle, f64::total_cmp);
        let median = *median;
        // Lines without a point leave gaps of several pitches.
        let single_gaps = gaps.iter().filter(|gap| **gap < 1.5 * median);
        let (sum, n) = single_gaps.fold((0.0, 0_usize), |(sum, n), gap| (sum + gap, n + 1));
        let steps = (range * n as f64 / sum).round();
        let line = Self {
            first: middles[0],
            pitch: range / steps,
            n: steps as usize + 1,
        };
        let offset = |x: &f64| ((x - line.first) / line.pitch - line.index(*x) as f64).abs();
        sorted.iter().all(|x| offset(x) < off).then_some(line)
    }

    /// The number of the lattice line nearest to a coordinate.
    fn index(&self, x: f64) -> usize {
        ((x - self.first) / self.pitch).round() as usize
    }
}

/// An even lattice in two columns of a table.
#[derive(Debug)]
pub(super) struct Lattice {
    x: Line,
    y: Line,
}

impl Lattice {
    /// Finds the lattice of some points, if at least half of it has points and it is no line.
    pub(super) fn find<I: Iterator<Item = f64>>(x: I, y: I, points: usize) -> Option<Self> {
        Self::fit(x, y, points, OFF)
    }

    /// Whether points were meant to lie on a lattice, which they miss by too much.
    pub(super) fn is_near<I: Iterator<Item = f64>>(x: I, y: I, points: usize) -> bool {
        Self::fit(x, y, points, NEAR).is_some()
    }

    /// Fits the lines along x and y with the tolerance `off`. None if the points are no lattice, lie on one
    /// line, or fill less than [`FILLED`] of it.
    fn fit<I: Iterator<Item = f64>>(x: I, y: I, points: usize, off: f64) -> Option<Self> {
        let (x, y) = (Line::fit(x, off)?, Line::fit(y, off)?);
        let filled = points as f64 / (x.n as f64 * y.n as f64);
        (x.n > 1 && y.n > 1 && filled >= FILLED).then_some(Self { x, y })
    }

    /// Distance of the points along x and y, in their unit.
    pub(super) fn pitch(&self) -> (f64, f64) {
        (self.x.pitch, self.y.pitch)
    }

    /// Arranges the values on the lattice, NaN where there is no point; fails with the numbers of two points at one
    /// place.
    pub(super) fn arrange(
        &self,
        points: impl Iterator<Item = [f64; 3]>,
    ) -> Result<Array2<f64>, (usize, usize)> {
        const NONE: u32 = u32::MAX;
        let shape = (self.x.n, self.y.n);
        let mut values = Array2::from_elem(shape, f64::NAN);
        let mut point_at = Array2::from_elem(shape, NONE);
        for (n, [x, y, value]) in points.enumerate() {
            let index = (self.x.index(x), self.y.index(y));
            if point_at[index] != NONE {
                return Err((point_at[index] as usize, n));
            }
            point_at[index] = n as u32;
            values[index] = value;
        }
        Ok(values)
    }
}

#[cfg(test)]
mod tests {
    use super::Lattice;

    #[test]
    fn a_lattice_is_found_whatever_the_rounding() {
        // A third of a micrometre, written with three digits.
        let coordinate = |n: usize| (n as f64 / 3.0 * 1e3).round() / 1e3;
        let points: Vec<[f64; 3]> = (0..1000 * 3)
            .map(|n| [coordinate(n % 1000), coordinate(n / 1000), n as f64])
            .filter(|[x, ..]| !(x - 2.0).abs().lt(&0.01))
            .collect();
        let column = |n: usize| points.iter().map(move |point| point[n]);
        let lattice = Lattice::find(column(0), column(1), points.len()).expect("a lattice");
        assert!((lattice.pitch().0 - 1.0 / 3.0).abs() < 1e-5, "{lattice:?}");
        let values = lattice.arrange(points.iter().copied()).expect("places");
        assert_eq!(values.dim(), (1000, 3));
        assert!(values[(999, 2)] == 2999.0 && values[(6, 1)].is_nan() && values[(7, 1)] == 1007.0);
        assert!(Lattice::find(column(0), column(2), points.len()).is_none());
        // A stage that misses its places, by less and by more.
        for (miss, found) in [(1e-3, true), (0.02, true), (0.09, true), (0.2, false)] {
            let off = |n: usize| miss * (2.0 * ((n * 7919) as f64 * 0.618).fract() - 1.0);
            let kept = (0..130_usize).filter(|n| n % 13 != 4);
            let (x, y) = (|n: usize| (n % 13) as f64, |n: usize| (n / 13) as f64);
            let points: Vec<[f64; 3]> = kept
                .map(|n| [x(n) + off(n), y(n) + off(3 * n + 1), n as f64])
                .collect();
            let column = |n: usize| points.iter().map(move |point| point[n]);
            let on_lattice = Lattice::find(column(0), column(1), points.len());
            assert_eq!(on_lattice.is_some(), found, "{miss}");
            assert!(Lattice::is_near(column(0), column(1), points.len()));
            if let Some(lattice) = on_lattice {
                let values = lattice.arrange(points.iter().copied()).expect("places");
                assert!(values.dim() == (13, 10) && values[(3, 2)] == 29.0);
                assert!(values[(4, 2)].is_nan());
            }
        }
        let twice = [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]];
        assert_eq!(lattice.arrange(twice.into_iter()), Err((0, 1)));
    }
}
