//! The cell of a line contact that contains the border of the stick zone.
//!
//! The part phi of its width sticks, the rest slips and wears. After many cycles the pressure is
//! the pressure of a punch whose edge lies within the cell, with a square-root singularity. A row
//! of whole cells represents such a punch if its outermost cell, of the pressure p, is recessed by
//! beta p. Let T be the matrix of the responses of a half-line of cells to each other, and t the
//! first diagonal entry of T^-1. The recess moves the edge by `beta/(1/t + beta)` cells from its
//! place for beta = 0 (J. Sherman, W. J. Morrison, Ann. Math. Stat. 21 (1950) 124). So
//!
//! ```text
//! beta = B (1 - phi)/phi,   B = 1/t = exp[1/(2 pi) int_-pi^pi ln K(w) dw],
//! K(w) = sum_n 2 dx/(E* |w_n|) sin(w_n/2)/(w_n/2),   w_n = w + 2 pi n
//! ```
//!
//! K being the response to waves of phase w per cell (E* the modulus of the pair) and B its
//! geometric mean (G. Szego, Math. Ann. 76 (1915) 490): 1.7243 dx/E*. For beta = 0 the edge lies
//! inside the outermost cell, 1/4 - 1/2 sum_m m r_m = 0.1747 cells from its outer border, r_m being
//! the cosine coefficients of ln [2 |sin(w/2)| K(w) E*/(2 dx)].
//!
//! Before the final state, at a depth w, the slipping part carries the pressure p - w/beta of the
//! cell. It alone wears and dissipates.

use contact_core::cells::Lattice;
use contact_core::zones::{Level, SHRINKING, STICK, Stencil};
use serde::{Deserialize, Serialize};

use super::loss::Worn;

/// B over C(0) - C(1) = `3 ln 3/pi dx/E*`, the difference of the responses of a cell and its
/// neighbour.
pub(super) const BORDER_STIFFNESS: f64 = 1.643_621;
/// Distance of the edge from the outer border of the outermost cell for beta = 0 \[cells\].
const EDGE_OFFSET: f64 = 0.174_65;
/// If the cells of a zone carry also the shear of a part f of the next cell, their level vanishes
/// f + FURTHER f^2 cells outside (fitted to half-lines of cells, within 0.006 for f < 0.9).
const EDGE_CURVATURE: f64 = 0.36;

/// A cell that contains the border of the stick zone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Cut {
    pub(crate) cell: usize,
    /// The next cell inside the zone.
    inner: usize,
    /// Part that sticks, above 0 and below 1.
    share: f64,
    /// Slip per cycle of the slipping part, times that part \[m\], if it is the smaller one. The
    /// march then makes the whole cell stick or slip too little.
    pub(crate) slip: Option<f64>,
}

/// The fields from which the border is located.
pub(crate) struct BorderFields<'a> {
    /// Cells that stick all through a cycle.
    pub(crate) stick: &'a [bool],
    /// Least p - |q|/mu over the cycle \[Pa\].
    pub(crate) short: &'a [f64],
    /// Slip of each cell relative to the next one in a cycle \[m\].
    pub(crate) relative_slip: &'a [f64],
    pub(crate) worn: &'a Worn,
    /// Part of the worn depth by which the gap grows.
    pub(crate) opens: f64,
    /// Difference of the responses of a cell and of the one beside it \[m/Pa\].
    pub(crate) response: f64,
}

impl Cut {
    /// The cells of a line contact that the border of the contact or of the stick zone crosses.
    pub(crate) fn cells(lattice: Lattice, signs: &BorderFields<'_>) -> Vec<Self> {
        let mut inside = signs.stick.to_vec();
        for n in lattice.border(signs.stick) {
            inside[n] = false;
        }
        let cut_cells = |zone: &[bool]| -> Vec<Self> {
            let stencils = [Stencil::ROOT.for_inner_zone(), Stencil::LINEAR];
            let edges = lattice.edges(zone, stencils, |_| (STICK, |n: usize| signs.short[n]));
            let outside = edges.into_iter().filter(|(n, _)| !zone[*n]);
            outside
                .filter_map(|(n, edge)| Self::from_level(n, &edge.level?, signs))
                .collect()
        };
        // Outermost cells of the stick zone; where the border is not in one of these, the cells
        // outside them.
        let mut cuts = cut_cells(&inside);
        let neighbours = cut_cells(signs.stick).into_iter();
        let neighbours: Vec<Self> = neighbours
            .filter(|cut_cells| !cuts.iter().any(|other| other.cell == cut_cells.inner))
            .collect();
        cuts.extend(neighbours);
        cuts
    }

    /// Finds the border in a cell next to a zone, from the level extrapolated to it; returns `None`
    /// if the border is not in the cell.
    fn from_level(cell: usize, level: &Level, signs: &BorderFields<'_>) -> Option<Self> {
        let inner = level.line.outermost();
        let mut cut = Self {
            cell,
            inner,
            share: 0.0,
            slip: None,
        };
        let sticks = signs.stick[cell];
        // Part of its shear that the neighbours carry: 1 if it slips; if it sticks, by its worn
        // depth.
        let lacks = if sticks {
            let worn =
                cut.gap_difference(signs.worn, signs.opens) / (BORDER_STIFFNESS * signs.response);
            worn / (worn + signs.short[cell].max(0.0)).max(f64::MIN_POSITIVE)
        } else {
            1.0
        };
        let shown = level.middle / level.gradient[0].abs() + 0.5;
        let part =
            2.0 * shown / (1.0 + (1.0 + 4.0 * EDGE_CURVATURE * lacks * shown.max(0.0)).sqrt());
        cut.share = part + EDGE_OFFSET;
        if cut.share > 0.5 {
            // On worn surfaces the slip grows like a square root from the border to the centre of
            // the next cell.
            let slips = 1.0 - cut.share;
            let mean = slips * (slips / (slips + 0.5)).sqrt() / 1.5;
            let neighbour = cell.min((2 * cell).saturating_sub(inner));
            cut.slip = Some(
                (signs.relative_slip[cell.min(inner)] + signs.relative_slip[neighbour]) * mean,
            );
        }
        (level.law == SHRINKING && cut.share > 0.0 && cut.share < 1.0).then_some(cut)
    }

    /// 1/beta \[Pa/m\], given C(0) - C(1) \[m/Pa\].
    pub(crate) fn stiffness(&self, response: f64) -> f64 {
        self.share / (1.0 - self.share) / (BORDER_STIFFNESS * response)
    }

    /// How much more the gap has grown at the cell than at the next cell inside \[m\]: the part `opens` of the
    /// worn depths, less the bed.
    pub(crate) fn gap_difference(&self, worn: &Worn, opens: f64) -> f64 {
        let difference = |field: &Vec<f64>| field[self.cell] - field[self.inner];
        let depths: f64 = worn.depth.iter().map(difference).sum();
        (opens * depths - difference(&worn.bed)).max(0.0)
    }
}
