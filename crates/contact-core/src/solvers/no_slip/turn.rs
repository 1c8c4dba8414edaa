//! Slip whose direction turns within the increment: a mean direction makes the path of second order.
//!
//! ```text
//! ds = -lambda m,   m = (w e_0 + e_1)/|w e_0 + e_1|
//! ```
//!
//! with e_0 and e_1 the directions of the shear where the slip begins and at the end of the increment.
//! The part of that slip across e_1, t = |ds| ((m.e_1) e_1 - m), is a term of u_0, so that the solver,
//! which holds the slip against the final shear, finds it there; it follows the solution until both agree.
//! When e_1 turns by a small angle m turns by 1/(1 + w) of it, which the Newton steps reckon with.
//!
//! The slip of a cell grows with the 3/2 power of the time since it began (Cattaneo's slip front moves
//! evenly), so that the mean of a direction that turns evenly has the weight w = 2/3 in a cell that starts
//! to slip: where its shear, extrapolated from the last increment, meets the bound. In a cell that slips all
//! the time the trapezoidal rule has w = 1. But it does not damp an error of e_0, which comes back in e_1 with
//! the other sign; with w = 0.8 the error falls by a fifth in every increment. Of a cell that entered the contact in the last increment e_0 is mostly the error of its entry
//! motion: it has no turn.

use crate::cells::size;
use crate::solvers::Interface;

/// Weight w of the direction at the beginning of a cell that starts to slip.
const STARTS: f64 = 2.0 / 3.0;
/// The same of a cell that slips all the time. Of 0.67, 0.8 and 1 on the paper's scene (E1/E2 = 2, 128 x 128):
/// q at the ends of branches off by 0.28, 0.30 and 0.37 % with chosen increments, 0.55, 0.68 and 0.97 % with
/// 55; on torsion 0.11 % with 0.8 and 0.19 % with 1. Below 0.8 the order with short increments is lost
/// (`tests/ladder/path_order.rs`).
const GOES_ON: f64 = 0.8;
/// Cosines of the angle between e_0 and e_1 over which the turn is faded in: beyond 60 degrees the path of
/// the direction in between is not known.
const FADE: [f64; 2] = [0.5, 0.7];

/// Part of the way to the end that the onset of slip is nearer than the start from which the turn counts in
/// full; it is faded in, so that rounding decides nothing.
const NEARER: f64 = 0.1;

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
    let at = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let end = at(&now.q);
    if size(end) == 0.0 {
        return None;
    }
    let (begin, w) = match last.slip[n] {
        true if earlier.p[n] <= 0.0 => return None,
        true => (at(&last.q), GOES_ON),
        false => (meets(at(earlier.q), at(&last.q), size(end))?, STARTS),
    };
    // Slip begins with a shear that is nearer to the one at the end than the one at the start was.
    let far = |q: [f64; 2]| size([q[0] - end[0], q[1] - end[1]]);
    let start = far(at(&last.q)).max(f64::MIN_POSITIVE);
    let nearer = if last.slip[n] {
        1.0
    } else {
        ((1.0 - far(begin) / start) / NEARER).clamp(0.0, 1.0)
    };
    let (e_0, e_1) = (unit(begin), unit(end));
    let cos = dot(e_0, e_1).clamp(-1.0, 1.0);
    let part = (cos - FADE[0]) / (FADE[1] - FADE[0]);
    let fade = nearer * part.clamp(0.0, 1.0);
    let mean = [0, 1].map(|c| w * e_0[c] + e_1[c]);
    let (length, m) = (size(mean), unit(mean));
    let along = dot(m, e_1);
    let across = [0, 1].map(|c| fade * size(slip) * (along * e_1[c] - m[c]));
    let of_fade = if (0.0..=1.0).contains(&part) {
        nearer * w * (1.0 - cos * cos) / (length * (FADE[1] - FADE[0]))
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
