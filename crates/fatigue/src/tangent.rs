//! Linear bounds of a criterion in its two parts, exact at given parts.
//!
//! A product a h of a >= 0 and h = z + w b is at most the square of (r a + h/r)/2 for any r > 0
//! where h >= 0, and at most 0 elsewhere; both are equal where r^2 = h/a. The sum r a + h/r has a
//! second derivative along great circles of at least -(r K_a + w K_b/r).

/// The form x a + y b + z. The criterion is at most this value, or at most the square of half of
/// it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent {
    pub(crate) first: f64,
    pub(crate) second: f64,
    pub(crate) constant: f64,
    is_product: bool,
}

impl Tangent {
    /// A tangent that bounds nothing.
    pub(crate) const NONE: Self = Self {
        first: 0.0,
        second: 0.0,
        constant: f64::INFINITY,
        is_product: false,
    };

    /// The tangent of a + w b, which is this form itself.
    pub(crate) fn sum(weight: f64) -> Self {
        Self {
            first: 1.0,
            second: weight,
            constant: 0.0,
            is_product: false,
        }
    }

    /// Bound of a (z + w b), at parts where it is positive; elsewhere it bounds nothing.
    pub(crate) fn for_product(constant: f64, weight: f64, [a, b]: [f64; 2]) -> Self {
        let r = ((constant + weight * b) / a).sqrt();
        if !(r > 0.0 && r.is_finite()) {
            return Self::NONE;
        }
        Self {
            first: r,
            second: weight / r,
            constant: constant / r,
            is_product: true,
        }
    }

    /// Evaluates the form at (a, b).
    pub(crate) fn evaluate(&self, [a, b]: [f64; 2]) -> f64 {
        self.first * a + self.second * b + self.constant
    }

    /// Upper bound of the criterion where the form is at most `sum`.
    pub(crate) fn value(&self, sum: f64) -> f64 {
        if self.is_product {
            (sum.max(0.0) / 2.0).powi(2)
        } else {
            sum
        }
    }

    /// The largest value of the form at which the criterion is at most `value`.
    pub(crate) fn sum_at_value(&self, value: f64) -> f64 {
        if self.is_product {
            2.0 * value.max(0.0).sqrt()
        } else {
            value
        }
    }
}
