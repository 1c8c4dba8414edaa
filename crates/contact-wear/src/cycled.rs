//! Sums over the increments of a cycle, in every cell.

use contact_core::cells::{Lattice, length};
use contact_core::march::{Increment, State};
use contact_core::solvers::Interface;
use serde::{Deserialize, Serialize};

use super::border::{BorderFields, Cut};
use super::loss::Worn;
use super::pressing::Pressing;

/// The results of one cycle in every kept cell.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct CycleResults {
    /// Integral of the pressure over the slip, `int p |ds|` \[Pa m\].
    pub(crate) pressure_times_slip: Vec<f64>,
    /// Slip distance \[m\].
    pub(crate) slip_distance: Vec<f64>,
    /// Energy dissipated per area \[J/m^2\].
    pub(crate) dissipated: Vec<f64>,
    /// Mean pressure \[Pa\].
    pub(crate) p: Vec<f64>,
    /// Mean normal displacement under the shear, less the mean gap of cells that touch \[m\].
    pub(crate) u_q: Vec<f64>,
    /// Mean normal force \[N\] and approach \[m\].
    pub(crate) mean: [f64; 2],
    /// Shift delta_x \[m\], force T_x \[N\], shift delta_y, force T_y at the increments of the
    /// loop.
    pub(crate) corners: Vec<[f64; 4]>,
    /// Ratio of the area that sticks all through the cycle and the area of the contact.
    pub(crate) stick_ratio: f64,
    /// Cells in contact that slip nowhere in the cycle.
    pub(crate) stick: Vec<bool>,
    /// Cells of a line contact that contain the border of the stick zone.
    pub(crate) cuts: Vec<Cut>,
    /// Coefficient of friction that the exposed surface gave; empty where it gives none.
    pub(crate) surface_mu: Vec<f64>,
}

/// Sums over the increments of a cycle.
pub(crate) struct Sums {
    cycled: CycleResults,
    /// Sum of u_z, weighted \[J m\].
    u_z: Vec<f64>,
    weight: f64,
    contact_area: f64,
    shape: usize,
    /// The coefficient of friction, if it is constant.
    mu: Option<f64>,
    /// Least p - |q|/mu over the cycle \[Pa\].
    short: Vec<f64>,
    /// Slip of each cell relative to the next one \[m\].
    relative_slip: Vec<f64>,
    /// Cells that are out of contact at some increment.
    leaves_contact: Vec<bool>,
}

impl Sums {
    /// Sums before any increment, on so many cells; `mu` is the coefficient of friction if it is uniform.
    pub(crate) fn new(cells: usize, mu: Option<f64>) -> Self {
        let field = || vec![0.0; cells];
        Self {
            cycled: CycleResults {
                pressure_times_slip: field(),
                slip_distance: field(),
                dissipated: field(),
                p: field(),
                u_q: field(),
                stick: vec![true; cells],
                ..CycleResults::default()
            },
            u_z: field(),
            weight: 0.0,
            contact_area: 0.0,
            shape: cells,
            mu,
            short: vec![f64::INFINITY; cells],
            relative_slip: field(),
            leaves_contact: vec![false; cells],
        }
    }

    /// Adds an increment from the state `before` to `now`, whose branch a cycle passes `count` times.
    pub(crate) fn add(&mut self, before: &State, now: &State, increment: &Increment, count: f64) {
        let (loads, motion) = (&increment.point.loads, &increment.motion);
        let corner = [motion.delta_x, loads.T_x, motion.delta_y, loads.T_y];
        self.cycled.corners.push(corner);
        self.contact_area = increment.contact_area;
        if count == 0.0 {
            return;
        }
        self.add_to_border(&before.interface, &now.interface);
        let cycled = &mut self.cycled;
        // A small weight without dissipation, so that the mean exists for a contact that sticks.
        let weight = count * increment.energy.dissipated.max(0.0)
            + 1e-12 * increment.energy.elastic.abs()
            + f64::MIN_POSITIVE;
        self.weight += weight;
        for c in 0..self.shape {
            let (p0, p1) = (before.interface.p[c], now.interface.p[c]);
            let p = 0.5 * (p0 + p1);
            self.leaves_contact[c] |= p0 <= 0.0 || p1 <= 0.0;
            let slip = count * (now.slip_length[c] - before.slip_length[c]);
            cycled.slip_distance[c] += slip;
            cycled.pressure_times_slip[c] += p * slip;
            cycled.dissipated[c] += count * (now.dissipated[c] - before.dissipated[c]);
            cycled.p[c] += weight * p;
            self.u_z[c] += weight * 0.5 * (before.interface.u_z[c] + now.interface.u_z[c]);
            if slip > 0.0 || now.interface.p[c] <= 0.0 {
                cycled.stick[c] = false;
            }
        }
        let mean = |a: f64, b: f64| weight * 0.5 * (a + b);
        cycled.mean[0] += mean(before.loads.W, now.loads.W);
        cycled.mean[1] += mean(before.motion.delta_z, now.motion.delta_z);
    }

    /// Updates the fields from which the border of the stick zone is located.
    fn add_to_border(&mut self, before: &Interface, now: &Interface) {
        let displacement = |c: usize| [0, 1].map(|k| now.u[k][c] - before.u[k][c]);
        for c in 0..self.shape {
            if let Some(mu) = self.mu {
                let short = now.p[c] - length([now.q[0][c], now.q[1][c]]) / mu;
                self.short[c] = self.short[c].min(short);
            }
            let [this, next_cell] = [c, (c + 1).min(self.shape - 1)].map(displacement);
            self.relative_slip[c] += length([next_cell[0] - this[0], next_cell[1] - this[1]]);
        }
    }

    /// Finishes the results of the cycle: compliances at the border, and the gap under load. `worn` are the
    /// surfaces so far, and `gap` is the gap between them when unloaded; it opens by the part `opens` of the
    /// worn depths.
    pub(crate) fn finish(
        self,
        pressing: &mut Pressing,
        coupled: bool,
        (worn, opens): (&Worn, f64),
        gap: &[f64],
    ) -> CycleResults {
        let mut cycled = self.cycled;
        cycled.dissipated.iter_mut().for_each(|d| *d = d.max(0.0));
        if let Some(mu) = self.mu {
            // |q| = mu p in slip: int p |ds| follows from the dissipated energy, which the march
            // integrates more accurately.
            let loadings = cycled
                .pressure_times_slip
                .iter_mut()
                .zip(&cycled.dissipated);
            loadings.for_each(|(slip, dissipated)| *slip = dissipated / mu);
        }
        let weight = self.weight;
        cycled.p.iter_mut().for_each(|p| *p /= weight);
        if let Some(mu) = self.mu.filter(|_| pressing.grid.plane_strain) {
            let signs = BorderFields {
                stick: &cycled.stick,
                short: &self.short,
                relative_slip: &self.relative_slip,
                worn,
                opens,
                response: pressing.shortest_waves(),
            };
            cycled.cuts = Cut::cells(Lattice::new(&pressing.grid, pressing.mirror), &signs);
            for cut in &cycled.cuts {
                let c = cut.cell;
                let slip = cut
                    .slip
                    .unwrap_or(cycled.pressure_times_slip[c] / cycled.p[c].max(f64::MIN_POSITIVE));
                let borne = cut.stiffness(signs.response) * cut.gap_difference(worn, opens);
                cycled.dissipated[c] = mu * slip * (cycled.p[c] - borne).max(0.0);
            }
        }
        cycled.mean.iter_mut().for_each(|m| *m /= weight);
        let touch = self.leaves_contact.iter().zip(&cycled.p);
        let in_part = touch.clone().any(|(parted, p)| *parted && *p > 0.0);
        if coupled || in_part {
            let u_p = pressing.response(&cycled.p);
            let [_, approach] = cycled.mean;
            for (c, (parted, p)) in touch.enumerate() {
                let u_z = if *parted && *p > 0.0 {
                    approach - gap[c]
                } else {
                    self.u_z[c] / weight
                };
                cycled.u_q[c] = u_z - u_p[c];
            }
        }
        let sticking = cycled.stick.iter().filter(|s| **s).count() as f64 * pressing.cell_area();
        cycled.stick_ratio = if self.contact_area > 0.0 {
            (sticking / self.contact_area).min(1.0)
        } else {
            1.0
        };
        cycled
    }
}
