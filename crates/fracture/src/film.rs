//! Channel cracks and partial cracks of a film on a dissimilar half-plane.
//!
//! A crack normal to the surface of the film, in depth z with the interface at z = 1. Along it an
//! opening dislocation D at t has the normal stress 2 D/(z - t) in the infinite film; the free
//! surface adds 2 D (1/S - 6 z/S^2 + 4 z^2/S^3), S = z + t. Tractions on planes z = const split
//! into families that decay downwards and upwards, T = (Q, p) (amplitudes of shear and pressure of
//! the wave number k), whose normal stress is -2 Q - p and 2 Q - p; over a phase thickness x they
//! change by exp(-x) (1 + x \[-1 -1; 1 1\]) and exp(-x) (1 + x \[-1 1; -1 1\]). A dislocation sends
//! (-2 D, 0) both ways; the surface turns T into -T, the interface into \[m n; n m\] T, m =
//! -(alpha - beta^2)/(1 - beta^2), n = -beta (1 - alpha)/(1 - beta^2). The interface's first echo
//! is
//!
//! ```text
//! -2 D ((2m - n)/S + 3 (n - m) r_0/S^2 + (n - m) r/S^2 + 4 (m - n) r r_0/S^3),
//! ```
//!
//! r = 1 - z, r_0 = 1 - t, S = r + r_0; the later echoes decay like exp(-k) and are integrated over
//! k.

use ndarray::{Array1, Array2};

use super::Error;
use super::crack::k_of_density;
use super::lu::Lu;

/// Step of ln(distance) along the crack.
const STEP: f64 = 0.2;
/// Range of the logarithm of the distance to the surface, 4 exp(-20).
const TO_SURFACE: f64 = 20.0;
/// Energy release rate of a tip at the interface, where the density goes with the distance to the power of -s:
/// it takes 1/(1 - s) times the range. g changes by less than 1e-8 from 8 to 20.
const TO_INTERFACE: f64 = 10.0;
/// Largest range: exp(-690) is still a number of full precision.
const LARGEST_RANGE: f64 = 690.0;
/// Largest Dundurs' alpha in size: beyond it s nears 1.
const LARGEST_ALPHA: f64 = 0.99;

/// A film on a half-plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    alpha: f64,
    m: f64,
    n: f64,
}

/// A place along the crack: depth, distance from the interface, weight of the dislocation there.
#[derive(Clone, Copy, Debug)]
struct Place {
    z: f64,
    r: f64,
    weight: f64,
}

impl Film {
    /// Dundurs' parameters, alpha = (E_1 - E_2)/(E_1 + E_2) of the plane moduli, positive for a
    /// film stiffer than what it lies on, and beta = ((1 - 2 nu_2)/G_2 - (1 - 2 nu_1)/G_1)/ (2 (1 -
    /// nu_2)/G_2 + 2 (1 - nu_1)/G_1).
    pub fn new(alpha: f64, beta: f64) -> Result<Self, Error> {
        if !(alpha.abs() <= LARGEST_ALPHA) {
            return Err(Error::invalid("alpha", alpha, "-0.99 to 0.99"));
        }
        let (low, high) = ((alpha - 1.0) / 4.0, (alpha + 1.0) / 4.0);
        // nu in 0..1/2; half of it for nu in -1..1/2 would be (alpha -+ 1)/2.
        if !(beta >= 2.0 * low && beta <= 2.0 * high) {
            let allowed = format!("{} to {} at alpha = {alpha}", 2.0 * low, 2.0 * high);
            return Err(Error::invalid("beta", beta, allowed));
        }
        let square = 1.0 - beta * beta;
        Ok(Self {
            alpha,
            m: -(alpha - beta * beta) / square,
            n: -beta * (1.0 - alpha) / square,
        })
    }

    /// Film with Young's modulus \[Pa\] and Poisson's ratio of the film and of what it lies on.
    pub fn from_moduli((E_1, nu_1): (f64, f64), (E_2, nu_2): (f64, f64)) -> Result<Self, Error> {
        let a = |E: f64, nu: f64| 2.0 * (1.0 + nu) * (1.0 - nu) / E;
        let b = |E: f64, nu: f64| (1.0 + nu) * (1.0 - 2.0 * nu) / E;
        let (a_1, a_2) = (a(E_1, nu_1), a(E_2, nu_2));
        let alpha = (a_2 - a_1) / (a_2 + a_1);
        Self::new(alpha, (b(E_2, nu_2) - b(E_1, nu_1)) / (a_1 + a_2))
    }

    /// g of a channel crack through the film: it releases (pi/2) g sigma^2 h/E' per area, sigma the
    /// stress of the film, h its thickness, E' = E/(1 - nu^2) its plane modulus.
    ///
    /// J. L. Beuth, Int. J. Solids Struct. 29 (1992) 1657-1675; J. W. Hutchinson, Z. Suo, Adv.
    /// Appl. Mech. 29 (1992) 63-191, whose Z = (pi/2) g.
    pub fn channel(&self) -> Result<f64, Error> {
        // The stress at a tip at the interface is less singular than r^-(1+alpha)/2.
        let slow = 2.0 / (1.0 - self.alpha.max(0.0));
        let (below, above) = ((TO_INTERFACE * slow).min(LARGEST_RANGE), TO_SURFACE);
        let count = ((below + above) / STEP).ceil() as usize;
        let place = |t: f64| {
            // z = 1/(1 + exp t), r = 1 - z.
            let (z, r) = (1.0 / (1.0 + t.exp()), 1.0 / (1.0 + (-t).exp()));
            Place {
                z,
                r,
                weight: STEP * z * r,
            }
        };
        let at = |n: f64| place(STEP * n - below);
        let from: Vec<_> = (0..count).map(|j| at(j as f64)).collect();
        let to: Vec<_> = (0..count).map(|k| at(k as f64 + 0.5)).collect();
        let density = self.solve(&from, &to)?;
        let moment = from.iter().zip(&density).map(|(p, d)| p.weight * p.z * d);
        Ok(8.0 * moment.sum::<f64>())
    }

    /// F of a crack with its tip in the film: K_I = F sigma sqrt(pi l) at the depth l = `depth`
    /// times the thickness of the film, in 0..1.
    pub fn partial(&self, depth: f64) -> Result<f64, Error> {
        if !(depth > 0.0 && depth < 0.9999) {
            return Err(Error::invalid(
                "depth of the tip over the thickness",
                depth,
                "in 0..0.9999",
            ));
        }
        let count = (TO_SURFACE / STEP).ceil() as usize;
        let place = |t: f64, part: f64| {
            // s = l (1 - w^2), w = tanh(t/2); ds over w = s dt.
            let z = depth / (0.5 * t).cosh().powi(2);
            Place {
                z,
                r: 1.0 - z,
                weight: STEP * part * z,
            }
        };
        let half = |j: usize| if j == 0 { 0.5 } else { 1.0 };
        let from: Vec<_> = (0..count)
            .map(|j| place(STEP * j as f64, half(j)))
            .collect();
        let to = (0..count).map(|k| place(STEP * (k as f64 + 0.5), 1.0));
        let density = self.solve(&from, &to.collect::<Vec<_>>())?;
        Ok(k_of_density() * density[0] / std::f64::consts::PI.sqrt())
    }

    /// The density of dislocations of a crack under unit tension.
    fn solve(&self, from: &[Place], to: &[Place]) -> Result<Array1<f64>, Error> {
        let (m, n) = (self.m, self.n);
        let mut matrix = self.echoes(from, to);
        for (k, at) in to.iter().enumerate() {
            for (j, d) in from.iter().enumerate() {
                let apart = if at.r < 0.5 { d.r - at.r } else { at.z - d.z };
                let S = at.z + d.z;
                let surface = 1.0 / S - 6.0 * at.z / (S * S) + 4.0 * at.z * at.z / (S * S * S);
                let (r, r_0) = (at.r, d.r);
                let S = r + r_0;
                let echo = (2.0 * m - n) / S
                    + (n - m) * ((3.0 * r_0 + r) / S) / S
                    + 4.0 * (m - n) * (r / S) * (r_0 / S) / S;
                matrix[[k, j]] += 2.0 / apart + 2.0 * surface - 2.0 * echo;
                matrix[[k, j]] *= d.weight;
            }
        }
        let unit = Array1::from_elem(to.len(), -1.0);
        let factors = Lu::new(matrix).ok_or_else(|| Error::Singular {
            length: 1.0,
            why: "the film's crack".into(),
        })?;
        Ok(factors.solve(&unit))
    }

    /// The stress between places by all reflections at surface and interface after the first ones.
    fn echoes(&self, from: &[Place], to: &[Place]) -> Array2<f64> {
        let down = |x: f64, [Q, p]: [f64; 2]| {
            let e = (-x).exp();
            [e * (Q - x * (Q + p)), e * (p + x * (Q + p))]
        };
        let up = |x: f64, [Q, p]: [f64; 2]| {
            let e = (-x).exp();
            [e * (Q - x * (Q - p)), e * (p - x * (Q - p))]
        };
        let turned = |[Q, p]: [f64; 2]| [self.m * Q + self.n * p, self.n * Q + self.m * p];
        let nodes = wave_numbers();
        let (mut left, mut right) = (
            Array2::zeros((to.len(), 4 * nodes.len())),
            Array2::zeros((4 * nodes.len(), from.len())),
        );
        for (i, (k, weight)) in nodes.iter().enumerate() {
            for (row, at) in to.iter().enumerate() {
                for (c, unit) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                    let [Q, p] = down(k * at.z, unit);
                    left[[row, 4 * i + c]] = weight * (-2.0 * Q - p);
                    let [Q, p] = up(k * at.r, unit);
                    left[[row, 4 * i + 2 + c]] = weight * (2.0 * Q - p);
                }
            }
            // One round trip from the surface on: d = -P_u R P_d d + first.
            let trip = |d: [f64; 2]| up(*k, turned(down(*k, d)));
            let (a, b) = (trip([1.0, 0.0]), trip([0.0, 1.0]));
            let M = [[1.0 + a[0], b[0]], [a[1], 1.0 + b[1]]];
            let det = M[0][0] * M[1][1] - M[0][1] * M[1][0];
            for (column, d) in from.iter().enumerate() {
                let first = up(k * d.z, [-2.0, 0.0]).map(|t| -t);
                let echo = turned(down(k * d.r, [-2.0, 0.0]));
                let arrived = up(*k, echo);
                let right_side = [first[0] - arrived[0], first[1] - arrived[1]];
                let at_surface = [
                    (M[1][1] * right_side[0] - M[0][1] * right_side[1]) / det,
                    (M[0][0] * right_side[1] - M[1][0] * right_side[0]) / det,
                ];
                let later = [at_surface[0] - first[0], at_surface[1] - first[1]];
                let back = turned(down(*k, at_surface));
                let values = [later[0], later[1], back[0], back[1]];
                for (c, value) in values.into_iter().enumerate() {
                    right[[4 * i + c, column]] = value;
                }
            }
        }
        left.dot(&right)
    }
}

/// Nodes and weights of the integral over the wave number k from 0 to 60/h, on panels that double from 1e-3/h.
fn wave_numbers() -> Vec<(f64, f64)> {
    const RULE: [(f64, f64); 5] = [
        (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_4),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
    ];
    let mut nodes = Vec::new();
    let (mut low, mut high) = (0.0, 1e-3);
    while low < 60.0 {
        let (middle, half) = (f64::midpoint(low, high), (high - low) / 2.0);
        for (u, w) in RULE {
            nodes.push((middle - half * u, half * w));
            nodes.push((middle + half * u, half * w));
        }
        (low, high) = (high, (2.0 * high).min(high + 6.0));
    }
    nodes
}
