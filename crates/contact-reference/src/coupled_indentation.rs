//! Indentation with friction of dissimilar bodies, normal and tangential directions fully coupled.

use std::f64::consts::PI;

use contact_core::hertz::elliptic_integrals;
use contact_core::linear_system::solve;
use ndarray::Array2;

/// Cells in the stick circle, and as many in the slip annulus.
const CELLS: usize = 100;

/// The self-similar contact of a sphere with friction during indentation: numbers that do not
/// depend on the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledIndentation {
    /// Stick radius over contact radius, c/a.
    pub stick_ratio: f64,
    /// Central pressure over Hertz's for the same force and contact radius, 3 W/(2 pi a^2).
    pub p0: f64,
    /// Approach over a^2/R.
    pub delta_z: f64,
    /// Normal force over Hertz's for the same contact radius, 4 E* a^3/(3 R).
    pub W: f64,
}

/// Rates of the tractions while the contact grows, as Abel transforms on graded cells of (0, 1).
struct Rates {
    /// Cell bounds.
    edges: Vec<f64>,
    /// Pressure: dp/da = f(1)/sqrt(1 - r^2) - int_r^1 f'(t)/sqrt(t^2 - r^2) dt.
    f: Vec<f64>,
    /// Radial shear: dq/da = -d/dr int_r^1 g(s)/sqrt(s^2 - r^2) ds.
    g: Vec<f64>,
}

/// The contact of bodies with Dundurs' parameter `beta` (its sign does not matter) and friction
/// `mu` > 0.
///
/// The problem is D. A. Spence's (J. Elasticity 5 (1975) 297); the equations are derived here. The
/// contact grows without changing its shape, so the rates of the tractions by the contact radius
/// solve a flat-punch problem with a stick circle of fixed c/a. As Abel transforms f, g (lengths
/// over a, displacements over A, A = (1 - nu1)/G1 + (1 - nu2)/G2) the rates satisfy, f even, g odd,
///
/// f(t) - (beta/pi) PV int_(-1)^1 g(s)/(s - t) ds = 1 (the sphere moves in), g(s) + (beta/pi) PV
/// int_(-1)^1 f(t)/(t - s) dt = 0 for s < c (no change of strain), g(s) = mu \[f(s) + int_s^1 f(t)
/// dG/dt dt\], G = (2 s/(pi t)) K(sqrt(1 - s^2/t^2)), for s > c (slip),
///
/// and c follows from g being continuous there. Collocation on 200 graded cells; p0, delta_z and W
/// are within 1e-4, c/a within 5e-5 of the limit of fine cells.
pub fn coupled_indentation(beta: f64, mu: f64) -> CoupledIndentation {
    let beta = beta.abs();
    // The jump of g at c changes its sign once; seven digits of c are more than the cells give.
    let (mut low, mut high) = (1e-3, 1.0 - 1e-6);
    while high - low > 1e-7 {
        let c = f64::midpoint(low, high);
        if Rates::new(beta, mu, c).jump() > 0.0 {
            low = c;
        } else {
            high = c;
        }
    }
    let c = f64::midpoint(low, high);
    Rates::new(beta, mu, c).summary(c)
}

impl Rates {
    /// Sets up the equations for the stick ratio c.
    fn new(beta: f64, mu: f64, c: f64) -> Self {
        let edges = graded(c);
        let n = edges.len() - 1;
        let middle: Vec<f64> = edges
            .windows(2)
            .map(|e| f64::midpoint(e[0], e[1]))
            .collect();
        let slopes: Vec<_> = (0..n).map(|j| slope_weights(&middle, j)).collect();
        let pull = beta / PI;
        let mut matrix = Array2::<f64>::zeros((2 * n, 2 * n));
        let mut right = Array2::zeros((2 * n, 1));
        for i in 0..n {
            let t = middle[i];
            right[[i, 0]] = 1.0;
            matrix[[i, i]] += 1.0;
            matrix[[n + i, n + i]] += 1.0;
            let sticks = i < CELLS;
            for j in 0..n {
                // The mirror image of the cell on s < 0 is the second part.
                let (value, slope) = hilbert(&edges, j, t);
                let (mirrored, mirrored_slope) = hilbert(&edges, j, -t);
                matrix[[i, n + j]] -= pull * (value + mirrored);
                for (k, weight) in &slopes[j] {
                    matrix[[i, n + k]] -= pull * weight * (slope + mirrored_slope);
                }
                if sticks {
                    matrix[[n + i, j]] += pull * (value - mirrored);
                    for (k, weight) in &slopes[j] {
                        matrix[[n + i, *k]] += pull * weight * (slope - mirrored_slope);
                    }
                }
            }
            if !sticks {
                let G = |bound: f64| 2.0 * t / (PI * bound) * elliptic_integrals(t / bound).K;
                matrix[[n + i, i]] -= mu * G(edges[i + 1]);
                for j in i + 1..n {
                    matrix[[n + i, j]] -= mu * (G(edges[j + 1]) - G(edges[j]));
                }
            }
        }
        let rates = solve(&matrix, &right);
        Self {
            edges,
            f: rates.column(0).iter().take(n).copied().collect(),
            g: rates.column(0).iter().skip(n).copied().collect(),
        }
    }

    /// The middle of cell i.
    fn middle(&self, i: usize) -> f64 {
        f64::midpoint(self.edges[i], self.edges[i + 1])
    }

    /// g just outside less g just inside the stick circle, by straight lines through two cells.
    fn jump(&self) -> f64 {
        let at = CELLS;
        let c = self.edges[at];
        let line = |i: usize, j: usize| {
            let (x, y) = (self.middle(i), self.middle(j));
            self.g[i] + (self.g[j] - self.g[i]) * (c - x) / (y - x)
        };
        line(at, at + 1) - line(at - 1, at - 2)
    }

    /// The numbers of the solution at the stick ratio c.
    fn summary(&self, c: f64) -> CoupledIndentation {
        let cells = || (0..self.f.len()).map(|i| (i, self.middle(i)));
        // f is even: its value in the middle from the first two cells.
        let (t0, t1) = (self.middle(0).powi(2), self.middle(1).powi(2));
        let f0 = (self.f[0] * t1 - self.f[1] * t0) / (t1 - t0);
        let (mut total, mut outside, mut central) = (0.0, 0.0, f0);
        for (i, t) in cells() {
            let (a, b) = (self.edges[i], self.edges[i + 1]);
            total += self.f[i] * (b - a);
            // The surface outside, where the contact will be: int_1^inf u_z(r) r^-3 dr.
            let root = ((1.0 - t) * (1.0 + t)).sqrt();
            outside += self.f[i] * (b - a) * (t.asin() - t * root) / (2.0 * t.powi(3));
            // dp/da(0) = f(0) - int (f - f(0))/t^2 dt.
            central -= (self.f[i] - f0) / (t * t) * (b - a);
        }
        // u_z = delta_z - r^2/(2 R) for every contact radius: 1/(2 R) over A.
        let curvature = PI / 4.0 - outside;
        CoupledIndentation {
            stick_ratio: c,
            p0: central / total,
            delta_z: PI / 8.0 / curvature,
            W: 2.0 * PI * total / (16.0 * curvature),
        }
    }
}

/// PV int of 1/(s - t) and of (s - m)/(s - t) over cell `j` with middle m.
fn hilbert(edges: &[f64], j: usize, t: f64) -> (f64, f64) {
    let (a, b) = (edges[j], edges[j + 1]);
    let value = ((b - t) / (a - t)).abs().ln();
    (value, (b - a) + (t - f64::midpoint(a, b)) * value)
}

/// Weights of the slope in cell `j`: the parabola through three middles of its own region.
fn slope_weights(middle: &[f64], j: usize) -> [(usize, f64); 3] {
    let first = if j < CELLS { 0 } else { CELLS };
    let left = j.clamp(first + 1, first + CELLS - 2) - 1;
    let x = |i: usize| middle[left + i];
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(i, k, l)| {
        let weight = (2.0 * middle[j] - x(k) - x(l)) / ((x(i) - x(k)) * (x(i) - x(l)));
        (left + i, weight)
    })
}

/// Cell bounds on (0, c) and (c, 1), refined towards c and 1 as cosines are.
fn graded(c: f64) -> Vec<f64> {
    let n = CELLS as f64;
    let inner = (0..CELLS).map(|i| c * (PI * i as f64 / (2.0 * n)).sin());
    let outer = (0..=CELLS).map(|i| c + (1.0 - c) * (1.0 - (PI * i as f64 / n).cos()) / 2.0);
    inner.chain(outer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Full stick has a closed form: f = A cos(eps L), g = A sin(eps L), L = ln\[(1 + t)/(1 - t)\],
    /// tanh(pi eps) = beta; the rates give W's rate A pi eps/sinh(pi eps) and the central
    /// pressure's A pi eps/beta (V. I. Mossakovskii's punch).
    #[test]
    fn strong_friction_leads_to_full_stick() {
        for beta in [0.1, 2.0 / 7.0] {
            let contact = coupled_indentation(beta, 8.0 * beta);
            let limit = f64::atanh(beta).sinh() / beta;
            assert!(1.0 - contact.stick_ratio < 1e-4);
            assert!((contact.p0 - limit).abs() < 5e-5, "{contact:?} {limit}");
        }
    }

    #[test]
    fn weak_coupling_leads_to_goodman() {
        for ratio in [0.3, 0.5, 1.0, 2.0] {
            let beta = 1e-3;
            let contact = coupled_indentation(beta, ratio * beta);
            let c = super::super::goodman_stick_ratio(beta, ratio * beta);
            assert!((contact.stick_ratio - c).abs() < 5e-5, "{contact:?} {c}");
            // 1 - 1/n^2 remains of the quadratures on 200 cells.
            for one in [contact.p0, contact.delta_z, contact.W] {
                assert!((one - 1.0).abs() < 1e-4, "{contact:?}");
            }
        }
    }
}
