//! Lengths that transform fast.

/// Odd parts of lengths, and what a point of such a transform costs over one of a power of two, as
/// measured with `rustfft`.
const ODD_PARTS: [(usize, f64); 6] = [
    (1, 1.0),
    (3, 1.02),
    (9, 1.05),
    (27, 1.08),
    (5, 1.15),
    (15, 1.35),
];

/// The even length >= `n` that takes least time.
pub fn good_size(n: usize) -> usize {
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
    use super::good_size;

    #[test]
    fn is_even_and_large_enough() {
        for n in 1..3000 {
            let size = good_size(n);
            assert!(
                size >= n && size.is_multiple_of(2) && size < 2 * n.max(2),
                "{n} -> {size}"
            );
        }
        assert_eq!(good_size(399), 432);
        assert_eq!(good_size(470), 512);
        assert_eq!(good_size(511), 512);
        assert_eq!(good_size(513), 576);
    }
}
