//! Local maxima of sampled fields, from which a search for the largest value starts.
//!
//! The search takes one direction after the other: the top of a line is the vertex of the parabola
//! through its largest sample and the two beside it. The tops of the lines of a plane are treated
//! as samples again. A hill is a depth whose top is higher than the tops of its neighbours.

use ndarray::{Array2, ArrayView1};

use super::Depth;

/// Tops of neighbouring lines or depths belong to one hill if their samples are at most this many
/// cells apart.
const SAME_HILL: usize = 2;

/// The largest value at one depth: on a line (D = 1) or on a plane (D = 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Top<const D: usize> {
    /// Value at the vertex of the parabolas.
    pub value: f64,
    /// Place along the line, or x and y \[m\].
    pub place: [f64; D],
    /// The nearest sample.
    pub sample: [usize; D],
    /// The value of that sample.
    pub sampled: f64,
    /// Error of the value: vertex of the parabola less the sample; at the end of the line the
    /// difference of the last two samples.
    pub error: f64,
}

/// A depth whose top is higher than the tops of the neighbouring depths in its layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hill<const D: usize> {
    /// The top of the parabolas through the tops of this depth and the two beside it.
    pub(super) top: Top<D>,
    pub(super) depth: Depth,
    /// Depth of the nearest sample \[m\].
    pub(super) sampled_z: f64,
    /// Distance to the next depth \[m\]; 0 without a neighbour.
    pub(super) step: f64,
}

/// The largest value on a line of samples at the places `along` \[m\]; `None` without a number.
pub fn top_of_line(values: &ArrayView1<'_, f64>, along: &[f64]) -> Option<Top<1>> {
    let samples = values.iter().zip(along).enumerate();
    let tops: Vec<_> = samples
        .filter(|(_, (value, _))| !value.is_nan())
        .map(|(i, (&value, &place))| Top {
            value,
            place: [place],
            sample: [i],
            sampled: value,
            error: 0.0,
        })
        .collect();
    let are_neighbours = |n: usize, m: usize| tops[n].sample[0].abs_diff(tops[m].sample[0]) == 1;
    let n = index_of_largest(&tops)?;
    let (at, top) = summit(&tops, n, |n| tops[n].place[0], &are_neighbours);
    let at_end = n == 0 || n + 1 == tops.len();
    let neighbour = [n.checked_sub(1), Some(n + 1)];
    let neighbour = neighbour.into_iter().flatten().find_map(|n| tops.get(n));
    let error = match neighbour.filter(|_| at_end) {
        Some(neighbour) => top.value - neighbour.value,
        None => top.value - top.sampled,
    };
    Some(Top {
        place: [at],
        error: error.abs(),
        ..top
    })
}

/// The largest value on a plane of samples at x and y \[m\]; `None` without a number.
pub fn top_of_plane(values: &Array2<f64>, x: &[f64], y: &[f64]) -> Option<Top<2>> {
    let lines = values.rows().into_iter().enumerate();
    let (samples, tops): (Vec<usize>, Vec<Top<1>>) = lines
        .filter_map(|(i, line)| Some((i, top_of_line(&line, y)?)))
        .unzip();
    let are_neighbours = |n: usize, m: usize| samples[n].abs_diff(samples[m]) == 1;
    let n = index_of_largest(&tops)?;
    let (at, top) = summit(&tops, n, |n| x[samples[n]], &are_neighbours);
    Some(Top {
        value: top.value,
        place: [at, top.place[0]],
        sample: [samples[n], top.sample[0]],
        sampled: top.sampled,
        error: top.error,
    })
}

/// Finds the maxima over the depths, the highest first, from the top of each depth. Depths of different layers
/// are no neighbours, so that kinks at interfaces remain. If `smooth`, parabolas interpolate between depths.
pub(super) fn find_hills<const D: usize>(
    tops: &[Option<Top<D>>],
    depths: &[Depth],
    smooth: bool,
) -> Vec<Hill<D>> {
    let (indices, tops): (Vec<usize>, Vec<Top<D>>) = tops
        .iter()
        .enumerate()
        .filter_map(|(k, top)| Some((k, (*top)?)))
        .unzip();
    let are_neighbours = |n: usize, m: usize| {
        let (a, b) = (indices[n], indices[m]);
        smooth && a.abs_diff(b) == 1 && depths[a].layer == depths[b].layer
    };
    let neighbours = |n: usize| {
        let others = [n.checked_sub(1), (n + 1 < tops.len()).then_some(n + 1)];
        others
            .into_iter()
            .flatten()
            .filter(move |m| are_neighbours(n, *m))
    };
    let higher = |n: &usize| neighbours(*n).all(|m| tops[m].value <= tops[*n].value);
    let mut hills: Vec<Hill<D>> = (0..tops.len())
        .filter(higher)
        .map(|n| {
            let z = |n: usize| depths[indices[n]].z;
            let (at, top) = summit(&tops, n, z, &are_neighbours);
            let layer = depths[indices[n]].layer;
            Hill {
                top,
                depth: Depth { z: at, layer },
                sampled_z: z(n),
                step: neighbours(n)
                    .map(|m| (z(m) - z(n)).abs())
                    .fold(0.0, f64::max),
            }
        })
        .collect();
    hills.sort_by(|a, b| b.top.value.total_cmp(&a.top.value));
    hills
}

/// Index of the largest sampled top.
fn index_of_largest<const D: usize>(tops: &[Top<D>]) -> Option<usize> {
    (0..tops.len()).max_by(|&a, &b| tops[a].value.total_cmp(&tops[b].value))
}

/// The vertex of the parabola through one of `tops` and its two neighbours, which are no higher:
/// its place along `place_of` and its value; the sample itself if the neighbours are not on the
/// same hill.
fn summit<const D: usize>(
    tops: &[Top<D>],
    n: usize,
    place_of: impl Fn(usize) -> f64,
    are_neighbours: &dyn Fn(usize, usize) -> bool,
) -> (f64, Top<D>) {
    let top = tops[n];
    let stays = (place_of(n), top);
    let on_same_hill = |m: usize| {
        let cells = tops[m].sample.iter().zip(top.sample);
        are_neighbours(n, m) && cells.into_iter().all(|(a, b)| a.abs_diff(b) <= SAME_HILL)
    };
    if n == 0 || n + 1 == tops.len() || !on_same_hill(n - 1) || !on_same_hill(n + 1) {
        return stays;
    }
    let (low, high) = (tops[n - 1], tops[n + 1]);
    let (a, b) = (place_of(n) - place_of(n - 1), place_of(n + 1) - place_of(n));
    // Newton's form of the parabola through three samples: value + slope s + half s^2, with the
    // slope at the middle one.
    let parabola = |low: f64, middle: f64, high: f64| {
        let (left, right) = ((middle - low) / a, (high - middle) / b);
        ((left * b + right * a) / (a + b), (right - left) / (a + b))
    };
    let (slope, half) = parabola(low.value, top.value, high.value);
    let step = -slope / (2.0 * half);
    // A vertex beyond the neighbours is rejected.
    if !(half < 0.0 && -a <= step && step <= b) {
        return stays;
    }
    let vertex = std::array::from_fn(|d| {
        let (slope, half) = parabola(low.place[d], top.place[d], high.place[d]);
        top.place[d] + step * (slope + step * half)
    });
    (
        place_of(n) + step,
        Top {
            value: top.value + slope * step / 2.0,
            place: vertex,
            sample: top.sample,
            sampled: top.sampled,
            error: top.error,
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const Z: [f64; 6] = [0.0, 0.7, 1.1, 1.9, 2.4, 3.0];
    const X: [f64; 6] = [-2.0, -1.0, -0.4, 0.5, 1.0, 1.6];

    fn highest(field: &Array2<f64>, depths: &[Depth], along: &[f64]) -> Option<Hill<1>> {
        let lines = field.rows().into_iter();
        let tops: Vec<_> = lines.map(|line| top_of_line(&line, along)).collect();
        find_hills(&tops, depths, true).into_iter().next()
    }

    #[test]
    fn finds_the_top_of_a_quadratic_on_uneven_samples() {
        let f = |x: f64, z: f64| {
            5.0 - (x - 0.2).powi(2) - 2.0 * (z - 1.6).powi(2) + 0.9 * (x - 0.2) * (z - 1.6)
        };
        let field = Array2::from_shape_fn((6, 6), |(k, i)| f(X[i], Z[k]));
        let depths = Z.map(|z| Depth { z, layer: 0 });
        let m = highest(&field, &depths, &X).expect("numbers");
        assert!((m.top.value - 5.0).abs() < 1e-12, "{m:?}");
        assert!((m.top.place[0] - 0.2).abs() < 1e-12 && (m.depth.z - 1.6).abs() < 1e-12);
    }

    #[test]
    fn finds_the_top_in_a_volume() {
        let y = [-1.0, -0.5, 0.0, 0.5, 1.0];
        let f = |x: f64, y: f64, z: f64| {
            let (x, y, z) = (x - 0.2, y - 0.13, z - 1.6);
            7.0 - x * x - 1.5 * y * y - 2.0 * z * z + 0.4 * x * y - 0.3 * y * z + 0.5 * x * z
        };
        let tops = Z.map(|z| {
            let plane = Array2::from_shape_fn((6, 5), |(i, j)| f(X[i], y[j], z));
            top_of_plane(&plane, &X, &y)
        });
        let m = find_hills(&tops, &Z.map(|z| Depth { z, layer: 0 }), true)[0];
        assert!((m.top.value - 7.0).abs() < 1e-12, "{m:?}");
        for (ours, exact) in [
            (m.top.place[0], 0.2),
            (m.top.place[1], 0.13),
            (m.depth.z, 1.6),
        ] {
            assert!((ours - exact).abs() < 1e-12, "{m:?}");
        }
    }

    #[test]
    fn a_kink_at_an_interface_stays_there() {
        let depths = [(0.0, 0), (1.0, 0), (1.0, 1), (2.0, 1)].map(|(z, layer)| Depth { z, layer });
        let field = Array2::from_shape_fn((4, 3), |(k, i)| {
            [1.0, 4.0, 3.0, 1.0][k] - (i as f64 - 1.0).powi(2)
        });
        let m = highest(&field, &depths, &[-1.0, 0.0, 1.0]).expect("numbers");
        assert_eq!((m.top.value, m.depth), (4.0, depths[1]));
    }

    #[test]
    fn another_hill_is_no_neighbour() {
        let depths = [0.0, 1.0, 2.0].map(|z| Depth { z, layer: 0 });
        let mut field = Array2::zeros((3, 9));
        (field[(0, 1)], field[(1, 7)], field[(2, 7)]) = (3.9, 4.0, 1.0);
        let along: Vec<f64> = (0..9).map(f64::from).collect();
        let m = highest(&field, &depths, &along).expect("numbers");
        assert_eq!((m.top.value, m.depth.z, m.top.place), (4.0, 1.0, [7.0]));
        assert!(highest(&(field * f64::NAN), &depths, &along).is_none());
    }
}
