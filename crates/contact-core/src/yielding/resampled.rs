//! A smooth field between the centres of cells.

/// A field of nx x ny cells on `ratio` times as many cells along x and y, by cubic polynomials through the four
/// nearest values.
pub(super) fn resampled(field: &[f64], (nx, ny): (usize, usize), ratio: [usize; 2]) -> Vec<f64> {
    if ratio == [1, 1] {
        return field.to_vec();
    }
    let along_y: Vec<f64> = field
        .chunks(ny)
        .flat_map(|row| line(row, ratio[1]))
        .collect();
    let ny = ny * ratio[1];
    let mut fine = vec![0.0; nx * ratio[0] * ny];
    let mut column = vec![0.0; nx];
    for j in 0..ny {
        for (i, value) in column.iter_mut().enumerate() {
            *value = along_y[i * ny + j];
        }
        for (i, value) in line(&column, ratio[0]).into_iter().enumerate() {
            fine[i * ny + j] = value;
        }
    }
    fine
}

/// Resamples one line as [`resampled`] does.
fn line(values: &[f64], ratio: usize) -> Vec<f64> {
    let n = values.len();
    if ratio == 1 || n < 4 {
        return values.iter().flat_map(|v| vec![*v; ratio]).collect();
    }
    let at = |fine: usize| {
        let x = (fine as f64 + 0.5) / ratio as f64 - 0.5;
        let first = (x.floor() as isize - 1).clamp(0, n as isize - 4) as usize;
        let weight = |k: usize| {
            let others = (0..4).filter(|m| *m != k);
            let factor = |m: usize| (x - (first + m) as f64) / (k as f64 - m as f64);
            others.map(factor).product::<f64>()
        };
        (0..4).map(|k| weight(k) * values[first + k]).sum()
    };
    (0..n * ratio).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::resampled;

    #[test]
    fn a_cubic_field_is_exact() {
        let field = |x: f64, y: f64| 1.0 + x - 2.0 * y + x * x * y + 0.3 * y * y * y;
        let (nx, ny, ratio) = (6, 8, [2, 4]);
        let coarse: Vec<f64> = (0..nx * ny)
            .map(|n| field((n / ny) as f64, (n % ny) as f64))
            .collect();
        let fine = resampled(&coarse, (nx, ny), ratio);
        for (n, value) in fine.iter().enumerate() {
            let (i, j) = (n / (ny * ratio[1]), n % (ny * ratio[1]));
            let x = (i as f64 + 0.5) / ratio[0] as f64 - 0.5;
            let y = (j as f64 + 0.5) / ratio[1] as f64 - 0.5;
            assert!((value - field(x, y)).abs() < 1e-10);
        }
    }
}
