//! Hamilton: stress in a half-space below a sphere that presses and slides.

use rustfft::num_complex::Complex64;

/// Stress \[Pa\], tension positive: s_xx, s_yy, s_zz, s_xy, s_xz, s_yz.
pub type Stress = [f64; 6];

/// A half-space loaded on r < a of its surface by Hertz's distribution sqrt(1 - r^2/a^2) of unit
/// peak, as pressure or as shear traction along x; z into the body.
///
/// G. M. Hamilton, Proc. Inst. Mech. Eng. C 197 (1983) 53, has these fields. Derived here anew and
/// without divisions by r, from the harmonic function
///
/// F = int sqrt(1 - r'^2/a^2) phi dA', phi = z ln(rho + z) - rho,
///
/// of which Boussinesq's and Cerruti's solutions are derivatives:
///
/// 2 pi s_xx = 2 nu F_zzz - (1 - 2 nu) F_xxz - z F_xxzz under the pressure,
/// 2 pi s_xx = 2 (1 + nu) F_xzz + 2 nu F_xxx - z F_xxxz under the shear,
///
/// and so on, as the code has them with s = x^2 + y^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzStress {
    /// Radius of the loaded circle \[m\].
    pub a: f64,
    /// Poisson's ratio.
    pub nu: f64,
}

impl HertzStress {
    /// Stress over p0 at (x, y, z >= 0) \[m\] under the pressure p0 sqrt(1 - r^2/a^2).
    pub fn pressure(&self, x: f64, y: f64, z: f64) -> Stress {
        let f = Derivatives::new(self.a, x, y, z);
        let loose = 1.0 - 2.0 * self.nu;
        let lateral = |x: f64| {
            2.0 * self.nu * f.zzz
                - loose * (2.0 * f.s_z + 4.0 * x * x * f.ss_z)
                - z * (2.0 * f.s_zz + 4.0 * x * x * f.ss_zz)
        };
        [
            lateral(x),
            lateral(y),
            f.zzz - z * f.zzzz,
            -4.0 * x * y * (loose * f.ss_z + z * f.ss_zz),
            -2.0 * x * z * f.s_zzz,
            -2.0 * y * z * f.s_zzz,
        ]
    }

    /// Stress over q0 at (x, y, z >= 0) \[m\] under the shear traction q_x = q0 sqrt(1 - r^2/a^2),
    /// which acts on the body along +x: s_xz = -q_x on the surface.
    pub fn shear(&self, x: f64, y: f64, z: f64) -> Stress {
        let f = Derivatives::new(self.a, x, y, z);
        let nu = self.nu;
        // d^3/(dx du dv) of a function of s is 4 (sum) f_ss + 8 (product) f_sss.
        let third = |sum: f64, product: f64| {
            2.0 * nu * (4.0 * sum * f.ss + 8.0 * product * f.sss)
                - z * (4.0 * sum * f.ss_z + 8.0 * product * f.sss_z)
        };
        [
            4.0 * (1.0 + nu) * x * f.s_zz + third(3.0 * x, x.powi(3)),
            4.0 * nu * x * f.s_zz + third(x, x * y * y),
            -2.0 * x * z * f.s_zzz,
            2.0 * y * f.s_zz + third(y, x * x * y),
            f.zzz - z * (2.0 * f.s_zz + 4.0 * x * x * f.ss_zz),
            -4.0 * x * y * z * f.ss_zz,
        ]
    }

    /// Stress \[Pa\] at (x, y, z) \[m\] under the peak pressure `p0` \[Pa\] of a sphere that drags
    /// the surface along +x with q_x = `mu` p.
    pub fn sliding(&self, p0: f64, mu: f64, (x, y, z): (f64, f64, f64)) -> Stress {
        let (pressure, shear) = (self.pressure(x, y, z), self.shear(x, y, z));
        std::array::from_fn(|i| p0 * (pressure[i] + mu * shear[i]))
    }
}

/// Derivatives of F/(2 pi) by s and z, named by their letters.
struct Derivatives {
    zzz: f64,
    zzzz: f64,
    s_z: f64,
    s_zz: f64,
    s_zzz: f64,
    ss: f64,
    ss_z: f64,
    ss_zz: f64,
    sss: f64,
    sss_z: f64,
}

impl Derivatives {
    /// Hertz's distribution is a sum of complex sources (derived),
    ///
    /// F = (pi/a) Re int_0^a (a^2 - t^2) phi(s, z + i t) dt,
    ///
    /// and two partial integrations close it: for K''' = g as functions of zeta = z + i t,
    ///
    /// Re int_0^a (a^2 - t^2) g dt = 2 Im K(z + i a) - 2 a Re K'(z + i a).
    ///
    /// So each derivative of F needs antiderivatives of phi along zeta: f_1' = phi, f_2' = f_1,
    /// f_3' = f_2, and their derivatives by s, which stay bounded on the axis.
    fn new(a: f64, x: f64, y: f64, z: f64) -> Self {
        let zeta = Complex64::new(z, a);
        // Written out, the imaginary part is +0 on the surface: the root then has the branch that
        // continues the field from inside the body. On the edge R vanishes and some derivatives
        // are infinite where z times them is zero; the smallest R keeps the product zero.
        let mut R = Complex64::new(x * x + y * y + z * z - a * a, 2.0 * a * z).sqrt();
        if R.norm() < 1e-12 * a {
            R = Complex64::new(1e-12 * a, 0.0);
        }
        let P = R + zeta;
        let log = P.ln();
        let (ratio, P2, P3) = (zeta / P, P * P, P * P * P);
        let closed = |K: Complex64, K_prime: Complex64| (K.im - a * K_prime.re) / a;

        let phi = zeta * log - R;
        let phi_s = -0.5 / P;
        let phi_ss = 0.25 / (R * P2);
        let f1_s = -0.25 * (log + ratio);
        let f1_ss = -0.125 / P2;
        let f1_sss = 0.125 / (R * P3);
        let f2_s = -0.25 * phi - (R * R + R * zeta + zeta * zeta) / (12.0 * P);
        let f2_ss = (2.0 * R + zeta) / (24.0 * P2);
        let f2_sss = -1.0 / (24.0 * P3);
        let f3_ss = (3.0 * log + 5.0 * ratio - ratio * ratio) / 96.0;
        let f3_sss = (3.0 * R + zeta) / (192.0 * P3);
        Self {
            zzz: closed(phi, log),
            zzzz: closed(log, 1.0 / R),
            s_z: closed(f2_s, f1_s),
            s_zz: closed(f1_s, phi_s),
            s_zzz: closed(phi_s, 0.5 / (R * P)),
            ss: closed(f3_ss, f2_ss),
            ss_z: closed(f2_ss, f1_ss),
            ss_zz: closed(f1_ss, phi_ss),
            sss: closed(f3_sss, f2_sss),
            sss_z: closed(f2_sss, f1_sss),
        }
    }
}
