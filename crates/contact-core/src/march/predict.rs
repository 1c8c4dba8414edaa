//! The first guess of an increment.

use super::State;
use crate::scene::{LoadPoint, Loads, Preset};
use crate::solvers::Interface;

impl Loads {
    /// The factor f with self = f other, if the two point the same way.
    fn along(&self, other: &Self) -> Option<f64> {
        let dot = |a: &Self, b: &Self| a.W * b.W + a.T_x * b.T_x + a.T_y * b.T_y;
        let (both, own, its) = (dot(self, other), dot(self, self), dot(other, other));
        let parallel = both > 0.0 && both * both >= (1.0 - 1e-9) * own * its;
        parallel.then(|| both / its)
    }
}

impl State {
    /// Tractions and slip set to start from: the last increment's, extrapolated while the loads
    /// keep their direction (the paper takes them as they are). At a reversal every cell is taken to stick: slip needs the load to
    /// move on before it sets in again.
    pub(crate) fn predict(
        &self,
        point: &LoadPoint,
        h_init: &[f64],
        sum_p: f64,
        approach: f64,
        preset: Preset,
    ) -> Interface {
        let mut guess = self.interface.clone();
        if sum_p <= 0.0 {
            return Interface::unloaded(h_init.len());
        }
        if self.loads.W <= 0.0 {
            first_touch(&mut guess, h_init, approach);
        }
        let step = Loads {
            W: point.loads.W - self.loads.W,
            T_x: point.loads.T_x - self.loads.T_x,
            T_y: point.loads.T_y - self.loads.T_y,
        };
        let same_way = step.along(&self.step).filter(|_| self.increments > 1);
        if let (Some(factor), Preset::Fast) = (same_way, preset) {
            extrapolate(&mut guess.p, &self.p_before, factor);
            guess.p.iter_mut().for_each(|p| *p = p.max(0.0));
            for c in 0..2 {
                extrapolate(&mut guess.q[c], &self.q_before[c], factor);
            }
        } else if same_way.is_none() {
            guess.slip.fill(false);
        }
        let factor = sum_p / guess.p.iter().sum::<f64>();
        guess.p.iter_mut().for_each(|p| *p *= factor);
        guess
    }
}

/// now + factor (now - before)
fn extrapolate(now: &mut [f64], before: &[f64], factor: f64) {
    now.iter_mut()
        .zip(before)
        .for_each(|(now, before)| *now += factor * (*now - before));
}

/// A pressure for bodies that have not touched: that of a Hertz contact of the given approach.
fn first_touch(guess: &mut Interface, h_init: &[f64], approach: f64) {
    let lowest = h_init.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    for (p, h) in guess.p.iter_mut().zip(h_init) {
        *p = (1.0 - 2.0 * (h - lowest) / approach).max(0.0).sqrt();
    }
}
