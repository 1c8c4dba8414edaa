//! Quadrature along a crack: dislocations and the points between them.
//!
//! The leg at the tip is mapped by s = L (1 - w^2), w = tanh(t/2), t from 0 at the tip on; the
//! density D = f/w has its root singularity at the tip, and the even continuation of f over t < 0
//! makes the trapezoidal rule in t with the points halfway exponentially convergent in the step: a
//! corner, a mouth or a load on the surface is an end in t, which geometric spacing resolves
//! whatever power of the distance the stress goes with. Other legs have such an end at both sides:
//! s = L/(1 + exp t). From the tip to the mouth dislocations and points take turns along the whole
//! crack.
//!
//! Every third dislocation and every third point make the same rule of three times the step; the
//! difference of the two is the estimated error.

use num_complex::Complex64;

use super::path::{Leg, Path};

/// Range of t to the mouth, where D is finite: what is left out is 4 exp(-20) of the leg, 8e-9.
const TO_MOUTH: f64 = 20.0;
/// Range of t to a kink, where D goes with a power of the distance above -1/2.
const TO_KINK: f64 = 24.0;

/// A dislocation or a point of the rule; places relative to the mouth, over the length of the
/// crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    /// Place x + i z.
    pub(crate) at: Complex64,
    /// Angle from the inward normal \[rad\].
    pub(crate) angle: f64,
    /// Distance from the mouth along the crack.
    pub(crate) s: f64,
    /// Direction of the crack as a unit number.
    pub(crate) along: Complex64,
    /// Weight of the density's regular part: ds times the singular factor of the density.
    pub(crate) weight: f64,
}

/// The rule of a path of unit length.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    /// Dislocations from the tip to the mouth.
    pub(crate) dislocations: Vec<Knot>,
    /// Points from the tip to the mouth; point k lies beyond dislocation k.
    pub(crate) points: Vec<Knot>,
    /// Length of the leg at the tip over the length of the crack.
    pub(crate) tip_leg: f64,
    /// The legs from the tip to the mouth.
    pub(crate) stretches: Vec<Stretch>,
    /// Step of t.
    pub(crate) step: f64,
}

/// The part of a rule on one leg: the point `first` + k lies at t = `start` + (k + 1/2) step.
#[derive(Clone, Debug)]
pub(crate) struct Stretch {
    /// Index of its first point, and their number.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// First value of t.
    pub(crate) start: f64,
    /// Begin and length over the length of the crack.
    pub(crate) from: f64,
    pub(crate) length: f64,
    /// Whether the crack ends with it.
    pub(crate) tip: bool,
}

/// Step of t that resolves a path: kernels and stresses are analytic in a strip whose half-width is
/// the angle between crack and surface, or 180 degrees less the kink.
pub(crate) fn step(path: &Path) -> f64 {
    let first = path.legs.first().map_or(0.0, |leg| leg.start);
    let to_surface = std::f64::consts::FRAC_PI_2 - first.abs();
    let narrowest = to_surface.min(std::f64::consts::PI - path.sharpest_kink());
    (0.3 * narrowest).clamp(0.02, 0.08)
}

impl Rule {
    /// Places dislocations and points along a path, with `step` as the distance of their parameter.
    pub(crate) fn new(path: &Path, step: f64) -> Self {
        let length = path.length();
        let (mut dislocations, mut points) = (Vec::new(), Vec::new());
        let mut stretches = Vec::new();
        let mut starts = Vec::with_capacity(path.legs.len());
        let (mut from, mut corner) = (0.0, Complex64::default());
        for leg in &path.legs {
            starts.push((from, corner));
            from += leg.length();
            corner += leg.at(leg.length()).0;
        }
        for (n, (leg, (from, corner))) in path.legs.iter().zip(starts).enumerate().rev() {
            let tip = n + 1 == path.legs.len();
            let far = if n == 0 { TO_MOUTH } else { TO_KINK };
            let near = if tip { 0.0 } else { TO_KINK };
            // A multiple of three, so that every third makes a rule, too.
            let count = 3 * ((far + near) / (3.0 * step)).ceil() as usize;
            let start = -near;
            stretches.push(Stretch {
                first: points.len(),
                count,
                start,
                from: from / length,
                length: leg.length() / length,
                tip,
            });
            for j in 0..count {
                let half = if tip && j == 0 { 0.5 } else { 1.0 };
                let knot = |t: f64, weight: f64| {
                    let (s, derivative) = place(leg.length(), t, tip);
                    let (offset, angle) = leg.at(s);
                    Knot {
                        at: (corner + offset) / length,
                        angle,
                        s: (from + s) / length,
                        along: Complex64::new(angle.sin(), angle.cos()),
                        weight: derivative * weight / length,
                    }
                };
                dislocations.push(knot(start + step * j as f64, half * step));
                points.push(knot(start + step * (j as f64 + 0.5), step));
            }
        }
        Self {
            dislocations,
            points,
            tip_leg: path.legs.last().map_or(0.0, Leg::length) / length,
            stretches,
            step,
        }
    }

    /// This rule with steps three times as long (every third dislocation and point), for the error of the
    /// quadrature.
    pub(crate) fn coarse(&self) -> Self {
        let tripled = |knot: &Knot| Knot {
            weight: 3.0 * knot.weight,
            ..*knot
        };
        Self {
            dislocations: self.dislocations.iter().step_by(3).map(tripled).collect(),
            points: self.points.iter().skip(1).step_by(3).map(tripled).collect(),
            tip_leg: self.tip_leg,
            stretches: Vec::new(),
            step: 3.0 * self.step,
        }
    }
}

/// Distance from the start of the leg, and its derivative by t, at the parameter t; at a `tip` with the
/// singularity of the density taken out.
fn place(length: f64, t: f64, tip: bool) -> (f64, f64) {
    if tip {
        let s = length / (0.5 * t).cosh().powi(2);
        return (s, s);
    }
    let e = t.exp();
    (length / (1.0 + e), length * e / (1.0 + e).powi(2))
}

/// Distance from the begin of a leg at t, which is even at the tip.
pub(crate) fn distance(stretch: &Stretch, t: f64) -> f64 {
    place(stretch.length, t, stretch.tip).0
}

/// The variable t after the length `s` of a crack of unit length; `None` outside of the leg's points.
pub(crate) fn variable(stretch: &Stretch, s: f64) -> Option<f64> {
    let ratio = stretch.length / (s - stretch.from);
    let t = if stretch.tip {
        2.0 * ratio.sqrt().acosh()
    } else {
        (ratio - 1.0).ln()
    };
    (t.is_finite() && t != 0.0 && t.abs() < TO_KINK).then_some(t)
}
