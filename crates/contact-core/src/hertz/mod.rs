//! Hertz: pressed bodies without friction, the yardstick of every contact and the first guess of its
//! size. The other closed forms are in the crate `contact-reference`.

mod ellipse;
mod elliptic;
mod line;
mod round;

pub use ellipse::{HertzEllipse, hertz_ellipse};
pub use elliptic::{EllipticIntegrals, elliptic_integrals};
pub use line::{LineContact, PlaneStress, line_contact, mcewen_pressure, mcewen_shear};
pub use round::{Hertz, contact_modulus, hertz};
