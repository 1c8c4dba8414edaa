//! A criterion as a function of the plane, and the record of an evaluated plane.

use crate::hemisphere::{Face, Hemisphere};
use crate::refine::Deciding;
use crate::tangent::Tangent;

/// No edge.
pub(crate) const NO_EDGE: usize = usize::MAX;

/// An evaluated plane.
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
    /// The deciding instants, as in [`Deciding`]; a guess before the plane is evaluated.
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
pub(crate) struct Bend {
    pub(crate) parts: [f64; 2],
    pub(crate) slopes: [f64; 2],
    /// Upper bound of the first part over all planes.
    pub(crate) first: f64,
}

/// A criterion on planes.
pub(crate) trait PlaneFunction {
    /// Evaluates planes; exactly only where a plane may exceed `enough`.
    fn measure(&mut self, planes: &mut [Plane], enough: Threshold);
    /// The faces to start from.
    fn start(&self) -> &'static Hemisphere;
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
    /// The bounds, from the largest first part on the first planes and the largest 1/cos r - 1 of
    /// their triangles.
    fn bend(&self, largest: f64, sag: f64) -> Bend;
    /// Lowers the bounds of the faces by quadratic forms of their corners.
    fn bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &BestPlane);
    /// The maxima of pieces within this part of the best value are refined: they may lead to a
    /// better plane.
    fn lead(&self) -> f64;
    /// Relative difference below which planes tie and the second part decides, since complementary
    /// planes have the same shear; 0 for criteria without a tie.
    fn tie(&self) -> f64;
    /// The piece of instants.
    fn piece(&self, instants: [usize; 6]) -> Deciding;
    /// The piece of the instants that decide on the plane of a unit normal, to rounding.
    fn deciding(&mut self, n: [f64; 3]) -> Deciding;

    /// A value that is not small.
    fn yardstick(&self, bend: &Bend) -> f64;
    /// Upper bound of the criterion over all planes, independent of the search.
    fn ceiling(&self, bend: &Bend) -> f64;

    /// The record of the best plane, with the tolerance of its value.
    fn known(&mut self, n: [f64; 3], value: f64, tolerance: f64) -> BestPlane {
        let parts = self.parts(n);
        BestPlane {
            n,
            parts,
            tangent: self.tangent(parts),
            values: [value, value + self.tie() * value.abs(), value + tolerance],
        }
    }

    /// The criterion on the plane of a unit normal, to rounding.
    fn at(&mut self, n: [f64; 3]) -> f64 {
        let parts = self.parts(n);
        self.value(parts)
    }
}

impl Plane {
    /// A plane that is not evaluated yet.
    pub(crate) fn of(n: [f64; 3], instants: [usize; 6]) -> Self {
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

impl Bend {
    /// The bound K of the tangent's sum.
    pub(crate) fn of(&self, tangent: &Tangent) -> f64 {
        tangent.first * self.parts[0] + tangent.second * self.parts[1]
    }
}
