//! Criteria of strain where plastic strain changes within the cycle.

use std::sync::atomic::AtomicBool;

use fatigue::{CoffinManson, Criterion, Error, History, PointResult, Search, evaluate};
use ndarray::Array3;
use plasticity::{Plastic, Point};

use super::brute_force::{dot, normals, radius, traction};
use super::closed_forms::same;
use super::splitmix::Draw;
use super::{STEEL, Tensor, all, criterion, one, random, smooth};

fn array(of: &[Tensor]) -> Array3<f64> {
    Array3::from_shape_fn((of.len(), 1, 6), |(t, _, c)| of[t][c])
}

fn tried(
    criterion: &Criterion,
    stress: &[Tensor],
    plastic: &[Tensor],
) -> Result<PointResult, Error> {
    let (stress, plastic) = (array(stress), array(plastic));
    let history = History {
        stress: stress.view(),
        plastic: Some(plastic.view()),
    };
    let never = AtomicBool::new(false);
    evaluate(criterion, &history, &Search::default(), &never).map(|found| found[0])
}

fn with(criterion: &Criterion, stress: &[Tensor], plastic: &[Tensor]) -> PointResult {
    tried(criterion, stress, plastic).unwrap()
}

/// Yield stress, linear kinematic hardening \[Pa\].
const LAW: (f64, f64) = (300e6, 20e9);

fn shear_modulus() -> f64 {
    STEEL.0 / (2.0 * (1.0 + STEEL.1))
}

/// The stabilised cycle of a point under a strain of this direction and amplitudes up to `most`, both
/// deviatoric: the deviator of the stress and the plastic strain.
fn loop_of(direction: Tensor, most: f64) -> (Vec<Tensor>, Vec<Tensor>) {
    let law = Plastic {
        kinematic: LAW.1,
        ..Plastic::perfect(LAW.0)
    };
    let mu = shear_modulus();
    let (mut point, mut stress, mut plastic) = (Point::default(), Vec::new(), Vec::new());
    for cycle in 0..2 {
        for t in 0..=40 {
            let share = if t <= 20 { t } else { 40 - t };
            let level = most * (f64::from(share) / 10.0 - 1.0);
            let trial = |held: &Tensor| -> Tensor {
                std::array::from_fn(|c| 2.0 * mu * (level * direction[c] - held[c]))
            };
            // All directions are the same line, whatever the stress at the start.
            let returned = point.advance(&law, mu, &[0.0; 6], &trial(&point.strain));
            point = returned.into();
            if cycle == 1 {
                stress.push(trial(&point.strain));
                plastic.push(point.strain);
            }
        }
    }
    (stress, plastic)
}

/// Linear kinematic hardening C in a stress amplitude s_a: s_a = s_y + C e_pa, e_a = s_a/E + e_pa. On the
/// plane at t, gamma_a = ((1 + nu) s_a/E + 3/2 e_pa) sin 2t and s_n,max = s_a cos^2 t.
#[test]
fn uniaxial_cycles_of_a_point_that_yields() {
    let ((E, nu), (s_y, C)) = (STEEL, LAW);
    // The deviator of a uniaxial stress s is s (2/3, -1/3, -1/3); a pressure s/3 completes it.
    let most = 4e-3;
    let (deviator, plastic) = loop_of([1.0, -0.5, -0.5, 0.0, 0.0, 0.0], most);
    let complete = |s: &Tensor| [s[0] - s[1], 0.0, s[2] - s[1], 0.0, 0.0, 0.0];
    let stress: Vec<Tensor> = deviator.iter().map(complete).collect();
    // s_xx = 3/2 of its deviator = 3 mu (most - e_pa) = s_y + C e_pa.
    let mu = shear_modulus();
    let e_pa = (3.0 * mu * most - s_y) / (3.0 * mu + C);
    let s_a = s_y + C * e_pa;
    assert!(e_pa > 1e-3 && s_a > 1.05 * s_y);

    let swt = criterion("smith_watson_topper", &[("E", E), ("nu", nu)]);
    let found = with(&swt, &stress, &plastic);
    same(found.value / (s_a * (s_a / E + e_pa)), 1.0, 1e-10);
    same(found.normal[0].abs(), 1.0, 1e-9);
    same(found.normal_max / s_a, 1.0, 1e-10);
    // The elastic strain alone leaves out more than half.
    assert!(one(&swt, &stress).value < 0.5 * found.value);

    let (k, limit) = (1.0, 500e6);
    let gamma_a = (1.0 + nu) * s_a / E + 1.5 * e_pa;
    let of = |t: f64| gamma_a * (2.0 * t).sin() * (1.0 + k * s_a * t.cos().powi(2) / limit);
    let exact = (0..200_000)
        .map(|i| of(f64::from(i) * 1e-5))
        .fold(0.0, f64::max);
    let numbers = [("E", E), ("nu", nu), ("k", k), ("s_y", limit)];
    let found = with(&criterion("fatemi_socie", &numbers), &stress, &plastic);
    same(found.value / exact, 1.0, 1e-9);

    // At 45 degrees the normal strain is (1 - nu)/2 of the elastic and 1/4 of the plastic strain each way.
    let S = 0.85;
    let range = (1.0 - nu) * s_a / E + e_pa / 2.0;
    let found = with(
        &criterion("brown_miller", &[("E", E), ("nu", nu), ("S", S)]),
        &stress,
        &plastic,
    );
    same(found.value / (gamma_a + S * range), 1.0, 1e-6);
}

/// In simple shear t_a = (s_y + C e)/sqrt 3 with the equivalent strain e = gamma_pa/sqrt 3. On the planes of
/// the shear gamma_a = t_a/G + gamma_pa; principal are t_a and gamma_a/2 at 45 degrees.
#[test]
fn shear_cycles_of_a_point_that_yields() {
    let ((E, nu), (s_y, C)) = (STEEL, LAW);
    let (most, mu) = (6e-3, shear_modulus());
    let (stress, plastic) = loop_of([0.0, 0.0, 0.0, 1.0, 0.0, 0.0], most);
    // t_a = 2 mu most - mu gamma_pa = s_y/sqrt 3 + C gamma_pa/3.
    let gamma_pa = (2.0 * mu * most - s_y / 3f64.sqrt()) / (mu + C / 3.0);
    let t_a = s_y / 3f64.sqrt() + C * gamma_pa / 3.0;
    let gamma_a = t_a / mu + gamma_pa;
    same(gamma_a, 2.0 * most, 1e-15);

    let found = with(
        &criterion("smith_watson_topper", &[("E", E), ("nu", nu)]),
        &stress,
        &plastic,
    );
    same(found.value / (t_a * gamma_a / 2.0), 1.0, 1e-10);
    let (k, limit) = (1.0, 500e6);
    // s_n,max = t_a sin 2t on the plane at t from that of the shear, gamma_a cos 2t there.
    let of = |t: f64| gamma_a * (2.0 * t).cos() * (1.0 + k * t_a * (2.0 * t).sin() / limit);
    let exact = (0..100_000)
        .map(|i| of(f64::from(i) * 1e-5))
        .fold(0.0, f64::max);
    let numbers = [("E", E), ("nu", nu), ("k", k), ("s_y", limit)];
    let found = with(&criterion("fatemi_socie", &numbers), &stress, &plastic);
    same(found.value / exact, 1.0, 1e-9);
    // A criterion of stress takes the stress.
    let findley = criterion("findley", &[("k", 0.3)]);
    assert_eq!(with(&findley, &stress, &plastic), one(&findley, &stress));
}

/// The strain-life test itself: the life of a uniaxial cycle is that of its amplitude on the curve.
#[test]
fn the_life_of_a_strain_life_test_is_that_of_its_curve() {
    let (E, nu) = STEEL;
    let N = 2e3;
    let curve = CoffinManson {
        E,
        elastic: fatigue::Basquin {
            coefficient: 1006e6,
            exponent: -0.0809,
        },
        ductility: 1.104,
        exponent: -0.6207,
    };
    let s_a = curve.elastic.amplitude(N);
    let e_pa = curve.amplitude(N) - s_a / E;
    assert!(e_pa > s_a / E);
    let ends = |a: f64, across: f64| {
        let end: Tensor = [a, across, across, 0.0, 0.0, 0.0];
        [end, end.map(|v| -v)]
    };
    let (stress, plastic) = (ends(s_a, 0.0), ends(e_pa, -e_pa / 2.0));
    for (name, more, tolerance) in [
        ("smith_watson_topper", [None, None], 1e-6),
        // On the plane of the largest shear; where the value is largest it is 1 % above.
        (
            "fatemi_socie",
            [Some(("k", 0.3)), Some(("s_y", 500e6))],
            0.05,
        ),
        ("brown_miller", [Some(("S", 0.85)), None], 1e-5),
    ] {
        let mut numbers = vec![("E", E), ("nu", nu)];
        numbers.extend(more.into_iter().flatten());
        let of = fatigue::Assessment {
            criterion: criterion(name, &numbers),
            judge: fatigue::Judge::Life(curve),
        };
        let life = of.life(with(&of.criterion, &stress, &plastic).value);
        same(life / N, 1.0, tolerance);
        let elastic = of.life(one(&of.criterion, &stress).value);
        assert!(elastic > 3.0 * N, "{name}: {elastic}");
    }
}

/// Strain by Hooke's law and the plastic strain beside it, not by S*.
fn total(E: f64, nu: f64, stress: &[Tensor], plastic: &[Tensor]) -> Vec<Tensor> {
    let of = |(s, e): (&Tensor, &Tensor)| -> Tensor {
        let trace = s[0] + s[1] + s[2];
        let hooke = |c: usize| (1.0 + nu) * s[c] - if c < 3 { nu * trace } else { 0.0 };
        std::array::from_fn(|c| hooke(c) / E + e[c])
    };
    stress.iter().zip(plastic).map(of).collect()
}

fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(f64::NEG_INFINITY, f64::max)
}

/// A criterion on a plane from stress and strain: what the search makes as large as it can.
fn on_plane(criterion: &Criterion, stress: &[Tensor], strain: &[Tensor], n: [f64; 3]) -> f64 {
    let normal = |s: &Tensor| dot(traction(s, n), n);
    let s_n = largest(stress.iter().map(normal));
    let shear: Vec<[f64; 3]> = strain
        .iter()
        .map(|e| {
            let (t, along) = (traction(e, n), normal(e));
            std::array::from_fn(|d| 2.0 * (t[d] - along * n[d]))
        })
        .collect();
    match criterion.name() {
        "smith_watson_topper" => {
            let range =
                largest(strain.iter().map(normal)) + largest(strain.iter().map(|e| -normal(e)));
            s_n.max(0.0) * range / 2.0
        }
        "fatemi_socie" => {
            let of = |name: &str| criterion.number(name).unwrap();
            radius(&shear) * (1.0 + of("k") * s_n / of("s_y")).max(0.0)
        }
        _ => radius(&shear),
    }
}

/// Plastic strains that keep the volume, their stress 2 G e of the size of 4e8 Pa.
fn plastic_of(draw: &mut Draw, instants: usize) -> Vec<Tensor> {
    let strains = smooth(draw, instants);
    let of = |s: &Tensor| {
        let mean = (s[0] + s[1] + s[2]) / 3.0;
        let by = 1.0 / (2.0 * shear_modulus());
        std::array::from_fn(|c| by * (s[c] - if c < 3 { mean } else { 0.0 }))
    };
    strains.iter().map(of).collect()
}

#[test]
fn twenty_thousand_planes_hold_no_more_where_strain_is_apart_from_stress() {
    let (E, nu) = STEEL;
    let mut draw = Draw(61);
    let tolerance = Search::default().tolerance;
    for instants in [6, 9, 12, 20] {
        let stress = random(&mut draw, instants);
        let plastic = plastic_of(&mut draw, instants);
        let strain = total(E, nu, &stress, &plastic);
        for of in all().into_iter().filter(Criterion::takes_strain) {
            let (found, name) = (with(&of, &stress, &plastic), of.name());
            let ours = on_plane(&of, &stress, &strain, found.normal);
            let brute = normals(20_000).map(|n| on_plane(&of, &stress, &strain, n));
            let brute = largest(brute);
            assert!(ours >= brute - 1e-7 * brute, "{name}: {ours} {brute}");
            assert!(
                ours - brute < 20.0 * tolerance * ours,
                "{name}: {ours} {brute}"
            );
            assert!(found.missed <= tolerance * found.value * 1.0001, "{name}");
            if name != "brown_miller" {
                assert!((found.value / ours - 1.0).abs() < 1e-9, "{name}");
            }
        }
    }
}

/// A constant strain has no range.
#[test]
fn a_constant_plastic_strain_changes_no_bit() {
    let mut draw = Draw(7);
    let stress = random(&mut draw, 9);
    let constant = plastic_of(&mut draw, 1)[0];
    for of in all() {
        let found = with(&of, &stress, &[constant; 9]);
        assert_eq!(format!("{found:?}"), format!("{:?}", one(&of, &stress)));
    }
}

#[test]
fn strains_that_are_none_are_refused_by_name() {
    let (E, nu) = STEEL;
    let of = criterion("smith_watson_topper", &[("E", E), ("nu", nu)]);
    let stress = random(&mut Draw(3), 3);
    let refused = |plastic: &[Tensor]| tried(&of, &stress, plastic).unwrap_err().to_string();
    let short = refused(&[[0.0; 6]; 2]);
    assert!(
        short.contains("of the shape of the stress, (3, 1, 6)"),
        "{short}"
    );
    let grows = refused(&[[1e-3, 0.0, 0.0, 0.0, 0.0, 0.0]; 3]);
    assert!(grows.contains("keeps the volume"), "{grows}");
    let infinite = refused(&[[f64::NAN; 6]; 3]);
    assert!(infinite.contains("a finite strain"), "{infinite}");
}
