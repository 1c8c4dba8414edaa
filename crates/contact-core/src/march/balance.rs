//! The accounts of an increment: energies, loads, areas.

use super::carried::Carried;
use super::{Energy, Increment, March, Motion, State, Status, Work};
use crate::cells::{both, set, size, sums};
use crate::error::Error;
use crate::plan::Mirror;
use crate::scene::{LoadPoint, Loads, RigidMotion};
use crate::solvers::Interface;
use crate::solvers::intermediate::{CoupledInfo, friction_bound};

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
        let ((energy, (residuals, [p_max, q_max])), zones) = both(
            now.p.len(),
            || {
                let energy = self.energies(point, &now, &motion, cell_area);
                (energy, self.residuals(point, &now, info, cell_area))
            },
            || {
                let (_, shift) = self.change(&motion);
                self.zones(&now, |n| {
                    let slip = self.slip(&now, shift, n);
                    size(held(slip, &self.datum.moved, &now, self.before(), n))
                })
            },
        );
        let [contact_area, without_slip] = [zones.contact, zones.stick].map(|n| n * cell_area);
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
    pub(super) fn transmitted(&self, point: &LoadPoint, now: &Interface, cell_area: f64) -> Loads {
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
                Some(_) if mirrored && RigidMotion::ALL[k].is_odd_in_y() => 0.0,
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
            let stretch = self.stretch_at(n);
            let wider = self.gap_rolled(n);
            let entered = self.entered_at(n);
            let mut elastic = p * du_z;
            let (mut trapezoidal, mut of_bulk) = (0.0, 0.0);
            let slip = self.slip(now, shift, n);
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

    /// The slip of a cell in the increment \[m\].
    fn slip(&self, now: &Interface, shift: [f64; 3], n: usize) -> [f64; 2] {
        let (last, entered) = (self.before(), self.entered_at(n));
        let shift = self.window.arms.in_plane(shift, n);
        [0, 1].map(|c| now.u[c][n] - last.u[c][n] - entered[c] - shift[c])
    }

    /// Motions across and in the plane from the present state, rotations times the length \[m\].
    fn change(&self, motion: &Motion) -> ([f64; 3], [f64; 3]) {
        let (from, to) = (self.state.motion.motions(), motion.motions());
        let d: [f64; 6] = std::array::from_fn(|k| (to[k] - from[k]) * self.unit(k));
        ([d[0], d[1], d[2]], [d[3], d[4], d[5]])
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
