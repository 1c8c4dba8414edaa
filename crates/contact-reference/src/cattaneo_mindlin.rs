//! Cattaneo and Mindlin: a sphere pressed on, then sheared to and fro, with partial slip.

use contact_core::hertz::Hertz;
use contact_core::scene::Elastic;

/// Tangential modulus G* of a pair \[Pa\], 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2.
pub fn tangential_modulus(body1: Elastic, body2: Elastic) -> f64 {
    let compliance = |m: Elastic| (2.0 - m.nu) / m.G();
    1.0 / (compliance(body1) + compliance(body2))
}

/// Partial slip under constant normal force W and a tangential force T along x.
///
/// C. Cattaneo, Rend. Accad. Naz. Lincei 27 (1938); R. D. Mindlin, J. Appl. Mech. 16 (1949) 259;
/// the reversals after R. D. Mindlin and H. Deresiewicz, J. Appl. Mech. 20 (1953) 327. The
/// tractions are differences of Hertz-shaped pressures, p_s(r) = p0 (s/a) sqrt(1 - r^2/s^2) on
/// r < s. Exact where the shear kernel of the pair is isotropic and no normal-tangential coupling
/// exists (nu = 0, similar bodies); else the slip is not quite along x and T against delta_x alone
/// stays a good approximation.
///
/// The force T and the shift delta_x have the same sign; all forces obey |T| <= mu W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CattaneoMindlin {
    /// The normal contact.
    pub hertz: Hertz,
    /// Friction coefficient.
    pub mu: f64,
    /// Tangential modulus G* \[Pa\].
    pub G_star: f64,
}

impl CattaneoMindlin {
    /// Partial slip on the given Hertz contact.
    pub fn new(hertz: Hertz, body1: Elastic, body2: Elastic, mu: f64) -> Self {
        Self {
            hertz,
            mu,
            G_star: tangential_modulus(body1, body2),
        }
    }

    /// The largest tangential force \[N\], mu W.
    pub fn T_limit(&self) -> f64 {
        self.mu * self.hertz.W
    }

    /// Stick radius over contact radius after the force changed by `T` \[N\] in one direction out
    /// of a state whose friction allows the change `limit` \[N\].
    fn stick(T: f64, limit: f64) -> f64 {
        (1.0 - T.abs() / limit).max(0.0).cbrt()
    }

    /// Shear at the limit of friction under the Hertz pressure of a smaller disc of radius s = `ratio` a, mu p0
    /// ratio sqrt(1 - r^2/s^2) \[Pa\]; zero outside of it.
    fn disc(&self, ratio: f64, r: f64) -> f64 {
        let (r, s) = (r.abs(), ratio * self.hertz.a);
        if r < s {
            self.mu * self.hertz.p0 * ratio * (1.0 - (r / s).powi(2)).sqrt()
        } else {
            0.0
        }
    }

    /// Shift at which gross sliding starts \[m\], 3 mu W/(16 a G*).
    pub fn shift_limit(&self) -> f64 {
        3.0 * self.T_limit() / (16.0 * self.hertz.a * self.G_star)
    }

    /// Stick radius c \[m\] of the first loading to `T` \[N\], a (1 - T/(mu W))^(1/3).
    pub fn stick_radius(&self, T: f64) -> f64 {
        self.hertz.a * Self::stick(T, self.T_limit())
    }

    /// Stick radius c' \[m\] after the force changed from the reversal at `T_m` to `T` \[N\],
    /// a \[1 - |T_m - T|/(2 mu W)\]^(1/3).
    pub fn stick_radius_reversed(&self, T: f64, T_m: f64) -> f64 {
        self.hertz.a * Self::stick(T_m - T, 2.0 * self.T_limit())
    }

    /// Shear traction q_x(r) \[Pa\] of the first loading to `T` \[N\], mu (p_a - p_c).
    pub fn q_loading(&self, r: f64, T: f64) -> f64 {
        let c = Self::stick(T, self.T_limit());
        T.signum() * (self.disc(1.0, r) - self.disc(c, r))
    }

    /// Shear traction q_x(r) \[Pa\] at `T` on the way back from the first loading to `T_m` \[N\],
    /// mu (p_a - p_c) - 2 mu (p_a - p_c') = -mu (p_a - 2 p_c' + p_c); |T| <= |T_m|.
    pub fn q_unloading(&self, r: f64, T: f64, T_m: f64) -> f64 {
        let c = Self::stick(T_m - T, 2.0 * self.T_limit());
        self.q_loading(r, T_m) - T_m.signum() * 2.0 * (self.disc(1.0, r) - self.disc(c, r))
    }

    /// Shear traction q_x(r) \[Pa\] at `T` on the way from -`T_m` back to `T_m` \[N\]: the mirror
    /// image of the way down.
    pub fn q_reloading(&self, r: f64, T: f64, T_m: f64) -> f64 {
        -self.q_unloading(r, -T, T_m)
    }

    /// Shift delta_x \[m\] of the first loading, (3 mu W/(16 a G*)) \[1 - (1 - T/(mu W))^(2/3)\].
    pub fn shift_loading(&self, T: f64) -> f64 {
        let c = Self::stick(T, self.T_limit());
        T.signum() * self.shift_limit() * (1.0 - c * c)
    }

    /// Shift delta_x \[m\] at `T` on the way back from `T_m` \[N\],
    /// (3 mu W/(16 a G*)) {2 \[1 - (T_m - T)/(2 mu W)\]^(2/3) - \[1 - T_m/(mu W)\]^(2/3) - 1}.
    pub fn shift_unloading(&self, T: f64, T_m: f64) -> f64 {
        let c = Self::stick(T_m - T, 2.0 * self.T_limit());
        self.shift_loading(T_m) - T_m.signum() * 2.0 * self.shift_limit() * (1.0 - c * c)
    }

    /// Shift delta_x \[m\] at `T` on the way from -`T_m` back to `T_m` \[N\].
    pub fn shift_reloading(&self, T: f64, T_m: f64) -> f64 {
        -self.shift_unloading(-T, T_m)
    }

    /// Energy dissipated in one closed loop between -`T_m` and `T_m` \[J\],
    /// (9 mu^2 W^2/(10 a G*)) {1 - (1 - q)^(5/3) - (5 q/6) \[1 + (1 - q)^(2/3)\]}, q = T_m/(mu W).
    pub fn loop_energy(&self, T_m: f64) -> f64 {
        0.9 * self.T_limit().powi(2) / (self.hertz.a * self.G_star)
            * loop_shape(T_m.abs() / self.T_limit())
    }

    /// Loop energy over the energy 4 T_m delta_x(T_m) of the rectangle around the loop; 0.2 where
    /// partial slip ends (S. Fouvry, Ph. Kapsa, L. Vincent, Wear 185 (1995) 35).
    pub fn energy_ratio(&self, T_m: f64) -> f64 {
        let q = T_m.abs() / self.T_limit();
        if q == 0.0 {
            return 0.0;
        }
        // 1 - c^2/a^2, exact for small q.
        let shift = -(2.0 / 3.0 * (-q.min(1.0)).ln_1p()).exp_m1();
        loop_shape(q) / q / (5.0 / 6.0 * shift)
    }
}

/// 1 - (1 - q)^(5/3) - (5 q/6) \[1 + (1 - q)^(2/3)\], which starts with 5 q^3/162.
fn loop_shape(q: f64) -> f64 {
    /// Below it the series is more accurate than the difference, which cancels.
    const SMALL: f64 = 0.1;
    if q > SMALL {
        let rest = (1.0 - q).max(0.0).cbrt();
        return 1.0 - rest.powi(5) - 5.0 * q / 6.0 * (1.0 + rest * rest);
    }
    // Coefficients of (1 - q)^(5/3) and, of the power before, (1 - q)^(2/3).
    let (mut five, mut two) = (5.0 / 9.0, -2.0 / 3.0);
    let (mut sum, mut power) = (0.0, q * q);
    for k in 3..20 {
        let n = f64::from(k);
        five *= (n - 1.0 - 5.0 / 3.0) / n;
        two *= (n - 2.0 - 2.0 / 3.0) / (n - 1.0);
        power *= q;
        sum -= (five + 5.0 / 6.0 * two) * power;
    }
    sum
}
