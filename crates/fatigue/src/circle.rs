//! Smallest circle round the path of the shear stress on a plane.
//!
//! Two or three of the points define the circle. The farthest point outside joins them. The next
//! circle is the smallest that holds them all, among the circles of that point and one or two of
//! the others. The radius grows until no point is outside (see the `ball` module for sources).

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};

use crate::lanes::{LANES, Lanes};

/// A point is outside if the square of its distance is larger by this share.
const OUTSIDE: f64 = 1e-14;

/// A circle and the instants of the points that define it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) radius: f64,
    pub(crate) instants: [usize; 3],
}

/// A disc: a centre and the square of a radius.
#[derive(Clone, Copy)]
pub(crate) struct Disc {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) square: f64,
}

/// Buffers of the search, and the points of the last circle.
#[derive(Clone, Debug)]
pub(crate) struct Circles {
    instants: [usize; 3],
    arch: Arch,
}

impl Default for Circles {
    fn default() -> Self {
        Self {
            instants: [0; 3],
            arch: Arch::new(),
        }
    }
}

impl Circles {
    /// The smallest circle round at least one block of points.
    pub(crate) fn smallest_circle(&mut self, points: &[[Lanes; 2]]) -> Circle {
        let point = |k: usize| points[k / LANES].map(|lanes| lanes[k % LANES]);
        let clamp = |k: usize| if k < points.len() * LANES { k } else { 0 };
        let instants = self.instants.map(clamp);
        let mut circle = smallest_disc_of_three(instants.map(point));
        self.instants = instants;
        loop {
            let (far, k) = self.farthest_from(&circle, points);
            if far <= circle.square * (1.0 + OUTSIDE) {
                return self.to_circle(far, &point);
            }
            let (larger, instants) = circle_with_point(k, self.instants, &point);
            if larger.square <= circle.square {
                // Rounding: the circle no longer grows.
                return self.to_circle(far, &point);
            }
            (circle, self.instants) = (larger, instants);
        }
    }

    /// The circle of this squared radius with the points that define it.
    fn to_circle(&self, square: f64, point: &impl Fn(usize) -> [f64; 2]) -> Circle {
        Circle {
            radius: square.sqrt(),
            instants: defining_points(self.instants, point),
        }
    }

    /// The square of the largest distance from the centre, and the index of that point.
    fn farthest_from(&self, circle: &Disc, points: &[[Lanes; 2]]) -> (f64, usize) {
        let centre = *circle;
        self.arch.dispatch(Farthest { centre, points })
    }
}

/// [`Circles::farthest_from`], compiled for the processor.
struct Farthest<'a> {
    centre: Disc,
    points: &'a [[Lanes; 2]],
}

impl WithSimd for Farthest<'_> {
    type Output = (f64, usize);

    /// Finds the squared distance and the index of the point farthest from the centre, with vectors of the
    /// processor.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, usize) {
        let Disc { x, y, .. } = self.centre;
        let (x, y) = (simd.splat_f64s(x), simd.splat_f64s(y));
        // The vectors of the farthest, as numbers that blend with the distances.
        let mut farthest = simd.splat_f64s(f64::NEG_INFINITY);
        let mut vectors_at = simd.splat_f64s(0.0);
        let mut vectors = 0;
        for [xs, ys] in self.points {
            let (xs, ys) = (S::as_simd_f64s(xs).0, S::as_simd_f64s(ys).0);
            for (a, b) in xs.iter().zip(ys) {
                let (a, b) = (simd.sub_f64s(*a, x), simd.sub_f64s(*b, y));
                let square = simd.add_f64s(simd.mul_f64s(a, a), simd.mul_f64s(b, b));
                let farther = simd.greater_than_f64s(square, farthest);
                farthest = simd.select_f64s_m64s(farther, square, farthest);
                vectors_at =
                    simd.select_f64s_m64s(farther, simd.splat_f64s(f64::from(vectors)), vectors_at);
                vectors += 1;
            }
        }
        let far = simd.reduce_max_f64s(farthest);
        let is_farthest = simd.equal_f64s(farthest, simd.splat_f64s(far));
        let none = simd.splat_f64s(f64::INFINITY);
        let vector =
            simd.reduce_min_f64s(simd.select_f64s_m64s(is_farthest, vectors_at, none)) as usize;
        let candidates = vector * S::F64_LANES..(vector + 1) * S::F64_LANES;
        let square = |k: &usize| {
            let [xs, ys] = &self.points[k / LANES];
            let (a, b) = (xs[k % LANES] - self.centre.x, ys[k % LANES] - self.centre.y);
            a * a + b * b
        };
        let k = candidates.max_by(|i, j| square(i).total_cmp(&square(j)));
        (far, k.unwrap_or(0))
    }
}

/// The points that define the smallest circle: all three, or the two on its diameter if their triangle has a
/// right or obtuse angle.
pub(crate) fn defining_points(on: [usize; 3], point: &impl Fn(usize) -> [f64; 2]) -> [usize; 3] {
    let [a, b, c] = on;
    let side = |i: usize, j: usize| {
        let (p, q) = (point(i), point(j));
        (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)
    };
    let (ab, bc, ca) = (side(a, b), side(b, c), side(c, a));
    if ab >= bc + ca {
        [a, b, b]
    } else if bc >= ca + ab {
        [b, c, c]
    } else if ca >= ab + bc {
        [c, a, a]
    } else {
        on
    }
}

/// The smallest circle around point k and the points `on`, with k on its border, and the points that define it.
pub(crate) fn circle_with_point(
    k: usize,
    on: [usize; 3],
    point: &impl Fn(usize) -> [f64; 2],
) -> (Disc, [usize; 3]) {
    let p = point(k);
    let points = on.map(point);
    let contains_all = |c: &Disc, defining: [usize; 3]| {
        on.iter().zip(&points).all(|(n, [x, y])| {
            let (a, b) = (x - c.x, y - c.y);
            defining.contains(n) || a * a + b * b <= c.square * (1.0 + OUTSIDE)
        })
    };
    let mut best: Option<(Disc, [usize; 3])> = None;
    let mut consider = |c: Disc, defining: [usize; 3]| {
        if best.is_none_or(|(b, _)| c.square < b.square) && contains_all(&c, defining) {
            best = Some((c, defining));
        }
    };
    for i in 0..3 {
        consider(disc_on_diameter(p, points[i]), [k, on[i], on[i]]);
    }
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        if let Some(c) = disc_through(p, points[i], points[j]) {
            consider(c, [k, on[i], on[j]]);
        }
    }
    best.unwrap_or((disc_on_diameter(p, p), [k; 3]))
}

/// The smallest circle round three points.
pub(crate) fn smallest_disc_of_three([a, b, c]: [[f64; 2]; 3]) -> Disc {
    let square = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    let (ab, bc, ca) = (square(a, b), square(b, c), square(c, a));
    // Beside a right or obtuse angle the longest side is the diameter.
    if ab >= bc + ca {
        disc_on_diameter(a, b)
    } else if bc >= ca + ab {
        disc_on_diameter(b, c)
    } else if ca >= ab + bc {
        disc_on_diameter(c, a)
    } else {
        disc_through(a, b, c).unwrap_or_else(|| disc_on_diameter(a, b))
    }
}

/// Radius of the smallest circle round three points.
pub(crate) fn radius_of_three(points: [[f64; 2]; 3]) -> f64 {
    smallest_disc_of_three(points).square.sqrt()
}

/// Radius of the circle through three points, or with two on a diameter. It is a smooth function of
/// the points, unlike the radius of the smallest circle at a right angle.
pub(crate) fn radius_through([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let circle = disc_through(a, b, c).unwrap_or_else(|| smallest_disc_of_three([a, b, c]));
    circle.square.sqrt()
}

/// The circle with two points at the ends of a diameter.
fn disc_on_diameter(a: [f64; 2], b: [f64; 2]) -> Disc {
    let (x, y) = (f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1]));
    Disc {
        x,
        y,
        square: ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)) / 4.0,
    }
}

/// The circle through three points; `None` if they are on a line.
fn disc_through(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Option<Disc> {
    let (p, q) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let twice_area = p[0] * q[1] - p[1] * q[0];
    let (pp, qq) = (p[0] * p[0] + p[1] * p[1], q[0] * q[0] + q[1] * q[1]);
    if twice_area * twice_area <= 1e-20 * pp * qq {
        return None;
    }
    let x = (q[1] * pp - p[1] * qq) / (2.0 * twice_area);
    let y = (p[0] * qq - q[0] * pp) / (2.0 * twice_area);
    Some(Disc {
        x: a[0] + x,
        y: a[1] + y,
        square: x * x + y * y,
    })
}

/// Half of the longest chord of a plane path with its smallest circle.
///
/// Two points on the circle are a diameter. Else an end of the longest chord, which is at least as
/// long as a side L of the triangle of the points on it, is L - R or more from the centre: few
/// points are.
pub(crate) fn half_chord(path: &[[Lanes; 2]], circle: &Circle) -> f64 {
    let point = |k: usize| path[k / LANES].map(|lanes| lanes[k % LANES]);
    let on = circle.instants.map(point);
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let [a, b, c] = on;
    let side = distance(a, b).max(distance(b, c)).max(distance(c, a));
    let Disc { x, y, .. } = smallest_disc_of_three(on);
    let near = (side - circle.radius) * (1.0 - OUTSIDE);
    let ends = (0..path.len() * LANES).map(point);
    let mut ends: Vec<_> = ends.filter(|p| distance(*p, [x, y]) >= near).collect();
    keep_hull_corners(&mut ends);
    let mut longest = side;
    for (n, p) in ends.iter().enumerate() {
        for q in &ends[n + 1..] {
            longest = longest.max(distance(*p, *q));
        }
    }
    longest / 2.0
}

/// Keeps the corners of the convex hull: A. M. Andrew, Inf. Process. Lett. 9 (1979) 216-219.
fn keep_hull_corners(points: &mut Vec<[f64; 2]>) {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 4 {
        return;
    }
    let turns_left = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let mut hull: Vec<[f64; 2]> = Vec::new();
    let mut half = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let start = hull.len();
        for p in points {
            while hull.len() > start + 1
                && !turns_left(hull[hull.len() - 2], hull[hull.len() - 1], *p)
            {
                hull.pop();
            }
            hull.push(*p);
        }
        hull.pop();
    };
    half(&mut points.iter());
    half(&mut points.iter().rev());
    *points = hull;
}
