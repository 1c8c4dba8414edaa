//! Convolution directly with the frequency response: the method the paper compares with.
//!
//! T. Nogi, T. Kato, J. Tribology 119 (1997) 493-500 (the paper's reference \[15\]): no influence
//! coefficients at all; the tractions are transformed on a domain lambda times as long as the
//! grid, multiplied by the response and transformed back, in every iteration. The periodic images
//! of the load remain in the answer and fade slowly with lambda.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use super::{Convolutions, Displacements, Spectra, SpectralProduct, SurfaceOperator, Tractions};
use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, SampledFrf, Stack};
use crate::plan::Mirror;
use crate::scene::{Body, Grid};
use crate::stop::{NOBODY, unless};

/// The frequency-domain operator.
pub struct FrequencyDomain {
    shape: (usize, usize),
    product: SpectralProduct<f64>,
    coupled: bool,
    self_coefficients: (f64, f64),
}

impl FrequencyDomain {
    /// Builds the operator of bodies 1 and 2 on a domain enlarged `lambda` times; without `coupling` the
    /// normal-tangential responses are taken as zero. `coefficients` belong to the pair.
    pub fn new(
        bodies: (&Body, &Body),
        grid: &Grid,
        lambda: usize,
        coupling: bool,
        coefficients: &InfluenceCoefficients,
    ) -> Self {
        let stop = AtomicBool::new(false);
        Self::new_unless_stopped(bodies, grid, lambda, coupling, coefficients, &stop).expect(NOBODY)
    }

    /// Builds the operator as [`Self::new`] does; fails when `stop` is raised.
    pub(crate) fn new_unless_stopped(
        bodies: (&Body, &Body),
        grid: &Grid,
        lambda: usize,
        coupling: bool,
        coefficients: &InfluenceCoefficients,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let (stack1, stack2) = (Stack::new(bodies.0), Stack::new(bodies.1));
        let lower = SampledFrf::new(&stack2, grid, lambda, 0);
        let upper = SampledFrf::new(&stack1, grid, lambda, 0);
        let (px, py) = lower.period;
        let norm = 1.0 / (px * py) as f64;
        // A kernel odd along n axes has the transform (-i)^n times its spectrum; the coupling of
        // the two bodies subtracts, eq. (4).
        let sample = |n: usize, m: usize| {
            let (lower_sample, upper_sample) = (lower.sample(m, n), upper.sample(m, n));
            [
                norm * (lower_sample[0] + upper_sample[0]),
                norm * (lower_sample[1] + upper_sample[1]),
                norm * (lower_sample[2] + upper_sample[2]),
                -norm * (lower_sample[3] + upper_sample[3]),
                -norm * (lower_sample[4] - upper_sample[4]),
                -norm * (lower_sample[5] - upper_sample[5]),
            ]
        };
        let row = |n: usize| {
            unless(stop)?;
            Ok((0..=px / 2).map(|m| sample(n, m)).collect())
        };
        let rows: Vec<Vec<[f64; 6]>> = (0..=py / 2)
            .into_par_iter()
            .map(row)
            .collect::<Result<_, Error>>()?;
        let samples = rows.concat();
        // A real field has no part of the highest frequency that is odd along its axis.
        let parity = [
            (false, false),
            (false, false),
            (false, false),
            (true, true),
            (true, false),
            (false, true),
        ];
        let spectrum = |c: usize| {
            let vanishes = |index: usize| {
                let (n, m) = (index / (px / 2 + 1), index % (px / 2 + 1));
                (parity[c].0 && 2 * m == px) || (parity[c].1 && 2 * n == py)
            };
            (samples.iter().enumerate())
                .map(|(i, s)| if vanishes(i) { 0.0 } else { s[c] })
                .collect()
        };
        let spectrum_if_coupled = |c: usize| if coupling { spectrum(c) } else { Vec::new() };
        let spectra = Spectra {
            xx: spectrum(0),
            yy: spectrum(1),
            zz: spectrum(2),
            xy: spectrum(3),
            xz: spectrum_if_coupled(4),
            yz: spectrum_if_coupled(5),
        };
        let shape = (grid.nx, grid.ny);
        Ok(Self {
            shape,
            product: SpectralProduct::new(shape, Mirror::None, &spectra, (px, py), stop)?,
            coupled: coupling,
            self_coefficients: coefficients.self_coefficients(),
        })
    }
}

impl SurfaceOperator for FrequencyDomain {
    fn shape(&self) -> (usize, usize) {
        self.shape
    }

    fn apply(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        self.product.apply(tractions, displacements);
    }

    fn work(&self) -> Convolutions {
        Convolutions::from_components(self.product.transforms)
    }

    fn is_coupled(&self) -> bool {
        self.coupled
    }

    fn self_coefficients(&self) -> (f64, f64) {
        self.self_coefficients
    }
}
