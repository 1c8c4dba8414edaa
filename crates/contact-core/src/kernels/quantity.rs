//! Quantities at a depth, displacement and stress, by their radial functions.

use super::depth_frf::WaveFields;
use super::layered_frf::{HalfSpace, Stack};

/// A quantity of R components under each of q_x, q_y, p, made of N radial functions.
pub trait Quantity<const N: usize, const R: usize>: 'static {
    /// Orders of the Bessel functions in the Hankel integrals.
    const ORDERS: [usize; N];

    /// The integrands at the wave number k, without the Bessel function.
    fn amplitudes(k: f64, fields: &WaveFields) -> [f64; N];

    /// Adds the response at (x, y) from unit forces; `g` are the radial functions over r^m.
    fn add(sum: &mut [[f64; 3]; R], x: f64, y: f64, g: [f64; N]);

    /// The radial functions over r^m of a half-space at the depth z > 0, s = r^2.
    fn radial(material: &HalfSpace, s: f64, z: f64) -> [f64; N];

    /// The response of a half-space at (x, y, z) from one corner of a uniformly loaded rectangle.
    /// On the line of an edge the distance from it is replaced by `edge`, along x and along y.
    fn corner(material: &HalfSpace, at: (f64, f64, f64), edge: (f64, f64)) -> [[f64; 3]; R];

    /// Whether an entry is odd in x and in y.
    fn is_odd(row: usize, column: usize) -> (bool, bool);

    /// Row and column that an entry becomes when x and y are exchanged.
    fn transposed(row: usize, column: usize) -> (usize, usize);

    /// Whether a component has exactly one index z, so that it is odd in z.
    fn has_one_z(row: usize) -> bool;

    /// Reference value for errors of the table, r times the deviation.
    fn error_scale(stack: &Stack, zeta: f64) -> f64;
}
