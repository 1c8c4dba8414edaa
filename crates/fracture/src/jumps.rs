//! Stresses that jump along a crack, at the interfaces of layers.
//!
//! K is the integral of g(t) s(t) over the variable t of the rule, s the traction of the body without
//! the crack and g a smooth weight function. The trapezoidal rule takes g and s at its points t_k, and
//! loses half a step where s jumps. Beside a jump the traction at a point is therefore replaced by
//!
//! ```text
//! s_k = 1/h int phi_k(t) s(t) dt,
//! ```
//!
//! phi_k the piecewise polynomial of degree 2 p - 1 that is 1 at t_k and 0 at the other points. The sum
//! over g(t_k) s_k is then the integral of the interpolated g times s, whatever s is. The integral is
//! split at the jumps. Where s is smooth, s_k = s(t_k) + O(h^(2 p)), since all moments of phi_k up to
//! the order 2 p - 1 vanish. At the tip s and g are even in t.

use std::collections::BTreeMap;

use super::path::Path;
use super::rule::{Rule, Stretch, distance, variable};
use super::stress::{Point, Traction};

/// Half of the points of an interpolation, for the rule and for the rule of three times its step.
const HALF: [i64; 2] = [3, 2];
/// Gauss's rule on (0, 1) between two points of the rule: exact for polynomials of degree 7.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// The traction at a point of the rule as a sum over the added points: (index, weight).
type Mean = (usize, Vec<(usize, f64)>);

/// Points added beside jumps, and the means over them that the two rules take.
#[derive(Debug, Default)]
pub(crate) struct Jumps {
    /// Added points.
    pub(crate) points: Vec<Point>,
    /// For the rule and for the rule of three times its step.
    means: [Vec<Mean>; 2],
}

impl Jumps {
    /// The points on both sides of the jumps of the stress at the lengths `at` from the mouth \[m\].
    pub(crate) fn new(rule: &Rule, path: &Path, at: &[f64]) -> Self {
        let mut jumps = Self::default();
        let length = path.length();
        for stretch in &rule.stretches {
            let places = at.iter().map(|s| s / length);
            let splits: Vec<f64> = places.filter_map(|s| variable(stretch, s)).collect();
            jumps.add_stretch((stretch, rule.step), &splits, |s| path.at(length * s));
        }
        jumps
    }

    /// Adds the points on both sides of the jumps that lie in one leg, at the parameters t = `splits`.
    fn add_stretch(
        &mut self,
        (stretch, h): (&Stretch, f64),
        splits: &[f64],
        point: impl Fn(f64) -> Point,
    ) {
        let mirrored = splits.iter().map(|t| -t).filter(|_| stretch.tip);
        let splits: Vec<f64> = splits.iter().copied().chain(mirrored).collect();
        // Points between the rule's points i and i + 1, in units of h from the first point on.
        let mut between: BTreeMap<i64, Vec<(f64, f64, usize)>> = BTreeMap::new();
        for (coarse, half) in [1, 3].into_iter().zip(HALF) {
            let offset = i64::from(coarse == 3);
            let mut nodes = Vec::new();
            for t in &splits {
                let cell = ((t - stretch.start) / h - 0.5 - offset as f64) / coarse as f64;
                let cell = cell.floor() as i64;
                nodes.extend(cell - half + 1..=cell + half);
            }
            nodes.sort_unstable();
            nodes.dedup();
            for node in nodes {
                let k = coarse * node + offset;
                if k < 0 || k >= stretch.count as i64 {
                    continue;
                }
                let mut weights = Vec::new();
                for cell in node - half..node + half {
                    let cardinal = |u: f64| -> f64 {
                        let around = cell - half + 1..=cell + half;
                        let u = (u - offset as f64) / coarse as f64;
                        around
                            .filter(|n| *n != node)
                            .map(|n| (u - n as f64) / (node - n) as f64)
                            .product()
                    };
                    let first = coarse * cell + offset;
                    for i in first..first + coarse {
                        let samples = between.entry(i).or_insert_with(|| {
                            let ends = (i as f64, (i + 1) as f64);
                            let inside = splits.iter().map(|t| (t - stretch.start) / h - 0.5);
                            self.sample(ends, inside, |u| {
                                let t = stretch.start + h * (u + 0.5);
                                point(stretch.from + distance(stretch, t))
                            })
                        });
                        for (u, weight, index) in samples {
                            weights.push((*index, cardinal(*u) * *weight / coarse as f64));
                        }
                    }
                }
                let rule = usize::from(coarse == 3);
                let index = (stretch.first as i64 + k) as usize / if rule == 0 { 1 } else { 3 };
                self.means[rule].push((index, weights));
            }
        }
    }

    /// Gauss points of an interval, split at what lies `inside`: place, weight, index of the point.
    fn sample(
        &mut self,
        (low, high): (f64, f64),
        inside: impl Iterator<Item = f64>,
        point: impl Fn(f64) -> Point,
    ) -> Vec<(f64, f64, usize)> {
        let mut ends: Vec<f64> = inside.filter(|u| low < *u && *u < high).collect();
        ends.extend([low, high]);
        ends.sort_unstable_by(f64::total_cmp);
        let mut samples = Vec::new();
        for pair in ends.windows(2) {
            let width = pair[1] - pair[0];
            for (x, weight) in GAUSS {
                let u = pair[0] + width * x;
                samples.push((u, width * weight, self.points.len()));
                self.points.push(point(u));
            }
        }
        samples
    }

    /// The tractions that the two rules take, of those at the points of the rule and at the added ones.
    pub(crate) fn loads(&self, rule: &[Traction], added: &[Traction]) -> [Vec<Traction>; 2] {
        let every_third = rule.iter().skip(1).step_by(3).copied().collect();
        let mut loads = [rule.to_vec(), every_third];
        for (load, means) in loads.iter_mut().zip(&self.means) {
            for (k, weights) in means {
                let sum = |of: fn(&Traction) -> f64| -> f64 {
                    weights.iter().map(|(n, w)| w * of(&added[*n])).sum()
                };
                load[*k] = Traction {
                    normal: sum(|t| t.normal),
                    shear: sum(|t| t.shear),
                };
            }
        }
        loads
    }
}
