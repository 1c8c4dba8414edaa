//! Turns of a record: the points where it goes back by more than a part of its range.

/// Points of a block, which is passed over by its least and largest value if it has no turn.
const BLOCK: usize = 64;
/// Values that are compared beside each other.
const LANES: usize = 8;

/// Finds the turns of a record, as indices of its points.
///
/// A turn is a point beyond which the record goes back by more than `part` of its range, the last
/// one of equal points. The first point of the record counts if it is farther from the middle of the
/// range than `outer` of its half, and so does the last turn, which nothing follows. NaN is not allowed.
///
/// ```
/// let record = [0.0, 1.0, 0.9, 2.0, 0.0, 2.0];
/// assert_eq!(fatigue::find_turns(&record, 0.3, 0.8), [0, 3, 4, 5]);
/// ```
pub fn find_turns(record: &[f64], part: f64, outer: f64) -> Vec<usize> {
    let blocks: Vec<(f64, f64)> = record.chunks(BLOCK).map(bounds).collect();
    let low = blocks.iter().fold(f64::INFINITY, |low, b| low.min(b.0));
    let high = (blocks.iter()).fold(f64::NEG_INFINITY, |high, b| high.max(b.1));
    let range = high - low;
    let least = part * range;
    let mut turns = Vec::new();
    if least.is_nan() || least <= 0.0 {
        return turns;
    }
    let is_outer = |point: usize| (record[point] - 0.5 * (high + low)).abs() > 0.5 * outer * range;
    // The sign of the direction; 0 until the record has gone by `least`.
    let (mut extreme, mut direction) = (0, 0.0);
    for (n, (block, (low, high))) in record.chunks(BLOCK).zip(&blocks).enumerate() {
        if direction != 0.0 {
            // The block along the direction: its farthest and its nearest value.
            let (far, near) = if direction > 0.0 {
                (*high, *low)
            } else {
                (-low, -high)
            };
            let reached = direction * record[extreme];
            if far.max(reached) - near <= least {
                if far >= reached {
                    let last = block.iter().rposition(|v| direction * v == far);
                    extreme = last.map_or(extreme, |last| n * BLOCK + last);
                }
                continue;
            }
        }
        for (point, value) in (n * BLOCK..).zip(block) {
            let ahead = value - record[extreme];
            if direction == 0.0 {
                if ahead.abs() > least {
                    if is_outer(extreme) {
                        turns.push(extreme);
                    }
                    (direction, extreme) = (ahead.signum(), point);
                }
            } else if direction * ahead >= 0.0 {
                extreme = point;
            } else if -direction * ahead > least {
                turns.push(extreme);
                (direction, extreme) = (-direction, point);
            }
        }
    }
    if is_outer(extreme) {
        turns.push(extreme);
    }
    turns
}

/// Returns the least and the largest value of a block.
fn bounds(block: &[f64]) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let (groups, last) = block.as_chunks::<LANES>();
    for group in groups {
        for (n, value) in group.iter().enumerate() {
            low[n] = if *value < low[n] { *value } else { low[n] };
            high[n] = if *value > high[n] { *value } else { high[n] };
        }
    }
    for value in last {
        low[0] = low[0].min(*value);
        high[0] = high[0].max(*value);
    }
    (
        low.into_iter().fold(f64::INFINITY, f64::min),
        high.into_iter().fold(f64::NEG_INFINITY, f64::max),
    )
}
