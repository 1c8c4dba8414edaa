//! Slip whose direction turns within the increment: a mean direction makes the path of second
//! order.
//!
//! ```text
//! ds = -lambda m,   m = (e_1 + a e_0 + b e_-1)/|e_1 + a e_0 + b e_-1|
//! ```
//!
//! with e_1 and e_0 the directions of the shear at the end of the increment and at the beginning of the
//! slip, and e_-1 the direction an increment earlier. The solver makes the slip opposite to e_1; the
//! component of the true slip across e_1, t = |ds| ((m.e_1) e_1 - m), is therefore a term of u_0.
//! It is updated with the solution until both agree. With w e = a e_0 + b e_-1, |e| = 1, a small
//! rotation of e_1 rotates m by 1/(1 + w) of it; the Newton steps contain that derivative.
//!
//! **A cell that slips all the time.** A direction that turns evenly has its mean in the middle of
//! the increment,
//!
//! ```text
//! (1 + a + b)/2 = 1 - b/r,
//! ```
//!
//! r being the increment over the last one. With b = 0 this is the trapezoidal rule, a = 1, which
//! does not damp an error of e_0: the error returns in e_1 with the other sign. Errors of e_1
//! follow z^2 + a z + b = 0 from one increment to the next; they fall the fastest where both roots
//! are -a/2, b = a^2/4:
//!
//! ```text
//! a = 2/(1 + (2 + 2/r)^(1/2));   a = 2/3, b = 1/9, z = -1/3 for r = 1.
//! ```
//!
//! **A cell that starts to slip.** Its slip grows with the power 3/2 of the time since the onset
//! (Cattaneo's slip front moves evenly), so that the mean of an evenly turning direction has the
//! weights a = 2/3, b = 0; e_0 is the direction at which the shear, extrapolated from the last
//! increment, meets the bound. In the increment after that, averaging with the square root of the
//! time gives a = 0.8. A cell that entered the contact in the last increment has t = 0: its e_0 is
//! dominated by the error of its entry motion.

use crate::cells::length;
use crate::solvers::Interface;

/// Weight a of the direction at the beginning of a cell that starts to slip.
const WEIGHT_AT_ONSET: f64 = 2.0 / 3.0;
/// Weight a of a cell that started to slip in the last increment.
const WEIGHT_AFTER_ONSET: f64 = 0.8;
/// The weights of a cell that slips depend on r = (|q_-1|/p_-1)/(|q_0|/p_0). For r = 1 they are the weights of a
/// cell that slips all the time, for r <= SLIPPED those after the onset of slip; they are
/// linear in r between the two, so that rounding cannot make them jump.
const SLIPPED: f64 = 0.9;
/// The turn counts fully where the cosine of the angle between two directions is above FADE\[1\],
/// not at all below FADE\[0\], and linearly between: beyond 60 degrees the path of the direction is
/// unknown.
const FADE: [f64; 2] = [0.5, 0.7];
/// Test that the extrapolated onset of slip lies within the increment: with d_0 = |q_0 - g e_1| at
/// the start and d = |q - g e_1| at the onset, the turn counts fully for d <= d_0, not at all for
/// d >= (1 + ONSET_TOLERANCE) d_0, and linearly between.
const ONSET_TOLERANCE: f64 = 0.1;

/// The tractions an increment earlier.
#[derive(Clone, Copy)]
pub struct EarlierTractions<'a> {
    p: &'a [f64],
    q: &'a [Vec<f64>; 2],
    /// The increment over the last one.
    ratio: f64,
    /// The weights a and b of a cell that slips all the time.
    weights: [f64; 2],
}

impl<'a> EarlierTractions<'a> {
    /// Keeps pressure and shear \[Pa\] of the earlier increment, and the ratio of the increment to the last one.
    pub fn new(p: &'a [f64], q: &'a [Vec<f64>; 2], ratio: f64) -> Self {
        let a = 2.0 / (1.0 + (2.0 + 2.0 / ratio).sqrt());
        Self {
            p,
            q,
            ratio,
            weights: [a, 0.25 * a * a],
        }
    }
}

/// The turn term of cell n \[m\] for the slip |ds| = `slip` \[m\],
///
/// ```text
/// t = |ds| fade(cos c) w sin(c)/|w e + e_1|,   c the angle from e to e_1,
/// ```
///
/// and t', its derivative by c over |ds|. None for a cell without friction or without earlier contact.
pub(super) fn turn_of_cell(
    last: &Interface,
    earlier: &EarlierTractions<'_>,
    now: &Interface,
    slip: f64,
    n: usize,
) -> Option<([f64; 2], f64)> {
    let at_cell = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let (e_1, bound) = direction_and_size(at_cell(&now.q));
    if bound == 0.0 {
        return None;
    }
    let (e, w, known) = match last.slips[n] {
        true if earlier.p[n] <= 0.0 => return None,
        true => slipping_direction(last, earlier, e_1, n),
        false => onset_direction(at_cell(earlier.q), at_cell(&last.q), e_1, bound)?,
    };
    let cos = dot(e, e_1).clamp(-1.0, 1.0);
    let sin = e[0] * e_1[1] - e[1] * e_1[0];
    let part = (cos - FADE[0]) / (FADE[1] - FADE[0]);
    let fade = known * part.clamp(0.0, 1.0);
    let square = w * w + 2.0 * w * cos + 1.0;
    let length = square.sqrt();
    let across = fade * slip * w * sin / length;
    let fade_derivative = if (0.0..=1.0).contains(&part) {
        known * w * (1.0 - cos * cos) / (length * (FADE[1] - FADE[0]))
    } else {
        0.0
    };
    let follows = fade * (1.0 + w * cos) * w * (w + cos) / (square * length) - fade_derivative;
    Some(([-across * e_1[1], across * e_1[0]], follows))
}

/// Direction of the shear of a cell that starts to slip in the increment. Returns the direction e at which its
/// shear, extrapolated from `before` through `last`, meets the bound \[Pa\], the weight w of e, and a factor 0
/// to 1 by which the turn counts ([`ONSET_TOLERANCE`]). `e_1` is the direction at the end of the increment.
fn onset_direction(
    before: [f64; 2],
    last: [f64; 2],
    e_1: [f64; 2],
    bound: f64,
) -> Option<([f64; 2], f64, f64)> {
    let begin = intersection_with_bound(before, last, bound)?;
    let distance_to_end = |q: [f64; 2]| length([q[0] - bound * e_1[0], q[1] - bound * e_1[1]]);
    let distance_at_start = distance_to_end(last).max(f64::MIN_POSITIVE);
    let known = (1.0 + (1.0 - distance_to_end(begin) / distance_at_start) / ONSET_TOLERANCE)
        .clamp(0.0, 1.0);
    Some((direction_and_size(begin).0, WEIGHT_AT_ONSET, known))
}

/// Direction of the shear of a cell that has slipped before: the direction e, its weight w, and the factor 1.
/// Where the turns of the last increment and of this one (to `e_1`) have opposite signs, the weight b of the
/// earlier direction is reduced, so that e lies between e_0 and e_1.
fn slipping_direction(
    last: &Interface,
    earlier: &EarlierTractions<'_>,
    e_1: [f64; 2],
    n: usize,
) -> ([f64; 2], f64, f64) {
    let at_cell = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let ((e_0, bound), (e_before, before)) = (
        direction_and_size(at_cell(&last.q)),
        direction_and_size(at_cell(earlier.q)),
    );
    // |q|/p is the coefficient of friction in all cells that slip.
    let bound_fraction = before * last.p[n] / (bound * earlier.p[n]).max(f64::MIN_POSITIVE);
    let slipped = (bound_fraction - SLIPPED) / (1.0 - SLIPPED);
    let turned = (dot(e_0, e_before) - FADE[0]) / (FADE[1] - FADE[0]);
    let squared_distance = |a: [f64; 2], b: [f64; 2]| {
        let difference = [a[0] - b[0], a[1] - b[1]];
        dot(difference, difference)
    };
    let [a, b] = earlier.weights;
    let turn_before = earlier.ratio.max(b / a).powi(2) * squared_distance(e_before, e_0);
    let alike = (squared_distance(e_0, e_1) / turn_before.max(f64::MIN_POSITIVE)).min(1.0);
    let part = slipped.clamp(0.0, 1.0) * turned.clamp(0.0, 1.0) * alike.sqrt();
    let (a, b) = (
        WEIGHT_AFTER_ONSET + part * (a - WEIGHT_AFTER_ONSET),
        part * b,
    );
    let (e, w) = direction_and_size([0, 1].map(|c| a * e_0[c] + b * e_before[c]));
    (e, w, 1.0)
}

/// Point where a shear extrapolated from `before` through `last` reaches the circle of radius `bound`
/// \[Pa\].
fn intersection_with_bound(before: [f64; 2], last: [f64; 2], bound: f64) -> Option<[f64; 2]> {
    let step = [last[0] - before[0], last[1] - before[1]];
    let inside = bound * bound - dot(last, last);
    if inside <= 0.0 {
        return Some(last);
    }
    let (a, b) = (dot(step, step), dot(last, step));
    let t = ((b * b + a * inside).sqrt() - b) / a;
    t.is_finite()
        .then(|| [last[0] + t * step[0], last[1] + t * step[1]])
}

/// a . b
fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The direction and the size of a vector.
fn direction_and_size(a: [f64; 2]) -> ([f64; 2], f64) {
    let size = length(a);
    let inverse_size = 1.0 / size.max(f64::MIN_POSITIVE);
    ([a[0] * inverse_size, a[1] * inverse_size], size)
}
