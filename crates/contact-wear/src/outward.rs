//! Extrapolates a field of the contact outwards.

/// Fills cells without a value with the mean of their neighbours that have one, ring by ring;
/// fields of `rows` cells per column. Zero if no cell has a value.
pub(crate) fn extrapolate_outward(
    rows: usize,
    cells: usize,
    value_at: impl Fn(usize) -> Option<f64>,
) -> Vec<f64> {
    let mut values: Vec<Option<f64>> = (0..cells).map(value_at).collect();
    let columns = cells / rows;
    let neighbours = |n: usize| {
        let (i, j) = (n / rows, n % rows);
        let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
        near(i, columns).flat_map(move |a| near(j, rows).map(move |b| a * rows + b))
    };
    let mut front: Vec<usize> = (0..cells)
        .filter(|&n| values[n].is_none() && neighbours(n).any(|m| values[m].is_some()))
        .collect();
    while !front.is_empty() {
        let mean = |&n: &usize| {
            let (sum, count) = neighbours(n)
                .filter_map(|m| values[m])
                .fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
            sum / count
        };
        let means: Vec<f64> = front.iter().map(mean).collect();
        front
            .iter()
            .zip(means)
            .for_each(|(&n, mean)| values[n] = Some(mean));
        let mut ring: Vec<usize> = front
            .iter()
            .flat_map(|&n| neighbours(n))
            .filter(|&n| values[n].is_none())
            .collect();
        ring.sort_unstable();
        ring.dedup();
        front = ring;
    }
    values.into_iter().map(|v| v.unwrap_or(0.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::extrapolate_outward;

    #[test]
    fn cells_outside_have_what_those_beside_them_have() {
        let field = extrapolate_outward(3, 15, |n| (6..9).contains(&n).then_some((n % 3) as f64));
        assert_eq!(field[6..9], [0.0, 1.0, 2.0]);
        assert_eq!(field[9..12], [0.5, 1.0, 1.5]);
        assert!(field[12..].iter().all(|v| (0.5..=1.5).contains(v)));
        assert_eq!(extrapolate_outward(3, 6, |_| None), [0.0; 6]);
    }
}
