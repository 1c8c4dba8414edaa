//! The smallest circles round the shear on eight planes at a time.
//!
//! As in the `circle` module the farthest instant outside the circle of three joins these. The circle
//! is then the largest of the smallest circles round this instant and two of the three: the smallest
//! circle round any points is that of two or three of them, and round more points it is no smaller
//! (E. Welzl, Lect. Notes Comput. Sci. 555 (1991) 359-370).

#![allow(
    clippy::inline_always,
    reason = "they are to be compiled for the processor that runs them"
)]

use pulp::{Simd, WithSimd};

use super::lanes::{Eight, LANES, Lanes, Real};

/// What is known of the smallest circles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// Three instants on each plane, whole numbers; where two make the circle, the third is the
    /// second.
    pub(super) on: [Lanes; 3],
    /// Squares of radii of the smallest circles round these: those round all are no smaller.
    pub(super) of_three: Lanes,
    /// Squares of radii of circles that hold all instants.
    pub(super) of_all: Lanes,
}

/// Looks for the circles on eight planes, from three instants on each.
pub(super) struct Circles<'a, F> {
    /// By instant.
    pub(super) shear: &'a [[Eight<F>; 2]],
    pub(super) on: [Lanes; 3],
    /// Squares of radii that need not be made smaller.
    pub(super) enough: Lanes,
}

impl<F: Real> WithSimd for Circles<'_, F> {
    type Output = Found;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Found {
        let Self { shear, on, enough } = self;
        let mut circle = Three {
            on,
            ..Three::default()
        };
        for k in circle.on.as_flattened_mut() {
            if *k as usize >= shear.len() {
                *k = 0.0;
            }
        }
        circle.round(simd, shear);
        let mut open = [1.0; LANES];
        loop {
            let (squares, instants) = farthest(simd, shear, &circle);
            let mut again = false;
            for l in 0..LANES {
                let outside = squares[l] > circle.square[l] * (1.0 + 8.0 * F::EPSILON);
                if !(outside && squares[l] > enough[l]) {
                    open[l] = 0.0;
                }
                again |= open[l] > 0.0;
            }
            if !again {
                return Found {
                    on: circle.on,
                    of_three: circle.square,
                    of_all: squares,
                };
            }
            circle.join(simd, shear, &instants, &mut open);
        }
    }
}

/// Three instants on each plane and the smallest circle round their shear.
#[derive(Clone, Copy, Debug, Default)]
struct Three {
    on: [Lanes; 3],
    x: Lanes,
    y: Lanes,
    square: Lanes,
}

/// The same in vectors, of instants, centres and squares of radii.
struct Vectors<S: Simd> {
    on: [S::f64s; 3],
    x: S::f64s,
    y: S::f64s,
    square: S::f64s,
}

impl Three {
    /// Takes the smallest circles round the three.
    #[inline(always)]
    fn round<F: Real, S: Simd>(&mut self, simd: S, shear: &[[Eight<F>; 2]]) {
        let [a, b, c] = self.points(shear);
        for v in 0..LANES / S::F64_LANES {
            let own = self.get(simd, v);
            let points = [pair(simd, &a, v), pair(simd, &b, v), pair(simd, &c, v)];
            self.put(simd, v, &round_of_three(simd, own.on, points));
        }
    }

    /// Where it is open takes the instant k as well, which is outside; closes what does not become
    /// larger, by rounding.
    #[inline(always)]
    fn join<F: Real, S: Simd>(
        &mut self,
        simd: S,
        shear: &[[Eight<F>; 2]],
        k: &Lanes,
        open: &mut Lanes,
    ) {
        let ([a, b, c], p) = (self.points(shear), at(shear, k));
        for v in 0..LANES / S::F64_LANES {
            let own = self.get(simd, v);
            let [i, j, l] = own.on;
            let (k, p) = (vector(simd, k, v), pair(simd, &p, v));
            let (a, b, c) = (pair(simd, &a, v), pair(simd, &b, v), pair(simd, &c, v));
            let largest = larger(
                simd,
                round_of_three(simd, [k, i, j], [p, a, b]),
                larger(
                    simd,
                    round_of_three(simd, [k, i, l], [p, a, c]),
                    round_of_three(simd, [k, j, l], [p, b, c]),
                ),
            );
            let (one, none) = (simd.splat_f64s(1.0), simd.splat_f64s(0.0));
            let was_open = simd.greater_than_f64s(vector(simd, open, v), none);
            let grows = simd.greater_than_f64s(largest.square, own.square);
            let taken = simd.and_m64s(was_open, grows);
            self.put(simd, v, &choose(simd, taken, &largest, &own));
            S::as_mut_simd_f64s(open).0[v] = simd.select_f64s_m64s(taken, one, none);
        }
    }

    /// The shear at the three instants.
    #[inline(always)]
    fn points<F: Real>(&self, shear: &[[Eight<F>; 2]]) -> [[Lanes; 2]; 3] {
        let [i, j, k] = &self.on;
        [at(shear, i), at(shear, j), at(shear, k)]
    }

    #[inline(always)]
    fn get<S: Simd>(&self, simd: S, v: usize) -> Vectors<S> {
        let [i, j, k] = &self.on;
        Vectors {
            on: [vector(simd, i, v), vector(simd, j, v), vector(simd, k, v)],
            x: vector(simd, &self.x, v),
            y: vector(simd, &self.y, v),
            square: vector(simd, &self.square, v),
        }
    }

    #[inline(always)]
    fn put<S: Simd>(&mut self, _: S, v: usize, found: &Vectors<S>) {
        for (own, on) in self.on.iter_mut().zip(&found.on) {
            S::as_mut_simd_f64s(own).0[v] = *on;
        }
        S::as_mut_simd_f64s(&mut self.x).0[v] = found.x;
        S::as_mut_simd_f64s(&mut self.y).0[v] = found.y;
        S::as_mut_simd_f64s(&mut self.square).0[v] = found.square;
    }
}

#[inline(always)]
fn vector<S: Simd>(_: S, lanes: &Lanes, v: usize) -> S::f64s {
    S::as_simd_f64s(lanes).0[v]
}

#[inline(always)]
fn pair<S: Simd>(simd: S, [x, y]: &[Lanes; 2], v: usize) -> [S::f64s; 2] {
    [vector(simd, x, v), vector(simd, y, v)]
}

/// Of two circles on each plane the larger.
#[inline(always)]
fn larger<S: Simd>(simd: S, one: Vectors<S>, other: Vectors<S>) -> Vectors<S> {
    choose(
        simd,
        simd.greater_than_f64s(one.square, other.square),
        &one,
        &other,
    )
}

/// One where the mask is set, else the other.
#[inline(always)]
fn choose<S: Simd>(simd: S, mask: S::m64s, one: &Vectors<S>, other: &Vectors<S>) -> Vectors<S> {
    let of = |one, other| simd.select_f64s_m64s(mask, one, other);
    Vectors {
        on: [
            of(one.on[0], other.on[0]),
            of(one.on[1], other.on[1]),
            of(one.on[2], other.on[2]),
        ],
        x: of(one.x, other.x),
        y: of(one.y, other.y),
        square: of(one.square, other.square),
    }
}

/// The shear at an instant on each plane.
#[inline(always)]
fn at<F: Real>(shear: &[[Eight<F>; 2]], instants: &Lanes) -> [Lanes; 2] {
    let mut points = [[0.0; LANES]; 2];
    for l in 0..LANES {
        let [x, y] = &shear[instants[l] as usize];
        (points[0][l], points[1][l]) = (x[l].wide(), y[l].wide());
    }
    points
}

/// The square of the largest distance from the centre on each plane, and the instant.
#[inline(always)]
fn farthest<F: Real, S: Simd>(simd: S, shear: &[[Eight<F>; 2]], from: &Three) -> (Lanes, Lanes) {
    let (mut x, mut y) = ([F::near(0.0); LANES], [F::near(0.0); LANES]);
    for l in 0..LANES {
        (x[l], y[l]) = (F::near(from.x[l]), F::near(from.y[l]));
    }
    let mut far = [F::near(-1.0); LANES];
    let mut at = [F::near(0.0); LANES];
    let (mut t, one) = (F::near(0.0), F::near(1.0));
    for [xs, ys] in shear {
        let mut square = [F::near(0.0); LANES];
        for l in 0..LANES {
            let (a, b) = (xs[l] - x[l], ys[l] - y[l]);
            square[l] = a.mul_add(a, b * b);
        }
        F::raise_marked(simd, &mut far, &mut at, &square, t);
        t = t + one;
    }
    let (mut squares, mut instants) = ([0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        (squares[l], instants[l]) = (far[l].wide(), at[l].wide());
    }
    (squares, instants)
}

/// The smallest circle round three points: that with the longest side as its diameter beside a right
/// or obtuse angle, else the one through all three.
#[inline(always)]
fn round_of_three<S: Simd>(simd: S, on: [S::f64s; 3], [a, b, c]: [[S::f64s; 2]; 3]) -> Vectors<S> {
    let minus =
        |a: [S::f64s; 2], b: [S::f64s; 2]| [simd.sub_f64s(a[0], b[0]), simd.sub_f64s(a[1], b[1])];
    let times = |a, b| simd.mul_f64s(a, b);
    let square = |a: [S::f64s; 2]| simd.mul_add_e_f64s(a[0], a[0], times(a[1], a[1]));
    let pick = |mask, one, other| simd.select_f64s_m64s(mask, one, other);
    let half = simd.splat_f64s(0.5);
    let (p, q) = (minus(b, a), minus(c, a));
    let (ab, bc, ca) = (square(p), square(minus(q, p)), square(q));
    // The longest side: from one instant to another, with twice its middle seen from a.
    let by = simd.greater_than_f64s(bc, ab);
    let longest = pick(by, bc, ab);
    let (i, j) = (pick(by, on[1], on[0]), pick(by, on[2], on[1]));
    let x = pick(by, simd.add_f64s(p[0], q[0]), p[0]);
    let y = pick(by, simd.add_f64s(p[1], q[1]), p[1]);
    let by = simd.greater_than_f64s(ca, longest);
    let longest = pick(by, ca, longest);
    let (i, j) = (pick(by, on[2], i), pick(by, on[0], j));
    let (x, y) = (pick(by, q[0], x), pick(by, q[1], y));
    let all = simd.add_f64s(ab, simd.add_f64s(bc, ca));
    let of_two = simd.greater_than_or_equal_f64s(simd.add_f64s(longest, longest), all);
    // The centre of the circle through a, b and c, seen from a.
    let twice_area = simd.sub_f64s(times(p[0], q[1]), times(p[1], q[0]));
    let scale = simd.div_f64s(half, twice_area);
    let across = |q, ab, p, ca| times(scale, simd.sub_f64s(times(q, ab), times(p, ca)));
    let x = pick(of_two, times(half, x), across(q[1], ab, p[1], ca));
    let y = pick(of_two, times(half, y), across(p[0], ca, q[0], ab));
    Vectors {
        on: [
            pick(of_two, i, on[0]),
            pick(of_two, j, on[1]),
            pick(of_two, j, on[2]),
        ],
        x: simd.add_f64s(a[0], x),
        y: simd.add_f64s(a[1], y),
        square: square([x, y]),
    }
}
