//! The value of a criterion at a point, with its plane.

/// The value of a criterion at a point, with its plane.
///
/// For Crossland's and Dang Van's, which have no plane, the normal and `normal_min` are NaN;
/// `shear_amplitude` is then sqrt(J2,a), or tau at the instant that decides, and `normal_max` the
/// hydrostatic stress that goes with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointResult {
    /// Value of the criterion, in its unit; 0 where there is no stress.
    pub value: f64,
    /// The criterion is at most value + missed on any plane, in the unit of the value; 0 without a
    /// plane.
    pub missed: f64,
    /// Number of planes evaluated, the cost of the search; 0 without a plane.
    pub planes: usize,
    /// Unit normal of the critical plane, z >= 0; NaN where there is no stress.
    pub normal: [f64; 3],
    /// Shear amplitude there, by the smallest circle \[Pa\].
    pub shear_amplitude: f64,
    /// Half of the longest chord of the shear path there \[Pa\]: at most the amplitude, and at
    /// least sqrt(3)/2 of it.
    pub shear_chord: f64,
    /// Largest normal stress there \[Pa\].
    pub normal_max: f64,
    /// Smallest normal stress there \[Pa\].
    pub normal_min: f64,
}

impl PointResult {
    /// Result for a point without stress.
    pub(crate) const NOTHING: Self = Self {
        value: 0.0,
        missed: 0.0,
        planes: 0,
        normal: [f64::NAN; 3],
        shear_amplitude: 0.0,
        shear_chord: 0.0,
        normal_max: 0.0,
        normal_min: 0.0,
    };
}
