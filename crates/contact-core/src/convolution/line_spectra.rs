//! The spectra in the order in which the lines use them.

use std::sync::atomic::AtomicBool;

use super::Spectra;
use super::precision::Precision;
use super::spectra::Spectrum;
use crate::error::Error;
use crate::stop::unless;

/// Frequencies k_x that are worked on together.
pub(crate) const LANES: usize = 8;

/// Spectra of a group of kernels that are used together: (line, block of k_x, kernel, frequency
/// k_y of the line), [`LANES`] frequencies k_x each, so that a product reads memory in one go.
#[derive(Clone, Debug, Default)]
struct Group<T> {
    values: Vec<[T; LANES]>,
    per_line: usize,
}

/// The spectra of the six coefficients by line.
///
/// A line has one frequency k_y, or the two 2 l and 2 l + 1 in a mirror-symmetric scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineSpectra<T> {
    tangential: Group<T>,
    normal: Group<T>,
    coupling: Group<T>,
}

/// The kernels that act on one line; a group is empty where its kernels vanish.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineKernels<'a, T> {
    /// xx, yy, xy
    pub(crate) tangential: &'a [[T; LANES]],
    /// zz
    pub(crate) normal: &'a [[T; LANES]],
    /// xz, yz
    pub(crate) coupling: &'a [[T; LANES]],
}

impl<T: Precision> LineSpectra<T> {
    /// Arranges the spectra: `row` numbers per frequency k_y, divided by `unit`; lines of two frequencies if `mirrored`.
    /// Fails when `stop` is raised.
    pub(crate) fn new(
        s: &Spectra,
        row: usize,
        mirrored: bool,
        unit: f64,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let group = |spectra: &[&Spectrum]| Group::new(spectra, row, mirrored, unit, stop);
        Ok(Self {
            tangential: group(&[&s.xx, &s.yy, &s.xy])?,
            normal: group(&[&s.zz])?,
            coupling: group(&[&s.xz, &s.yz])?,
        })
    }

    /// The kernels of one line of constant k_y.
    pub(crate) fn kernels_of_line(&self, line: usize) -> LineKernels<'_, T> {
        LineKernels {
            tangential: self.tangential.values_of_line(line),
            normal: self.normal.values_of_line(line),
            coupling: self.coupling.values_of_line(line),
        }
    }
}

impl<T: Precision> Group<T> {
    /// Arranges spectra of the same kind as [`LineSpectra::new`] does; empty where there are none.
    fn new(
        spectra: &[&Spectrum],
        row: usize,
        mirrored: bool,
        unit: f64,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        if spectra.iter().any(|s| s.is_empty()) {
            return Ok(Self::default());
        }
        let blocks = row.div_ceil(LANES);
        let frequencies = spectra[0].len() / row;
        let kernels_per_line = if mirrored { 2 } else { 1 };
        let lines = frequencies.div_ceil(kernels_per_line);
        let mut values = Vec::with_capacity(lines * blocks * spectra.len() * kernels_per_line);
        for line in 0..lines {
            unless(stop)?;
            for block in 0..blocks {
                for spectrum in spectra {
                    for l in 0..kernels_per_line {
                        // The last line may have one frequency only, the last block fewer.
                        let k_y = line * kernels_per_line + l;
                        let value_at = |i: usize| {
                            let k_x = block * LANES + i;
                            let inside = k_x < row && k_y < frequencies;
                            if inside {
                                T::from_double(spectrum[k_y * row + k_x] / unit)
                            } else {
                                T::zero()
                            }
                        };
                        values.push(std::array::from_fn(value_at));
                    }
                }
            }
        }
        Ok(Self {
            per_line: blocks * spectra.len() * kernels_per_line,
            values,
        })
    }

    /// The blocks of kernel values of a line.
    fn values_of_line(&self, line: usize) -> &[[T; LANES]] {
        &self.values[line * self.per_line..(line + 1) * self.per_line]
    }
}
