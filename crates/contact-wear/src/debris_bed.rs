//! Settings of the bed of debris in a contact.

use contact_core::Error;

use super::air::check_positive;

/// A bed of debris, of the volume h per area:
///
/// ```text
/// dh/dN = e (w_1' + w_2') + div(K grad h),   K = kappa (slip of the cell per cycle/4)^2,
/// ```
///
/// h = 0 on the border of the closed region. Starved wear counts `starved_yield` times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DebrisBed {
    /// Transport number per cycle: K over the square of the slip amplitude.
    pub kappa: f64,
    /// Volume of debris over worn volume e (default 1).
    pub volume_ratio: f64,
    /// Part of the volume worn without oxygen that enters the bed (default 1). The rest leaves.
    pub starved_yield: f64,
    /// Thickness h_ref of a protecting bed \[m\]: wear coefficients are divided by 1 + h/h_ref
    /// (default none).
    pub protecting_thickness: Option<f64>,
}

impl DebrisBed {
    /// A bed of a transport number, all else by default.
    pub fn new(kappa: f64) -> Self {
        Self {
            kappa,
            volume_ratio: 1.0,
            starved_yield: 1.0,
            protecting_thickness: None,
        }
    }

    /// Fails at constants without a meaning.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if !(self.kappa >= 0.0 && self.kappa.is_finite()) {
            let allowed = "a finite number >= 0 per cycle";
            return Err(Error::invalid("wear.bed.kappa", self.kappa, allowed));
        }
        check_positive(
            "wear.bed.volume_ratio",
            self.volume_ratio,
            "m^3 of debris per m^3 worn",
        )?;
        if !(0.0..=1.0).contains(&self.starved_yield) {
            let key = "wear.bed.starved_yield";
            return Err(Error::invalid(key, self.starved_yield, "between 0 and 1"));
        }
        match self.protecting_thickness {
            Some(h) => check_positive("wear.bed.protecting_thickness", h, "m"),
            None => Ok(()),
        }
    }

    /// Factor of the wear coefficients under the bed h \[m\].
    pub(crate) fn protection(&self, h: f64) -> f64 {
        self.protecting_thickness
            .map_or(1.0, |reference| 1.0 / (1.0 + h / reference))
    }
}
