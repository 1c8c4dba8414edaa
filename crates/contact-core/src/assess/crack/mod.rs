//! Stress intensity of cracks below a contact, over the states of a cycle.
//!
//! The stress of the body without the crack is asked for along the crack's line once for all lengths; the
//! crate [`fracture`] does the rest. Plane strain in the plane of the crack.

mod along;
mod grown;

use std::collections::HashMap;

use fracture::{Crack, Faces, Intensity, Path};
use rayon::prelude::*;

use self::along::{Along, Line, Which};
use crate::error::Error;
use crate::fields::{Points, Side, States};
use crate::scene::{Body, Grid};

pub use grown::{Grown, Growth, direction_named, grown};

/// The shortest distance from the mouth at which the stress is sampled, over the shortest crack.
const NEAREST: f64 = 1e-3;
/// Relative error of K that the samples leave: 7e-6 under a sliding contact at most.
const SAMPLES: f64 = 2e-5;
/// Step of the quadrature along the crack: K within 1e-4 in closed cracks.
const QUADRATURE: f64 = 0.12;
/// Change of K by a layer for each unit of Dundurs' alpha, tip at the interface: largest of the table of
/// partial cracks in a film (|alpha| to 0.8), rounded up.
const LAYERED: f64 = 1.2;

/// The error of the core that says the same.
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

/// Cracks from one place, of several lengths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cracks {
    /// Place of the mouth along x, or along the plane of the cracks \[m\].
    pub x: f64,
    /// Angle from the inward normal, positive towards +x \[rad\] (default 0).
    pub angle: f64,
    /// Length \[m\] after which cracks go on at another angle \[rad\] (default: they are straight).
    pub kink: Option<(f64, f64)>,
    /// Angle of the plane of the cracks about the axis of depth from that of x \[rad\] (default 0); x is
    /// the distance from the axis along it.
    pub azimuth: f64,
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

/// The contact below which cracks run.
#[derive(Clone, Copy, Debug)]
pub struct Below<'a> {
    /// The body.
    pub body: &'a Body,
    /// Which of the two it is.
    pub side: Side,
    /// The grid of the tractions.
    pub grid: &'a Grid,
}

impl<'a> Below<'a> {
    /// The stress where cracks run, in the plane at an azimuth.
    fn along(&self, states: &States<'_>, azimuth: f64, nearest: f64) -> Result<Along<'a>, Error> {
        if self.grid.plane_strain && azimuth != 0.0 {
            let allowed = "0 in plane strain, where cracks run along y";
            return Err(Error::invalid("azimuth", azimuth, allowed));
        }
        if !azimuth.is_finite() {
            return Err(Error::invalid("azimuth", azimuth, "a finite angle in rad"));
        }
        Ok(Along {
            body: self.body,
            side: self.side,
            points: Points::new(self.body, self.side, self.grid, states.clone())?,
            azimuth,
            nearest,
            known: HashMap::new(),
        })
    }
}

impl Cracks {
    /// The longest of the cracks.
    fn path(&self, longest: f64) -> Path {
        match self.kink {
            Some((first, angle)) if first < longest => {
                let legs = [(first, self.angle), (longest - first, angle)];
                Path::kinked(self.x, &legs)
            }
            _ => Path::straight(self.x, longest, self.angle),
        }
    }
}

/// K of the cracks below a contact under each of the states, one length after the other.
///
/// K is that of a crack in the homogeneous half-plane of whatever material, under the stress of the
/// layered body; where layers differ its error grows by what published partial cracks in films change.
pub fn over_cycle(
    below: &Below<'_>,
    states: &States<'_>,
    cracks: &Cracks,
) -> Result<Vec<OverCycle>, Error> {
    let longest = cracks.lengths.iter().copied().fold(0.0, f64::max);
    let shortest = cracks.lengths.iter().copied().fold(f64::INFINITY, f64::min);
    if cracks.lengths.is_empty() || !(shortest > 0.0 && longest.is_finite()) {
        let found = format!("{:?}", cracks.lengths);
        return Err(Error::invalid("lengths of the crack", found, "above 0 m"));
    }
    if let Some((first, _)) = cracks.kink
        && !(first > 0.0 && first.is_finite())
    {
        return Err(Error::invalid(
            "length of the crack to its kink",
            first,
            "above 0 m",
        ));
    }
    let path = cracks.path(longest);
    // Straight ones are alike.
    let unit = Path::straight(cracks.x, longest, cracks.angle);
    let unit = Crack::with_step(unit, QUADRATURE).map_err(refused)?;
    let line = below
        .along(states, cracks.azimuth, NEAREST * shortest)?
        .on(&path)?;
    let of = |length: &f64| {
        let part = path.up_to(*length);
        let crack = if part.legs.len() > 1 {
            Crack::with_step(part, QUADRATURE)
        } else {
            unit.similar(cracks.x, *length)
        };
        let crack = crack.map_err(refused)?;
        on_line(below.body, &line, &crack, cracks.friction)
    };
    cracks.lengths.par_iter().map(of).collect()
}

/// A crack under the stress along its line.
fn on_line(body: &Body, line: &Line, crack: &Crack, friction: f64) -> Result<OverCycle, Error> {
    let layers = layered(body, crack.path().tip().z);
    let points = crack.points();
    let mut faces = Faces::new(crack, friction).map_err(refused)?;
    let mut over = OverCycle {
        faces: Vec::new(),
        linear: Vec::new(),
        open: Vec::new(),
    };
    for state in 0..line.states() {
        let stress = line.stress(Which::Continued, state, &points);
        let mut linear = crack.intensity(&stress).map_err(refused)?;
        // What the cells leave open of the tractions within them.
        let other = line.stress(Which::Constant, state, &points);
        let other = crack.intensity(&other).map_err(refused)?;
        linear.error += (linear.K_I - other.K_I).hypot(linear.K_II - other.K_II);
        linear.error += (layers + SAMPLES) * linear.K_I.hypot(linear.K_II);
        faces = faces.next(&stress).map_err(refused)?;
        let mut k = faces.intensity;
        k.error = k.error.max(linear.error);
        over.open.push(faces.open_share().map_err(refused)?);
        over.faces.push(k);
        over.linear.push(linear);
    }
    Ok(over)
}

/// Relative error of K in the homogeneous half-plane where the materials of the layers differ: with the
/// largest Dundurs' alpha of an interface and the depth of the tip over that of the interface.
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
