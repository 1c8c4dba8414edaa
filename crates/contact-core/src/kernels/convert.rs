//! Conversion of a user's frequency response to influence coefficients.
//!
//! The paper's method, eq. (9)-(13), for any response f(k_x, k_y) with f(-k) = conj f(k), isotropic
//! or not: the response is sampled, weighted with the transform of uniform traction on a cell and
//! transformed back. [`Conversion`] lists the wave vectors first, so that a whole table of samples can be
//! computed at once; [`convert`] is the short form.

use std::f64::consts::PI;

use ndarray::Array4;
use realfft::RealFftPlanner;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;

use crate::error::Error;
use crate::memory::fits;
use crate::scene::{Grid, MOST_ALIASES};
use quadrature::gauss;

/// The displacements u_x, u_y, u_z \[m/Pa\] (rows) under tractions exp(i(k_x x + k_y y)) q_x, q_y,
/// p (columns).
pub type SurfaceFrf = [[Complex64; 3]; 3];

/// Gauss nodes in angle and radius of the mean at zero frequency.
const MEAN: usize = 16;

/// Memory of a wave vector and the sample of the response at it \[bytes\].
const POINT: f64 = 200.0;

/// A conversion planned: grid, enlargement of the domain, order of the alias sums.
#[derive(Clone, Debug)]
pub struct Conversion {
    shape: (usize, usize),
    /// Number of cells of the enlarged domain.
    period: (usize, usize),
    /// Wave vectors to be sampled \[1/m\], with the number of the sum and the weight each has.
    points: Vec<Point>,
}

#[derive(Clone, Copy, Debug)]
struct Point {
    k: (f64, f64),
    /// m (period_y/2 + 1) + n for the frequency numbers m, n.
    index: usize,
    weight: f64,
}

impl Conversion {
    /// Plans a conversion on a domain `lambda` times as long as the grid, with the alias sums up to `aliases`.
    pub fn new(grid: &Grid, lambda: usize, aliases: usize) -> Result<Self, Error> {
        if lambda < 2 {
            let allowed = "2 or more: offsets reach over twice the grid";
            return Err(Error::invalid("lambda", lambda, allowed));
        }
        if aliases > MOST_ALIASES {
            let allowed = format!("0 to {MOST_ALIASES}");
            return Err(Error::invalid("aliases", aliases, allowed));
        }
        grid.check_alone()?;
        let sums = (2 * aliases + 1).pow(2) as f64;
        let frequencies = (lambda as f64).powi(2) * grid.cells() as f64 / 2.0;
        fits("the conversion", POINT * frequencies * sums)?;
        let period = (lambda * grid.nx, lambda * grid.ny);
        let step = (
            2.0 * PI / (period.0 as f64 * grid.dx),
            2.0 * PI / (period.1 as f64 * grid.dy),
        );
        let signed_frequency = |m: usize, n: usize| {
            if 2 * m > n {
                m as i64 - n as i64
            } else {
                m as i64
            }
        };
        let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
        let frequencies = period.1 / 2 + 1;
        let orders = -(aliases as i64)..=aliases as i64;
        let mut points = Vec::new();
        for (m, n) in (0..period.0).flat_map(|m| (0..frequencies).map(move |n| (m, n))) {
            let index = m * frequencies + n;
            for r in orders.clone() {
                for s in orders.clone() {
                    let m = signed_frequency(m, period.0) + r * period.0 as i64;
                    let n = n as i64 + s * period.1 as i64;
                    if (m, n) == (0, 0) {
                        points.extend(mean_nodes(step).map(|(k, weight)| Point {
                            k,
                            index,
                            weight,
                        }));
                        continue;
                    }
                    let phase = |m: i64, period: usize| PI * m as f64 / period as f64;
                    let weight = sinc(phase(m, period.0)) * sinc(phase(n, period.1));
                    let (k_x, k_y) = (m as f64 * step.0, n as f64 * step.1);
                    // The Nyquist frequency stands for both signs of k_x.
                    let nyquist = 2 * (index / frequencies) == period.0;
                    let signs: &[f64] = if nyquist { &[1.0, -1.0] } else { &[1.0] };
                    points.extend(signs.iter().map(|sign| Point {
                        k: (sign * k_x, k_y),
                        index,
                        weight: weight / signs.len() as f64,
                    }));
                }
            }
        }
        Ok(Self {
            shape: (grid.nx, grid.ny),
            period,
            points,
        })
    }

    /// The wave vectors (k_x, k_y) \[1/m\] at which the response is needed, never zero.
    pub fn wave_vectors(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.points.iter().map(|p| p.k)
    }

    /// The coefficients C_ij \[m/Pa\], shape (3, 3, 2 nx - 1, 2 ny - 1) with the offset (0, 0) in
    /// the middle, from the response at the wave vectors, in their order.
    ///
    /// # Panics
    /// If the numbers of samples and wave vectors differ.
    pub fn convert(&self, samples: &[SurfaceFrf]) -> Array4<f64> {
        assert_eq!(
            samples.len(),
            self.points.len(),
            "one sample per wave vector"
        );
        let (nx, ny) = self.shape;
        let (px, py) = self.period;
        let frequencies = py / 2 + 1;
        let along_x = FftPlanner::new().plan_fft_inverse(px);
        let along_y = RealFftPlanner::new().plan_fft_inverse(py);
        let norm = 1.0 / (px * py) as f64;
        let mut coefficients = Array4::zeros((3, 3, 2 * nx - 1, 2 * ny - 1));
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            // Lines along x, one per frequency k_y >= 0.
            let mut lines = vec![Complex64::default(); px * frequencies];
            for (point, sample) in self.points.iter().zip(samples) {
                let (m, n) = (point.index / frequencies, point.index % frequencies);
                lines[n * px + m] += sample[i][j] * point.weight;
            }
            along_x.process(&mut lines);
            let mut spectrum = along_y.make_input_vec();
            let mut real = along_y.make_output_vec();
            for a in 0..2 * nx - 1 {
                let x = (a + px + 1 - nx) % px;
                for (n, s) in spectrum.iter_mut().enumerate() {
                    *s = lines[n * px + x];
                }
                // Real by the symmetry of the response, up to rounding.
                spectrum[0].im = 0.0;
                if py.is_multiple_of(2) {
                    spectrum[frequencies - 1].im = 0.0;
                }
                along_y
                    .process(&mut spectrum, &mut real)
                    .expect("buffers have the planned lengths");
                for b in 0..2 * ny - 1 {
                    coefficients[(i, j, a, b)] = norm * real[(b + py + 1 - ny) % py];
                }
            }
        }
        coefficients
    }
}

/// Nodes and weights of the mean over the cell of the frequency plane around zero, for functions
/// singular like 1/k, on its half k_x > 0; the other half is the complex conjugate. The
/// imaginary part of the sum at zero is dropped, as for all samples there.
fn mean_nodes(step: (f64, f64)) -> impl Iterator<Item = ((f64, f64), f64)> {
    let (half_x, half_y) = (step.0 / 2.0, step.1 / 2.0);
    let corner = half_y.atan2(half_x);
    let sectors = [
        (-PI / 2.0, -corner),
        (-corner, 0.0),
        (0.0, corner),
        (corner, PI / 2.0),
    ];
    sectors.into_iter().flat_map(move |(from, to)| {
        gauss(MEAN).iter().flat_map(move |(t, weight_t)| {
            let (s, c) = (from + (to - from) * (1.0 + t) / 2.0).sin_cos();
            let reach = (half_x / c).min(half_y / s.abs());
            gauss(MEAN).iter().map(move |(r, weight_r)| {
                let k = reach * (1.0 + r) / 2.0;
                let weight = weight_t * (to - from) / 2.0 * weight_r * reach / 2.0 * k;
                ((k * c, k * s), weight / (2.0 * half_x * half_y))
            })
        })
    })
}

/// The coefficients of a user's frequency response `frf(k_x, k_y)`, in the form of
/// [`Conversion::convert`].
pub fn convert(
    mut frf: impl FnMut(f64, f64) -> SurfaceFrf,
    grid: &Grid,
    lambda: usize,
    aliases: usize,
) -> Result<Array4<f64>, Error> {
    let conversion = Conversion::new(grid, lambda, aliases)?;
    let samples: Vec<_> = conversion.wave_vectors().map(|(x, y)| frf(x, y)).collect();
    Ok(conversion.convert(&samples))
}
