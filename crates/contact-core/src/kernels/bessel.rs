//! Bessel functions of the first kind of the orders 0 to 3.

/// J_0 to J_3 at t >= 0, to about 1e-16 absolute; for small t also relative.
///
/// J_0 and J_1 are computed by `libm`; the higher ones follow by recurrence where it is stable and
/// by the power series elsewhere.
pub(crate) fn bessel(t: f64) -> [f64; 4] {
    let (j0, j1) = (libm::j0(t), libm::j1(t));
    // Upward recurrence loses digits as t^-n below t ~ n.
    let (j2, j3) = if t < 2.0 {
        (series(2, t), series(3, t))
    } else {
        let j2 = 2.0 * j1 / t - j0;
        let j3 = if t < 3.0 {
            series(3, t)
        } else {
            4.0 * j2 / t - j1
        };
        (j2, j3)
    };
    [j0, j1, j2, j3]
}

/// Sums the power series of the Bessel function J_n, for small t.
fn series(n: i32, t: f64) -> f64 {
    let half = t / 2.0;
    let factorial: f64 = (1..=n).map(f64::from).product();
    let mut term = half.powi(n) / factorial;
    let mut sum = term;
    for m in 1..20 {
        term *= -half * half / f64::from(m * (m + n));
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agree_with_libm() {
        for i in 0..4000 {
            let t = f64::from(i) * 0.05;
            let ours = bessel(t);
            for (n, value) in ours.iter().enumerate() {
                let theirs = libm::jn(n as i32, t);
                assert!((value - theirs).abs() < 1e-15, "J_{n}({t})");
            }
        }
    }
}
