//! One attempt of a jump: implicit ones whole and in two halves, extrapolated to second order.

use contact_core::Error;

use super::loss::{Loss, Worn};
use super::model::{Model, ModelState};

/// An attempted jump.
pub(super) struct Attempt {
    pub(super) loss: Loss,
    /// Loss in its first half \[m\].
    pub(super) half: [Vec<f64>; 2],
    /// Root mean square of the correction by extrapolation, over the worn depth.
    pub(super) error: f64,
    /// Root mean square of the change of the pressure at the end, over the pressure.
    pub(super) pressure_error: f64,
    /// Change of the mean coefficient of friction by extrapolation, over it.
    pub(super) mu_error: f64,
    /// Difference of the worn depths of the two halves and of the whole jump \[m\].
    pub(super) correction: [Vec<f64>; 2],
}

impl Attempt {
    /// Makes a jump of n cycles with the pressure of its start, without an error.
    pub(super) fn explicit(model: &mut Model, worn: &Worn, n: f64) -> Result<Self, Error> {
        let loss = model.jump(worn, n, false)?;
        let none = loss.depth.each_ref().map(|d| vec![0.0; d.len()]);
        let half = |d: &Vec<f64>| d.iter().map(|w| 0.5 * w).collect();
        Ok(Self {
            half: loss.depth.each_ref().map(half),
            loss,
            error: 0.0,
            pressure_error: 0.0,
            mu_error: 0.0,
            correction: none,
        })
    }

    /// Makes a jump of n cycles with the pressure of its end, from the state of the model at its
    /// start.
    pub(super) fn implicit(
        model: &mut Model,
        start: &ModelState,
        worn: &Worn,
        n: f64,
    ) -> Result<Self, Error> {
        let whole = model.jump(worn, n, true)?;
        let pressure = model.pressures();
        let end = model.take_end();
        model.restore(start);
        model.start_towards(end.as_ref(), 0.5);
        let first = model.jump(worn, 0.5 * n, true)?;
        let mut middle = worn.clone();
        middle.add(&first);
        model.start_towards(end.as_ref(), 1.0);
        let second = model.jump(&middle, 0.5 * n, true)?;
        let pressure_error = relative_difference(&pressure, &model.pressures());
        let one_half = first.depth.clone();
        let halves = first.plus(&second);
        let moved: [Vec<f64>; 2] = [0, 1].map(|b| {
            let pairs = halves.depth[b].iter().zip(&whole.depth[b]);
            pairs.map(|(halves, whole)| halves - whole).collect()
        });
        let mu = halves.mean_mu(1.0);
        let (loss, error) = halves.extrapolated(&whole, worn);
        let mu_error = (loss.mean_mu(mu) / mu - 1.0).abs();
        // The second-order correction of a first half is half of the correction of the whole jump.
        let half = [0, 1].map(|b| {
            let cells = one_half[b].iter().zip(&moved[b]).zip(&loss.depth[b]);
            let corrected = |((half, moved), whole): ((&f64, &f64), &f64)| {
                (half + 0.5 * moved).clamp(0.25 * whole, 0.75 * whole)
            };
            cells.map(corrected).collect::<Vec<f64>>()
        });
        Ok(Self {
            loss,
            half,
            error,
            pressure_error,
            mu_error,
            correction: moved,
        })
    }
}

/// Root mean square of the difference of two fields, over the root mean square of the second.
fn relative_difference(a: &[f64], b: &[f64]) -> f64 {
    let (mut differs, mut size) = (0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        differs += (a - b).powi(2);
        size += b * b;
    }
    (differs / f64::max(size, f64::MIN_POSITIVE)).sqrt()
}
