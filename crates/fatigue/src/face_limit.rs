//! An upper bound of a criterion on a triangle, from its corners and bounds on second derivatives.

use crate::face_bound::max_on_face;
use crate::hemisphere::Face;
use crate::plane_function::{CurvatureBounds, Plane, PlaneFunction};
use crate::tangent::Tangent;

/// Bounds of the criterion on faces, given the best value so far.
pub(crate) struct FaceBound {
    tangent: Tangent,
    bend: CurvatureBounds,
    /// Bounds on the second derivative and the slope of the tangent's sum.
    K: f64,
    slope: f64,
    best: f64,
}

impl FaceBound {
    /// Prepares bounds on faces of the hemisphere: from bounds on the second derivatives of the two parts, the
    /// `tangent` of the criterion at the best plane, and the `best` value so far.
    pub(crate) fn new(bend: &CurvatureBounds, tangent: Tangent, best: f64) -> Self {
        Self {
            tangent,
            bend: *bend,
            K: bend.for_sum(&tangent),
            slope: tangent.first * bend.slopes[0] + tangent.second * bend.slopes[1],
            best,
        }
    }

    /// Upper bound of the criterion on a face. If it is below the best value, no sharper one is computed.
    pub(crate) fn bound(&self, f: &impl PlaneFunction, face: &Face, planes: &[Plane]) -> f64 {
        let Self { tangent, K, .. } = self;
        let [a, b, c] = face.planes;
        let [a, b, c] = [&planes[a], &planes[b], &planes[c]];
        let largest = |a: f64, b: f64, c: f64| a.max(b).max(c);
        let sums = [a, b, c].map(|plane| tangent.evaluate(plane.parts));
        let whole = tangent.value(largest(sums[0], sums[1], sums[2]) + K * face.sag);
        if whole <= self.best {
            return whole;
        }
        let lows = [a, b, c].map(|plane| tangent.evaluate(plane.low));
        let reach = 2.0 * (2.0 * face.sag).sqrt();
        let low = largest(lows[0], lows[1], lows[2]) - self.slope * reach;
        let whole = tangent.value(max_on_face(face, sums, low, *K));
        if whole <= self.best {
            return whole;
        }
        let part =
            |k: usize| largest(a.parts[k], b.parts[k], c.parts[k]) + self.bend.parts[k] * face.sag;
        let parts = [part(0), part(1)];
        whole.min(f.value(parts))
    }
}
