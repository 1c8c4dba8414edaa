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
//! within the tolerance of the best; the best planes of what is left are refined by Newton steps.
//! The largest value of several smooth functions has a horizontal tangent, so these converge.

use super::hemisphere::{Face, HEMISPHERE, midway, sag};
use super::path::{Frame, dot, unit};

/// How far the search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Largest part of the value by which a plane may be proved better than the one found
    /// (default: 1e-3). The one found is much nearer to the best than what is proved.
    pub tolerance: f64,
    /// Times the first 160 triangles may be cut into four (default: 6).
    pub cuts: usize,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            cuts: 6,
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
}

/// Room for the search.
#[derive(Default)]
pub(super) struct Room {
    planes: Vec<([f64; 3], OnPlane)>,
    faces: Vec<Face>,
    cut: Vec<Face>,
    /// Middles of edges by the numbers of their ends.
    edges: Vec<([usize; 2], usize)>,
}

impl Search {
    /// The plane on which `f` is largest.
    pub(super) fn peak(&self, f: &mut impl PlaneFunction, room: &mut Room) -> Peak {
        let start = &*HEMISPHERE;
        room.planes.clear();
        room.planes
            .extend(start.planes.iter().map(|n| (*n, f.at(*n))));
        room.faces.clone_from(&start.faces);
        let largest = [0, 1].map(|k| {
            let part = room.planes.iter().map(|(_, p)| p.parts[k]);
            part.fold(f64::NEG_INFINITY, f64::max)
        });
        let sag_of = |faces: &[Face]| faces.iter().map(|f| sag(&f.corners)).fold(0.0, f64::max);
        let bend = f.bend(largest, sag_of(&room.faces));
        let first = room.best(0..room.planes.len());
        let mut best = refine(f, first, (2.0 * sag_of(&room.faces)).sqrt() / 2.0);
        let mut missed = 0.0;
        for cuts in 0..=self.cuts {
            let Room { planes, faces, .. } = room;
            let mut most = best.value;
            faces.retain(|face| {
                let bound = bound(f, face, planes, &bend);
                most = most.max(bound);
                bound > best.value
            });
            missed = most - best.value;
            if missed <= self.tolerance * best.value.abs() || cuts == self.cuts {
                break;
            }
            room.cut(f);
        }
        let reach = (2.0 * sag_of(&room.faces)).sqrt();
        for n in room.hills(&best, reach) {
            let other = refine(f, n, reach / 2.0);
            if other.value > best.value {
                missed -= other.value - best.value;
                best = other;
            }
        }
        Peak {
            missed: missed.max(0.0),
            ..best
        }
    }
}

/// No plane in the face has more.
fn bound(f: &impl PlaneFunction, face: &Face, planes: &[([f64; 3], OnPlane)], bend: &Bend) -> f64 {
    let at = face.planes.map(|p| planes[p].1);
    let sag = sag(&face.corners);
    let most = |of: &dyn Fn(&OnPlane) -> f64| at.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let whole = most(&|p| p.value) + bend.value * sag;
    let parts = [0, 1].map(|k| most(&|p| p.parts[k]) + bend.parts[k] * sag);
    whole.min(f.value(parts))
}

impl Room {
    fn best(&self, among: impl Iterator<Item = usize>) -> [f64; 3] {
        let value = |p: &usize| self.planes[*p].1.value;
        let best = among.max_by(|a, b| value(a).total_cmp(&value(b)));
        self.planes[best.unwrap_or(0)].0
    }

    /// Cuts every face into four.
    fn cut(&mut self, f: &mut impl PlaneFunction) {
        self.cut.clear();
        self.edges.clear();
        for face in &self.faces {
            let [a, b, c] = face.corners;
            let [i, j, k] = face.planes;
            let mut middle = |a: [f64; 3], b: [f64; 3], i: usize, j: usize| {
                let (n, ends) = (midway(a, b), [i.min(j), i.max(j)]);
                let known = self.edges.iter().rev().find(|(edge, _)| *edge == ends);
                let number = known.map_or(self.planes.len(), |(_, number)| *number);
                if known.is_none() {
                    self.edges.push((ends, number));
                    self.planes.push((n, f.at(n)));
                }
                (n, number)
            };
            let (ab, l) = middle(a, b, i, j);
            let (bc, m) = middle(b, c, j, k);
            let (ca, o) = middle(c, a, k, i);
            let face = |corners, planes| Face { corners, planes };
            self.cut.extend([
                face([a, ab, ca], [i, l, o]),
                face([ab, b, bc], [l, j, m]),
                face([ca, bc, c], [o, m, k]),
                face([ab, bc, ca], [l, m, o]),
            ]);
        }
        std::mem::swap(&mut self.faces, &mut self.cut);
    }

    /// A plane of each hill that the faces left belong to, but for that of the best one known.
    fn hills(&self, best: &Peak, reach: f64) -> Vec<[f64; 3]> {
        let mut corners: Vec<usize> = self.faces.iter().flat_map(|face| face.planes).collect();
        corners.sort_unstable();
        corners.dedup();
        corners.sort_by(|a, b| self.planes[*b].1.value.total_cmp(&self.planes[*a].1.value));
        let mut tops = vec![best.n];
        for corner in corners {
            let n = self.planes[corner].0;
            let near = |top: &[f64; 3]| 1.0 - dot(*top, n).abs() < 8.0 * reach * reach;
            if tops.len() < 9 && !tops.iter().any(near) {
                tops.push(n);
            }
        }
        tops.split_off(1)
    }
}

/// Newton steps from the plane n; derivatives from planes `step` away at first.
fn refine(f: &mut impl PlaneFunction, n: [f64; 3], step: f64) -> Peak {
    let mut best = (n, f.at(n).value);
    let mut step = step;
    for _ in 0..12 {
        let before = best.1;
        newton(f, &mut best, step, false);
        let gain = best.1 - before;
        if step < 2e-3 && gain <= 1e-9 * best.1.abs() {
            break;
        }
        step = (step / 5.0).max(1e-3);
    }
    newton(f, &mut best, 1e-3, true);
    Peak {
        n: best.0,
        value: best.1,
        missed: 0.0,
    }
}

/// One step to the top of the quadratic through planes around the best; any better plane on the way
/// is kept. With `close` the slope is exact to the fourth order of the step and a plane as good is
/// taken.
fn newton(f: &mut impl PlaneFunction, best: &mut ([f64; 3], f64), step: f64, close: bool) {
    let Frame { n, u, v } = Frame::across(best.0);
    let turned = |a: f64, b: f64| unit(std::array::from_fn(|d| n[d] + a * u[d] + b * v[d]));
    let here = best.1;
    let mut sample = |a: f64, b: f64| {
        let n = turned(a, b);
        let value = f.at(n).value;
        if value > best.1 {
            *best = (n, value);
        }
        value
    };
    let (east, west) = (sample(step, 0.0), sample(-step, 0.0));
    let (north, south) = (sample(0.0, step), sample(0.0, -step));
    let mixed =
        sample(step, step) - sample(step, -step) - sample(-step, step) + sample(-step, -step);
    let mut slope = [(east - west) / 2.0, (north - south) / 2.0];
    if close {
        let twice = 2.0 * step;
        let far = [
            (sample(twice, 0.0) - sample(-twice, 0.0)) / 4.0,
            (sample(0.0, twice) - sample(0.0, -twice)) / 4.0,
        ];
        slope = [0, 1].map(|k| (4.0 * slope[k] - far[k]) / 3.0);
    }
    let (uu, vv, uv) = (
        east + west - 2.0 * here,
        north + south - 2.0 * here,
        mixed / 4.0,
    );
    let Some([a, b]) = top_of_quadratic(slope, [uu, vv, uv], 1e-9 * here.abs()) else {
        return;
    };
    let far = a.hypot(b);
    let shrink = if far > 2.0 { 2.0 / far } else { 1.0 };
    let there = turned(a * shrink * step, b * shrink * step);
    let value = f.at(there).value;
    let as_good = close && value >= best.1 - 4.0 * f64::EPSILON * best.1.abs();
    if value > best.1 || as_good {
        *best = (there, value);
    }
}

/// Where slope + bend x = 0, along the directions that bend down by more than `flat`.
fn top_of_quadratic(slope: [f64; 2], [uu, vv, uv]: [f64; 3], flat: f64) -> Option<[f64; 2]> {
    // Rotation to the axes of the quadratic.
    let angle = 0.5 * (2.0 * uv).atan2(uu - vv);
    let (sin, cos) = angle.sin_cos();
    let axes = [[cos, sin], [-sin, cos]];
    let mut top = [0.0; 2];
    for [a, b] in axes {
        let bend = a * a * uu + b * b * vv + 2.0 * a * b * uv;
        if bend < -flat {
            let by = -(slope[0] * a + slope[1] * b) / bend;
            top = [top[0] + by * a, top[1] + by * b];
        }
    }
    (top != [0.0; 2]).then_some(top)
}
