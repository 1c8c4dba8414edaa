//! The first guess of an increment.

use ndarray::Array2;
use rayon::prelude::*;

use super::window::Window;
use super::{March, State};
use crate::cells::{CHUNK, Drive, set, size, sweep};
use crate::scene::{Given, LoadPoint, Loads};
use crate::solvers::Interface;
use crate::solvers::intermediate::friction_bound;

impl Loads {
    /// The change from `before` and `motions` to here, of what is given.
    pub(crate) fn since(&self, before: &Self, motions: [f64; 6]) -> Self {
        let forces = before.forces();
        let (to, given) = (self.forces(), self.given.motions());
        let force = |k: usize| given[k].map_or(to[k] - forces[k], |_| 0.0);
        let motion = |k: usize| given[k].map(|to| to - motions[k]);
        Self {
            sigma_B: self.sigma_B - before.sigma_B,
            sigma_B1: self.sigma_B1 - before.sigma_B1,
            rolled: self.rolled - before.rolled,
            ..Self::default()
        }
        .with_forces(
            std::array::from_fn(force),
            Given::from_motions(std::array::from_fn(motion)),
        )
    }

    /// The factor f with self = f other, if the two changes are of the same kind and point the same
    /// way.
    fn along(&self, other: &Self) -> Option<f64> {
        let (a, b) = (self.given.motions(), other.given.motions());
        if (0..6).any(|k| a[k].is_some() != b[k].is_some()) {
            return None;
        }
        let (f, g) = (self.forces(), other.forces());
        let pairs = (0..6)
            .map(|k| a[k].zip(b[k]).unwrap_or((f[k], g[k])))
            .chain([
                (self.sigma_B, other.sigma_B),
                (self.sigma_B1, other.sigma_B1),
                (self.rolled, other.rolled),
            ]);
        let (mut both, mut own, mut its) = (0.0, 0.0, 0.0);
        for (a, b) in pairs {
            // Forces, moments, lengths and angles compare as parts of the larger of the two.
            let scale = a.abs().max(b.abs());
            if scale > 0.0 {
                let (a, b) = (a / scale, b / scale);
                both += a * b;
                own += a * a;
                its += b * b;
            }
        }
        let parallel = both > 0.0 && both * both >= (1.0 - 1e-9) * own * its;
        parallel.then(|| both / its)
    }
}

impl March {
    /// The pressure that closes the gaps and overlaps which the last increment has left within its
    /// tolerance, about; none where the shear does not open them. Left alone they would add up, and
    /// the pressure would have to be solved for in every other increment.
    pub(super) fn closing_pressure(&mut self, normal: &Drive) -> Option<Vec<f64>> {
        if !(self.plan.coupling && self.plan.friction) || self.carried.is_some() {
            return None;
        }
        let approach = self.approach_before();
        let Window {
            h_init,
            arms,
            inverse,
            ..
        } = &mut self.window;
        let inverse = inverse.as_mut()?;
        let Interface { p, u_z, .. } = &self.state.interface;
        let fields = [&p[..], u_z, h_init];
        // The overlap, and one in cells that touch, zero elsewhere.
        let touching = |n: usize, [p, u_z, h]: [f64; 3]| {
            let overlap = arms.across(approach, n) - u_z - h;
            let touches = p > 0.0 || overlap > 0.0;
            [overlap, 1.0].map(|v| if touches { v } else { 0.0 })
        };
        let (mut overlaps, mut touches) = (vec![0.0; p.len()], vec![0.0; p.len()]);
        let to = [&mut overlaps[..], &mut touches];
        set(fields, to, |n, cell, _| touching(n, cell));
        let mut closing = vec![0.0; p.len()];
        inverse.normal(&overlaps, &mut closing);
        let fields = [&touches[..], &closing];
        let rigid = arms.fit_across(normal.free, fields, |_, [touches, z]| (touches, z));
        set([&touches[..]], [&mut closing], |n, [touches], [z]| {
            [touches * (z - arms.across(rigid, n))]
        });
        Some(closing)
    }
}

impl State {
    /// The factor by which the change of the loads to a point is that of the last increment, if both
    /// go the same way.
    pub(super) fn going_on(&self, point: &LoadPoint) -> Option<f64> {
        let step = point.loads.since(&self.loads, self.motion.motions());
        step.along(&self.step).filter(|_| self.increments > 1)
    }

    /// Tractions and slip set to start from: the last increment's, extrapolated while the loads
    /// keep their direction (the paper takes them as they are). At a reversal every cell is taken
    /// to stick: slip needs the load to move on before it sets in again. Bodies that have not touched
    /// start from the pressure `touch`, those in contact close what gaps they have left
    /// ([`March::closing_pressure`]).
    pub(crate) fn predict(
        &self,
        point: &LoadPoint,
        touch: Option<Vec<f64>>,
        closing: Option<&[f64]>,
        mu: &[f64],
        normal: &Drive,
        extrapolates: bool,
    ) -> Interface {
        let mut guess = self.interface.clone();
        if let Some(p) = touch {
            guess.p = p;
        }
        if let Some(closing) = closing {
            set([closing], [&mut guess.p], |_, [closing], [p]| [p + closing]);
        }
        let same_way = self.going_on(point);
        if let Some(factor) = same_way.filter(|_| extrapolates) {
            let from = [&self.interface.p[..], &self.p_before];
            set(from, [&mut guess.p], |_, [p, before], [closed]| {
                [closed + factor * (p - before)]
            });
            approach_slip(&mut guess, &self.q_before, mu, factor);
        } else if same_way.is_none() {
            guess.slip.fill(false);
        }
        let [sum] = sweep([], [&mut guess.p], |_, [], [p]| {
            ([p.max(0.0)], [p.max(0.0)])
        });
        if normal.free[0] {
            let factor = normal.sums[0] / sum;
            set([], [&mut guess.p], |_, [], [p]| [p * factor]);
        }
        guess
    }
}

/// Extrapolates the shear. The shear of a stick cell nears its bound as the root of the distance
/// to the moving slip front (Cattaneo: g - q ~ (c^2 - r^2)^(1/2)): the square of what is left of the way
/// to the bound is extrapolated; a cell for which nothing is left starts to slip.
fn approach_slip(guess: &mut Interface, q_before: &[Vec<f64>; 2], mu: &[f64], factor: f64) {
    let Interface { p, q, slip, .. } = guess;
    let [q_x, q_y] = q;
    let chunks = (
        q_x.par_chunks_mut(CHUNK),
        q_y.par_chunks_mut(CHUNK),
        slip.par_chunks_mut(CHUNK),
    );
    let chunks = chunks.into_par_iter().enumerate();
    chunks.for_each(|(chunk, (q_x, q_y, slip))| {
        for (i, n) in (chunk * CHUNK..).take(q_x.len()).enumerate() {
            let bound = friction_bound(mu[n], p[n]);
            if bound <= 0.0 {
                continue;
            }
            let q = [q_x[i], q_y[i]];
            let change = [q[0] - q_before[0][n], q[1] - q_before[1][n]];
            let moved = size(change);
            let inside = bound * bound - q[0] * q[0] - q[1] * q[1];
            let mut part = factor;
            if !slip[i] && inside > 0.0 && inside.is_finite() && moved > 0.0 {
                let along = (q[0] * change[0] + q[1] * change[1]) / moved;
                let left = (along * along + inside).sqrt() - along;
                let before = left + moved;
                let square = left * left + factor * (left * left - before * before);
                slip[i] = square <= 0.0;
                part = (left - square.max(0.0).sqrt()) / moved;
            }
            q_x[i] += part * change[0];
            q_y[i] += part * change[1];
        }
    });
}

/// A pressure for bodies that have not touched: that of a Hertz contact of the given approach \[m\],
/// up to a factor.
pub(super) fn first_touch(h_init: &Array2<f64>, approach: f64) -> Array2<f64> {
    let lowest = h_init.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    let p = |h: &f64| {
        if approach > 0.0 {
            (1.0 - 2.0 * (h - lowest) / approach).max(0.0).sqrt()
        } else {
            0.0
        }
    };
    h_init.map(p)
}
