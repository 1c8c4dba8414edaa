//! A criterion as a function of the plane, and what a search keeps of a plane.

use crate::hemisphere::{Face, Hemisphere};
use crate::refine::Deciding;
use crate::tangent::Tangent;

/// No edge.
pub(crate) const NO_EDGE: usize = usize::MAX;

/// A plane that was looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// Unit normal.
    pub(crate) n: [f64; 3],
    /// Two quantities, and the criterion, which rises with both: no less than they are.
    pub(crate) parts: [f64; 2],
    pub(crate) value: f64,
    /// The parts are no less than these.
    pub(crate) low: [f64; 2],
    /// The instants that decide, as in [`Deciding`]; before it is measured a guess.
    pub(crate) instants: [usize; 6],
    /// First of the edges that have this as the end of the smaller number.
    pub(crate) edge: usize,
}

/// A plane on which the first part is at most `first`, or the tangent at most `sum`, need not be known
/// better.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Enough {
    pub(crate) first: f64,
    pub(crate) tangent: Tangent,
    pub(crate) sum: f64,
}

/// The best plane known.
#[derive(Clone, Copy)]
pub(crate) struct Known {
    pub(crate) n: [f64; 3],
    pub(crate) parts: [f64; 2],
    /// At the parts.
    pub(crate) tangent: Tangent,
    /// Its value, the one from which on planes tie with it, and the one that is within the tolerance:
    /// what is not above these need not be known better.
    pub(crate) values: [f64; 3],
}

/// Bounds on second derivatives of the parts along great circles, which are nowhere below -K, and on
/// their slopes, up and down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend {
    pub(crate) parts: [f64; 2],
    pub(crate) slopes: [f64; 2],
    /// No plane has more of the first part.
    pub(crate) first: f64,
}

/// A criterion on planes.
pub(crate) trait PlaneFunction {
    /// Parts and values of planes, of which some need to be no better than `enough`.
    fn measure(&mut self, planes: &mut [Plane], enough: Enough);
    /// The faces to start from.
    fn start(&self) -> &'static Hemisphere;
    /// What rounding may add to the value of a plane as measured.
    fn rounding(&mut self, n: [f64; 3]) -> f64;
    /// Measures in double precision from here on.
    fn to_double(&mut self);
    /// The two quantities on the plane of a unit normal, to rounding.
    fn parts(&mut self, n: [f64; 3]) -> [f64; 2];
    /// The criterion, which rises with both.
    fn value(&self, parts: [f64; 2]) -> f64;
    /// A sum of the parts that bounds the criterion, closely where the parts are these.
    fn tangent(&self, parts: [f64; 2]) -> Tangent;
    /// The bounds, from the largest first part on the first planes and the largest 1/cos r - 1 of
    /// their triangles.
    fn bend(&self, largest: f64, sag: f64) -> Bend;
    /// Lowers what the faces may hold, where forms of their corners prove that.
    fn bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &Known);
    /// Tops of pieces that are lower than the best by less than this part of it are refined: they may
    /// lead to a better one.
    fn lead(&self) -> f64;
    /// Part of the value from which on planes tie and a second quantity chooses, since complementary
    /// planes have the same shear; 0 where none does.
    fn tie(&self) -> f64;
    /// The piece of instants.
    fn piece(&self, instants: [usize; 6]) -> Deciding;
    /// The piece of the instants that decide on the plane of a unit normal, to rounding.
    fn deciding(&mut self, n: [f64; 3]) -> Deciding;

    /// A value that is not small.
    fn yardstick(&self, bend: &Bend) -> f64;
    /// No plane has more, whatever the search finds.
    fn ceiling(&self, bend: &Bend) -> f64;

    /// What is known of the best plane; within `tolerance` of its value others need not be known better.
    fn known(&mut self, n: [f64; 3], value: f64, tolerance: f64) -> Known {
        let parts = self.parts(n);
        Known {
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
    /// Not yet measured.
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
    /// That of a sum of the parts.
    pub(crate) fn of(&self, tangent: &Tangent) -> f64 {
        tangent.first * self.parts[0] + tangent.second * self.parts[1]
    }
}
