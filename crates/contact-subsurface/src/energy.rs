//! Energy and stiffness of fretting loops.
//!
//! S. Fouvry, P. Kapsa, L. Vincent, Analysis of sliding behaviour for fretting loadings:
//! determination of transition criteria, Wear 185 (1995) 35-46: with the half ranges T* and
//! delta* of force and shift and the energy E_d dissipated in a cycle, the energy ratio is
//! E_d/(4 T* delta*), the sliding ratio half the opening of the loop over delta*. Partial slip
//! turns into gross slip at an energy ratio of 0.2 and a sliding ratio of 0.26.

use contact_core::march::Status;
use contact_core::scene::{Branch, LoadPath};

use crate::loop_point::{Direction, LoopPoint};
use crate::reversal;

/// Largest error with which a sliding ratio is given.
const MAX_SLIDING_ERROR: f64 = 0.05;

/// Error of the sliding ratio s by the cells, over `s (1 - s)`, times N^(3/2), N being the cells across the
/// slip zone: of line contacts, and of others, in which the border of the stick zone cuts cells everywhere.
/// The cell that this border cuts sticks or slips as a whole, with either sign. From 45 lines of 24 to 96
/// cells (bare, coated, unlike bodies) against 512, and from 20 spheres of 16 to 48 cells against the closed
/// form, T 0.15 to 0.9 mu W: 64 of 65 errors are within 1.5 times these.
const CELLS: [f64; 2] = [0.4, 0.15];
/// Fewest cells across the slip zone that count.
const FEWEST: f64 = 0.5;

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
    /// where the increments leave an error above 2 %, in torsion 6 %: too few of them are in partial
    /// slip.
    pub stiffness: f64,
    /// Its estimated error \[N/m\].
    pub stiffness_error: f64,
    /// Half the opening of the loop where the force passes the middle of its range \[m\].
    pub opening: f64,
    /// Bound of its error \[m\]: the loop between two increments is convex.
    pub opening_error: f64,
    /// Gross slip if the interface slid in any increment.
    pub status: Status,
    /// Cells across the zone that slips, where it is widest; 0 where nothing slips.
    pub slip_cells: f64,
}

/// Errors of a cycle, from the errors of its branches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleErrors {
    /// Error of the dissipated energy \[J\].
    pub dissipated: f64,
    /// Error of the energy ratio.
    pub energy_ratio: f64,
    /// Error of the sliding ratio.
    pub sliding_ratio: f64,
    /// Error of half the opening \[m\].
    pub opening: f64,
}

impl Cycle {
    /// Explains why a cycle has no stiffness, and the remedy.
    pub const TOO_FEW: &str =
        "fewer than three increments of a branch are in partial slip, use more";

    /// E_d/(4 T* delta*); 0 where nothing moves.
    pub fn energy_ratio(&self) -> f64 {
        ratio(self.dissipated, 4.0 * self.T * self.delta)
    }

    /// [`Self::opening`]; NaN if the increments cause an error above 0.05 of half the range of the
    /// shift.
    pub fn checked_opening(&self) -> f64 {
        if self.sliding_ratio_error() > MAX_SLIDING_ERROR {
            f64::NAN
        } else {
            self.opening
        }
    }

    /// [`Self::checked_opening`] over half the range of the shift; 0 where nothing moves.
    pub fn sliding_ratio(&self) -> f64 {
        ratio(self.checked_opening(), self.delta)
    }

    /// Bound of the error of the sliding ratio by the increments.
    pub fn sliding_ratio_error(&self) -> f64 {
        ratio(self.opening_error, self.delta)
    }

    /// Relative error of the opening by the cells on a grid; 0 where nothing slips.
    fn opening_error_of_cells(&self, plane_strain: bool) -> f64 {
        if self.slip_cells <= 0.0 {
            return 0.0;
        }
        CELLS[usize::from(!plane_strain)] / self.slip_cells.max(FEWEST).powf(1.5)
    }

    /// Error of the sliding ratio by the cells on a grid. The part of the shift that is no opening is elastic
    /// and has no such error, so that it shrinks in gross slip.
    fn sliding_ratio_error_of_cells(&self, plane_strain: bool) -> f64 {
        let s = ratio(self.opening, self.delta);
        (self.opening_error_of_cells(plane_strain) * s * (1.0 - s)).max(0.0)
    }

    /// Errors of a cycle from the errors of the branches of the path: of their energy \[J\], of the
    /// force \[N\] and of the shift \[m\] at their ends. Without branches they are NaN, except for
    /// the opening and the sliding ratio, whose errors by the cells follow from the width of the slip
    /// zone. Errors of energies have one cause and add up. The error of half a range is the largest
    /// error of the ends. The relative error of the opening is the relative error of the energy,
    /// which is the area of the loop, plus the error by the increments.
    pub fn errors(&self, of_branches: &[[f64; 3]], plane_strain: bool) -> CycleErrors {
        if of_branches.is_empty() {
            return CycleErrors {
                dissipated: f64::NAN,
                energy_ratio: f64::NAN,
                sliding_ratio: self.sliding_ratio_error()
                    + self.sliding_ratio_error_of_cells(plane_strain),
                opening: self.opening_error
                    + self.opening * self.opening_error_of_cells(plane_strain),
            };
        }
        let (first, last) = self.branches;
        let of_cycle = of_branches.iter().skip(first).take(last + 1 - first);
        let largest = |n: usize| of_cycle.clone().map(|errors| errors[n]).fold(0.0, f64::max);
        let energy: f64 = of_cycle.clone().map(|errors| errors[0]).sum();
        let of_energy = ratio(energy, self.dissipated);
        let [of_T, of_delta] = [ratio(largest(1), self.T), ratio(largest(2), self.delta)];
        let of_cells = ratio(self.opening, self.delta) * (of_energy + of_delta);
        CycleErrors {
            dissipated: energy,
            energy_ratio: self.energy_ratio() * (of_energy + of_T + of_delta),
            sliding_ratio: self.sliding_ratio_error() + of_cells,
            opening: self.opening_error + self.opening * (of_energy + of_T),
        }
    }

    /// Stiffness of the whole loop \[N/m\], T*/delta*.
    pub fn secant_stiffness(&self) -> f64 {
        ratio(self.T, self.delta)
    }
}

/// Ratio of two numbers, 0 for 0/0.
fn ratio(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { 0.0 }
}

/// First and last branch, from 0, of the cycles of a path that end within its first increments.
pub fn finished_cycles(path: &LoadPath, increments: usize) -> Vec<(usize, usize)> {
    let mut cycles = path.cycles();
    cycles.retain(|(_, last)| increments_before(path, last + 1) <= increments);
    cycles
}

/// Number of increments of the path before a branch.
fn increments_before(path: &LoadPath, branch: usize) -> usize {
    let before = path.branches.iter().take(branch);
    before.map(Branch::count).sum()
}

/// The loops of a motion in those cycles of a path that the history contains completely.
pub fn loops(path: &LoadPath, direction: Direction, history: &[LoopPoint]) -> Vec<Cycle> {
    let finished = finished_cycles(path, history.len()).into_iter();
    let done = finished.filter_map(|(first, last)| {
        let [start, end] = [first, last + 1].map(|branch| increments_before(path, branch));
        // With the turning point that the cycle starts from, unless that is the unloaded state.
        let curve = history.get(start.saturating_sub(1)..end)?;
        let part = history.get(start..end)?;
        Some(cycle((first, last), direction, part, curve))
    });
    done.collect()
}

/// The loop of a cycle: `part` are its increments, `curve` starts one point earlier.
fn cycle(
    branches: (usize, usize),
    direction: Direction,
    part: &[LoopPoint],
    curve: &[LoopPoint],
) -> Cycle {
    let range = |f: fn(&LoopPoint) -> f64| {
        let values = curve.iter().map(f);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        })
    };
    let (force, shift) = (range(|p| p.T), range(|p| p.delta));
    let worse = |a: Status, b: Status| if b.code() > a.code() { b } else { a };
    let [stiffness, stiffness_error] =
        reversal::stiffness(from_reversals(curve).into_iter(), direction);
    let [opening, opening_error] = loop_opening(curve, f64::midpoint(force.0, force.1));
    Cycle {
        branches,
        dissipated: part.iter().map(|p| p.dissipated).sum(),
        T: (force.1 - force.0) / 2.0,
        delta: (shift.1 - shift.0) / 2.0,
        stiffness,
        stiffness_error,
        opening,
        opening_error,
        status: part.iter().map(|p| p.status).fold(Status::NoContact, worse),
        slip_cells: part.iter().map(|p| p.slip_cells).fold(0.0, f64::max),
    }
}

/// Splits a loop into runs from reversal to reversal, each with the point that it starts from. Branches that go
/// on in the same direction of force and shift are one run.
fn runs(curve: &[LoopPoint]) -> Vec<&[LoopPoint]> {
    let span = |value: fn(&LoopPoint) -> f64| {
        let values = curve.iter().map(value);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        (high - low).max(f64::MIN_POSITIVE)
    };
    let (force, shift) = (span(|p| p.T), span(|p| p.delta));
    // Change of force and shift in an increment, over their ranges.
    let change = |n: usize| {
        let (from, to) = (curve[n - 1], curve[n]);
        (to.T - from.T) / force + (to.delta - from.delta) / shift
    };
    let goes_on = |n: usize| change(n - 1) * change(n) > 0.0;
    let mut starts: Vec<usize> = (1..curve.len())
        .filter(|n| *n == 1 || (curve[*n].branch != curve[n - 1].branch && !goes_on(*n)))
        .collect();
    starts.push(curve.len());
    let pairs = starts.windows(2);
    pairs.map(|pair| &curve[pair[0] - 1..pair[1]]).collect()
}

/// The runs of a loop that begin at a reversal. The first one does not if the last one goes on in its
/// direction.
fn from_reversals(curve: &[LoopPoint]) -> Vec<&[LoopPoint]> {
    let mut runs = runs(curve);
    let rise = |run: &[LoopPoint]| match run {
        [first, .., last] => last.T - first.T,
        _ => 0.0,
    };
    if let [first, _, .., last] = &runs[..]
        && rise(first) * rise(last) > 0.0
    {
        runs.remove(0);
    }
    runs
}

/// Half the distance between the outermost shifts at which the force passes `middle`, and the bound
/// of its error \[m\]. Between two increments of a branch the loop is convex: it lies between the
/// chord and the extensions of the chords before and after.
fn loop_opening(curve: &[LoopPoint], middle: f64) -> [f64; 2] {
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    let mut error = 0.0;
    for branch in runs(curve) {
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
        assert_eq!(path.cycles(), [(2, 3), (4, 5)]);
        let repeated = LoadPath::start()
            .normal(1.0, 1)
            .normal(0.0, 1)
            .normal(2.0, 1);
        assert_eq!(repeated.cycles(), [(0, 1)]);
        assert!(LoadPath::start().normal(1.0, 1).cycles().is_empty());
        let held = LoadPath::start().normal(1.0, 1).normal(1.0, 3);
        assert!(held.cycles().is_empty());
        let torsion = LoadPath::start()
            .normal(10.0, 1)
            .torsion(&[0.2, -0.2, 0.2], 10);
        assert_eq!(torsion.cycles(), [(2, 3)]);
    }

    #[test]
    fn cycles_of_given_motions() {
        let shifted = |path: LoadPath, by: f64| path.change_to(|l| l.given.delta_x = Some(by), 2);
        let path = [1e-6, -1e-6, 1e-6, 0.0]
            .into_iter()
            .fold(LoadPath::start().normal(10.0, 1), shifted);
        // The force that was given before the shifts is no end of a cycle of shifts.
        assert_eq!(path.cycles(), [(2, 3)]);
        let lower = |path: LoadPath, by: f64| path.change_to(|l| l.sigma_B = by, 2);
        let upper = |path: LoadPath, by: f64| path.change_to(|l| l.sigma_B1 = by, 2);
        for pulled in [lower, upper] {
            let path = [1e8, -1e8, 1e8]
                .into_iter()
                .fold(LoadPath::start().normal(10.0, 1), pulled);
            assert_eq!(path.cycles(), [(2, 3)]);
        }
        let rocking = |path: LoadPath, by: f64| path.change_to(|l| l.given.phi_y = Some(by), 2);
        let path = [1e-4, -1e-4, 0.0]
            .into_iter()
            .fold(LoadPath::start().normal(10.0, 1), rocking);
        assert_eq!(path.cycles(), [(1, 3)]);
    }
}
