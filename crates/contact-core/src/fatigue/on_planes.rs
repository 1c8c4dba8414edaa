//! The criteria that look for a plane, as functions of the plane.
//!
//! M bounds the shear amplitude of all planes, Q Tresca's stress of all instants. Along a great
//! circle the second derivative of s_n is at least -2 Q, its slope at most Q; that of tau_a at least
//! -4 M, its slope at most 2 M; that of half the strain range at least -(1 + nu)/E 2 D, its slope at
//! most (1 + nu)/E D, D bounding Tresca's stress of the deviation of any instant from a constant
//! stress (derived).

use super::circle::Circles;
use super::criterion::Criterion;
use super::critical_plane::{Bend, PlaneFunction};
use super::lanes::Lanes;
use super::path::{Frame, Path, normal_weights};
use super::refine::{Deciding, First};
use crate::fields::StressTensor;

/// Weight of the second quantity where the plane is that of the largest first one: enough to choose
/// between equal planes, and too little to move the plane by more than this.
const TIE: f64 = 1e-7;

/// Room for the shear path on a plane.
#[derive(Default)]
pub(super) struct ShearRoom {
    shear: Vec<[Lanes; 2]>,
    circles: Circles,
}

/// How the criterion follows from the two parts.
#[derive(Clone, Copy, Debug)]
enum Law {
    /// a + w b.
    Sum(f64),
    /// a b where b > 0.
    Product,
    /// a (1 + w b) where that is positive.
    Raised(f64),
}

/// A criterion on the planes of one point.
pub(super) struct OnPlanes<'a> {
    path: &'a Path,
    room: &'a mut ShearRoom,
    law: Law,
    /// Parts in place of stresses: shear strain 1/G, normal strain (1 + nu)/E and nu/E.
    shear_scale: f64,
    strain: Option<[f64; 2]>,
    has_shear: bool,
    tresca: (f64, f64),
}

impl<'a> OnPlanes<'a> {
    /// `None` for criteria of invariants.
    pub(super) fn new(
        criterion: &Criterion,
        path: &'a Path,
        room: &'a mut ShearRoom,
    ) -> Option<Self> {
        let shear_strain = |E: f64, nu: f64| 2.0 * (1.0 + nu) / E;
        let strain = |E: f64, nu: f64| Some([(1.0 + nu) / E, nu / E]);
        let (law, shear_scale, strain, has_shear) = match *criterion {
            Criterion::Crossland { .. } | Criterion::DangVan { .. } => return None,
            Criterion::Findley { k } => (Law::Sum(k), 1.0, None, true),
            Criterion::Matake { .. } | Criterion::McDiarmid { .. } => {
                (Law::Sum(TIE), 1.0, None, true)
            }
            Criterion::SmithWatsonTopper { E, nu } => (Law::Product, 1.0, strain(E, nu), false),
            Criterion::FatemiSocie { E, nu, k, s_y } => {
                (Law::Raised(k / s_y), shear_strain(E, nu), None, true)
            }
            Criterion::BrownMiller { E, nu, .. } => {
                (Law::Sum(TIE), shear_strain(E, nu), strain(E, nu), true)
            }
        };
        let tresca = path.tresca_bounds();
        Some(Self {
            path,
            room,
            law,
            shear_scale,
            strain,
            has_shear,
            tresca,
        })
    }

    /// Half the range of the normal strain on a plane.
    fn strain_amplitude(&self, n: [f64; 3], strain: [f64; 2]) -> f64 {
        self.path.range(&strain_weights(n, strain)).amplitude()
    }

    /// The instants of the largest and smallest normal strain on a plane, and half of the difference
    /// of the strains of their stresses.
    fn strain_range(&self, n: [f64; 3], strain: [f64; 2]) -> ([usize; 2], StressTensor) {
        let ends = self.path.extremes(&strain_weights(n, strain));
        let [most, least] = ends.map(|k| self.path.at(k));
        let [along, across] = strain;
        let change: StressTensor = std::array::from_fn(|c| (most[c] - least[c]) / 2.0);
        let trace = change[0] + change[1] + change[2];
        let of = |c: usize| along * change[c] - if c < 3 { across * trace } else { 0.0 };
        (ends, std::array::from_fn(of))
    }

    /// Shear amplitude and largest normal stress on a plane.
    fn shear_and_normal(&mut self, n: [f64; 3]) -> [f64; 2] {
        let s_n = self.path.resolve(&Frame::across(n), &mut self.room.shear);
        [self.room.circles.round(&self.room.shear).radius, s_n]
    }
}

impl PlaneFunction for OnPlanes<'_> {
    fn parts(&mut self, n: [f64; 3]) -> [f64; 2] {
        match (self.has_shear, self.strain) {
            (false, Some(strain)) => {
                let (s_n, strain) = self.path.max_and_range(n, strain);
                [strain.amplitude(), s_n]
            }
            (_, strain) => {
                let [shear, s_n] = self.shear_and_normal(n);
                let second = strain.map_or(s_n, |strain| self.strain_amplitude(n, strain));
                [self.shear_scale * shear, second]
            }
        }
    }

    fn value(&self, [a, b]: [f64; 2]) -> f64 {
        match self.law {
            Law::Sum(weight) => a + weight * b,
            Law::Product => a * b.max(0.0),
            Law::Raised(weight) => a * (1.0 + weight * b).max(0.0),
        }
    }

    fn has_ties(&self) -> bool {
        matches!(self.law, Law::Sum(weight) if weight == TIE)
    }

    fn deciding(&mut self, n: [f64; 3]) -> Deciding {
        let [most, _] = self.path.extremes(&normal_weights(n));
        let range = self.strain.map(|strain| self.strain_range(n, strain));
        let (second, at) = match range {
            Some((_, tensor)) if self.has_shear => (tensor, most),
            _ => (self.path.at(most), most),
        };
        let ends = range.map_or([0; 2], |(ends, _)| ends);
        if let (false, Some((_, tensor))) = (self.has_shear, range) {
            return Deciding {
                instants: [0, 0, 0, ends[0], ends[1], at],
                first: First::Normal(tensor),
                second,
            };
        }
        self.path.resolve(&Frame::across(n), &mut self.room.shear);
        let mut on = self.room.circles.round(&self.room.shear).on;
        on.sort_unstable();
        Deciding {
            instants: [on[0], on[1], on[2], ends[0], ends[1], at],
            first: First::Shear(self.shear_scale, on.map(|k| self.path.at(k))),
            second,
        }
    }

    fn bend(&self, largest: [f64; 2], sag: f64) -> Bend {
        let (whole, deviation) = self.tresca;
        // Second derivative and slope of the first part; its largest value.
        let (bend_a, slope_a, most_a) = if self.has_shear {
            let most = largest[0] / (1.0 - 4.0 * sag);
            (4.0 * most, 2.0 * most, most)
        } else {
            let scale = self.strain.map_or(0.0, |[along, _]| along) * deviation;
            (2.0 * scale, scale, largest[0] + 2.0 * scale * sag)
        };
        let (bend_b, slope_b) = match self.strain {
            Some([along, _]) if self.has_shear => (2.0 * along * deviation, along * deviation),
            _ => (2.0 * whole, whole),
        };
        let most_b = largest[1] + bend_b * sag;
        let of_product = |weight: f64, factor: f64| {
            bend_a * factor.max(0.0) + weight * (most_a * bend_b + 2.0 * slope_a * slope_b)
        };
        let value = match self.law {
            Law::Sum(weight) => bend_a + weight * bend_b,
            Law::Product => of_product(1.0, most_b),
            Law::Raised(weight) => of_product(weight, 1.0 + weight * most_b),
        };
        Bend {
            parts: [bend_a, bend_b],
            value,
        }
    }
}

/// The normal strain on a plane as a sum of the components of the stress.
fn strain_weights(n: [f64; 3], [along, across]: [f64; 2]) -> [f64; 6] {
    let mut weights = normal_weights(n).map(|w| along * w);
    for w in &mut weights[..3] {
        *w -= across;
    }
    weights
}

/// What acts on the plane of a unit normal, for people.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Acting {
    pub(super) shear_amplitude: f64,
    pub(super) shear_chord: f64,
    pub(super) normal_max: f64,
    pub(super) normal_min: f64,
}

impl Acting {
    pub(super) fn on(path: &Path, n: [f64; 3], room: &mut ShearRoom) -> Self {
        path.resolve(&Frame::across(n), &mut room.shear);
        let normal = path.normal(n);
        Self {
            shear_amplitude: room.circles.round(&room.shear).radius,
            shear_chord: half_chord(&room.shear),
            normal_max: normal.max,
            normal_min: normal.min,
        }
    }
}

/// Half of the longest chord of a plane path.
fn half_chord(path: &[[Lanes; 2]]) -> f64 {
    let mut most = 0.0_f64;
    for (n, from) in path.iter().enumerate() {
        for (x, y) in from[0].iter().zip(from[1]) {
            for to in &path[n..] {
                for (a, b) in to[0].iter().zip(to[1]) {
                    most = most.max((a - x).powi(2) + (b - y).powi(2));
                }
            }
        }
    }
    most.sqrt() / 2.0
}
