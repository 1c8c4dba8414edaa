//! Surface coefficients in plane strain: infinitely long strips of width dx along y.
//!
//! With A(k)/k the response of the body to tractions exp(i k x), a line load displaces the surface
//! by
//!
//! ```text
//! u(x) = 1/pi integral of A(k)/k (cos k x - cos k L) dk          u_x(q_x), u_y(q_y), u_z(p)
//! u(x) = -1/pi integral of B(k)/k sin k x dk                     u_x(p)
//! ```
//!
//! over k > 0. A line load leaves a constant open: displacements are relative to the points at the
//! distance L, here the grid's length, of any stack of layers; of a homogeneous body the integral
//! is -A/pi ln(|x|/L) (K. L. Johnson, Contact Mechanics (1985), eq. (2.19), (2.22)). As in three
//! dimensions A is the response of the outermost material, whose integral over a strip is closed, plus a
//! remainder that decays like exp(-2 k h), whose integral over k is taken by a Gauss rule.

use std::f64::consts::PI;

use ndarray::Array2;
use rayon::prelude::*;

use super::InfluenceCoefficients;
use super::layered_frf::{HalfSpace, RadialResponse, Stack};
use crate::scene::Grid;
use quadrature::gauss;

/// Phase 2 k h beyond which the remainder, exp(-2 k h) times a low power, is below rounding.
const DECAY: f64 = 48.0;
/// Longest panel of the k-integral in 1/L: the phase k x turns by no more.
const LONGEST: f64 = 8.0;
/// Gauss nodes per panel.
const NODES: usize = 20;

/// The coefficients of a stack on a grid in plane strain.
pub(crate) fn line_coefficients(stack: &Stack, grid: &Grid) -> InfluenceCoefficients {
    let (dx, length) = (grid.dx, grid.nx as f64 * grid.dx);
    let nodes = remainder_nodes(stack, length);
    let coefficients_at = |i: usize| {
        let x = i as f64 * dx;
        let mut sum = integrate_over_strip(&stack.outermost(), i, dx, length);
        for Node { k, far, d } in &nodes {
            let strip = dx * sinc(k * dx / 2.0);
            let (sine, cosine) = (k * x).sin_cos();
            let even = (strip * cosine - dx * far) / k;
            let odd = strip * sine / k;
            let terms = [even * d.rr, even * d.tt, even * d.zz, -odd * d.rz];
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum += term;
            }
        }
        sum
    };
    let rows: Vec<[f64; 4]> = (0..grid.nx).into_par_iter().map(coefficients_at).collect();
    let quadrant = |c: usize| Array2::from_shape_fn((grid.nx, 1), |(i, _)| rows[i][c]);
    let zeros = || Array2::zeros((grid.nx, 1));
    InfluenceCoefficients {
        xx: quadrant(0),
        yy: quadrant(1),
        zz: quadrant(2),
        xz: quadrant(3),
        xy: zeros(),
        yz: zeros(),
    }
}

/// xx, yy, zz, xz of a half-space under a strip `i` strips away: the integrals of ln(|x|/L) and of
/// the sign of x.
fn integrate_over_strip(material: &HalfSpace, i: usize, dx: f64, length: f64) -> [f64; 4] {
    let HalfSpace { a, b, c, .. } = *material;
    let primitive = |x: f64| x * ((x.abs() / length).ln() - 1.0);
    let x = i as f64 * dx;
    let log = (primitive(x + dx / 2.0) - primitive(x - dx / 2.0)) / PI;
    let sign = if i == 0 { 0.0 } else { 0.5 * dx };
    [-a * log, -c * log, -a * log, -b * sign]
}

/// A node of the k-integral: wave number \[1/m\], cos(k L), the remainder times weight over pi.
struct Node {
    k: f64,
    far: f64,
    d: RadialResponse,
}

/// Nodes of the quadrature over the wave number for the part of the response that the layers add to a
/// half-space; none without a layer.
fn remainder_nodes(stack: &Stack, length: f64) -> Vec<Node> {
    let Some((_, h)) = stack.layers.first() else {
        return Vec::new();
    };
    let k_max = DECAY / (2.0 * h);
    let mut nodes = Vec::new();
    let (mut panel_start, mut panel_end) = (
        0.0,
        (stack.lowest_scale().min(1.0 / length) / 8.0).min(k_max),
    );
    while panel_start < k_max {
        for (t, weight) in gauss(NODES) {
            let half = (panel_end - panel_start) / 2.0;
            let k = f64::midpoint(panel_start, panel_end) + half * t;
            let d = stack.remainder(k);
            let weight_over_pi = weight * half / PI;
            nodes.push(Node {
                k,
                far: (k * length).cos(),
                d: RadialResponse {
                    zz: weight_over_pi * d.zz,
                    rr: weight_over_pi * d.rr,
                    tt: weight_over_pi * d.tt,
                    rz: weight_over_pi * d.rz,
                },
            });
        }
        (panel_start, panel_end) = (
            panel_end,
            (2.0 * panel_end)
                .min(panel_end + LONGEST / length)
                .min(k_max),
        );
    }
    nodes
}

/// sin(x)/x.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}
