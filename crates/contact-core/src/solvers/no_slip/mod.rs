//! The displacement without slip, eq. (7): the reference of the slip increment.
//!
//! ```text
//! ds = u - u_0 - B d(delta),     u_0 = u_start - r + m + t
//! ```
//!
//! with terms in metres, each a field:
//!
//! - u_start: the displacement of the material of the cell at the start of the increment, rolled
//!   and stretched with it;
//! - r, the residual slip: slip of the last increment that should be zero (all of it in
//!   stick cells, in slip cells the part that does not oppose the shear), within the tolerance.
//!   It is subtracted here, so that it does not add up along the path (defect correction);
//! - m, the entry motion of cells outside the last contact: their free motion before they
//!   touch;
//! - t, the turn of cells in the last contact: eq. (8) makes the slip opposite to the shear at the
//!   end of the increment, but the shear rotated while the cell slipped.
//!
//! Slip is computed here and nowhere else: [`slip`] in one cell.

mod slip;
mod turn;

use rayon::prelude::*;

pub use self::slip::{slip, unopposed_part};
pub use self::turn::EarlierTractions;
use self::turn::turn_of_cell;
use super::Interface;
use crate::cells::{Arms, CHUNK, length, set_fields};

/// The fields of u_0, allocated once for all increments.
#[derive(Debug)]
pub struct NoSlipTerms {
    /// u_0 \[m\].
    sum: [Vec<f64>; 2],
    /// m of cells outside the last contact, t of cells in it \[m\].
    added: [Vec<f64>; 2],
    /// t': derivative of t by the angle of the final shear, over |ds| \[1\].
    turning: Vec<f64>,
}

impl NoSlipTerms {
    /// Allocates the fields for `cells` cells.
    pub fn new(cells: usize) -> Self {
        let pair = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            sum: pair(),
            added: pair(),
            turning: vec![0.0; cells],
        }
    }

    /// m or t in cell n \[m\].
    pub fn entry_or_turn(&self, n: usize) -> [f64; 2] {
        [self.added[0][n], self.added[1][n]]
    }

    /// u_0 \[m\].
    pub fn displacement(&self) -> [&[f64]; 2] {
        [&self.sum[0], &self.sum[1]]
    }
}

/// The start of the increment.
#[derive(Clone, Copy)]
pub struct Start<'a> {
    /// Tractions and displacements of the material that is now in each cell.
    pub interface: &'a Interface,
    /// r: the residual slip of the last increment \[m\].
    pub residual: &'a [Vec<f64>; 2],
    /// Positions of the cells.
    pub arms: &'a Arms,
    /// The tractions an increment earlier, where t is computed.
    pub earlier: Option<EarlierTractions<'a>>,
    /// Elastic displacement at which the bodies slide, about mu times the approach \[m\].
    pub elastic_slip: f64,
}

/// The displacement without slip in an increment.
pub struct NoSlip<'a> {
    start: Start<'a>,
    terms: &'a mut NoSlipTerms,
}

impl<'a> NoSlip<'a> {
    /// Starts with t = 0 and the entry motion m of cells outside the contact \[m\], zero by default.
    pub fn new(
        start: Start<'a>,
        terms: &'a mut NoSlipTerms,
        entry: Option<&[Vec<f64>; 2]>,
    ) -> Self {
        let [x, y] = &mut terms.added;
        match entry {
            Some([to_x, to_y]) => set_fields([&to_x[..], to_y], [x, y], |_, to, _| to),
            None => set_fields([], [x, y], |_, [], _| [0.0; 2]),
        }
        let (u, r) = (&start.interface.u, start.residual);
        let from = [&u[0][..], &u[1], &r[0], &r[1], x, y];
        let [x, y] = &mut terms.sum;
        set_fields(from, [x, y], |_, [u_x, u_y, r_x, r_y, x, y], _| {
            [u_x - r_x + x, u_y - r_y + y]
        });
        Self { start, terms }
    }

    /// u_0 \[m\].
    pub fn displacement(&self) -> [&[f64]; 2] {
        self.terms.displacement()
    }

    /// t' in each cell \[1\].
    pub fn turning(&self) -> &[f64] {
        &self.terms.turning
    }

    /// Whether t is computed at all.
    pub fn has_turn(&self) -> bool {
        self.start.earlier.is_some()
    }

    /// Updates t += `relaxation` (t_new - t), with t_new of the shear `now` and the `shift` d(delta) \[m\].
    /// Returns false, with t = 0, where no cell sticks: the bodies then slide along the prescribed
    /// motion, and the shear has its direction at the end.
    pub fn update_turn(&mut self, now: &Interface, shift: [f64; 3], relaxation: f64) -> bool {
        let Some(earlier) = self.start.earlier else {
            return false;
        };
        if !(0..now.p.len()).any(|n| now.p[n] > 0.0 && !now.slips[n]) {
            self.clear_turn();
            return false;
        }
        let Start {
            interface: last,
            residual,
            arms,
            elastic_slip,
            ..
        } = self.start;
        let turn_and_derivative = |n: usize| -> ([f64; 2], f64) {
            if !(now.p[n] > 0.0 && now.slips[n]) {
                return ([0.0; 2], 0.0);
            }
            let at_cell = |u: &[Vec<f64>; 2]| [u[0][n], u[1][n]];
            let slip = length(slip(
                at_cell(&now.u),
                at_cell(&last.u),
                arms.displacement_in_plane(shift, n),
            ));
            // The turn fades out for slips between half of and all of the elastic displacement: the
            // bodies slide then.
            let fade = (2.0 - 2.0 * slip / elastic_slip).clamp(0.0, 1.0);
            turn_of_cell(last, &earlier, now, slip, n)
                .map_or(([0.0; 2], 0.0), |(across, follows)| {
                    (across.map(|t| fade * t), relaxation * fade * follows)
                })
        };
        let NoSlipTerms {
            sum: [u_x, u_y],
            added: [x, y],
            turning,
        } = &mut *self.terms;
        let chunks = (
            x.par_chunks_mut(CHUNK),
            y.par_chunks_mut(CHUNK),
            turning.par_chunks_mut(CHUNK),
            u_x.par_chunks_mut(CHUNK),
            u_y.par_chunks_mut(CHUNK),
        );
        let chunks = chunks.into_par_iter().enumerate();
        chunks.for_each(|(chunk, (x, y, turning, u_x, u_y))| {
            for (i, n) in (chunk * CHUNK..).take(x.len()).enumerate() {
                if last.p[n] <= 0.0 {
                    turning[i] = 0.0;
                    continue;
                }
                let (target, follows) = turn_and_derivative(n);
                // A cell that sticks has t = 0 at once, without relaxation.
                let part = if now.slips[n] { relaxation } else { 1.0 };
                x[i] += part * (target[0] - x[i]);
                y[i] += part * (target[1] - y[i]);
                u_x[i] = last.u[0][n] - residual[0][n] + x[i];
                u_y[i] = last.u[1][n] - residual[1][n] + y[i];
                turning[i] = follows;
            }
        });
        true
    }

    /// Sets t = 0, where the iteration for it does not converge: the slip is opposite to the final
    /// shear.
    pub fn clear_turn(&mut self) {
        if self.start.earlier.is_none() {
            return;
        }
        let (last, r) = (self.start.interface, self.start.residual);
        let NoSlipTerms {
            sum: [u_x, u_y],
            added: [x, y],
            turning,
        } = &mut *self.terms;
        let from = [&last.p[..], &last.u[0], &last.u[1], &r[0], &r[1]];
        let to = [&mut u_x[..], u_y, x, y, turning];
        set_fields(from, to, |_, [p, x, y, r_x, r_y], old| {
            if p > 0.0 {
                [x - r_x, y - r_y, 0.0, 0.0, 0.0]
            } else {
                old
            }
        });
    }
}
