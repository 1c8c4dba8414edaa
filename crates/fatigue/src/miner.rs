//! Damage of counted loops on planes: Miner's sum, with a law below the knee of the curve of lives.
//!
//! M. A. Miner, J. Appl. Mech. 12 (1945) A159-A164: the damage of a plane is the sum over the loops of
//! count/N(value on this plane). The value of a loop is the criterion on the stress of its instants. The
//! plane of the largest sum decides; it need not be the worst plane of any single loop. A criterion
//! whose plane has the largest first part takes the plane with the largest sum by that part.

use std::sync::atomic::{AtomicBool, Ordering};

use ndarray::ArrayView4;
use rayon::prelude::*;
use stress_tensor::StressTensor;

use crate::assessment::Assessment;
use crate::critical_plane::Search;
use crate::definition::Acts;
use crate::error::Error;
use crate::evaluate::{Worker, evaluate_point};
use crate::hemisphere::FINE;
use crate::histories::Histories;
use crate::judge::Judge;
use crate::on_planes::{OnPlanes, ShearBuffers};
use crate::path::{cross, dot, normalize};
use crate::plane_function::PlaneFunction;

/// Turn of a plane with which its neighbours are tried first, and the one that ends the search: the sum
/// is flat at its maximum, so that this turn changes it by 1e-8.
const FIRST_TURN: f64 = 0.08;
const LAST_TURN: f64 = 1e-4;
/// Loops whose own critical planes are tried.
const OWN_PLANES: usize = 3;
/// Points of the table of lives, and its ends \[cycles\].
const KNOTS: usize = 2000;
const TABLE: [f64; 2] = [1e-3, 1e15];

/// The curve of lives below its knee.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BelowKnee {
    /// Smaller loops do no damage (Miner's original rule).
    Original,
    /// The curve goes on with its slope (elementary rule).
    Elementary,
    /// The curve goes on with the exponent 2 m - 1, m being the exponent above the knee (E. Haibach,
    /// LBF report TM 50/70 (1970)).
    Haibach,
}

/// A curve of lives, from the value of a criterion to the damage of a loop.
#[derive(Clone, Debug)]
pub struct DamageCurve {
    assessment: Assessment,
    below: BelowKnee,
    /// Cycles at the knee.
    knee: f64,
    /// Value at the knee, and exponent m of N ~ value^-m there.
    value: f64,
    exponent: f64,
    /// ln value, falling, and ln N of a strain-life curve.
    table: Vec<[f64; 2]>,
}

impl DamageCurve {
    /// Makes the curve of a criterion with lives, or with a limit and the exponent of its lives above the
    /// limit: N = knee (value/limit)^-exponent.
    pub fn new(
        assessment: &Assessment,
        below: BelowKnee,
        knee: f64,
        exponent: Option<f64>,
    ) -> Result<Self, Error> {
        if !(knee.is_finite() && (1.0..=1e12).contains(&knee)) {
            return Err(Error::argument("knee", knee, "1 to 1e12 cycles"));
        }
        let name = assessment.criterion.name();
        let mut table = Vec::new();
        let (value, exponent) = match assessment.judge {
            Judge::Limit(limit) => {
                let Some(exponent) = exponent else {
                    let allowed = format!("given: {name} has a limit and no curve of lives");
                    return Err(Error::argument("exponent", "nothing", allowed));
                };
                if !(exponent.is_finite() && (1.0..=100.0).contains(&exponent)) {
                    return Err(Error::argument("exponent", exponent, "1 to 100"));
                }
                (limit, exponent)
            }
            Judge::Life(curve) => {
                if let Some(exponent) = exponent {
                    let allowed = format!("left out: {name} has a curve of lives");
                    return Err(Error::argument("exponent", exponent, allowed));
                }
                let definition = assessment.criterion.definition();
                let numbers = assessment.criterion.ordered_numbers();
                let value = |N: f64| (definition.curve)(&curve, numbers, N);
                let [first, last] = TABLE.map(f64::ln);
                table.extend((0..KNOTS).map(|k| {
                    let x = first + (last - first) * k as f64 / (KNOTS - 1) as f64;
                    [value(x.exp()).ln(), x]
                }));
                let h = 1e-4_f64;
                let slope = (value(knee * (1.0 + h)) / value(knee * (1.0 - h))).ln() / (2.0 * h);
                (value(knee), -1.0 / slope)
            }
        };
        Ok(Self {
            assessment: *assessment,
            below,
            knee,
            value,
            exponent,
            table,
        })
    }

    /// Value of the criterion at the knee.
    pub fn value_at_knee(&self) -> f64 {
        self.value
    }

    /// Damage of one loop of a value.
    pub fn damage(&self, value: f64) -> f64 {
        self.damage_by(value, |v| 1.0 / self.assessment.life(v))
    }

    /// Interpolates [`Self::damage`] in the table of a curve, to a relative error of 1e-5.
    fn quick_damage(&self, value: f64) -> f64 {
        self.damage_by(value, |v| {
            let x = v.ln();
            let after = self.table.partition_point(|[ln_value, _]| *ln_value > x);
            if after == self.table.len() {
                return 0.0;
            }
            let [[v0, n0], [v1, n1]] = [after.max(1) - 1, after.max(1)].map(|k| self.table[k]);
            (-(n0 + (n1 - n0) * (x - v0) / (v1 - v0))).exp()
        })
    }

    /// Damage of a loop by the rule for values below the knee; `above` computes it from the strain-life curve.
    fn damage_by(&self, value: f64, above: impl Fn(f64) -> f64) -> f64 {
        if !(value > 0.0) {
            return 0.0;
        }
        let straight = |exponent: f64| (value / self.value).powf(exponent) / self.knee;
        match (value > self.value, self.below, self.assessment.judge) {
            (true, _, Judge::Limit(_)) | (false, BelowKnee::Elementary, Judge::Limit(_)) => {
                straight(self.exponent)
            }
            (true, _, Judge::Life(_)) | (false, BelowKnee::Elementary, Judge::Life(_)) => {
                above(value)
            }
            (false, BelowKnee::Original, _) => {
                // The knee itself is on the curve.
                if value == self.value {
                    1.0 / self.knee
                } else {
                    0.0
                }
            }
            (false, BelowKnee::Haibach, _) => straight(2.0 * self.exponent - 1.0),
        }
    }
}

/// Damage of a point.
#[derive(Clone, Debug)]
pub struct PointDamage {
    /// Sum on the worst plane.
    pub damage: f64,
    /// Most that another plane may have more: the sum of the loops, each on its own worst plane, less the
    /// damage; NaN if it was not asked for.
    pub missed: f64,
    /// Normal of the worst plane; NaN without one.
    pub normal: [f64; 3],
    /// Part of each loop in the sum.
    pub parts: Vec<f64>,
    /// Value of each loop on that plane.
    pub values: Vec<f64>,
}

/// Sums the damage of loops at points by Miner's rule, in parallel. `stress` has the shape (loops, instants,
/// points, 6) \[Pa\]. If `bounded`, an upper bound on other planes is computed as well
/// ([`PointDamage::missed`]).
pub fn sum_damage(
    curve: &DamageCurve,
    stress: &ArrayView4<'_, f64>,
    counts: &[f64],
    bounded: bool,
    stop: &AtomicBool,
) -> Result<Vec<PointDamage>, Error> {
    let (loops, instants, points, components) = stress.dim();
    if components != 6 {
        let allowed = "6 long: xx, yy, zz, xy, xz, yz";
        return Err(Error::argument("last axis of stress", components, allowed));
    }
    if instants < 2 {
        return Err(Error::argument(
            "instants of a loop",
            instants,
            "at least 2",
        ));
    }
    if counts.len() != loops {
        return Err(Error::argument(
            "counts",
            counts.len(),
            format!("{loops}, one for each loop"),
        ));
    }
    if let Some(n) = counts.iter().position(|n| !(n.is_finite() && *n >= 0.0)) {
        return Err(Error::argument(
            format!("counts[{n}]"),
            counts[n],
            "0 or more",
        ));
    }
    if let Some(s) = stress.iter().find(|s| !(s.abs() <= 1e75)) {
        return Err(Error::argument("stress", s, "finite, in Pa, up to 1e75"));
    }
    (0..points)
        .into_par_iter()
        .map(|point| {
            if stop.load(Ordering::Relaxed) {
                return Err(Error::Stopped);
            }
            let histories = (0..loops).map(|n| {
                let instant = |t| std::array::from_fn(|c| stress[(n, t, point, c)]);
                let stresses: Vec<StressTensor> = (0..instants).map(instant).collect();
                let mut histories = Histories::new();
                histories.load(&stresses, None);
                histories
            });
            Ok(point_damage(
                curve,
                &histories.collect::<Vec<_>>(),
                counts,
                bounded,
            ))
        })
        .collect()
}

/// Sums the damage at one point on the plane where the sum is largest.
fn point_damage(
    curve: &DamageCurve,
    histories: &[Histories],
    counts: &[f64],
    bounded: bool,
) -> PointDamage {
    let criterion = &curve.assessment.criterion;
    let search = Search::default();
    let mut worker = Worker::default();
    let empty = |h: &Histories| h.max_components().iter().all(|s| *s == 0.0);
    let mut alone = |n: usize| evaluate_point(criterion, &histories[n], &search, &mut worker);
    let finish = |values: Vec<f64>, normal: [f64; 3]| {
        let parts: Vec<f64> = values
            .iter()
            .zip(counts)
            .map(|(value, count)| count * curve.damage(*value))
            .collect();
        PointDamage {
            damage: parts.iter().sum(),
            missed: f64::NAN,
            normal,
            parts,
            values,
        }
    };
    if !criterion.has_plane() {
        let values = (0..histories.len()).map(|n| {
            if empty(&histories[n]) {
                0.0
            } else {
                alone(n).value
            }
        });
        let mut damage = finish(values.collect(), [f64::NAN; 3]);
        damage.missed = 0.0;
        return damage;
    }
    let mut buffers: Vec<ShearBuffers> =
        histories.iter().map(|_| ShearBuffers::default()).collect();
    let mut planes: Vec<_> = histories
        .iter()
        .zip(&mut buffers)
        .map(|(history, buffer)| {
            let Acts::OnPlanes(law) = criterion.acts(history.stress.unit()) else {
                unreachable!("criteria of planes act on planes")
            };
            (!empty(history)).then(|| (OnPlanes::new(law, history, buffer), law))
        })
        .collect();
    let mut sum = |n: [f64; 3]| -> (f64, usize) {
        let (mut total, mut most) = (0.0, (0.0, 0));
        for (k, plane) in planes.iter_mut().enumerate() {
            let Some((plane, law)) = plane else { continue };
            let parts = plane.parts(n);
            let part = counts[k] * curve.quick_damage(law.factor * plane.value(parts));
            total += part;
            most = if part > most.0 { (part, k) } else { most };
        }
        (total, most.1)
    };
    let mut best = ([f64::NAN; 3], 0.0);
    let mut leading: Vec<usize> = Vec::new();
    for n in &FINE.planes {
        let (total, most) = sum(*n);
        if total > best.1 {
            best = (*n, total);
            if !leading.contains(&most) {
                leading.push(most);
            }
        }
    }
    // Loops that lead on the best planes, and the first one where no plane of the grid has damage.
    if leading.is_empty() && !histories.is_empty() {
        leading.push(0);
    }
    for k in leading.iter().rev().take(OWN_PLANES) {
        if !empty(&histories[*k]) {
            let n = alone(*k).normal;
            let total = if n[0].is_nan() { 0.0 } else { sum(n).0 };
            // A plane found by the search is the best one to rounding.
            if total * (1.0 + 1e-7) >= best.1 && total > 0.0 {
                best = (n, total);
            }
        }
    }
    if best.1 > 0.0 {
        best = refine(best, &mut |n| sum(n).0);
    }
    let values = planes.iter_mut().map(|plane| match plane {
        Some((plane, law)) if best.1 > 0.0 => {
            let parts = plane.parts(best.0);
            law.factor * law.combination.criterion_value(parts)
        }
        _ => 0.0,
    });
    let mut damage = finish(values.collect(), best.0);
    if bounded {
        // The search finds the plane of a loop to rounding.
        let bound: f64 = (0..histories.len())
            .filter(|k| !empty(&histories[*k]))
            .map(|k| counts[k] * curve.damage(alone(k).value))
            .sum();
        damage.missed = (bound - damage.damage).max(0.0);
    }
    damage
}

/// Turns a plane with its sum towards larger sums, until they no longer grow.
fn refine(start: ([f64; 3], f64), sum: &mut impl FnMut([f64; 3]) -> f64) -> ([f64; 3], f64) {
    let (mut n, mut most) = start;
    let mut turn = FIRST_TURN;
    while turn > LAST_TURN {
        let axis = if n[0].abs() < 0.6 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        };
        let u = normalize(cross(n, axis));
        let v = cross(n, u);
        debug_assert!(dot(u, v).abs() < 1e-9);
        let neighbour = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
            .map(|(a, b)| {
                let turned: [f64; 3] = std::array::from_fn(|d| n[d] + turn * (a * u[d] + b * v[d]));
                let turned = normalize(turned);
                (turned, sum(turned))
            })
            .into_iter()
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match neighbour {
            Some((turned, larger)) if larger > most * (1.0 + 1e-9) => (n, most) = (turned, larger),
            _ => turn *= 0.4,
        }
    }
    (n, most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::criterion::Criterion;
    use crate::evaluate::evaluate;
    use crate::history::History;
    use crate::life::{Basquin, CoffinManson};
    use ndarray::Array4;

    fn assessments() -> Vec<(Assessment, Option<f64>)> {
        let curve = CoffinManson {
            E: 209e9,
            elastic: Basquin {
                coefficient: 1006e6,
                exponent: -0.0809,
            },
            ductility: 1.104,
            exponent: -0.6207,
        };
        let with = |name: &str, numbers: &[(&str, f64)], judge| Assessment {
            criterion: Criterion::new(name, numbers).unwrap(),
            judge,
        };
        let E = ("E", 209e9);
        vec![
            (
                with("smith_watson_topper", &[E, ("nu", 0.3)], Judge::Life(curve)),
                None,
            ),
            (
                with(
                    "fatemi_socie",
                    &[E, ("nu", 0.3), ("k", 0.6), ("s_y", 4e8)],
                    Judge::Life(curve),
                ),
                None,
            ),
            (
                with(
                    "brown_miller",
                    &[E, ("nu", 0.3), ("S", 0.5)],
                    Judge::Life(curve),
                ),
                None,
            ),
            (with("findley", &[("k", 0.3)], Judge::Limit(2e8)), Some(6.0)),
            (with("matake", &[("k", 0.3)], Judge::Limit(2e8)), Some(6.0)),
            (
                with("crossland", &[("alpha", 0.3)], Judge::Limit(2e8)),
                Some(6.0),
            ),
        ]
    }

    fn random(loops: usize, points: usize, seed: u64) -> Array4<f64> {
        let mut random = fastrand::Rng::with_seed(seed);
        Array4::from_shape_fn((loops, 2, points, 6), |_| 8e8 * (random.f64() - 0.5))
    }

    #[test]
    fn one_loop_is_the_criterion_on_its_cycle() {
        let never = AtomicBool::new(false);
        let stress = random(1, 40, 7);
        let cycle = stress.index_axis(ndarray::Axis(0), 0);
        for (assessment, exponent) in assessments() {
            let curve =
                DamageCurve::new(&assessment, BelowKnee::Elementary, 1e6, exponent).unwrap();
            let damage = sum_damage(&curve, &stress.view(), &[3.0], true, &never).unwrap();
            let search = Search::default();
            let results = evaluate(
                &assessment.criterion,
                &History::elastic(&cycle),
                &search,
                &never,
            )
            .unwrap();
            for (damage, result) in damage.iter().zip(&results) {
                let exact = 3.0 * curve.damage(result.value);
                let error = (damage.damage - exact).abs();
                assert!(
                    error <= 1e-9 * exact,
                    "{:?} {} {exact}",
                    assessment.criterion,
                    damage.damage
                );
            }
        }
    }

    #[test]
    fn no_plane_of_a_fine_grid_has_more() {
        let never = AtomicBool::new(false);
        let stress = random(5, 12, 3);
        let counts = [1.0, 20.0, 0.5, 4.0, 100.0];
        let (assessment, _) = &assessments()[0];
        let curve = DamageCurve::new(assessment, BelowKnee::Haibach, 1e6, None).unwrap();
        let damage = sum_damage(&curve, &stress.view(), &counts, true, &never).unwrap();
        // Normal strain range and largest normal stress on planes of a spiral.
        let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        for (point, damage) in damage.iter().enumerate() {
            let mut largest: f64 = 0.0;
            for k in 0..20_000 {
                let z = (f64::from(k) + 0.5) / 20_000.0;
                let (r, phi) = ((1.0 - z * z).sqrt(), turn * f64::from(k));
                let n = [r * phi.cos(), r * phi.sin(), z];
                let sum = (0..5).map(|l| {
                    let normal = |t: usize| {
                        let s = |c: usize| stress[(l, t, point, c)];
                        let along = n[0] * n[0] * s(0)
                            + n[1] * n[1] * s(1)
                            + n[2] * n[2] * s(2)
                            + 2.0 * (n[0] * n[1] * s(3) + n[0] * n[2] * s(4) + n[1] * n[2] * s(5));
                        let strain = (1.3 * along - 0.3 * (s(0) + s(1) + s(2))) / 209e9;
                        (along, strain)
                    };
                    let ((a, ea), (b, eb)) = (normal(0), normal(1));
                    counts[l] * curve.damage(a.max(b) * 0.5 * (ea - eb).abs())
                });
                largest = largest.max(sum.sum());
            }
            assert!(
                damage.damage >= 0.9999 * largest,
                "{} {largest}",
                damage.damage
            );
            assert!(damage.damage <= 1.01 * largest);
            assert!(damage.missed >= 0.0);
            assert!((damage.parts.iter().sum::<f64>() / damage.damage - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn laws_below_the_knee_differ_there_alone() {
        for (assessment, exponent) in assessments() {
            let by = |below| DamageCurve::new(&assessment, below, 1e6, exponent).unwrap();
            let [original, elementary, haibach] = [
                BelowKnee::Original,
                BelowKnee::Elementary,
                BelowKnee::Haibach,
            ]
            .map(by);
            let knee = original.value_at_knee();
            assert!((elementary.damage(1.1 * knee) - haibach.damage(1.1 * knee)).abs() == 0.0);
            assert_eq!(original.damage(0.8 * knee), 0.0);
            let [e, h] = [elementary.damage(0.8 * knee), haibach.damage(0.8 * knee)];
            assert!(h < e && h > 0.0, "{e} {h}");
            assert!((haibach.damage(knee) * 1e6 - 1.0).abs() < 1e-6);
            assert!(
                (original.quick_damage(1.3 * knee) / original.damage(1.3 * knee) - 1.0).abs()
                    < 1e-4
            );
        }
    }
}
