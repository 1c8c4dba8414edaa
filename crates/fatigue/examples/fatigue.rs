//! Time of the criteria on random histories of 64 instants:
//! `cargo run --release --example fatigue -- [points]`.

#![allow(clippy::print_stdout)]

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use fatigue::{Criterion, History, Search, evaluate};
use ndarray::Array3;

/// Points that are held at a time.
const CHUNK: usize = 20_000;
const INSTANTS: usize = 64;

fn main() {
    let points: usize = std::env::args()
        .nth(1)
        .and_then(|n| n.parse().ok())
        .unwrap_or(1_000_000);
    let (E, nu) = (210e9, 0.3);
    let criterion = |name: &str, numbers: &[(&str, f64)]| {
        Criterion::new(name, numbers).expect("numbers in range")
    };
    let criteria = [
        criterion("smith_watson_topper", &[("E", E), ("nu", nu)]),
        criterion("findley", &[("k", 0.3)]),
        criterion(
            "fatemi_socie",
            &[("E", E), ("nu", nu), ("k", 1.0), ("s_y", 5e8)],
        ),
        criterion("matake", &[("k", 0.5)]),
        criterion("brown_miller", &[("E", E), ("nu", nu), ("S", 0.85)]),
        criterion("crossland", &[("alpha", 0.2)]),
        criterion("dang_van", &[("alpha", 0.4)]),
    ];
    let never = AtomicBool::new(false);
    for smooth in [false, true] {
        for criterion in &criteria {
            let (mut seconds, mut sum, mut planes) = (0.0, 0.0, 0);
            for chunk in 0..points.div_ceil(CHUNK) {
                let here = CHUNK.min(points - chunk * CHUNK);
                let stress = histories(here, chunk as u64, smooth);
                let start = Instant::now();
                let found = evaluate(
                    criterion,
                    &History::elastic(&stress.view()),
                    &Search::default(),
                    &never,
                );
                seconds += start.elapsed().as_secs_f64();
                let found = found.expect("random histories are histories");
                sum += found.iter().map(|p| p.value).sum::<f64>();
                planes += found.iter().map(|p| p.planes).sum::<usize>();
            }
            let kind = if smooth { "smooth" } else { "random" };
            let each = 1e6 * seconds / points as f64;
            let mean = sum / points as f64;
            let planes = planes as f64 / points as f64;
            println!(
                "{} {kind}: {points} points {seconds:.2} s, {each:.2} us and {planes:.1} planes \
                 each, mean {mean:.4e}",
                criterion.name()
            );
        }
    }
}

/// Independent stresses at all instants, or cycles of two harmonics \[Pa\].
fn histories(points: usize, seed: u64, smooth: bool) -> Array3<f64> {
    let mut draw = fastrand::Rng::with_seed(seed);
    if !smooth {
        return Array3::from_shape_simple_fn((INSTANTS, points, 6), || 4e8 * (draw.f64() - 0.5));
    }
    let mut stress = Array3::zeros((INSTANTS, points, 6));
    for p in 0..points {
        for c in 0..6 {
            let part: [f64; 5] = std::array::from_fn(|_| 4e8 * (draw.f64() - 0.5));
            for t in 0..INSTANTS {
                let (sin, cos) = (std::f64::consts::TAU * t as f64 / INSTANTS as f64).sin_cos();
                let second = 0.3 * ((cos * cos - sin * sin) * part[2] + 2.0 * sin * cos * part[3]);
                stress[(t, p, c)] = part[0] * cos + part[1] * sin + second + part[4];
            }
        }
    }
    stress
}
