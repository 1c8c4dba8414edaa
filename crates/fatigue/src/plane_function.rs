//! A criterion as a function of the plane, and the record of an evaluated plane.

use crate::hemisphere::{Face, Hemisphere};
use crate::refine::Piece;
use crate::tangent::Tangent;

/// Marks the end of a list of edges.
pub(crate) const NO_EDGE: usize = usize::MAX;

/// A plane and the bounds of its parts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// Unit normal.
    pub(crate) n: [f64; 3],
    /// Upper bounds (rounding included) of the two parts, and of the criterion, which increases
    /// with both.
    pub(crate) parts: [f64; 2],
    pub(crate) value: f64,
    /// Lower bounds of the parts.
    pub(crate) low: [f64; 2],
    /// The deciding instants, as in [`Piece`]; a guess before the plane is evaluated.
    pub(crate) instants: [usize; 6],
    /// Head of the list of edges whose lower-numbered end is this plane.
    pub(crate) edge: usize,
}

/// A plane on which the first part is at most `first`, or the tangent at most `sum`, need not be
/// evaluated exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threshold {
    pub(crate) first: f64,
    pub(crate) tangent: Tangent,
    pub(crate) sum: f64,
}

/// The best plane so far.
#[derive(Clone, Copy)]
pub(crate) struct BestPlane {
    pub(crate) n: [f64; 3],
    pub(crate) parts: [f64; 2],
    /// The tangent at these parts.
    pub(crate) tangent: Tangent,
    /// Ascending: its value v, (1 + tie) v, up to which planes tie with it, and v + tolerance. A
    /// face whose bound is below one of them needs no sharper bound for that purpose.
    pub(crate) values: [f64; 3],
}

/// Bounds on second derivatives of the parts along great circles, which are nowhere below -K, and
/// on their slopes, up and down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurvatureBounds {
    pub(crate) parts: [f64; 2],
    pub(crate) slopes: [f64; 2],
    /// Upper bound of the first part over all planes.
    pub(crate) first: f64,
}

/// A criterion on planes.
pub(crate) trait PlaneFunction {
    /// Evaluates planes; exactly only where a plane may exceed `enough`.
    fn measure(&mut self, planes: &mut [Plane], enough: Threshold);
    /// The faces of the first triangulation.
    fn first_faces(&self) -> &'static Hemisphere;
    /// Bound of the rounding error of the value of a plane.
    fn rounding(&mut self, n: [f64; 3]) -> f64;
    /// Evaluates in double precision from now on.
    fn to_double(&mut self);
    /// The two quantities on the plane of a unit normal, to rounding.
    fn parts(&mut self, n: [f64; 3]) -> [f64; 2];
    /// The criterion as a function of the parts; it increases with both.
    fn value(&self, parts: [f64; 2]) -> f64;
    /// A [`Tangent`]: a linear bound of the criterion that is exact at these parts.
    fn tangent(&self, parts: [f64; 2]) -> Tangent;
    /// The bounds on second derivatives, from the largest first part on the first planes and the
    /// largest 1/cos r - 1 of their triangles.
    fn curvature_bounds(&self, largest: f64, sag: f64) -> CurvatureBounds;
    /// Lowers the bounds of the faces by quadratic forms of their corners.
    fn bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &BestPlane);
    /// The maxima of pieces within this part of the best value are refined, since they may lead to
    /// a better plane.
    fn lead(&self) -> f64;
    /// Relative difference below which planes tie and the second part decides, since complementary
    /// planes have the same shear; 0 for criteria without a tie.
    fn tie(&self) -> f64;
    /// The piece of given instants.
    fn piece(&self, instants: [usize; 6]) -> Piece;
    /// The piece of the deciding instants on the plane of a unit normal, to rounding.
    fn deciding_piece(&mut self, n: [f64; 3]) -> Piece;

    /// A value that is not small.
    fn yardstick(&self, bend: &CurvatureBounds) -> f64;
    /// Upper bound of the criterion over all planes, independent of the search.
    fn ceiling(&self, bend: &CurvatureBounds) -> f64;

    /// The record of the best plane, with the tolerance of its value.
    fn best_plane(&mut self, n: [f64; 3], value: f64, tolerance: f64) -> BestPlane {
        let parts = self.parts(n);
        BestPlane {
            n,
            parts,
            tangent: self.tangent(parts),
            values: [value, value + self.tie() * value.abs(), value + tolerance],
        }
    }

    /// The criterion on the plane of a unit normal, to rounding.
    fn criterion_at(&mut self, n: [f64; 3]) -> f64 {
        let parts = self.parts(n);
        self.value(parts)
    }
}

impl Plane {
    /// A plane that is not evaluated yet.
    pub(crate) fn unevaluated(n: [f64; 3], instants: [usize; 6]) -> Self {
        Self {
            n,
            parts: [f64::NAN; 2],
            value: f64::NAN,
            low: [f64::NAN; 2],
            instants,
            edge: NO_EDGE,
        }
    }
}

impl CurvatureBounds {
    /// Bound K on the second derivative of the tangent's sum.
    pub(crate) fn for_sum(&self, tangent: &Tangent) -> f64 {
        tangent.first * self.parts[0] + tangent.second * self.parts[1]
    }
}
