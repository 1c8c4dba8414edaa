//! Rates of wear of the cells, and the loss in a jump of cycles at these rates.

use contact_core::cells::Drive;

use super::border::Cut;
use super::loss::{Loss, Worn};

/// Rates of wear of the cells.
pub(super) struct Rates {
    /// Coefficient of each body in the last cycle \[1/Pa\].
    pub(super) k: [Vec<f64>; 2],
    /// Difference of the mean coefficient of a jump and that coefficient, times the pressure at
    /// which both were computed \[1\].
    pub(super) excess: [Vec<f64>; 2],
    /// Integral of the pressure over the slip, divided by the mean pressure \[m\].
    pub(super) sigma: Vec<f64>,
    /// Energy dissipated, divided by the integral of the pressure over the slip \[1\].
    pub(super) mu: Vec<f64>,
    /// Slip distance in a cycle \[m\].
    pub(super) slips: Vec<f64>,
    /// Mean normal displacement under the shear \[m\].
    pub(super) u_q: Vec<f64>,
    /// Cells that the border of the stick zone cuts.
    pub(super) cuts: Vec<Cut>,
    /// Prescribed force or approach of the contact.
    pub(super) drive: Drive,
}

impl Rates {
    /// The coefficients of the loss in a jump of n cycles. `worn` are the surfaces at its start, whose gap
    /// opens by the part `opens` of the worn depths. Rates that depend on the pressure are linearised about
    /// `p`.
    pub(super) fn in_jump(
        &self,
        n: f64,
        (worn, opens): (&Worn, f64),
        p: &[f64],
        shortest_waves: f64,
    ) -> LossRate {
        let mut slip: Vec<f64> = self.sigma.iter().map(|sigma| n * sigma).collect();
        let mut borne = vec![0.0; slip.len()];
        for cut in &self.cuts {
            let c = cut.cell;
            let stiffness = cut.stiffness(shortest_waves);
            borne[c] = stiffness * cut.gap_difference(worn, opens);
            slip[c] = if p[c] > borne[c] {
                slip[c] / (1.0 + stiffness * opens * (self.k[0][c] + self.k[1][c]) * slip[c])
            } else {
                0.0
            };
        }
        LossRate { n, slip, borne }
    }
}

/// Loss in a jump: slip (k (p - borne) + excess) for each body.
pub(super) struct LossRate {
    /// Cycles.
    n: f64,
    /// Slip distance in all its cycles \[m\].
    pub(super) slip: Vec<f64>,
    /// Pressure on the sticking part of a cut cell, which does not wear \[Pa\].
    pub(super) borne: Vec<f64>,
}

impl LossRate {
    /// The loss under the pressure p at the end of the jump.
    pub(super) fn loss(&self, rates: &Rates, p: &[f64], cell_area: f64) -> Loss {
        let loading = |c: usize| self.slip[c] * (p[c] - self.borne[c]).max(0.0);
        let depth = [0, 1].map(|b| {
            let of_cell = |c: usize| {
                let excess = self.slip[c] * rates.excess[b][c];
                (rates.k[b][c] * loading(c) + excess).max(0.0)
            };
            (0..p.len()).map(of_cell).collect()
        });
        let energy: Vec<f64> = (0..p.len()).map(|c| rates.mu[c] * loading(c)).collect();
        let dissipated: f64 = energy.iter().sum();
        let slip_of = |c: usize| {
            if p[c] > 0.0 {
                self.n * rates.slips[c]
            } else {
                0.0
            }
        };
        Loss {
            cycles: self.n,
            depth,
            slid: (0..p.len()).map(slip_of).collect(),
            energy: [energy.clone(), energy],
            dissipated: dissipated * cell_area,
            loading: (0..p.len()).map(loading).sum::<f64>() * cell_area,
            debris: None,
        }
    }
}
