//! The criteria that look for a plane, as functions of the plane.
//!
//! M bounds the shear amplitude of all planes, Q Tresca's stress of all instants. Along a great
//! circle the second derivative of s_n is at least -2 Q, its slope at most Q; that of tau_a at
//! least -4 M, its slope at most 2 M; that of half the strain range at least -(1 + nu)/E 2 D, its
//! slope at most (1 + nu)/E D, D bounding Tresca's stress of the deviation of any instant from a
//! constant stress (derived).

use stress_tensor::StressTensor;

use crate::circle::Circles;
use crate::combination::Combination;
use crate::critical_plane::Peak;
use crate::definition::OnPlane;
use crate::eight_planes::{Instants, OfThree};
use crate::forms::{EDGES, corners_of};
use crate::hemisphere::{COARSE, FINE, Face, Hemisphere};
use crate::lanes::{LANES, Lanes, ROUNDING, Real};
use crate::path::{Frame, Path, normal_weights};
use crate::plane_function::{Bend, BestPlane, Plane, PlaneFunction, Threshold};
use crate::product_bound::product_bounds;
use crate::refine::{Deciding, First};
use crate::shear_bound::About;
use crate::tangent::Tangent;

/// [`PlaneFunction::lead`] of products, whose faces are large. Of 1000 cycles of two random
/// harmonics 3 end on a plane that is not the best (by 3e-4 at most); with LEAD = 0 it is 16.
const LEAD: f64 = 0.01;

/// Stresses below this part of the largest component are rounding.
const NOTHING: f64 = 1e-12;

/// Buffers for the shear path on a plane, and for eight planes in single and double precision.
pub(crate) struct ShearBuffers {
    pub(crate) shear: Vec<[Lanes; 2]>,
    pub(crate) circles: Circles,
    single: Instants<f32>,
    double: Instants<f64>,
    /// The squares of [`About`].
    squares: Instants<f32>,
}

impl Default for ShearBuffers {
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
pub(crate) struct OnPlanes<'a> {
    path: &'a Path,
    buffers: &'a mut ShearBuffers,
    combination: Combination,
    strain: Option<[f64; 2]>,
    has_shear: bool,
    tresca: (f64, f64),
    /// The largest principal stress of any instant, and its direction.
    tension: (f64, [f64; 3]),
    /// Largest component of any instant.
    size: f64,
    in_double: bool,
    /// The best plane, and the bound about it, if it applies.
    best: [f64; 3],
    about: Option<About>,
}

impl<'a> OnPlanes<'a> {
    pub(crate) fn new(of: OnPlane, path: &'a Path, buffers: &'a mut ShearBuffers) -> Self {
        buffers.single.load(path);
        let tresca = path.tresca_bounds();
        Self {
            path,
            buffers,
            combination: of.combination.for_ratio((tresca.1 / path.size()).min(1.0)),
            strain: of.strain,
            has_shear: of.shear,
            tresca,
            tension: path.most_tension(),
            size: path.size(),
            in_double: false,
            best: [0.0; 3],
            about: None,
        }
    }

    /// The plane of histories that need no search: no tension where the criterion requires it, or a
    /// stress that changes hydrostatically only, so that no plane is sheared.
    ///
    /// No plane's normal is returned where the value is 0 on all of them.
    pub(crate) fn without_search(&mut self) -> Option<Peak> {
        let (tension, along) = self.tension;
        let most = self
            .strain
            .map_or(0.0, |[along, across]| along + 3.0 * across);
        let first = if self.has_shear {
            self.tresca.1
        } else {
            most * self.size
        };
        let nowhere = |missed: f64| {
            let n = [f64::NAN; 3];
            Some(Peak {
                n,
                value: 0.0,
                missed,
                planes: 0,
            })
        };
        let of_tension = matches!(
            self.combination,
            Combination::Product | Combination::Raised(_)
        );
        if of_tension && self.combination.value([first, tension - NOTHING]) <= 0.0 {
            return nowhere(self.combination.value([first, tension]));
        }
        if self.tresca.1 > NOTHING {
            return None;
        }
        let parts = self.parts(along);
        let value = self.combination.value(parts);
        let change = self.strain.map_or(0.0, |[along, _]| along * self.tresca.1);
        let ceiling = match (self.has_shear, self.strain) {
            (true, None) => [self.tresca.1, tension],
            (true, Some(_)) => [self.tresca.1, parts[1] + change],
            (false, _) => [parts[0] + change, tension],
        };
        let missed = (self.combination.value(ceiling) - value).max(0.0);
        Some(Peak {
            n: along,
            value,
            missed,
            planes: 0,
        })
    }

    /// Bounds of the rounding errors of the two parts.
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
            (true, strain) => [stress, strain.unwrap_or(stress)],
            (false, strain) => [strain.unwrap_or(stress), stress],
        }
    }

    /// [`PlaneFunction::measure`] of at most eight planes.
    fn measure_eight<F: Real>(
        &self,
        instants: &mut Instants<F>,
        planes: &mut [Plane],
        enough: Threshold,
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
                let radius = (first - slack[0]).max(0.0);
                *lane = OfThree {
                    on: first_three(plane.instants),
                    enough: radius * radius,
                    square: 0.0,
                };
            }
            let squares = instants.circles(&mut lanes[..planes.len()]);
            for (l, plane) in planes.iter_mut().enumerate() {
                plane.parts[0] = squares[l].sqrt() + slack[0];
                low[l] = lanes[l].square.sqrt() + slack[0];
                plane.instants[..3].copy_from_slice(&lanes[l].on);
                plane.instants[..3].sort_unstable();
            }
        }
        for (plane, low) in planes.iter_mut().zip(low) {
            plane.value = self.value(plane.parts);
            plane.low = [low - 2.0 * slack[0], plane.parts[1] - 2.0 * slack[1]];
        }
    }

    /// Upper bound of the second part on all planes: no component of a unit normal is larger
    /// than 1.
    fn most_of_second(&self) -> f64 {
        let of_stress = self.strain.map_or(1.0, |[along, across]| along + across);
        3.0 * of_stress * self.size
    }

    /// Lowers the bounds by [`About`] the best plane, if two instants define its circle, as long as
    /// that excludes faces.
    fn shear_bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &BestPlane) {
        if self.best != known.n {
            self.best = known.n;
            let First::Shear([a, b, c]) = self.deciding(known.n).first else {
                return;
            };
            let two = if a == b {
                Some([a, c])
            } else {
                (b == c).then_some([a, b])
            };
            self.about =
                two.map(|on| About::plane(known.n, on, self.path, &mut self.buffers.squares));
        }
        let Some(about) = &self.about else {
            return;
        };
        let slack = self.slack()[1];
        let second = |eight: &[Face]| {
            if self.combination.tie() > 0.0 {
                // Its weight is tiny: an upper bound over all planes is enough.
                return [[self.most_of_second(); LANES]; 3];
            }
            let corners = corners_of(eight);
            EDGES.map(|(i, j)| {
                let (a, b) = (&corners[i], &corners[j]);
                let normal_max = if self.in_double {
                    self.buffers.double.mixed(a, b, None).normal_max
                } else {
                    let mixed = self.buffers.single.mixed(a, b, None);
                    mixed.normal_max.map(f64::from)
                };
                normal_max.map(|most| most + slack)
            })
        };
        let first = known.parts[0].max(f64::MIN_POSITIVE);
        if !about.bounds(&self.buffers.squares, first, second, (faces, planes), known) {
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
        let s_n = self
            .path
            .resolve(&Frame::across(n), &mut self.buffers.shear);
        [self.buffers.circles.round(&self.buffers.shear).radius, s_n]
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
                [shear, second]
            }
        }
    }

    fn measure(&mut self, planes: &mut [Plane], enough: Threshold) {
        // Moved out of `self`, which the evaluation borrows.
        if self.in_double {
            let mut instants = std::mem::replace(&mut self.buffers.double, Instants::new());
            for eight in planes.chunks_mut(LANES) {
                self.measure_eight(&mut instants, eight, enough);
            }
            self.buffers.double = instants;
        } else {
            let mut instants = std::mem::replace(&mut self.buffers.single, Instants::new());
            for eight in planes.chunks_mut(LANES) {
                self.measure_eight(&mut instants, eight, enough);
            }
            self.buffers.single = instants;
        }
    }

    fn start(&self) -> &'static Hemisphere {
        match self.combination {
            Combination::Product => &COARSE,
            Combination::Sum(_) | Combination::First { .. } | Combination::Raised(_) => &FINE,
        }
    }

    fn rounding(&mut self, n: [f64; 3]) -> f64 {
        let ([a, b], slack) = (self.parts(n), self.slack());
        self.value([a + slack[0], b + slack[1]]) - self.value([a, b])
    }

    fn to_double(&mut self) {
        self.in_double = true;
        self.buffers.double.load(self.path);
    }

    fn value(&self, parts: [f64; 2]) -> f64 {
        self.combination.value(parts)
    }

    fn bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &BestPlane) {
        if self.has_shear {
            self.shear_bounds(faces, planes, known);
        } else {
            let (strain, slack) = (self.strain.unwrap_or_default(), self.slack());
            let on = (faces, planes);
            if self.in_double {
                product_bounds(&self.buffers.double, strain, slack, on, known);
            } else {
                product_bounds(&self.buffers.single, strain, slack, on, known);
            }
        }
    }

    fn lead(&self) -> f64 {
        if self.has_shear {
            self.combination.tie()
        } else {
            LEAD
        }
    }

    fn tie(&self) -> f64 {
        self.combination.tie()
    }

    fn piece(&self, instants: [usize; 6]) -> Deciding {
        let [a, b, c, most, least, at] = instants;
        let change = self
            .strain
            .map(|strain| self.strain_amplitude_of([most, least], strain));
        let first = if self.has_shear {
            First::Shear([a, b, c].map(|k| self.path.at(k)))
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
            self.path
                .resolve(&Frame::across(n), &mut self.buffers.shear);
            on = self.buffers.circles.round(&self.buffers.shear).on;
            on.sort_unstable();
        }
        self.piece([on[0], on[1], on[2], most, least, at])
    }

    fn tangent(&self, parts: [f64; 2]) -> Tangent {
        self.combination.tangent(parts)
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
            first: if self.has_shear {
                shear
            } else {
                largest + 2.0 * first * sag
            },
        }
    }

    fn yardstick(&self, bend: &Bend) -> f64 {
        self.combination.yardstick(bend.first)
    }

    fn ceiling(&self, bend: &Bend) -> f64 {
        let second = match self.strain {
            Some(_) if self.has_shear => self.most_of_second(),
            _ => self.tension.0,
        };
        self.combination.value([bend.first, second])
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
