//! Stress intensity of a crack below a contact: the stress along its line, faces that touch,
//! errors.

use contact_core::Error;
use contact_core::scene::Body;
use fracture::{Crack, Faces, Intensity, Path};

use super::along::{Along, Line, Stencil};
use super::prepared::Cells;

/// The shortest distance from the mouth at which the stress is sampled, over the shortest crack.
pub(super) const NEAREST: f64 = 1e-3;
/// Relative error of K from the sampling: bound of 7e-6 found under a sliding contact.
const SAMPLES: f64 = 2e-5;
/// Step of the quadrature along the crack: K within 1e-4 in closed cracks.
pub(super) const QUADRATURE: f64 = 0.12;
/// Change of K by a layer for each unit of Dundurs' alpha, tip at the interface: largest of the
/// table of partial cracks in a film (|alpha| to 0.8), rounded up.
const LAYERED: f64 = 1.2;

/// Converts an error of the crate fracture to an error of the core.
pub fn to_core_error(error: fracture::Error) -> Error {
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
    /// K with faces that touch, in each state. The error has a part of the quadrature and one of
    /// layers of other materials. The part of the cells is the change of K by tractions on cells twice
    /// as large, the larger change of two pairings: one of them may vanish by chance.
    pub faces: Vec<Intensity>,
    /// K with faces that may pass through each other.
    pub linear: Vec<Intensity>,
    /// Share of the crack that is open, in each state.
    pub open: Vec<f64>,
}

/// The stress along a line of cracks, and its changes.
pub(super) struct Stressed {
    /// The stress by the tractions on the grid.
    pub(super) line: Line,
    /// Its changes by tractions on cells twice as large, in both pairings.
    pub(super) by_cells: Vec<Line>,
    /// Its changes by the error of the place of the mouth.
    pub(super) by_mouth: Vec<Line>,
}

impl Stressed {
    /// Samples the stress along a path, and its changes by coarser cells and by a mouth that is off by
    /// `mouth_error` \[m\] to either side.
    pub(super) fn new(
        along: &mut Along<'_>,
        path: &Path,
        mouth_error: Option<f64>,
    ) -> Result<Self, Error> {
        let line = along.sample_path(path, Cells::Grid)?;
        let by_cells = Cells::DOUBLED.map(|cells| along.change_by_cells(&line, path, cells));
        let mouths = mouth_error.map(|off| [path.mouth - off, path.mouth + off]);
        let by_mouth = mouths
            .into_iter()
            .flatten()
            .map(|mouth| along.change_by_mouth(&line, path, mouth));
        Ok(Self {
            by_mouth: by_mouth.collect::<Result<_, _>>()?,
            by_cells: by_cells.into_iter().collect::<Result<_, _>>()?,
            line,
        })
    }
}

/// Computes K of a crack over the states, under the stress along its line, with its errors.
pub(super) fn on_line(
    body: &Body,
    stressed: &Stressed,
    crack: &Crack,
    friction: f64,
) -> Result<OverCycle, Error> {
    let layers = layered(body, crack.path().tip().z);
    let points = crack.points();
    let line = &stressed.line;
    let stencils = line.stencils(&points);
    let changes = |lines: &'_ [Line]| -> Vec<Vec<Stencil>> {
        lines.iter().map(|line| line.stencils(&points)).collect()
    };
    let (of_cells, of_mouth) = (changes(&stressed.by_cells), changes(&stressed.by_mouth));
    // K is linear in the stress where faces may pass through each other.
    let largest = |lines: &[Line], stencils: &[Vec<Stencil>], state| -> Result<f64, Error> {
        let mut largest = 0.0_f64;
        for (line, stencils) in lines.iter().zip(stencils) {
            let change = crack.intensity(&line.stress(state, stencils));
            let change = change.map_err(to_core_error)?;
            largest = largest.max(change.K_I.hypot(change.K_II));
        }
        Ok(largest)
    };
    let mut faces = Faces::new(crack, friction).map_err(to_core_error)?;
    let mut over = OverCycle {
        faces: Vec::new(),
        linear: Vec::new(),
        open: Vec::new(),
    };
    for state in 0..line.states() {
        let stress = line.stress(state, &stencils);
        let mut linear = crack.intensity(&stress).map_err(to_core_error)?;
        linear.error += largest(&stressed.by_cells, &of_cells, state)?;
        linear.error += (layers + SAMPLES) * linear.K_I.hypot(linear.K_II);
        faces = faces.next(&stress).map_err(to_core_error)?;
        let mut k = faces.intensity;
        k.error = k.error.max(linear.error) + largest(&stressed.by_mouth, &of_mouth, state)?;
        over.open.push(faces.open_share().map_err(to_core_error)?);
        over.faces.push(k);
        over.linear.push(linear);
    }
    Ok(over)
}

/// The largest range of K_I over the states, of cracks along a line. With a coefficient of `friction`, faces
/// touch; without one they may pass through each other.
pub(super) fn range_on_line(
    line: &Line,
    crack: &Crack,
    friction: Option<f64>,
) -> Result<f64, Error> {
    let stencils = line.stencils(&crack.points());
    let mut faces = friction
        .map(|friction| Faces::new(crack, friction))
        .transpose()
        .map_err(to_core_error)?;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for state in 0..line.states() {
        let stress = line.stress(state, &stencils);
        let K_I = if let Some(touching) = &mut faces {
            *touching = touching.next(&stress).map_err(to_core_error)?;
            touching.intensity.K_I
        } else {
            crack
                .intensity(&stress)
                .map_err(to_core_error)?
                .K_I
                .max(0.0)
        };
        (low, high) = (low.min(K_I), high.max(K_I));
    }
    Ok((high - low).max(0.0))
}

/// Relative error of K since it holds for a homogeneous half-plane: from the largest Dundurs' alpha of an
/// interface, and the depth of the tip over the depth of the interface.
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
