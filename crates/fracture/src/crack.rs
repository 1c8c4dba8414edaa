//! A crack as a row of dislocations; stress intensity without contact of the faces.

use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

use ndarray::Array1;

use super::Error;
use super::closure::Contact;
use super::influence::influence;
use super::jumps::Jumps;
use super::lu::Lu;
use super::path::Path;
use super::rule::{Rule, step};
use super::stress::{PlaneStress, Point, Traction, tractions};

/// K over the density's value at the tip of a leg of unit length: K = 2 pi sqrt(2 pi) lim D
/// sqrt(r).
pub(crate) fn k_of_density() -> f64 {
    2.0 * PI * (2.0 * PI).sqrt()
}

/// Stress intensity at the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Intensity {
    /// Opening \[Pa m^0.5\].
    pub K_I: f64,
    /// In-plane shear \[Pa m^0.5\]: K_I + i K_II = lim sqrt(2 pi r) (s_nn + i s_tn).
    pub K_II: f64,
    /// Error of both by the quadrature \[Pa m^0.5\]: the difference from three times its step.
    pub error: f64,
}

/// The system of a path of unit length from x = 0; the system of any similar crack follows from it.
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) rule: Rule,
    /// K over the tractions at the points, K_I and K_II, for unit length: rows normal, then shear.
    weights: [Array1<f64>; 2],
    /// Weights of the rule of three times the step, at every third point.
    coarse: [Array1<f64>; 2],
    contact: OnceLock<Result<Contact, Error>>,
}

/// A crack in a half-plane: its path and the dislocations along it.
///
/// Cracks of the same shape share their system: [`Crack::similar`] costs nothing.
#[derive(Clone, Debug)]
pub struct Crack {
    path: Path,
    length: f64,
    pub(crate) system: Arc<System>,
    jumps: Arc<Jumps>,
}

/// Tractions of the body without the crack for the rule, and for the rule of three times its step.
pub(crate) type Loads = [Vec<Traction>; 2];

/// Weights of the tractions in K_I and K_II, from the transposed system.
fn weights(rule: &Rule, length: f64) -> Result<[Array1<f64>; 2], Error> {
    let n = rule.points.len();
    let transposed = influence(rule).t().as_standard_layout().into_owned();
    let lu = Lu::new(transposed).ok_or_else(|| Error::Singular {
        length,
        why: "its legs touch or run along each other".into(),
    })?;
    let of = |row: usize| {
        let mut unit = Array1::zeros(2 * n);
        unit[row] = -k_of_density() * rule.tip_leg.sqrt();
        lu.solve(&unit)
    };
    Ok([of(0), of(n)])
}

impl Crack {
    /// Computes the dislocation system of a crack along a path.
    pub fn new(path: Path) -> Result<Self, Error> {
        path.check()?;
        let step = step(&path);
        Self::with_step(path, step)
    }

    /// Crack with a given step of the quadrature: change of ln(distance) to mouth and
    /// kinks from point to point, 0.08 and less at flat cracks and sharp kinks by default.
    pub fn with_step(path: Path, step: f64) -> Result<Self, Error> {
        path.check()?;
        if !(0.02..=1.0).contains(&step) {
            return Err(Error::invalid("step of the quadrature", step, "0.02 to 1"));
        }
        let length = path.length();
        let rule = Rule::new(&path, step);
        let system = System {
            weights: weights(&rule, length)?,
            coarse: weights(&rule.coarse(), length)?,
            rule,
            contact: OnceLock::new(),
        };
        Ok(Self {
            path,
            length,
            system: Arc::new(system),
            jumps: Arc::default(),
        })
    }

    /// The path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Length along the crack \[m\].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Names the depths at which the stress jumps or has a kink \[m\]: [`Crack::points`] are more, and
    /// the quadrature is split there.
    #[must_use]
    pub fn with_interfaces(mut self, interfaces: &[f64]) -> Self {
        let at: Vec<f64> = interfaces
            .iter()
            .flat_map(|z| self.path.crossings(*z))
            .collect();
        self.jumps = Arc::new(Jumps::new(&self.system.rule, &self.path, &at));
        self
    }

    /// A crack of the same shape with its mouth at `mouth` \[m\] and the length `length` \[m\], in a
    /// body without interfaces.
    pub fn similar(&self, mouth: f64, length: f64) -> Result<Self, Error> {
        let factor = length / self.length;
        let mut path = self.path.clone();
        path.mouth = mouth;
        for piece in path.legs.iter_mut().flat_map(|leg| &mut leg.pieces) {
            piece.0 *= factor;
        }
        path.check()?;
        Ok(Self {
            path,
            length,
            system: Arc::clone(&self.system),
            jumps: Arc::default(),
        })
    }

    /// Points for the stress of the body without the crack, from the tip to the mouth; then the
    /// points beside interfaces.
    pub fn points(&self) -> Vec<Point> {
        let at = |knot: &super::rule::Knot| Point {
            x: self.path.mouth + self.length * knot.at.re,
            z: self.length * knot.at.im,
            angle: knot.angle,
            s: self.length * knot.s,
        };
        let rule = self.system.rule.points.iter().map(at);
        rule.chain(self.jumps.points.iter().copied()).collect()
    }

    /// Number of points of the rule, the first ones of [`Crack::points`].
    pub(crate) fn rule_points(&self) -> usize {
        self.system.rule.points.len()
    }

    /// The tractions under the stress at [`Crack::points`].
    pub(crate) fn loads(&self, stress: &[PlaneStress]) -> Result<Loads, Error> {
        let tractions = tractions(&self.points(), stress)?;
        let (rule, added) = tractions.split_at(self.rule_points());
        Ok(self.jumps.loads(rule, added))
    }

    /// K under the stress at [`Crack::points`], with faces that may pass through each other: K_I <
    /// 0 means that they would. Linear in the stress.
    pub fn intensity(&self, stress: &[PlaneStress]) -> Result<Intensity, Error> {
        Ok(self.linear(&self.loads(stress)?))
    }

    /// K_I and K_II under tractions at the points, with faces that may pass through each other.
    pub(crate) fn linear(&self, loads: &Loads) -> Intensity {
        let root = self.length.sqrt();
        let sum = |w: &Array1<f64>, load: &[Traction]| -> f64 {
            let n = load.len();
            let product = |(k, t): (usize, &Traction)| w[k] * t.normal + w[n + k] * t.shear;
            root * load.iter().enumerate().map(product).sum::<f64>()
        };
        let [K_I, K_II] = [0, 1].map(|i| sum(&self.system.weights[i], &loads[0]));
        let [c_I, c_II] = [0, 1].map(|i| sum(&self.system.coarse[i], &loads[1]));
        // Error of the parts between the last point and the mouth, and between the points beside a
        // kink.
        let kinks = if self.path.legs.len() > 1 { 2e-6 } else { 0.0 };
        let mouth = loads[0].last().map_or(0.0, |t| t.normal.hypot(t.shear));
        let mouth = 4.0 * self.points_left_out() * mouth * (PI * self.length).sqrt();
        Intensity {
            K_I,
            K_II,
            error: (K_I - c_I).abs().max((K_II - c_II).abs()) + mouth + kinks * K_I.hypot(K_II),
        }
    }

    /// Distance of the last dislocation from the mouth over the length.
    fn points_left_out(&self) -> f64 {
        self.system.rule.dislocations.last().map_or(0.0, |d| d.s)
    }

    /// The compliance matrices of the faces, computed once for all cracks of this shape.
    pub(crate) fn contact(&self) -> Result<&Contact, Error> {
        let made = self
            .system
            .contact
            .get_or_init(|| Contact::new(&self.system.rule, self.length));
        made.as_ref().map_err(Clone::clone)
    }
}
