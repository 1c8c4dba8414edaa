//! The return of a point to its yield surface.
//!
//! Over an increment the plastic strain grows by
//!
//! ```text
//! de_p = dp n,     n = b N_0 + (1 - b) N_1,      b = max(0, cos(N_0, N_1))/2
//! ```
//!
//! with N_0 the normal of the yield surface where the trial path leaves it, and N_1 the normal at the
//! end: the trapezoidal rule, of second order along a path on which the direction turns. The trial path
//! goes straight from the stress at the start to the trial stress, both with the plastic strain of the
//! start. With B_0 the stress there less the back stresses, dB its growth, it leaves the surface at
//!
//! ```text
//! t = (-B_0 : dB + sqrt((B_0 : dB)^2 - dB : dB (B_0 : B_0 - 2/3 R(p_0)^2)))/(dB : dB),     0 <= t <= 1
//! ```
//!
//! A start on the surface or beyond it by an error has t = 0, whether or not the point yielded in the
//! increment before: N_0 is a continuous function of the path. Along n a back stress with recall is exact,
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
            back: end.back,
        }
    }
}

/// Direction of a deviator, where the trial path from B_0 to `end` leaves the yield surface of the radius R
/// \[Pa\]. It has N : N = 3/2.
fn onset_normal(start: &Tensor, end: &Tensor, radius: f64) -> Tensor {
    let growth: Tensor = std::array::from_fn(|c| end[c] - start[c]);
    let square = contraction(&growth, &growth);
    let along = contraction(start, &growth);
    let outside = contraction(start, start) - radius * radius / 1.5;
    let root = (along * along - square * outside).max(0.0).sqrt();
    // Without growth the point stands at its end.
    let t = if square > 0.0 {
        ((root - along) / square).clamp(0.0, 1.0)
    } else {
        1.0
    };
    let onset: Tensor = std::array::from_fn(|c| start[c] + t * growth[c]);
    let size = equivalent_stress(&onset);
    onset.map(|s| 1.5 * s / size)
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

    /// Returns the point to its yield surface, from the stress at the start of the increment \[Pa\] and the
    /// trial stress s_t \[Pa\], which is the stress at the end with the plastic strain of the start. `mu`
    /// is the shear modulus \[Pa\].
    pub fn advance(&self, law: &Plastic, mu: f64, stress: &Tensor, trial: &Tensor) -> Returned {
        let linear = 2.0 / 3.0 * law.kinematic;
        let start: Tensor = {
            let trial = deviator(trial);
            std::array::from_fn(|c| trial[c] - linear * self.strain[c])
        };
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
        let normal = {
            let stress = deviator(stress);
            let relative: Tensor = std::array::from_fn(|c| {
                let back: f64 = self.back.iter().map(|back| back[c]).sum();
                stress[c] - linear * self.strain[c] - back
            });
            onset_normal(&relative, &shifted, law.yield_stress(self.equivalent))
        };
        // N : N = 3/2.
        let cos = towards * contraction(&normal, &shifted) / 1.5;
        let b = 0.5 * cos.clamp(0.0, 1.0);
        let slope =
            1.5 * d_k + law.slope(self.equivalent) - towards * contraction(&shifted, &d_shifted);
        let whole = |dp: f64| {
            let (mut left, k, mut d_left, d_k) = of(dp);
            for c in 0..COMPONENTS {
                left[c] -= b * k * normal[c];
                d_left[c] -= b * d_k * normal[c];
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
        let along: Tensor = std::array::from_fn(|c| b * normal[c] + (1.0 - b) * flow[c]);
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
mod tests;
