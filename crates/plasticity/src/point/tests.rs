//! The return at a point against closed forms, rotations and the second law.

use super::*;

const PERFECT: Plastic = Plastic::perfect(1e9);
const LAWS: [Plastic; 4] = [
    PERFECT,
    Plastic {
        hardening: 1e10,
        ..PERFECT
    },
    Plastic {
        kinematic: 2e10,
        ..PERFECT
    },
    Plastic {
        hardening: 5e9,
        kinematic: 2e10,
        ..PERFECT
    },
];
/// The others, alone and together.
const CURVED: [Plastic; 4] = [
    Plastic {
        voce_Q: 4e8,
        voce_b: 30.0,
        ..PERFECT
    },
    Plastic {
        swift_e_0: 4e-3,
        swift_n: 0.2,
        ..PERFECT
    },
    Plastic {
        chaboche_C: [1e11, 2e10, 0.0],
        chaboche_gamma: [400.0, 50.0, 0.0],
        ..PERFECT
    },
    Plastic {
        hardening: 1e9,
        voce_Q: 2e8,
        voce_b: 10.0,
        kinematic: 1e9,
        chaboche_C: [6e10, 1e10, 2e9],
        chaboche_gamma: [300.0, 20.0, 0.0],
        ..PERFECT
    },
];
const MU: f64 = 80e9;
const ZERO: Tensor = [0.0; COMPONENTS];

/// A point along a path of total strains (deviators).
fn along(law: &Plastic, path: impl Fn(f64) -> Tensor, steps: usize) -> Point {
    let mut point = Point::default();
    for n in 1..=steps {
        let strain = path(n as f64 / steps as f64);
        let stress_of = |strain: Tensor| -> Tensor {
            std::array::from_fn(|c| 2.0 * MU * (strain[c] - point.strain[c]))
        };
        let start = stress_of(path((n - 1) as f64 / steps as f64));
        let now = point.advance(law, MU, &start, &stress_of(strain));
        let before = point;
        point = now.into();
        let stress: Tensor = std::array::from_fn(|c| {
            let back: f64 = now.back.iter().map(|x| x[c]).sum();
            2.0 * MU * (strain[c] - now.strain[c]) - law.kinematic / 1.5 * now.strain[c] - back
        });
        // What is not stored is heat.
        let heat = before.work(law, &now) - point.stored(law) + before.stored(law);
        let dp = now.equivalent - before.equivalent;
        assert!(
            heat >= law.s_y * dp * (1.0 - 1e-2),
            "{heat:e} of {:e}",
            law.s_y * dp
        );
        let over = equivalent_stress(&stress) / law.yield_stress(now.equivalent) - 1.0;
        assert!(over < 2.0 * YIELDS, "over the yield surface by {over}");
    }
    point
}

#[test]
fn shear_that_reverses_follows_the_closed_form() {
    for law in LAWS {
        let up = along(&law, |t| [0.0, 0.0, 0.0, 0.01 * t, 0.0, 0.0], 3);
        // 3 mu dp + C dp + H dp = sqrt(3) 2 mu e - s_y.
        let p =
            (3f64.sqrt() * 2.0 * MU * 0.01 - law.s_y) / (3.0 * MU + law.kinematic + law.hardening);
        assert!((up.equivalent / p - 1.0).abs() < 1e-12);
        assert!((up.strain[3] / (3f64.sqrt() / 2.0 * p) - 1.0).abs() < 1e-12);
        let back = |t: f64| {
            let part = if t < 0.25 {
                4.0 * t
            } else {
                1.0 - 8.0 / 3.0 * (t - 0.25)
            };
            [0.0, 0.0, 0.0, 0.01 * part, 0.0, 0.0]
        };
        let there = along(&law, back, 64);
        // From +e to -e: the elastic range is 2 R of the end of the first stroke.
        let more = (3f64.sqrt() * 2.0 * MU * 0.02 - 2.0 * law.yield_stress(p))
            / (3.0 * MU + law.kinematic + law.hardening);
        assert!((there.equivalent - p - more).abs() < 1e-12);
    }
}

#[test]
fn a_path_that_turns_is_followed_in_second_order() {
    let turning = |t: f64| {
        let (sin, cos) = (1.5 * t).sin_cos();
        let part = 0.01 * t.min(0.25) * 4.0;
        [part * cos, -part * cos, 0.0, part * sin, 0.0, 0.0]
    };
    for law in LAWS.into_iter().chain(CURVED) {
        let exact = along(&law, turning, 8192);
        let error = |steps: usize| {
            let found = along(&law, turning, steps);
            let off: Tensor = std::array::from_fn(|c| found.strain[c] - exact.strain[c]);
            crate::equivalent_strain(&off) / exact.equivalent
        };
        let (coarse, fine) = (error(32), error(64));
        assert!(
            fine < 3e-4 && coarse / fine > 3.0,
            "{law:?}: {coarse:e}, {fine:e}"
        );
    }
}

/// A point that has just yielded and its twin that has just not: after the next increment they are as close.
#[test]
fn a_little_flow_before_changes_little() {
    let onset = |law: &Plastic, factor: f64| -> Tensor {
        let s = factor * law.s_y / 3f64.sqrt();
        [0.0, 0.0, 0.0, s, 0.0, 0.0]
    };
    for law in LAWS.into_iter().chain(CURVED) {
        let ends = [-1e-7, 1e-7].map(|beyond| {
            let trial = onset(&law, 1.0 + beyond);
            let first = Point::default().advance(&law, MU, &ZERO, &trial);
            assert_eq!(first.equivalent > 0.0, beyond > 0.0);
            let stress: Tensor = std::array::from_fn(|c| trial[c] - 2.0 * MU * first.strain[c]);
            // The strain turns: along xz, and a little back along xy.
            let growth = [0.0, 0.0, 0.0, -0.1 * law.s_y, 2.0 * law.s_y, 0.0];
            let next: Tensor = std::array::from_fn(|c| stress[c] + growth[c]);
            Point::from(first).advance(&law, MU, &stress, &next)
        });
        let off: Tensor = std::array::from_fn(|c| ends[1].strain[c] - ends[0].strain[c]);
        let off = crate::equivalent_strain(&off) / ends[0].equivalent;
        assert!(off < 1e-5, "{law:?}: {off:e}");
    }
}

/// An increment that begins within the yield surface is as good as one from its onset.
#[test]
fn an_elastic_part_of_an_increment_costs_no_order() {
    let law = LAWS[3];
    // Along xy to half of the yield strain, then along xz.
    let half = 0.5 * law.s_y / (2.0 * MU * 3f64.sqrt());
    let path = |t: f64| {
        let turn = 6.0 * half * t;
        [0.0, 0.0, 0.0, half, turn, 0.0]
    };
    let strain_of = |steps: usize| {
        let mut point = Point::default();
        for n in 0..steps {
            let stress_of = |t: f64| -> Tensor {
                std::array::from_fn(|c| 2.0 * MU * (path(t)[c] - point.strain[c]))
            };
            let [start, end] = [n, n + 1].map(|n| stress_of(n as f64 / steps as f64));
            point = point.advance(&law, MU, &start, &end).into();
        }
        point.strain
    };
    let exact = strain_of(4096);
    let error = |steps: usize| {
        let strain = strain_of(steps);
        let off: Tensor = std::array::from_fn(|c| strain[c] - exact[c]);
        crate::equivalent_strain(&off) / crate::equivalent_strain(&exact)
    };
    let errors = [1, 4, 16].map(error);
    // Second order: a quarter of the increment has a sixteenth of the error.
    let ratios = [errors[0] / errors[1], errors[1] / errors[2]];
    assert!(
        errors[0] < 0.04 && ratios.iter().all(|r| *r > 10.0),
        "{errors:?}"
    );
}

#[test]
fn a_point_on_its_surface_unloads_elastically() {
    let law = LAWS[0];
    let trial = [
        0.0,
        0.0,
        0.0,
        law.s_y / 3f64.sqrt() * (1.0 + 0.1 * YIELDS),
        0.0,
        0.0,
    ];
    let end = Point::default().advance(&law, MU, &ZERO, &trial);
    assert_eq!(end, Returned::default());
}

/// One step of a bar: the deviator of a total strain along x.
fn bar(point: &Point, law: &Plastic, strain: f64) -> (Point, f64) {
    let s = 2.0 * MU;
    let e = [strain, -0.5 * strain, -0.5 * strain, 0.0, 0.0, 0.0];
    let trial = std::array::from_fn(|c| s * (e[c] - point.strain[c]));
    // All directions are the same line, whatever the stress at the start.
    let now = point.advance(law, MU, &ZERO, &trial);
    // Of uniaxial stress the deviator along x is 2/3.
    let stress = 1.5 * s * (e[0] - now.strain[0]);
    (now.into(), stress)
}

#[test]
fn a_bar_that_is_drawn_has_the_curve_of_its_law() {
    for law in LAWS.into_iter().chain(CURVED) {
        let mut point = Point::default();
        for strain in [0.007, 0.02, 0.05] {
            let (now, stress) = bar(&point, &law, strain);
            point = now;
            let p = now.equivalent;
            let back = law.kinematic * p
                + law
                    .chaboche_C
                    .iter()
                    .zip(law.chaboche_gamma)
                    .map(|(C, gamma)| C * mean_recall(gamma * p) * p)
                    .sum::<f64>();
            let curve = law.yield_stress(p) + back;
            assert!(
                (stress / curve - 1.0).abs() < 1e-12,
                "{law:?}: {stress:e} {curve:e}"
            );
            assert!((p / now.strain[0] - 1.0).abs() < 1e-12);
        }
        assert!(law.most() >= law.yield_stress(10.0));
    }
}

#[test]
fn cycles_saturate_where_they_do_in_closed_form() {
    // Lemaitre, Chaboche, section 5.4.4: s_a = R + sum C/gamma tanh(gamma e_pa).
    for law in [
        CURVED[2],
        Plastic {
            hardening: 0.0,
            kinematic: 0.0,
            ..CURVED[3]
        },
    ] {
        let (mut point, mut stress, mut before) = (Point::default(), 0.0, 0.0);
        for n in 0..4000 {
            before = point.strain[0];
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            (point, stress) = bar(&point, &law, sign * 0.012);
        }
        let amplitude = 0.5 * (point.strain[0] - before).abs();
        let pairs = law.chaboche_C.iter().zip(law.chaboche_gamma);
        let back: f64 = pairs
            .map(|(C, gamma)| match gamma {
                0.0 => C * amplitude,
                gamma => C / gamma * (gamma * amplitude).tanh(),
            })
            .sum();
        let peak = law.yield_stress(point.equivalent) + back;
        assert!(
            (stress.abs() / peak - 1.0).abs() < 1e-9,
            "{stress:e} for {peak:e}"
        );
    }
}

#[test]
fn a_mean_stress_ratchets_as_it_does_in_closed_form() {
    let law = Plastic {
        s_y: 3e8,
        chaboche_C: [4e10, 0.0, 0.0],
        chaboche_gamma: [100.0, 0.0, 0.0],
        ..PERFECT
    };
    // The total strain at which the stress is as given.
    let to = |point: &Point, stress: f64| {
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if bar(point, &law, middle).1 < stress {
                low = middle;
            } else {
                high = middle;
            }
        }
        bar(point, &law, low).0
    };
    for sign in [1.0, -1.0] {
        let (most, least) = (6e8, -4e8);
        let mut point = to(&Point::default(), sign * most);
        let start = point.strain[0];
        for _ in 0..5 {
            point = to(&to(&point, sign * least), sign * most);
        }
        // Lemaitre, Chaboche, section 5.4.4, with X at most 6e8 - s_y, at least -4e8 + s_y.
        let (k, X, x) = (4e10 / 100.0, most - law.s_y, least + law.s_y);
        let step = (((k - x) * (k + x)) / ((k - X) * (k + X))).ln() / 100.0;
        let found = (point.strain[0] - start) / 5.0;
        assert!(
            (found / (sign * step) - 1.0).abs() < 1e-9,
            "{found:e} for {step:e}"
        );
    }
}

/// A b A^T of a rotation A.
fn turned(a: &[[f64; 3]; 3], b: &Tensor) -> Tensor {
    let full = [[b[0], b[3], b[4]], [b[3], b[1], b[5]], [b[4], b[5], b[2]]];
    let at = |i: usize, j: usize| -> f64 {
        (0..9)
            .map(|n| a[i][n / 3] * full[n / 3][n % 3] * a[j][n % 3])
            .sum()
    };
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)]
}

#[test]
fn no_law_knows_axes_and_all_give_heat() {
    let mut random = fastrand::Rng::with_seed(60);
    for law in LAWS.into_iter().chain(CURVED) {
        for _ in 0..20 {
            let (sin, cos) = (6.0 * random.f64()).sin_cos();
            let (s, c) = (6.0 * random.f64()).sin_cos();
            let a = [
                [cos, -sin, 0.0],
                [c * sin, c * cos, -s],
                [s * sin, s * cos, c],
            ];
            let (mut one, mut other, mut stress) = (Point::default(), Point::default(), ZERO);
            for _ in 0..30 {
                let trial: Tensor = std::array::from_fn(|_| 2e9 * (random.f64() - 0.5));
                let now = one.advance(&law, MU, &stress, &trial);
                let there = other.advance(&law, MU, &turned(&a, &stress), &turned(&a, &trial));
                let wanted = turned(&a, &now.strain);
                for c in 0..COMPONENTS {
                    assert!((there.strain[c] - wanted[c]).abs() < 1e-12);
                }
                let stored = Point::from(now).stored(&law) - one.stored(&law);
                let heat = one.work(&law, &now) - stored;
                let dp = now.equivalent - one.equivalent;
                let growth = |c: usize| now.strain[c] - one.strain[c];
                stress = std::array::from_fn(|c| trial[c] - 2.0 * MU * growth(c));
                assert!(heat >= law.s_y * dp * (1.0 - 1e-9), "{heat:e}, {dp:e}");
                (one, other) = (now.into(), there.into());
            }
        }
    }
}

#[test]
fn numbers_without_meaning_are_refused_by_name() {
    let law = LAWS[0];
    for (bad, key) in [
        (Plastic { s_y: 0.0, ..law }, "body2.plastic.s_y"),
        (
            Plastic {
                s_y: f64::NAN,
                ..law
            },
            "body2.plastic.s_y",
        ),
        (
            Plastic {
                hardening: -1.0,
                ..law
            },
            "body2.plastic.hardening",
        ),
        (
            Plastic {
                kinematic: f64::NAN,
                ..law
            },
            "body2.plastic.kinematic",
        ),
        (Plastic { voce_Q: 1e8, ..law }, "body2.plastic.voce_b"),
        (
            Plastic {
                voce_b: 10.0,
                ..law
            },
            "body2.plastic.voce_Q",
        ),
        (
            Plastic {
                swift_n: 0.2,
                ..law
            },
            "body2.plastic.swift_e_0",
        ),
        (
            Plastic {
                swift_n: 1.2,
                swift_e_0: 1e-3,
                ..law
            },
            "body2.plastic.swift_n",
        ),
        (
            Plastic {
                chaboche_C: [1e9, -1.0, 0.0],
                ..law
            },
            "body2.plastic.chaboche_C[1]",
        ),
        (
            Plastic {
                chaboche_gamma: [0.0, f64::NAN, 0.0],
                ..law
            },
            "body2.plastic.chaboche_gamma[1]",
        ),
        (
            Plastic {
                chaboche_gamma: [10.0, 0.0, 0.0],
                ..law
            },
            "body2.plastic.chaboche_C[0]",
        ),
    ] {
        assert_eq!(bad.check("body2.plastic").expect_err("bad").key, key);
    }
}
