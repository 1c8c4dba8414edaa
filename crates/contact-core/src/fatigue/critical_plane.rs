//! The plane on which a criterion is largest, with a bound on what the search may have missed.
//!
//! On a plane turned by the angle t about an axis in it, each component of the stress is
//! m + r cos(2 t + c) or r cos(t + c). Normal stresses, strain ranges and shear amplitudes are
//! largest values of such functions, so that along every great circle their second derivative is
//! nowhere below some -K (where pieces meet, it is infinitely positive). Within a circle of radius r
//! about c the function K (1 - cos d(n, c))/cos r has a second derivative of at least K. Added to
//! such a quantity it makes it convex, and a convex function on a triangle is largest at a corner
//! (derived):
//!
//! f(n) <= largest f of the corners + K (1/cos r - 1) in the triangle of circumradius r.
//!
//! Where that does not rule a triangle out, the bound of [`most_on`] is taken, which counts how the
//! corners differ. The triangles that may hold more than the best plane known are cut into four until
//! the bound is within the tolerance of the best. Planes are measured eight at a time, in single
//! precision where rounding, which is added to what is measured, is small against the tolerance, and
//! a circle is not made the smallest where its plane cannot matter. What is left is refined: the instants that decide on a plane
//! make a smooth function of it, a piece, whose top Newton's steps find; where other instants decide
//! there, their piece is next. The largest value of several smooth functions is the top of one of
//! them, so the place is found to rounding, much nearer than what is proved.

use super::face_bound::most_on;
use super::hemisphere::{Face, HEMISPHERE, midway};
use super::lanes::LANES;
use super::path::dot;
use super::refine::{Deciding, nearly, refine};

/// How far the search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Largest part of the value by which a plane may be proved better than the one found
    /// (default: 1e-3). The plane found is usually the best one to rounding.
    pub tolerance: f64,
    /// Times the first 160 triangles may be cut into four (default: 12).
    pub cuts: usize,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            cuts: 12,
        }
    }
}

/// A plane that was looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// Unit normal.
    pub(super) n: [f64; 3],
    /// Two quantities, and the criterion, which rises with both: no less than they are.
    pub(super) parts: [f64; 2],
    pub(super) value: f64,
    /// The criterion is no less than this.
    pub(super) low: f64,
    /// The instants that decide, as in [`Deciding`]; before it is measured a guess.
    pub(super) instants: [usize; 6],
    /// First of the edges that have this as the end of the smaller number.
    edge: usize,
}

/// A plane whose first part and value are at most these need not be known better.
#[derive(Clone, Copy, Debug)]
pub(super) struct Enough {
    pub(super) first: f64,
    pub(super) value: f64,
}

/// Bounds on second derivatives along great circles: those are nowhere below -K.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    pub(super) parts: [f64; 2],
    pub(super) value: f64,
    /// Bound on slopes of the value, up and down.
    pub(super) slope: f64,
}

/// A criterion on planes.
pub(super) trait PlaneFunction {
    /// Parts and values of planes, of which some need to be no better than `enough`.
    fn measure(&mut self, planes: &mut [Plane], enough: Enough);
    /// What rounding may add to the value of these parts as measured.
    fn rounding(&self, parts: [f64; 2]) -> f64;
    /// Measures in double precision from here on.
    fn to_double(&mut self);
    /// The two quantities on the plane of a unit normal, to rounding.
    fn parts(&mut self, n: [f64; 3]) -> [f64; 2];
    /// The criterion, which rises with both.
    fn value(&self, parts: [f64; 2]) -> f64;
    /// The bounds, from the largest parts on the first planes and the largest 1/cos r - 1 of their
    /// triangles.
    fn bend(&self, largest: [f64; 2], sag: f64) -> Bend;
    /// Whether a second quantity chooses between planes of equal first ones: complementary planes
    /// have the same shear.
    fn has_ties(&self) -> bool;
    /// The piece of instants.
    fn piece(&self, instants: [usize; 6]) -> Deciding;
    /// The piece of the instants that decide on the plane of a unit normal, to rounding.
    fn deciding(&mut self, n: [f64; 3]) -> Deciding;

    /// The criterion on the plane of a unit normal, to rounding.
    fn at(&mut self, n: [f64; 3]) -> f64 {
        let parts = self.parts(n);
        self.value(parts)
    }
}

/// The best plane found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Peak {
    pub(super) n: [f64; 3],
    pub(super) value: f64,
    /// No plane has more than value + missed.
    pub(super) missed: f64,
    /// Planes looked at.
    pub(super) planes: usize,
}

/// Room for the search.
#[derive(Default)]
pub(super) struct Room {
    planes: Vec<Plane>,
    faces: Vec<Face>,
    cut: Vec<Face>,
    /// Middles of edges: the other end, the number of the middle, the next edge of the same end.
    edges: Vec<[usize; 3]>,
    corners: Vec<usize>,
    tried: Vec<([usize; 6], [f64; 3])>,
}

/// No edge.
const NONE: usize = usize::MAX;
/// Triangles that are so few that they are cut on beyond the tolerance where planes may tie.
const FEW: usize = 48;
/// Planes nearer to each other than this cosine, 18 degrees, lead to the same top of a piece.
const NEAR: f64 = 0.95;
/// Pieces whose top is refined at most.
const PIECES: usize = 24;

impl Plane {
    /// Not yet measured.
    fn of(n: [f64; 3], instants: [usize; 6]) -> Self {
        Self {
            n,
            parts: [f64::NAN; 2],
            value: f64::NAN,
            low: f64::NAN,
            instants,
            edge: NONE,
        }
    }
}

impl Search {
    /// The plane on which `f` is largest.
    pub(super) fn peak(&self, f: &mut impl PlaneFunction, room: &mut Room) -> Peak {
        let start = &*HEMISPHERE;
        room.tried.clear();
        let mut bend = room.first_planes(f);
        let first = room.planes[room.best(0..room.planes.len())];
        if f.rounding(first.parts) > 0.05 * self.tolerance * first.value.abs() {
            f.to_double();
            bend = room.first_planes(f);
        }
        let mut best = room.refined(f, room.best(0..room.planes.len()));
        let mut missed = 0.0;
        let mut seen = room.planes.len();
        for cuts in 0..=self.cuts {
            let Room {
                planes, faces, cut, ..
            } = room;
            let among = if cuts == 0 { &start.faces } else { &*cut };
            let mut most = best.value;
            faces.clear();
            for face in among {
                let bound = bound(f, face, planes, &bend, best.value);
                if bound > best.value {
                    most = most.max(bound);
                    faces.push(*face);
                }
            }
            missed = most - best.value;
            let few = if f.has_ties() { FEW } else { 0 };
            let done = missed <= self.tolerance * best.value.abs() && faces.len() > few;
            if faces.is_empty() || done || cuts == self.cuts {
                break;
            }
            room.cut();
            let sag = room.cut.iter().map(|f| f.sag).fold(0.0, f64::max);
            let enough = Enough {
                first: f64::INFINITY,
                value: best.value - bend.value * sag,
            };
            f.measure(&mut room.planes[seen..], enough);
            let higher = room.best(seen..room.planes.len());
            seen = room.planes.len();
            if room.planes[higher].value > best.value {
                let other = room.refined(f, higher);
                if other.value > best.value {
                    best = other;
                }
            }
        }
        let proved = best.value + missed;
        room.try_the_rest(f, &mut best);
        Peak {
            missed: (proved - best.value).max(0.0),
            planes: room.planes.len(),
            ..best
        }
    }
}

/// No plane in the face has more; not the least such number where it is below the best.
fn bound(f: &impl PlaneFunction, face: &Face, planes: &[Plane], bend: &Bend, best: f64) -> f64 {
    let [a, b, c] = face.planes;
    let [a, b, c] = [&planes[a], &planes[b], &planes[c]];
    let most = |a: f64, b: f64, c: f64| a.max(b).max(c);
    let whole = most(a.value, b.value, c.value) + bend.value * face.sag;
    if whole <= best {
        return whole;
    }
    let low = most(a.low, b.low, c.low) - bend.slope * 2.0 * (2.0 * face.sag).sqrt();
    let whole = most_on(face, [a.value, b.value, c.value], low, bend.value);
    if whole <= best {
        return whole;
    }
    let part = |k: usize| most(a.parts[k], b.parts[k], c.parts[k]) + bend.parts[k] * face.sag;
    let parts = [part(0), part(1)];
    whole.min(f.value(parts))
}

impl Room {
    /// Measures the first planes, and the bounds that follow. Where a plane cannot matter, its circle
    /// is not made the smallest.
    fn first_planes(&mut self, f: &mut impl PlaneFunction) -> Bend {
        let start = &*HEMISPHERE;
        self.planes.clear();
        self.planes
            .extend(start.planes.iter().map(|n| Plane::of(*n, [0; 6])));
        let (mut largest, mut best) = ([f64::NEG_INFINITY; 2], f64::NEG_INFINITY);
        let mut enough = Enough {
            first: f64::NEG_INFINITY,
            value: f64::NEG_INFINITY,
        };
        let mut instants = [0; 6];
        for planes in self.planes.chunks_mut(LANES) {
            for plane in &mut *planes {
                plane.instants = instants;
            }
            f.measure(planes, enough);
            for plane in &*planes {
                largest = [0, 1].map(|k| plane.parts[k].max(largest[k]));
                best = plane.value.max(best);
            }
            instants = planes[planes.len() - 1].instants;
            enough = Enough {
                first: largest[0],
                value: best - f.bend(largest, start.sag).value * start.sag,
            };
        }
        f.bend(largest, start.sag)
    }

    /// The plane of the largest value.
    fn best(&self, among: std::ops::Range<usize>) -> usize {
        let value = |p: &usize| self.planes[*p].value;
        let most = among.max_by(|a, b| value(a).total_cmp(&value(b)));
        most.unwrap_or(0)
    }

    /// The top that the piece on a plane leads to.
    fn refined(&mut self, f: &mut impl PlaneFunction, plane: usize) -> Peak {
        let n = self.planes[plane].n;
        let mut best = (n, f.at(n));
        for _ in 0..8 {
            let piece = f.deciding(best.0);
            self.tried.push((piece.instants, best.0));
            let (top, of_piece) = refine(&|n| f.value(piece.parts(n)), best.0);
            let value = f.at(top);
            let rounding = 4.0 * f64::EPSILON * value.abs();
            if value < best.1 - rounding {
                break;
            }
            best = (top, value);
            if value <= of_piece + rounding {
                break;
            }
        }
        let piece = f.deciding(best.0);
        let (top, _) = refine(&|n| f.value(piece.smooth_parts(n)), best.0);
        let value = f.at(top);
        if value >= best.1 - 4.0 * f64::EPSILON * value.abs() {
            best = (top, value);
        }
        Peak {
            n: best.0,
            value: best.1,
            missed: 0.0,
            planes: 0,
        }
    }

    /// Refines the pieces at the corners of the faces left that promise more than the best.
    fn try_the_rest(&mut self, f: &mut impl PlaneFunction, best: &mut Peak) {
        self.corners.clear();
        self.corners
            .extend(self.faces.iter().flat_map(|face| face.planes));
        self.corners.sort_unstable();
        self.corners.dedup();
        for k in 0..self.corners.len() {
            let plane = self.corners[k];
            let Plane { n, instants, .. } = self.planes[plane];
            let again =
                |(those, m): &([usize; 6], [f64; 3])| *those == instants && dot(*m, n).abs() > NEAR;
            if self.tried.iter().any(again) || self.tried.len() > PIECES {
                continue;
            }
            self.tried.push((instants, n));
            let piece = f.piece(instants);
            let (_, top) = nearly(&|n| f.value(piece.quick_parts(n)), n, best.value);
            if top > best.value {
                let other = self.refined(f, plane);
                if other.value > best.value {
                    *best = other;
                }
            }
        }
    }

    /// Cuts every face into four.
    fn cut(&mut self) {
        self.edges.clear();
        for plane in &mut self.planes {
            plane.edge = NONE;
        }
        let mut cut = std::mem::take(&mut self.cut);
        let faces = std::mem::take(&mut self.faces);
        cut.clear();
        for Face {
            corners, planes, ..
        } in &faces
        {
            let ([a, b, c], [i, j, k]) = (*corners, *planes);
            let (ab, l) = self.middle((a, i), (b, j));
            let (bc, m) = self.middle((b, j), (c, k));
            let (ca, o) = self.middle((c, k), (a, i));
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

    /// The middle of an edge and the number of its plane, looked at once.
    fn middle(
        &mut self,
        (a, i): ([f64; 3], usize),
        (b, j): ([f64; 3], usize),
    ) -> ([f64; 3], usize) {
        let (n, low, high) = (midway(a, b), i.min(j), i.max(j));
        let mut edge = self.planes[low].edge;
        while edge != NONE {
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
        self.planes.push(Plane::of(n, guess));
        self.edges.push([high, middle, self.planes[low].edge]);
        self.planes[low].edge = self.edges.len() - 1;
        (n, middle)
    }
}
