//! One-dimensional springs: the solution for every path of W and T, uncoupled and axisymmetric.

use contact_core::hertz::Hertz;
use contact_core::scene::Elastic;

use super::tangential_modulus;

/// Independent springs that carry, for a sphere, exactly the force-displacement relations of the
/// three-dimensional contact under any path (W, T): method of dimensionality reduction, V. L.
/// Popov, M. Hess, Facta Univ. Mech. Eng. 12 (2014) 1. Springs of stiffness E* dx and G_t dx, G_t =
/// 4 G*, under the profile x^2/R, each with Coulomb's law |f_x| <= mu f_z. Valid where
/// [`CattaneoMindlin`](super::CattaneoMindlin) is.
#[derive(Clone, Debug, PartialEq)]
pub struct Springs {
    /// Relative radius R \[m\].
    R: f64,
    /// Normal and tangential stiffness per length \[Pa\].
    E_star: f64,
    G_t: f64,
    mu: f64,
    /// Distance of the springs \[m\]; spring i stands at +-(i + 1/2) dx.
    dx: f64,
    /// Tangential force per length of each spring on x > 0 \[N/m\].
    f_x: Vec<f64>,
    /// Approach \[m\].
    delta_z: f64,
    /// Shift \[m\].
    delta_x: f64,
}

impl Springs {
    /// `n` unloaded springs on either side, up to the edge of the contact of `largest`.
    pub fn new(largest: Hertz, R: f64, body1: Elastic, body2: Elastic, mu: f64, n: usize) -> Self {
        Self {
            R,
            E_star: largest.E_star,
            G_t: 4.0 * tangential_modulus(body1, body2),
            mu,
            dx: largest.a / n as f64,
            f_x: vec![0.0; n],
            delta_z: 0.0,
            delta_x: 0.0,
        }
    }

    /// Shift delta_x \[m\].
    pub fn shift(&self) -> f64 {
        self.delta_x
    }

    /// Goes straight to the forces `W`, `T` \[N\] in `steps` steps and returns the shift \[m\]. The
    /// path starts from `from`, the forces reached before. |T| <= mu W throughout; at the limit
    /// the shift is the one at incipient sliding.
    pub fn load(&mut self, from: (f64, f64), to: (f64, f64), steps: usize) -> f64 {
        for step in 1..=steps {
            let s = step as f64 / steps as f64;
            self.step(from.0 + s * (to.0 - from.0), from.1 + s * (to.1 - from.1));
        }
        self.delta_x
    }

    /// Goes to the forces in one step. A spring that comes to bear in it has moved freely until then.
    fn step(&mut self, W: f64, T: f64) {
        let before = self.delta_z;
        let a = (3.0 * W * self.R / (4.0 * self.E_star)).cbrt();
        self.delta_z = a * a / self.R;
        // Per spring: force held, stiffness in this step, limit; all times 2 dx for both sides.
        let springs: Vec<(f64, f64, f64)> = self
            .f_x
            .iter()
            .enumerate()
            .map(|(i, &f)| {
                let x = (i as f64 + 0.5) * self.dx;
                let depth = self.delta_z - x * x / self.R;
                if depth <= 0.0 {
                    return (0.0, 0.0, 0.0);
                }
                let entered = x * x / self.R > before;
                let borne = if entered {
                    depth / (self.delta_z - before)
                } else {
                    1.0
                };
                (f, self.G_t * borne, self.mu * self.E_star * depth)
            })
            .collect();
        let force = |move_x: f64| -> f64 {
            springs
                .iter()
                .map(|&(f, k, limit)| (f + k * move_x).clamp(-limit, limit))
                .sum::<f64>()
                * 2.0
                * self.dx
        };
        // The limits of the springs add up to mu W without the last, half-covered spring.
        let reach = springs.iter().map(|s| s.2).sum::<f64>() * 2.0 * self.dx;
        let T = T.clamp(-reach, reach);
        let move_x = rising_root(|m| force(m) - T, T - force(0.0), &springs);
        for (f, &(held, k, limit)) in self.f_x.iter_mut().zip(&springs) {
            *f = (held + k * move_x).clamp(-limit, limit);
        }
        self.delta_x += move_x;
    }
}

/// The root nearest to zero of a piecewise linear, never falling function, by bisection between
/// zero and the move at which the last spring slips in the direction of `missing`.
fn rising_root(f: impl Fn(f64) -> f64, missing: f64, springs: &[(f64, f64, f64)]) -> f64 {
    if missing == 0.0 {
        return 0.0;
    }
    let s = missing.signum();
    let last = springs
        .iter()
        .filter(|(_, k, _)| *k > 0.0)
        .map(|&(held, k, limit)| (limit - s * held).max(0.0) / k)
        .fold(0.0, f64::max);
    let (mut near, mut far) = (0.0, last);
    while (far - near) > 1e-13 * last {
        let middle = f64::midpoint(near, far);
        if s * f(s * middle) < 0.0 {
            near = middle;
        } else {
            far = middle;
        }
    }
    s * far
}
