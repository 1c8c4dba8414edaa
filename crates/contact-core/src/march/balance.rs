//! The accounts of an increment: energies, residuals, areas.

use super::{Energy, Increment, March, Motion, Residuals, State, Status, Work};
use crate::convolution::Mirror;
use crate::scene::{Given, LoadPoint, Loads};
use crate::solvers::{CoupledInfo, Interface, add, friction_bound};

impl March {
    /// Draws up the accounts of a solved increment and makes it the present state.
    pub(super) fn account(
        &mut self,
        point: &LoadPoint,
        now: Interface,
        info: &CoupledInfo,
        transforms: usize,
    ) -> Increment {
        let cell_area = self.scene.grid.cell_area() * self.plan.mirror.multiplicity();
        let last = &self.state;
        let motion = self.motion(point, info);
        let point = &LoadPoint {
            loads: self.transmitted(point, &now, cell_area),
            ..*point
        };
        let contact = now.p.iter().filter(|&&p| p > 0.0).count();
        let slipping = now.slip.iter().filter(|&&s| s).count();
        let energy = self.energies(point, &now, &motion, cell_area);
        let residuals = self.residuals(point, &now, info, cell_area);
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
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
            contact_area: contact as f64 * cell_area,
            stick_area: (contact - slipping) as f64 * cell_area,
            p_max: largest(&mut now.p.iter().copied()),
            q_max: largest(
                &mut (0..now.p.len()).map(|n| now.q[0][n].hypot(self.arms.stretch * now.q[1][n])),
            ),
            energy,
            residuals,
            work: Work {
                convolutions: transforms as f64 / 6.0,
                alternations: info.alternations,
                normal_iterations: info.normal_iterations,
                tangential_iterations: info.tangential_iterations,
            },
        };
        self.keep(point, now, motion, increment.energy.work);
        if self.state.work != 0.0 {
            increment.residuals.energy = energy.imbalance() / self.state.work;
        }
        increment
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
        let mut sums = [[0.0; 3]; 2];
        for n in 0..now.p.len() {
            sums[0] = add(sums[0], self.arms.sums_across(now.p[n], n));
            let q = [now.q[0][n], now.q[1][n]];
            sums[1] = add(sums[1], self.arms.sums_in_plane(q, n));
        }
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
        Loads::from_forces(transmitted, given)
    }

    /// Energies with mid-increment tractions, an identity for any symmetric C: the sum of mean
    /// traction times change of displacement is the change of the elastic energy.
    fn energies(
        &self,
        point: &LoadPoint,
        now: &Interface,
        motion: &Motion,
        cell_area: f64,
    ) -> Energy {
        let State {
            interface: last,
            loads,
            motion: before,
            ..
        } = &self.state;
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let (from, to) = (loads.forces(), point.loads.forces());
        let (started, ended) = (before.motions(), motion.motions());
        let work = (0..6)
            .map(|k| mean(from[k], to[k]) * (ended[k] - started[k]))
            .sum();
        let (mut elastic, mut dissipated, mut opening) = (0.0, 0.0, 0.0);
        let (approach, shift) = self.change(motion);
        for n in 0..now.p.len() {
            let p = mean(now.p[n], last.p[n]);
            let du_z = now.u_z[n] - last.u_z[n];
            elastic += p * du_z;
            let shift = self.arms.in_plane(shift, n);
            opening -= p * (du_z - self.arms.across(approach, n));
            for c in 0..2 {
                let q = mean(now.q[c][n], last.q[c][n]);
                let du = now.u[c][n] - last.u[c][n];
                elastic += q * du;
                dissipated -= q * (du - shift[c]);
            }
        }
        Energy {
            work,
            elastic: elastic * cell_area,
            dissipated: dissipated * cell_area,
            opening: opening * cell_area,
        }
    }

    /// Motions across and in the plane from the present state, rotations times the length \[m\].
    fn change(&self, motion: &Motion) -> ([f64; 3], [f64; 3]) {
        let (from, to) = (self.state.motion.motions(), motion.motions());
        let d: [f64; 6] = std::array::from_fn(|k| (to[k] - from[k]) * self.unit(k));
        ([d[0], d[1], d[2]], [d[3], d[4], d[5]])
    }

    /// How well the equations hold.
    fn residuals(
        &self,
        point: &LoadPoint,
        now: &Interface,
        info: &CoupledInfo,
        cell_area: f64,
    ) -> Residuals {
        let mu = self.scene.friction.scale();
        let mut r = Residuals {
            coulomb: f64::NEG_INFINITY,
            ..Residuals::default()
        };
        let (mut contact, mut slipping) = (0, 0);
        let mut p_max = 0.0_f64;
        for n in 0..now.p.len() {
            let gap = now.u_z[n] + self.h_init[n] - self.arms.across(info.approach, n);
            let q = [now.q[0][n], now.q[1][n]];
            p_max = p_max.max(now.p[n]);
            let bound = friction_bound(self.mu[n], now.p[n]);
            r.coulomb = r.coulomb.max(q[0].hypot(q[1]) - bound);
            if now.p[n] <= 0.0 {
                r.penetration = r.penetration.max(-gap);
                continue;
            }
            contact += 1;
            r.gap += gap * gap;
            let shift = self.arms.in_plane(info.shift, n);
            let slip: [f64; 2] =
                std::array::from_fn(|c| now.u[c][n] - self.state.interface.u[c][n] - shift[c]);
            if now.slip[n] {
                slipping += 1;
                let e = q.map(|q| q / bound.max(f64::MIN_POSITIVE));
                let along = (slip[0] * e[0] + slip[1] * e[1]).min(0.0);
                let off = [slip[0] - along * e[0], slip[1] - along * e[1]];
                r.direction += off[0] * off[0] + off[1] * off[1];
            } else {
                r.stick += slip[0] * slip[0] + slip[1] * slip[1];
            }
        }
        let rms = |squares: f64, count: usize| (squares / count.max(1) as f64).sqrt();
        r.gap = rms(r.gap, contact) / self.approach;
        r.penetration /= self.approach;
        if mu > 0.0 {
            r.stick = rms(r.stick, contact - slipping) / (mu * self.approach);
            r.direction = rms(r.direction, slipping) / (mu * self.approach);
        }
        if mu * p_max > 0.0 {
            r.coulomb /= mu * p_max;
        }
        r.balance = self.missing_loads(point, now, mu, cell_area);
        r
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

    /// Makes the increment the present state.
    fn keep(&mut self, point: &LoadPoint, now: Interface, motion: Motion, work: f64) {
        let (_, shift) = self.change(&motion);
        let state = &mut self.state;
        let last = std::mem::replace(&mut state.interface, now);
        let now = &state.interface;
        for n in 0..now.p.len() {
            let shift = self.arms.in_plane(shift, n);
            let mut moved = [0.0; 2];
            for c in 0..2 {
                let slip = now.u[c][n] - last.u[c][n] - shift[c];
                state.dissipated[n] -= 0.5 * (now.q[c][n] + last.q[c][n]) * slip;
                moved[c] = slip;
            }
            if now.p[n] > 0.0 && now.slip[n] {
                state.slip[0][n] += moved[0];
                state.slip[1][n] += moved[1];
                state.slip_length[n] += moved[0].hypot(moved[1] / self.arms.stretch);
            }
        }
        state.step = point
            .loads
            .since(state.loads.forces(), state.motion.motions());
        state.p_before = last.p;
        state.q_before = last.q;
        state.loads = point.loads;
        state.motion = motion;
        state.work += work;
        state.increments += 1;
    }
}
