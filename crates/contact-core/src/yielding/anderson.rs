//! Anderson's mixing of a fixed point x = G(x), with unknowns that are added on the way.

/// Differences that are kept.
const DEPTH: usize = 8;
/// Part of the largest diagonal entry that the least-squares problem is regularised by.
const REGULARISED: f64 = 1e-12;
/// Unknowns of a point.
const OF_A_POINT: usize = 6;

/// The last passes of a fixed point.
#[derive(Debug, Default)]
pub(super) struct Anderson {
    last: Option<[Vec<f64>; 2]>,
    /// Differences of x and of f = G(x) - x between passes.
    differences: Vec<[Vec<f64>; 2]>,
    /// Points of each body in the last pass.
    counts: Vec<usize>,
}

impl Anderson {
    /// The next unknowns from the present x and their image f + x: x + f - sum c_j (dx_j + df_j), with c the
    /// least squares of f - sum c_j df_j. The first `fixed` unknowns are always there. After them come the
    /// components of the points of each body, as many points as in `counts`; new points have not changed
    /// before.
    pub(super) fn mixed(
        &mut self,
        x: &[f64],
        image: &[f64],
        fixed: usize,
        counts: &[usize],
    ) -> Vec<f64> {
        let f: Vec<f64> = x.iter().zip(image).map(|(x, to)| to - x).collect();
        if self.counts != counts {
            let before = std::mem::replace(&mut self.counts, counts.to_vec());
            let widen = |v: &mut Vec<f64>| {
                let mut wide = v[..fixed].to_vec();
                let mut from = fixed;
                for (body, count) in counts.iter().enumerate() {
                    let had = OF_A_POINT * before.get(body).copied().unwrap_or(0);
                    wide.extend_from_slice(&v[from..from + had]);
                    wide.resize(wide.len() + OF_A_POINT * count - had, 0.0);
                    from += had;
                }
                *v = wide;
            };
            let fields = self.differences.iter_mut().chain(&mut self.last);
            fields.flatten().for_each(widen);
        }
        if let Some([x_last, f_last]) = self.last.take() {
            let difference = |now: &[f64], last: &[f64]| -> Vec<f64> {
                now.iter().zip(last).map(|(now, last)| now - last).collect()
            };
            self.differences
                .push([difference(x, &x_last), difference(&f, &f_last)]);
            if self.differences.len() > DEPTH {
                self.differences.remove(0);
            }
        }
        let weights = self.weights(&f);
        let mut mixed: Vec<f64> = image.to_vec();
        for ([dx, df], weight) in self.differences.iter().zip(weights) {
            for ((next, dx), df) in mixed.iter_mut().zip(dx).zip(df) {
                *next -= weight * (dx + df);
            }
        }
        self.last = Some([x.to_vec(), f]);
        mixed
    }

    /// The weights c of the last changes that reduce f most: least squares by normal equations.
    fn weights(&self, f: &[f64]) -> Vec<f64> {
        let n = self.differences.len();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut matrix = vec![vec![0.0; n]; n];
        for i in 0..n {
            for j in 0..=i {
                matrix[i][j] = dot(&self.differences[i][1], &self.differences[j][1]);
                matrix[j][i] = matrix[i][j];
            }
        }
        let scale: Vec<f64> = (0..n)
            .map(|i| matrix[i][i].sqrt().max(f64::MIN_POSITIVE))
            .collect();
        let mut right: Vec<f64> = (0..n)
            .map(|i| dot(&self.differences[i][1], f) / scale[i])
            .collect();
        for i in 0..n {
            for j in 0..n {
                matrix[i][j] /= scale[i] * scale[j];
            }
            matrix[i][i] += REGULARISED;
        }
        solve(&mut matrix, &mut right);
        right.iter().zip(&scale).map(|(w, s)| w / s).collect()
    }
}

/// Gauss elimination of a positive definite system, in place.
fn solve(matrix: &mut [Vec<f64>], right: &mut [f64]) {
    let n = right.len();
    for pivot in 0..n {
        for row in pivot + 1..n {
            let factor = matrix[row][pivot] / matrix[pivot][pivot];
            for column in pivot..n {
                matrix[row][column] -= factor * matrix[pivot][column];
            }
            right[row] -= factor * right[pivot];
        }
    }
    for row in (0..n).rev() {
        let sum: f64 = (row + 1..n)
            .map(|column| matrix[row][column] * right[column])
            .sum();
        right[row] = (right[row] - sum) / matrix[row][row];
    }
}
