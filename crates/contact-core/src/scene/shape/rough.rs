//! Self-affine rough surfaces.

use std::f64::consts::TAU;

use ndarray::Array2;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;

use crate::error::Error;
use crate::scene::Grid;

/// A random surface whose power falls like k^-(2 + 2 H) between two wavelengths and is level above
/// the longer one (B. N. J. Persson et al., J. Phys.: Condens. Matter 17 (2005) R1).
///
/// It is a sum of waves that fit the grid, with phases drawn from the seed and wave numbers: the
/// same seed gives the same surface on every grid of the same size, however fine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rough {
    /// Root-mean-square height \[m\], exact over the grid.
    pub rms: f64,
    /// Hurst exponent H, above 0 and up to 1.
    pub hurst: f64,
    /// Wavelength up to which the surface is self-affine \[m\].
    pub longest: f64,
    /// Shortest wavelength \[m\], at least two cells.
    pub shortest: f64,
    /// Seed of the phases.
    pub seed: u32,
}

impl Rough {
    /// Drop below the mean plane, minus the heights, whose mean is zero \[m\].
    pub(crate) fn drop(&self, grid: &Grid) -> Array2<f64> {
        let (nx, ny) = (grid.nx, grid.ny);
        let (length_x, length_y) = grid.extent();
        let largest_wave_number = |length: f64| (length / self.shortest).floor() as i64;
        let mut spectrum = Array2::<Complex64>::zeros((nx, ny));
        let mut squares = 0.0;
        for m in 0..=largest_wave_number(length_x) {
            for n in -largest_wave_number(length_y)..=largest_wave_number(length_y) {
                // One of each pair of opposite waves.
                if m == 0 && n <= 0 {
                    continue;
                }
                let k = (m as f64 / length_x, n as f64 / length_y);
                let size = k.0.hypot(k.1);
                if size * self.shortest > 1.0 {
                    continue;
                }
                let amplitude = size.max(1.0 / self.longest).powf(-1.0 - self.hurst);
                squares += 0.5 * amplitude * amplitude;
                let phase_at_first_cell = k.0 * grid.x(0) + k.1 * grid.y(0);
                let phase = TAU * (hashed_uniform(self.seed, m, n) + phase_at_first_cell);
                let index = (m as usize % nx, n.rem_euclid(ny as i64) as usize);
                spectrum[index] += Complex64::from_polar(amplitude, phase);
            }
        }
        let heights = sum_of_waves(spectrum);
        let factor = if squares > 0.0 {
            self.rms / squares.sqrt()
        } else {
            0.0
        };
        heights.mapv(|z| -factor * z.re)
    }

    /// Fails at a number of the roughness out of its range; `key` is the key of the shape.
    pub(crate) fn check(&self, key: &str) -> Result<(), Error> {
        let refuse = |name: &str, value: f64, allowed: &str| {
            Err(Error::invalid(format!("{key}.{name}"), value, allowed))
        };
        let positive = |v: f64| v > 0.0 && v.is_finite();
        if !(self.rms >= 0.0 && self.rms.is_finite()) {
            return refuse("rms", self.rms, "a height >= 0 in m");
        }
        if !(self.hurst > 0.0 && self.hurst <= 1.0) {
            return refuse("hurst", self.hurst, "above 0 and up to 1");
        }
        if !positive(self.shortest) {
            return refuse("shortest", self.shortest, "a positive wavelength in m");
        }
        if !(positive(self.longest) && self.longest >= self.shortest) {
            return refuse(
                "longest",
                self.longest,
                "a wavelength in m, not below the shortest",
            );
        }
        Ok(())
    }

    /// Fails if the shortest wave is shorter than two cells.
    pub(crate) fn check_on(&self, grid: &Grid, key: &str) -> Result<(), Error> {
        let cell = grid.dx.max(grid.dy);
        if self.shortest >= 2.0 * cell * (1.0 - 1e-9) {
            return Ok(());
        }
        Err(Error::invalid(
            format!("{key}.shortest"),
            self.shortest,
            format!("at least two cells, {:e} m", 2.0 * cell),
        ))
    }
}

/// sum of F exp(2 pi i (m i/nx + n j/ny)) at the cells (i, j).
fn sum_of_waves(mut spectrum: Array2<Complex64>) -> Array2<Complex64> {
    let (nx, ny) = spectrum.dim();
    let mut planner = FftPlanner::new();
    let (along_x, along_y) = (planner.plan_fft_inverse(nx), planner.plan_fft_inverse(ny));
    for mut row in spectrum.rows_mut() {
        if let Some(row) = row.as_slice_mut() {
            along_y.process(row);
        }
    }
    for mut column in spectrum.columns_mut() {
        let mut buffer = column.to_vec();
        along_x.process(&mut buffer);
        column
            .iter_mut()
            .zip(buffer)
            .for_each(|(to, from)| *to = from);
    }
    spectrum
}

/// A number in [0, 1) that a seed and two wave numbers determine: the mixing function of SplitMix64
/// (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
fn hashed_uniform(seed: u32, m: i64, n: i64) -> f64 {
    let mix = |mut z: u64| {
        z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let bits = mix(mix(mix(u64::from(seed)) ^ m as u64) ^ n as u64);
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::Rough;
    use crate::scene::Grid;

    const ROUGH: Rough = Rough {
        rms: 2e-7,
        hurst: 0.8,
        longest: 3e-4,
        shortest: 6.25e-5,
        seed: 7,
    };

    #[test]
    fn the_rms_height_is_as_prescribed() {
        let grid = Grid::centred(1e-3, 64).expect("a grid");
        let z = ROUGH.drop(&grid);
        let mean = z.sum() / 4096.0;
        let rms = (z.mapv(|z| z * z).sum() / 4096.0).sqrt();
        assert!((rms / ROUGH.rms - 1.0).abs() < 1e-12 && mean.abs() < 1e-12 * rms);
        let other_surface = Rough { seed: 8, ..ROUGH }.drop(&grid);
        assert!((&other_surface - &z).mapv(f64::abs).sum() > 0.1 * z.mapv(f64::abs).sum());
    }

    #[test]
    fn a_finer_grid_has_the_same_surface() {
        // Every third cell of the fine grid has the centre of a coarse one.
        let (coarse, fine) = (Grid::centred(1e-3, 48), Grid::centred(1e-3, 144));
        let coarse = ROUGH.drop(&coarse.expect("a grid"));
        let fine = ROUGH.drop(&fine.expect("a grid"));
        for ((i, j), z) in coarse.indexed_iter() {
            assert!((z - fine[(3 * i + 1, 3 * j + 1)]).abs() < 1e-12 * 1e-6);
        }
    }
}
