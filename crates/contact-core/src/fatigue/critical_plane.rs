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
//! The triangles that may hold more than the best plane known are cut into four until that bound is
//! within the tolerance of the best. What is left is refined: the instants that decide on a plane
//! make a smooth function of it, a piece, whose top Newton's steps find; where other instants decide
//! there, their piece is next. The largest value of several smooth functions is the top of one of
//! them, so the place is found to rounding, much nearer than what is proved.

use super::hemisphere::{Face, HEMISPHERE, midway, sag};

use super::path::dot;
use super::refine::{Deciding, refine};

/// How far the search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Largest part of the value by which a plane may be proved better than the one found
    /// (default: 5e-3). The plane found is usually the best one to rounding.
    pub tolerance: f64,
    /// Times the first 160 triangles may be cut into four (default: 12).
    pub cuts: usize,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            tolerance: 5e-3,
            cuts: 12,
        }
    }
}

/// What is known of a plane: two quantities, and the criterion, which rises with both.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnPlane {
    pub(super) parts: [f64; 2],
    pub(super) value: f64,
}

/// Bounds on second derivatives along great circles: those are nowhere below -K.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    pub(super) parts: [f64; 2],
    pub(super) value: f64,
}

/// A criterion on planes.
pub(super) trait PlaneFunction {
    /// The two quantities on the plane of a unit normal.
    fn parts(&mut self, n: [f64; 3]) -> [f64; 2];
    /// The criterion, which rises with both.
    fn value(&self, parts: [f64; 2]) -> f64;
    /// The bounds, from the largest parts on the first planes and the largest 1/cos r - 1 of their
    /// triangles.
    fn bend(&self, largest: [f64; 2], sag: f64) -> Bend;
    /// Whether a second quantity chooses between planes of equal first ones: complementary planes
    /// have the same shear.
    fn has_ties(&self) -> bool;
    /// The piece of the instants that decide on the plane of a unit normal.
    fn deciding(&mut self, n: [f64; 3]) -> Deciding;

    /// The plane of a unit normal.
    fn at(&mut self, n: [f64; 3]) -> OnPlane {
        let parts = self.parts(n);
        let value = self.value(parts);
        OnPlane { parts, value }
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
    planes: Vec<Known>,
    faces: Vec<Face>,
    cut: Vec<Face>,
    /// Middles of edges: the other end, the number of the middle, the next edge of the same end.
    edges: Vec<[usize; 3]>,
    corners: Vec<usize>,
    tried: Vec<([usize; 6], [f64; 3])>,
}

/// A plane that was looked at.
#[derive(Clone, Copy)]
struct Known {
    n: [f64; 3],
    on: OnPlane,
    /// First of the edges that have this as the end of the smaller number.
    edge: usize,
}

/// No edge.
const NONE: usize = usize::MAX;
/// Triangles that are so few that they are cut on beyond the tolerance where planes may tie.
const FEW: usize = 48;
/// Planes nearer to each other than this cosine, 18 degrees, lead to the same top of a piece.
const NEAR: f64 = 0.95;
/// Pieces whose top is refined at most.
const PIECES: usize = 24;

impl Search {
    /// The plane on which `f` is largest.
    pub(super) fn peak(&self, f: &mut impl PlaneFunction, room: &mut Room) -> Peak {
        let start = &*HEMISPHERE;
        room.planes.clear();
        for n in &start.planes {
            room.look(f, *n);
        }
        room.faces.clone_from(&start.faces);
        room.tried.clear();
        let largest = [0, 1].map(|k| {
            let part = room.planes.iter().map(|p| p.on.parts[k]);
            part.fold(f64::NEG_INFINITY, f64::max)
        });
        let bend = f.bend(largest, start.sag);
        let mut best = room.refined(f, room.best(0..room.planes.len()).unwrap_or(0));
        let mut missed = 0.0;
        let mut seen = room.planes.len();
        for cuts in 0..=self.cuts {
            let Room { planes, faces, .. } = room;
            let mut most = best.value;
            faces.retain(|face| {
                let bound = bound(f, face, planes, &bend);
                most = most.max(bound);
                bound > best.value
            });
            missed = most - best.value;
            let few = if f.has_ties() { FEW } else { 0 };
            let done = missed <= self.tolerance * best.value.abs() && faces.len() > few;
            if faces.is_empty() || done || cuts == self.cuts {
                break;
            }
            room.cut(f);
            let higher = room.best(seen..room.planes.len());
            seen = room.planes.len();
            if higher.is_some_and(|k| room.planes[k].on.value > best.value) {
                let other = room.refined(f, higher.unwrap_or(0));
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

/// No plane in the face has more.
fn bound(f: &impl PlaneFunction, face: &Face, planes: &[Known], bend: &Bend) -> f64 {
    let [a, b, c] = face.planes.map(|p| planes[p].on);
    let sag = sag(&face.corners);
    let whole = a.value.max(b.value).max(c.value) + bend.value * sag;
    let parts = [0, 1].map(|k| {
        let most = a.parts[k].max(b.parts[k]).max(c.parts[k]);
        most + bend.parts[k] * sag
    });
    whole.min(f.value(parts))
}

impl Room {
    /// Looks at a plane; its number.
    fn look(&mut self, f: &mut impl PlaneFunction, n: [f64; 3]) -> usize {
        let (on, edge) = (f.at(n), NONE);
        self.planes.push(Known { n, on, edge });
        self.planes.len() - 1
    }

    /// The plane of the largest value.
    fn best(&self, among: std::ops::Range<usize>) -> Option<usize> {
        let value = |p: &usize| self.planes[*p].on.value;
        among.max_by(|a, b| value(a).total_cmp(&value(b)))
    }

    /// The top that the piece on a plane leads to.
    fn refined(&mut self, f: &mut impl PlaneFunction, plane: usize) -> Peak {
        let Known { n, on, .. } = self.planes[plane];
        let mut best = (n, on.value);
        for _ in 0..8 {
            let piece = f.deciding(best.0);
            self.tried.push((piece.instants, best.0));
            let (top, of_piece) = refine(&|n| f.value(piece.parts(n)), best.0);
            let value = f.at(top).value;
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
        let value = f.at(top).value;
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
            let n = self.planes[plane].n;
            let piece = f.deciding(n);
            let again = |(instants, m): &([usize; 6], [f64; 3])| {
                *instants == piece.instants && dot(*m, n).abs() > NEAR
            };
            if self.tried.iter().any(again) || self.tried.len() > PIECES {
                continue;
            }
            self.tried.push((piece.instants, n));
            let (_, top) = refine(&|n| f.value(piece.parts(n)), n);
            if top > best.value {
                let other = self.refined(f, plane);
                if other.value > best.value {
                    *best = other;
                }
            }
        }
    }

    /// Cuts every face into four.
    fn cut(&mut self, f: &mut impl PlaneFunction) {
        self.edges.clear();
        for plane in &mut self.planes {
            plane.edge = NONE;
        }
        let (mut cut, faces) = (
            std::mem::take(&mut self.cut),
            std::mem::take(&mut self.faces),
        );
        cut.clear();
        for Face { corners, planes } in &faces {
            let ([a, b, c], [i, j, k]) = (*corners, *planes);
            let (ab, l) = self.middle(f, (a, i), (b, j));
            let (bc, m) = self.middle(f, (b, j), (c, k));
            let (ca, o) = self.middle(f, (c, k), (a, i));
            let face = |corners, planes| Face { corners, planes };
            cut.extend([
                face([a, ab, ca], [i, l, o]),
                face([ab, b, bc], [l, j, m]),
                face([ca, bc, c], [o, m, k]),
                face([ab, bc, ca], [l, m, o]),
            ]);
        }
        (self.faces, self.cut) = (cut, faces);
    }

    /// The middle of an edge and the number of its plane, looked at once.
    fn middle(
        &mut self,
        f: &mut impl PlaneFunction,
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
        let middle = self.look(f, n);
        self.edges.push([high, middle, self.planes[low].edge]);
        self.planes[low].edge = self.edges.len() - 1;
        (n, middle)
    }
}
