//! An upper bound of a criterion with the shear amplitude on triangles of normals near the best
//! plane.
//!
//! Let C be a constant tensor and D = S - C. The smallest circle on a plane is no larger than that
//! about the shear of C, and the shear of D on the plane of n no longer than (D - m) n for any
//! number m, so that tau_a^2 is at most the largest n.(D - m)^2.n of all instants, with a number m
//! for each (derived). C is the mean of the two stresses whose shear is a diameter of the circle on
//! the best plane, m the normal component of D there. On that plane both sides are equal; turned
//! about the axis across the shear, the normal stress of D is m + tau sin 2t and its shear tau cos
//! 2t, and they stay so. Where three instants make the circle, its centre moves other than a
//! constant tensor has it, and the bound is of no use.
//!
//! For any s > 0 the amplitude is at most tau_a^2/(2 s) + s/2; here s is the amplitude on the best
//! plane.

use stress_tensor::StressTensor;

use crate::eight_planes::Instants;
use crate::forms::{EDGES, Forms, gather_corners, lower_bounds};
use crate::hemisphere::Face;
use crate::lanes::{Eight, LANES, ROUNDING};
use crate::path::{Path, dot, normal_weights};
use crate::plane_function::{BestPlane, Plane};

/// Bound on planes near the best plane.
pub(crate) struct BestPlaneBound {
    /// Bound of the rounding errors of the squares \[Pa^2\].
    slack: f64,
}

impl BestPlaneBound {
    /// Loads the squares (D - m)^2 about a plane. The shear of the stresses at two instants is a
    /// diameter of the circle.
    pub(crate) fn load(
        n: [f64; 3],
        [a, b]: [StressTensor; 2],
        path: &Path,
        squares: &mut Instants<f32>,
    ) -> Self {
        let centre: StressTensor = std::array::from_fn(|c| f64::midpoint(a[c], b[c]));
        let normal = normal_weights(n);
        let mut largest = 0.0_f64;
        squares.load_tensors(path.instants().map(|s| {
            let mut d: StressTensor = std::array::from_fn(|c| s[c] - centre[c]);
            let m: f64 = normal.iter().zip(&d).map(|(w, d)| w * d).sum();
            for normal in &mut d[..3] {
                *normal -= m;
            }
            let square = squared(&d);
            largest = largest.max(square[0] + square[1] + square[2]);
            square
        }));
        let slack = ROUNDING * f64::from(f32::EPSILON) * largest;
        Self { slack }
    }

    /// Lowers the bounds of faces by the diameter of the circle on the best plane. `s` is the amplitude there;
    /// `second` bounds the second part on the edges of eight faces. Stops and returns false once fewer than one
    /// face in four is excluded.
    pub(crate) fn bounds(
        &self,
        squares: &Instants<f32>,
        s: f64,
        second: impl Fn(&[Face]) -> [Eight<f64>; 3],
        (faces, planes): (&mut [Face], &[Plane]),
        known: &BestPlane,
    ) -> bool {
        let (mut tried, mut excluded) = (0, 0);
        let first = |square: f32, cosine: f64| {
            (f64::from(square) + self.slack) / (2.0 * s) + s / 2.0 * cosine
        };
        for eight in faces.chunks_mut(LANES) {
            let corners = gather_corners(eight);
            let pair =
                |(i, j): (usize, usize)| squares.mixed(&corners[i], &corners[j], None).normal_max;
            let diagonal = [(0, 0), (1, 1), (2, 2)].map(pair);
            let mixed = EDGES.map(pair);
            let second = second(eight);
            lower_bounds(eight, |l, face| {
                let corner =
                    |k: usize| [first(diagonal[k][l], 1.0), planes[face.planes[k]].parts[1]];
                let edge = |k: usize| {
                    let (i, j) = EDGES[k];
                    let cosine = dot(face.corners[i], face.corners[j]);
                    [first(mixed[k][l], cosine), second[k][l]]
                };
                let forms = Forms::new([0, 1, 2].map(corner), [0, 1, 2].map(edge), &face.corners);
                let proved = forms.smallest_proved(&known.values, &[known.tangent]);
                proved.unwrap_or(f64::INFINITY)
            });
            tried += eight.len();
            excluded += eight.iter().filter(|f| f.most <= known.values[2]).count();
            if 4 * excluded < tried {
                return false;
            }
        }
        true
    }
}

/// The matrix product D D of a symmetric tensor.
fn squared(&[xx, yy, zz, xy, xz, yz]: &StressTensor) -> StressTensor {
    [
        xx * xx + xy * xy + xz * xz,
        xy * xy + yy * yy + yz * yz,
        xz * xz + yz * yz + zz * zz,
        xx * xy + xy * yy + xz * yz,
        xx * xz + xy * yz + xz * zz,
        xy * xz + yy * yz + yz * zz,
    ]
}
