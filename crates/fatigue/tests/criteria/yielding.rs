//! First yield and shakedown against Hertz contacts.

use std::sync::atomic::AtomicBool;

use fatigue::{Yield, yielding};
use ndarray::Array3;

use super::Tensor;

const NONE: Tensor = [0.0; 6];

fn factors(points: &[Vec<Tensor>], s_y: f64, constant: &Tensor) -> Vec<Yield> {
    let shape = (points[0].len(), points.len(), 6);
    let stress = Array3::from_shape_fn(shape, |(t, p, c)| points[p][t][c]);
    yielding(&stress.view(), s_y, constant, &AtomicBool::new(false)).unwrap()
}

/// On the axis below a Hertz contact of unit radius and peak pressure.
fn below_a_sphere(z: f64, nu: f64) -> Tensor {
    let inverse = 1.0 / (1.0 + z * z);
    let lateral = -(1.0 + nu) * (1.0 - z * (1.0 / z).atan()) + inverse / 2.0;
    [lateral, lateral, -inverse, 0.0, 0.0, 0.0]
}

/// p_0 = 1.6128 Y at z = 0.4809 a for nu = 0.3: 1.5/(1 + z^2) - (1 + nu)(1 - z atan(1/z)), the
/// difference of the principal stresses on the axis in p_0 (K. L. Johnson, Contact Mechanics
/// (1985), eq. (3.45)), is largest there, 0.62004. Johnson's 1.60 Y at 0.48 a, eq. (4.49), is
/// rounded.
#[test]
fn first_yield_below_a_sphere() {
    let z: Vec<f64> = (1..400).map(|i| 0.005 * f64::from(i)).collect();
    let points: Vec<_> = z
        .iter()
        .map(|z| vec![NONE, below_a_sphere(*z, 0.3)])
        .collect();
    let found = factors(&points, 1.0, &NONE);
    for of in [|f: &Yield| f.von_mises, |f: &Yield| f.tresca] {
        let (k, least) = (0..z.len())
            .map(|k| (k, of(&found[k])))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        assert!((least / 1.6128 - 1.0).abs() < 1e-4, "{least}");
        assert!((least / 1.60 - 1.0).abs() < 1e-2, "{least}");
        assert!((z[k] - 0.4809).abs() < 2.5e-3, "{}", z[k]);
    }
    // A stress that comes and goes shakes down to twice the load of first yield.
    for f in &found {
        assert!((f.shakedown / f.von_mises - 2.0).abs() < 1e-12);
    }
}

/// E. McEwen's stress below a line contact of unit half-width and peak pressure.
fn below_a_cylinder(x: f64, z: f64) -> Tensor {
    let root = ((1.0 - x * x + z * z).powi(2) + 4.0 * x * x * z * z).sqrt();
    let m = f64::midpoint(root + 1.0 - x * x, z * z).sqrt();
    let n = x.signum() * ((root - (1.0 - x * x + z * z)) / 2.0).max(0.0).sqrt();
    let share = (z * z + n * n) / (m * m + n * n);
    let (xx, zz) = (-m * (1.0 + share) + 2.0 * z, -m * (1.0 - share));
    let xz = n * (m * m - z * z) / (m * m + n * n);
    [xx, 0.3 * (xx + zz), zz, 0.0, xz, 0.0]
}

/// K. L. Johnson, Contact Mechanics (1985) section 9.2: rolling cylinders without friction shake
/// down up to p_0 = 4.00 k, k = Y/sqrt 3, which the orthogonal shear of 0.25 p_0 at z = 0.5 a
/// decides.
#[test]
fn shakedown_of_a_rolling_cylinder() {
    let z: Vec<f64> = (4..40).map(|i| 0.025 * f64::from(i)).collect();
    let passes = |z: &f64| -> Vec<Tensor> {
        (-400..=400)
            .map(|i| below_a_cylinder(0.02 * f64::from(i), *z))
            .collect()
    };
    let points: Vec<_> = z.iter().map(passes).collect();
    let found = factors(&points, 3.0_f64.sqrt(), &NONE);
    let (k, least) = (0..z.len())
        .map(|k| (k, found[k].shakedown))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap();
    assert!((least - 4.0).abs() < 0.01, "{least} at {}", z[k]);
    assert!((z[k] - 0.5).abs() < 0.03, "{}", z[k]);
}

/// Uniaxial stress on a uniaxial residual stress: what is left of the yield stress.
#[test]
fn residual_stress_is_not_scaled() {
    let pulled = vec![NONE, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]];
    for (held, exact) in [(0.0, 5.0), (2.0, 3.0), (-2.0, 7.0)] {
        let found = factors(
            std::slice::from_ref(&pulled),
            5.0,
            &[held, 0.0, 0.0, 0.0, 0.0, 0.0],
        )[0];
        assert!((found.von_mises - exact).abs() < 1e-12, "{found:?}");
        assert!((found.tresca - exact).abs() < 1e-12, "{found:?}");
        assert!((found.shakedown - 10.0).abs() < 1e-12, "{found:?}");
    }
    let refused = yielding(
        &Array3::ones((2, 1, 6)).view(),
        1.0,
        &[2.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        &AtomicBool::new(false),
    );
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("within the yield stress")
    );
}
