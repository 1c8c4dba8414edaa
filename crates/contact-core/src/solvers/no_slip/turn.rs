//! Slip whose direction turns within the increment: a mean direction makes the path of second order.
//!
//! ```text
//! ds = -lambda m,   m = (e_1 + a e_0 + b e_-1)/|e_1 + a e_0 + b e_-1|
//! ```
//!
//! with e_1 and e_0 the directions of the shear at the end of the increment and where the slip begins, and e_-1
//! that an increment earlier. The part of that slip across e_1, t = |ds| ((m.e_1) e_1 - m), is a term of u_0, so
//! that the solver, which holds the slip against the final shear, finds it there; it follows the solution until
//! both agree. With w e = a e_0 + b e_-1, |e| = 1, m turns by 1/(1 + w) of a small turn of e_1, which the Newton
//! steps reckon with.
//!
//! **A cell that slips all the time.** A direction that turns evenly has its mean in the middle of the increment,
//!
//! ```text
//! (1 + a + b)/2 = 1 - b/r,
//! ```
//!
//! r being the increment over the last one. With b = 0 that is the trapezoidal rule, a = 1, which does not damp
//! an error of e_0: it comes back in e_1 with the other sign. Errors of e_1 follow z^2 + a z + b = 0 from one
//! increment to the next; they fall the fastest where both roots are -a/2, b = a^2/4:
//!
//! ```text
//! a = 2/(1 + (2 + 2/r)^(1/2));   a = 2/3, b = 1/9, z = -1/3 for r = 1.
//! ```
//!
//! **A cell that starts to slip.** Its slip grows with the 3/2 power of the time since then (Cattaneo's slip front
//! moves evenly), so that the mean of a direction that turns evenly has the weights a = 2/3, b = 0; e_0 is
//! where its shear, extrapolated from the last increment, meets the bound. In the increment after that the mean
//! of the square root of the time has a = 0.8. Of a cell that entered the contact in the last increment e_0 is
//! mostly the error of its entry motion: it has no turn.

use crate::cells::size;
use crate::solvers::Interface;

/// Weight a of the direction at the beginning of a cell that starts to slip.
const STARTS: f64 = 2.0 / 3.0;
/// The same of one that started in the last increment.
const STARTED: f64 = 0.8;
/// Part of its bound, less than all of it, that the shear an increment earlier had in a cell that started to slip in
/// the last increment; what the cell is taken for is faded, so that rounding decides nothing.
const SLIPPED: f64 = 0.9;
/// Cosines of the angle between two directions over which the turn is faded in: beyond 60 degrees the path of
/// the direction in between is not known.
const FADE: [f64; 2] = [0.5, 0.7];
/// Part by which the onset of slip is farther from the end than the start of the increment was from which on its turn
/// does not count; it is faded out, so that rounding decides nothing.
const FARTHER: f64 = 0.1;

/// The tractions an increment earlier.
#[derive(Clone, Copy)]
pub struct Earlier<'a> {
    p: &'a [f64],
    q: &'a [Vec<f64>; 2],
    /// The increment over the last one.
    ratio: f64,
    /// The weights a and b of a cell that slips all the time.
    weights: [f64; 2],
}

impl<'a> Earlier<'a> {
    /// Of pressure and shear \[Pa\], and of the increment over the last one.
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

/// The part t of a `slip` \[m\] of cell n across its final shear \[m\], as far as the way there is known,
///
/// ```text
/// |ds| fade(cos c) w sin(c)/|w e + e_1|,   c the angle from e to e_1,
/// ```
///
/// and its derivative by c over |ds|.
pub(super) fn turn(
    last: &Interface,
    earlier: &Earlier<'_>,
    now: &Interface,
    slip: f64,
    n: usize,
) -> Option<([f64; 2], f64)> {
    let at = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let (e_1, bound) = direction(at(&now.q));
    if bound == 0.0 {
        return None;
    }
    let (e, w, known) = match last.slip[n] {
        true if earlier.p[n] <= 0.0 => return None,
        true => goes_on(last, earlier, e_1, n),
        false => starts(at(earlier.q), at(&last.q), e_1, bound)?,
    };
    let cos = dot(e, e_1).clamp(-1.0, 1.0);
    let sin = e[0] * e_1[1] - e[1] * e_1[0];
    let part = (cos - FADE[0]) / (FADE[1] - FADE[0]);
    let fade = known * part.clamp(0.0, 1.0);
    let square = w * w + 2.0 * w * cos + 1.0;
    let length = square.sqrt();
    let across = fade * slip * w * sin / length;
    let of_fade = if (0.0..=1.0).contains(&part) {
        known * w * (1.0 - cos * cos) / (length * (FADE[1] - FADE[0]))
    } else {
        0.0
    };
    let follows = fade * (1.0 + w * cos) * w * (w + cos) / (square * length) - of_fade;
    Some(([-across * e_1[1], across * e_1[0]], follows))
}

/// The direction e of a cell that starts to slip, where its shear, extrapolated from `before` through `last`, meets
/// the bound \[Pa\], its weight, and how far that is known: slip begins with a shear that is no farther from the one
/// at the end than the one at the start was.
fn starts(
    before: [f64; 2],
    last: [f64; 2],
    e_1: [f64; 2],
    bound: f64,
) -> Option<([f64; 2], f64, f64)> {
    let begin = meets(before, last, bound)?;
    let far = |q: [f64; 2]| size([q[0] - bound * e_1[0], q[1] - bound * e_1[1]]);
    let start = far(last).max(f64::MIN_POSITIVE);
    let known = (1.0 + (1.0 - far(begin) / start) / FARTHER).clamp(0.0, 1.0);
    Some((direction(begin).0, STARTS, known))
}

/// The direction e of a cell that has slipped before, its weight w, and how far it is known. A turn of the last increment
/// counts as far as it is no larger than that of this one and, where it went the other way, b times it no larger than
/// a times this one, so that the mean lies between e_0 and e_1.
fn goes_on(
    last: &Interface,
    earlier: &Earlier<'_>,
    e_1: [f64; 2],
    n: usize,
) -> ([f64; 2], f64, f64) {
    let at = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let ((e_0, bound), (e_before, before)) = (direction(at(&last.q)), direction(at(earlier.q)));
    // The shear over the pressure is as large in all cells that slip.
    let of_bound = before * last.p[n] / (bound * earlier.p[n]).max(f64::MIN_POSITIVE);
    let slipped = (of_bound - SLIPPED) / (1.0 - SLIPPED);
    let turned = (dot(e_0, e_before) - FADE[0]) / (FADE[1] - FADE[0]);
    let between = |a: [f64; 2], b: [f64; 2]| {
        let apart = [a[0] - b[0], a[1] - b[1]];
        dot(apart, apart)
    };
    let [a, b] = earlier.weights;
    let turn_before = earlier.ratio.max(b / a).powi(2) * between(e_before, e_0);
    let alike = (between(e_0, e_1) / turn_before.max(f64::MIN_POSITIVE)).min(1.0);
    let part = slipped.clamp(0.0, 1.0) * turned.clamp(0.0, 1.0) * alike.sqrt();
    let (a, b) = (STARTED + part * (a - STARTED), part * b);
    let (e, w) = direction([0, 1].map(|c| a * e_0[c] + b * e_before[c]));
    (e, w, 1.0)
}

/// Where a shear extrapolated from `before` through `last` meets the circle of radius `bound` \[Pa\].
fn meets(before: [f64; 2], last: [f64; 2], bound: f64) -> Option<[f64; 2]> {
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

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The direction and the size of a vector.
fn direction(a: [f64; 2]) -> ([f64; 2], f64) {
    let size = size(a);
    let over = 1.0 / size.max(f64::MIN_POSITIVE);
    ([a[0] * over, a[1] * over], size)
}
