//! The fields of one increment on the whole grid.

use ndarray::Array2;

/// Fields at the end of an increment, each of shape (nx, ny).
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// Pressure p \[Pa\], compression positive.
    pub p: Array2<f64>,
    /// Shear traction on body 2 along x \[Pa\].
    pub q_x: Array2<f64>,
    /// Shear traction on body 2 along y \[Pa\].
    pub q_y: Array2<f64>,
    /// Relative surface displacement u(2) - u(1) along x \[m\].
    pub u_x: Array2<f64>,
    /// Relative surface displacement along y \[m\].
    pub u_y: Array2<f64>,
    /// Relative surface displacement along z, into body 2 \[m\].
    pub u_z: Array2<f64>,
    /// Gap h \[m\], >= 0.
    pub gap: Array2<f64>,
    /// Slip along x added up over the load path \[m\], in cells while in contact.
    pub slip_x: Array2<f64>,
    /// Slip along y added up over the load path \[m\].
    pub slip_y: Array2<f64>,
    /// Energy dissipated per area, added up over the load path \[J/m^2\].
    pub dissipated: Array2<f64>,
    /// Cells that transmit pressure.
    pub contact: Array2<bool>,
    /// Contact cells that do not slip in this increment.
    pub stick: Array2<bool>,
}
