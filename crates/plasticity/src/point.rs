//! The return of a point to its yield surface.
//!
//! Over an increment the plastic strain grows by
//!
//! ```text
//! de_p = dp n,     n = b N_0 + (1 - b) N_1,      b = max(0, cos(N_0, N_1))/2
//! ```
//!
//! with N_0 the direction of flow at the start, where the point yielded there, and N_1 that at the end:
//! the trapezoidal rule, of second order along a path on which the direction turns. A point that starts
//! to yield within the increment has b = 0, radial return. Along n a back stress with recall is exact,
//!
//! ```text
//! X_i = E_i X_i,0 + 2/3 C_i G_i n,     E_i = exp(-gamma_i dp),   G_i = (1 - E_i)/gamma_i
//! ```
//!
//! With the trial stress s_t = s + 2 mu (e_p - e_p,0), s being the stress with the present e_p, and
//! K(dp) = (2 mu + 2/3 C) dp + sum 2/3 C_i G_i, dp solves
//!
//! ```text
//! sqrt(3/2) |B| - (1 - b) 3/2 K - R(p_0 + dp) = 0,    B = s_t - 2/3 C e_p,0 - sum E_i X_i,0 - b K N_0
//! ```
//!
//! by Newton steps with the exact derivative, held between bounds; N_1 has the direction of B.

use crate::{BACK_STRESSES, COMPONENTS, Plastic, Tensor, contraction, deviator, equivalent_stress};

/// Excess over the yield stress from which a point yields, over s_y: a point that stands on its yield
/// surface to rounding unloads elastically.
pub const YIELDS: f64 = 1e-8;
/// Largest error of dp over itself.
const SETTLED: f64 = 1e-14;
/// Most steps to it; halving alone takes 60.
const STEPS: usize = 100;

/// A point at the start of an increment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Plastic strain e_p.
    pub strain: Tensor,
    /// Equivalent plastic strain p, added up over the path.
    pub equivalent: f64,
    /// Direction of flow N_0; zero where the point did not yield.
    pub flow: Tensor,
    /// Back stresses X_i with recall \[Pa\].
    pub back: [Tensor; BACK_STRESSES],
}

/// A point at the end of an increment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Returned {
    /// Plastic strain e_p.
    pub strain: Tensor,
    /// Equivalent plastic strain p.
    pub equivalent: f64,
    /// Direction of flow N_1; zero where the point did not yield.
    pub flow: Tensor,
    /// Back stresses X_i with recall \[Pa\].
    pub back: [Tensor; BACK_STRESSES],
}

/// (1 - exp(-x))/x.
fn mean_recall(x: f64) -> f64 {
    if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 }
}

/// (x - 1 + exp(-x))/x^2.
fn second_recall(x: f64) -> f64 {
    if x > 1e-3 {
        (x + (-x).exp_m1()) / (x * x)
    } else {
        0.5 - x / 6.0 + x * x / 24.0
    }
}

impl From<Returned> for Point {
    fn from(end: Returned) -> Self {
        Self {
            strain: end.strain,
            equivalent: end.equivalent,
            flow: end.flow,
            back: end.back,
        }
    }
}

impl Point {
    /// The point as it is, without flow.
    pub fn unchanged(&self) -> Returned {
        Returned {
            strain: self.strain,
            equivalent: self.equivalent,
            flow: [0.0; COMPONENTS],
            back: self.back,
        }
    }

    /// The end of the increment under the trial stress s_t \[Pa\]: that of the end with the plastic
    /// strain of the start. `mu` is the shear modulus \[Pa\].
    pub fn at(&self, law: &Plastic, mu: f64, trial: &Tensor) -> Returned {
        let linear = 2.0 / 3.0 * law.kinematic;
        let mut start = deviator(trial);
        for (s, e) in start.iter_mut().zip(&self.strain) {
            *s -= linear * e;
        }
        // Terms that are there: C_i, gamma_i and X_i at the start.
        let terms = law
            .chaboche_C
            .iter()
            .zip(&law.chaboche_gamma)
            .zip(&self.back);
        let terms = terms.filter(|((C, _), _)| **C > 0.0);
        // B without the part of N_0, K, and their derivatives.
        let of = |dp: f64| -> (Tensor, f64, Tensor, f64) {
            let stiff = 2.0 * mu + linear;
            let (mut left, mut k) = (start, stiff * dp);
            let (mut d_left, mut d_k) = ([0.0; COMPONENTS], stiff);
            for ((C, gamma), back) in terms.clone() {
                let kept = (-gamma * dp).exp();
                k += 2.0 / 3.0 * C * mean_recall(gamma * dp) * dp;
                d_k += 2.0 / 3.0 * C * kept;
                for c in 0..COMPONENTS {
                    left[c] -= kept * back[c];
                    d_left[c] += gamma * kept * back[c];
                }
            }
            (left, k, d_left, d_k)
        };
        let (shifted, _, d_shifted, d_k) = of(0.0);
        let size = equivalent_stress(&shifted);
        let excess = size - law.yield_stress(self.equivalent);
        if !(excess > YIELDS * law.s_y) {
            return self.unchanged();
        }
        let towards = 1.5 / size;
        // N : N = 3/2.
        let cos = towards * contraction(&self.flow, &shifted) / 1.5;
        let b = 0.5 * cos.clamp(0.0, 1.0);
        let slope =
            1.5 * d_k + law.slope(self.equivalent) - towards * contraction(&shifted, &d_shifted);
        let whole = |dp: f64| {
            let (mut left, k, mut d_left, d_k) = of(dp);
            for c in 0..COMPONENTS {
                left[c] -= b * k * self.flow[c];
                d_left[c] -= b * d_k * self.flow[c];
            }
            (left, k, d_left, d_k)
        };
        let mut dp = excess / slope.max(mu);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        for _ in 0..STEPS {
            let (left, k, d_left, d_k) = whole(dp);
            let size = equivalent_stress(&left);
            let p = self.equivalent + dp;
            let residual = size - (1.0 - b) * 1.5 * k - law.yield_stress(p);
            let slope =
                1.5 * contraction(&left, &d_left) / size - (1.0 - b) * 1.5 * d_k - law.slope(p);
            if residual > 0.0 {
                low = dp;
            } else {
                high = dp;
            }
            let next = dp - residual / slope;
            if !((next - dp).abs() > SETTLED * dp) {
                dp = next;
                break;
            }
            dp = if next > low && next < high {
                next
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * dp
            };
        }
        let (left, ..) = whole(dp);
        let towards = 1.5 / equivalent_stress(&left);
        let flow: Tensor = left.map(|s| towards * s);
        let along: Tensor = std::array::from_fn(|c| b * self.flow[c] + (1.0 - b) * flow[c]);
        let back = |n: usize| -> Tensor {
            let (C, gamma) = (law.chaboche_C[n], law.chaboche_gamma[n]);
            if C == 0.0 {
                return [0.0; COMPONENTS];
            }
            let kept = (-gamma * dp).exp();
            let grown = 2.0 / 3.0 * C * mean_recall(gamma * dp) * dp;
            std::array::from_fn(|c| kept * self.back[n][c] + grown * along[c])
        };
        Returned {
            strain: std::array::from_fn(|c| self.strain[c] + dp * along[c]),
            equivalent: self.equivalent + dp,
            flow,
            back: std::array::from_fn(back),
        }
    }

    /// Plastic work of an increment that ends so, int sigma : de_p \[J/m^3\], at the yield surface: int R dp +
    /// int X : de_p.
    pub fn work(&self, law: &Plastic, end: &Returned) -> f64 {
        let dp = end.equivalent - self.equivalent;
        let grown: Tensor = std::array::from_fn(|c| end.strain[c] - self.strain[c]);
        let mean: Tensor = std::array::from_fn(|c| 0.5 * (end.strain[c] + self.strain[c]));
        let mut work = law.integral(self.equivalent, end.equivalent)
            + 2.0 / 3.0 * law.kinematic * contraction(&mean, &grown);
        for (n, back) in self.back.iter().enumerate() {
            let (C, x) = (law.chaboche_C[n], law.chaboche_gamma[n] * dp);
            work += mean_recall(x) * contraction(back, &grown)
                + 2.0 / 3.0 * C * second_recall(x) * contraction(&grown, &grown);
        }
        work
    }

    /// The same part of it that is stored, and given back where the back stresses go: int (R - s_y) dp +
    /// C/3 e_p : e_p + sum 3/(4 C_i) X_i : X_i \[J/m^3\]. The rest is heat, never negative.
    pub fn stored(&self, law: &Plastic) -> f64 {
        let isotropic = law.integral(0.0, self.equivalent) - law.s_y * self.equivalent;
        let mut stored = isotropic + law.kinematic / 3.0 * contraction(&self.strain, &self.strain);
        for (back, C) in self.back.iter().zip(law.chaboche_C) {
            if C > 0.0 {
                stored += 0.75 / C * contraction(back, back);
            }
        }
        stored
    }
}

#[cfg(test)]
mod tests {
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

    /// A point along a path of total strains (deviators).
    fn along(law: &Plastic, path: impl Fn(f64) -> Tensor, steps: usize) -> Point {
        let mut point = Point::default();
        for n in 1..=steps {
            let strain = path(n as f64 / steps as f64);
            let trial = std::array::from_fn(|c| 2.0 * MU * (strain[c] - point.strain[c]));
            let now = point.at(law, MU, &trial);
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
            let p = (3f64.sqrt() * 2.0 * MU * 0.01 - law.s_y)
                / (3.0 * MU + law.kinematic + law.hardening);
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
        let found = Point::default().at(&law, MU, &trial);
        assert_eq!(found, Returned::default());
    }

    /// One step of a bar: the deviator of a total strain along x.
    fn bar(point: &Point, law: &Plastic, strain: f64) -> (Point, f64) {
        let s = 2.0 * MU;
        let e = [strain, -0.5 * strain, -0.5 * strain, 0.0, 0.0, 0.0];
        let trial = std::array::from_fn(|c| s * (e[c] - point.strain[c]));
        let now = point.at(law, MU, &trial);
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
                let (mut one, mut other) = (Point::default(), Point::default());
                for _ in 0..30 {
                    let trial: Tensor = std::array::from_fn(|_| 2e9 * (random.f64() - 0.5));
                    let now = one.at(&law, MU, &trial);
                    let there = other.at(&law, MU, &turned(&a, &trial));
                    let wanted = turned(&a, &now.strain);
                    for c in 0..COMPONENTS {
                        assert!((there.strain[c] - wanted[c]).abs() < 1e-12);
                    }
                    // Radial return: the flow of a step is that of its end.
                    let first = Point {
                        flow: [0.0; COMPONENTS],
                        ..one
                    };
                    let end = first.at(&law, MU, &trial);
                    let stored = Point::from(end).stored(&law) - first.stored(&law);
                    let heat = first.work(&law, &end) - stored;
                    let dp = end.equivalent - first.equivalent;
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
}
