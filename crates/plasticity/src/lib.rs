//! Bodies that yield: von Mises plasticity with isotropic and kinematic hardening, on plain arrays.
//!
//! ```text
//! f = sqrt(3/2) |s - X| - R(p) <= 0,   X = 2/3 C e_p + sum X_i
//! de_p = dp N,   N = 3/2 (s - X)/(sqrt(3/2) |s - X|),   dp = sqrt(2/3 de_p : de_p)
//! dX_i = 2/3 C_i de_p - gamma_i X_i dp
//! ```
//!
//! with s the deviator of the stress, e_p the plastic strain (no change of volume), p the equivalent
//! plastic strain. R(p) is the sum of the isotropic laws ([`ISOTROPIC`]: linear, Voce, Swift), C the linear
//! kinematic hardening (W. Prager, 1956), C_i and gamma_i those with recall (P. J. Armstrong, C. O.
//! Frederick, CEGB report RD/B/N 731, 1966; J.-L. Chaboche, Int. J. Plast. 2 (1986) 149-188). A [`Plastic`] is
//! these numbers; [`Point::advance`] is the return of one point to its yield surface within an increment.
//! Components are xx, yy, zz, xy, xz, yz, tensor components of the strain.
//!
//! ```
//! use plasticity::{Plastic, Point};
//!
//! let steel = Plastic { hardening: 5e9, ..Plastic::perfect(900e6) };
//! steel.check("plastic")?;
//! // A strain in shear of 1 %, held: the stress falls back to the yield surface.
//! let mu = 80e9;
//! let trial = [0.0, 0.0, 0.0, 2.0 * mu * 0.01, 0.0, 0.0];
//! let end = Point::default().advance(&steel, mu, &[0.0; 6], &trial);
//! let left = trial[3] - 2.0 * mu * end.strain[3];
//! let yield_stress = steel.yield_stress(end.equivalent);
//! assert!((3f64.sqrt() * left / yield_stress - 1.0).abs() < 1e-12);
//! # Ok::<(), plasticity::Error>(())
//! ```

#![forbid(unsafe_code)]

mod law;
mod point;

pub use law::{BACK_STRESSES, Error, ISOTROPIC, Isotropic, NUMBERS, Number, Plastic};
pub use point::{Point, Returned, YIELDS};

/// Components of a symmetric tensor.
pub const COMPONENTS: usize = 6;
/// A symmetric tensor: xx, yy, zz, xy, xz, yz.
pub type Tensor = [f64; COMPONENTS];

/// a : b.
pub fn contraction(a: &Tensor, b: &Tensor) -> f64 {
    let sum =
        |from: usize| a[from] * b[from] + a[from + 1] * b[from + 1] + a[from + 2] * b[from + 2];
    sum(0) + 2.0 * sum(3)
}

/// The deviator of a tensor.
pub fn deviator(of: &Tensor) -> Tensor {
    let mean = (of[0] + of[1] + of[2]) / 3.0;
    [
        of[0] - mean,
        of[1] - mean,
        of[2] - mean,
        of[3],
        of[4],
        of[5],
    ]
}

/// sqrt(3/2 s : s) of a deviator s: the stress of von Mises.
pub fn equivalent_stress(deviator: &Tensor) -> f64 {
    (1.5 * contraction(deviator, deviator)).sqrt()
}

/// sqrt(2/3 e : e) of a deviator e: the equivalent strain.
pub fn equivalent_strain(deviator: &Tensor) -> f64 {
    (contraction(deviator, deviator) / 1.5).sqrt()
}
