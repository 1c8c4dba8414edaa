//! Lengths that transform fast.

/// Odd factors of lengths, and the cost of a point of such a transform over one with a power of two, as
/// measured with `rustfft`.
const ODD_PARTS: [(usize, f64); 6] = [
    (1, 1.0),
    (3, 1.02),
    (9, 1.05),
    (27, 1.08),
    (5, 1.15),
    (15, 1.35),
];

/// The even length >= `n` whose FFT takes the least time.
pub fn fast_length(n: usize) -> usize {
    let sizes = ODD_PARTS.map(|(odd, cost)| {
        let mut size = 2 * odd;
        while size < n {
            size *= 2;
        }
        (size, size as f64 * cost)
    });
    let cheapest = sizes.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    cheapest.map_or(n, |(size, _)| size)
}

#[cfg(test)]
mod tests {
    use super::fast_length;

    #[test]
    fn is_even_and_large_enough() {
        for n in 1..3000 {
            let size = fast_length(n);
            assert!(
                size >= n && size.is_multiple_of(2) && size < 2 * n.max(2),
                "{n} -> {size}"
            );
        }
        assert_eq!(fast_length(399), 432);
        assert_eq!(fast_length(470), 512);
        assert_eq!(fast_length(511), 512);
        assert_eq!(fast_length(513), 576);
    }
}
