//! The criteria on invariants: the smallest sphere round the path of the deviatoric stress.

use super::at_point::AtPoint;
use super::ball::{Ball, Search as Balls};
use super::criterion::Criterion;
use super::lanes::{LANES, Lanes};
use super::path::Path;
use crate::fields::{StressTensor, hydrostatic, tresca};

/// sqrt 3.
const ROOT3: f64 = 1.732_050_807_568_877_2;

/// The deviatoric stress as five coordinates whose sum of squares is J2.
pub(super) fn deviatoric([xx, yy, zz, xy, xz, yz]: StressTensor) -> [f64; 5] {
    [
        (xx - yy) / 2.0,
        (2.0 * zz - xx - yy) / (2.0 * ROOT3),
        xy,
        xz,
        yz,
    ]
}

/// The deviatoric stress of five coordinates.
pub(super) fn tensor([a, b, xy, xz, yz]: [f64; 5]) -> StressTensor {
    let b = b / ROOT3;
    [a - b, -a - b, 2.0 * b, xy, xz, yz]
}

/// The smallest sphere round the path of the deviatoric stress; its radius is sqrt(J2,a) \[Pa\].
pub(super) fn sphere(path: &Path, balls: &mut Balls<5>) -> Ball<5> {
    let block = |block: &[Lanes; 6]| {
        let mut coordinates = [[0.0; LANES]; 5];
        for l in 0..LANES {
            let at = deviatoric(block.map(|lanes| lanes[l]));
            for d in 0..5 {
                coordinates[d][l] = at[d];
            }
        }
        coordinates
    };
    balls.ball(&path.blocks.iter().map(block).collect())
}

/// Crossland's or Dang Van's criterion.
pub(super) fn at_point(criterion: &Criterion, path: &Path, balls: &mut Balls<5>) -> AtPoint {
    let sphere = sphere(path, balls);
    let (value, shear, pressure) = match *criterion {
        Criterion::DangVan { alpha } => dang_van(path, &sphere, alpha),
        Criterion::Crossland { alpha } => {
            let largest = path.instants().map(|s| hydrostatic(&s));
            let p = largest.fold(f64::NEG_INFINITY, f64::max);
            (sphere.radius + alpha * p, sphere.radius, p)
        }
        _ => unreachable!("the others look for a plane"),
    };
    AtPoint {
        value,
        missed: 0.0,
        planes: 0,
        normal: [f64::NAN; 3],
        shear_amplitude: shear,
        shear_chord: f64::NAN,
        normal_max: pressure,
        normal_min: f64::NAN,
    }
}

/// Value, tau and hydrostatic stress at the instant that decides.
fn dang_van(path: &Path, sphere: &Ball<5>, alpha: f64) -> (f64, f64, f64) {
    let mut worst = (f64::NEG_INFINITY, 0.0, 0.0);
    for (tau, p) in tau_and_pressure(path, sphere) {
        let value = tau + alpha * p;
        if value > worst.0 {
            worst = (value, tau, p);
        }
    }
    worst
}

/// Mesoscopic shear tau and hydrostatic stress at every instant \[Pa\].
fn tau_and_pressure(path: &Path, sphere: &Ball<5>) -> impl Iterator<Item = (f64, f64)> {
    let centre = tensor(sphere.centre);
    path.instants().map(move |s| {
        let from: StressTensor = std::array::from_fn(|c| s[c] - centre[c]);
        (tresca(&from) / 2.0, hydrostatic(&s))
    })
}

/// Path of one point in the plane of Dang Van: mesoscopic shear tau and hydrostatic stress \[Pa\] at
/// every instant of its stress.
pub fn dang_van_path(stress: &[StressTensor]) -> Vec<(f64, f64)> {
    if stress.is_empty() {
        return Vec::new();
    }
    let mut path = Path::new();
    path.load(stress.iter().copied());
    let sphere = sphere(&path, &mut Balls::default());
    let mut found: Vec<_> = tau_and_pressure(&path, &sphere).collect();
    found.truncate(stress.len());
    found
}
