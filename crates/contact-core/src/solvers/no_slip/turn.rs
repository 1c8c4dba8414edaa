//! Slip whose direction turns within the increment: a mean direction makes the path of second order.
//!
//! ```text
//! ds = -lambda m,   m = (w e_0 + e_1)/|w e_0 + e_1|,   w = 2/3
//! ```
//!
//! with e_0 and e_1 the directions of the shear where the slip begins and at the end of the increment.
//! The part of that slip across e_1, t = |ds| ((m.e_1) e_1 - m), is a term of u_0, so that the solver,
//! which holds the slip against the final shear, finds it there; it follows the solution until both agree.
//! When e_1 turns by a small angle m turns by 1/(1 + w) of it, which the Newton steps reckon with.
//!
//! The slip of a cell grows with the 3/2 power of the time since it began (Cattaneo's slip front moves
//! evenly), so that the mean of a direction that turns evenly has the weight w = 2/3. A cell that starts
//! to slip within the increment does so where its shear, extrapolated from the last increment, meets the
//! bound. Of a cell that entered the contact in the last increment e_0 is mostly the error of its entry
//! motion: it has no turn.

use crate::cells::size;
use crate::solvers::Interface;

/// Weight w of the direction at the beginning.
const WEIGHT: f64 = 2.0 / 3.0;
/// Cosines of the angle between e_0 and e_1 over which the turn is faded in: beyond 60 degrees the path of
/// the direction in between is not known.
const FADE: [f64; 2] = [0.5, 0.7];

/// The tractions an increment earlier.
#[derive(Clone, Copy)]
pub struct Earlier<'a> {
    /// Pressure \[Pa\].
    pub p: &'a [f64],
    /// Shear \[Pa\].
    pub q: &'a [Vec<f64>; 2],
}

/// The part t of the slip across the final shear in cell n \[m\], as far as the way there is known,
///
/// ```text
/// |ds| fade(cos a) w sin(a)/|w e_0 + e_1|,   a the angle from e_0 to e_1,
/// ```
///
/// and its derivative by a over |ds|.
pub(super) fn turn(
    last: &Interface,
    earlier: &Earlier<'_>,
    now: &Interface,
    slip: [f64; 2],
    n: usize,
) -> Option<([f64; 2], f64)> {
    let w = WEIGHT;
    let at = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let end = at(&now.q);
    let begin = match last.slip[n] {
        true if earlier.p[n] <= 0.0 => return None,
        true => at(&last.q),
        false => meets(at(earlier.q), at(&last.q), size(end))?,
    };
    let (e_0, e_1) = (unit(begin), unit(end));
    let cos = dot(e_0, e_1).clamp(-1.0, 1.0);
    let part = (cos - FADE[0]) / (FADE[1] - FADE[0]);
    let fade = part.clamp(0.0, 1.0);
    let mean = [0, 1].map(|c| w * e_0[c] + e_1[c]);
    let (length, m) = (size(mean), unit(mean));
    let along = dot(m, e_1);
    let across = [0, 1].map(|c| fade * size(slip) * (along * e_1[c] - m[c]));
    let of_fade = if (0.0..=1.0).contains(&part) {
        w * (1.0 - cos * cos) / (length * (FADE[1] - FADE[0]))
    } else {
        0.0
    };
    let follows = fade * along * w * (w + cos) / (length * length) - of_fade;
    Some((across, follows))
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

fn unit(a: [f64; 2]) -> [f64; 2] {
    let size = size(a).max(f64::MIN_POSITIVE);
    [a[0] / size, a[1] / size]
}
