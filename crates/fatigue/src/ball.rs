//! Smallest ball round given points: of the shear stress on a plane (a circle) and of the
//! deviatoric stress (a sphere in five dimensions).
//!
//! The ball is that of at most D + 1 of the points. The farthest point from the ball of a few joins
//! them until none is outside; the ball of the few is found by Welzl's recursion, the points that
//! mattered tried first.
//!
//! E. Welzl, Smallest enclosing disks (balls and ellipsoids), LNCS 555 (1991) 359-370.
//! B. Gärtner, Fast and robust smallest enclosing balls, LNCS 1643 (1999) 325-338.

use crate::lanes::{LANES, Lanes, largest, place_of};

/// A point is outside if it is farther from the centre than this share of the radius beyond it;
/// rounding is a few units of 1e-16.
const OUTSIDE: f64 = 4e-15;
/// A point whose distance from the affine hull of the others on the border, over its distance from
/// one of them, is below FLAT is taken to lie in that hull: it would add rounding only.
const FLAT: f64 = 1e-9;

/// The smallest ball round points in D dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball<const D: usize> {
    /// Centre, in the unit of the points.
    pub centre: [f64; D],
    /// Radius, in the unit of the points.
    pub radius: f64,
}

/// Points in D dimensions, a coordinate after the other, as blocks of lanes.
pub(crate) type Points<const D: usize> = Vec<[Lanes; D]>;

/// Buffers of the search; the next one starts from the points on the last border.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search<const D: usize> {
    /// Points that may lie on the border, the likely ones first.
    likely: Vec<usize>,
    distances: Vec<Lanes>,
}

/// A ball with the points of `held` on its border, smallest among those.
#[derive(Clone, Copy)]
struct Held<const D: usize> {
    first: [f64; D],
    /// Orthonormal axes of the flat through the held points, and the centre along them.
    axes: [[f64; D]; D],
    along: [f64; D],
    held: usize,
    centre: [f64; D],
    /// Square of the radius; negative while nothing is held.
    square: f64,
}

impl<const D: usize> Search<D> {
    /// The smallest ball round at least one block of points.
    pub(crate) fn ball(&mut self, points: &Points<D>) -> Ball<D> {
        let point = |k: usize| points[k / LANES].map(|lanes| lanes[k % LANES]);
        self.likely.retain(|k| *k < points.len() * LANES);
        if self.likely.is_empty() {
            self.likely.push(0);
        }
        let end = self.likely.len();
        let mut ball = welzl(&mut self.likely, end, &Held::nothing(), &point);
        loop {
            let far = self.distances_from(&ball.centre, points);
            if far <= ball.square * (1.0 + OUTSIDE) {
                return ball.with_radius(far);
            }
            let k = place_of(&self.distances, far);
            let before = ball.square;
            let pivot = Held::nothing().with(&point(k));
            let Some(pivot) = pivot else {
                return ball.with_radius(far);
            };
            self.likely.retain(|n| *n != k);
            let end = self.likely.len();
            let larger = welzl(&mut self.likely, end, &pivot, &point);
            self.likely.insert(0, k);
            self.likely.truncate(2 * (D + 1));
            if larger.square <= before {
                // Rounding: the ball no longer grows.
                return ball.with_radius(far);
            }
            ball = larger;
        }
    }

    /// The squares of all distances from the centre; the largest is returned.
    fn distances_from(&mut self, centre: &[f64; D], points: &Points<D>) -> f64 {
        self.distances.clear();
        self.distances.extend(points.iter().map(|block| {
            let mut square = [0.0; LANES];
            for d in 0..D {
                for l in 0..LANES {
                    let to = block[d][l] - centre[d];
                    square[l] += to * to;
                }
            }
            square
        }));
        largest(&self.distances)
    }
}

/// The smallest ball round the first `end` of the points `likely` that has what `on` holds on its
/// border; points that end up on the border move to the front.
fn welzl<const D: usize>(
    likely: &mut [usize],
    end: usize,
    on: &Held<D>,
    point: &impl Fn(usize) -> [f64; D],
) -> Held<D> {
    let mut ball = *on;
    if on.held == D + 1 {
        return ball;
    }
    for n in 0..end {
        let candidate = point(likely[n]);
        if ball.holds(&candidate) {
            continue;
        }
        if let Some(with) = on.with(&candidate) {
            ball = welzl(likely, n, &with, point);
            likely[..=n].rotate_right(1);
        }
    }
    ball
}

impl<const D: usize> Held<D> {
    fn nothing() -> Self {
        Self {
            first: [0.0; D],
            axes: [[0.0; D]; D],
            along: [0.0; D],
            held: 0,
            centre: [0.0; D],
            square: -1.0,
        }
    }

    fn holds(&self, point: &[f64; D]) -> bool {
        let square: f64 = (0..D).map(|d| (point[d] - self.centre[d]).powi(2)).sum();
        self.square >= 0.0 && square <= self.square * (1.0 + OUTSIDE)
    }

    /// With one more point on the border; `None` if it lies in the flat of the others.
    fn with(&self, point: &[f64; D]) -> Option<Self> {
        let mut more = *self;
        more.held += 1;
        if self.held == 0 {
            (more.first, more.centre, more.square) = (*point, *point, 0.0);
            return Some(more);
        }
        // The centre is as far from the point as from the first: 2 v.c = v.v, c and v from the
        // first on.
        let v: [f64; D] = std::array::from_fn(|d| point[d] - self.first[d]);
        let length = dot(&v, &v);
        let (mut rest, mut known) = (v, 0.0);
        let n = self.held - 1;
        for (axis, along) in self.axes[..n].iter().zip(self.along) {
            let part = dot(&v, axis);
            known += part * along;
            for d in 0..D {
                rest[d] -= part * axis[d];
            }
        }
        let across = dot(&rest, &rest).sqrt();
        if across <= FLAT * length.sqrt() {
            return None;
        }
        more.axes[n] = rest.map(|r| r / across);
        more.along[n] = (length / 2.0 - known) / dot(&v, &more.axes[n]);
        for d in 0..D {
            more.centre[d] += more.along[n] * more.axes[n][d];
        }
        more.square += more.along[n] * more.along[n];
        Some(more)
    }

    fn with_radius(&self, square: f64) -> Ball<D> {
        Ball {
            centre: self.centre,
            radius: square.sqrt(),
        }
    }
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The smallest ball round points, at least one.
pub fn smallest_ball<const D: usize>(points: &[[f64; D]]) -> Ball<D> {
    let blocks = points.chunks(LANES).map(|chunk| {
        std::array::from_fn(|d| std::array::from_fn(|l| chunk[l.min(chunk.len() - 1)][d]))
    });
    Search::default().ball(&blocks.collect())
}
