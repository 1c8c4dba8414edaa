//! Stresses on a plane over the instants of a path.

use crate::circle::half_chord;
use crate::on_planes::ShearBuffers;
use crate::path::{Frame, Path};

/// Shear amplitude and normal stresses on the plane of a unit normal \[Pa\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlaneStresses {
    pub(crate) shear_amplitude: f64,
    pub(crate) shear_chord: f64,
    pub(crate) normal_max: f64,
    pub(crate) normal_min: f64,
}

impl PlaneStresses {
    /// Amplitude and chord of the shear, and extremes of the normal stress, on the plane of a unit normal
    /// \[Pa\].
    pub(crate) fn new(path: &Path, n: [f64; 3], buffers: &mut ShearBuffers) -> Self {
        path.resolve_on_plane(path, &Frame::from_normal(n), &mut buffers.shear);
        let (normal, unit) = (path.normal(n), path.unit());
        let circle = buffers.circles.smallest_circle(&buffers.shear);
        Self {
            shear_amplitude: unit * circle.radius,
            shear_chord: unit * half_chord(&buffers.shear, &circle),
            normal_max: unit * normal.max,
            normal_min: unit * normal.min,
        }
    }
}
