//! The most that a function of the plane may be on a triangle, from its corners.
//!
//! Let f have a second derivative along great circles of at least -K, and nowhere on the triangle be
//! below a number l. With A = K - l the sum F = f + A has F'' + F >= 0, so that |v| F(v/|v|) is a
//! convex function of the vector v, and at v = sum of w_i a_i, a mean of the corners a_i, at most the
//! mean S of the corners' F. Hence f + A <= S(v)/|v| on the triangle. S is linear in v: in the plane
//! of the corners, at the distance h from the origin, S = S_o + g.x, x reckoned from the foot o of
//! the origin, and |v|^2 = h^2 + x^2, so that (Cauchy and Schwarz)
//!
//! f + A <= sqrt((S_o/h)^2 + g^2), at x = g h^2/S_o,
//!
//! if that lies in the triangle; else the largest value is on an edge, where the same holds with one
//! dimension less (derived). A function whose F'' + F is zero reaches the bound.

#![allow(
    clippy::inline_always,
    reason = "they are to be compiled for the processor that runs them"
)]

use pulp::{Simd, WithSimd};

use super::lanes::{LANES, Lanes};

/// Eight triangles, and what a function of the plane is on them.
pub(super) struct MostOn {
    /// By corner and axis.
    pub(super) corners: [[Lanes; 3]; 3],
    /// At least the values at the corners.
    pub(super) values: [Lanes; 3],
    /// At most any value on the triangle.
    pub(super) low: Lanes,
    /// The bound K of the second derivative.
    pub(super) bend: f64,
}

impl WithSimd for MostOn {
    /// No number of the triangle exceeds this.
    type Output = Lanes;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Lanes {
        let mut most = [0.0; LANES];
        for l in 0..LANES {
            let raise = self.bend - self.low[l];
            let [a, b, c] = &self.corners;
            let corner = |a: &[Lanes; 3]| [a[0][l], a[1][l], a[2][l]];
            let raised = [
                self.values[0][l] + raise,
                self.values[1][l] + raise,
                self.values[2][l] + raise,
            ];
            most[l] = most_raised(corner(a), corner(b), corner(c), raised) - raise;
        }
        most
    }
}

/// The largest S/|v| on a triangle.
#[inline(always)]
fn most_raised(a: [f64; 3], b: [f64; 3], c: [f64; 3], [s_a, s_b, s_c]: [f64; 3]) -> f64 {
    let (p, q) = (minus(b, a), minus(c, a));
    let normal = cross(p, q);
    let over = 1.0 / dot(normal, normal);
    let (across_q, across_p) = (cross(q, normal), cross(normal, p));
    let (by_p, by_q) = ((s_b - s_a) * over, (s_c - s_a) * over);
    let g = [
        by_p * across_q[0] + by_q * across_p[0],
        by_p * across_q[1] + by_q * across_p[1],
        by_p * across_q[2] + by_q * across_p[2],
    ];
    let height = dot(normal, a);
    let h_squared = height * height * over;
    let at_foot = s_a - dot(g, a);
    // From the first corner to the foot and on to the top.
    let (foot, on) = (height * over, h_squared / at_foot);
    let y = [
        foot * normal[0] - a[0] + on * g[0],
        foot * normal[1] - a[1] + on * g[1],
        foot * normal[2] - a[2] + on * g[2],
    ];
    let (w_b, w_c) = (dot(y, across_q) * over, dot(y, across_p) * over);
    let inside = at_foot * at_foot / h_squared + dot(g, g);
    let on_edges =
        on_edge(p, s_a, s_b)
            .max(on_edge(q, s_a, s_c))
            .max(on_edge(minus(c, b), s_b, s_c));
    let within = (w_b >= 0.0) & (w_c >= 0.0) & (w_b + w_c <= 1.0);
    (if within { inside } else { on_edges }).sqrt()
}

/// The square of the largest S/|v| of an edge.
#[inline(always)]
fn on_edge(chord: [f64; 3], s_a: f64, s_b: f64) -> f64 {
    let length_squared = dot(chord, chord);
    let h_squared = 1.0 - length_squared / 4.0;
    let (middle, change) = (0.5 * (s_a + s_b), s_b - s_a);
    let top = middle * middle / h_squared + change * change / length_squared;
    let end = if s_a > s_b { s_a } else { s_b };
    if change.abs() * h_squared <= middle * length_squared / 2.0 {
        top
    } else {
        end * end
    }
}

#[inline(always)]
fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
