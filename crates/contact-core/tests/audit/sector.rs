//! Where the shear of a cell points while the cell slips.
//!
//! A cell slips against a shear that turns from where slip begins to that at the end: what it moves
//! lies between the opposites of both. In a cell that slips all the time slip begins with the shear
//! at the start. In a cell that stuck then it begins on the way, with a shear at its bound that is
//! nearer to the one at the end than the one at the start was. Of a cell that enters the contact
//! the fields tell the end alone.

use std::f64::consts::FRAC_PI_2;

use contact_core::march::Fields;

use super::{dot, held, shear, size};

/// Directions of the shear while a cell slips.
pub(super) struct Sector {
    middle: [f64; 2],
    /// Angle to either side of it \[rad\].
    half: f64,
}

impl Sector {
    /// Of a cell in the contact at the end; none of one that enters and sticks.
    pub(super) fn of(start: &Fields, end: &Fields, n: (usize, usize)) -> Self {
        let (from, to) = (shear(start, n), shear(end, n));
        if start.p[n] <= 0.0 {
            let slips = if held(end, n) { [0.0; 2] } else { to };
            Self::about(slips, 0.0)
        } else if held(start, n) {
            Self::about(to, size([to[0] - from[0], to[1] - from[1]]))
        } else {
            Self::between(from, to)
        }
    }

    /// Between two shears.
    fn between(from: [f64; 2], to: [f64; 2]) -> Self {
        let unit = |q: [f64; 2]| q.map(|c| c / size(q).max(f64::MIN_POSITIVE));
        let (from, to) = (unit(from), unit(to));
        Self {
            middle: [from[0] + to[0], from[1] + to[1]],
            half: 0.5 * angle(from, to),
        }
    }

    /// Of the shears of the size of `to` that are no farther from it than `way`.
    fn about(to: [f64; 2], way: f64) -> Self {
        let sine = 0.5 * way / size(to).max(f64::MIN_POSITIVE);
        Self {
            middle: to,
            half: 2.0 * sine.min(1.0).asin(),
        }
    }

    /// How far the opposite of a motion is from the sector \[m\].
    pub(super) fn off(&self, moved: [f64; 2]) -> f64 {
        if size(self.middle) == 0.0 {
            return size(moved);
        }
        let beyond = angle(self.middle, moved.map(|v| -v)) - self.half;
        size(moved) * beyond.clamp(0.0, FRAC_PI_2).sin()
    }
}

/// Between 0 and pi.
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).abs().atan2(dot(a, b))
}
