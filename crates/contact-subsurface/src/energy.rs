//! Energy and stiffness of fretting loops.
//!
//! S. Fouvry, P. Kapsa, L. Vincent, Analysis of sliding behaviour for fretting loadings:
//! determination of transition criteria, Wear 185 (1995) 35-46: with the half ranges T* and
//! delta* of force and shift and the energy E_d dissipated in a cycle, the energy ratio is
//! E_d/(4 T* delta*), the sliding ratio half the opening of the loop over delta*. Partial slip
//! turns into gross slip at an energy ratio of 0.2 and a sliding ratio of 0.26.
//!
//! The stiffness K right after a reversal is that of the contact without slip. An increment gives a
//! secant S, which is lower: after a change of the force by f the ring of reverse slip has grown.
//! R. D. Mindlin, H. Deresiewicz, J. Appl. Mech. 20 (1953) 327-344, for balls:
//!
//! ```text
//! S/K = g(f/F),  g(x) = (2/3) x/(1 - (1 - x)^(2/3)),  F = 2 mu W
//! ```
//!
//! K and F are those of least squares through the secants, so that the form holds for other
//! contacts and coatings as well. How far K moves without the largest changes of the force, its
//! standard error and the ring, which grows from cell to cell, make its error. Increments in gross
//! slip have no part in it: there the shift does not depend on the force.

use contact_core::bisection::bisect;
use contact_core::march::{Increment, Status};
use contact_core::scene::{Branch, LoadPath, Loads, Prescribed, RigidMotion};

/// Changes of the force whose secants are fitted, over that of the whole branch: errors of the shift
/// are amplified in smaller ones, and gross slip is near in larger ones. Three secants are fitted in
/// any case.
const FITTED: (f64, f64) = (0.025, 0.6);
const LEAST_FITTED: f64 = 3.2;
const LEAST_SECANTS: usize = 3;
/// Changes of the force of the second fit, over the largest of the first.
const OF_NEAR: f64 = 0.7;
/// Relative error by a ring of slip, and a rim of the contact, that move from cell to cell. Of 215
/// loops of a ball on 20 to 40 cells, bare and coated, 195 have a stiffness: 96 % lie within the
/// error.
const OF_CELLS: f64 = 0.01;
/// Largest relative error with which a stiffness is given.
const OF_STIFFNESS: f64 = 0.02;
/// Largest error with which a sliding ratio is given.
const OF_SLIDING: f64 = 0.05;

/// Loads that agree to this share of the largest are the same.
const SAME: f64 = 1e-9;

/// A tangential motion and the load that drives it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// T_x and delta_x.
    #[default]
    X,
    /// T_y and delta_y.
    Y,
    /// M_z and phi_z: moments \[N m\] take the place of forces, rotations \[rad\] that of shifts.
    Torsion,
}

/// A closed part of the load path: the loads at its end are those at its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// First and last branch, from 0.
    pub branches: (usize, usize),
    /// Energy dissipated by friction \[J\].
    pub dissipated: f64,
    /// Half the range of the force T \[N\].
    pub T: f64,
    /// Half the range of the shift \[m\].
    pub delta: f64,
    /// Stiffness right after the reversals \[N/m\], extrapolated, mean over the branches; NaN
    /// where the increments leave an error above 2 %: too few of them are in partial slip.
    pub stiffness: f64,
    /// Its estimated error \[N/m\].
    pub stiffness_error: f64,
    /// Half the opening of the loop where the force passes the middle of its range \[m\].
    pub opening: f64,
    /// Bound of its error \[m\]: the loop between two increments is convex.
    pub opening_error: f64,
    /// Gross slip if the interface slid in any increment.
    pub status: Status,
}

impl Cycle {
    /// Why a cycle has no stiffness, and what to do.
    pub const TOO_FEW: &str =
        "fewer than three increments of a branch are in partial slip, use more";

    /// E_d/(4 T* delta*); 0 where nothing moves.
    pub fn energy_ratio(&self) -> f64 {
        ratio(self.dissipated, 4.0 * self.T * self.delta)
    }

    /// Half the opening over half the range of the shift; 0 where nothing moves, NaN where the
    /// increments leave an error above 0.05.
    pub fn sliding_ratio(&self) -> f64 {
        if self.sliding_ratio_error() > OF_SLIDING {
            return f64::NAN;
        }
        ratio(self.opening, self.delta)
    }

    /// Bound of the error of the sliding ratio.
    pub fn sliding_ratio_error(&self) -> f64 {
        ratio(self.opening_error, self.delta)
    }

    /// Stiffness of the whole loop \[N/m\], T*/delta*.
    pub fn secant_stiffness(&self) -> f64 {
        ratio(self.T, self.delta)
    }
}

fn ratio(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { 0.0 }
}

/// First and last branch of every cycle of a load path: from a turning point, the first time that
/// its loads, the motions given in place of loads and the bulk stresses return; cycles follow each
/// other and do not overlap. A branch that changes nothing is no cycle.
pub fn cycles(path: &LoadPath) -> Vec<(usize, usize)> {
    let ends: Vec<Loads> = std::iter::once(Loads::default())
        .chain(path.branches.iter().map(|b| b.to))
        .collect();
    // Largest load and largest motion that is prescribed; moments and rotations have their own.
    let kind = |of: RigidMotion, prescribed: Prescribed| {
        (
            usize::from(of.is_rotation()),
            usize::from(prescribed.is_motion()),
        )
    };
    let mut largest = [[0.0_f64; 2]; 2];
    for end in &ends {
        for of in RigidMotion::ALL {
            let prescribed = end.prescribed(of);
            let (rotation, motion) = kind(of, prescribed);
            let largest = &mut largest[rotation][motion];
            *largest = largest.max(prescribed.value().abs());
        }
    }
    let pulls = |l: &Loads| [l.sigma_B, l.sigma_B1];
    let bulk = ends
        .iter()
        .flat_map(pulls)
        .fold(0.0, |m: f64, s| m.max(s.abs()));
    let same = |a: &Loads, b: &Loads| {
        let (a_pulls, b_pulls) = (pulls(a), pulls(b));
        let pulled_alike = (0..2).all(|k| (a_pulls[k] - b_pulls[k]).abs() <= SAME * bulk);
        let driven_alike = RigidMotion::ALL.into_iter().all(|of| {
            let (a, b) = (a.prescribed(of), b.prescribed(of));
            let (rotation, motion) = kind(of, a);
            a.is_motion() == b.is_motion()
                && (a.value() - b.value()).abs() <= SAME * largest[rotation][motion]
        });
        pulled_alike && driven_alike
    };
    let mut found = Vec::new();
    let mut start = 0;
    while start < ends.len() {
        let back = (start + 2..ends.len()).find(|end| same(&ends[start], &ends[*end]));
        match back {
            // Branch n ends at the n + 1st of the turning points.
            Some(end) => {
                found.push((start, end - 1));
                start = end;
            }
            None => start += 1,
        }
    }
    found
}

/// A point of a loop: force and shift at the end of an increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPoint {
    /// Branch of the load path, from 0.
    pub branch: usize,
    /// Tangential force \[N\].
    pub T: f64,
    /// Tangential shift \[m\].
    pub delta: f64,
    /// Energy dissipated by friction in the increment \[J\].
    pub dissipated: f64,
    /// State of the interface.
    pub status: Status,
}

impl LoopPoint {
    /// The force and shift of an increment along a direction.
    pub fn new(increment: &Increment, direction: Direction) -> Self {
        let (loads, motion) = (&increment.point.loads, &increment.motion);
        let (T, delta) = match direction {
            Direction::X => (loads.T_x, motion.delta_x),
            Direction::Y => (loads.T_y, motion.delta_y),
            Direction::Torsion => (loads.M_z, motion.phi_z),
        };
        Self {
            branch: increment.point.branch,
            T,
            delta,
            dissipated: increment.energy.dissipated,
            status: increment.status,
        }
    }
}

/// The loops of the cycles of a path that the history contains completely.
pub fn loops(path: &LoadPath, history: &[LoopPoint]) -> Vec<Cycle> {
    let upto = |branch: usize| -> usize {
        let before = path.branches.iter().take(branch);
        before.map(Branch::count).sum()
    };
    let done = cycles(path).into_iter().filter_map(|(first, last)| {
        let (start, end) = (upto(first), upto(last + 1));
        // With the turning point that the cycle starts from, unless that is the unloaded state.
        let curve = history.get(start.saturating_sub(1)..end)?;
        Some(cycle((first, last), history.get(start..end)?, curve))
    });
    done.collect()
}

fn cycle(branches: (usize, usize), part: &[LoopPoint], curve: &[LoopPoint]) -> Cycle {
    let range = |f: fn(&LoopPoint) -> f64| {
        let values = curve.iter().map(f);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        })
    };
    let (force, shift) = (range(|p| p.T), range(|p| p.delta));
    let worst = |a: Status, b: Status| if b.code() > a.code() { b } else { a };
    let [stiffness, stiffness_error] = reversal_stiffness(curve);
    let [opening, opening_error] = opening(curve, f64::midpoint(force.0, force.1));
    Cycle {
        branches,
        dissipated: part.iter().map(|p| p.dissipated).sum(),
        T: (force.1 - force.0) / 2.0,
        delta: (shift.1 - shift.0) / 2.0,
        stiffness,
        stiffness_error,
        opening,
        opening_error,
        status: part.iter().map(|p| p.status).fold(Status::NoContact, worst),
    }
}

/// The branches of a loop, each with the point that it starts from.
fn branches(curve: &[LoopPoint]) -> impl Iterator<Item = &[LoopPoint]> {
    let starts = (1..curve.len()).filter(|n| *n == 1 || curve[*n].branch != curve[n - 1].branch);
    starts.map(|first| {
        let of_branch = |p: &&LoopPoint| p.branch == curve[first].branch;
        let count = curve[first..].iter().take_while(of_branch).count();
        &curve[first - 1..first + count]
    })
}

/// Stiffness right after the reversals and its error \[N/m\], mean over the branches that change
/// the force.
fn reversal_stiffness(curve: &[LoopPoint]) -> [f64; 2] {
    let moved =
        branches(curve).filter(|of| of[1..].iter().any(|p| p.T.to_bits() != of[0].T.to_bits()));
    let known: Vec<Option<[f64; 2]>> = moved.map(tangent).collect();
    let count = known.len() as f64;
    let sums = (known.into_iter().flatten()).fold([0.0, 0.0, 0.0], |[n, k, e], [K, error]| {
        [n + 1.0, k + K, e + error]
    });
    let [found, K, error] = sums;
    if found < count || !(error <= OF_STIFFNESS * K) {
        return [f64::NAN; 2];
    }
    [ratio(K, count), ratio(error, count)]
}

/// The tangent of the loop where a branch begins, and its error \[N/m\]; none where too few
/// increments are in partial slip.
fn tangent(branch: &[LoopPoint]) -> Option<[f64; 2]> {
    let (start, points) = branch.split_first()?;
    let secant = |p: &LoopPoint| {
        let (rise, run) = ((p.T - start.T).abs(), (p.delta - start.delta).abs());
        (rise > 0.0 && run > 0.0).then(|| [rise, rise / run])
    };
    if let Some(stuck) = points.iter().rfind(|p| p.status == Status::FullStick) {
        return secant(stuck).map(|[_, K]| [K, OF_CELLS * K]);
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
    let near = fitted.iter().filter(|s| s[0] <= OF_NEAR * largest).count();
    let [K, scatter] = without_slip(&fitted);
    let [of_near, _] = without_slip(&fitted[..near.max(2)]);
    Some([K, OF_CELLS * K + (K - of_near).abs() + scatter])
}

/// g(x), the secant after a reversal over the stiffness without slip, and its derivative.
fn secant_over_stiffness(x: f64) -> [f64; 2] {
    // Below, rounding costs more than the term of x^3.
    const SMALL: f64 = 1e-4;
    if x < SMALL {
        return [
            1.0 - x / 6.0 - 5.0 * x * x / 108.0,
            -1.0 / 6.0 - 5.0 * x / 54.0,
        ];
    }
    let rest = (1.0 - x).cbrt();
    let slipped = 1.0 - rest * rest;
    let value = 2.0 / 3.0 * x / slipped;
    [value, value * (1.0 / x - 2.0 / (3.0 * rest * slipped))]
}

/// K of least squares through secants, each a change of the force and a stiffness, and its standard
/// error; 0 of two secants.
fn without_slip(secants: &[[f64; 2]]) -> [f64; 2] {
    let largest = secants.iter().fold(0.0_f64, |m, s| m.max(s[0]));
    // K of least squares for an F of `largest`/c, and what the residuals and the slopes add up to.
    let fit = |c: f64| {
        let at = |s: &[f64; 2]| {
            let [g, slope] = secant_over_stiffness(c * s[0] / largest);
            [g, slope * s[0] / largest, s[1]]
        };
        let points: Vec<[f64; 3]> = secants.iter().map(at).collect();
        let sum = |of: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(of).sum::<f64>();
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

/// Half the distance between the outermost shifts at which the force passes `middle`, and the bound
/// of its error \[m\]. Between two increments of a branch the loop is convex: it lies between the
/// chord and the extensions of the chords before and after.
fn opening(curve: &[LoopPoint], middle: f64) -> [f64; 2] {
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    let mut error = 0.0;
    for branch in branches(curve) {
        for (n, pair) in branch.windows(2).enumerate() {
            let (from, to) = (pair[0], pair[1]);
            if (from.T - middle) * (to.T - middle) > 0.0 || from.T.to_bits() == to.T.to_bits() {
                continue;
            }
            let share = (middle - from.T) / (to.T - from.T);
            let at = from.delta + (to.delta - from.delta) * share;
            let length = (to.delta - from.delta).abs();
            // Shifts per force of the chords beside.
            let beside = |a: usize, b: usize| {
                let (a, b) = (branch.get(a)?, branch.get(b)?);
                let rise = (b.T - a.T).abs();
                (rise > 0.0).then(|| (b.delta - a.delta).abs() / rise)
            };
            let before = n.checked_sub(1).and_then(|m| beside(m, n)).unwrap_or(0.0);
            let least = before * (middle - from.T).abs();
            let after = beside(n + 1, n + 2);
            let least = after.map_or(least, |slope| {
                least.max(length - slope * (to.T - middle).abs())
            });
            let chord = (at - from.delta).abs();
            error += (chord - least.max(0.0)).clamp(0.0, length) / 2.0;
            range = (range.0.min(at), range.1.max(at));
        }
    }
    [((range.1 - range.0) / 2.0).max(0.0), error]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_start_where_the_loads_return() {
        let path = LoadPath::start()
            .normal(10.0, 1)
            .tangential(&[2.0, -2.0, 2.0, -2.0, 2.0], 10);
        assert_eq!(cycles(&path), [(2, 3), (4, 5)]);
        let repeated = LoadPath::start()
            .normal(1.0, 1)
            .normal(0.0, 1)
            .normal(2.0, 1);
        assert_eq!(cycles(&repeated), [(0, 1)]);
        assert!(cycles(&LoadPath::start().normal(1.0, 1)).is_empty());
        let held = LoadPath::start().normal(1.0, 1).normal(1.0, 3);
        assert!(cycles(&held).is_empty());
        let torsion = LoadPath::start()
            .normal(10.0, 1)
            .torsion(&[0.2, -0.2, 0.2], 10);
        assert_eq!(cycles(&torsion), [(2, 3)]);
    }

    #[test]
    fn the_stiffness_of_balls_is_found_and_its_scatter_told() {
        let secants: Vec<[f64; 2]> = (1..8)
            .map(|n| 0.1 * f64::from(n))
            .map(|f| [f, 3.0 * secant_over_stiffness(f / 1.3)[0]])
            .collect();
        let [found, error] = without_slip(&secants);
        assert!(
            (found - 3.0).abs() < 1e-9 && error < 1e-9,
            "{found} {error}"
        );
        let [of_two, none] = without_slip(&secants[..2]);
        assert!((of_two - 3.0).abs() < 1e-6 && none == 0.0, "{of_two}");
        let mut wavy = secants;
        for (n, point) in wavy.iter_mut().enumerate() {
            point[1] += if n % 2 == 0 { 0.01 } else { -0.01 };
        }
        let [found, error] = without_slip(&wavy);
        assert!(
            (found - 3.0).abs() < 2.0 * error && error < 0.05,
            "{found} {error}"
        );
        // The slope is the derivative, where the series ends as well.
        for x in [5e-5, 1e-4, 0.3, 0.9] {
            let change = secant_over_stiffness(x + 1e-6)[0] - secant_over_stiffness(x - 1e-6)[0];
            let slope = secant_over_stiffness(x)[1];
            assert!((change / 2e-6 - slope).abs() < 1e-5, "{x}: {slope}");
        }
    }

    #[test]
    fn cycles_of_given_motions() {
        let shifted = |path: LoadPath, by: f64| path.to(|l| l.given.delta_x = Some(by), 2);
        let path = [1e-6, -1e-6, 1e-6, 0.0]
            .into_iter()
            .fold(LoadPath::start().normal(10.0, 1), shifted);
        // The force that was given before the shifts is no end of a cycle of shifts.
        assert_eq!(cycles(&path), [(2, 3)]);
        let lower = |path: LoadPath, by: f64| path.to(|l| l.sigma_B = by, 2);
        let upper = |path: LoadPath, by: f64| path.to(|l| l.sigma_B1 = by, 2);
        for pulled in [lower, upper] {
            let path = [1e8, -1e8, 1e8]
                .into_iter()
                .fold(LoadPath::start().normal(10.0, 1), pulled);
            assert_eq!(cycles(&path), [(2, 3)]);
        }
        let rocking = |path: LoadPath, by: f64| path.to(|l| l.given.phi_y = Some(by), 2);
        let path = [1e-4, -1e-4, 0.0]
            .into_iter()
            .fold(LoadPath::start().normal(10.0, 1), rocking);
        assert_eq!(cycles(&path), [(1, 3)]);
    }
}
