//! How well the equations hold at the end of an increment, from the fields alone.

use super::{Increment, March, Residuals, Status};
use crate::cells::{set, size, survey};
use crate::error::Error;
use crate::scene::{Given, LoadPoint, Loads, Preset};
use crate::solvers::Interface;
use crate::solvers::intermediate::{CoupledInfo, friction_bound};

/// What sums in another order may differ by.
const ROUNDING: f64 = 1e-9;

impl March {
    /// How well the equations hold; and the largest pressure and shear \[Pa\].
    pub(super) fn residuals(
        &self,
        point: &LoadPoint,
        now: &Interface,
        info: &CoupledInfo,
        cell_area: f64,
    ) -> (Residuals, [f64; 2]) {
        let mu = self.scene.friction.scale();
        let arms = &self.window.arms;
        let [datum_x, datum_y] = &self.datum.displacements;
        let tractions = [&now.p[..], &now.q[0], &now.q[1], &self.mu];
        let moved = [&now.u[0][..], &now.u[1], datum_x, datum_y];
        let heights = [&now.u_z[..], &self.window.h_init];
        let fields = ((tractions, moved), (heights, &now.slip[..]));
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let (sums, largest) = survey(fields, |n, ((tractions, moved), ([u_z, h], slips))| {
            let ([p, q_x, q_y, mu], [u_x, u_y, x, y]) = (tractions, moved);
            let (gap, bound) = (
                u_z + h - arms.across(info.approach, n),
                friction_bound(mu, p),
            );
            let (stretched, excess) = (size([q_x, arms.stretch * q_y]), size([q_x, q_y]) - bound);
            if p <= 0.0 {
                return ([0.0; 6], [p, stretched, excess, -gap]);
            }
            let largest = [p, stretched, excess, 0.0];
            let shift = arms.in_plane(info.shift, n);
            let slip = [u_x - x - shift[0], u_y - y - shift[1]];
            if !slips {
                return ([1.0, 0.0, gap * gap, square(slip), 0.0, 0.0], largest);
            }
            let off = not_opposite(slip, [q_x, q_y], bound);
            (
                [1.0, 1.0, gap * gap, 0.0, square(off), square(slip)],
                largest,
            )
        });
        let [contact, slipping, gap_squares, stick, direction, slipped] = sums;
        let [p_max, q_max, excess, overlap] = largest;
        let mut r = Residuals {
            coulomb: excess,
            ..Residuals::default()
        };
        let rms = |squares: f64, count: f64| (squares / count.max(1.0)).sqrt();
        if contact > 0.0 {
            r.gap = rms(gap_squares, contact) / self.approach;
            r.penetration = overlap / self.approach;
        }
        if slipped > 0.0 {
            r.angle = (direction / slipped).sqrt().min(1.0).asin();
        }
        if mu > 0.0 && contact > 0.0 {
            r.stick = rms(stick, contact - slipping) / (mu * self.approach);
            r.direction = rms(direction, slipping) / (mu * self.approach);
        }
        if mu * p_max > 0.0 {
            r.coulomb /= mu * p_max;
        }
        r.balance = self.missing_loads(point, now, mu, cell_area);
        (r, [p_max, q_max])
    }

    /// Largest error of the balances of the loads that are given: across the plane over W, in it
    /// over mu W, moments over these times the grid's half-length.
    fn missing_loads(&self, point: &LoadPoint, now: &Interface, mu: f64, cell_area: f64) -> f64 {
        let all_given = LoadPoint {
            loads: Loads {
                given: Given::from_motions([Some(0.0); 6]),
                ..point.loads
            },
            ..*point
        };
        let carried = self.transmitted(&all_given, now, cell_area).forces();
        let (asked, motions) = (point.loads.forces(), point.loads.given.motions());
        let W = carried[0];
        let scale = |k: usize| {
            if k < 3 {
                W * self.unit(k)
            } else {
                mu * W * self.unit(k)
            }
        };
        (0..6)
            .filter(|&k| motions[k].is_none() && scale(k) > 0.0)
            .fold(0.0, |worst, k| {
                ((carried[k] - asked[k]) / scale(k)).abs().max(worst)
            })
    }

    /// Whatever a solver took for solved: gap and overlap, and the slip that should not be over the
    /// `contact` cells, of which some slip, are within the tolerance, or the increment is not.
    pub(super) fn check_residuals(
        &self,
        increment: &Increment,
        (contact, slipping): (usize, usize),
    ) -> Result<(), Error> {
        let r = &increment.residuals;
        let mu = self.scene.friction.scale();
        let slips = if increment.status == Status::GrossSlip {
            // A body that slides may have any shift beyond the incipient one.
            0.0
        } else {
            let stick = r.stick.powi(2) * (contact - slipping) as f64;
            let direction = r.direction.powi(2) * slipping as f64;
            mu.max(1.0) * ((stick + direction) / contact.max(1) as f64).sqrt()
        };
        let worst = r.gap.max(r.penetration).max(slips);
        let tolerance = self.scene.tolerance();
        if worst <= tolerance * (1.0 + ROUNDING) {
            return Ok(());
        }
        Err(Error::NotConverged {
            increment: increment.index,
            solver: "coupled",
            residual: worst * self.approach,
            tolerance: tolerance * self.approach,
            iterations: increment.work.alternations,
        })
    }

    /// Notes the slip that should not be, for the next increment to make good; a body that slides may
    /// have any shift beyond the incipient one.
    pub(super) fn note_missed(&mut self, now: &Interface, shift: [f64; 3], slides: bool) {
        let fast = self.scene.settings.solver.preset == Preset::Fast;
        let (arms, mu) = (&self.window.arms, &self.mu);
        let [datum_x, datum_y] = &self.datum.displacements;
        let [x, y] = &mut self.state.missed;
        let tractions = [&now.p[..], &now.q[0], &now.q[1], mu];
        let moved = [&now.u[0][..], &now.u[1], datum_x, datum_y];
        let fields = ((tractions, moved), &now.slip[..]);
        set(fields, [x, y], |n, ((tractions, moved), slips), _| {
            let ([p, q_x, q_y, mu], [u_x, u_y, x, y]) = (tractions, moved);
            if !fast || slides || p <= 0.0 {
                return [0.0; 2];
            }
            let shift = arms.in_plane(shift, n);
            let slip = [u_x - x - shift[0], u_y - y - shift[1]];
            if slips {
                not_opposite(slip, [q_x, q_y], friction_bound(mu, p))
            } else {
                slip
            }
        });
    }
}

/// The part of a slip that is not opposite to the shear `q`, which is at the `bound`.
fn not_opposite(slip: [f64; 2], q: [f64; 2], bound: f64) -> [f64; 2] {
    let e = q.map(|q| q / bound.max(f64::MIN_POSITIVE));
    let along = (slip[0] * e[0] + slip[1] * e[1]).min(0.0);
    [slip[0] - along * e[0], slip[1] - along * e[1]]
}
