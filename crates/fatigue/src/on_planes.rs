//! The criteria that look for a plane, as functions of the plane.
//!
//! S* ([`Histories`]) gives shears and strains; for a criterion of stress it is the stress.
//!
//! M bounds the shear amplitude of all planes, Q Tresca's stress of all instants. Along a great
//! circle these hold (derived):
//!
//! - s_n: second derivative at least -2 Q, slope at most Q;
//! - tau_a: second derivative at least -4 M, slope at most 2 M;
//! - half the strain range: second derivative at least -(1 + nu)/E 2 D, slope at most (1 + nu)/E D.
//!   D bounds Tresca's stress of the deviation of any instant from a constant stress.
//!
//! M and D are taken from S*.

mod bounds;

use crate::circle::Circles;
use crate::combination::Combination;
use crate::definition::PlaneLaw;
use crate::eight_planes::{Instants, ThreePointCircle};
use crate::hemisphere::{COARSE, FINE, Face, Hemisphere};
use crate::histories::Histories;
use crate::lanes::{LANES, Lanes, Real};
use crate::path::{Frame, normal_weights};
use crate::plane_function::{BestPlane, CurvatureBounds, Plane, PlaneFunction, Threshold};
use crate::product_bound::product_bounds;
use crate::refine::{First, Piece};
use crate::shear_bound::BestPlaneBound;
use crate::tangent::Tangent;

/// [`PlaneFunction::lead`] of products, whose faces are large. Of 1000 cycles of two random
/// harmonics 3 end on a plane that is not the best (by 3e-4 at most); with LEAD = 0 it is 16.
const LEAD: f64 = 0.01;

/// Buffers for the shear path on a plane, and for eight planes in single and double precision.
pub(crate) struct ShearBuffers {
    pub(crate) shear: Vec<[Lanes; 2]>,
    pub(crate) circles: Circles,
    single: Instants<f32>,
    double: Instants<f64>,
    /// The squares of [`BestPlaneBound`].
    squares: Instants<f32>,
}

impl Default for ShearBuffers {
    /// Empty buffers.
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

/// A criterion as a function of the planes of one point.
pub(crate) struct OnPlanes<'a> {
    histories: &'a Histories,
    buffers: &'a mut ShearBuffers,
    combination: Combination,
    strain: Option<[f64; 2]>,
    has_shear: bool,
    tresca: (f64, f64),
    /// The largest principal stress of any instant, and its direction.
    tension: (f64, [f64; 3]),
    /// Largest component of any instant, of the stress and of S*.
    sizes: [f64; 2],
    in_double: bool,
    /// The best plane, and the bound near it, if it applies.
    best: [f64; 3],
    near_best: Option<BestPlaneBound>,
}

impl<'a> OnPlanes<'a> {
    /// Prepares the criterion for the histories of one point: bounds and the form of the combination.
    pub(crate) fn new(
        law: PlaneLaw,
        histories: &'a Histories,
        buffers: &'a mut ShearBuffers,
    ) -> Self {
        buffers.single.load(histories);
        let (tresca, sizes) = (histories.tresca_bounds(), histories.max_components());
        Self {
            histories,
            buffers,
            combination: law.combination.for_ratio((tresca.1 / sizes[1]).min(1.0)),
            strain: law.strain,
            has_shear: law.shear,
            tresca,
            tension: histories.stress.max_principal(),
            sizes,
            in_double: false,
            best: [0.0; 3],
            near_best: None,
        }
    }

    /// [`PlaneFunction::measure`] for at most eight planes.
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
            for (k, source) in [(5, 0), (3, 1), (4, 2)] {
                plane.instants[k] = swept.instants[source][l].wide() as usize;
            }
        }
        let mut low = [0.0; LANES];
        for (low, plane) in low.iter_mut().zip(&*planes) {
            *low = plane.parts[0];
        }
        if self.has_shear {
            let mut lanes = [ThreePointCircle {
                instants: [0; 3],
                enough: 0.0,
                square: 0.0,
            }; LANES];
            for (lane, plane) in lanes.iter_mut().zip(&*planes) {
                let tangent = &enough.tangent;
                let known_part = tangent.second * plane.parts[1] + tangent.constant;
                let first = ((enough.sum - known_part) / tangent.first).min(enough.first);
                let radius = (first - slack[0]).max(0.0);
                *lane = ThreePointCircle {
                    instants: first_three(plane.instants),
                    enough: radius * radius,
                    square: 0.0,
                };
            }
            let squares = instants.circles(&mut lanes[..planes.len()]);
            for (l, plane) in planes.iter_mut().enumerate() {
                plane.parts[0] = squares[l].sqrt() + slack[0];
                low[l] = lanes[l].square.sqrt() + slack[0];
                plane.instants[..3].copy_from_slice(&lanes[l].instants);
                plane.instants[..3].sort_unstable();
            }
        }
        for (plane, low) in planes.iter_mut().zip(low) {
            plane.value = self.value(plane.parts);
            plane.low = [low - 2.0 * slack[0], plane.parts[1] - 2.0 * slack[1]];
        }
    }
}

impl PlaneFunction for OnPlanes<'_> {
    /// The two parts on the plane of a unit normal.
    fn parts(&mut self, n: [f64; 3]) -> [f64; 2] {
        match (self.has_shear, self.strain) {
            (false, Some(strain)) => {
                let (s_n, strain) =
                    self.histories
                        .stress
                        .max_and_range(self.histories.strained(), n, strain);
                [strain.amplitude(), s_n]
            }
            (_, strain) => {
                let ShearBuffers { shear, circles, .. } = &mut *self.buffers;
                let [shear, s_n] = self.histories.shear_and_normal(n, shear, circles);
                let strain = strain.map(|strain| strain_weights(n, strain));
                let amplitude =
                    strain.map(|weights| self.histories.strained().range(&weights).amplitude());
                [shear, amplitude.unwrap_or(s_n)]
            }
        }
    }

    /// Evaluates planes eight at a time, in the present precision.
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

    /// A coarse triangulation for products, a fine one for all others.
    fn first_faces(&self) -> &'static Hemisphere {
        match self.combination {
            Combination::Product => &COARSE,
            Combination::Sum(_) | Combination::First { .. } | Combination::Raised(_) => &FINE,
        }
    }

    /// The change of the value by the rounding of its parts.
    fn rounding(&mut self, n: [f64; 3]) -> f64 {
        let ([a, b], slack) = (self.parts(n), self.slack());
        self.value([a + slack[0], b + slack[1]]) - self.value([a, b])
    }

    /// Loads the histories in double precision.
    fn to_double(&mut self) {
        self.in_double = true;
        self.buffers.double.load(self.histories);
    }

    /// The criterion by its two parts.
    fn value(&self, parts: [f64; 2]) -> f64 {
        self.combination.value(parts)
    }

    /// Lowers the bounds of faces, by shear or by products as the criterion needs.
    fn bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &BestPlane) {
        if self.has_shear {
            self.shear_bounds(faces, planes, known);
        } else {
            let (strain, slack) = (self.strain.unwrap_or_default(), self.slack());
            let faces_and_planes = (faces, planes);
            if self.in_double {
                product_bounds(&self.buffers.double, strain, slack, faces_and_planes, known);
            } else {
                product_bounds(&self.buffers.single, strain, slack, faces_and_planes, known);
            }
        }
    }

    /// Relative lead of a value below which pieces are refined.
    fn lead(&self) -> f64 {
        if self.has_shear {
            self.combination.tie()
        } else {
            LEAD
        }
    }

    /// Relative difference below which planes tie.
    fn tie(&self) -> f64 {
        self.combination.tie()
    }

    /// The smooth function of the plane that the given instants define: three of the circle, two of the strain,
    /// one of the normal stress.
    fn piece(&self, instants: [usize; 6]) -> Piece {
        let [a, b, c, max_at, min_at, second_at] = instants;
        let change = self.strain.map(|strain| {
            self.histories
                .strain_amplitude_tensor([max_at, min_at], strain)
        });
        let first = if self.has_shear {
            First::Shear([a, b, c].map(|k| self.histories.strained().stress_at(k)))
        } else {
            First::Normal(change.unwrap_or_default())
        };
        let second = match change {
            Some(tensor) if self.has_shear => tensor,
            _ => self.histories.stress.stress_at(second_at),
        };
        Piece {
            instants,
            first,
            second,
        }
    }

    /// The piece of the instants that decide on a plane.
    fn deciding_piece(&mut self, n: [f64; 3]) -> Piece {
        let [second_at, _] = self.histories.stress.extreme_instants(&normal_weights(n));
        let weights = self.strain.map(|strain| strain_weights(n, strain));
        let [max_at, min_at] = weights.map_or([0; 2], |weights| {
            self.histories.strained().extreme_instants(&weights)
        });
        let mut on = [0; 3];
        if self.has_shear {
            let (strained, plane) = (self.histories.strained(), Frame::from_normal(n));
            strained.resolve_on_plane(strained, &plane, &mut self.buffers.shear);
            on = self
                .buffers
                .circles
                .smallest_circle(&self.buffers.shear)
                .instants;
            on.sort_unstable();
        }
        self.piece([on[0], on[1], on[2], max_at, min_at, second_at])
    }

    /// A linear bound that is exact at these parts.
    fn tangent(&self, parts: [f64; 2]) -> Tangent {
        self.combination.tangent(parts)
    }

    /// Bounds on the second derivatives of both parts, from the largest first part and the sag of the
    /// triangles.
    fn curvature_bounds(&self, largest: f64, sag: f64) -> CurvatureBounds {
        let (whole, deviation) = self.tresca;
        let strain_bound = self
            .strain
            .map(|[strain_bound, _]| strain_bound * deviation);
        let shear = largest / (1.0 - 4.0 * sag);
        let first = if self.has_shear {
            2.0 * shear
        } else {
            strain_bound.unwrap_or_default()
        };
        let second = strain_bound.filter(|_| self.has_shear).unwrap_or(whole);
        CurvatureBounds {
            parts: [2.0 * first, 2.0 * second],
            slopes: [first, second],
            first: if self.has_shear {
                shear
            } else {
                largest + 2.0 * first * sag
            },
        }
    }

    /// A value that is not small.
    fn yardstick(&self, bend: &CurvatureBounds) -> f64 {
        self.combination.yardstick(bend.first)
    }

    /// Upper bound of the criterion on all planes.
    fn ceiling(&self, bend: &CurvatureBounds) -> f64 {
        let second = match self.strain {
            Some(_) if self.has_shear => self.max_second_part(),
            _ => self.tension.0,
        };
        self.combination.value([bend.first, second])
    }
}

/// The instants that define the circle.
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
