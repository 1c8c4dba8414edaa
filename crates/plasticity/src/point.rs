//! The return of a point to its yield surface.
//!
//! Over an increment the plastic strain grows by
//!
//! ```text
//! de_p = dp [b N_0 + (1 - b) N_1],      b = max(0, cos(N_0, N_1))/2
//! ```
//!
//! with N_0 the direction of flow at the start, where the point yielded there, and N_1 that at the end:
//! the trapezoidal rule, of second order along a path on which the direction turns. A point that starts
//! to yield within the increment has b = 0, radial return. With the trial stress s_t = s + 2 mu (e_p -
//! e_p,0), s being the stress with the present e_p, and A = 2 mu + 2/3 C, dp solves
//!
//! ```text
//! sqrt(3/2) |s_t - X_0 - b A dp N_0| - (1 - b) 3/2 A dp - R(p_0 + dp) = 0
//! ```

use crate::{COMPONENTS, Plastic, Tensor, contraction, deviator, equivalent_stress};

/// Excess over the yield stress from which a point yields, over s_y: a point that stands on its yield
/// surface to rounding unloads elastically.
pub const YIELDS: f64 = 1e-8;
/// Largest error of dp over itself.
const SETTLED: f64 = 1e-14;

/// A point at the start of an increment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Plastic strain e_p.
    pub strain: Tensor,
    /// Equivalent plastic strain p, added up over the path.
    pub equivalent: f64,
    /// Direction of flow N_0; zero where the point did not yield.
    pub flow: Tensor,
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
}

impl Point {
    /// The end of the increment under the trial stress s_t \[Pa\]: that of the end with the plastic
    /// strain of the start. `mu` is the shear modulus \[Pa\].
    pub fn at(&self, law: &Plastic, mu: f64, trial: &Tensor) -> Returned {
        let back = 2.0 / 3.0 * law.kinematic;
        let mut shifted = deviator(trial);
        for (s, e) in shifted.iter_mut().zip(&self.strain) {
            *s -= back * e;
        }
        let size = equivalent_stress(&shifted);
        let excess = size - law.yield_stress(self.equivalent);
        if !(excess > YIELDS * law.s_y) {
            return Returned {
                strain: self.strain,
                equivalent: self.equivalent,
                flow: [0.0; COMPONENTS],
            };
        }
        let stiff = 2.0 * mu + back;
        let towards = 1.5 / size;
        // N : N = 3/2.
        let cos = towards * contraction(&self.flow, &shifted) / 1.5;
        let b = 0.5 * cos.clamp(0.0, 1.0);
        let after = |dp: f64| -> Tensor {
            std::array::from_fn(|c| shifted[c] - b * stiff * dp * self.flow[c])
        };
        let mut dp = excess / (1.5 * stiff + law.hardening);
        if b > 0.0 {
            for _ in 0..20 {
                let left = after(dp);
                let size = equivalent_stress(&left);
                let residual =
                    size - (1.0 - b) * 1.5 * stiff * dp - law.yield_stress(self.equivalent + dp);
                let turn = 1.5 * contraction(&left, &self.flow) / size;
                let slope = -b * stiff * turn - (1.0 - b) * 1.5 * stiff - law.hardening;
                let step = residual / slope;
                dp = (dp - step).max(0.0);
                if step.abs() <= SETTLED * dp {
                    break;
                }
            }
        }
        let left = after(dp);
        let towards = 1.5 / equivalent_stress(&left);
        let flow: Tensor = left.map(|s| towards * s);
        let grown = |c: usize| self.strain[c] + dp * (b * self.flow[c] + (1.0 - b) * flow[c]);
        Returned {
            strain: std::array::from_fn(grown),
            equivalent: self.equivalent + dp,
            flow,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [Plastic; 4] = [
        Plastic {
            s_y: 1e9,
            hardening: 0.0,
            kinematic: 0.0,
        },
        Plastic {
            s_y: 1e9,
            hardening: 1e10,
            kinematic: 0.0,
        },
        Plastic {
            s_y: 1e9,
            hardening: 0.0,
            kinematic: 2e10,
        },
        Plastic {
            s_y: 1e9,
            hardening: 5e9,
            kinematic: 2e10,
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
            point = Point {
                strain: now.strain,
                equivalent: now.equivalent,
                flow: now.flow,
            };
            let stress: Tensor = std::array::from_fn(|c| {
                2.0 * MU * (strain[c] - now.strain[c]) - law.kinematic / 1.5 * now.strain[c]
            });
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
        for law in LAWS {
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
        ] {
            assert_eq!(bad.check("body2.plastic").expect_err("bad").key, key);
        }
    }
}
