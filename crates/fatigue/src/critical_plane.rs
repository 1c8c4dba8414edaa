//! The plane on which a criterion is largest, with a bound on the value of all other planes.
//!
//! On a plane turned by the angle t about an axis in it, each component of the stress is m + r
//! cos(2 t + c) or r cos(t + c). Normal stresses, strain ranges and shear amplitudes are largest
//! values of such functions, so that along every great circle their second derivative is nowhere
//! below some -K (at kinks, where another instant takes over, it is +infinity). Within a circle of
//! radius r about c the function K (1 - cos d(n, c))/cos r has a second derivative of at least K.
//! Added to such a quantity it makes it convex, and a convex function on a triangle is largest at a
//! corner (derived):
//!
//! f(n) <= largest f of the corners + K (1/cos r - 1) in the triangle of circumradius r.
//!
//! For criteria that are products f is a sum of their parts ([`Tangent`]). If this bound does not
//! exclude a triangle, the sharper bounds of [`crate::face_bound`], which uses the differences of
//! the corners, and of [`crate::forms`] are tried. Triangles whose bound exceeds the best value are
//! divided into four until the bound is within the tolerance of the best. Planes are evaluated
//! eight at a time, in single precision where the rounding error, which is added to the values, is
//! small against the tolerance; the smallest circle of a plane is not completed if that plane
//! cannot be the best. The best plane is then refined: with the deciding instants fixed the
//! criterion is a smooth function of the plane, a piece, whose maximum Newton's method finds; if
//! other instants decide there, their piece is next. The criterion is the largest of these smooth
//! functions, so that its maximum is found to rounding, far closer than the proved bound.
//!
//! Two planes whose normals are n and the direction of the shear amplitude on n are complementary:
//! n.dS.s is the shear amplitude on both if two instants, which differ by 2 dS, decide. If the
//! first part is the shear amplitude and decides alone, the search may find one of the two. The
//! other one is always compared with it.

use crate::face_limit::FaceBound;
use crate::hemisphere::{Face, arc_midpoint};
use crate::lanes::LANES;
use crate::path::dot;
use crate::plane_function::{BestPlane, CurvatureBounds, NO_EDGE, Plane, PlaneFunction, Threshold};
use crate::refine::{refine, refine_roughly};
use crate::tangent::Tangent;

/// Limits of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Relative tolerance of the proof that no plane is better (default: 1e-3). Values below 1e-3
    /// times the largest possible value for this stress have a tolerance of 1e-3 times this part of
    /// that value. The plane found is usually the best one to rounding.
    pub tolerance: f64,
    /// Most planes (default: 4096): a bound on time and memory, reached by histories with hardly
    /// any tension or shear. [`crate::PointResult::missed`] is larger then.
    pub planes: usize,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            planes: 4096,
        }
    }
}

/// The best plane found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Peak {
    pub(crate) n: [f64; 3],
    pub(crate) value: f64,
    /// No plane has more than value + missed.
    pub(crate) missed: f64,
    /// Number of planes evaluated.
    pub(crate) planes: usize,
}

/// Buffers of the search.
#[derive(Default)]
pub(crate) struct Buffers {
    planes: Vec<Plane>,
    faces: Vec<Face>,
    cut: Vec<Face>,
    /// Edges with a known middle: the other end, the plane of the middle, the next edge of the same
    /// end (linked list).
    edges: Vec<[usize; 3]>,
    corners: Vec<usize>,
    tried: Vec<([usize; 6], [f64; 3])>,
    /// Refined planes and their values.
    tops: Vec<([f64; 3], f64)>,
}

/// Values below this part of the yardstick of the stress are small. Their tolerance is the
/// tolerance of SMALL times the yardstick.
const SMALL: f64 = 1e-3;
/// First parts are equal if their relative difference is below EQUAL.
const EQUAL: f64 = 1e-9;
/// Relative rounding error of a first part.
const ROUNDED: f64 = 1e-14;
/// If at most FEW triangles are left, they are divided further, beyond the tolerance, as long as
/// their bound exceeds the value with which planes tie.
const FEW: usize = 48;
/// Planes within 18 degrees (this cosine) and with the same deciding instants lead to the same
/// maximum.
const NEARBY: f64 = 0.95;
/// Planes with a larger cosine are the same: twice the error of a maximum before it is refined.
const SAME: f64 = 1.0 - 2e-6;
/// Most pieces that are refined.
const PIECES: usize = 24;

impl Search {
    /// Finds the plane on which `f` is largest: all planes of a triangulation, then finer triangles wherever
    /// their bounds allow a larger value.
    pub(crate) fn peak(&self, f: &mut impl PlaneFunction, buffers: &mut Buffers) -> Peak {
        let start = f.first_faces();
        buffers.tried.clear();
        buffers.tops.clear();
        let mut bend = buffers.first_planes(f);
        let mut best = buffers.refine_plane(f, buffers.best_plane(0..buffers.planes.len()));
        let yardstick = f.yardstick(&bend);
        let tolerance = |value: f64| self.tolerance * value.abs().max(SMALL * yardstick);
        if f.rounding(best.n) >= 0.05 * tolerance(best.value) {
            f.to_double();
            bend = buffers.first_planes(f);
        }
        let mut record = f.best_plane(best.n, best.value, tolerance(best.value));
        let ceiling = f.ceiling(&bend);
        let mut missed = ceiling - best.value;
        let mut seen = buffers.planes.len();
        let is_settled = ceiling <= record.values[2];
        for cuts in 0.. {
            if is_settled {
                buffers.faces.clear();
                break;
            }
            let Buffers {
                planes, faces, cut, ..
            } = buffers;
            let among = if cuts == 0 { &start.faces } else { &*cut };
            if record.n != best.n {
                record = f.best_plane(best.n, best.value, tolerance(best.value));
            }
            let BestPlane {
                tangent,
                values: [_, tied, near],
                ..
            } = record;
            faces.clear();
            let limit = FaceBound::new(&bend, tangent, best.value);
            for face in among {
                let bound = limit.bound(f, face, planes);
                if bound > best.value {
                    faces.push(Face {
                        most: bound,
                        ..*face
                    });
                }
            }
            if !faces.is_empty() {
                f.bounds(faces, planes, &record);
                faces.retain(|face| face.most > best.value);
            }
            let bound = faces.iter().fold(best.value, |m, face| m.max(face.most));
            missed = bound.min(ceiling) - best.value;
            let open = tied > best.value && faces.len() <= FEW && bound > tied;
            let done = bound <= near && !open;
            // The division of a face adds three planes at most.
            let full = seen + 3 * faces.len() > self.planes;
            if faces.is_empty() || done || full {
                break;
            }
            buffers.divide_faces();
            let sag = buffers.cut.iter().map(|f| f.sag).fold(0.0, f64::max);
            let enough = Threshold {
                first: f64::INFINITY,
                tangent,
                sum: tangent.sum_at_value(best.value) - bend.for_sum(&tangent) * sag,
            };
            f.measure(&mut buffers.planes[seen..], enough);
            let higher = buffers.best_plane(seen..buffers.planes.len());
            seen = buffers.planes.len();
            if buffers.planes[higher].value > best.value {
                let candidate = buffers.refine_plane(f, higher);
                if candidate.value > best.value {
                    best = candidate;
                }
            }
        }
        let proved = best.value + missed;
        buffers.try_remaining_pieces(f, &mut best);
        if f.tie() > 0.0 {
            buffers.choose_by_first_part(f, &mut best);
        }
        Peak {
            missed: (proved - best.value).max(0.0),
            planes: buffers.planes.len(),
            ..best
        }
    }
}

impl Buffers {
    /// Evaluates the planes of the first triangles; returns the bounds on second derivatives.
    fn first_planes(&mut self, f: &mut impl PlaneFunction) -> CurvatureBounds {
        let start = f.first_faces();
        self.planes.clear();
        self.planes
            .extend(start.planes.iter().map(|n| Plane::unevaluated(*n, [0; 6])));
        let (mut largest, mut best) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        let mut enough = Threshold {
            first: f64::NEG_INFINITY,
            tangent: Tangent::NONE,
            sum: f64::NEG_INFINITY,
        };
        let mut instants = [0; 6];
        for planes in self.planes.chunks_mut(LANES) {
            for plane in &mut *planes {
                plane.instants = instants;
            }
            f.measure(planes, enough);
            for plane in &*planes {
                largest = plane.parts[0].max(largest);
                if plane.value > best {
                    (best, enough.tangent) = (plane.value, f.tangent(plane.parts));
                }
            }
            instants = planes[planes.len() - 1].instants;
            let K = f
                .curvature_bounds(largest, start.sag)
                .for_sum(&enough.tangent);
            enough.first = largest;
            enough.sum = enough.tangent.sum_at_value(best) - K * start.sag;
        }
        f.curvature_bounds(largest, start.sag)
    }

    /// The index of the plane with the largest value.
    fn best_plane(&self, among: std::ops::Range<usize>) -> usize {
        let value = |p: &usize| self.planes[*p].value;
        let best_index = among.max_by(|a, b| value(a).total_cmp(&value(b)));
        best_index.unwrap_or(0)
    }

    /// Finds the maximum by refining the piece of a plane.
    fn refine_plane(&mut self, f: &mut impl PlaneFunction, plane: usize) -> Peak {
        let n = self.planes[plane].n;
        let mut best = (n, f.criterion_at(n));
        for _ in 0..8 {
            let piece = f.deciding_piece(best.0);
            self.tried.push((piece.instants, best.0));
            let (top, value_of_piece) = refine(&|n| f.value(piece.parts(n)), best.0);
            let value = f.criterion_at(top);
            let rounding = 4.0 * f64::EPSILON * value.abs();
            if value < best.1 - rounding {
                break;
            }
            best = (top, value);
            if value <= value_of_piece + rounding {
                break;
            }
        }
        let piece = f.deciding_piece(best.0);
        let (top, _) = refine(&|n| f.value(piece.smooth_parts(n)), best.0);
        let value = f.criterion_at(top);
        if value >= best.1 - 4.0 * f64::EPSILON * value.abs() {
            best = (top, value);
        }
        self.tops.push(best);
        Peak {
            n: best.0,
            value: best.1,
            missed: 0.0,
            planes: 0,
        }
    }

    /// Refines the pieces at the corners of the faces that are left, where these may exceed the best value.
    fn try_remaining_pieces(&mut self, f: &mut impl PlaneFunction, best: &mut Peak) {
        self.corners.clear();
        self.corners
            .extend(self.faces.iter().flat_map(|face| face.planes));
        self.corners.sort_unstable();
        self.corners.dedup();
        for k in 0..self.corners.len() {
            let plane = self.corners[k];
            let Plane { n, instants, .. } = self.planes[plane];
            let again = |(tried, tried_normal): &([usize; 6], [f64; 3])| {
                *tried == instants && dot(*tried_normal, n).abs() > NEARBY
            };
            if self.tried.iter().any(again) || self.tried.len() > PIECES {
                continue;
            }
            self.tried.push((instants, n));
            let piece = f.piece(instants);
            let enough = best.value - f.lead() * best.value.abs();
            let (maximum, top) = refine_roughly(&|n| f.value(piece.quick_parts(n)), n, enough);
            let is_known = |(tried_normal, value): &([f64; 3], f64)| {
                dot(*tried_normal, maximum).abs() > SAME && *value >= top
            };
            if top > enough && !self.tops.iter().any(is_known) {
                let candidate = self.refine_plane(f, plane);
                if candidate.value > best.value {
                    *best = candidate;
                }
            }
        }
    }

    /// Chooses the plane by the first part, among the planes found and their complementary planes.
    /// Of planes with equal first parts the one with the larger second part is taken.
    fn choose_by_first_part(&mut self, f: &mut impl PlaneFunction, best: &mut Peak) {
        let enough = best.value - f.tie() * best.value.abs();
        let mut best_found: Option<([f64; 3], [f64; 2])> = None;
        for k in 0..self.tops.len() {
            let (n, value) = self.tops[k];
            if value < enough {
                continue;
            }
            let (piece, mut n, mut parts) = (f.deciding_piece(n), n, f.parts(n));
            let (top, _) = refine(&|n| piece.parts(n)[0], n);
            let (smooth, _) = refine(&|n| piece.smooth_parts(n)[0], top);
            for top in [top, smooth] {
                let higher = f.parts(top);
                if higher[0] >= parts[0] * (1.0 - ROUNDED) {
                    (n, parts) = (top, higher);
                }
            }
            let complement = f.deciding_piece(n).complementary(n);
            let complement = complement.map(|complement| (complement, f.parts(complement)));
            for (n, parts) in [Some((n, parts)), complement].into_iter().flatten() {
                let better = best_found.is_none_or(|(_, [first, second])| {
                    let equal = (parts[0] - first).abs() <= EQUAL * first;
                    if equal {
                        parts[1] > second
                    } else {
                        parts[0] > first
                    }
                });
                if better {
                    best_found = Some((n, parts));
                }
            }
        }
        if let Some((n, _)) = best_found {
            best.n = n;
        }
    }

    /// Divides every face into four.
    fn divide_faces(&mut self) {
        self.edges.clear();
        for plane in &mut self.planes {
            plane.edge = NO_EDGE;
        }
        let mut cut = std::mem::take(&mut self.cut);
        let faces = std::mem::take(&mut self.faces);
        cut.clear();
        for Face {
            corners, planes, ..
        } in &faces
        {
            let ([a, b, c], [i, j, k]) = (*corners, *planes);
            let (ab, l) = self.edge_midpoint((a, i), (b, j));
            let (bc, m) = self.edge_midpoint((b, j), (c, k));
            let (ca, o) = self.edge_midpoint((c, k), (a, i));
            let face = Face::new;
            cut.extend([
                face([a, ab, ca], [i, l, o]),
                face([ab, b, bc], [l, j, m]),
                face([ca, bc, c], [o, m, k]),
                face([ab, bc, ca], [l, m, o]),
            ]);
        }
        (self.faces, self.cut) = (faces, cut);
    }

    /// Returns the middle of an edge and its plane, which is evaluated once.
    fn edge_midpoint(
        &mut self,
        (a, i): ([f64; 3], usize),
        (b, j): ([f64; 3], usize),
    ) -> ([f64; 3], usize) {
        let (n, low, high) = (arc_midpoint(a, b), i.min(j), i.max(j));
        let mut edge = self.planes[low].edge;
        while edge != NO_EDGE {
            let [end, middle, next] = self.edges[edge];
            // Opposite corners are one plane: two edges may have the same ends.
            if end == high && dot(self.planes[middle].n, n).abs() > 1.0 - 1e-9 {
                return (n, middle);
            }
            edge = next;
        }
        let middle = self.planes.len();
        let higher = if self.planes[i].value >= self.planes[j].value {
            i
        } else {
            j
        };
        let guess = self.planes[higher].instants;
        self.planes.push(Plane::unevaluated(n, guess));
        self.edges.push([high, middle, self.planes[low].edge]);
        self.planes[low].edge = self.edges.len() - 1;
        (n, middle)
    }
}
