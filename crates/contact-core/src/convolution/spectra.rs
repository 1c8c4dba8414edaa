//! Real spectra of kernels of definite parity.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;
use realfft::RealFftPlanner;
use rustfft::num_complex::Complex64;

use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, Quadrant};
use crate::plan::Parity;
use crate::stop::unless;

/// One real spectrum S, k_y-major, shape (period_y/2 + 1, period_x/2 + 1); the transform of the
/// kernel is (-i)^n S with n the number of axes along which it is odd.
pub(crate) type Spectrum = Vec<f64>;

/// The spectra of the six independent coefficients, the inverse transform's factor included.
///
/// An empty spectrum stands for a coefficient that vanishes or is not asked for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spectra {
    pub(crate) xx: Spectrum,
    pub(crate) yy: Spectrum,
    pub(crate) zz: Spectrum,
    pub(crate) xy: Spectrum,
    pub(crate) xz: Spectrum,
    pub(crate) yz: Spectrum,
}

impl Spectra {
    /// Computes the spectra of influence coefficients on a domain of the given periods; without `coupling` the
    /// normal-tangential ones are left out. Fails when `stop` is raised.
    pub(crate) fn from_coefficients(
        c: &InfluenceCoefficients,
        period: (usize, usize),
        coupling: bool,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        use Parity::{Even, Odd};
        let transform = |q: &Quadrant, x, y| transform_quadrant(q, (x, y), period, stop);
        let transform_if_coupled = |q: &Quadrant, x, y| {
            if coupling {
                transform(q, x, y)
            } else {
                Ok(Spectrum::new())
            }
        };
        Ok(Self {
            xx: transform(&c.xx, Even, Even)?,
            yy: transform(&c.yy, Even, Even)?,
            zz: transform(&c.zz, Even, Even)?,
            xy: transform(&c.xy, Odd, Odd)?,
            xz: transform_if_coupled(&c.xz, Odd, Even)?,
            yz: transform_if_coupled(&c.yz, Even, Odd)?,
        })
    }
}

/// Computes the spectrum of a kernel from its values at the offsets >= 0, along x and then along y.
fn transform_quadrant(
    quadrant: &Quadrant,
    half: (Parity, Parity),
    period: (usize, usize),
    stop: &AtomicBool,
) -> Result<Spectrum, Error> {
    let (nx, ny) = quadrant.dim();
    if quadrant.is_empty() {
        return Ok(Spectrum::new());
    }
    let transformed_x =
        transform_by_parity(ny, nx, |j, i| quadrant[(i, j)], half.0, period.0, stop)?;
    let frequencies_x = period.0 / 2 + 1;
    let transformed_y = transform_by_parity(
        frequencies_x,
        ny,
        |k, j| transformed_x[j * frequencies_x + k],
        half.1,
        period.1,
        stop,
    )?;
    let frequencies_y = period.1 / 2 + 1;
    let norm = 1.0 / (period.0 * period.1) as f64;
    Ok((0..frequencies_y)
        .flat_map(|l| (0..frequencies_x).map(move |k| (k, l)))
        .map(|(k, l)| norm * transformed_y[k * frequencies_y + l])
        .collect())
}

/// Continues each of `lines` sequences `f(line, i)`, i < n, to i < 0 by their parity; returns the sums
/// of f cos(2 pi k i / period), or of f sin, for k = 0 to period/2.
fn transform_by_parity(
    lines: usize,
    n: usize,
    f: impl Fn(usize, usize) -> f64 + Sync,
    half: Parity,
    period: usize,
    stop: &AtomicBool,
) -> Result<Vec<f64>, Error> {
    let fft = RealFftPlanner::<f64>::new().plan_fft_forward(period);
    let frequencies = period / 2 + 1;
    let mut out = vec![0.0; lines * frequencies];
    let buffers = || {
        let scratch = vec![Complex64::default(); fft.get_scratch_len()];
        (
            vec![0.0; period],
            vec![Complex64::default(); frequencies],
            scratch,
        )
    };
    out.par_chunks_mut(frequencies)
        .enumerate()
        .try_for_each_init(buffers, |(real, spectrum, scratch), (line, out)| {
            unless(stop)?;
            real.fill(0.0);
            for i in 0..n {
                let value = f(line, i);
                match half {
                    Parity::Even => {
                        real[i] = value;
                        real[(period - i) % period] = value;
                    }
                    Parity::Odd if i > 0 => {
                        real[i] = value;
                        real[period - i] = -value;
                    }
                    Parity::Odd => {}
                }
            }
            fft.process_with_scratch(real, spectrum, scratch)
                .expect("buffers have the planned lengths");
            for (s, v) in out.iter_mut().zip(spectrum.iter()) {
                *s = match half {
                    Parity::Even => v.re,
                    Parity::Odd => -v.im,
                };
            }
            Ok(())
        })?;
    Ok(out)
}
