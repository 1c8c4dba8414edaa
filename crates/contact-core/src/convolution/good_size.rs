//! Lengths that transform fast.

/// The smallest even length >= `n` of the form 2^a 3^b 5^c with b <= 2 and c <= 1.
///
/// Higher powers of 3 and 5 cost more per point than the zeros they save.
pub(crate) fn good_size(n: usize) -> usize {
    let mut best = n.next_power_of_two().max(2);
    for odd in [3, 5, 9, 15, 45] {
        let mut size = 2 * odd;
        while size < n {
            size *= 2;
        }
        best = best.min(size);
    }
    best
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
        assert_eq!(good_size(511), 512);
        assert_eq!(good_size(513), 576);
        assert_eq!(good_size(399), 480);
    }
}
