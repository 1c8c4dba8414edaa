//! The paper's conversion, eq. (9)-(13): inverse transform on an enlarged domain.
//!
//! Every sample has a definite parity, so that sine and cosine sums are sufficient: along y first, of which
//! the ny offsets of the grid are kept, then along x.

use ndarray::Array2;
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner};
use rustfft::num_complex::Complex64;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::coefficients::ODD;
use super::layered_frf::Stack;
use super::sampled_frf::SampledFrf;
use super::{InfluenceCoefficients, Quadrant};
use crate::error::Error;
use crate::scene::Grid;
use crate::stop::unless;

/// The coefficients by inverse transform on a domain `lambda` times as long. Fails when `stop` is
/// raised.
pub(crate) fn inverse_fft(
    stack: &Stack,
    grid: &Grid,
    (lambda, aliases): (usize, usize),
    stop: &AtomicBool,
) -> Result<InfluenceCoefficients, Error> {
    let samples = SampledFrf::new(stack, grid, lambda, aliases);
    let (px, py) = samples.period;
    let (nx, ny) = (grid.nx, grid.ny);
    let mut planner = RealFftPlanner::new();
    let along_y = Inverse(planner.plan_fft_inverse(py));
    let along_x = Inverse(planner.plan_fft_inverse(px));

    // One line of 6 ny numbers per frequency k_x >= 0.
    let frequencies = px / 2 + 1;
    let mut transformed_along_y = vec![0.0; frequencies * 6 * ny];
    transformed_along_y
        .par_chunks_mut(6 * ny)
        .enumerate()
        .try_for_each_init(
            || (along_y.buffers(), vec![[0.0; 6]; py / 2 + 1]),
            |(buffers, line), (m, out)| {
                unless(stop)?;
                for (n, sample) in line.iter_mut().enumerate() {
                    *sample = samples.sample(m, n);
                }
                for ((out, odd), c) in out.chunks_mut(ny).zip(ODD).zip(0..) {
                    along_y.sum_frequencies(buffers, odd.1, |n| line[n][c], out);
                }
                Ok(())
            },
        )?;
    let norm = 1.0 / (px * py) as f64;
    let convert = |c: usize| -> Result<Quadrant, Error> {
        unless(stop)?;
        let mut columns = Array2::zeros((ny, nx));
        let slice: &mut [f64] = columns.as_slice_mut().expect("standard layout");
        slice.par_chunks_mut(nx).enumerate().for_each_init(
            || along_x.buffers(),
            |buffers, (j, out)| {
                along_x.sum_frequencies(
                    buffers,
                    ODD[c].0,
                    |m| transformed_along_y[(6 * m + c) * ny + j],
                    out,
                );
            },
        );
        // Sines come from i: i^2 for xy, i times the i of the response for xz and yz.
        let sign = if c < 3 { norm } else { -norm };
        let transposed = columns.reversed_axes();
        Ok(transposed.as_standard_layout().mapv(|v| sign * v))
    };
    Ok(InfluenceCoefficients {
        xx: convert(0)?,
        yy: convert(1)?,
        zz: convert(2)?,
        xy: convert(3)?,
        xz: convert(4)?,
        yz: convert(5)?,
    })
}

/// A planned sum over positive and negative frequencies.
struct Inverse(Arc<dyn ComplexToReal<f64>>);

/// Buffers of one thread.
struct Buffers {
    spectrum: Vec<Complex64>,
    real: Vec<f64>,
    scratch: Vec<Complex64>,
}

impl Inverse {
    /// Allocates the buffers of one thread.
    fn buffers(&self) -> Buffers {
        Buffers {
            spectrum: self.0.make_input_vec(),
            real: self.0.make_output_vec(),
            scratch: self.0.make_scratch_vec(),
        }
    }

    /// out_j = sum over all n of f_n cos(2 pi n j/N), or of f_n sin where f is odd.
    fn sum_frequencies(
        &self,
        b: &mut Buffers,
        odd: bool,
        f: impl Fn(usize) -> f64,
        out: &mut [f64],
    ) {
        for (n, s) in b.spectrum.iter_mut().enumerate() {
            *s = if odd {
                Complex64::new(0.0, -f(n))
            } else {
                Complex64::new(f(n), 0.0)
            };
        }
        self.0
            .process_with_scratch(&mut b.spectrum, &mut b.real, &mut b.scratch)
            .expect("buffers have the planned lengths and odd spectra vanish at their ends");
        out.copy_from_slice(&b.real[..out.len()]);
    }
}
