//! The smallest ball against its definition.

use fatigue::smallest_ball;

use super::splitmix::Draw;

/// The optimum of a convex problem: all points inside, and the centre within the hull of those on
/// the border, told by no direction along which all of these come nearer.
fn check<const D: usize>(points: &[[f64; D]]) {
    let ball = smallest_ball(points);
    let from = |p: &[f64; D]| -> [f64; D] { std::array::from_fn(|d| p[d] - ball.centre[d]) };
    let length = |v: &[f64; D]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let size = points.iter().map(length).fold(0.0, f64::max);
    let border: Vec<_> = points
        .iter()
        .map(from)
        .filter(|v| length(v) > ball.radius - 1e-9 * size)
        .collect();
    for p in points {
        assert!(
            length(&from(p)) <= ball.radius * (1.0 + 1e-12),
            "{points:?}"
        );
    }
    // Frank-Wolfe on the hull of the border: its point nearest to the centre.
    let mut nearest = border[0];
    for step in 1..20_000 {
        let along = |v: &[f64; D]| -> f64 { v.iter().zip(&nearest).map(|(a, b)| a * b).sum() };
        let least = border
            .iter()
            .min_by(|a, b| along(a).total_cmp(&along(b)))
            .unwrap();
        let share = 2.0 / f64::from(step + 2);
        nearest = std::array::from_fn(|d| nearest[d] + share * (least[d] - nearest[d]));
    }
    assert!(
        length(&nearest) < 2e-2 * ball.radius.max(1e-300),
        "{nearest:?} {ball:?}"
    );
}

#[test]
fn random_points() {
    let mut draw = Draw(7);
    for n in [1, 2, 3, 5, 8, 20, 64] {
        for _ in 0..10 {
            let mut points = || -> Vec<[f64; 5]> {
                (0..n)
                    .map(|_| std::array::from_fn(|_| draw.next() - 0.5))
                    .collect()
            };
            check(&points());
            let flat: Vec<[f64; 2]> = points().iter().map(|p| [p[0], p[1]]).collect();
            check(&flat);
        }
    }
}

#[test]
fn degenerate_points() {
    check(&[[1.0, 2.0]; 9]);
    let line: Vec<[f64; 5]> = (0..40)
        .map(|i| [1.0, 2.0, -0.3, 0.1, 0.7].map(|v| v * f64::from(i)))
        .collect();
    check(&line);
    assert!((smallest_ball(&line).radius / (39.0 * 5.59_f64.sqrt() / 2.0) - 1.0).abs() < 1e-14);
    let circle: Vec<[f64; 5]> = (0..64)
        .map(|i| {
            let (sin, cos) = (f64::from(i) * 0.1).sin_cos();
            [3.0 + cos, 4.0 + sin, 1.0, 1.0, cos + sin]
        })
        .collect();
    check(&circle);
    let cube: Vec<[f64; 5]> = (0..32)
        .map(|i| std::array::from_fn(|d| f64::from(i >> d & 1)))
        .collect();
    assert!((smallest_ball(&cube).radius - 5.0_f64.sqrt() / 2.0).abs() < 1e-14);
}
