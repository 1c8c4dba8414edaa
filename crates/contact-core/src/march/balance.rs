//! The accounts of an increment: energies, residuals, areas.

use super::{Energy, Increment, March, Motion, Residuals, State, Status, Work};
use crate::scene::{LoadPoint, Loads};
use crate::solvers::{CoupledInfo, Interface};

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
        let motion = Motion {
            delta_z: info.delta_z,
            delta_x: last.motion.delta_x + info.shift[0],
            delta_y: last.motion.delta_y + info.shift[1],
        };
        let contact = now.p.iter().filter(|&&p| p > 0.0).count();
        let slipping = now.slip.iter().filter(|&&s| s).count();
        let energy = self.energies(point, &now, &motion, info.shift, cell_area);
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
            q_max: largest(&mut (0..now.p.len()).map(|n| now.q[0][n].hypot(now.q[1][n]))),
            energy,
            residuals,
            work: Work {
                convolutions: transforms as f64 / 6.0,
                alternations: info.alternations,
                normal_iterations: info.normal_iterations,
                tangential_iterations: info.tangential_iterations,
                parts: 1,
            },
        };
        self.keep(point, now, motion, info.shift, increment.energy.work);
        if self.state.work != 0.0 {
            increment.residuals.energy = energy.imbalance() / self.state.work;
        }
        increment
    }

    /// Energies with mid-increment tractions, an identity for any symmetric C: the sum of mean
    /// traction times change of displacement is the change of the elastic energy.
    fn energies(
        &self,
        point: &LoadPoint,
        now: &Interface,
        motion: &Motion,
        shift: [f64; 2],
        cell_area: f64,
    ) -> Energy {
        let State {
            interface: last,
            loads,
            motion: before,
            ..
        } = &self.state;
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let work = mean(loads.W, point.loads.W) * (motion.delta_z - before.delta_z)
            + mean(loads.T_x, point.loads.T_x) * shift[0]
            + mean(loads.T_y, point.loads.T_y) * shift[1];
        let (mut elastic, mut dissipated, mut opening) = (0.0, 0.0, 0.0);
        let approach = motion.delta_z - before.delta_z;
        for n in 0..now.p.len() {
            let p = mean(now.p[n], last.p[n]);
            let du_z = now.u_z[n] - last.u_z[n];
            elastic += p * du_z;
            opening -= p * (du_z - approach);
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

    /// How well the equations hold.
    fn residuals(
        &self,
        point: &LoadPoint,
        now: &Interface,
        info: &CoupledInfo,
        cell_area: f64,
    ) -> Residuals {
        let mu = self.scene.friction.mu;
        let mut r = Residuals {
            coulomb: f64::NEG_INFINITY,
            ..Residuals::default()
        };
        let (mut contact, mut slipping) = (0, 0);
        let (mut p_max, mut slipped) = (0.0_f64, 0.0_f64);
        for n in 0..now.p.len() {
            let gap = now.u_z[n] + self.h_init[n] - info.delta_z;
            let q = [now.q[0][n], now.q[1][n]];
            p_max = p_max.max(now.p[n]);
            r.coulomb = r.coulomb.max(q[0].hypot(q[1]) - mu * now.p[n]);
            if now.p[n] <= 0.0 {
                r.penetration = r.penetration.max(-gap);
                continue;
            }
            contact += 1;
            r.gap += gap * gap;
            let slip: [f64; 2] =
                std::array::from_fn(|c| now.u[c][n] - self.state.interface.u[c][n] - info.shift[c]);
            if now.slip[n] {
                slipping += 1;
                let e = q.map(|q| q / (mu * now.p[n]));
                let along = (slip[0] * e[0] + slip[1] * e[1]).min(0.0);
                let off = [slip[0] - along * e[0], slip[1] - along * e[1]];
                r.direction += off[0] * off[0] + off[1] * off[1];
                slipped += slip[0] * slip[0] + slip[1] * slip[1];
            } else {
                r.stick += slip[0] * slip[0] + slip[1] * slip[1];
            }
        }
        let rms = |squares: f64, count: usize| (squares / count.max(1) as f64).sqrt();
        r.gap = rms(r.gap, contact) / self.approach;
        r.penetration /= self.approach;
        if slipped > 0.0 {
            r.angle = (r.direction / slipped).sqrt().min(1.0).asin();
        }
        if mu > 0.0 {
            r.stick = rms(r.stick, contact - slipping) / (mu * self.approach);
            r.direction = rms(r.direction, slipping) / (mu * self.approach);
        }
        if mu * p_max > 0.0 {
            r.coulomb /= mu * p_max;
        }
        let sum = |f: &[f64]| f.iter().sum::<f64>() * cell_area;
        let Loads { W, T_x, T_y } = point.loads;
        if W > 0.0 {
            r.balance = (sum(&now.p) - W).abs() / W;
            if mu > 0.0 {
                let missing = |q: &[f64], T: f64| (sum(q) - T).abs() / (mu * W);
                r.balance = r.balance.max(missing(&now.q[0], T_x));
                if self.plan.mirror == crate::convolution::Mirror::None {
                    r.balance = r.balance.max(missing(&now.q[1], T_y));
                }
            }
        }
        r
    }

    /// Makes the increment the present state.
    fn keep(
        &mut self,
        point: &LoadPoint,
        now: Interface,
        motion: Motion,
        shift: [f64; 2],
        work: f64,
    ) {
        let state = &mut self.state;
        let last = std::mem::replace(&mut state.interface, now);
        let now = &state.interface;
        for n in 0..now.p.len() {
            for c in 0..2 {
                let slip = now.u[c][n] - last.u[c][n] - shift[c];
                state.dissipated[n] -= 0.5 * (now.q[c][n] + last.q[c][n]) * slip;
                if now.p[n] > 0.0 && now.slip[n] {
                    state.slip[c][n] += slip;
                }
            }
        }
        state.step = Loads {
            W: point.loads.W - state.loads.W,
            T_x: point.loads.T_x - state.loads.T_x,
            T_y: point.loads.T_y - state.loads.T_y,
        };
        state.p_before = last.p;
        state.q_before = last.q;
        state.loads = point.loads;
        state.motion = motion;
        state.work += work;
        state.increments += 1;
    }
}
