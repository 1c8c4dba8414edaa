//! The frequency response at the points of an enlarged domain, eq. (9)-(11) of the paper.
//!
//! The displacement under uniform traction on one cell has the transform f(k) dx dy sinc(k_x dx/2)
//! sinc(k_y dy/2), f the frequency response. On a domain of lambda N cells it is sampled at the
//! frequencies 2 pi n/(lambda L); the terms beyond the Nyquist frequency, which the samples cannot
//! distinguish from those below it, are left out or added up to a given order (alias sums, S. Liu,
//! Q. Wang, G. Liu, Wear 243 (2000) 101-111). At zero frequency, where f is singular like 1/k, its
//! mean over the cell of the frequency plane stands for it (T. Nogi, T. Kato, J. Tribology 119
//! (1997) 493-500).

use std::f64::consts::PI;

use super::half_space::Six;
use super::layered_frf::{RadialResponse, Stack};
use crate::scene::Grid;
use quadrature::gauss;

/// Gauss nodes in angle and radius of the mean at zero frequency: exact to rounding.
const MEAN: usize = 16;

/// The samples of one stack's response on one domain.
pub(crate) struct SampledFrf<'a> {
    stack: &'a Stack,
    /// Number of cells of the enlarged domain.
    pub(crate) period: (usize, usize),
    /// Frequency steps \[1/m\].
    step: (f64, f64),
    aliases: i64,
}

impl<'a> SampledFrf<'a> {
    /// Prepares sampling on a domain `lambda` times as long as the grid, with alias sums up to `aliases`.
    pub(crate) fn new(stack: &'a Stack, grid: &Grid, lambda: usize, aliases: usize) -> Self {
        let period = (lambda * grid.nx, lambda * grid.ny);
        let step = |n: usize, d: f64| 2.0 * PI / (n as f64 * d);
        Self {
            stack,
            period,
            step: (step(period.0, grid.dx), step(period.1, grid.dy)),
            aliases: aliases as i64,
        }
    }

    /// The samples xx, yy, zz, xy \[m/Pa\] and xz, yz over i at the frequency number
    /// (m, n), 0 <= m <= lambda nx/2 and n alike; odd samples vanish at the Nyquist frequency.
    pub(crate) fn sample(&self, m: usize, n: usize) -> Six {
        let (m, n) = (m as i64, n as i64);
        let (px, py) = (self.period.0 as i64, self.period.1 as i64);
        let orders = || -self.aliases..=self.aliases;
        let mut sum = [0.0; 6];
        for (r, s) in orders().flat_map(|r| orders().map(move |s| (r, s))) {
            let (m, n) = (m + r * px, n + s * py);
            let (k_x, k_y) = (m as f64 * self.step.0, n as f64 * self.step.1);
            let (phase_x, phase_y) = (PI * m as f64 / px as f64, PI * n as f64 / py as f64);
            let term = if (m, n) == (0, 0) {
                self.mean_at_zero()
            } else {
                rotate_response(&self.stack.response(k_x.hypot(k_y)), k_x, k_y)
            };
            let shape = sinc(phase_x) * sinc(phase_y);
            for (sum, term) in sum.iter_mut().zip(term) {
                *sum += shape * term;
            }
        }
        let (nyquist_x, nyquist_y) = (2 * m == px, 2 * n == py);
        let odd_x = if m == 0 || nyquist_x { 0.0 } else { 1.0 };
        let odd_y = if n == 0 || nyquist_y { 0.0 } else { 1.0 };
        let [xx, yy, zz, xy, xz, yz] = sum;
        [xx, yy, zz, xy * odd_x * odd_y, xz * odd_x, yz * odd_y]
    }

    /// The mean of the response over the cell of the frequency plane around zero, eq. (11). In
    /// polar coordinates the 1/k drops out; the mean of the odd terms is zero.
    fn mean_at_zero(&self) -> Six {
        let (half_x, half_y) = (self.step.0 / 2.0, self.step.1 / 2.0);
        let corner = half_y.atan2(half_x);
        let mut sum = [0.0; 6];
        for (from, to) in [(0.0, corner), (corner, PI / 2.0)] {
            for (t, weight_t) in gauss(MEAN) {
                let angle = from + (to - from) * (1.0 + t) / 2.0;
                let (s, c) = angle.sin_cos();
                let radius = (half_x / c).min(half_y / s);
                for (r, weight_r) in gauss(MEAN) {
                    let k = radius * (1.0 + r) / 2.0;
                    let term = rotate_response(&self.stack.response(k), k * c, k * s);
                    let weight = weight_t * (to - from) / 2.0 * weight_r * radius / 2.0 * k;
                    for (sum, term) in sum.iter_mut().zip(term).take(3) {
                        *sum += weight * term;
                    }
                }
            }
        }
        sum.map(|v| v / (half_x * half_y))
    }
}

/// Rotates a response from the axes of the wave vector (k_x, k_y) to x and y: xx, yy, zz, xy, and the odd xz,
/// yz over i.
fn rotate_response(response: &RadialResponse, k_x: f64, k_y: f64) -> Six {
    let k = k_x.hypot(k_y);
    let (c, s) = (k_x / k, k_y / k);
    let RadialResponse { zz, rr, tt, rz } = *response;
    [
        rr * c * c + tt * s * s,
        rr * s * s + tt * c * c,
        zz,
        (rr - tt) * c * s,
        rz * c,
        rz * s,
    ]
    .map(|v| v / k)
}

/// sin(x)/x.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}
