//! The cell of a line contact that the border of the stick zone runs through.
//!
//! It sticks with a part phi of its width and wears with the rest. Where nothing wears any more the pressure is
//! that of a punch whose edge runs through the cell, with a root singularity. Whole cells stand for such a punch
//! if the outermost, of the pressure p, has given way by beta p: worn to this depth. With T the responses of a
//! half-line of cells to one another this moves the edge, as seen from the others, by `beta/(1/t + beta)` cells
//! from where it is for beta = 0, t being the corner of T^-1 (J. Sherman, W. J. Morrison, Ann. Math. Stat. 21
//! (1950) 124). So
//!
//! ```text
//! beta = B (1 - phi)/phi,   B = 1/t = exp[1/(2 pi) int_-pi^pi ln K(w) dw],
//! K(w) = sum_n 2 dx/(E* |w_n|) sin(w_n/2)/(w_n/2),   w_n = w + 2 pi n
//! ```
//!
//! K being the response to waves of w per cell (E* the modulus of the pair), B its geometric mean (G. Szego, Math.
//! Ann. 76 (1915) 490): 1.7243 dx/E*. The edge itself lies within the outermost of whole cells,
//! 1/4 - 1/2 sum_m m r_m cells from its border, r_m the cosine coefficients of ln [2 |sin(w/2)| K(w) E*/(2 dx)]
//! (0.1747 in all).
//!
//! Until then the part that slips, which alone wears and dissipates, has what is left of the cell's pressure,
//! p - w/beta, for a depth w.

use serde::{Deserialize, Serialize};

use super::loss::Worn;
use crate::cells::Lattice;
use crate::zones::{Level, SHRINKS, STICK, Stencil};

/// B over the difference of the responses to pressure of a cell and of the one beside it, `3 ln 3/pi dx/E*`.
const STIFFENS: f64 = 1.643_621;
/// How far from the border of the outermost of whole cells their edge lies, in cells.
const WITHIN: f64 = 0.174_65;
/// Where cells that fill a zone but for a part f of the next cell have all of its shear, the level of theirs vanishes
/// f + FURTHER f^2 cells out: that of half-lines of cells for f below 0.9, to 0.006.
const FURTHER: f64 = 0.36;

/// A cell that the border runs through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Cut {
    pub(crate) cell: usize,
    /// The next one inside.
    inner: usize,
    /// Part that sticks, above 0 and below 1.
    share: f64,
    /// Way of the part that slips in a cycle, times that part, if it is the smaller one: the march then has the whole
    /// cell stick, or hardly slip \[m\].
    pub(crate) way: Option<f64>,
}

/// What tells where the border runs.
pub(crate) struct Signs<'a> {
    /// Cells that stick all through a cycle.
    pub(crate) stick: &'a [bool],
    /// What the shear falls short of its bound in all of it, over the coefficient of friction \[Pa\].
    pub(crate) short: &'a [f64],
    /// Way of each cell against the next \[m\].
    pub(crate) apart: &'a [f64],
    pub(crate) worn: &'a Worn,
    /// Part of the worn depth by which the gap grows.
    pub(crate) opens: f64,
    /// Difference of the responses of a cell and of the one beside it \[m/Pa\].
    pub(crate) response: f64,
}

impl Cut {
    /// The cut cells of a line contact.
    pub(crate) fn cells(lattice: Lattice, signs: &Signs<'_>) -> Vec<Self> {
        let mut inside = signs.stick.to_vec();
        for n in lattice.border(signs.stick) {
            inside[n] = false;
        }
        let cut = |zone: &[bool]| -> Vec<Self> {
            let stencils = [Stencil::ROOT, Stencil::LINEAR];
            let edges = lattice.edges(zone, stencils, |_| (STICK, |n: usize| signs.short[n]));
            let outside = edges.into_iter().filter(|(n, _)| !zone[*n]);
            outside
                .filter_map(|(n, edge)| Self::at(n, &edge.level?, signs))
                .collect()
        };
        // The outermost of the stick zone, and the cells next to those that it does not run through.
        let mut cuts = cut(&inside);
        let next = cut(signs.stick).into_iter();
        let next: Vec<Self> = next
            .filter(|cut| !cuts.iter().any(|other| other.cell == cut.inner))
            .collect();
        cuts.extend(next);
        cuts
    }

    /// A cell next to a zone whose level is extrapolated to it, if the border runs through it.
    fn at(cell: usize, level: &Level, signs: &Signs<'_>) -> Option<Self> {
        let inner = level.line.outermost();
        let mut cut = Self {
            cell,
            inner,
            share: 0.0,
            way: None,
        };
        let sticks = signs.stick[cell];
        // The part of its shear that it does not take: all if it slips; if not, by how much it is worn.
        let lacks = if sticks {
            let worn = cut.deeper(signs.worn, signs.opens) / (STIFFENS * signs.response);
            worn / (worn + signs.short[cell].max(0.0)).max(f64::MIN_POSITIVE)
        } else {
            1.0
        };
        let shown = level.middle / level.gradient[0].abs() + 0.5;
        let part = 2.0 * shown / (1.0 + (1.0 + 4.0 * FURTHER * lacks * shown.max(0.0)).sqrt());
        cut.share = part + WITHIN;
        if cut.share > 0.5 {
            // The slip grows like a root from the border to the middle of the next cell, as it does on worn surfaces.
            let slips = 1.0 - cut.share;
            let mean = slips * (slips / (slips + 0.5)).sqrt() / 1.5;
            let next = cell.min((2 * cell).saturating_sub(inner));
            cut.way = Some((signs.apart[cell.min(inner)] + signs.apart[next]) * mean);
        }
        (level.law == SHRINKS && cut.share > 0.0 && cut.share < 1.0).then_some(cut)
    }

    /// 1/beta \[Pa/m\], given the difference of the responses of a cell and of the one beside it \[m/Pa\].
    pub(crate) fn stiffness(&self, response: f64) -> f64 {
        self.share / (1.0 - self.share) / (STIFFENS * response)
    }

    /// By how much the gap at it has grown more than at the cell inside \[m\], a part `opens` of what is worn.
    pub(crate) fn deeper(&self, worn: &Worn, opens: f64) -> f64 {
        let deeper = |depth: &Vec<f64>| depth[self.cell] - depth[self.inner];
        opens * worn.depth.iter().map(deeper).sum::<f64>().max(0.0)
    }
}
