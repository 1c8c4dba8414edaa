//! The stress at a point: its six components and numbers that do not depend on axes.

#![forbid(unsafe_code)]

/// Stress at a point \[Pa\], tension positive: xx, yy, zz, xy, xz, yz.
pub type StressTensor = [f64; 6];

/// Von Mises equivalent stress \[Pa\].
pub fn von_mises(s: &StressTensor) -> f64 {
    let [xx, yy, zz, xy, xz, yz] = *s;
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (normal / 2.0 + 3.0 * (xy * xy + xz * xz + yz * yz)).sqrt()
}

/// Mean of the normal stresses \[Pa\].
pub fn hydrostatic(s: &StressTensor) -> f64 {
    (s[0] + s[1] + s[2]) / 3.0
}

/// Tresca equivalent stress \[Pa\]: twice the largest shear stress.
pub fn tresca(s: &StressTensor) -> f64 {
    let [first, _, third] = principal_values(s);
    first - third
}

/// Principal stresses \[Pa\], the largest first.
pub fn principal_values(s: &StressTensor) -> [f64; 3] {
    principal(s).values
}

/// Principal stresses and their directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principal {
    /// Values \[Pa\], the largest first.
    pub values: [f64; 3],
    /// Unit vectors, in the same order.
    pub directions: [[f64; 3]; 3],
}

/// Principal stresses and directions, by Jacobi's rotations: each makes the largest off-diagonal
/// entry vanish, and three or four sweeps leave rounding.
pub fn principal(s: &StressTensor) -> Principal {
    let [xx, yy, zz, xy, xz, yz] = *s;
    let mut a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    // Columns are the directions.
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let size = s.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    for _ in 0..24 {
        let off = [(0, 1), (0, 2), (1, 2)];
        let largest = off
            .into_iter()
            .max_by(|&(i, j), &(k, l)| a[i][j].abs().total_cmp(&a[k][l].abs()));
        let Some((i, j)) = largest.filter(|&(i, j)| a[i][j].abs() > f64::EPSILON * size / 4.0)
        else {
            break;
        };
        let theta = (a[j][j] - a[i][i]) / (2.0 * a[i][j]);
        let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
        let c = 1.0 / t.hypot(1.0);
        let s = t * c;
        for row in &mut a {
            (row[i], row[j]) = (c * row[i] - s * row[j], s * row[i] + c * row[j]);
        }
        for n in 0..3 {
            (a[i][n], a[j][n]) = (c * a[i][n] - s * a[j][n], s * a[i][n] + c * a[j][n]);
            (v[n][i], v[n][j]) = (c * v[n][i] - s * v[n][j], s * v[n][i] + c * v[n][j]);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
    Principal {
        values: order.map(|n| a[n][n]),
        directions: order.map(|n| [v[0][n], v[1][n], v[2][n]]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_directions_diagonalise() {
        for n in 0..200 {
            let s: StressTensor = std::array::from_fn(|c| {
                let scale = if n % 3 == 0 { 1e9 } else { 1.0 };
                scale * (f64::from(n) * 1.7 + c as f64 * 2.3).sin().powi(1 + n % 5)
            });
            let size = s.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
            let Principal { values, directions } = principal(&s);
            assert!(values[0] >= values[1] && values[1] >= values[2]);
            for (value, d) in values.iter().zip(directions) {
                let traction = [
                    s[0] * d[0] + s[3] * d[1] + s[4] * d[2],
                    s[3] * d[0] + s[1] * d[1] + s[5] * d[2],
                    s[4] * d[0] + s[5] * d[1] + s[2] * d[2],
                ];
                for (t, d) in traction.iter().zip(d) {
                    assert!((t - value * d).abs() < 1e-14 * size, "{s:?}");
                }
            }
            // Invariants tie the equivalent stresses to the principal values.
            let [a, b, c] = values;
            let mises = (((a - b).powi(2) + (b - c).powi(2) + (c - a).powi(2)) / 2.0).sqrt();
            assert!((von_mises(&s) - mises).abs() < 1e-14 * size);
            assert!((tresca(&s) - (a - c)).abs() < 1e-14 * size);
            assert!((3.0 * hydrostatic(&s) - (a + b + c)).abs() < 1e-14 * size);
        }
    }

    #[test]
    fn equal_values_and_nothing() {
        let cases = [
            ([0.0; 6], [0.0; 3]),
            ([-2.0, -2.0, -2.0, 0.0, 0.0, 0.0], [-2.0; 3]),
            ([0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [1.0, 0.0, -1.0]),
        ];
        for (s, exact) in cases {
            for (value, exact) in principal_values(&s).iter().zip(exact) {
                assert!((value - exact).abs() < 1e-15, "{s:?}");
            }
        }
    }
}
