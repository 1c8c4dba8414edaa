//! The ascent to the largest value of a number, from a starting point.
//!
//! The number is evaluated on both sides along every free direction and at the vertex of the
//! parabola through these values, with smaller and smaller steps. Where it rises towards a side,
//! the ascent goes there with steps twice as long: the samples end with the grid, and a tension
//! around a contact may be largest beyond it.

use contact_core::Error;

use super::{Depth, Point};

/// Most rounds with smaller steps, and the ratio of the steps of successive rounds.
const MOST_ROUNDS: usize = 5;
const CLOSER: f64 = 1.0 / 3.0;
/// Most rounds towards a side, and the ratio of the steps of successive rounds.
const OUTWARDS: usize = 16;
const FARTHER: f64 = 2.0;
/// Relative gain of a round that ends the ascent.
const LEAST_GAIN: f64 = 1e-4;

/// A starting point of an ascent.
pub(super) struct Start {
    pub(super) place: [f64; 3],
    pub(super) layer: usize,
    /// First steps along x, y, z; 0 along directions that are not searched.
    pub(super) steps: [f64; 3],
    /// The value at the start, if it is a sample.
    pub(super) known: Option<f64>,
}

/// Values at points.
pub(super) type Values<'a> = dyn Fn(&[Point]) -> Result<Vec<f64>, Error> + 'a;

/// Point at a place in a layer.
pub(super) fn point_in_layer([x, y, z]: [f64; 3], layer: usize) -> Point {
    (x, y, Depth { z, layer })
}

/// Ascends from a start, where the value is `value`, to a maximum between two depths of its layer. Returns the
/// place (along, across, depth), the value, and the error that remains along each direction.
pub(super) fn climb(
    values: &Values<'_>,
    start: &Start,
    value: f64,
    (highest, deepest): (f64, f64),
) -> Result<([f64; 3], f64, [f64; 3]), Error> {
    let (mut place, mut best, mut steps) = (start.place, value, start.steps);
    let mut remaining = [0.0; 3];
    let (mut closer, mut farther) = (0, 0);
    while closer < MOST_ROUNDS && farther < OUTWARDS {
        let neighbours_along = |axis: usize, sign: f64| {
            let mut at = place;
            at[axis] += sign * steps[axis];
            at[2] = at[2].clamp(highest, deepest);
            at
        };
        let sides =
            (0..3).flat_map(|axis| [-1.0, 1.0].map(|sign| (axis, neighbours_along(axis, sign))));
        let sides: Vec<_> = sides
            .filter(|(axis, at)| at[*axis] != place[*axis])
            .collect();
        let points: Vec<Point> = sides
            .iter()
            .map(|(_, at)| point_in_layer(*at, start.layer))
            .collect();
        let new_values = values(&points)?;
        let mut top = place;
        for axis in 0..3 {
            let of_axis = sides
                .iter()
                .zip(&new_values)
                .filter(|((a, _), _)| *a == axis);
            let of_axis: Vec<_> = of_axis
                .map(|((_, at), v)| (at[axis] - place[axis], *v))
                .collect();
            let (step, gain) = vertex(best, &of_axis);
            top[axis] += step;
            remaining[axis] = gain;
        }
        let mut tried: Vec<_> = sides.iter().map(|(_, at)| *at).zip(new_values).collect();
        if top != place {
            let new_values = values(&[point_in_layer(top, start.layer)])?;
            tried.push((top, new_values[0]));
        }
        let before = best;
        let mut outwards = None;
        for (n, (at, value)) in tried.into_iter().enumerate() {
            if value > best {
                (place, best) = (at, value);
                outwards = sides.get(n).map(|(axis, _)| *axis);
            }
        }
        if let Some(axis) = outwards {
            farther += 1;
            steps[axis] *= FARTHER;
        } else {
            if best - before <= LEAST_GAIN * best.abs() {
                break;
            }
            closer += 1;
            steps = steps.map(|s| CLOSER * s);
        }
    }
    Ok((place, best, remaining))
}

/// Finds the vertex of the parabola through a `value` and its neighbours at one or two `sides` (distance,
/// value), no farther away than these. Returns its distance, and how far the parabola falls at a third of the
/// way to the sides.
fn vertex(value: f64, sides: &[(f64, f64)]) -> (f64, f64) {
    let &[(low, v_low), (high, v_high)] = sides else {
        // At the border of a layer: the value itself is the top, unless the field rises away from
        // it.
        let rises = sides.iter().filter(|(_, v)| *v > value);
        return rises
            .map(|(s, v)| (*s, v - value))
            .next()
            .unwrap_or((0.0, 0.0));
    };
    let (left, right) = ((v_low - value) / low, (v_high - value) / high);
    let half = (right - left) / (high - low);
    let slope = left - half * low;
    if half >= 0.0 || half.is_nan() {
        return (0.0, (v_low.max(v_high) - value).max(0.0));
    }
    let third = CLOSER * high.max(-low);
    (
        (-slope / (2.0 * half)).clamp(low, high),
        -half * third * third,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn climbed(f: impl Fn(f64, f64) -> f64, x: f64, z: f64) -> ([f64; 3], f64, [f64; 3]) {
        let values = |points: &[Point]| Ok(points.iter().map(|p| f(p.0, p.2.z)).collect());
        let start = Start {
            place: [x, 0.0, z],
            layer: 0,
            steps: [0.5, 0.0, 0.3],
            known: None,
        };
        climb(&values, &start, f(x, z), (0.0, 3.0)).expect("a value")
    }

    #[test]
    fn climbs_to_the_top_of_a_smooth_hill() {
        let f = |x: f64, z: f64| (x - 0.13).cos() * (2.0 * (z - 1.1)).cos();
        let (place, value, left) = climbed(f, 0.5, 1.3);
        assert!(
            (value - 1.0).abs() < 1e-4 && (place[0] - 0.13).abs() < 0.02,
            "{place:?} {value}"
        );
        assert!(left[0] > 0.0 && left[1] == 0.0 && left[2] > 0.0, "{left:?}");
        assert!(1.0 - value <= left.iter().sum::<f64>(), "{left:?} {value}");
    }

    #[test]
    fn climbs_to_a_top_far_beyond_the_start() {
        let f = |x: f64, z: f64| 1.0 / (1.0 + (x - 40.0).powi(2) / 900.0) - 0.1 * (z - 1.3).powi(2);
        let (place, value, left) = climbed(f, 0.5, 1.3);
        let off = 1.0 - value;
        assert!(
            off < 1e-3 && off <= left.iter().sum::<f64>(),
            "{place:?} {value} {left:?}"
        );
    }

    #[test]
    fn climbs_to_a_cusp_at_the_surface() {
        let f = |x: f64, z: f64| 2.0 - (x - 0.2_f64).abs().sqrt() - z;
        let (place, value, left) = climbed(f, 0.2, 0.0);
        assert!(
            place == [0.2, 0.0, 0.0] && value == 2.0 && left[2] == 0.0,
            "{place:?}"
        );
    }
}
