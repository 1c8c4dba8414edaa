//! Stress intensity of a crack below a contact: the stress along its line, faces that touch,
//! errors.

use std::collections::HashMap;

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_subsurface::{DoubledCells, Moments, Points, Side, States};
use fracture::{Crack, Faces, Intensity};

use super::along::{Along, GRIDS, Line, PointsOnGrid};

/// The shortest distance from the mouth at which the stress is sampled, over the shortest crack.
pub(super) const NEAREST: f64 = 1e-3;
/// Relative error of K from the sampling: bound of 7e-6 found under a sliding contact.
const SAMPLES: f64 = 2e-5;
/// Step of the quadrature along the crack: K within 1e-4 in closed cracks.
pub(super) const QUADRATURE: f64 = 0.12;
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

/// A crack of one length over the states.
#[derive(Clone, Debug, PartialEq)]
pub struct OverCycle {
    /// K with faces that touch, in each state. The error has the part of the quadrature and that of
    /// layers of other materials. The part of the cells is the change of K by tractions on cells twice
    /// as large, the larger change of two pairings: one of them may vanish by chance.
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
    /// Depths at which the stress jumps or has a kink: interfaces, and rows of residual stress \[m\].
    pub(super) fn breaks(&self, states: &States<'_>) -> Vec<f64> {
        let residual = states
            .residual
            .map_or_else(|| ResidualStress::from_body(self.body), Clone::clone);
        [self.body.interfaces(), residual.kinks()].concat()
    }

    /// Points under states, and under their tractions on cells twice as large: with the middle of each
    /// grid \[m\].
    fn points(&self, states: &States<'_>) -> Result<[PointsOnGrid; GRIDS], Error> {
        let on = |grid: &Grid, states: States<'_>| Points::new(self.body, self.side, grid, states);
        let moments = Moments::from_states(states, self.grid);
        let coarser = |cells: &DoubledCells| {
            let paired = moments.coarsened(cells);
            let points = paired.with_states(states.residual, &states.stop, |paired| {
                let stick = states.stick.and(paired.stick);
                on(&cells.grid, States { stick, ..paired })
            })?;
            Ok::<_, Error>((points, cells.middle))
        };
        let [first, second] = DoubledCells::new_pair(self.grid);
        let same = (on(self.grid, states.clone())?, (0.0, 0.0));
        Ok([same, coarser(&first)?, coarser(&second)?])
    }

    /// The stress where cracks run, in the plane at an azimuth and a distance from the axis of depth.
    pub(super) fn along(
        &self,
        states: &States<'_>,
        (azimuth, offset): (f64, f64),
        nearest: f64,
    ) -> Result<Along<'a>, Error> {
        if self.grid.plane_strain && azimuth != 0.0 {
            let allowed = "0 in plane strain, where cracks run along y";
            return Err(Error::invalid("azimuth", azimuth, allowed));
        }
        if !azimuth.is_finite() {
            return Err(Error::invalid("azimuth", azimuth, "a finite angle in rad"));
        }
        if !offset.is_finite() {
            return Err(Error::invalid("offset", offset, "a finite distance in m"));
        }
        Ok(Along {
            body: self.body,
            side: self.side,
            points: self.points(states)?,
            azimuth,
            offset,
            breaks: self.breaks(states),
            nearest,
            known: HashMap::new(),
        })
    }
}

/// A crack under the stress along its line.
pub(super) fn on_line(
    body: &Body,
    line: &Line,
    crack: &Crack,
    friction: f64,
) -> Result<OverCycle, Error> {
    let layers = layered(body, crack.path().tip().z);
    let points = crack.points();
    let mut faces = Faces::new(crack, friction).map_err(refused)?;
    let mut over = OverCycle {
        faces: Vec::new(),
        linear: Vec::new(),
        open: Vec::new(),
    };
    for state in 0..line.states() {
        let stress = line.stress(0, state, &points);
        let mut linear = crack.intensity(&stress).map_err(refused)?;
        let mut cells = 0.0_f64;
        for grid in 1..GRIDS {
            let paired = line.stress(grid, state, &points);
            let paired = crack.intensity(&paired).map_err(refused)?;
            cells = cells.max((linear.K_I - paired.K_I).hypot(linear.K_II - paired.K_II));
        }
        linear.error += cells;
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

/// Relative error of K in the homogeneous half-plane where the materials of the layers differ: with
/// the largest Dundurs' alpha of an interface and the depth of the tip over that of the interface.
fn layered(body: &Body, depth: f64) -> f64 {
    let modulus = |m: contact_core::scene::Elastic| m.E / (1.0 - m.nu * m.nu);
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
