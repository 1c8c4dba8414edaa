//! Whether a crack stops.

use super::Error;
use super::curve::Curve;
use super::threshold::Threshold;

/// Parts into which a piece of a curve is divided to find where it crosses the threshold.
const PARTS: usize = 8;
/// Halvings of a part.
const HALVINGS: usize = 50;

/// The fate of a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// It does not grow from its first length.
    Dormant,
    /// It stops at a length \[m\].
    Stops(f64),
    /// It grows up to the last length of the curve.
    Grows,
}

/// Growth against the threshold along a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrest {
    /// The fate of the crack.
    pub verdict: Verdict,
    /// Lengths of the whole curve at which the range of K crosses the threshold \[m\]: down, up, ...
    /// or up, down, ...
    pub crossings: Vec<f64>,
    /// Range of K over its threshold at the first length; above 1 the crack grows from there.
    pub at_start: f64,
    /// Smallest range of K over its threshold from the first length on; below 1 the crack stops.
    pub margin: f64,
    /// Length at which it is smallest \[m\].
    pub margin_at: f64,
}

impl Curve {
    /// Range of K at R = 0 over its threshold at a length \[m\].
    pub fn over_threshold(&self, threshold: &Threshold, l: f64) -> f64 {
        threshold.equivalent(self.at(l)) / threshold.at_length(l)
    }

    /// Whether a crack of the length `from` \[m\] grows, and where it stops: at the first length at
    /// which the range of K falls below its threshold.
    pub fn arrest(&self, threshold: &Threshold, from: f64) -> Result<Arrest, Error> {
        threshold.check()?;
        self.check("first length of the crack", from)?;
        let excess = |l: f64| self.over_threshold(threshold, l) - 1.0;
        let places = self.places(from);
        let values: Vec<f64> = places.iter().map(|l| excess(*l)).collect();
        let start = places.partition_point(|l| *l < from);
        let mut crossings = Vec::new();
        let mut stop = None;
        for n in 1..places.len() {
            if (values[n - 1] > 0.0) != (values[n] > 0.0) {
                let l = crossing(&excess, places[n - 1], places[n]);
                if n > start && values[n - 1] > 0.0 && stop.is_none() {
                    stop = Some(l);
                }
                crossings.push(l);
            }
        }
        let (margin, margin_at) = smallest(&excess, &places[start..], &values[start..]);
        let verdict = match stop {
            _ if values[start] <= 0.0 => Verdict::Dormant,
            Some(l) => Verdict::Stops(l),
            None => Verdict::Grows,
        };
        Ok(Arrest {
            verdict,
            crossings,
            at_start: values[start] + 1.0,
            margin: margin + 1.0,
            margin_at,
        })
    }

    /// The lengths at which the curve is evaluated, from the length `from` on \[m\].
    fn places(&self, from: f64) -> Vec<f64> {
        let (before, after): (Vec<f64>, Vec<f64>) = self.lengths().iter().partition(|l| **l < from);
        let after = after.into_iter().filter(|l| *l > from);
        let knots: Vec<f64> = before.into_iter().chain([from]).chain(after).collect();
        let mut places = vec![knots[0]];
        for pair in knots.windows(2) {
            let part = (pair[1] / pair[0]).powf(1.0 / PARTS as f64);
            places.extend((1..PARTS).map(|n| pair[0] * part.powi(n as i32)));
            places.push(pair[1]);
        }
        places
    }
}

/// The place between `low` and `high` at which f changes its sign, by bisection.
fn crossing(f: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let begins = f(low) > 0.0;
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if (f(middle) > 0.0) == begins {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low * high).sqrt()
}

/// The smallest value and its place, by a parabola through its neighbours where there are two.
fn smallest(f: &impl Fn(f64) -> f64, places: &[f64], values: &[f64]) -> (f64, f64) {
    let mut least = 0;
    for n in 1..values.len() {
        if values[n] < values[least] {
            least = n;
        }
    }
    let here = (values[least], places[least]);
    if least == 0 || least + 1 == values.len() {
        return here;
    }
    let x = |n: usize| (places[n] / places[least]).ln();
    let (a, b) = (x(least - 1), x(least + 1));
    let (fa, fb) = (values[least - 1] - here.0, values[least + 1] - here.0);
    let curvature = (fa / a - fb / b) / (a - b);
    let slope = fa / a - curvature * a;
    let l = places[least] * (-slope / (2.0 * curvature)).exp();
    if l > places[least - 1] && l < places[least + 1] && f(l) < here.0 {
        return (f(l), l);
    }
    here
}
