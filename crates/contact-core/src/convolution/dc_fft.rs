//! Discrete convolution by fast Fourier transforms on a doubled domain.

use std::sync::atomic::AtomicBool;

use super::good_size::fast_length;
use super::{Convolutions, Displacements, Spectra, SpectralProduct, SurfaceOperator, Tractions};
use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, norm};
use crate::plan::Mirror;
use crate::stop::NOBODY;

/// The DC-FFT operator: exact up to rounding for tractions that are constant on each cell.
///
/// S. Liu, Q. Wang, G. Liu, Wear 243 (2000) 101-111.
pub struct DcFft {
    shape: (usize, usize),
    product: SpectralProduct<f64>,
    single: Option<SpectralProduct<f32>>,
    rounding: f64,
    coupled: bool,
    self_coefficients: (f64, f64),
}

/// Largest error of a displacement in single precision, over the norms (roots of the sums of
/// squares) of the tractions and of a kernel. Transforms spread the error of each number over all
/// numbers, so that it does not cancel where tractions do.
const ROUNDING: f64 = 1e-7;

impl DcFft {
    /// Builds the operator of a pair of bodies. With [`Mirror::Y`] the fields cover the
    /// half y > 0; without `coupling` the normal-tangential kernels are taken as zero.
    pub fn new(coefficients: &InfluenceCoefficients, mirror: Mirror, coupling: bool) -> Self {
        Self::with_single(coefficients, mirror, coupling, false)
    }

    /// Builds the operator as [`Self::new`] does; if `single`, responses to changes are computed in single precision
    /// ([`SurfaceOperator::respond`]).
    pub fn with_single(
        coefficients: &InfluenceCoefficients,
        mirror: Mirror,
        coupling: bool,
        single: bool,
    ) -> Self {
        let stop = AtomicBool::new(false);
        Self::new_unless_stopped(coefficients, mirror, coupling, single, &stop).expect(NOBODY)
    }

    /// Builds the operator. `coupling` keeps the normal-tangential kernels; `single` adds spectra in f32, so
    /// that responses to changes are computed in single precision ([`SurfaceOperator::respond`]). Fails when
    /// `stop` is raised: [`Error::Interrupted`] after increment 0.
    pub fn new_unless_stopped(
        coefficients: &InfluenceCoefficients,
        mirror: Mirror,
        coupling: bool,
        single: bool,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let shape = coefficients.zz.dim();
        let period = (fast_length(2 * shape.0 - 1), fast_length(2 * shape.1 - 1));
        let spectra = Spectra::from_coefficients(coefficients, period, coupling, stop)?;
        let product = SpectralProduct::new(shape, mirror, &spectra, period, stop)?;
        let single = single.then(|| SpectralProduct::new(shape, mirror, &spectra, period, stop));
        Ok(Self {
            shape: (shape.0, mirror.rows(shape.1)),
            product,
            rounding: if single.is_some() {
                ROUNDING * largest_norm(coefficients) * mirror.multiplicity().sqrt()
            } else {
                0.0
            },
            single: single.transpose()?,
            coupled: coupling,
            self_coefficients: coefficients.self_coefficients(),
        })
    }
}

/// The largest norm of the influence coefficients of one pair of directions \[m/Pa\].
fn largest_norm(c: &InfluenceCoefficients) -> f64 {
    let kernels = [&c.xx, &c.yy, &c.zz, &c.xy, &c.xz, &c.yz];
    kernels.into_iter().map(norm).fold(0.0, f64::max)
}

impl SurfaceOperator for DcFft {
    fn shape(&self) -> (usize, usize) {
        self.shape
    }

    fn apply(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        self.product.apply(tractions, displacements);
    }

    /// Applies the kernels in single precision where the operator has them, otherwise in double precision.
    fn respond(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        match &mut self.single {
            Some(single) => single.apply(tractions, displacements),
            None => self.product.apply(tractions, displacements),
        }
    }

    fn rounding(&self) -> f64 {
        self.rounding
    }

    fn work(&self) -> Convolutions {
        let single = self.single.as_ref().map_or(0, |single| single.transforms);
        Convolutions::from_components(self.product.transforms + single)
    }

    fn is_coupled(&self) -> bool {
        self.coupled
    }

    fn self_coefficients(&self) -> (f64, f64) {
        self.self_coefficients
    }
}
