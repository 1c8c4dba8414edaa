//! The slip of a cell, eq. (7), and its part that does not oppose the shear, eq. (20).

use crate::cells::length;

/// The slip increment of a cell \[m\], eq. (7), from the displacement u, the displacement without
/// slip u_0 and the rigid motion B d(delta).
pub fn slip(u: [f64; 2], u_0: [f64; 2], rigid: [f64; 2]) -> [f64; 2] {
    [u[0] - u_0[0] - rigid[0], u[1] - u_0[1] - rigid[1]]
}

/// The part of a slip that does not oppose the shear `q` \[m\]; zero where q = 0, since without
/// friction any slip is admissible.
pub fn unopposed_part(slip: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    let size = length(q);
    if size == 0.0 {
        return [0.0; 2];
    }
    let e = q.map(|q| q / size);
    let along = (slip[0] * e[0] + slip[1] * e[1]).min(0.0);
    [slip[0] - along * e[0], slip[1] - along * e[1]]
}
