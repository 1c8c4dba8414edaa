//! An upper bound of a function of the plane on a triangle, from its corners.
//!
//! Let f have a second derivative along great circles of at least -K, and nowhere on the triangle
//! be below a number l. With A = K - l the sum F = f + A has F'' + F >= 0, so that |v| F(v/|v|) is
//! a convex function of the vector v, and at v = sum of w_i a_i, a mean of the corners a_i, at most
//! the mean S of the corners' F. Hence f + A <= S(v)/|v| on the triangle. S is linear in v: in the
//! plane of the corners, at the distance h from the origin, S = S_o + g.x, x reckoned from the foot
//! o of the origin, and |v|^2 = h^2 + x^2, so that (Cauchy and Schwarz)
//!
//! f + A <= sqrt((S_o/h)^2 + g^2), at x = g h^2/S_o,
//!
//! if that lies in the triangle; else the largest value is on an edge, where the same holds with
//! one dimension less (derived). A function whose F'' + F is zero reaches the bound.

use crate::hemisphere::{Face, Triangle};
use crate::path::{cross, dot};

/// Upper bound of a function on a face of the hemisphere. `corners` are upper bounds of its values at the
/// corners, `low` is a lower bound on the face, and `K` bounds the second derivative.
pub(crate) fn max_on_face(face: &Face, corners: [f64; 3], low: f64, K: f64) -> f64 {
    let raised = corners.map(|f| K + (f - low));
    max_inside(&face.corners, raised).unwrap_or_else(|| max_on_edges(&face.corners, raised)) - K
        + low
}

/// The largest S/|v| in the plane through the corners v with the values s, if it lies inside the triangle.
fn max_inside([a, b, c]: &Triangle, [s_a, s_b, s_c]: [f64; 3]) -> Option<f64> {
    let (p, q) = (minus(b, a), minus(c, a));
    let normal = cross(p, q);
    let square = dot(normal, normal);
    let (across_q, across_p) = (cross(q, normal), cross(normal, p));
    let (by_p, by_q) = ((s_b - s_a) / square, (s_c - s_a) / square);
    let g: [f64; 3] = [0, 1, 2].map(|d| by_p * across_q[d] + by_q * across_p[d]);
    let height = dot(normal, *a);
    let h_squared = height * height / square;
    let at_foot = s_a - dot(g, *a);
    // From the first corner to the foot and on to the top.
    let (foot, along_slope) = (height / square, h_squared / at_foot);
    let y = [0, 1, 2].map(|d| foot * normal[d] - a[d] + along_slope * g[d]);
    let (w_b, w_c) = (dot(y, across_q) / square, dot(y, across_p) / square);
    let is_inside = w_b >= 0.0 && w_c >= 0.0 && w_b + w_c <= 1.0;
    is_inside.then(|| (at_foot * at_foot / h_squared + dot(g, g)).sqrt())
}

/// The largest S/|v| on the edges of the triangle.
fn max_on_edges([a, b, c]: &Triangle, [s_a, s_b, s_c]: [f64; 3]) -> f64 {
    let edge = |a: &[f64; 3], b: &[f64; 3], s_a: f64, s_b: f64| {
        let chord = minus(b, a);
        let length_squared = dot(chord, chord);
        let h_squared = 1.0 - length_squared / 4.0;
        let (middle, change) = (f64::midpoint(s_a, s_b), s_b - s_a);
        if change.abs() * h_squared <= middle * length_squared / 2.0 {
            middle * middle / h_squared + change * change / length_squared
        } else {
            s_a.max(s_b).powi(2)
        }
    };
    let largest = edge(a, b, s_a, s_b).max(edge(b, c, s_b, s_c));
    largest.max(edge(c, a, s_c, s_a)).sqrt()
}

/// a - b
fn minus(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
