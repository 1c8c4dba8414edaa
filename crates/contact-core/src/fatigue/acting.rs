//! What acts on a plane.

use super::circle::half_chord;
use super::on_planes::ShearRoom;
use super::path::{Frame, Path};

/// What acts on the plane of a unit normal, for people.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Acting {
    pub(super) shear_amplitude: f64,
    pub(super) shear_chord: f64,
    pub(super) normal_max: f64,
    pub(super) normal_min: f64,
}

impl Acting {
    pub(super) fn on(path: &Path, n: [f64; 3], room: &mut ShearRoom) -> Self {
        path.resolve(&Frame::across(n), &mut room.shear);
        let normal = path.normal(n);
        Self {
            shear_amplitude: room.circles.round(&room.shear).radius,
            shear_chord: half_chord(&room.shear),
            normal_max: normal.max,
            normal_min: normal.min,
        }
    }
}
