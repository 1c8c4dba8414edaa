//! The criteria on invariants: the smallest sphere round the path of the deviatoric stress.

use stress_tensor::{StressTensor, hydrostatic, tresca};

use crate::ball::{Ball, Search as Balls};
use crate::lanes::{LANES, Lanes};
use crate::path::{Path, max_abs, power_of_two};
use crate::point_result::PointResult;

/// sqrt 3.
const ROOT3: f64 = 1.732_050_807_568_877_2;

/// The deviatoric stress as five coordinates whose sum of squares is J2.
pub(crate) fn deviatoric([xx, yy, zz, xy, xz, yz]: StressTensor) -> [f64; 5] {
    [
        (xx - yy) / 2.0,
        (2.0 * zz - xx - yy) / (2.0 * ROOT3),
        xy,
        xz,
        yz,
    ]
}

/// The deviatoric tensor of five coordinates.
pub(crate) fn from_deviatoric([a, b, xy, xz, yz]: [f64; 5]) -> StressTensor {
    let b = b / ROOT3;
    [a - b, -a - b, 2.0 * b, xy, xz, yz]
}

/// The smallest sphere round the path of the deviatoric stress; its radius is sqrt(J2,a), in the
/// unit of the path.
pub(crate) fn deviatoric_sphere(path: &Path, balls: &mut Balls<5>) -> Ball<5> {
    let block = |block: &[Lanes; 6]| {
        let mut coordinates = [[0.0; LANES]; 5];
        for l in 0..LANES {
            let coordinates_of_instant = deviatoric(block.map(|lanes| lanes[l]));
            for d in 0..5 {
                coordinates[d][l] = coordinates_of_instant[d];
            }
        }
        coordinates
    };
    balls.ball(&path.blocks.iter().map(block).collect())
}

/// Value of a criterion on invariants, with its shear and hydrostatic stress.
#[derive(Clone, Copy)]
pub(crate) struct OfInvariants {
    value: f64,
    shear: f64,
    pressure: f64,
}

impl OfInvariants {
    /// The result in Pa, stresses being given in a unit \[Pa\].
    pub(crate) fn to_result(self, unit: f64) -> PointResult {
        PointResult {
            value: unit * self.value,
            missed: 0.0,
            planes: 0,
            normal: [f64::NAN; 3],
            shear_amplitude: unit * self.shear,
            shear_chord: f64::NAN,
            normal_max: unit * self.pressure,
            normal_min: f64::NAN,
        }
    }
}

/// Crossland's criterion, sqrt(J2,a) + alpha p_h,max, from the smallest sphere around the stress deviator.
pub(crate) fn crossland(path: &Path, sphere: &Ball<5>, alpha: f64) -> OfInvariants {
    let pressures = path.instants().map(|s| hydrostatic(&s));
    let pressure = pressures.fold(f64::NEG_INFINITY, f64::max);
    OfInvariants {
        value: sphere.radius + alpha * pressure,
        shear: sphere.radius,
        pressure,
    }
}

/// Dang Van's criterion, the largest tau(t) + alpha p_h(t) over the instants.
pub(crate) fn dang_van(path: &Path, sphere: &Ball<5>, alpha: f64) -> OfInvariants {
    let instants = tau_and_pressure(path, sphere).map(|(shear, pressure)| OfInvariants {
        value: shear + alpha * pressure,
        shear,
        pressure,
    });
    let no_stress = OfInvariants {
        value: f64::NEG_INFINITY,
        shear: 0.0,
        pressure: 0.0,
    };
    instants.fold(
        no_stress,
        |worst, now| if now.value > worst.value { now } else { worst },
    )
}

/// Mesoscopic shear tau and hydrostatic stress at every instant.
fn tau_and_pressure(path: &Path, sphere: &Ball<5>) -> impl Iterator<Item = (f64, f64)> {
    let centre = from_deviatoric(sphere.centre);
    path.instants().map(move |s| {
        let deviation: StressTensor = std::array::from_fn(|c| s[c] - centre[c]);
        (tresca(&deviation) / 2.0, hydrostatic(&s))
    })
}

/// Path of one point in the plane of Dang Van: mesoscopic shear tau and hydrostatic stress \[Pa\]
/// at every instant of its stress.
pub fn dang_van_path(stress: &[StressTensor]) -> Vec<(f64, f64)> {
    if stress.is_empty() {
        return Vec::new();
    }
    let mut path = Path::new();
    path.load(stress, power_of_two(max_abs(stress.as_flattened())));
    let sphere = deviatoric_sphere(&path, &mut Balls::default());
    let in_pascal = |(tau, p): (f64, f64)| (path.unit() * tau, path.unit() * p);
    let mut path_points: Vec<_> = tau_and_pressure(&path, &sphere).map(in_pascal).collect();
    path_points.truncate(stress.len());
    path_points
}
