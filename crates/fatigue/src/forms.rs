//! Two quadratic forms of the corners of a triangle of normals, which bound two parts of a
//! criterion.
//!
//! With the corners a_i and v = sum of w_i a_i, w >= 0, the component n.T.n of a tensor on the
//! plane of n = v/|v| is (sum of w_i w_j a_i.T.a_j)/|v|^2, and |v|^2 the sum of w_i w_j a_i.a_j.
//! All w being positive, the largest component over several tensors is no larger than with the
//! largest a_i.T.a_j of all, each for itself; half the range of the components likewise. With A_ij
//! and B_ij of two parts the sum x a + y b + z of a [`Tangent`] is nowhere above s if
//!
//! sum of w_i w_j ((s - z) a_i.a_j - x A_ij - y B_ij) >= 0 for all w >= 0 (derived).
//!
//! Unlike a bound on second derivatives this one depends on the direction. Stresses of contacts are
//! often nearly uniaxial pressure: the criterion is constant along a ring of planes and varies
//! strongly across it.

use crate::copositive::is_copositive;
use crate::hemisphere::{Face, Triangle};
use crate::lanes::{Eight, LANES};
use crate::path::dot;
use crate::tangent::Tangent;

/// Pairs of corners that are edges.
pub(crate) const EDGES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// A_ij and B_ij.
pub(crate) struct Forms {
    /// A_ii and B_ii of each corner.
    pub(crate) corners: [[f64; 2]; 3],
    pub(crate) edges: [[f64; 2]; 3],
    /// a_i.a_j of the edges.
    cosines: [f64; 3],
}

impl Forms {
    /// Quadratic forms of the two parts (upper bounds at corners and edges) on a face.
    pub(crate) fn new(corners: [[f64; 2]; 3], edges: [[f64; 2]; 3], face: &Triangle) -> Self {
        Self {
            corners,
            edges,
            cosines: EDGES.map(|(i, j)| dot(face[i], face[j])),
        }
    }

    /// Upper bound of the first (0) or second (1) part on the triangle.
    pub(crate) fn max_part(&self, part: usize) -> f64 {
        let corners = self.corners.iter().map(|parts| parts[part]);
        let edges = self.edges.iter().zip(self.cosines);
        let edges = edges.map(|(parts, cosine)| parts[part] / cosine);
        corners.chain(edges).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The smallest of the ascending `values` that one of the tangents proves to be an upper bound of the
    /// criterion; none if no value is.
    pub(crate) fn smallest_proved(&self, values: &[f64; 3], tangents: &[Tangent]) -> Option<f64> {
        let proved = |value: &&f64| tangents.iter().any(|t| self.is_bound(t, **value));
        values.iter().rev().take_while(proved).last().copied()
    }

    /// Whether this tangent proves `value` to be an upper bound of the criterion on the triangle.
    fn is_bound(&self, tangent: &Tangent, value: f64) -> bool {
        let level = tangent.sum_at_value(value) - tangent.constant;
        let below = |parts: [f64; 2], cosine: f64| {
            level * cosine - tangent.first * parts[0] - tangent.second * parts[1]
        };
        let edge = |k: usize| below(self.edges[k], self.cosines[k]);
        is_copositive(
            self.corners.map(|parts| below(parts, 1.0)),
            [0, 1, 2].map(edge),
        )
    }
}

/// The corners of at most eight faces, the faces side by side.
pub(crate) fn gather_corners(faces: &[Face]) -> [[Eight<f64>; 3]; 3] {
    let mut corners = [[[0.0; LANES]; 3]; 3];
    for l in 0..LANES {
        let face = &faces[l.min(faces.len() - 1)];
        for k in 0..3 {
            for d in 0..3 {
                corners[k][d][l] = face.corners[k][d];
            }
        }
    }
    corners
}

/// Lowers the bounds of at most eight faces to `most` of each.
pub(crate) fn lower_bounds(faces: &mut [Face], most: impl Fn(usize, &Face) -> f64) {
    debug_assert!(faces.len() <= LANES);
    for (l, face) in faces.iter_mut().enumerate() {
        face.most = face.most.min(most(l, face));
    }
}
