//! Numbers of the literature and of hand calculation.

use fatigue::Criterion;

use super::{STEEL, Tensor, criterion, one};

const MPA: f64 = 1e6;

fn between(a: Tensor, b: Tensor) -> [Tensor; 2] {
    [a.map(|s| s * MPA), b.map(|s| s * MPA)]
}

fn axial(max: f64, min: f64) -> [Tensor; 2] {
    between(
        [max, 0.0, 0.0, 0.0, 0.0, 0.0],
        [min, 0.0, 0.0, 0.0, 0.0, 0.0],
    )
}

fn torsion(tau: f64) -> [Tensor; 2] {
    between(
        [0.0, 0.0, 0.0, tau, 0.0, 0.0],
        [0.0, 0.0, 0.0, -tau, 0.0, 0.0],
    )
}

fn value(criterion: &Criterion, history: &[Tensor]) -> f64 {
    one(criterion, history).value / MPA
}

#[track_caller]
pub(crate) fn same(ours: f64, exact: f64, digits: f64) {
    assert!((ours - exact).abs() < digits, "{ours}, not {exact}");
}

#[test]
fn crossland_in_bending_and_torsion_in_phase() {
    let (t_0, d_0) = (352.0, 540.97);
    let alpha = (t_0 - d_0 / 3.0_f64.sqrt()) / (d_0 / 3.0);
    let history = between(
        [411.0, 0.0, 0.0, 205.0, 0.0, 0.0],
        [-411.0, 0.0, 0.0, -205.0, 0.0, 0.0],
    );
    let found = one(&criterion("crossland", &[("alpha", alpha)]), &history);
    same(found.normal_max / MPA, 137.0, 1e-9);
    same(found.shear_amplitude / MPA, 313.579, 5e-4);
    same(found.value / MPA - t_0, -8.281, 5e-4);
}

#[test]
fn matake_and_dang_van_in_biaxial_stress() {
    let history = between(
        [100.0, -200.0, 0.0, 0.0, 0.0, 0.0],
        [-100.0, 200.0, 0.0, 0.0, 0.0, 0.0],
    );
    let found = one(&criterion("matake", &[("k", 1.0)]), &history);
    same(found.shear_amplitude / MPA, 150.0, 1e-4);
    same(found.normal_max / MPA, 50.0, 1e-4);
    same(1.5 * found.value / MPA, 300.0, 1e-4);
    same(
        1.5 * value(&criterion("dang_van", &[("alpha", 1.0)]), &history),
        275.0,
        1e-9,
    );
}

#[test]
fn findley() {
    let criterion = criterion("findley", &[("k", 0.3)]);
    same(value(&criterion, &axial(100.0, -100.0)), 67.2015, 5e-5);
    same(value(&criterion, &axial(200.0, 0.0)), 88.3095, 5e-5);
    same(value(&criterion, &torsion(100.0)), 104.4031, 5e-5);
    let exact = |k: f64, s: f64| s / 2.0 * (k + k.hypot(1.0));
    same(
        value(&criterion, &axial(100.0, -100.0)),
        exact(0.3, 100.0),
        1e-10,
    );
}

#[test]
fn smith_watson_topper() {
    let (E, nu) = STEEL;
    let criterion = criterion("smith_watson_topper", &[("E", E), ("nu", nu)]);
    let per_modulus = MPA * MPA / E;
    let axial = one(&criterion, &axial(300.0, -300.0));
    same(axial.value / (300.0 * 300.0 * per_modulus), 1.0, 1e-12);
    same(axial.normal[0].abs(), 1.0, 1e-9);
    let torsion = one(&criterion, &torsion(200.0));
    same(
        torsion.value / (200.0 * 200.0 * per_modulus),
        1.0 + nu,
        1e-12,
    );
    // Compression opens no crack.
    let pressed = one(&criterion, &super::closed_forms::axial(-100.0, -300.0));
    same(pressed.value, 0.0, 1e-20);
}

/// Uniaxial stress turns the plane by t: tau = (s/2) sin 2t, s_n = s cos^2 t, and Hooke's law gives
/// the strains.
#[test]
fn shear_strain_criteria_in_uniaxial_stress() {
    let (E, nu) = STEEL;
    let (s, s_y, k) = (300.0 * MPA, 500.0 * MPA, 1.0);
    let history = axial(300.0, -300.0);
    let G = E / (2.0 * (1.0 + nu));
    let fatemi_socie =
        |t: f64| s / 2.0 * (2.0 * t).sin() / G * (1.0 + k * s * t.cos().powi(2) / s_y);
    let exact = (0..200_000)
        .map(|i| fatemi_socie(f64::from(i) * 1e-5))
        .fold(0.0, f64::max);
    let found = one(
        &criterion(
            "fatemi_socie",
            &[("E", E), ("nu", nu), ("k", k), ("s_y", s_y)],
        ),
        &history,
    );
    same(found.value / exact, 1.0, 1e-9);
    // At 45 degrees gamma_a = (1 + nu) s/E, and the normal strain is (1 - nu) s/(2 E) each way.
    let S = 0.85;
    let found = one(
        &criterion("brown_miller", &[("E", E), ("nu", nu), ("S", S)]),
        &history,
    );
    same(
        found.value / (s / E * (1.0 + nu + S * (1.0 - nu))),
        1.0,
        1e-6,
    );
    let found = one(&criterion("mcdiarmid", &[("k", 0.3)]), &history);
    same(found.value / (s / 2.0 * 1.3), 1.0, 1e-6);
}

/// A shear path that is a circle: the radius is the amplitude, and so is half of its diameter.
#[test]
fn out_of_phase_torsion_turns_on_a_circle() {
    let history: Vec<Tensor> = (0..64)
        .map(|t| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(t) / 64.0).sin_cos();
            [0.0, 0.0, 0.0, 0.0, 100.0 * MPA * cos, 100.0 * MPA * sin]
        })
        .collect();
    let found = one(&criterion("findley", &[("k", 0.0)]), &history);
    same(found.value / MPA, 100.0, 1e-10);
    // Three instants at the corners of a triangle: the chord is sqrt(3)/2 of the amplitude.
    let corners: Vec<Tensor> = (0..3)
        .map(|t| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(t) / 3.0).sin_cos();
            [0.0, 0.0, 0.0, 0.0, 100.0 * MPA * cos, 100.0 * MPA * sin]
        })
        .collect();
    let found = one(&criterion("findley", &[("k", 0.0)]), &corners);
    same(found.shear_amplitude / MPA, 100.0, 1e-10);
    same(found.shear_chord / MPA, 50.0 * 3.0_f64.sqrt(), 1e-10);
}
