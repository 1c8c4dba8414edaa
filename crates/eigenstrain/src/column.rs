//! The equations of one wave number in depth, and their elimination.
//!
//! With axis 1 along the wave vector, 2 across it, 3 = z, and u_1 = -i v, u_3 = w, everything is real.
//! The solution is the minimum of
//!
//! ```text
//! in the plane:  1/2 int (lambda + 2 mu)(k^2 v^2 + w'^2) + 2 lambda k v w' + mu g^2 dz
//!                - Re int tau_11 k v* + tau_33 w'* + (i tau_13) g* dz - (i t_1) v* - t_3 w*
//! across:        1/2 int mu (u_2'^2 + k^2 u_2^2) dz - Re int (-i tau_12) k u_2* + tau_23 u_2'* dz - t_2 u_2*
//! ```
//!
//! with g = v' - k w and the polarisation tau = C : e. Below the last element the half-space has the
//! impedance 4 mu k/(3 - 4 nu) \[\[1 - nu, 1/2 - nu\], \[1/2 - nu, 1 - nu\]\] for (v, w), and mu k for u_2.
//!
//! Elements are quadratic with two Gauss points. That rule is an implicit Runge-Kutta step, which
//! keeps the decaying solutions: the compliance of a homogeneous column is exact on any mesh. The
//! middle node of each element is condensed, the others are eliminated from the bottom up. No
//! exponential appears, so that k h of an element may have any size.

use crate::mesh::{GAUSS_POINT, Mesh};

/// Numbers of an element at a wave number, see [`Reduced`].
pub(crate) const FACTORS: usize = 23;
/// Numbers of the surface at a wave number: the inverse stiffness of (v, w), and of u_2.
pub(crate) const TOP: usize = 4;

/// Shape functions of the upper, middle and lower node and their slopes by z at a Gauss point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shapes {
    pub(crate) N: [f64; 3],
    pub(crate) dN: [f64; 3],
    /// Weight of the point \[m\].
    pub(crate) weight: f64,
}

impl Shapes {
    /// Shape functions at both Gauss points of an element of height h.
    pub(crate) fn at_gauss_points(h: f64) -> [Self; 2] {
        [-GAUSS_POINT, GAUSS_POINT].map(|x| Self {
            N: [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)],
            dN: [x - 0.5, -2.0 * x, x + 0.5].map(|slope| slope * 2.0 / h),
            weight: 0.5 * h,
        })
    }
}

type Square = [[f64; 2]; 2];

/// Product of two 2 x 2 matrices.
fn product(a: Square, b: Square) -> Square {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// Transpose of a 2 x 2 matrix.
fn transposed(a: Square) -> Square {
    [[a[0][0], a[1][0]], [a[0][1], a[1][1]]]
}

/// a + factor b of 2 x 2 matrices.
fn sum(a: Square, b: Square, factor: f64) -> Square {
    [0, 1].map(|i| [0, 1].map(|j| a[i][j] + factor * b[i][j]))
}

/// Inverse of a 2 x 2 matrix.
fn inverse(a: Square) -> Square {
    let by = 1.0 / (a[0][0] * a[1][1] - a[0][1] * a[1][0]);
    [[a[1][1] * by, -a[0][1] * by], [-a[1][0] * by, a[0][0] * by]]
}

/// The eliminated equations of an element, (v, w) first, then u_2:
///
/// ```text
/// u_m = M f_m - P u_a - Q u_b,      u_b = D r_b - G u_a
/// r_b = f_b - Q' f_m + r_below,     r_a = f_a - P' f_m - G' r_b
/// ```
///
/// of its upper (a), middle (m) and lower (b) node.
pub(crate) struct Reduced;

impl Reduced {
    /// Packs the factors of a column in the order in which they are read: M (3), P (4), Q (4), D (3), G (4),
    /// and the five of the displacement across the wave.
    fn packed(
        m: Square,
        p: Square,
        q: Square,
        d: Square,
        g: Square,
        across: [f64; 5],
    ) -> [f64; FACTORS] {
        let mut all = [0.0; FACTORS];
        all[..3].copy_from_slice(&[m[0][0], m[0][1], m[1][1]]);
        for (to, of) in [(3, p), (7, q), (14, g)] {
            all[to..to + 4].copy_from_slice(&[of[0][0], of[0][1], of[1][0], of[1][1]]);
        }
        all[11..14].copy_from_slice(&[d[0][0], d[0][1], d[1][1]]);
        all[18..].copy_from_slice(&across);
        all
    }
}

/// Eliminates from the bottom up: `each` gets the factors of each element, from the lowest; the
/// inverse stiffness of the surface is returned.
pub(crate) fn eliminate(
    mesh: &Mesh,
    k: f64,
    mut each: impl FnMut(usize, [f64; FACTORS]),
) -> [f64; TOP] {
    let below = mesh.half_space();
    let ([_, mu], nu) = (below.lame(), below.nu);
    let of_half_space = 4.0 * mu * k / (3.0 - 4.0 * nu);
    let (same, other) = (of_half_space * (1.0 - nu), of_half_space * (0.5 - nu));
    let mut stiffness = [[same, other], [other, same]];
    let mut across = mu * k;
    for element in (0..mesh.elements()).rev() {
        let (plane, out) = stiffnesses(mesh.height(element), k, mesh.lame(element));
        let Nodes { between, moved } = plane;
        let m = inverse(between[1][1]);
        let (p, q) = (product(m, between[1][0]), product(m, between[1][2]));
        let schur =
            |i: usize, j: usize, of: Square| sum(between[i][j], product(between[i][1], of), -1.0);
        let (cross, own) = (schur(2, 0, p), schur(2, 2, q));
        let d = inverse(sum(own, stiffness, 1.0));
        let g = product(d, cross);
        // Forces under a translation of the whole element: small of order k, so that nothing cancels.
        let of_middle = product(m, moved[1]);
        let [of_upper, of_lower] =
            [0, 2].map(|i| sum(moved[i], product(between[i][1], of_middle), -1.0));
        let carried = product(d, sum(of_lower, stiffness, 1.0));
        stiffness = sum(of_upper, product(transposed(cross), carried), -1.0);
        let mean = 0.5 * (stiffness[0][1] + stiffness[1][0]);
        stiffness[0][1] = mean;
        stiffness[1][0] = mean;

        let Nodes { between, moved } = out;
        let m_2 = 1.0 / between[1][1];
        let (p_2, q_2) = (m_2 * between[1][0], m_2 * between[1][2]);
        let (cross, own) = (
            between[2][0] - between[2][1] * p_2,
            between[2][2] - between[2][1] * q_2,
        );
        let d_2 = 1.0 / (own + across);
        let g_2 = d_2 * cross;
        let [of_upper, of_lower] = [0, 2].map(|i| moved[i] - between[i][1] * m_2 * moved[1]);
        across = of_upper - cross * d_2 * (of_lower + across);
        each(
            element,
            Reduced::packed(m, p, q, d, g, [m_2, p_2, q_2, d_2, g_2]),
        );
    }
    let top = inverse(stiffness);
    [top[0][0], top[0][1], top[1][1], 1.0 / across]
}

/// Stiffness of an element.
struct Nodes<T> {
    /// Between its three nodes.
    between: [[T; 3]; 3],
    /// Its sums over the second node: forces under a translation of the element.
    moved: [T; 3],
}

/// Stiffness of an element of the thickness h at the wave number k, for displacements in the plane of the wave
/// (v, w), and across it (u_2).
fn stiffnesses(h: f64, k: f64, [lambda, mu]: [f64; 2]) -> (Nodes<Square>, Nodes<f64>) {
    let mut plane = Nodes {
        between: [[[[0.0; 2]; 2]; 3]; 3],
        moved: [[[0.0; 2]; 2]; 3],
    };
    let mut across = Nodes {
        between: [[0.0; 3]; 3],
        moved: [0.0; 3],
    };
    let stiff = lambda + 2.0 * mu;
    for Shapes { N, dN, weight } in Shapes::at_gauss_points(h) {
        for i in 0..3 {
            for j in 0..3 {
                let (nn, dd) = (weight * k * k * N[i] * N[j], weight * dN[i] * dN[j]);
                let (n_d, d_n) = (weight * k * N[i] * dN[j], weight * k * dN[i] * N[j]);
                let block: &mut Square = &mut plane.between[i][j];
                block[0][0] += stiff * nn + mu * dd;
                block[1][1] += stiff * dd + mu * nn;
                block[0][1] += lambda * n_d - mu * d_n;
                block[1][0] += lambda * d_n - mu * n_d;
                across.between[i][j] += mu * (nn + dd);
            }
            // The shapes add up to 1, their slopes to 0.
            let (n, d) = (weight * k * k * N[i], weight * k * dN[i]);
            let block = &mut plane.moved[i];
            block[0][0] += stiff * n;
            block[1][1] += mu * n;
            block[0][1] -= mu * d;
            block[1][0] += lambda * d;
            across.moved[i] += mu * n;
        }
    }
    (plane, across)
}

/// Displacement of the surface at the wave number k \[1/m\] under unit tractions \[m/Pa\]: displacement of
/// (v, w) under (i t_1, t_3), `[vv, vw, ww]`, and of u_2 under t_2.
///
/// Of a homogeneous half-space: (1 - nu)/(mu k), -(1 - 2 nu)/(2 mu k), (1 - nu)/(mu k), 1/(mu k).
pub fn surface_compliance(mesh: &Mesh, k: f64) -> [f64; TOP] {
    eliminate(mesh, k, |_, _| {})
}
