//! Faces of a crack over a history: open, stick, slip by Coulomb's law.

use std::f64::consts::PI;

use ndarray::Array1;

use super::Error;
use super::closure::{Contact, Opening, solve};
use super::crack::{Crack, Intensity, k_of_density};
use super::lu::largest;
use super::stress::{PlaneStress, tractions};

/// Passes between pressure and shear of the faces before the search gives up.
const MOST_PASSES: usize = 200;
/// Change of the pressure from pass to pass that ends the search, over its largest: a point between
/// open and closed, or between stick and slip, that comes and goes changes it by some 1e-7; K is
/// told to 1e-4.
const LEAST_CHANGE: f64 = 1e-6;
/// The same after the last pass, which then counts as an error of K: more points come and go along
/// kinked cracks.
const BEARABLE: f64 = 1e-4;
/// Values below this part of the largest of their kind count as zero.
const ZERO: f64 = 1e-12;

/// State of the faces at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Apart.
    Open,
    /// In contact without relative motion since the last instant.
    Stick,
    /// In contact and slipping, or without friction.
    Slip,
}

/// The faces of a crack at one instant; [`Faces::next`] takes them to the next one.
#[derive(Clone, Debug)]
pub struct Faces {
    crack: Crack,
    friction: f64,
    /// Jump along the crack over its length, at the points \[Pa\].
    slip: Array1<f64>,
    /// Slip since the last instant.
    moved: Array1<f64>,
    open: Vec<bool>,
    /// Stick, or the sign of the shear traction where slipping.
    moving: Vec<i8>,
    /// K at the tip; K_I is never below zero.
    pub intensity: Intensity,
    /// Opening of the faces and the pressure between them.
    pub opening: Opening,
    /// Shear traction between the faces \[Pa\].
    pub shear: Array1<f64>,
}

impl Faces {
    /// Faces without load, with the coefficient of friction `friction` >= 0 between them.
    pub fn new(crack: &Crack, friction: f64) -> Result<Self, Error> {
        if !(0.0..=2.0).contains(&friction) {
            return Err(Error::invalid(
                "friction between the faces",
                friction,
                "0 to 2",
            ));
        }
        let n = crack.points().len();
        Ok(Self {
            crack: crack.clone(),
            friction,
            slip: Array1::zeros(n),
            moved: Array1::zeros(n),
            open: vec![true; n],
            moving: vec![0; n],
            intensity: Intensity::default(),
            opening: Opening {
                open: vec![false; n],
                gap: Array1::zeros(n),
                normal: Array1::zeros(n),
            },
            shear: Array1::zeros(n),
        })
    }

    /// The faces under the stress at [`Crack::points`] of the next instant. Without friction the
    /// history does not matter.
    pub fn next(&self, stress: &[PlaneStress]) -> Result<Self, Error> {
        let points = self.crack.points();
        let tractions = tractions(&points, stress)?;
        let linear = self.crack.linear(&tractions);
        let normal: Array1<f64> = tractions.iter().map(|t| t.normal).collect();
        let shear: Array1<f64> = tractions.iter().map(|t| t.shear).collect();
        let mut next = self.clone();
        let change = next.settle(self.crack.contact()?, &normal, &shear)?;
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
            let scale = largest(&normal).max(largest(&shear));
            next.intensity.error += change * scale * (PI * self.crack.length()).sqrt();
        }
        Ok(next)
    }

    /// Pressure for known shear, shear for known pressure, until the pressure settles; its last
    /// change over the largest traction.
    fn settle(
        &mut self,
        contact: &Contact,
        normal: &Array1<f64>,
        shear: &Array1<f64>,
    ) -> Result<f64, Error> {
        let n = normal.len();
        let before = self.slip.clone();
        let mut carried = Array1::zeros(n);
        let mut pressure: Option<Array1<f64>> = None;
        let mut change = f64::INFINITY;
        for pass in 1..=MOST_PASSES {
            let load = normal + &contact.nt.dot(&(&carried - shear));
            let mut open = self.open.clone();
            let Some(opening) = contact.open(&load, &mut open) else {
                break;
            };
            let known = shear + &contact.tn.dot(&opening.gap);
            self.open = open;
            let scale = largest(normal).max(largest(shear));
            change = pressure.as_ref().map_or(f64::INFINITY, |last| {
                largest(&(last - &opening.normal)) / scale.max(f64::MIN_POSITIVE)
            });
            pressure = Some(opening.normal.clone());
            self.opening = opening;
            if self.friction == 0.0 {
                self.slip = contact.tt_inverse.dot(&-known);
                self.shear = Array1::zeros(n);
                self.moving = vec![1; n];
                return Ok(0.0);
            }
            carried = self.stick(contact, &known, &before).ok_or(Error::Faces {
                length: self.crack.length(),
                passes: MOST_PASSES,
                change,
            })?;
            if change <= LEAST_CHANGE || (pass == MOST_PASSES && change <= BEARABLE) {
                self.shear = carried;
                return Ok(change);
            }
        }
        Err(Error::Faces {
            length: self.crack.length(),
            passes: MOST_PASSES,
            change,
        })
    }

    /// Slip under a known pressure; the shear traction that the faces carry.
    ///
    /// Active set: stuck points beyond Coulomb's bound slip, points that would slip against their
    /// shear stick.
    fn stick(
        &mut self,
        contact: &Contact,
        known: &Array1<f64>,
        before: &Array1<f64>,
    ) -> Option<Array1<f64>> {
        let n = known.len();
        let bound = self.opening.normal.mapv(|s| self.friction * (-s).max(0.0));
        let held = known + &contact.tt.dot(before);
        let scale = largest(&held).max(largest(&bound));
        for _ in 0..MOST_PASSES {
            let target = |k: usize| {
                if self.opening.open[k] {
                    0.0
                } else {
                    f64::from(self.moving[k]) * bound[k]
                }
            };
            let free: Vec<usize> = (0..n)
                .filter(|k| self.opening.open[*k] || self.moving[*k] != 0)
                .collect();
            let right = Array1::from_shape_fn(n, |k| target(k) - held[k]);
            let moved = solve(&contact.tt, &free, &right)?;
            let carried = &held + &contact.tt.dot(&moved);
            let tight = ZERO * largest(&moved);
            let mut changed = false;
            for k in 0..n {
                if self.opening.open[k] {
                    continue;
                }
                let next = match self.moving[k] {
                    0 if carried[k].abs() > bound[k] + ZERO * scale => carried[k].signum() as i8,
                    sign if sign != 0 && moved[k] * f64::from(sign) < -tight => 0,
                    same => same,
                };
                changed |= next != self.moving[k];
                self.moving[k] = next;
            }
            if !changed {
                self.slip = before + &moved;
                self.moved = moved;
                return Some(carried);
            }
        }
        None
    }

    /// States of the faces from the mouth to the tip: state, begin and end over the crack's length.
    ///
    /// A border lies where the jump that grows from it with the power 3/2 of the distance goes to
    /// zero: the opening, or the slip since the last instant.
    pub fn parts(&self) -> Result<Vec<(State, f64, f64)>, Error> {
        let s = &self.crack.contact()?.s;
        let states: Vec<State> = (0..s.len()).map(|k| self.state(k)).collect();
        let mut parts = Vec::new();
        let mut begin = 0.0;
        for k in (0..s.len()).rev() {
            let last = k == 0;
            if !last && states[k - 1] == states[k] && self.sign(k - 1) == self.sign(k) {
                continue;
            }
            let end = if last { 1.0 } else { self.border(s, k - 1, k) };
            parts.push((states[k], begin, end));
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

    fn state(&self, k: usize) -> State {
        if self.opening.open[k] {
            State::Open
        } else if self.friction > 0.0 && self.moving[k] == 0 {
            State::Stick
        } else {
            State::Slip
        }
    }

    /// Sign of slip, 0 elsewhere.
    fn sign(&self, k: usize) -> i8 {
        if self.state(k) == State::Slip {
            self.moving[k]
        } else {
            0
        }
    }

    /// The border between the points k and k + 1 (nearer to the mouth).
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

    fn rank(&self, k: usize) -> u8 {
        match self.state(k) {
            State::Open => 0,
            State::Slip => 1,
            State::Stick => 2,
        }
    }
}
