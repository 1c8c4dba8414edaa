//! The criteria that look for a plane, as functions of the plane.
//!
//! M bounds the shear amplitude of all planes, Q Tresca's stress of all instants. Along a great
//! circle the second derivative of s_n is at least -2 Q, its slope at most Q; that of tau_a at least
//! -4 M, its slope at most 2 M; that of half the strain range at least -(1 + nu)/E 2 D, its slope at
//! most (1 + nu)/E D, D bounding Tresca's stress of the deviation of any instant from a constant
//! stress (derived).

use super::circle::Circles;
use super::criterion::Criterion;
use super::eight_planes::{Instants, OfThree};
use super::forms::{EDGES, corners_of};
use super::hemisphere::{COARSE, FINE, Face, Hemisphere};
use super::lanes::{LANES, Lanes, ROUNDING, Real};
use super::law::{Law, TIE};
use super::path::{Frame, Path, normal_weights};
use super::plane_function::{Bend, Enough, Known, Plane, PlaneFunction};
use super::product_bound::product_bounds;
use super::refine::{Deciding, First};
use super::shear_bound::About;
use super::tangent::Tangent;
use crate::fields::StressTensor;

/// [`PlaneFunction::lead`] of products, whose faces are large: 3 of 1000 cycles of two random harmonics
/// keep a plane that is not the best (by 3e-4 at most), 16 with 0.
const LEAD: f64 = 0.01;

/// Room for the shear path on a plane, and for eight planes in single and double precision.
pub(super) struct ShearRoom {
    pub(super) shear: Vec<[Lanes; 2]>,
    pub(super) circles: Circles,
    single: Instants<f32>,
    double: Instants<f64>,
    /// What [`About`] needs.
    squares: Instants<f32>,
}

impl Default for ShearRoom {
    fn default() -> Self {
        Self {
            shear: Vec::new(),
            circles: Circles::default(),
            single: Instants::new(),
            double: Instants::new(),
            squares: Instants::new(),
        }
    }
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
    /// Largest component of any instant.
    size: f64,
    in_double: bool,
    /// The best plane, and the squares about it, where they are of use.
    best: [f64; 3],
    about: Option<About>,
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
        room.single.load(path);
        Some(Self {
            path,
            room,
            law,
            shear_scale,
            strain,
            has_shear,
            tresca,
            size: path.size(),
            in_double: false,
            best: [0.0; 3],
            about: None,
        })
    }

    /// What rounding may take from the two parts.
    fn slack(&self) -> [f64; 2] {
        let spacing = if self.in_double {
            f64::EPSILON
        } else {
            f64::from(f32::EPSILON)
        };
        let stress = ROUNDING * spacing * self.size;
        let strain = self
            .strain
            .map(|[along, across]| (along + 3.0 * across) * stress);
        match (self.has_shear, strain) {
            (true, strain) => [self.shear_scale * stress, strain.unwrap_or(stress)],
            (false, strain) => [strain.unwrap_or(stress), stress],
        }
    }

    /// [`PlaneFunction::measure`] of at most eight planes.
    fn measure_eight<F: Real>(
        &self,
        instants: &mut Instants<F>,
        planes: &mut [Plane],
        enough: Enough,
    ) {
        let n = [0, 1, 2].map(|d| std::array::from_fn(|l| planes[l.min(planes.len() - 1)].n[d]));
        let swept = instants.sweep(&n, self.strain, self.has_shear);
        let slack = self.slack();
        for (l, plane) in planes.iter_mut().enumerate() {
            let s_n = swept.normal_max[l].wide();
            let strain = (swept.strain_max[l].wide() - swept.strain_min[l].wide()) / 2.0;
            plane.parts = match (self.has_shear, self.strain) {
                (false, _) => [strain + slack[0], s_n + slack[1]],
                (true, None) => [0.0, s_n + slack[1]],
                (true, Some(_)) => [0.0, strain + slack[1]],
            };
            for (k, at) in [(5, 0), (3, 1), (4, 2)] {
                plane.instants[k] = swept.at[at][l].wide() as usize;
            }
        }
        let mut low = [0.0; LANES];
        for (low, plane) in low.iter_mut().zip(&*planes) {
            *low = plane.parts[0];
        }
        if self.has_shear {
            let mut lanes = [OfThree {
                on: [0; 3],
                enough: 0.0,
                square: 0.0,
            }; LANES];
            for (lane, plane) in lanes.iter_mut().zip(&*planes) {
                let tangent = &enough.tangent;
                let rest = tangent.second * plane.parts[1] + tangent.constant;
                let first = ((enough.sum - rest) / tangent.first).min(enough.first);
                let radius = ((first - slack[0]) / self.shear_scale).max(0.0);
                *lane = OfThree {
                    on: first_three(plane.instants),
                    enough: radius * radius,
                    square: 0.0,
                };
            }
            let squares = instants.circles(&mut lanes[..planes.len()]);
            for (l, plane) in planes.iter_mut().enumerate() {
                plane.parts[0] = self.shear_scale * squares[l].sqrt() + slack[0];
                low[l] = self.shear_scale * lanes[l].square.sqrt() + slack[0];
                plane.instants[..3].copy_from_slice(&lanes[l].on);
                plane.instants[..3].sort_unstable();
            }
        }
        for (plane, low) in planes.iter_mut().zip(low) {
            plane.value = self.value(plane.parts);
            plane.low = [low - 2.0 * slack[0], plane.parts[1] - 2.0 * slack[1]];
        }
    }

    /// No plane has more of the second part: no component of a unit normal is larger than 1.
    fn most_of_second(&self) -> f64 {
        let of_stress = self.strain.map_or(1.0, |[along, across]| along + across);
        3.0 * of_stress * self.size
    }

    /// Bounds about the best plane, where two instants make its circle, as long as they help.
    fn shear_bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &Known) {
        if self.best != known.n {
            self.best = known.n;
            let First::Shear(_, [a, b, c]) = self.deciding(known.n).first else {
                return;
            };
            let two = if a == b {
                Some([a, c])
            } else {
                (b == c).then_some([a, b])
            };
            self.about = two.map(|on| About::plane(known.n, on, self.path, &mut self.room.squares));
        }
        let Some(about) = &self.about else {
            return;
        };
        let slack = self.slack()[1];
        let second = |eight: &[Face]| {
            if self.law.tie() > 0.0 {
                // It counts for next to nothing: what it is at most anywhere is enough.
                return [[self.most_of_second(); LANES]; 3];
            }
            let corners = corners_of(eight);
            EDGES.map(|(i, j)| {
                let (a, b) = (&corners[i], &corners[j]);
                let normal_max = if self.in_double {
                    self.room.double.mixed(a, b, None).normal_max
                } else {
                    let mixed = self.room.single.mixed(a, b, None);
                    mixed.normal_max.map(f64::from)
                };
                normal_max.map(|most| most + slack)
            })
        };
        let parts = [self.shear_scale, known.parts[0].max(f64::MIN_POSITIVE)];
        if !about.bounds(&self.room.squares, parts, second, (faces, planes), known) {
            self.about = None;
        }
    }

    /// Half the range of the normal strain on a plane.
    fn strain_amplitude(&self, n: [f64; 3], strain: [f64; 2]) -> f64 {
        self.path.range(&strain_weights(n, strain)).amplitude()
    }

    /// The tensor whose normal component is half of the difference of the normal strains of two
    /// instants.
    fn strain_amplitude_of(&self, ends: [usize; 2], [along, across]: [f64; 2]) -> StressTensor {
        let [most, least] = ends.map(|k| self.path.at(k));
        let change: StressTensor = std::array::from_fn(|c| (most[c] - least[c]) / 2.0);
        let trace = change[0] + change[1] + change[2];
        std::array::from_fn(|c| along * change[c] - if c < 3 { across * trace } else { 0.0 })
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

    fn measure(&mut self, planes: &mut [Plane], enough: Enough) {
        // Taken out, so that the planes can be measured with what else is known of the point.
        if self.in_double {
            let mut instants = std::mem::replace(&mut self.room.double, Instants::new());
            for eight in planes.chunks_mut(LANES) {
                self.measure_eight(&mut instants, eight, enough);
            }
            self.room.double = instants;
        } else {
            let mut instants = std::mem::replace(&mut self.room.single, Instants::new());
            for eight in planes.chunks_mut(LANES) {
                self.measure_eight(&mut instants, eight, enough);
            }
            self.room.single = instants;
        }
    }

    fn start(&self) -> &'static Hemisphere {
        match self.law {
            Law::Product => &COARSE,
            Law::Sum(_) | Law::Raised(_) => &FINE,
        }
    }

    fn rounding(&mut self, n: [f64; 3]) -> f64 {
        let ([a, b], slack) = (self.parts(n), self.slack());
        self.value([a + slack[0], b + slack[1]]) - self.value([a, b])
    }

    fn to_double(&mut self) {
        self.in_double = true;
        self.room.double.load(self.path);
    }

    fn value(&self, parts: [f64; 2]) -> f64 {
        self.law.value(parts)
    }

    fn bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &Known) {
        if self.has_shear {
            self.shear_bounds(faces, planes, known);
        } else {
            let (strain, slack) = (self.strain.unwrap_or_default(), self.slack());
            let on = (faces, planes);
            if self.in_double {
                product_bounds(&self.room.double, strain, slack, on, known);
            } else {
                product_bounds(&self.room.single, strain, slack, on, known);
            }
        }
    }

    fn lead(&self) -> f64 {
        if self.has_shear { self.law.tie() } else { LEAD }
    }

    fn tie(&self) -> f64 {
        self.law.tie()
    }

    fn piece(&self, instants: [usize; 6]) -> Deciding {
        let [a, b, c, most, least, at] = instants;
        let change = self
            .strain
            .map(|strain| self.strain_amplitude_of([most, least], strain));
        let first = if self.has_shear {
            First::Shear(self.shear_scale, [a, b, c].map(|k| self.path.at(k)))
        } else {
            First::Normal(change.unwrap_or_default())
        };
        let second = match change {
            Some(tensor) if self.has_shear => tensor,
            _ => self.path.at(at),
        };
        Deciding {
            instants,
            first,
            second,
        }
    }

    fn deciding(&mut self, n: [f64; 3]) -> Deciding {
        let [at, _] = self.path.extremes(&normal_weights(n));
        let weights = self.strain.map(|strain| strain_weights(n, strain));
        let [most, least] = weights.map_or([0; 2], |weights| self.path.extremes(&weights));
        let mut on = [0; 3];
        if self.has_shear {
            self.path.resolve(&Frame::across(n), &mut self.room.shear);
            on = self.room.circles.round(&self.room.shear).on;
            on.sort_unstable();
        }
        self.piece([on[0], on[1], on[2], most, least, at])
    }

    fn tangent(&self, parts: [f64; 2]) -> Tangent {
        self.law.tangent(parts)
    }

    fn bend(&self, largest: f64, sag: f64) -> Bend {
        let (whole, deviation) = self.tresca;
        let along = self.strain.map(|[along, _]| along * deviation);
        let shear = largest / (1.0 - 4.0 * sag);
        let first = if self.has_shear {
            2.0 * shear
        } else {
            along.unwrap_or_default()
        };
        let second = along.filter(|_| self.has_shear).unwrap_or(whole);
        Bend {
            parts: [2.0 * first, 2.0 * second],
            slopes: [first, second],
        }
    }
}

fn first_three([a, b, c, ..]: [usize; 6]) -> [usize; 3] {
    [a, b, c]
}

/// The normal strain on a plane as a sum of the components of the stress.
fn strain_weights(n: [f64; 3], [along, across]: [f64; 2]) -> [f64; 6] {
    let mut weights = normal_weights(n).map(|w| along * w);
    for w in &mut weights[..3] {
        *w -= across;
    }
    weights
}
