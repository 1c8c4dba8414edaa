//! A bracketed root.

/// Returns the root in (a, b) of a function `f` that rises through zero, to round-off, by bisection. If `f` has
/// only one sign, it returns a or b: the end on the side of zero.
pub fn bisect(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = f64::midpoint(a, b);
        if middle <= a || middle >= b {
            return middle;
        }
        if f(middle) > 0.0 {
            b = middle;
        } else {
            a = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bisection_finds_the_root_or_the_bound() {
        assert!((bisect(0.0, 2.0, |x| x * x - 2.0) - 2f64.sqrt()).abs() < 1e-15);
        assert!((bisect(0.0, 2.0, |x| x - 2.0) - 2.0).abs() < 1e-15);
    }
}
