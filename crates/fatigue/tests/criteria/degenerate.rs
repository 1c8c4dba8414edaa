//! Histories on which a search for a plane has nothing to go by: every criterion ends at once or
//! within its planes, and what it may have missed is told.

use fatigue::{Criterion, PointResult, Search};

use super::brute_force::{normals, on_plane, sought};
use super::splitmix::Draw;
use super::{Tensor, all, criterion, many, one, random, smooth};

const NONE: Tensor = [0.0; 6];

fn hydrostatic(p: f64) -> Tensor {
    [p, p, p, 0.0, 0.0, 0.0]
}

fn axial(s: f64) -> Tensor {
    [s, 0.0, 0.0, 0.0, 0.0, 0.0]
}

/// Stress in other axes, which the seed draws.
fn turned(s: &Tensor, draw: &mut Draw) -> Tensor {
    let [a, b, c]: [f64; 3] = std::array::from_fn(|_| std::f64::consts::TAU * draw.next());
    let about = |t: f64, i: usize, j: usize| {
        let mut r = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        (r[i][i], r[j][j], r[i][j], r[j][i]) = (t.cos(), t.cos(), -t.sin(), t.sin());
        r
    };
    let product = |p: [[f64; 3]; 3], q: [[f64; 3]; 3]| -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| p[i][k] * q[k][j]).sum()))
    };
    let r = product(product(about(a, 0, 1), about(b, 1, 2)), about(c, 0, 1));
    let [xx, yy, zz, xy, xz, yz] = *s;
    let whole = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let across = std::array::from_fn(|i| std::array::from_fn(|j| r[j][i]));
    let t = product(product(r, whole), across);
    [t[0][0], t[1][1], t[2][2], t[0][1], t[0][2], t[1][2]]
}

fn ends(of: &Criterion, found: &PointResult, history: &[Tensor]) {
    assert!(
        found.value.is_finite() && found.missed >= 0.0,
        "{of:?} {history:?}: {found:?}"
    );
    assert!(
        found.planes <= Search::default().planes,
        "{of:?} {history:?}: {found:?}"
    );
}

#[test]
fn nothing_in_tension_makes_no_product() {
    let mut draw = Draw(3);
    let swt = criterion("smith_watson_topper", &[("E", 162e9), ("nu", 0.3)]);
    for pressure in [-1e-3, -1e6, -4e8, -1e12] {
        let pulsating = [NONE, turned(&axial(pressure), &mut draw)];
        let pressed = [hydrostatic(pressure), hydrostatic(pressure / 3.0)];
        for history in [&pulsating[..], &[NONE, axial(pressure)], &pressed] {
            let found = one(&swt, history);
            assert_eq!((found.value, found.planes), (0.0, 0), "{history:?}");
            assert!(
                found.missed <= 1e-11 * pressure * pressure / 162e9,
                "{found:?}"
            );
        }
    }
}

/// Pressure all round from 0 to -p and a constant stress: no plane is sheared, and the value is
/// that of the normal stress.
#[test]
fn no_plane_is_sheared() {
    let (E, nu, p) = (210e9, 0.3, 3e8);
    for of in all() {
        let found = one(&of, &[NONE, hydrostatic(-p)]);
        ends(&of, &found, &[]);
        let exact = match of.name() {
            "brown_miller" => 0.85 * (1.0 - 2.0 * nu) * p / E,
            _ => 0.0,
        };
        assert!(
            (found.value - exact).abs() <= 1e-12 * exact.max(p),
            "{of:?}: {found:?}"
        );
        assert!(found.missed <= 1e-9 * p, "{of:?}: {found:?}");
    }
    let mut draw = Draw(4);
    let constant = turned(&[2e8, -1e8, 1e8, 0.0, 0.0, 0.0], &mut draw);
    for of in all() {
        let found = one(&of, &[constant; 5]);
        ends(&of, &found, &[]);
        let exact = match of.name() {
            "findley" => 0.3 * 2e8,
            "matake" => 0.5 * 2e8,
            "mcdiarmid" => 0.2 * 2e8,
            "crossland" => 0.22 * 2e8 / 3.0,
            "dang_van" => 0.4 * 2e8 / 3.0,
            _ => 0.0,
        };
        assert!(
            (found.value - exact).abs() <= 1e-6 * exact.max(1.0),
            "{of:?}: {found:?}"
        );
    }
}

/// A bracket that is negative on all planes.
#[test]
fn pressed_shut() {
    let of = all()
        .into_iter()
        .find(|c| c.name() == "fatemi_socie")
        .unwrap();
    let mut draw = Draw(6);
    let mut history = smooth(&mut draw, 8);
    for s in &mut history {
        for normal in &mut s[..3] {
            *normal -= 9e9;
        }
    }
    let found = one(&of, &history);
    assert_eq!((found.value, found.planes), (0.0, 0));
}

/// The histories that contacts and their users make of nothing: in proportion, constant, one
/// instant apart, nearly so, in all sizes.
#[test]
fn random_histories_end_and_bound_the_planes() {
    let mut draw = Draw(11);
    let (mut histories, mut scaled): (Vec<Vec<Tensor>>, Vec<Vec<Tensor>>) = (vec![], vec![]);
    for n in 0..60 {
        let scale = [1.0, 1e-300, 1e-30, 1e30, 1e66][n % 5];
        let near = [0.0, 1e-14, 1e-9, 1e-6, 1e-3][(n / 5) % 5];
        let base = match n % 6 {
            0 => vec![turned(&axial(-4e8), &mut draw); 4],
            1 => vec![hydrostatic(-2e8); 4],
            2 => vec![turned(&[0.0, 0.0, 0.0, 1e8, 0.0, 0.0], &mut draw); 4],
            3 => vec![turned(&[-1e8, -1e8, 0.0, 0.0, 0.0, 0.0], &mut draw); 4],
            4 => vec![turned(&[1e8, -1e8, 0.0, 0.0, 0.0, 0.0], &mut draw); 4],
            _ => random(&mut draw, 4),
        };
        let noise = random(&mut draw, 4);
        let history = base.iter().zip(&noise).enumerate().map(|(t, (b, r))| {
            // From nothing, there and back, or held.
            let share = [0.0, 1.0, 0.5, if n % 2 == 0 { 0.0 } else { 1.0 }][t];
            std::array::from_fn(|c| share * b[c] + near * r[c])
        });
        let history: Vec<Tensor> = history.collect();
        scaled.push(history.iter().map(|s| s.map(|s| scale * s)).collect());
        histories.push(history);
    }
    for of in all() {
        for (history, found) in scaled.iter().zip(many(&of, &scaled)) {
            ends(&of, &found, history);
        }
        let found = many(&of, &histories);
        for (history, found) in histories.iter().zip(&found) {
            ends(&of, found, history);
            if !of.has_plane() {
                continue;
            }
            let brute = normals(2000)
                .map(|n| on_plane(&of, history, n).0)
                .fold(f64::NEG_INFINITY, f64::max);
            let ours = sought(&of, found);
            // Values that rounding of the stress makes are not told apart.
            let size = history
                .as_flattened()
                .iter()
                .fold(0.0, |m: f64, s| m.max(s.abs()));
            let rounding = match of.name() {
                "smith_watson_topper" => 1e-11 * size * (size / 210e9),
                "fatemi_socie" => 1e-11 * size / 210e9 * (1.0 + size / 5e8),
                _ => 1e-11 * size,
            };
            assert!(
                ours + found.missed >= brute * (1.0 - 1e-9) - rounding,
                "{of:?} {history:?}: {found:?} {brute}"
            );
        }
    }
}

/// The value is that on the plane of the largest shear, however large the normal stress beside it.
#[test]
fn little_shear_beside_a_large_constant_stress() {
    let mut draw = Draw(17);
    for share in [0.1, 1e-2, 1e-3, 1e-4] {
        for _ in 0..20 {
            let held = turned(&[1e9, -3e8, 2e8, 0.0, 0.0, 0.0], &mut draw);
            let part = smooth(&mut draw, 8);
            let history: Vec<Tensor> = part
                .iter()
                .map(|s| std::array::from_fn(|c| held[c] + share * s[c]))
                .collect();
            // The largest shear does not know the constant stress.
            let alone: Vec<Tensor> = part.iter().map(|s| s.map(|v| share * v)).collect();
            for (name, k) in [("matake", 0.5), ("mcdiarmid", 0.2)] {
                let of = criterion(name, &[("k", k)]);
                let findley = criterion("findley", &[("k", 0.0)]);
                let (found, most) = (one(&of, &history), one(&findley, &alone).value);
                let rounding = 1e-15 * 1e9 / share;
                assert!(
                    found.shear_amplitude >= most * (1.0 - 1e-9) - rounding,
                    "{share}: {found:?} {most}"
                );
            }
        }
    }
}
