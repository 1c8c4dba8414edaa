//! Test of quadratic forms: nowhere negative where all coordinates are positive.

/// Checks that the sum of m_ij w_i w_j is nowhere negative for w >= 0; `diagonal` is m_11, m_22,
/// m_33 and `mixed` m_12, m_23, m_31.
///
/// K. P. Hadeler, Linear Algebra Appl. 49 (1983) 79-89.
pub(crate) fn is_copositive(diagonal: [f64; 3], mixed: [f64; 3]) -> bool {
    if diagonal.iter().any(|m| !(*m >= 0.0)) {
        return false;
    }
    let [a, b, c] = diagonal.map(f64::sqrt);
    let [ab, bc, ca] = mixed;
    let [over_ab, over_bc, over_ca] = [ab + a * b, bc + b * c, ca + c * a];
    let on_edges = over_ab >= 0.0 && over_bc >= 0.0 && over_ca >= 0.0;
    let inside = a * b * c + ab * c + bc * a + ca * b;
    on_edges && (inside >= 0.0 || inside * inside <= 2.0 * over_ab * over_bc * over_ca)
}

#[cfg(test)]
mod tests {
    use super::is_copositive;

    /// The least value of the form on a lattice of w with the sum 1.
    fn least([a, b, c]: [f64; 3], [ab, bc, ca]: [f64; 3]) -> f64 {
        let n = 200;
        let lattice = (0..=n).flat_map(|i| (0..=n - i).map(move |j| (i, j)));
        let value = |(i, j): (i32, i32)| {
            let [x, y, z] = [i, j, n - i - j].map(|w| f64::from(w) / f64::from(n));
            let mixed = ab * x * y + bc * y * z + ca * z * x;
            a * x * x + b * y * y + c * z * z + 2.0 * mixed
        };
        lattice.map(value).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn forms_are_told_apart_as_on_a_lattice() {
        // Irrational multiples spread the entries evenly.
        let entry = |k: usize, step: f64| (k as f64 * step).fract();
        let mut counted = [0; 2];
        for k in 1..3000 {
            let diagonal = [2.0, 3.0, 5.0].map(|d: f64| entry(k, d.sqrt()) - 0.05);
            let mixed = [7.0, 11.0, 13.0].map(|d: f64| 1.5 * entry(k, d.sqrt()) - 0.9);
            let least = least(diagonal, mixed);
            let copositive = is_copositive(diagonal, mixed);
            // The lattice may pass over a negative value that is next to nothing.
            assert!(
                if copositive {
                    least >= 0.0
                } else {
                    least < 1e-4
                },
                "{diagonal:?} {mixed:?}"
            );
            counted[usize::from(copositive)] += 1;
        }
        assert!(counted.iter().all(|n| *n > 300), "{counted:?}");
    }
}
