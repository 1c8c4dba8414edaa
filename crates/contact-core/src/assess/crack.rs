//! Stress intensity of cracks below a contact, over the states of a cycle.
//!
//! The stress of the body without the crack is asked for along the crack's line once for all
//! lengths; the crate [`fracture`] does the rest. Plane strain in the plane y = 0 of the contact.

use fracture::{Crack, Faces, Intensity, Path, PlaneStress, Point};
use rayon::prelude::*;

use crate::error::Error;
use crate::fields::{Depth, Points, Side, States};
use crate::scene::Body;
use crate::scene::Grid;

/// Step of ln(distance from the mouth) between samples of the stress along the line.
const STEP: f64 = 0.15;
/// The shortest distance from the mouth at which the stress is sampled, over the shortest crack.
const NEAREST: f64 = 1e-3;
/// Samples that an interpolation takes.
const POINTS: usize = 6;
/// Relative error of K from the sampling: bound of 7e-6 found under a sliding contact.
const SAMPLES: f64 = 2e-5;
/// Step of the quadrature along the crack: K within 1e-4 in closed cracks.
const QUADRATURE: f64 = 0.12;
/// Change of K by a layer for each unit of Dundurs' alpha, tip at the interface: largest of the
/// table of partial cracks in a film (|alpha| to 0.8), rounded up.
const LAYERED: f64 = 1.2;

/// The corresponding error of the core.
pub fn refused(error: fracture::Error) -> Error {
    match error {
        fracture::Error::Invalid {
            key,
            value,
            allowed,
        } => Error::invalid(key, value, allowed),
        other => Error::invalid("crack", other.to_string(), "one whose faces settle"),
    }
}

/// Cracks from one place, at one angle, of several lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Cracks {
    /// Place of the mouth along x \[m\].
    pub x: f64,
    /// Angle from the inward normal, positive towards +x \[rad\] (default 0).
    pub angle: f64,
    /// Lengths \[m\], ascending.
    pub lengths: Vec<f64>,
    /// Coefficient of friction between the faces (default 0).
    pub friction: f64,
}

/// A crack of one length over the states.
#[derive(Clone, Debug, PartialEq)]
pub struct OverCycle {
    /// K with faces that touch, in each state; the error has the quadrature's part, that of the
    /// tractions within the cells and that of layers of other materials.
    pub faces: Vec<Intensity>,
    /// K with faces that may pass through each other.
    pub linear: Vec<Intensity>,
    /// Share of the crack that is open, in each state.
    pub open: Vec<f64>,
}

/// K of the cracks in the body `side` under each of the states, one length after the other.
///
/// K is that of a crack in a homogeneous half-plane under the stress of the layered body. Where
/// layers differ, the error includes the change of K of published partial cracks in films.
pub fn over_cycle(
    body: &Body,
    side: Side,
    grid: &Grid,
    states: &States<'_>,
    cracks: &Cracks,
) -> Result<Vec<OverCycle>, Error> {
    let longest = cracks.lengths.iter().copied().fold(0.0, f64::max);
    let shortest = cracks.lengths.iter().copied().fold(f64::INFINITY, f64::min);
    if cracks.lengths.is_empty() || !(shortest > 0.0 && longest.is_finite()) {
        let found = format!("{:?}", cracks.lengths);
        return Err(Error::invalid("lengths of the crack", found, "above 0 m"));
    }
    let unit = Path::straight(cracks.x, longest, cracks.angle);
    let unit = Crack::with_step(unit, QUADRATURE).map_err(refused)?;
    let line = Line::new(body, cracks, (NEAREST * shortest, longest));
    let sampled = line.sample(body, side, grid, states)?;
    // Constant tractions: the difference estimates the error of the tractions within the cells.
    let plain = States {
        stick: None,
        ..states.clone()
    };
    let plain = match states.stick {
        Some(_) => Some(line.sample(body, side, grid, &plain)?),
        None => None,
    };
    let of = |length: &f64| {
        let crack = unit.similar(cracks.x, *length).map_err(refused)?;
        let layers = layered(body, *length * cracks.angle.cos());
        let points = crack.points();
        let mut faces = Faces::new(&crack, cracks.friction).map_err(refused)?;
        let mut over = OverCycle {
            faces: Vec::new(),
            linear: Vec::new(),
            open: Vec::new(),
        };
        for (n, state) in sampled.iter().enumerate() {
            let stress = line.along(state, &points);
            let mut linear = crack.intensity(&stress).map_err(refused)?;
            if let Some(plain) = &plain {
                let other = crack
                    .intensity(&line.along(&plain[n], &points))
                    .map_err(refused)?;
                linear.error += (linear.K_I - other.K_I).hypot(linear.K_II - other.K_II);
            }
            linear.error += (layers + SAMPLES) * linear.K_I.hypot(linear.K_II);
            faces = faces.next(&stress).map_err(refused)?;
            let mut k = faces.intensity;
            k.error = k.error.max(linear.error);
            over.open.push(faces.open_share().map_err(refused)?);
            over.faces.push(k);
            over.linear.push(linear);
        }
        Ok(over)
    };
    cracks.lengths.par_iter().map(of).collect()
}

/// Relative error of K in the homogeneous half-plane where the materials of the layers differ: with
/// the largest Dundurs' alpha of an interface and the depth of the tip over that of the interface.
fn layered(body: &Body, depth: f64) -> f64 {
    let modulus = |m: crate::scene::Elastic| m.E / (1.0 - m.nu * m.nu);
    let below = body.coatings.iter().skip(1).map(|c| c.material);
    let below = below.chain([body.substrate]);
    let mut error = 0.0_f64;
    for ((coating, next), z) in body.coatings.iter().zip(below).zip(body.interfaces()) {
        let (a, b) = (modulus(coating.material), modulus(next));
        let alpha = if b.is_finite() {
            (a - b) / (a + b)
        } else {
            -1.0
        };
        error = error.max(LAYERED * alpha.abs() * (depth / z).min(z / depth));
    }
    error
}

/// The line of cracks and the distances from the mouth at which the stress is sampled.
struct Line {
    mouth: f64,
    angle: f64,
    /// Layer by layer: distances and the layer's number.
    parts: Vec<(Vec<f64>, usize)>,
}

/// Stress at the distances of each part.
type Sampled = Vec<Vec<PlaneStress>>;

impl Line {
    fn new(body: &Body, cracks: &Cracks, (from, to): (f64, f64)) -> Self {
        let cos = cracks.angle.cos();
        let mut parts = Vec::new();
        let mut start = from;
        let ends = body.interfaces().into_iter().map(|z| z / cos);
        for (layer, end) in ends.chain([f64::INFINITY]).enumerate() {
            let stop = end.min(to);
            if stop > start {
                let steps = ((stop / start).ln() / STEP).ceil().max(POINTS as f64 - 1.0);
                let ratio = (stop / start).powf(1.0 / steps);
                let s = (0..=steps as i32).map(|n| start * ratio.powi(n));
                parts.push((s.collect(), layer));
                start = stop;
            }
        }
        Self {
            mouth: cracks.x,
            angle: cracks.angle,
            parts,
        }
    }

    /// The stress of each state; in body 1 in the frame of x and its own depth.
    fn sample(
        &self,
        body: &Body,
        side: Side,
        grid: &Grid,
        states: &States<'_>,
    ) -> Result<Vec<Sampled>, Error> {
        let (sin, cos) = self.angle.sin_cos();
        let bottoms = body.interfaces();
        let place = |s: f64, layer: usize| {
            // A sample on an interface must stay in its layer in spite of rounding.
            let top = layer.checked_sub(1).map_or(0.0, |n| bottoms[n]);
            let bottom = bottoms.get(layer).copied().unwrap_or(f64::INFINITY);
            let z = (s * cos).clamp(top, bottom);
            (self.mouth + s * sin, 0.0, Depth { z, layer })
        };
        let places: Vec<_> = self
            .parts
            .iter()
            .flat_map(|(s, layer)| s.iter().map(move |s| place(*s, *layer)))
            .collect();
        let sign = if side == Side::Body1 { -1.0 } else { 1.0 };
        let all = Points::new(body, side, grid, states.clone())?.stress(&places)?;
        let of_state = |state: Vec<[f64; 6]>| {
            let mut stress = state.into_iter().map(|s| [s[0], s[2], sign * s[4]]);
            let part = |(s, _): &(Vec<f64>, usize)| stress.by_ref().take(s.len()).collect();
            self.parts.iter().map(part).collect()
        };
        Ok(all.into_iter().map(of_state).collect())
    }

    /// The stress of a state at points of a crack: polynomials in ln(s), constant towards the
    /// mouth.
    fn along(&self, state: &Sampled, points: &[Point]) -> Vec<PlaneStress> {
        let at = |point: &Point| {
            let holds = |part: &(Vec<f64>, usize)| point.s <= part.0[part.0.len() - 1];
            let n = self
                .parts
                .iter()
                .position(holds)
                .unwrap_or(self.parts.len() - 1);
            interpolated(&self.parts[n].0, &state[n], point.s)
        };
        points.iter().map(at).collect()
    }
}

/// Lagrange's polynomial in ln(s) through the nearest samples; `s` is evenly spaced in it.
fn interpolated(s: &[f64], stress: &[PlaneStress], at: f64) -> PlaneStress {
    let last = s.len() - 1;
    let ratio = (s[last] / s[0]).ln() / last as f64;
    let u = ((at / s[0]).ln() / ratio).clamp(0.0, last as f64);
    let first = (u as usize + 1)
        .saturating_sub(POINTS / 2)
        .min(s.len() - POINTS);
    let mut sum = [0.0; 3];
    for k in first..first + POINTS {
        let others = (first..first + POINTS).filter(|j| *j != k);
        let weight: f64 = others
            .map(|j| (u - j as f64) / (k as f64 - j as f64))
            .product();
        for (sum, value) in sum.iter_mut().zip(stress[k]) {
            *sum += weight * value;
        }
    }
    sum
}
