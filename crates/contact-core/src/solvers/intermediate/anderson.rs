//! Anderson acceleration of the intermediate loop, for contacts where plain alternation is slow.
//!
//! The unknown of the loop is the part s of u_z that the shear causes: the pressure is solved for a
//! given s, the shear for that pressure, and this shear causes G(s). Plain alternation takes s =
//! G(s); it contracts as long as friction times coupling is small. Where the misfit f = G(s) - s
//! falls too slowly, the next s is the combination of the last ones whose misfit on the contact is
//! least, plus that misfit times a damping factor (D. G. Anderson, J. ACM 12 (1965) 547-560; H. F.
//! Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715-1735).
//!
//! Steel scenes never need it; a rigid sphere on a body with nu = 0 and mu = 2, pressed and sheared
//! on 64 x 64 cells, takes 2800 convolutions with it and 12 700 without.

use std::collections::VecDeque;

use crate::cells::{set_fields, sums};

/// Passes that are combined.
const DEPTH: usize = 8;
/// A pass is slow if the misfit after it is more than SLOW times the misfit before it.
const SLOW: f64 = 0.5;
/// Slow passes before the acceleration begins.
const SLOW_PASSES: usize = 2;
/// Accelerated passes in a row, none with a misfit below [`SLOW`] times the least, after which the
/// damping is halved.
const TRIALS: usize = 12;
/// Smallest damping.
const MIN_DAMPING: f64 = 1.0 / 16.0;
/// Regularisation of the least squares, relative to the mean square.
const RIDGE: f64 = 1e-12;

/// Memory of the loop over one increment.
#[derive(Debug)]
pub(crate) struct Anderson {
    /// s - G, G being the u_z under the present shear \[m\]; zero in plain alternation.
    ahead: Vec<f64>,
    /// Misfit of the last pass \[m\].
    misfit: Vec<f64>,
    /// Change of s after the last pass \[m\].
    step: Vec<f64>,
    /// Changes of misfit and of s in the last passes.
    changes: VecDeque<[Vec<f64>; 2]>,
    /// Root of the sum of squares of the last misfit on the contact.
    size: f64,
    slow_passes: usize,
    enabled: bool,
    /// Damping: factor of the misfit that is added to s, 1 to [`MIN_DAMPING`].
    damping: f64,
    /// Least misfit that was below [`SLOW`] times the one before, and passes since.
    least_misfit: f64,
    since_least: usize,
}

impl Anderson {
    /// Allocates buffers for fields of `cells` cells.
    pub(crate) fn new(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            ahead: field(),
            misfit: field(),
            step: field(),
            changes: VecDeque::new(),
            size: f64::INFINITY,
            slow_passes: 0,
            enabled: true,
            damping: 1.0,
            least_misfit: f64::INFINITY,
            since_least: 0,
        }
    }

    /// Restarts in plain alternation; stays there unless `enabled`.
    pub(crate) fn restart(&mut self, enabled: bool) {
        self.enabled = enabled;
        set_fields([], [&mut self.ahead], |_, [], _| [0.0]);
        self.changes.clear();
        self.size = f64::INFINITY;
        self.slow_passes = 0;
        self.damping = 1.0;
        self.least_misfit = f64::INFINITY;
        self.since_least = 0;
    }

    /// Whether [`SLOW_PASSES`] passes were slow, so that passes are combined.
    pub(crate) fn accelerates(&self) -> bool {
        self.enabled && self.slow_passes >= SLOW_PASSES
    }

    /// Corrects `u_z` from the assumed s to the s of the tractions, after a pass in which u_z under the
    /// shear changed by `change`.
    pub(crate) fn close_pass(&mut self, change: &[f64], u_z: &mut [f64]) {
        let cells = u_z.len();
        if self.accelerates() {
            let oldest = if self.changes.len() == DEPTH {
                self.changes.pop_front()
            } else {
                None
            };
            let oldest = oldest.unwrap_or_else(|| [vec![0.0; cells], vec![0.0; cells]]);
            self.changes.push_back(oldest);
        }
        if let Some([of_misfit, of_s]) = self.changes.back_mut() {
            let (ahead, last, step) = (&self.ahead, &self.misfit, &self.step);
            let from = [change, ahead, last, step];
            set_fields(
                from,
                [of_misfit, of_s],
                |_, [change, ahead, last, step], _| [change - ahead - last, step],
            );
        }
        let to = [&mut self.misfit[..], u_z, &mut self.ahead];
        set_fields([change], to, |_, [change], [_, u_z, ahead]| {
            let misfit = change - ahead;
            [misfit, u_z + misfit, 0.0]
        });
    }

    /// Adds the next s - G to `u_z`; the misfit is weighed on the contact, p > 0.
    pub(crate) fn extrapolate(&mut self, p: &[f64], u_z: &mut [f64]) {
        let dot_on_contact = |a: &[f64], b: &[f64]| -> f64 {
            let inside = |p: f64, product: f64| if p > 0.0 { product } else { 0.0 };
            let [sum] = sums([p, a, b], |_, [p, a, b]| [inside(p, a * b)]);
            sum
        };
        let size = dot_on_contact(&self.misfit, &self.misfit).sqrt();
        if !self.accelerates() {
            self.slow_passes += usize::from(size > SLOW * self.size);
        }
        self.size = size;
        self.since_least += 1;
        if size < SLOW * self.least_misfit {
            (self.least_misfit, self.since_least) = (size, 0);
        } else if self.accelerates() && self.since_least >= TRIALS {
            self.damping = (0.5 * self.damping).max(MIN_DAMPING);
            self.since_least = 0;
            self.changes.clear();
        }
        let damping = self.damping;
        let misfit = &self.misfit;
        set_fields([&misfit[..]], [&mut self.step], |_, [misfit], _| {
            [damping * misfit]
        });
        let count = self.changes.len();
        let mut gram = [[0.0; DEPTH]; DEPTH];
        let mut right_hand_side = [0.0; DEPTH];
        for (i, [of_misfit, _]) in self.changes.iter().enumerate() {
            right_hand_side[i] = dot_on_contact(of_misfit, &self.misfit);
            for (j, [other_change, _]) in self.changes.iter().enumerate().take(i + 1) {
                gram[i][j] = dot_on_contact(of_misfit, other_change);
            }
        }
        let weights = least_squares(gram, right_hand_side, count);
        for (weight, [of_misfit, of_s]) in weights.iter().zip(&self.changes) {
            let from = [&of_s[..], of_misfit];
            set_fields(from, [&mut self.step], |_, [s, misfit], [step]| {
                [step - weight * (s + damping * misfit)]
            });
        }
        let from = [&self.step[..], misfit];
        set_fields(
            from,
            [&mut self.ahead, u_z],
            |_, [step, misfit], [_, u_z]| {
                let ahead = step - misfit;
                [ahead, u_z + ahead]
            },
        );
    }
}

/// Solves gram x = right for the leading `count` unknowns by Cholesky's method, slightly
/// regularised; `gram` is given by its lower half.
fn least_squares(
    mut gram: [[f64; DEPTH]; DEPTH],
    mut right_hand_side: [f64; DEPTH],
    count: usize,
) -> [f64; DEPTH] {
    let trace: f64 = (0..count).map(|i| gram[i][i]).sum();
    for i in 0..count {
        gram[i][i] += RIDGE * trace;
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| gram[i][k] * gram[j][k]).sum();
            gram[i][j] = if i == j {
                (gram[i][i] - sum).max(f64::MIN_POSITIVE).sqrt()
            } else {
                (gram[i][j] - sum) / gram[j][j]
            };
        }
    }
    for i in 0..count {
        let sum: f64 = (0..i).map(|k| gram[i][k] * right_hand_side[k]).sum();
        right_hand_side[i] = (right_hand_side[i] - sum) / gram[i][i];
    }
    for i in (0..count).rev() {
        let sum: f64 = (i + 1..count)
            .map(|k| gram[k][i] * right_hand_side[k])
            .sum();
        right_hand_side[i] = (right_hand_side[i] - sum) / gram[i][i];
    }
    right_hand_side
}
