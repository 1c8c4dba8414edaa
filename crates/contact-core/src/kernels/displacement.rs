//! Displacement below one loaded cell, in any layer of any body.
//!
//! With the amplitudes of [`WaveFields`], theta the azimuth and J_n for the Hankel integral of
//! order n (U = u_r/i, Q = q_r/i in the frame of the wave):
//!
//! ```text
//!      under p              under q_x
//! u_z  J_0[u_z]             J_1[u_z] cos(theta)
//! u_x  -J_1[U] cos(theta)   J_0[(U + u_t)/2] - J_2[(U - u_t)/2] cos 2theta
//! u_y  -J_1[U] sin(theta)   -J_2[(U - u_t)/2] sin 2theta
//! ```

use super::depth_frf::WaveFields;
use super::half_space_displacement::{self, DisplacementResponse};
use super::layered_frf::{HalfSpace, Stack};
use super::quantity::Quantity;

/// The three displacements \[m/Pa\].
pub struct Displacement;

impl Quantity<5, 3> for Displacement {
    const ORDERS: [usize; 5] = [0, 1, 0, 2, 1];

    /// The five radial amplitudes of the displacement at a wave number, from the fields of the wave.
    fn amplitudes(_: f64, f: &WaveFields) -> [f64; 5] {
        [
            f.u.3,
            -f.u.1,
            f64::midpoint(f.u.0, f.u_t),
            (f.u_t - f.u.0) / 2.0,
            f.u.2,
        ]
    }

    /// Adds the displacement at (x, y) from the five radial functions over powers of r: rows u_x, u_y, u_z,
    /// columns q_x, q_y, p.
    fn add(u: &mut DisplacementResponse, x: f64, y: f64, g: [f64; 5]) {
        let [normal, radial, mean, deviation, lift] = g;
        let (c2, s2) = ((x * x - y * y) * deviation, 2.0 * x * y * deviation);
        let displacement = [
            [mean + c2, s2, radial * x],
            [s2, mean - c2, radial * y],
            [lift * x, lift * y, normal],
        ];
        for (sum, row) in u.iter_mut().zip(displacement) {
            for (sum, value) in sum.iter_mut().zip(row) {
                *sum += value;
            }
        }
    }

    /// The radial functions of a half-space at s = r^2 and the depth z.
    fn radial(material: &HalfSpace, s: f64, z: f64) -> [f64; 5] {
        half_space_displacement::radial_functions(s, z, material)
    }

    /// The closed form of one corner of a loaded cell.
    fn corner(
        material: &HalfSpace,
        (x, y, z): (f64, f64, f64),
        _: (f64, f64),
    ) -> DisplacementResponse {
        half_space_displacement::corner(x, y, z, material)
    }

    /// Whether the entry is odd in x and in y.
    fn is_odd(row: usize, column: usize) -> (bool, bool) {
        ((row == 0) != (column == 0), (row == 1) != (column == 1))
    }

    /// The entry that it becomes when x and y change places.
    fn transposed(row: usize, column: usize) -> (usize, usize) {
        ([1, 0, 2][row], [1, 0, 2][column])
    }

    /// Whether the component has exactly one index z: u_z.
    fn has_one_z(row: usize) -> bool {
        row == 2
    }

    /// Reference for errors of the table, which compares r times the displacement: the largest 1/G \[1/Pa\],
    /// since the displacement decays like 1/(G r).
    fn error_scale(stack: &Stack, _: f64) -> f64 {
        stack.largest_compliance()
    }
}
