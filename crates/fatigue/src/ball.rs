//! Smallest ball round given points: of the shear stress on a plane (a circle) and of the
//! deviatoric stress (a sphere in five dimensions).
//!
//! At most D + 1 of the points lie on its border. The search starts with the ball round a few
//! points and adds the point that is farthest outside, until none is outside. Welzl's recursion
//! finds the ball of the few. It tries the points of the last border first.
//!
//! E. Welzl, Smallest enclosing disks (balls and ellipsoids), LNCS 555 (1991) 359-370.
//! B. Gärtner, Fast and robust smallest enclosing balls, LNCS 1643 (1999) 325-338.

use crate::lanes::{LANES, Lanes, index_of_value, max_of_blocks};

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

/// A ball with `held` points on its border, the smallest such ball.
#[derive(Clone, Copy)]
struct BoundaryBall<const D: usize> {
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
    /// The smallest ball around points, at least one block of them.
    pub(crate) fn ball(&mut self, points: &Points<D>) -> Ball<D> {
        let point = |k: usize| points[k / LANES].map(|lanes| lanes[k % LANES]);
        self.likely.retain(|k| *k < points.len() * LANES);
        if self.likely.is_empty() {
            self.likely.push(0);
        }
        let end = self.likely.len();
        let mut ball = welzl(&mut self.likely, end, &BoundaryBall::empty(), &point);
        loop {
            let far = self.distances_from(&ball.centre, points);
            if far <= ball.square * (1.0 + OUTSIDE) {
                return ball.with_radius(far);
            }
            let k = index_of_value(&self.distances, far);
            let before = ball.square;
            let pivot = BoundaryBall::empty().with_border_point(&point(k));
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

    /// Computes the squares of all distances from the centre and returns the largest.
    fn distances_from(&mut self, centre: &[f64; D], points: &Points<D>) -> f64 {
        self.distances.clear();
        self.distances.extend(points.iter().map(|block| {
            let mut square = [0.0; LANES];
            for d in 0..D {
                for l in 0..LANES {
                    let distance = block[d][l] - centre[d];
                    square[l] += distance * distance;
                }
            }
            square
        }));
        max_of_blocks(&self.distances)
    }
}

/// Finds the smallest ball around the first `end` of the points `likely` that has the points of `on` on its
/// border (E. Welzl). Points that end up on the border move to the front of `likely`.
fn welzl<const D: usize>(
    likely: &mut [usize],
    end: usize,
    on: &BoundaryBall<D>,
    point: &impl Fn(usize) -> [f64; D],
) -> BoundaryBall<D> {
    let mut ball = *on;
    if on.held == D + 1 {
        return ball;
    }
    for n in 0..end {
        let candidate = point(likely[n]);
        if ball.contains(&candidate) {
            continue;
        }
        if let Some(larger) = on.with_border_point(&candidate) {
            ball = welzl(likely, n, &larger, point);
            likely[..=n].rotate_right(1);
        }
    }
    ball
}

impl<const D: usize> BoundaryBall<D> {
    /// A ball without any point.
    fn empty() -> Self {
        Self {
            first: [0.0; D],
            axes: [[0.0; D]; D],
            along: [0.0; D],
            held: 0,
            centre: [0.0; D],
            square: -1.0,
        }
    }

    /// Whether a point lies in the ball, to rounding.
    fn contains(&self, point: &[f64; D]) -> bool {
        let square: f64 = (0..D).map(|d| (point[d] - self.centre[d]).powi(2)).sum();
        self.square >= 0.0 && square <= self.square * (1.0 + OUTSIDE)
    }

    /// Adds a point to the border and returns the smallest ball with all these border points; `None` if the
    /// point lies in the flat through the others.
    fn with_border_point(&self, point: &[f64; D]) -> Option<Self> {
        let mut larger = *self;
        larger.held += 1;
        if self.held == 0 {
            (larger.first, larger.centre, larger.square) = (*point, *point, 0.0);
            return Some(larger);
        }
        // The centre is as far from the point as from the first: 2 v.c = v.v, c and v from the
        // first on.
        let v: [f64; D] = std::array::from_fn(|d| point[d] - self.first[d]);
        let length = dot(&v, &v);
        let (mut residual, mut projection) = (v, 0.0);
        let n = self.held - 1;
        for (axis, coefficient) in self.axes[..n].iter().zip(self.along) {
            let part = dot(&v, axis);
            projection += part * coefficient;
            for d in 0..D {
                residual[d] -= part * axis[d];
            }
        }
        let across = dot(&residual, &residual).sqrt();
        if across <= FLAT * length.sqrt() {
            return None;
        }
        larger.axes[n] = residual.map(|r| r / across);
        larger.along[n] = (length / 2.0 - projection) / dot(&v, &larger.axes[n]);
        for d in 0..D {
            larger.centre[d] += larger.along[n] * larger.axes[n][d];
        }
        larger.square += larger.along[n] * larger.along[n];
        Some(larger)
    }

    /// The ball of this centre with the squared radius `square`.
    fn with_radius(&self, square: f64) -> Ball<D> {
        Ball {
            centre: self.centre,
            radius: square.sqrt(),
        }
    }
}

/// Dot product.
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
