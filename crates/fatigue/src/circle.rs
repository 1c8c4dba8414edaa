//! Smallest circle round the path of the shear stress on a plane.
//!
//! The circle is that of two or three of the points. The farthest point outside the circle of these
//! joins them, and of the circles of that point and one or two of the others the smallest that
//! holds all is the next; its radius grows until no point is outside (see the `ball` module for
//! sources).

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};

use crate::lanes::{LANES, Lanes};

/// A point is outside if the square of its distance is larger by this share.
const OUTSIDE: f64 = 1e-14;

/// A circle and the instants of the points that it is the smallest round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) radius: f64,
    pub(crate) on: [usize; 3],
}

/// A centre and the square of a radius.
#[derive(Clone, Copy)]
pub(crate) struct Round {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) square: f64,
}

/// Buffers of the search, and the points of the last circle.
#[derive(Clone, Debug)]
pub(crate) struct Circles {
    on: [usize; 3],
    arch: Arch,
}

impl Default for Circles {
    fn default() -> Self {
        Self {
            on: [0; 3],
            arch: Arch::new(),
        }
    }
}

impl Circles {
    /// The smallest circle round at least one block of points.
    pub(crate) fn round(&mut self, points: &[[Lanes; 2]]) -> Circle {
        let point = |k: usize| points[k / LANES].map(|lanes| lanes[k % LANES]);
        let within = |k: usize| if k < points.len() * LANES { k } else { 0 };
        let on = self.on.map(within);
        let mut circle = round_of_three(on.map(point));
        self.on = on;
        loop {
            let (far, k) = self.farthest_from(&circle, points);
            if far <= circle.square * (1.0 + OUTSIDE) {
                return self.found(far, &point);
            }
            let (larger, on) = joined(k, self.on, &point);
            if larger.square <= circle.square {
                // Rounding: the circle no longer grows.
                return self.found(far, &point);
            }
            (circle, self.on) = (larger, on);
        }
    }

    fn found(&self, square: f64, point: &impl Fn(usize) -> [f64; 2]) -> Circle {
        Circle {
            radius: square.sqrt(),
            on: needed(self.on, point),
        }
    }

    /// The square of the largest distance from the centre, and whose it is.
    fn farthest_from(&self, circle: &Round, points: &[[Lanes; 2]]) -> (f64, usize) {
        let from = *circle;
        self.arch.dispatch(Farthest { from, points })
    }
}

/// [`Circles::farthest_from`], compiled for the processor.
struct Farthest<'a> {
    from: Round,
    points: &'a [[Lanes; 2]],
}

impl WithSimd for Farthest<'_> {
    type Output = (f64, usize);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, usize) {
        let Round { x, y, .. } = self.from;
        let (x, y) = (simd.splat_f64s(x), simd.splat_f64s(y));
        // The vectors of the farthest, as numbers that blend with the distances.
        let mut most = simd.splat_f64s(f64::NEG_INFINITY);
        let mut at = simd.splat_f64s(0.0);
        let mut vectors = 0;
        for [xs, ys] in self.points {
            let (xs, ys) = (S::as_simd_f64s(xs).0, S::as_simd_f64s(ys).0);
            for (a, b) in xs.iter().zip(ys) {
                let (a, b) = (simd.sub_f64s(*a, x), simd.sub_f64s(*b, y));
                let square = simd.add_f64s(simd.mul_f64s(a, a), simd.mul_f64s(b, b));
                let farther = simd.greater_than_f64s(square, most);
                most = simd.select_f64s_m64s(farther, square, most);
                at = simd.select_f64s_m64s(farther, simd.splat_f64s(f64::from(vectors)), at);
                vectors += 1;
            }
        }
        let far = simd.reduce_max_f64s(most);
        let its = simd.equal_f64s(most, simd.splat_f64s(far));
        let none = simd.splat_f64s(f64::INFINITY);
        let vector = simd.reduce_min_f64s(simd.select_f64s_m64s(its, at, none)) as usize;
        let of = vector * S::F64_LANES..(vector + 1) * S::F64_LANES;
        let square = |k: &usize| {
            let [xs, ys] = &self.points[k / LANES];
            let (a, b) = (xs[k % LANES] - self.from.x, ys[k % LANES] - self.from.y);
            a * a + b * b
        };
        let k = of.max_by(|i, j| square(i).total_cmp(&square(j)));
        (far, k.unwrap_or(0))
    }
}

/// Of three points with a right or obtuse angle, two make the circle.
pub(crate) fn needed(on: [usize; 3], point: &impl Fn(usize) -> [f64; 2]) -> [usize; 3] {
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

/// The smallest circle round the point k and those of `on`, which has k on it.
pub(crate) fn joined(
    k: usize,
    on: [usize; 3],
    point: &impl Fn(usize) -> [f64; 2],
) -> (Round, [usize; 3]) {
    let p = point(k);
    let all = on.map(point);
    let holds = |c: &Round, own: [usize; 3]| {
        on.iter().zip(&all).all(|(n, [x, y])| {
            let (a, b) = (x - c.x, y - c.y);
            own.contains(n) || a * a + b * b <= c.square * (1.0 + OUTSIDE)
        })
    };
    let mut best: Option<(Round, [usize; 3])> = None;
    let mut consider = |c: Round, own: [usize; 3]| {
        if best.is_none_or(|(b, _)| c.square < b.square) && holds(&c, own) {
            best = Some((c, own));
        }
    };
    for i in 0..3 {
        consider(across(p, all[i]), [k, on[i], on[i]]);
    }
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        if let Some(c) = through(p, all[i], all[j]) {
            consider(c, [k, on[i], on[j]]);
        }
    }
    best.unwrap_or((across(p, p), [k; 3]))
}

/// The smallest circle round three points.
pub(crate) fn round_of_three([a, b, c]: [[f64; 2]; 3]) -> Round {
    let square = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    let (ab, bc, ca) = (square(a, b), square(b, c), square(c, a));
    // Beside a right or obtuse angle the longest side is the diameter.
    if ab >= bc + ca {
        across(a, b)
    } else if bc >= ca + ab {
        across(b, c)
    } else if ca >= ab + bc {
        across(c, a)
    } else {
        through(a, b, c).unwrap_or_else(|| across(a, b))
    }
}

/// Radius of the smallest circle round three points.
pub(crate) fn radius_of_three(points: [[f64; 2]; 3]) -> f64 {
    round_of_three(points).square.sqrt()
}

/// Radius of the circle through three points, or with two on a diameter: a smooth function, unlike
/// that of the smallest circle at a right angle.
pub(crate) fn radius_through([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let circle = through(a, b, c).unwrap_or_else(|| round_of_three([a, b, c]));
    circle.square.sqrt()
}

/// The circle with two points at the ends of a diameter.
fn across(a: [f64; 2], b: [f64; 2]) -> Round {
    let (x, y) = (f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1]));
    Round {
        x,
        y,
        square: ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)) / 4.0,
    }
}

/// The circle through three points; `None` if they are on a line.
fn through(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Option<Round> {
    let (p, q) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let twice_area = p[0] * q[1] - p[1] * q[0];
    let (pp, qq) = (p[0] * p[0] + p[1] * p[1], q[0] * q[0] + q[1] * q[1]);
    if twice_area * twice_area <= 1e-20 * pp * qq {
        return None;
    }
    let x = (q[1] * pp - p[1] * qq) / (2.0 * twice_area);
    let y = (p[0] * qq - q[0] * pp) / (2.0 * twice_area);
    Some(Round {
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
    let on = circle.on.map(point);
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let [a, b, c] = on;
    let side = distance(a, b).max(distance(b, c)).max(distance(c, a));
    let Round { x, y, .. } = round_of_three(on);
    let near = (side - circle.radius) * (1.0 - OUTSIDE);
    let ends = (0..path.len() * LANES).map(point);
    let mut ends: Vec<_> = ends.filter(|p| distance(*p, [x, y]) >= near).collect();
    corners_of_hull(&mut ends);
    let mut longest = side;
    for (n, p) in ends.iter().enumerate() {
        for q in &ends[n + 1..] {
            longest = longest.max(distance(*p, *q));
        }
    }
    longest / 2.0
}

/// Keeps the corners of the convex hull: A. M. Andrew, Inf. Process. Lett. 9 (1979) 216-219.
fn corners_of_hull(points: &mut Vec<[f64; 2]>) {
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
