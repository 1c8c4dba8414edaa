//! The most that Smith, Watson and Topper's product may be on a triangle of normals.
//!
//! With the corners a_i and v = sum of w_i a_i, w >= 0, the normal stress on the plane of n = v/|v| is
//! (sum of w_i w_j a_i.S.a_j)/|v|^2, and |v|^2 the sum of w_i w_j a_i.a_j. All w being positive, its
//! largest value over time is no larger than with the largest a_i.S.a_j of all instants, each for
//! itself, and so is the strain amplitude with half the range of the strain's. A sum x a + y b of the
//! two, as a [`Tangent`] has it, is nowhere above s if
//!
//! sum of w_i w_j (s a_i.a_j - x A_ij - y B_ij) >= 0 for all w >= 0 (derived).
//!
//! No bend is bounded by that of the steepest direction: stresses of contacts are often near to
//! pressure in one direction, with little tension on a whole ring of planes.

use super::copositive::is_copositive;
use super::eight_planes::Instants;
use super::hemisphere::Face;
use super::lanes::{LANES, Real};
use super::path::dot;
use super::plane_function::Plane;
use super::tangent::Tangent;

/// What the products of planes are compared with.
pub(super) struct ProductBound<'a> {
    /// The strain is the first times the normal stress less the second times the sum of all three.
    pub(super) strain: [f64; 2],
    /// What rounding may take from the strain amplitude and from the normal stress.
    pub(super) slack: [f64; 2],
    /// At the best plane.
    pub(super) tangent: &'a Tangent,
    /// The value there, and one above that is near enough.
    pub(super) values: [f64; 2],
}

/// Strain amplitude and normal stress of the corners of a face, and mixed ones of its edges with the
/// cosines of these.
struct Forms {
    corners: [[f64; 2]; 3],
    edges: [[f64; 2]; 3],
    cosines: [f64; 3],
}

impl ProductBound<'_> {
    /// What no plane of each face has more of: the first or the second value, or the product of the
    /// largest coefficients.
    pub(super) fn bounds<F: Real>(
        &self,
        instants: &Instants<F>,
        faces: &mut [Face],
        planes: &[Plane],
    ) {
        for eight in faces.chunks_mut(LANES) {
            let corners = [0, 1, 2].map(|k| {
                let face = |l: usize| &eight[l.min(eight.len() - 1)];
                [0, 1, 2].map(|d| std::array::from_fn(|l| face(l).corners[k][d]))
            });
            let mixed = [(0, 1), (1, 2), (2, 0)]
                .map(|(i, j)| instants.mixed(&corners[i], &corners[j], self.strain));
            for (l, face) in eight.iter_mut().enumerate() {
                let [a, b, c] = face.corners;
                let forms = Forms {
                    corners: face.planes.map(|plane| planes[plane].parts),
                    edges: [0, 1, 2].map(|k| {
                        let strain = mixed[k].strain_amplitude[l].wide() + self.slack[0];
                        [strain, mixed[k].normal_max[l].wide() + self.slack[1]]
                    }),
                    cosines: [dot(a, b), dot(b, c), dot(c, a)],
                };
                face.most = self.bound(&forms);
            }
        }
    }

    fn bound(&self, forms: &Forms) -> f64 {
        let largest = [forms.largest(0), forms.largest(1)];
        let product = largest[0] * largest[1].max(0.0);
        let there = Tangent::of_product(0.0, 1.0, largest);
        let at_most = |value: &f64| {
            product <= *value
                || forms.are_at_most(self.tangent, *value)
                || forms.are_at_most(&there, *value)
        };
        let [best, near] = self.values;
        if !at_most(&near) {
            product
        } else if at_most(&best) {
            best
        } else {
            near
        }
    }
}

impl Forms {
    /// No plane has more of a part.
    fn largest(&self, part: usize) -> f64 {
        let corners = self.corners.iter().map(|parts| parts[part]);
        let edges = self.edges.iter().zip(self.cosines);
        let edges = edges.map(|(parts, cosine)| parts[part] / cosine);
        corners.chain(edges).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether the tangent's sum is nowhere above what makes this value.
    fn are_at_most(&self, tangent: &Tangent, value: f64) -> bool {
        let sum = tangent.sum_of(value);
        let below = |parts: [f64; 2], cosine: f64| {
            sum * cosine - tangent.first * parts[0] - tangent.second * parts[1]
        };
        let edge = |k: usize| below(self.edges[k], self.cosines[k]);
        tangent.is_some()
            && is_copositive(
                self.corners.map(|parts| below(parts, 1.0)),
                [0, 1, 2].map(edge),
            )
    }
}
