//! Stiffness of a loop right after its reversals.
//!
//! The stiffness K is the stiffness of the contact without slip. An increment gives a secant S,
//! which is
//! lower: after a change of the force by f the ring of reverse slip has grown. With x = f/F
//!
//! ```text
//! S/K = g(x) = (2/3) x/(1 - (1 - x)^(2/3)),  F = 2 mu W       of a tangential force [1]
//! S/K = g(x) = x/((1 - y)(3 - y)),  y = (1 - x)^(1/2)         of a torsional couple [2]
//! ```
//!
//! K and F follow from least squares through the secants, so that the form holds for other
//! contacts and coatings as well. How far K moves without the largest changes of the force, its
//! standard error and the ring, which grows from cell to cell, make its error. Increments in gross
//! slip have no part in it: there the shift does not depend on the force. K grows like the radius of
//! the contact, in torsion like its third power: there the error of the cells counts three times.
//!
//! [1] R. D. Mindlin, H. Deresiewicz, J. Appl. Mech. 20 (1953) 327-344, of balls.
//! [2] H. Deresiewicz, J. Appl. Mech. 21 (1954) 52-56, of balls, an approximation of the solution of
//! J. L. Lubkin, J. Appl. Mech. 18 (1951) 183-187.

use contact_core::bisection::bisect;
use contact_core::march::Status;

use crate::loop_point::{Direction, LoopPoint};

/// Changes of the force whose secants are fitted, over the change of the whole branch. In smaller
/// ones errors of the shift are amplified; larger ones are near gross slip. Three secants are
/// fitted in any case.
const FITTED: (f64, f64) = (0.025, 0.6);
const LEAST_FITTED: f64 = 3.2;
const LEAST_SECANTS: usize = 3;
/// Changes of the force of the second fit, over the largest of the first.
const NEAR_FRACTION: f64 = 0.7;
/// Relative error, for each power of the radius in K, by the rim of the contact and the border of the
/// ring of slip, which move from cell to cell. Of 215 loops of a ball on 20 to 40 cells under a
/// tangential force, bare and coated, 195 have a stiffness: 96 % lie within the error.
const CELL_ERROR: f64 = 0.01;
/// Largest relative error with which a stiffness is given, times the power of the radius in it.
const MAX_STIFFNESS_ERROR: f64 = 0.02;

/// Law by which the secants of a motion fall.
#[derive(Clone, Copy)]
struct Law {
    /// g(x) and its derivative.
    secant: fn(f64) -> [f64; 2],
    /// Power of the radius of the contact in K.
    power: f64,
}

impl Law {
    /// The law of a shift along x or y, or of torsion.
    fn for_direction(direction: Direction) -> Self {
        match direction {
            Direction::X | Direction::Y => Self {
                secant: tangential_secant_ratio,
                power: 1.0,
            },
            Direction::Torsion => Self {
                secant: torsional_secant_ratio,
                power: 3.0,
            },
        }
    }
}

/// Stiffness right after the reversals and its error \[N/m\], mean over the branches that change
/// the force; each branch with the point that it starts from.
pub(super) fn stiffness<'a>(
    branches: impl Iterator<Item = &'a [LoopPoint]>,
    direction: Direction,
) -> [f64; 2] {
    let law = Law::for_direction(direction);
    let changes = |branch: &&[LoopPoint]| {
        branch[1..]
            .iter()
            .any(|p| p.T.to_bits() != branch[0].T.to_bits())
    };
    let moved = branches.filter(changes);
    let tangents: Vec<Option<[f64; 2]>> =
        moved.map(|branch| initial_tangent(branch, law)).collect();
    let count = tangents.len() as f64;
    let sums = (tangents.into_iter().flatten()).fold([0.0, 0.0, 0.0], |[n, k, e], [K, error]| {
        [n + 1.0, k + K, e + error]
    });
    let [with_stiffness, K, error] = sums;
    if count == 0.0 || with_stiffness < count || !(error <= law.power * MAX_STIFFNESS_ERROR * K) {
        return [f64::NAN; 2];
    }
    [K / count, error / count]
}

/// The tangent of the loop where a branch begins, and its error \[N/m\]; none where too few
/// increments are in partial slip.
fn initial_tangent(branch: &[LoopPoint], law: Law) -> Option<[f64; 2]> {
    let (start, points) = branch.split_first()?;
    let secant = |p: &LoopPoint| {
        let (rise, run) = ((p.T - start.T).abs(), (p.delta - start.delta).abs());
        (rise > 0.0 && run > 0.0).then(|| [rise, rise / run])
    };
    if let Some(stuck) = points.iter().rfind(|p| p.status == Status::FullStick) {
        return secant(stuck).map(|[_, K]| [K, law.power * CELL_ERROR * K]);
    }
    let held = points.iter().take_while(|p| p.status != Status::GrossSlip);
    let secants: Vec<[f64; 2]> = held.filter_map(secant).collect();
    let (first, whole) = (secants.first()?[0], secants.last()?[0]);
    let (from, to) = (
        FITTED.0 * whole,
        (FITTED.1 * whole).max(LEAST_FITTED * first),
    );
    let near = secants.iter().filter(|s| from <= s[0] && s[0] <= to);
    let fitted: Vec<[f64; 2]> = near.copied().collect();
    if fitted.len() < LEAST_SECANTS {
        return None;
    }
    let largest = fitted.last()?[0];
    let near = fitted
        .iter()
        .filter(|s| s[0] <= NEAR_FRACTION * largest)
        .count();
    let [K, scatter] = fit_stiffness(&fitted, law);
    let [of_near, _] = fit_stiffness(&fitted[..near.max(2)], law);
    Some([
        K,
        law.power * CELL_ERROR * K + (K - of_near).abs() + scatter,
    ])
}

/// g(x) = S/K, secant over initial stiffness after a reversal of a tangential force, and its derivative. x is
/// the change of the force over F, the limit that is fitted.
fn tangential_secant_ratio(x: f64) -> [f64; 2] {
    // Below, rounding costs more than the term of x^3.
    const SMALL: f64 = 1e-4;
    if x < SMALL {
        return [
            1.0 - x / 6.0 - 5.0 * x * x / 108.0,
            -1.0 / 6.0 - 5.0 * x / 54.0,
        ];
    }
    let root = (1.0 - x).cbrt();
    let slipped = 1.0 - root * root;
    let value = 2.0 / 3.0 * x / slipped;
    [value, value * (1.0 / x - 2.0 / (3.0 * root * slipped))]
}

/// g(x) = S/K, secant over initial stiffness after a reversal of a torsional couple, and its derivative. x is
/// the change of the couple over F, the limit that is fitted.
fn torsional_secant_ratio(x: f64) -> [f64; 2] {
    // Below, rounding costs more than the term of x^3; the term of x^2 is 0.
    const SMALL: f64 = 1e-4;
    if x < SMALL {
        return [1.0 - x / 2.0, -0.5];
    }
    let root = (1.0 - x).sqrt();
    let turned = (1.0 - root) * (3.0 - root);
    let value = x / turned;
    [value, value * (1.0 / x - (2.0 / root - 1.0) / turned)]
}

/// Fits the initial stiffness K and the limit F to secants, each a change of the force \[N\] and a stiffness
/// \[N/m\], by least squares. Returns K and its standard error, which is 0 for two secants.
fn fit_stiffness(secants: &[[f64; 2]], law: Law) -> [f64; 2] {
    let largest = secants.iter().fold(0.0_f64, |m, s| m.max(s[0]));
    // K of least squares for an F of `largest`/c, and what the residuals and the slopes add up to.
    let fit = |c: f64| {
        let terms_at = |s: &[f64; 2]| {
            let [g, slope] = (law.secant)(c * s[0] / largest);
            [g, slope * s[0] / largest, s[1]]
        };
        let points: Vec<[f64; 3]> = secants.iter().map(terms_at).collect();
        let sum = |term: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(term).sum::<f64>();
        let K = sum(&|p| p[0] * p[2]) / sum(&|p| p[0] * p[0]);
        let squares = sum(&|p| (p[2] - K * p[0]).powi(2));
        // d(squares)/dc over 2 K, at the K that makes them least.
        let rise = -sum(&|p| (p[2] - K * p[0]) * p[1]);
        let normal = [
            sum(&|p| p[0] * p[0]),
            K * sum(&|p| p[0] * p[1]),
            K * K * sum(&|p| p[1] * p[1]),
        ];
        (K, squares, rise, normal)
    };
    let (K, squares, _, [aa, ab, bb]) = fit(bisect(0.0, 1.0, |c| fit(c).2));
    let free = secants.len().saturating_sub(2).max(1) as f64;
    let determinant = aa * bb - ab * ab;
    let variance = if secants.len() > 2 && determinant > 0.0 {
        squares / free * bb / determinant
    } else {
        0.0
    };
    [K, variance.sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stiffness_of_balls_is_found_and_its_scatter_told() {
        for direction in [Direction::X, Direction::Torsion] {
            is_found(Law::for_direction(direction));
        }
    }

    fn is_found(law: Law) {
        let secants: Vec<[f64; 2]> = (1..8)
            .map(|n| 0.1 * f64::from(n))
            .map(|f| [f, 3.0 * (law.secant)(f / 1.3)[0]])
            .collect();
        let [found, error] = fit_stiffness(&secants, law);
        assert!(
            (found - 3.0).abs() < 1e-9 && error < 1e-9,
            "{found} {error}"
        );
        let [of_two, none] = fit_stiffness(&secants[..2], law);
        assert!((of_two - 3.0).abs() < 1e-6 && none == 0.0, "{of_two}");
        let mut wavy = secants;
        for (n, point) in wavy.iter_mut().enumerate() {
            point[1] += if n % 2 == 0 { 0.01 } else { -0.01 };
        }
        let [found, error] = fit_stiffness(&wavy, law);
        assert!(
            (found - 3.0).abs() < 2.0 * error && error < 0.05,
            "{found} {error}"
        );
        // The slope is the derivative, where the series ends as well.
        for x in [5e-5, 1e-4, 0.3, 0.9] {
            let change = (law.secant)(x + 1e-6)[0] - (law.secant)(x - 1e-6)[0];
            let slope = (law.secant)(x)[1];
            assert!((change / 2e-6 - slope).abs() < 1e-5, "{x}: {slope}");
        }
    }
}
