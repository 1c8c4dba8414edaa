//! Linear bounds of a criterion in its two parts, exact at given parts.
//!
//! A product a h of a >= 0 and h = z + w b is at most the square of (r a + h/r)/2 for any r > 0
//! where h >= 0, and at most 0 elsewhere; both are equal where r^2 = h/a. The sum r a + h/r has a
//! second derivative along great circles of at least -(r K_a + w K_b/r).

/// x a + y b + z: the criterion is at most that, or at most the square of half of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent {
    pub(crate) first: f64,
    pub(crate) second: f64,
    pub(crate) constant: f64,
    of_product: bool,
}

impl Tangent {
    /// Bounds nothing.
    pub(crate) const NONE: Self = Self {
        first: 0.0,
        second: 0.0,
        constant: f64::INFINITY,
        of_product: false,
    };

    /// a + w b itself.
    pub(crate) fn sum(weight: f64) -> Self {
        Self {
            first: 1.0,
            second: weight,
            constant: 0.0,
            of_product: false,
        }
    }

    /// Of a (z + w b), at parts where it is positive; elsewhere it bounds nothing.
    pub(crate) fn of_product(constant: f64, weight: f64, [a, b]: [f64; 2]) -> Self {
        let r = ((constant + weight * b) / a).sqrt();
        if !(r > 0.0 && r.is_finite()) {
            return Self::NONE;
        }
        Self {
            first: r,
            second: weight / r,
            constant: constant / r,
            of_product: true,
        }
    }

    /// The sum of two parts.
    pub(crate) fn of(&self, [a, b]: [f64; 2]) -> f64 {
        self.first * a + self.second * b + self.constant
    }

    /// Upper bound of the criterion where the sum is at most this.
    pub(crate) fn value(&self, sum: f64) -> f64 {
        if self.of_product {
            (sum.max(0.0) / 2.0).powi(2)
        } else {
            sum
        }
    }

    /// The sum up to which the criterion is at most this value.
    pub(crate) fn sum_of(&self, value: f64) -> f64 {
        if self.of_product {
            2.0 * value.max(0.0).sqrt()
        } else {
            value
        }
    }
}
