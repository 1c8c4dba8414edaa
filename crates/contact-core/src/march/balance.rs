//! The accounts of an increment: energies, residuals, areas.

use super::carried::Carried;
use super::{Energy, Increment, March, Motion, Residuals, State, Status, Work};
use crate::convolution::Mirror;
use crate::error::Error;
use crate::scene::{Given, LoadPoint, Loads, Preset};
use crate::solvers::{CoupledInfo, Interface, both, friction_bound, set, size, sums, survey};

/// What sums in another order may differ by.
const ROUNDING: f64 = 1e-9;

impl March {
    /// Draws up the accounts of a solved increment and makes it the present state; fails if the
    /// equations do not hold as the tolerance says.
    pub(super) fn account(
        &mut self,
        point: &LoadPoint,
        now: Interface,
        info: &CoupledInfo,
        convolutions: f64,
    ) -> Result<Increment, Error> {
        let cell_area = self.scene.grid.cell_area() * self.plan.mirror.multiplicity();
        let last = &self.state;
        let motion = self.motion(point, info);
        let point = &LoadPoint {
            loads: self.transmitted(point, &now, cell_area),
            ..*point
        };
        let contact = now.p.iter().filter(|&&p| p > 0.0).count();
        let slipping = now.slip.iter().filter(|&&s| s).count();
        let ((energy, (residuals, [p_max, q_max])), areas) = both(
            now.p.len(),
            || {
                let energy = self.energies(point, &now, &motion, cell_area);
                (energy, self.residuals(point, &now, info, cell_area))
            },
            || self.contact_and_stick(&now),
        );
        let [contact_area, without_slip] = areas.map(|cells| cells * cell_area);
        let stick_area = self
            .grown_to_the_end(without_slip, slipping > 0)
            .min(contact_area);
        let mut increment = Increment {
            index: last.increments + 1,
            point: *point,
            motion,
            status: match (contact, slipping) {
                (0, _) => Status::NoContact,
                (_, 0) => Status::FullStick,
                (contact, slipping) if contact == slipping => Status::GrossSlip,
                _ => Status::PartialSlip,
            },
            contact_area,
            stick_area,
            p_max,
            q_max,
            energy,
            residuals,
            work: Work {
                convolutions,
                alternations: info.alternations,
                normal_iterations: info.normal_iterations,
                tangential_iterations: info.tangential_iterations,
                parts: 1,
            },
        };
        self.check_residuals(&increment, (contact, slipping))?;
        let slides = increment.status == Status::GrossSlip;
        self.note_missed(&now, info.shift, slides);
        self.keep(point, now, motion, increment.energy.work);
        self.state.without_slip = without_slip;
        if self.state.work != 0.0 {
            increment.residuals.energy = energy.imbalance() / self.state.work;
        }
        Ok(increment)
    }

    /// Whatever a solver took for solved: gap and overlap, and the slip that should not be over the
    /// `contact` cells, of which some slip, are within the tolerance, or the increment is not.
    fn check_residuals(
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

    /// The rigid motion at the end of the increment; what is given is kept as it was said.
    fn motion(&self, point: &LoadPoint, info: &CoupledInfo) -> Motion {
        let last = &self.state.motion;
        let given = &point.loads.given;
        Motion {
            delta_z: given.delta_z.unwrap_or(info.approach[0]),
            phi_x: given.phi_x.unwrap_or(info.approach[1] / self.unit(1)),
            phi_y: given.phi_y.unwrap_or(info.approach[2] / self.unit(2)),
            delta_x: given.delta_x.unwrap_or(last.delta_x + info.shift[0]),
            delta_y: given
                .delta_y
                .unwrap_or(last.delta_y + info.shift[1] / self.unit(4)),
            phi_z: given
                .phi_z
                .unwrap_or(last.phi_z + info.shift[2] / self.unit(5)),
        }
    }

    /// The loads of the increment: those given, and for given motions what the tractions come to.
    fn transmitted(&self, point: &LoadPoint, now: &Interface, cell_area: f64) -> Loads {
        let arms = &self.window.arms;
        let sums = [
            sums([&now.p[..]], |n, [p]| arms.sums_across(p, n)),
            sums([&now.q[0][..], &now.q[1]], |n, q| arms.sums_in_plane(q, n)),
        ];
        let mirrored = self.plan.mirror != Mirror::None;
        let (forces, given) = (point.loads.forces(), point.loads.given);
        let motions = given.motions();
        let transmitted = std::array::from_fn(|k| {
            match motions[k] {
                None => forces[k],
                // The other half has the opposite.
                Some(_) if mirrored && matches!(k, 1 | 4 | 5) => 0.0,
                Some(_) => sums[k / 3][k % 3] * cell_area * self.unit(k),
            }
        });
        point.loads.with_forces(transmitted, given)
    }

    /// Energies with mid-increment tractions, an identity for any symmetric C: the sum of mean
    /// traction times change of displacement is the change of the elastic energy. What friction
    /// takes is not reckoned with the mean shear; the difference stands apart.
    fn energies(
        &self,
        point: &LoadPoint,
        now: &Interface,
        motion: &Motion,
        cell_area: f64,
    ) -> Energy {
        let last = self.before();
        let State {
            loads,
            motion: before,
            ..
        } = &self.state;
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let (from, to) = (loads.forces(), point.loads.forces());
        let (started, ended) = (before.motions(), motion.motions());
        let of_loads: f64 = (0..6)
            .map(|k| mean(from[k], to[k]) * (ended[k] - started[k]))
            .sum();
        let (approach, shift) = self.change(motion);
        let sums = sums([&now.p[..], &last.p], |n, [p, p_before]| {
            if p <= 0.0 && p_before <= 0.0 {
                return [0.0; 6];
            }
            let p = mean(p, p_before);
            let du_z = now.u_z[n] - last.u_z[n];
            let shift = self.window.arms.in_plane(shift, n);
            let stretch = self.stretch_at(n);
            let wider = self.gap_rolled(n);
            let entered = self.entered_at(n);
            let mut elastic = p * du_z;
            let (mut trapezoidal, mut of_bulk) = (0.0, 0.0);
            let slip = [0, 1].map(|c| now.u[c][n] - last.u[c][n] - entered[c] - shift[c]);
            let mut opening = -p * (du_z + wider - self.window.arms.across(approach, n));
            for c in 0..2 {
                let q = mean(now.q[c][n], last.q[c][n]);
                let du = now.u[c][n] - last.u[c][n];
                elastic += q * (du - stretch[c]);
                opening -= q * entered[c];
                trapezoidal -= q * slip[c];
                of_bulk -= q * stretch[c];
            }
            let held = held(slip, &self.datum.moved, now, last, n);
            let dissipated = friction_takes(self.mu[n], now, last, held, n);
            let quadrature = dissipated - trapezoidal;
            [
                elastic,
                dissipated,
                quadrature,
                opening,
                of_bulk,
                -p * wider,
            ]
        });
        let [
            elastic,
            dissipated,
            quadrature,
            opening,
            of_bulk,
            of_rolling,
        ] = sums;
        Energy {
            work: of_loads + (of_bulk + of_rolling) * cell_area,
            elastic: elastic * cell_area,
            dissipated: dissipated * cell_area,
            opening: opening * cell_area,
            quadrature: quadrature * cell_area,
        }
    }

    /// Motions across and in the plane from the present state, rotations times the length \[m\].
    fn change(&self, motion: &Motion) -> ([f64; 3], [f64; 3]) {
        let (from, to) = (self.state.motion.motions(), motion.motions());
        let d: [f64; 6] = std::array::from_fn(|k| (to[k] - from[k]) * self.unit(k));
        ([d[0], d[1], d[2]], [d[3], d[4], d[5]])
    }

    /// How well the equations hold; and the largest pressure and shear \[Pa\].
    fn residuals(
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

    /// The stick area at the end of an increment \[m^2\] from the area `without_slip` in all of it:
    /// where the zone grows, the cells that have come to stick on the way count as slipping, and the zone is
    /// that of the middle. Its radius grows on by half of what it grew from the last increment.
    fn grown_to_the_end(&self, without_slip: f64, slips: bool) -> f64 {
        let before = self.state.without_slip;
        if !(self.datum.goes_on && slips && before > 0.0 && without_slip > before) {
            return without_slip;
        }
        let (radius, last) = (without_slip.sqrt(), before.sqrt());
        (radius + 0.5 * (radius - last)).powi(2)
    }

    /// Notes the slip that should not be, for the next increment to make good; a body that slides may
    /// have any shift beyond the incipient one.
    fn note_missed(&mut self, now: &Interface, shift: [f64; 3], slides: bool) {
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

    /// Makes the increment the present state.
    fn keep(&mut self, point: &LoadPoint, now: Interface, motion: Motion, work: f64) {
        let (_, shift) = self.change(&motion);
        self.roll_history();
        let state = &mut self.state;
        let last = std::mem::replace(&mut state.interface, now);
        let now = &state.interface;
        let before = self.carried.as_ref().map_or(&last, Carried::interface);
        let (mu, arms, moved) = (&self.mu, &self.window.arms, &self.datum.moved);
        let slip = |n: usize| -> [f64; 2] {
            let shift = arms.in_plane(shift, n);
            let entered = |c: usize| if before.p[n] > 0.0 { 0.0 } else { moved[c][n] };
            std::array::from_fn(|c| now.u[c][n] - before.u[c][n] - entered(c) - shift[c])
        };
        let stretch = self.window.arms.stretch;
        let [slip_x, slip_y] = &mut state.slip;
        let histories = [
            slip_x,
            slip_y,
            &mut state.slip_length,
            &mut state.dissipated,
        ];
        set(
            [&now.p[..], &before.p],
            histories.map(|f| &mut f[..]),
            |n, [p, p_before], [x, y, length, dissipated]| {
                if p <= 0.0 && p_before <= 0.0 {
                    return [x, y, length, dissipated];
                }
                let slip = slip(n);
                let held = held(slip, moved, now, before, n);
                let dissipated = dissipated + friction_takes(mu[n], now, before, held, n);
                if !(now.p[n] > 0.0 && now.slip[n]) {
                    return [x, y, length, dissipated];
                }
                let way = size([slip[0], slip[1] / stretch]);
                [x + slip[0], y + slip[1], length + way, dissipated]
            },
        );
        state.step = point.loads.since(&state.loads, state.motion.motions());
        state.p_before = last.p;
        state.q_before = last.q;
        state.loads = point.loads;
        state.motion = motion;
        state.work += work;
        state.increments += 1;
    }
}

/// The part of a slip that is not opposite to the shear `q`, which is at the `bound`.
fn not_opposite(slip: [f64; 2], q: [f64; 2], bound: f64) -> [f64; 2] {
    let e = q.map(|q| q / bound.max(f64::MIN_POSITIVE));
    let along = (slip[0] * e[0] + slip[1] * e[1]).min(0.0);
    [slip[0] - along * e[0], slip[1] - along * e[1]]
}

/// The slip that is held against the final shear \[m\]: without its turn on the way.
fn held(
    slip: [f64; 2],
    moved: &[Vec<f64>; 2],
    now: &Interface,
    last: &Interface,
    n: usize,
) -> [f64; 2] {
    if now.p[n] > 0.0 && last.p[n] > 0.0 {
        [slip[0] - moved[0][n], slip[1] - moved[1][n]]
    } else {
        slip
    }
}

/// Energy per area that friction takes from a cell whose `slip` is held against the final shear
/// \[J/m^2\]: a cell slips at its bound, so it is the mean bound of the increment times the slip,
/// where the trapezoidal rule takes a mean of the shear before slip and in slip. A single increment
/// is exact while the pressure stays. It is not negative because slip opposes the shear, to the
/// tolerance. A cell that leaves the contact slips under half of the shear that it carried, if it
/// gives way to it; how it moves once it is free is no slip.
fn friction_takes(mu: f64, now: &Interface, last: &Interface, slip: [f64; 2], n: usize) -> f64 {
    let power = |q: &[Vec<f64>; 2]| q[0][n] * slip[0] + q[1][n] * slip[1];
    let bound = friction_bound(mu, now.p[n]);
    if bound <= 0.0 {
        return (-0.5 * power(&last.q)).max(0.0);
    }
    if !now.slip[n] {
        return 0.0;
    }
    let mean = 0.5 * (1.0 + friction_bound(mu, last.p[n]) / bound);
    -mean * power(&now.q)
}
