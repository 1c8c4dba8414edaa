//! Complete elliptic integrals by the arithmetic-geometric mean.

use std::f64::consts::PI;

/// Complete elliptic integrals of the modulus k, all from one pass of the mean.
///
/// They are functions of the complementary modulus k' = sqrt(1 - k^2), the ratio of lengths that
/// contact problems give (b/a, c/a), so that neither end of 0 < k' <= 1 loses digits. DLMF
/// 19.8.5-19.8.6 for K and E, 19.2.6 for D; B = K - D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticIntegrals {
    /// First kind, K = int_0^(pi/2) dt / sqrt(1 - k^2 sin^2 t).
    pub K: f64,
    /// Second kind, E = int_0^(pi/2) sqrt(1 - k^2 sin^2 t) dt.
    pub E: f64,
    /// B = int_0^(pi/2) cos^2 t dt / sqrt(1 - k^2 sin^2 t) = [E - (1 - k^2) K]/k^2.
    pub B: f64,
    /// D = int_0^(pi/2) sin^2 t dt / sqrt(1 - k^2 sin^2 t) = (K - E)/k^2.
    pub D: f64,
}

/// Complete elliptic integrals for the complementary modulus 0 < `k_prime` <= 1, by the arithmetic-geometric
/// mean.
pub fn elliptic_integrals(k_prime: f64) -> EllipticIntegrals {
    // c_0 = k; c_(n+1) = c_n^2/(4 a_(n+1)); K - E = K sum 2^(n-1) c_n^2. Here everything is over
    // k^2, which may vanish: `ratio` is c_n^2/k^2.
    let k2 = (1.0 - k_prime) * (1.0 + k_prime);
    let (mut a, mut g) = (1.0, k_prime);
    let (mut ratio, mut weight, mut sum) = (1.0, 0.5, 0.5);
    while (a - g).abs() > 4.0 * f64::EPSILON * a {
        let c2 = ratio * k2;
        let mean = f64::midpoint(a, g);
        g = (a * g).sqrt();
        a = mean;
        ratio *= c2 / (16.0 * a * a);
        weight *= 2.0;
        sum += weight * ratio;
    }
    let K = PI / (a + g);
    let D = K * sum;
    EllipticIntegrals {
        K,
        E: K - k2 * D,
        B: K - D,
        D,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The midpoint rule converges geometrically on these periodic integrands.
    fn by_midpoint_rule(k_prime: f64) -> EllipticIntegrals {
        let n = 2000;
        let mut i = EllipticIntegrals {
            K: 0.0,
            E: 0.0,
            B: 0.0,
            D: 0.0,
        };
        for j in 0..n {
            let t = (f64::from(j) + 0.5) / f64::from(n) * PI / 2.0;
            let (s, c) = t.sin_cos();
            // 1 - k^2 sin^2 t without cancellation.
            let root = c.hypot(k_prime * s);
            i.K += 1.0 / root;
            i.E += root;
            i.B += c * c / root;
            i.D += s * s / root;
        }
        let h = PI / 2.0 / f64::from(n);
        EllipticIntegrals {
            K: i.K * h,
            E: i.E * h,
            B: i.B * h,
            D: i.D * h,
        }
    }

    #[test]
    fn agree_with_direct_integration_to_round_off() {
        for k_prime in [1.0, 1.0 - 1e-9, 0.999, 0.9, 0.5, 0.1, 0.02] {
            let (i, j) = (elliptic_integrals(k_prime), by_midpoint_rule(k_prime));
            for (x, y) in [(i.K, j.K), (i.E, j.E), (i.B, j.B), (i.D, j.D)] {
                assert!(
                    (x - y).abs() < 1e-14 * y.max(1.0),
                    "k' = {k_prime}: {x} {y}"
                );
            }
        }
    }

    #[test]
    fn follow_the_logarithm_as_k_prime_vanishes() {
        // K = ln(4/k') + (k'^2/4)(ln(4/k') - 1) + ..., E -> 1 (DLMF 19.12).
        let k_prime: f64 = 1e-8;
        let i = elliptic_integrals(k_prime);
        assert!((i.K - (4.0 / k_prime).ln()).abs() < 1e-14 * i.K);
        assert!((i.E - 1.0).abs() < 1e-13);
    }
}
