//! Rates of wear of the cells, and the loss in a jump of cycles at these rates.

use contact_core::cells::Drive;

use super::border::Cut;
use super::loss::{Loss, Worn};

/// Rates of wear of the cells.
pub(super) struct Rates {
    /// Coefficient of each body in the last cycle \[1/Pa\].
    pub(super) k: [Vec<f64>; 2],
    /// What the mean coefficient of a jump is above that, times the pressure that both were found
    /// at \[1\].
    pub(super) above: [Vec<f64>; 2],
    /// Pressed way over the mean pressure \[m\].
    pub(super) sigma: Vec<f64>,
    /// Energy dissipated over the pressed way \[1\].
    pub(super) mu: Vec<f64>,
    /// Way slipped in a cycle \[m\].
    pub(super) slips: Vec<f64>,
    /// Mean normal displacement under the shear \[m\].
    pub(super) u_q: Vec<f64>,
    /// Cells that the border of the stick zone cuts.
    pub(super) cuts: Vec<Cut>,
    /// What the contact is pressed by.
    pub(super) drive: Drive,
}

impl Rates {
    /// The coefficients of the loss in a jump of n cycles on worn surfaces, of which the gap opens
    /// by the part `opens`, near the pressure p.
    pub(super) fn in_jump(
        &self,
        n: f64,
        (worn, opens): (&Worn, f64),
        p: &[f64],
        shortest_waves: f64,
    ) -> LossRate {
        let mut way: Vec<f64> = self.sigma.iter().map(|sigma| n * sigma).collect();
        let mut borne = vec![0.0; way.len()];
        for cut in &self.cuts {
            let c = cut.cell;
            let stiffness = cut.stiffness(shortest_waves);
            borne[c] = stiffness * cut.deeper(worn, opens);
            way[c] = if p[c] > borne[c] {
                way[c] / (1.0 + stiffness * opens * (self.k[0][c] + self.k[1][c]) * way[c])
            } else {
                0.0
            };
        }
        LossRate { n, way, borne }
    }
}

/// Loss in a jump: way (k (p - borne) + above) of each body.
pub(super) struct LossRate {
    /// Cycles.
    n: f64,
    /// Way slipped in all its cycles \[m\].
    pub(super) way: Vec<f64>,
    /// Pressure on the sticking part of a cut cell, which does not wear \[Pa\].
    pub(super) borne: Vec<f64>,
}

impl LossRate {
    /// The loss under the pressure p at the end of the jump.
    pub(super) fn loss(&self, rates: &Rates, p: &[f64], cell_area: f64) -> Loss {
        let way = |c: usize| self.way[c] * (p[c] - self.borne[c]).max(0.0);
        let depth = [0, 1].map(|b| {
            let of_cell = |c: usize| {
                let above = self.way[c] * rates.above[b][c];
                (rates.k[b][c] * way(c) + above).max(0.0)
            };
            (0..p.len()).map(of_cell).collect()
        });
        let energy: Vec<f64> = (0..p.len()).map(|c| rates.mu[c] * way(c)).collect();
        let dissipated: f64 = energy.iter().sum();
        let slides = |c: usize| {
            if p[c] > 0.0 {
                self.n * rates.slips[c]
            } else {
                0.0
            }
        };
        Loss {
            cycles: self.n,
            depth,
            slid: (0..p.len()).map(slides).collect(),
            energy: [energy.clone(), energy],
            dissipated: dissipated * cell_area,
        }
    }
}
