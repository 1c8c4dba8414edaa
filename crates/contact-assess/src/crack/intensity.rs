//! Stress intensity of a crack below a contact: the stress along its line, faces that touch,
//! errors.

use contact_core::Error;
use contact_core::scene::Body;
use fracture::{Crack, Faces, Intensity, Path, PlaneStress};

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
    // K is linear in the stress where faces may pass through each other.
    let linear_changes = |line: &Line, stencils: &[Stencil]| -> Result<Vec<f64>, Error> {
        let of_state = |state| {
            let change = crack.intensity(&line.stress(state, stencils));
            change.map(|k| k.K_I.hypot(k.K_II)).map_err(to_core_error)
        };
        (0..line.states()).map(of_state).collect()
    };
    let stress: Vec<_> = (0..line.states())
        .map(|state| line.stress(state, &stencils))
        .collect();
    let history = follow_faces(crack, friction, &stress).map_err(to_core_error)?;
    // The largest changes of each state by the stress of some lines: where faces may pass through each other,
    // and where they touch.
    let largest_changes = |lines: &[Line]| -> Result<[Vec<f64>; 2], Error> {
        let mut largest = [0, 1].map(|_| vec![0.0; stress.len()]);
        for line in lines {
            let stencils = line.stencils(&points);
            let linear = linear_changes(line, &stencils)?;
            let states = (&stress[..], &history[..]);
            let carried = carried_changes(crack, friction, states, line, &stencils, &linear);
            raise(&mut largest[0], &linear);
            raise(&mut largest[1], &carried);
        }
        Ok(largest)
    };
    let [cells, touching] = largest_changes(&stressed.by_cells)?;
    let [mut mouth, touching_at_mouth] = largest_changes(&stressed.by_mouth)?;
    raise(&mut mouth, &touching_at_mouth);
    let mut over = OverCycle {
        faces: Vec::new(),
        linear: Vec::new(),
        open: Vec::new(),
    };
    for (state, faces) in history.iter().enumerate() {
        let mut linear = crack.intensity(&stress[state]).map_err(to_core_error)?;
        linear.error += cells[state];
        linear.error += (layers + SAMPLES) * linear.K_I.hypot(linear.K_II);
        let mut k = faces.intensity;
        k.error = k.error.max(linear.error).max(touching[state]) + mouth[state];
        over.open.push(faces.open_share().map_err(to_core_error)?);
        over.faces.push(k);
        over.linear.push(linear);
    }
    Ok(over)
}

/// The faces of a crack under one stress after the other.
fn follow_faces(
    crack: &Crack,
    friction: f64,
    stress: &[Vec<PlaneStress>],
) -> Result<Vec<Faces>, fracture::Error> {
    let mut history: Vec<Faces> = Vec::with_capacity(stress.len());
    let start = Faces::new(crack, friction)?;
    for stress in stress {
        history.push(history.last().unwrap_or(&start).next(stress)?);
    }
    Ok(history)
}

/// The change of K_II of each state by a change of the stress in all states, where faces touch with friction.
/// They keep the slip of earlier states, and its error, as long as they stick: an increment with a small
/// change of its own may have the change of an earlier one. Where the changed stress leaves the faces without
/// a state, it is the largest of the changes `linear` so far.
fn carried_changes(
    crack: &Crack,
    friction: f64,
    (stress, history): (&[Vec<PlaneStress>], &[Faces]),
    line: &Line,
    stencils: &[Stencil],
    linear: &[f64],
) -> Vec<f64> {
    let is_open = |faces: &Faces| faces.opening.open.iter().all(|open| *open);
    if friction == 0.0 || history.iter().all(is_open) {
        return vec![0.0; stress.len()];
    }
    let add = |(state, stress): (usize, &Vec<PlaneStress>)| -> Vec<PlaneStress> {
        let changes = line.stress(state, stencils);
        let pairs = stress.iter().zip(changes);
        pairs
            .map(|(s, d)| std::array::from_fn(|k| s[k] + d[k]))
            .collect()
    };
    let changed: Vec<_> = stress.iter().enumerate().map(add).collect();
    if let Ok(changed) = follow_faces(crack, friction, &changed) {
        let pairs = changed.iter().zip(history);
        pairs
            .map(|(a, b)| (a.intensity.K_II - b.intensity.K_II).abs())
            .collect()
    } else {
        let so_far = linear.iter().scan(0.0, |most: &mut f64, change| {
            *most = most.max(*change);
            Some(*most)
        });
        so_far.collect()
    }
}

/// Raises each number to the other one where that is larger.
fn raise(numbers: &mut [f64], others: &[f64]) {
    for (number, other) in numbers.iter_mut().zip(others) {
        *number = number.max(*other);
    }
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
