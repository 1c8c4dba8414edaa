//! Stage 3: u = C * q, the displacement that tractions cause.
//!
//! The solvers use elasticity only through [`SurfaceOperator`]. [`DcFft`] computes it by
//! discrete convolution with transforms on a doubled domain (S. Liu, Q. Wang, G. Liu, Wear 243
//! (2000) 101-111); [`Direct`] sums cell by cell and exists to check the others.

mod complexes;
mod dc_fft;
mod direct;
mod frequency_domain;
mod good_size;
mod line_product;
mod line_spectra;
mod operator;
mod precision;
mod preconditioner;
mod spectra;
mod spectral_product;
mod work;
mod y_transform;

pub use dc_fft::DcFft;
pub use direct::Direct;
pub use frequency_domain::FrequencyDomain;
pub use good_size::fast_length;
pub(crate) use operator::{approximate_inverse, surface_operator};
pub use operator::{normal_operator, operator_of_bodies, scalar_operator};
pub use preconditioner::CirculantInverse;
pub(crate) use spectra::Spectra;
pub(crate) use spectral_product::{PARALLEL_FROM, SpectralProduct};
pub use work::Convolutions;

/// The tractions that act, each a field \[Pa\] in row-major (nx, ny) order; missing ones are
/// zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tractions<'a> {
    /// Shear traction on body 2 along x.
    pub q_x: Option<&'a [f64]>,
    /// Shear traction on body 2 along y.
    pub q_y: Option<&'a [f64]>,
    /// Pressure.
    pub p: Option<&'a [f64]>,
}

/// The relative displacements u = u(2) - u(1) to be computed \[m\]; missing ones are not computed.
#[derive(Debug, Default)]
pub struct Displacements<'a> {
    /// Along x.
    pub u_x: Option<&'a mut [f64]>,
    /// Along y.
    pub u_y: Option<&'a mut [f64]>,
    /// Along z, into body 2.
    pub u_z: Option<&'a mut [f64]>,
}

/// The linear response of the pair of bodies, eq. (2)-(4) of the paper: u = C * (q_x, q_y, p).
pub trait SurfaceOperator: Send + Sync {
    /// Shape (nx, ny) of the fields.
    fn shape(&self) -> (usize, usize);

    /// Computes the displacements requested under the given tractions.
    ///
    /// # Panics
    /// If a field does not have nx ny entries.
    fn apply(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>);

    /// Computes as [`Self::apply`] does, for a change of the tractions, of which some digits are enough: an
    /// operator with single precision errs by about 1e-7 of the largest displacement.
    ///
    /// # Panics
    /// If a field does not have nx ny entries.
    fn respond(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        self.apply(tractions, displacements);
    }

    /// Largest error of [`Self::respond`] in a displacement, over the root of the sum of squares of
    /// the tractions \[m/Pa\]; zero in double precision.
    fn rounding(&self) -> f64 {
        0.0
    }

    /// Work done so far.
    fn work(&self) -> Convolutions;

    /// Whether pressure moves the surfaces tangentially and shear moves them apart.
    fn is_coupled(&self) -> bool;

    /// The self coefficients C_xx(0,0) and C_zz(0,0) \[m/Pa\].
    fn self_coefficients(&self) -> (f64, f64);
}

/// An approximate inverse of the normal and of the tangential part of an operator: a
/// preconditioner.
pub trait ApproximateInverse: Send + Sync {
    /// z ~ C_zz^-1 r.
    fn normal(&mut self, r: &[f64], z: &mut [f64]);

    /// z ~ C_tt^-1 r.
    fn tangential(&mut self, r: [&[f64]; 2], z: [&mut [f64]; 2]);
}
