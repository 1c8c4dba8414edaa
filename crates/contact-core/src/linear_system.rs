//! Dense linear equations, for the integral equations among the references.

use ndarray::Array2;

/// Solves `matrix` x = `right` for every column of `right`; Gaussian elimination with row pivots.
pub fn solve(matrix: &Array2<f64>, right: &Array2<f64>) -> Array2<f64> {
    let (n, columns) = right.dim();
    let mut rows: Vec<Vec<f64>> = matrix
        .rows()
        .into_iter()
        .zip(right.rows())
        .map(|(left, right)| left.iter().chain(right).copied().collect())
        .collect();
    for i in 0..n {
        let size = |row: usize| rows[row][i].abs();
        let pivot = (i..n).fold(
            i,
            |best, row| if size(row) > size(best) { row } else { best },
        );
        rows.swap(i, pivot);
        let (above, below) = rows.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / above[i][i];
            for (x, y) in row[i..].iter_mut().zip(&above[i][i..]) {
                *x -= factor * y;
            }
        }
    }
    let mut x = Array2::zeros((n, columns));
    for i in (0..n).rev() {
        for column in 0..columns {
            let sum: f64 = (i + 1..n).map(|j| rows[i][j] * x[[j, column]]).sum();
            x[[i, column]] = (rows[i][n + column] - sum) / rows[i][i];
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_satisfies_the_equations_even_where_the_first_pivot_is_zero() {
        let matrix = Array2::from_shape_fn((7, 7), |(i, j)| {
            if i == j && i % 3 == 0 {
                0.0
            } else {
                ((3 * i * i + i * j + 7 * j) as f64).sin()
            }
        });
        let right = Array2::from_shape_fn((7, 2), |(i, j)| (i + 5 * j) as f64);
        let x = solve(&matrix, &right);
        let residual = (matrix.dot(&x) - right).mapv(f64::abs);
        assert!(residual.iter().all(|r| *r < 1e-10), "{residual}");
    }
}
