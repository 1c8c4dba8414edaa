//! Faces of a crack over a history: open, stick, slip by Coulomb's law.

use ndarray::{Array1, s};

use super::Error;
use super::closure::{Instant, OpenFactors, Opening, Signed, State};
use super::crack::{Crack, Intensity, k_of_density};
use super::lu::largest;
use super::stress::{PlaneStress, Traction};

/// Most halvings of the change of the load between two instants before the search gives up.
const MOST_HALVINGS: usize = 5;
/// Most linear systems solved in a search that halves the load.
const MOST_PASSES: usize = 400;

/// The faces of a crack at one instant; [`Faces::next`] takes them to the next one.
#[derive(Clone, Debug)]
pub struct Faces {
    crack: Crack,
    friction: f64,
    /// Jump along the crack over its length, at the points \[Pa\].
    slip: Array1<f64>,
    /// Slip since the last instant.
    moved: Array1<f64>,
    /// Tractions of the body without the crack, normal then shear, and the largest of the history
    /// \[Pa\].
    load: Array1<f64>,
    most: f64,
    states: Vec<Signed>,
    open_factors: OpenFactors,
    /// K at the tip; K_I is never below zero.
    pub intensity: Intensity,
    /// Opening of the faces and the pressure between them.
    pub opening: Opening,
    /// Shear traction between the faces \[Pa\].
    pub shear: Array1<f64>,
    /// Linear systems solved for this instant.
    pub passes: usize,
}

impl Faces {
    /// A crack without load, with this coefficient of friction between its faces.
    pub fn new(crack: &Crack, friction: f64) -> Result<Self, Error> {
        if !(0.0..=2.0).contains(&friction) {
            return Err(Error::invalid(
                "friction between the faces",
                friction,
                "0 to 2",
            ));
        }
        let n = crack.rule_points();
        Ok(Self {
            crack: crack.clone(),
            friction,
            slip: Array1::zeros(n),
            moved: Array1::zeros(n),
            load: Array1::zeros(2 * n),
            most: 0.0,
            states: vec![(State::Open, 0); n],
            open_factors: None,
            intensity: Intensity::default(),
            opening: Opening {
                open: vec![false; n],
                gap: Array1::zeros(n),
                normal: Array1::zeros(n),
            },
            shear: Array1::zeros(n),
            passes: 0,
        })
    }

    /// The faces under the stress at [`Crack::points`] of the next instant. Without friction the
    /// history does not matter.
    pub fn next(&self, stress: &[PlaneStress]) -> Result<Self, Error> {
        let loads = self.crack.loads(stress)?;
        let linear = self.crack.linear(&loads);
        let part = |of: fn(&Traction) -> f64| loads[0].iter().map(of);
        let load: Array1<f64> = part(|t| t.normal).chain(part(|t| t.shear)).collect();
        let mut next = self.clone();
        next.passes = 0;
        next.go_to(load, MOST_HALVINGS)?;
        next.moved = &next.slip - &self.slip;
        let root = self.crack.length().sqrt();
        let k = k_of_density() * self.crack.system.rule.tip_leg.sqrt() * root
            / self.crack.contact()?.tip;
        next.intensity = Intensity {
            K_I: (k * next.opening.gap[0]).max(0.0),
            K_II: k * next.slip[0],
            error: linear.error,
        };
        if next.opening.open.iter().all(|open| *open) {
            next.intensity = linear;
        } else {
            // The border of a part lies between two points; measured against solutions with the
            // borders as unknowns: below 1e-4 of the intensity and of that without contact.
            let sizes = [linear, next.intensity].map(|k| k.K_I.hypot(k.K_II));
            next.intensity.error += 1e-4 * (sizes[0] + sizes[1]);
        }
        Ok(next)
    }

    /// Takes the faces to a load; in halves, `halvings` times at most, if their states do not settle.
    fn go_to(&mut self, load: Array1<f64>, halvings: usize) -> Result<(), Error> {
        let n = self.slip.len();
        let contact = self.crack.contact()?;
        let before = self.slip.clone();
        let instant = Instant {
            load: &load,
            most: self.most.max(largest(&load)),
            friction: self.friction,
            before: &before,
        };
        let unsettled = match contact.settle(&instant, &self.states, &mut self.open_factors) {
            Ok(found) => {
                self.passes += found.passes;
                self.slip = found.jumps.slice(s![n..]).to_owned();
                self.shear = found.tractions.slice(s![n..]).to_owned();
                self.opening = Opening {
                    open: found.states.iter().map(|of| of.0 == State::Open).collect(),
                    gap: found.jumps.slice(s![..n]).to_owned(),
                    normal: found.tractions.slice(s![..n]).to_owned(),
                };
                (self.most, self.states, self.load) = (instant.most, found.states, load);
                return Ok(());
            }
            Err(unsettled) => unsettled,
        };
        self.passes += unsettled.passes;
        if halvings == 0 || self.passes > MOST_PASSES {
            return Err(Error::Faces {
                length: self.crack.length(),
                friction: self.friction,
                kink: self.crack.path().sharpest_kink(),
                passes: self.passes,
                at_fault: unsettled.at_fault,
                points: n,
            });
        }
        let middle = 0.5 * (&self.load + &load);
        self.go_to(middle, halvings - 1)?;
        self.go_to(load, halvings - 1)
    }

    /// States of the faces from the mouth to the tip: state, begin and end over the crack's length.
    ///
    /// A border lies where the jump that grows from it with the power 3/2 of the distance goes to
    /// zero: the opening, or the slip since the last instant.
    pub fn parts(&self) -> Result<Vec<(State, f64, f64)>, Error> {
        let s = &self.crack.contact()?.s;
        let mut parts = Vec::new();
        let mut begin = 0.0;
        for k in (0..s.len()).rev() {
            let last = k == 0;
            if !last && self.states[k - 1] == self.states[k] {
                continue;
            }
            let end = if last { 1.0 } else { self.border(s, k - 1, k) };
            parts.push((self.states[k].0, begin, end));
            begin = end;
        }
        Ok(parts)
    }

    /// Share of the crack's length that is open.
    pub fn open_share(&self) -> Result<f64, Error> {
        let parts = self.parts()?;
        let open = parts.iter().filter(|part| part.0 == State::Open);
        Ok(open.fold(0.0, |sum, (_, begin, end)| sum + end - begin))
    }

    /// The place of the border between open and closed faces, between the points k and `next` (nearer to the
    /// mouth).
    fn border(&self, s: &[f64], k: usize, next: usize) -> f64 {
        let (rank, other) = (self.rank(k), self.rank(next));
        // From the side that moves: open against closed, slipping against stuck.
        let (first, second) = if rank < other {
            (k, k.checked_sub(1))
        } else {
            (next, Some(next + 1).filter(|n| *n < s.len()))
        };
        let middle = (s[k] * s[next]).sqrt();
        let Some(second) = second.filter(|n| self.rank(*n) == self.rank(first)) else {
            return middle;
        };
        let jump = |n: usize| {
            let jump = if rank.min(other) == 0 {
                self.opening.gap[n]
            } else {
                self.moved[n]
            };
            jump.abs().powf(2.0 / 3.0)
        };
        let (a, b) = (jump(first), jump(second));
        let place = s[first] - a * (s[second] - s[first]) / (b - a);
        let beyond = |n: Option<usize>, at: f64| n.and_then(|n| s.get(n)).copied().unwrap_or(at);
        let (low, high) = (beyond(Some(next + 1), 0.0), beyond(k.checked_sub(1), 1.0));
        if place.is_finite() {
            place.clamp(low, high)
        } else {
            middle
        }
    }

    /// How firmly the faces are held at point k: 0 open, 1 slip, 2 stick.
    fn rank(&self, k: usize) -> u8 {
        match self.states[k].0 {
            State::Open => 0,
            State::Slip => 1,
            State::Stick => 2,
        }
    }
}
