//! Line of a crack: legs that meet in kinks, each straight or gently curved.

use std::f64::consts::FRAC_PI_2;

use num_complex::Complex64;

use super::Error;
use super::stress::Point;

/// Largest angle of a crack from the inward normal \[rad\], 80 degrees: flatter ones run along the
/// surface, where the quadrature along the crack loses its digits.
pub(crate) const FLATTEST: f64 = 80.0 * FRAC_PI_2 / 90.0;
/// Most legs of a path.
const MOST_LEGS: usize = 40;

/// Parts of a piece, at whose ends a depth is compared to find the crossings of the piece.
const SUBDIVISIONS: u32 = 16;

/// The place at which a condition that holds at `low` ceases to hold, to rounding.
fn bisect(holds: impl Fn(f64) -> bool, (mut low, mut high): (f64, f64)) -> f64 {
    while high - low > 1e-14 * high {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// A part of a crack without a kink.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Angle from the inward normal where it begins, positive towards +x \[rad\].
    pub start: f64,
    /// Pieces: length \[m\] and angle at the end \[rad\]; the angle changes linearly along a piece.
    pub pieces: Vec<(f64, f64)>,
}

impl Leg {
    /// A straight leg.
    pub fn straight(length: f64, angle: f64) -> Self {
        Self {
            start: angle,
            pieces: vec![(length, angle)],
        }
    }

    /// Length \[m\].
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(|p| p.0).sum()
    }

    /// Angle where it ends \[rad\].
    pub fn end(&self) -> f64 {
        self.pieces.last().map_or(self.start, |p| p.1)
    }

    /// Offset x + i z \[m\] from its begin and angle \[rad\] after the length `s` \[m\] of the piece.
    pub(crate) fn at(&self, s: f64) -> (Complex64, f64) {
        let (mut from, mut angle, mut offset) = (0.0, self.start, Complex64::default());
        let last = self.pieces.len().saturating_sub(1);
        for (n, (length, end)) in self.pieces.iter().enumerate() {
            let rest = s - from;
            if rest <= *length || n == last {
                let turned = angle + (end - angle) * rest / length;
                return (offset + arc(rest, angle, turned), turned);
            }
            offset += arc(*length, angle, *end);
            (from, angle) = (from + length, *end);
        }
        (offset, angle)
    }
}

/// Chord (x + i z) of a piece of the length `s` whose angle goes linearly from `a` to `b`; Gauss's
/// rule of five points, exact to rounding for turns below 1 rad.
fn arc(s: f64, a: f64, b: f64) -> Complex64 {
    const RULE: [(f64, f64); 5] = [
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let direction = |angle: f64| Complex64::new(angle.sin(), angle.cos());
    if a == b {
        return direction(a) * s;
    }
    let (middle, half) = (f64::midpoint(a, b), (b - a) / 2.0);
    let sum: Complex64 = RULE
        .iter()
        .map(|(u, w)| direction(middle + half * u) * *w)
        .sum();
    sum * (s / 2.0)
}

/// A crack's line from its mouth on the surface to its tip.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Place of the mouth along the surface \[m\].
    pub mouth: f64,
    /// Legs from the mouth to the tip.
    pub legs: Vec<Leg>,
}

impl Path {
    /// A straight crack of the length `length` \[m\] from x = `mouth` \[m\] at `angle` \[rad\] from
    /// the inward normal, positive towards +x.
    pub fn straight(mouth: f64, length: f64, angle: f64) -> Self {
        Self {
            mouth,
            legs: vec![Leg::straight(length, angle)],
        }
    }

    /// A crack of straight legs, each (length \[m\], angle \[rad\]).
    pub fn kinked(mouth: f64, legs: &[(f64, f64)]) -> Self {
        let legs = legs.iter().map(|(l, angle)| Leg::straight(*l, *angle));
        Self {
            mouth,
            legs: legs.collect(),
        }
    }

    /// Length from the mouth to the tip along the crack \[m\].
    pub fn length(&self) -> f64 {
        self.legs.iter().map(Leg::length).sum()
    }

    /// The largest change of direction between two legs \[rad\].
    pub fn sharpest_kink(&self) -> f64 {
        let turns = self.legs.windows(2);
        turns
            .map(|legs| (legs[1].start - legs[0].end()).abs())
            .fold(0.0, f64::max)
    }

    /// The path from the mouth to the length `s` \[m\].
    #[must_use]
    pub fn up_to(&self, s: f64) -> Self {
        // What rounding leaves of a length is no piece.
        let least = 1e-12 * s;
        let mut rest = s;
        let mut part = Self {
            mouth: self.mouth,
            legs: Vec::new(),
        };
        for leg in &self.legs {
            let mut kept = Leg {
                start: leg.start,
                pieces: Vec::new(),
            };
            for (length, end) in &leg.pieces {
                if rest <= least {
                    break;
                }
                if rest < length - least {
                    let turned = kept.end() + (end - kept.end()) * rest / length;
                    kept.pieces.push((rest, turned));
                } else {
                    kept.pieces.push((*length, *end));
                }
                rest -= length;
            }
            if !kept.pieces.is_empty() {
                part.legs.push(kept);
            }
        }
        part
    }

    /// Lengths from the mouth at which its pieces end \[m\], ascending, the last at the tip.
    pub fn ends(&self) -> Vec<f64> {
        let pieces = self.legs.iter().flat_map(|leg| &leg.pieces);
        let sum = |sum: &mut f64, (length, _): &(f64, f64)| {
            *sum += length;
            Some(*sum)
        };
        pieces.scan(0.0, sum).collect()
    }

    /// Lengths from the mouth at which it crosses the depth `z` \[m\], ascending.
    pub fn crossings(&self, z: f64) -> Vec<f64> {
        let below = |s: f64| self.at(s).z > z;
        let mut crossings = Vec::new();
        let mut from = 0.0;
        for to in self.ends() {
            let length = |n: u32| from + (to - from) * f64::from(n) / f64::from(SUBDIVISIONS);
            for n in 0..SUBDIVISIONS {
                let (low, high) = (length(n), length(n + 1));
                let begins = below(low);
                if begins != below(high) {
                    crossings.push(bisect(|s| below(s) == begins, (low, high)));
                }
            }
            from = to;
        }
        crossings
    }

    /// The tip.
    pub fn tip(&self) -> Point {
        self.at(self.length())
    }

    /// The point at the length `s` \[m\] from the mouth.
    pub fn at(&self, s: f64) -> Point {
        let (mut from, mut at) = (0.0, Complex64::new(self.mouth, 0.0));
        let last = self.legs.len().saturating_sub(1);
        let mut angle = 0.0;
        for (n, leg) in self.legs.iter().enumerate() {
            let length = leg.length();
            if s - from <= length || n == last {
                let (offset, turned) = leg.at(s - from);
                (at, angle) = (at + offset, turned);
                break;
            }
            at += leg.at(length).0;
            from += length;
        }
        Point {
            x: at.re,
            z: at.im,
            angle,
            s,
        }
    }

    /// Fails at lengths and angles that no crack has.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if !self.mouth.is_finite() {
            return Err(Error::invalid(
                "x of the crack",
                self.mouth,
                "a finite place in m",
            ));
        }
        if self.legs.is_empty() || self.legs.len() > MOST_LEGS {
            let allowed = format!("1 to {MOST_LEGS}");
            return Err(Error::invalid(
                "legs of the crack",
                self.legs.len(),
                allowed,
            ));
        }
        for leg in &self.legs {
            for length in leg.pieces.iter().map(|p| p.0).chain([leg.length()]) {
                if !(length > 0.0 && length.is_finite()) {
                    return Err(Error::invalid("length of the crack", length, "above 0 m"));
                }
            }
        }
        let first = self.legs.first().map_or(0.0, |leg| leg.start);
        if !(first.abs() <= FLATTEST) {
            let allowed = format!(
                "in radians, from {:.4} to {FLATTEST:.4} (80 degrees) from the inward normal at the mouth",
                -FLATTEST
            );
            return Err(Error::invalid("angle of the crack", first, allowed));
        }
        let total = self.length();
        for n in 1..=400 {
            let point = self.at(total * f64::from(n) / 400.0);
            if !(point.z > 0.0) {
                let place = format!("depth of the crack after {:.4e} m", point.s);
                return Err(Error::invalid(place, point.z, "above 0 m"));
            }
        }
        Ok(())
    }
}
