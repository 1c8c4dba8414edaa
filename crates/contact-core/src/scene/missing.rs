//! Points of a measured surface that have no number.

use ndarray::{Array2, Axis, Slice};

/// Treatment of points without a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Missing {
    /// An error gives their number and the first place (default).
    #[default]
    Refuse,
    /// Lines at the edges are left out until every point has a number; the middle moves with them.
    Crop,
    /// Each has the mean of its neighbours, beginning at the border of each hole. Many or large
    /// holes are refused, since nothing is known of the surface in them.
    Fill,
}

impl Missing {
    /// Parses a word: "refuse", "crop" or "fill".
    pub fn from_word(word: &str) -> Option<Self> {
        match word {
            "refuse" => Some(Self::Refuse),
            "crop" => Some(Self::Crop),
            "fill" => Some(Self::Fill),
            _ => None,
        }
    }
}

/// Largest part of the points that may be filled.
const MOST_FILLED: f64 = 0.1;
/// Part of the points that a crop leaves at least.
const LEAST_LEFT: f64 = 0.5;
/// Largest depth of a filled point within its hole, in points.
const DEEPEST: usize = 5;

/// Refuses, crops or fills the holes; returns the numbers and how many of them are filled.
pub(super) fn treat_holes(
    values: Array2<f64>,
    missing: Missing,
) -> Result<(Array2<f64>, usize), String> {
    let holes = values.fold(0, |count, v| count + usize::from(v.is_nan()));
    let total = values.len();
    if holes == total {
        return Err("holds no number".into());
    }
    if holes == 0 {
        return Ok((values, 0));
    }
    let share = 100.0 * holes as f64 / total as f64;
    match missing {
        Missing::Refuse => Err(describe_holes(&values, holes)),
        Missing::Crop => check_crop(&values, crop_edges(&values)).map(|values| (values, 0)),
        Missing::Fill if holes as f64 > MOST_FILLED * total as f64 => Err(format!(
            "{holes} of {total} points ({share:.1} %) have no number, too many to fill: a tenth of them at most"
        )),
        Missing::Fill => fill_from_neighbours(values).map(|values| (values, holes)).ok_or_else(|| {
            format!(
                "{holes} of {total} points ({share:.1} %) have no number, and a hole among them is too large to fill. \
                 Every point of it must lie within {DEEPEST} points of measured ones"
            )
        }),
    }
}

/// A sentence on how many points have no number and where the first one is, with the two remedies.
fn describe_holes(values: &Array2<f64>, holes: usize) -> String {
    let (nx, ny) = values.dim();
    let missing = values.indexed_iter().filter(|(_, v)| v.is_nan());
    let (mut first, mut depth) = (None, 0);
    for ((i, j), _) in missing {
        first.get_or_insert((i, j));
        depth = depth.max(1 + i.min(j).min(nx - 1 - i).min(ny - 1 - j));
    }
    let (i, j) = first.unwrap_or_default();
    format!(
        "{holes} of {} points have no number, the first in row {} and column {}, all within {depth} of \
         the edges. missing = \"crop\" takes lines off the edges, \"fill\" takes the mean of the \
         neighbours",
        values.len(),
        i + 1,
        j + 1
    )
}

/// Refuses a crop that leaves less than [`LEAST_LEFT`] of the points.
fn check_crop(values: &Array2<f64>, crop: Array2<f64>) -> Result<Array2<f64>, String> {
    if crop.len() as f64 >= LEAST_LEFT * values.len() as f64 {
        return Ok(crop);
    }
    let ((nx, ny), (left_x, left_y)) = (values.dim(), crop.dim());
    Err(format!(
        "missing = \"crop\" would leave {left_x} x {left_y} of {nx} x {ny} points, less than half. \
         missing = \"fill\" takes the mean of the neighbours"
    ))
}

/// Takes the line at the edge with the largest part of holes off, until there is none.
fn crop_edges(values: &Array2<f64>) -> Array2<f64> {
    let mut kept = values.view();
    while kept.iter().any(|v| v.is_nan()) {
        let (nx, ny) = kept.dim();
        let share_of_holes = |line: ndarray::ArrayView1<'_, f64>| {
            line.iter().filter(|v| v.is_nan()).count() as f64 / line.len() as f64
        };
        let shares = [
            share_of_holes(kept.row(0)),
            share_of_holes(kept.row(nx - 1)),
            share_of_holes(kept.column(0)),
            share_of_holes(kept.column(ny - 1)),
        ];
        let worst = (0..4)
            .max_by(|&a, &b| shares[a].total_cmp(&shares[b]))
            .unwrap_or(0);
        let worst = if shares[worst] > 0.0 {
            worst
        } else {
            edge_nearest_to_a_hole(&kept)
        };
        let (axis, slice) = match worst {
            0 => (Axis(0), Slice::from(1..)),
            1 => (Axis(0), Slice::from(..nx - 1)),
            2 => (Axis(1), Slice::from(1..)),
            _ => (Axis(1), Slice::from(..ny - 1)),
        };
        kept.slice_axis_inplace(axis, slice);
    }
    kept.to_owned()
}

/// Edge nearest to the first hole, in the order of [`crop_edges`].
fn edge_nearest_to_a_hole(values: &ndarray::ArrayView2<'_, f64>) -> usize {
    let (nx, ny) = values.dim();
    let hole = values.indexed_iter().find(|(_, v)| v.is_nan());
    let (i, j) = hole.map_or((0, 0), |(at, _)| at);
    let distances = [i, nx - 1 - i, j, ny - 1 - j];
    (0..4).min_by_key(|&edge| distances[edge]).unwrap_or(0)
}

/// Fills from the borders of the holes inwards; `None` where they are too large.
fn fill_from_neighbours(mut values: Array2<f64>) -> Option<Array2<f64>> {
    let (nx, ny) = values.dim();
    let mut holes: Vec<(usize, usize)> = values
        .indexed_iter()
        .filter(|(_, v)| v.is_nan())
        .map(|(at, _)| at)
        .collect();
    for _ in 0..DEEPEST {
        let mean = |&(i, j): &(usize, usize)| {
            let rows = i.saturating_sub(1)..(i + 2).min(nx);
            let cells_of_row = |row: usize| {
                let columns = j.saturating_sub(1)..(j + 2).min(ny);
                columns.map(move |column| (row, column))
            };
            let neighbours = rows.flat_map(cells_of_row).map(|at| values[at]);
            let neighbours = neighbours.filter(|v| !v.is_nan());
            let (sum, n) = neighbours.fold((0.0, 0), |(sum, n), v| (sum + v, n + 1));
            (n > 0).then(|| sum / f64::from(n))
        };
        let means: Vec<_> = holes.iter().map(|at| (*at, mean(at))).collect();
        holes.clear();
        for (at, value) in means {
            match value {
                Some(value) => values[at] = value,
                None => holes.push(at),
            }
        }
    }
    holes.is_empty().then_some(values)
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::{Missing, treat_holes};

    /// A plane with holes at two edges.
    fn plane_with_holes() -> Array2<f64> {
        let mut z = Array2::from_shape_fn((6, 5), |(i, j)| i as f64 + 2.0 * j as f64);
        for at in [(0, 0), (0, 1), (0, 3), (4, 4)] {
            z[at] = f64::NAN;
        }
        z
    }

    #[test]
    fn holes_are_named() {
        let error = treat_holes(plane_with_holes(), Missing::Refuse).expect_err("holes");
        assert!(
            error.starts_with("4 of 30 points have no number, the first in row 1"),
            "{error}"
        );
    }

    #[test]
    fn edges_with_holes_are_cut_off() {
        let (z, filled) = treat_holes(plane_with_holes(), Missing::Crop).expect("numbers");
        assert!(
            z.dim() == (5, 4) && z[(0, 0)] == 1.0 && z[(4, 3)] == 11.0 && filled == 0,
            "{z}"
        );
    }

    #[test]
    fn a_crop_to_a_line_is_refused() {
        let mut plane = Array2::ones((40, 40));
        for n in 0..40 {
            plane[(n, (7 * n) % 40)] = f64::NAN;
        }
        let error = treat_holes(plane, Missing::Crop).expect_err("few points are left");
        assert!(
            error.contains("of 40 x 40 points, less than half"),
            "{error}"
        );
        assert!(error.contains("\"fill\""), "{error}");
    }

    #[test]
    fn few_small_holes_are_filled_from_their_neighbours() {
        let mut plane = Array2::from_shape_fn((30, 20), |(i, j)| i as f64 + 2.0 * j as f64);
        for at in [(0, 3), (4, 4), (4, 5), (29, 19)] {
            plane[at] = f64::NAN;
        }
        let (z, filled) = treat_holes(plane.clone(), Missing::Fill).expect("numbers");
        assert!(filled == 4 && z.iter().all(|v| v.is_finite()));
        // The mean of the neighbours of a plane that lie on one side is off by a point at most.
        assert!((z[(0, 3)] - 6.0).abs() <= 2.0 && (z[(4, 4)] - 12.0).abs() <= 2.0);
        for at in (10..21).flat_map(|i| (0..20).map(move |j| (i, j))) {
            plane[at] = f64::NAN;
        }
        let many = treat_holes(plane.clone(), Missing::Fill).expect_err("many");
        assert!(many.contains("too many to fill"), "{many}");
        let mut large = Array2::ones((60, 60));
        for at in (20..31).flat_map(|i| (20..31).map(move |j| (i, j))) {
            large[at] = f64::NAN;
        }
        let large = treat_holes(large, Missing::Fill).expect_err("a large hole");
        assert!(
            large.contains("121 of 3600 points (3.4 %)") && large.contains("too large"),
            "{large}"
        );
    }
}
