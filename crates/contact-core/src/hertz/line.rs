//! Parallel cylinders: Hertz, Cattaneo and McEwen in two dimensions (plane strain).

use std::f64::consts::PI;

/// Stress in the plane of the section \[Pa\], tension positive: s_xx, s_zz, s_xz. Plane strain adds
/// s_yy = nu (s_xx + s_zz).
pub type PlaneStress = [f64; 3];

/// Line contact of cylinders along y under a force per length.
///
/// K. L. Johnson, Contact Mechanics (1985), sec. 4.2(c).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineContact {
    /// Normal force per length W \[N/m\].
    pub W: f64,
    /// Half-width a \[m\], a^2 = 4 W R/(pi E*).
    pub a: f64,
    /// Peak pressure \[Pa\], 2 W/(pi a).
    pub p0: f64,
}

/// Hertz contact of cylinders of relative radius `R` \[m\] and contact modulus `E_star` \[Pa\]
/// under `W` \[N/m\].
pub fn line_contact(R: f64, E_star: f64, W: f64) -> LineContact {
    let a = (4.0 * W * R / (PI * E_star)).sqrt();
    LineContact {
        W,
        a,
        p0: 2.0 * W / (PI * a),
    }
}

impl LineContact {
    /// Approach relative to the points of the surfaces at the distance `far` \[m\] for the relative
    /// radius `R` \[m\]: a^2/(2 R) (ln(2 far/a) + 1/2), from the integral of ln(far/|x|) under p.
    pub fn approach(&self, R: f64, far: f64) -> f64 {
        self.a * self.a / (2.0 * R) * ((2.0 * far / self.a).ln() + 0.5)
    }

    /// Middle \[m\] of the stick zone under `T` > 0 and the strain `eps_x` of body 2 along x,
    /// brought up together with T: e = eps_x E* a/(2 mu p0). With similar bodies, plane strain and
    /// a bulk stress sigma_B this is a sigma_B/(4 mu p0); it holds while e + c <= a.
    ///
    /// D. Nowell, D. A. Hills, Int. J. Mech. Sci. 29 (1987) 355-365.
    pub fn stick_middle(&self, eps_x: f64, E_star: f64, mu: f64) -> f64 {
        eps_x * E_star * self.a / (2.0 * mu * self.p0)
    }

    /// Shear traction q_x(x) \[Pa\] under `T` \[N/m\] with the stick zone's middle at `e` \[m\]: mu
    /// times the pressure less the similar one on the stick zone. With e the stick zone's shift in
    /// steady rolling, a - c towards the leading edge, it is Carter's (F. W. Carter, Proc. R. Soc.
    /// A 112 (1926) 151-157).
    pub fn q_shifted(&self, x: f64, e: f64, T: f64, mu: f64) -> f64 {
        let c = self.stick_half_width(T, mu);
        let stuck = (c * c - (x - e) * (x - e)).max(0.0).sqrt() / self.a;
        T.signum() * mu * (self.p(x) - self.p0 * stuck)
    }

    /// Pressure at x \[Pa\], p0 sqrt(1 - x^2/a^2).
    pub fn p(&self, x: f64) -> f64 {
        self.p0 * (1.0 - (x / self.a).powi(2)).max(0.0).sqrt()
    }

    /// Stick half-width c \[m\] under the tangential force per length `T` \[N/m\] across the axis,
    /// c/a = sqrt(1 - |T|/(mu W)). C. Cattaneo (1938); Johnson, eq. (7.24).
    pub fn stick_half_width(&self, T: f64, mu: f64) -> f64 {
        self.a * (1.0 - T.abs() / (mu * self.W)).max(0.0).sqrt()
    }

    /// Shear traction q_x(x) \[Pa\] of the first loading to `T` \[N/m\]:
    /// mu p0 \[sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - x^2/c^2)\].
    pub fn q(&self, x: f64, T: f64, mu: f64) -> f64 {
        let c = self.stick_half_width(T, mu);
        let stuck = (c * c - x * x).max(0.0).sqrt() / self.a;
        T.signum() * mu * (self.p(x) - self.p0 * stuck)
    }

    /// Stress \[Pa\] at (x, z >= 0) \[m\] in partial slip under `T` \[N/m\] along +x on the body:
    /// the pressure's field and the difference of two shears.
    pub fn partial_slip_stress(&self, at: (f64, f64), T: f64, mu: f64) -> PlaneStress {
        self.partial_slip_stress_shifted(at, 0.0, T, mu)
    }

    /// Shear with the stick zone's middle at `e` \[m\], as in [`Self::q_shifted`]. A bulk stress
    /// adds to s_xx.
    pub fn partial_slip_stress_shifted(
        &self,
        (x, z): (f64, f64),
        e: f64,
        T: f64,
        mu: f64,
    ) -> PlaneStress {
        let c = self.stick_half_width(T, mu);
        let pressure = mcewen_pressure(self.p0, self.a, (x, z));
        let slip = mcewen_shear(mu * self.p0, self.a, (x, z));
        let stick = if c > 0.0 {
            mcewen_shear(mu * self.p0 * c / self.a, c, (x - e, z))
        } else {
            [0.0; 3]
        };
        std::array::from_fn(|i| pressure[i] + T.signum() * (slip[i] - stick[i]))
    }
}

/// The confocal coordinates m and n of McEwen at (x, z) below a contact of half-width `a` \[m\], n with the
/// sign of x, and m^2 + n^2.
fn confocal(a: f64, x: f64, z: f64) -> (f64, f64, f64) {
    let difference = a * a - x * x + z * z;
    let sum = difference.hypot(2.0 * x * z);
    let m = ((sum + difference).max(0.0) / 2.0).sqrt();
    let n = ((sum - difference).max(0.0) / 2.0).sqrt();
    // The product m n = x z restores what cancels in the smaller of the two.
    let (m, n) = if difference >= 0.0 && m > 0.0 {
        (m, x.abs() * z / m)
    } else if n > 0.0 {
        (x.abs() * z / n, n)
    } else {
        (m, n)
    };
    (m, n.copysign(x), sum)
}

/// Stress \[Pa\] at (x, z >= 0) \[m\] under the pressure `p0` sqrt(1 - x^2/a^2) on |x| < `a`.
///
/// E. McEwen, Phil. Mag. 40 (1949) 454; Johnson, eq. (4.49).
pub fn mcewen_pressure(p0: f64, a: f64, (x, z): (f64, f64)) -> PlaneStress {
    let (m, n, sum) = confocal(a, x, z);
    if sum == 0.0 {
        return [0.0; 3];
    }
    let rotation = (z * z + n * n) / sum;
    [
        -p0 / a * (m * (1.0 + rotation) - 2.0 * z),
        -p0 / a * m * (1.0 - rotation),
        -p0 / a * n * (m * m - z * z) / sum,
    ]
}

/// Stress \[Pa\] at (x, z >= 0) \[m\] under the shear traction q_x = `q0` sqrt(1 - x^2/a^2) on
/// |x| < `a` that acts on the body along +x. Johnson, sec. 7.1(a), with his sign of q reversed.
pub fn mcewen_shear(q0: f64, a: f64, (x, z): (f64, f64)) -> PlaneStress {
    let (m, n, sum) = confocal(a, x, z);
    if sum == 0.0 {
        return [-2.0 * q0 * x / a, 0.0, 0.0];
    }
    let [s_xx, _, s_xz] = mcewen_pressure(q0, a, (x, z));
    [
        q0 / a * (n * (2.0 - (z * z - m * m) / sum) - 2.0 * x),
        s_xz,
        s_xx,
    ]
}
