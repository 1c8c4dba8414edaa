//! Largest value of a sampled field, between the samples.
//!
//! One direction after the other: the top of each line is that of the parabola through its largest
//! sample and the two beside it; the tops of the lines of a plane, or of the depths, are samples
//! again. For a quadratic field that is exact, mixed derivatives included. For smooth ones the
//! place is right to the square of the sampling, the value to its fourth power.

use ndarray::{Array2, ArrayView1};

use super::Depth;
use super::depth::on_interfaces;

/// Largest shift of the sample, in cells, between the tops of neighbouring lines or depths for
/// them to belong to one hill.
const SAME_HILL: usize = 2;

/// The largest value at one depth: on a line (D = 1) or on a plane (D = 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Top<const D: usize> {
    /// Value, of the parabolas through the samples around.
    pub value: f64,
    /// Place along the line, or x and y \[m\].
    pub place: [f64; D],
    /// The sample next to it.
    pub sample: [usize; D],
}

/// The largest value at several depths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum<const D: usize> {
    /// Value, of the parabolas through the samples around.
    pub value: f64,
    /// Place along the line, or x and y \[m\].
    pub place: [f64; D],
    /// Depth and layer; a maximum on an interface or on the surface is that of the side named.
    pub depth: Depth,
    /// Index of the depth next to it.
    pub sample: usize,
    /// What the distances of the depths leave of an error, estimated: what the value changes by if
    /// every other depth of each layer is left out.
    pub error: f64,
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
        })
        .collect();
    let beside = |n: usize, m: usize| tops[n].sample[0].abs_diff(tops[m].sample[0]) == 1;
    let (at, top) = summit(&tops, |n| tops[n].place[0], &beside)?;
    Some(Top { place: [at], ..top })
}

/// The largest value on a plane of samples at x and y \[m\]; `None` without a number.
pub fn top_of_plane(values: &Array2<f64>, x: &[f64], y: &[f64]) -> Option<Top<2>> {
    let lines = values.rows().into_iter().enumerate();
    let (samples, tops): (Vec<usize>, Vec<Top<1>>) = lines
        .filter_map(|(i, line)| Some((i, top_of_line(&line, y)?)))
        .unzip();
    let beside = |n: usize, m: usize| samples[n].abs_diff(samples[m]) == 1;
    let (at, top) = summit(&tops, |n| x[samples[n]], &beside)?;
    let largest = largest(&tops)?;
    Some(Top {
        value: top.value,
        place: [at, top.place[0]],
        sample: [samples[largest], top.sample[0]],
    })
}

/// The largest value over depths, from the tops at each; depths of other layers are no
/// neighbours, so that kinks stay kinks. `None` without a number.
pub fn maximum_of_tops<const D: usize>(
    tops: &[Option<Top<D>>],
    depths: &[Depth],
) -> Option<Maximum<D>> {
    let largest = summit_of_tops(tops, depths)?;
    let mut thinned = tops.to_vec();
    for (top, kept) in thinned.iter_mut().zip(every_other(depths)) {
        *top = top.filter(|_| kept);
    }
    let coarser = summit_over(&thinned, depths, &every_other(depths));
    let error = coarser.map_or(f64::INFINITY, |c| (largest.value - c.value).abs());
    Some(Maximum { error, ..largest })
}

/// The same on the interfaces alone; `None` where there is none among the depths.
pub fn maximum_on_interfaces<const D: usize>(
    tops: &[Option<Top<D>>],
    depths: &[Depth],
) -> Option<Maximum<D>> {
    let tops = tops.iter().zip(on_interfaces(depths));
    let kept: Vec<_> = tops.map(|(top, kept)| top.filter(|_| kept)).collect();
    // An interface is no sample of anything: there is nothing between two of them.
    let largest = summit_over(&kept, depths, &vec![false; depths.len()])?;
    Some(Maximum {
        error: 0.0,
        ..largest
    })
}

/// Which depths stay if every other one of each layer is left out, its first and last kept.
fn every_other(depths: &[Depth]) -> Vec<bool> {
    let layers = depths.chunk_by(|a, b| a.layer == b.layer);
    let kept = layers.flat_map(|of| (0..of.len()).map(|n| n % 2 == 0 || n + 1 == of.len()));
    kept.collect()
}

fn summit_of_tops<const D: usize>(tops: &[Option<Top<D>>], depths: &[Depth]) -> Option<Maximum<D>> {
    summit_over(tops, depths, &vec![true; depths.len()])
}

/// The largest value over the depths with a top; neighbours are those of one layer between which
/// no depth lies that is `present`.
fn summit_over<const D: usize>(
    tops: &[Option<Top<D>>],
    depths: &[Depth],
    present: &[bool],
) -> Option<Maximum<D>> {
    let (found, tops): (Vec<usize>, Vec<Top<D>>) = tops
        .iter()
        .enumerate()
        .filter_map(|(k, top)| Some((k, (*top)?)))
        .unzip();
    let beside = |n: usize, m: usize| {
        let (a, b) = (found[n], found[m]);
        let between = a.min(b) + 1..a.max(b);
        let next = present[a] && present[b] && !present[between].contains(&true);
        next && depths[a].layer == depths[b].layer
    };
    let (z, top) = summit(&tops, |n| depths[found[n]].z, &beside)?;
    let sample = found[largest(&tops)?];
    Some(Maximum {
        value: top.value,
        place: top.place,
        depth: Depth {
            z,
            layer: depths[sample].layer,
        },
        sample,
        error: 0.0,
    })
}

/// The largest value of a field of shape (depths, places along a line).
pub fn maximum(field: &Array2<f64>, depths: &[Depth], along: &[f64]) -> Option<Maximum<1>> {
    let tops: Vec<_> = field
        .rows()
        .into_iter()
        .map(|line| top_of_line(&line, along))
        .collect();
    maximum_of_tops(&tops, depths)
}

fn largest<const D: usize>(tops: &[Top<D>]) -> Option<usize> {
    (0..tops.len()).max_by(|&a, &b| tops[a].value.total_cmp(&tops[b].value))
}

/// The top of the parabola through the largest of `tops` and the two beside it: where it lies
/// along `at`, and what it is there. Without neighbours on the same hill the sample stands.
fn summit<const D: usize>(
    tops: &[Top<D>],
    at: impl Fn(usize) -> f64,
    beside: &dyn Fn(usize, usize) -> bool,
) -> Option<(f64, Top<D>)> {
    let n = largest(tops)?;
    let top = tops[n];
    let stays = Some((at(n), top));
    let on_same_hill = |m: usize| {
        let cells = tops[m].sample.iter().zip(top.sample);
        beside(n, m) && cells.into_iter().all(|(a, b)| a.abs_diff(b) <= SAME_HILL)
    };
    if n == 0 || n + 1 == tops.len() || !on_same_hill(n - 1) || !on_same_hill(n + 1) {
        return stays;
    }
    let (low, high) = (tops[n - 1], tops[n + 1]);
    let (a, b) = (at(n) - at(n - 1), at(n + 1) - at(n));
    // Newton's form of the parabola through three samples: value + slope s + half s^2, with the
    // slope at the middle one.
    let parabola = |low: f64, middle: f64, high: f64| {
        let (left, right) = ((middle - low) / a, (high - middle) / b);
        ((left * b + right * a) / (a + b), (right - left) / (a + b))
    };
    let (slope, half) = parabola(low.value, top.value, high.value);
    let step = -slope / (2.0 * half);
    // Beyond the neighbours the samples are no parabola.
    if !(half < 0.0 && -a <= step && step <= b) {
        return stays;
    }
    let place = std::array::from_fn(|d| {
        let (slope, half) = parabola(low.place[d], top.place[d], high.place[d]);
        top.place[d] + step * (slope + step * half)
    });
    Some((
        at(n) + step,
        Top {
            value: top.value + slope * step / 2.0,
            place,
            sample: top.sample,
        },
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    const Z: [f64; 6] = [0.0, 0.7, 1.1, 1.9, 2.4, 3.0];
    const X: [f64; 6] = [-2.0, -1.0, -0.4, 0.5, 1.0, 1.6];

    #[test]
    fn finds_the_top_of_a_quadratic_on_uneven_samples() {
        let f = |x: f64, z: f64| {
            5.0 - (x - 0.2).powi(2) - 2.0 * (z - 1.6).powi(2) + 0.9 * (x - 0.2) * (z - 1.6)
        };
        let field = Array2::from_shape_fn((6, 6), |(k, i)| f(X[i], Z[k]));
        let depths = Z.map(|z| Depth { z, layer: 0 });
        let m = maximum(&field, &depths, &X).expect("numbers");
        assert!((m.value - 5.0).abs() < 1e-12, "{m:?}");
        assert!((m.place[0] - 0.2).abs() < 1e-12 && (m.depth.z - 1.6).abs() < 1e-12);
    }

    #[test]
    fn its_error_is_what_half_of_the_depths_miss() {
        let depths: Vec<Depth> = (0..=16)
            .map(|k| Depth {
                z: 0.25 * f64::from(k),
                layer: 0,
            })
            .collect();
        let field = |z: f64| (z - 1.6).powi(2) * (0.1 * z - 1.0);
        let values = Array2::from_shape_fn((17, 6), |(k, i)| field(depths[k].z) - X[i].powi(2));
        let m = maximum(&values, &depths, &X).expect("numbers");
        let off = (m.value - field(1.6)).abs();
        assert!(m.error > 0.0 && off < 1e-2, "{m:?}");
        // One at a border is exact.
        let at_border = Array2::from_shape_fn((17, 6), |(k, i)| depths[k].z - X[i].powi(2));
        assert_eq!(
            maximum(&at_border, &depths, &X).expect("numbers").error,
            0.0
        );
    }

    #[test]
    fn what_lives_on_interfaces_is_looked_for_there_alone() {
        let at = |z: f64, layer: usize| Depth { z, layer };
        let depths = [at(0.0, 0), at(1.0, 0), at(1.0, 1), at(2.0, 1)];
        let tops: Vec<_> = [9.0, 2.0, 3.0, 8.0]
            .map(|value| {
                Some(Top {
                    value,
                    place: [0.0],
                    sample: [0],
                })
            })
            .to_vec();
        let m = maximum_on_interfaces(&tops, &depths).expect("an interface");
        assert!(m.value == 3.0 && m.depth == at(1.0, 1), "{m:?}");
        assert!(maximum_on_interfaces(&tops[..2], &depths[..2]).is_none());
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
        let m = maximum_of_tops(&tops, &Z.map(|z| Depth { z, layer: 0 })).expect("numbers");
        assert!((m.value - 7.0).abs() < 1e-12, "{m:?}");
        for (ours, exact) in [(m.place[0], 0.2), (m.place[1], 0.13), (m.depth.z, 1.6)] {
            assert!((ours - exact).abs() < 1e-12, "{m:?}");
        }
    }

    #[test]
    fn the_error_falls_with_the_fourth_power() {
        let error = |n: i32| {
            let x: Vec<f64> = (0..=n).map(|i| f64::from(i) / f64::from(n)).collect();
            let field = Array2::from_shape_fn((x.len(), x.len()), |(k, i)| {
                (3.0 * (x[i] - 0.41) + x[k]).cos() * (2.0 * (x[k] - 0.63)).cos()
            });
            let depths: Vec<_> = x.iter().map(|&z| Depth { z, layer: 0 }).collect();
            // At z = 0.63 both factors are 1.
            let m = maximum(&field, &depths, &x).expect("numbers");
            let z = m.depth.z - 0.63;
            assert!(z.abs() < 1.0 / f64::from(n * n), "{m:?}");
            (m.value - 1.0).abs()
        };
        let (coarse, fine) = (error(20), error(80));
        assert!(fine < coarse / 100.0, "{coarse} {fine}");
    }

    #[test]
    fn a_kink_at_an_interface_stays_there() {
        let depths = [(0.0, 0), (1.0, 0), (1.0, 1), (2.0, 1)].map(|(z, layer)| Depth { z, layer });
        let field = Array2::from_shape_fn((4, 3), |(k, i)| {
            [1.0, 4.0, 3.0, 1.0][k] - (i as f64 - 1.0).powi(2)
        });
        let m = maximum(&field, &depths, &[-1.0, 0.0, 1.0]).expect("numbers");
        assert_eq!((m.value, m.depth, m.sample), (4.0, depths[1], 1));
    }

    #[test]
    fn another_hill_is_no_neighbour() {
        let depths = [0.0, 1.0, 2.0].map(|z| Depth { z, layer: 0 });
        let mut field = Array2::zeros((3, 9));
        (field[(0, 1)], field[(1, 7)], field[(2, 7)]) = (3.9, 4.0, 1.0);
        let along: Vec<f64> = (0..9).map(f64::from).collect();
        let m = maximum(&field, &depths, &along).expect("numbers");
        assert_eq!((m.value, m.depth.z, m.place), (4.0, 1.0, [7.0]));
        assert!(maximum(&(field * f64::NAN), &depths, &along).is_none());
    }
}
