//! K with faces that may pass through each other, against the tables: 1e-5 of the larger component,
//! and within the error that is told.

use std::collections::BTreeMap;

use crate::truth::{Fretting, numbers, shape, tables};
use fracture::{Crack, Path, PlaneStress, Point};

/// A stress whose traction on the crack is (normal, shear).
fn on_faces(point: &Point, normal: f64, shear: f64) -> PlaneStress {
    let (s, c) = point.angle.sin_cos();
    [
        c * c * normal + 2.0 * s * c * shear,
        s * s * normal - 2.0 * s * c * shear,
        -s * c * normal + (c * c - s * s) * shear,
    ]
}

/// Largest error of F over the larger component; asserts that it is within `bound` and the told
/// error.
fn agree(crack: &Crack, stress: &[PlaneStress], truth: &[f64], bound: f64, what: &str) {
    let k = crack.intensity(stress).unwrap();
    let l = crack.length();
    let larger = truth[0].abs().max(truth[1].abs());
    for (found, truth) in [k.K_I, k.K_II].iter().zip(truth) {
        let off = (shape(*found, l) - truth).abs();
        assert!(off <= bound * larger, "{what}: {off:e} of {larger}");
        let told = shape(k.error, l) + 3e-7 * larger;
        assert!(off <= told, "{what}: {off:e}, told {told:e}");
    }
}

#[test]
fn powers_of_the_depth_on_a_normal_crack() {
    let crack = Crack::new(Path::straight(3.0, 2e-3, 0.0)).unwrap();
    for (n, F) in tables()["F_n"].as_object().unwrap() {
        let power = |p: &Point| (p.s / 2e-3).powi(n.parse().unwrap());
        let F = F.as_f64().unwrap();
        let opened: Vec<_> = crack
            .points()
            .iter()
            .map(|p| on_faces(p, power(p), 0.0))
            .collect();
        agree(&crack, &opened, &[F, 0.0], 1e-6, n);
        let sheared: Vec<_> = crack
            .points()
            .iter()
            .map(|p| on_faces(p, 0.0, power(p)))
            .collect();
        agree(&crack, &sheared, &[0.0, F], 1e-6, n);
    }
}

#[test]
fn inclined_cracks_under_uniform_and_linear_tractions() {
    for (angle, rows) in tables()["inclined"].as_object().unwrap() {
        for sign in [1.0, -1.0] {
            let theta = sign * angle.parse::<f64>().unwrap().to_radians();
            let crack = Crack::new(Path::straight(-1.0, 0.7, theta)).unwrap();
            let points = crack.points();
            let load = |f: &dyn Fn(&Point) -> PlaneStress| points.iter().map(f).collect::<Vec<_>>();
            let cases = [
                ("tension", load(&|_| [1.0, 0.0, 0.0])),
                ("pressure", load(&|p| on_faces(p, 1.0, 0.0))),
                ("p1", load(&|p| on_faces(p, p.s / 0.7, 0.0))),
                ("shear", load(&|p| on_faces(p, 0.0, 1.0))),
                ("s2", load(&|p| on_faces(p, 0.0, (p.s / 0.7).powi(2)))),
            ];
            for (name, stress) in cases {
                let mut truth = numbers(&rows[name]);
                let odd = usize::from(!name.starts_with('s'));
                truth[odd] *= sign;
                agree(&crack, &stress, &truth, 1e-6, &format!("{name} at {theta}"));
            }
        }
    }
}

#[test]
fn point_loads_beside_the_mouth() {
    for (key, truth) in tables()["flamant"].as_object().unwrap() {
        let parts: Vec<_> = key.split('|').collect();
        let (d, angle): (f64, f64) = (parts[1].parse().unwrap(), parts[2].parse().unwrap());
        let crack = Crack::new(Path::straight(0.0, 1.0, angle.to_radians())).unwrap();
        let flamant = |p: &Point| {
            let (X, z) = (p.x - d, p.z);
            let along = if parts[0] == "P" { z } else { X };
            let f = -2.0 / std::f64::consts::PI * along / (X * X + z * z).powi(2);
            [f * X * X, f * z * z, f * X * z]
        };
        let stress: Vec<_> = crack.points().iter().map(flamant).collect();
        let root = std::f64::consts::PI.sqrt();
        let truth: Vec<_> = numbers(truth).iter().map(|k| k / root).collect();
        agree(&crack, &stress, &truth, 2e-6, key);
    }
}

#[test]
fn fretting_in_full_and_partial_slip_with_bulk_stress() {
    let mut cracks: BTreeMap<String, Crack> = BTreeMap::new();
    for (key, truth) in tables()["fretting_linear"].as_object().unwrap() {
        let parts: Vec<_> = key.split('|').collect();
        let value = |n: usize| parts[n].parse::<f64>().unwrap();
        let straight = || Crack::new(Path::straight(0.0, 1.0, value(2).to_radians())).unwrap();
        let unit = cracks.entry(parts[2].to_owned()).or_insert_with(straight);
        let crack = unit.similar(value(1), value(3)).unwrap();
        let stress = Fretting::named(parts[0]).along(&crack.points());
        agree(&crack, &stress, &numbers(truth), 1e-5, key);
    }
}

#[test]
fn kinked_cracks() {
    let row = |legs: &[(f64, f64)]| {
        let legs: Vec<_> = legs
            .iter()
            .map(|(l, a)| (*l, f64::to_radians(*a)))
            .collect();
        Crack::new(Path::kinked(-1.0, &legs)).unwrap()
    };
    let tension = |crack: &Crack| vec![[1.0, 0.0, 0.0]; crack.points().len()];
    for (legs, truth) in [
        ([(0.5, 0.0), (0.5, 45.0)], [0.774_471_3, 0.401_074_7]),
        ([(0.5, 30.0), (0.5, -30.0)], [0.919_951_4, -0.305_394_0]),
        ([(0.8, 0.0), (0.2, 70.0)], [0.490_570_5, 0.450_966_1]),
        ([(0.3, 20.0), (0.7, 20.0)], [1.028_574_16, 0.224_307_80]),
    ] {
        let crack = row(&legs);
        agree(&crack, &tension(&crack), &truth, 1e-5, &format!("{legs:?}"));
    }
    let crack = row(&[(0.1, 20.0), (0.4, 0.0)]);
    let load = Fretting {
        pressure: 1.0,
        shear: 0.6,
        stick: (0.5_f64.sqrt(), 0.3 / 2.4),
        bulk: 0.3,
    };
    let stress = load.along(&crack.points());
    agree(
        &crack,
        &stress,
        &[0.290_814_7, 0.110_057_6],
        1e-5,
        "fretting",
    );
}

#[test]
fn a_similar_crack_is_a_new_one() {
    let first = Crack::new(Path::straight(0.0, 1.0, 0.3)).unwrap();
    let similar = first.similar(-1.0, 0.04).unwrap();
    let new = Crack::new(Path::straight(-1.0, 0.04, 0.3)).unwrap();
    let stress = Fretting::named("FS.6+").along(&new.points());
    let (a, b) = (
        similar.intensity(&stress).unwrap(),
        new.intensity(&stress).unwrap(),
    );
    assert!((a.K_I - b.K_I).abs() + (a.K_II - b.K_II).abs() < 1e-12 * b.K_I);
}
