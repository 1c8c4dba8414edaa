//! The cell of a line contact that the border of the stick zone runs through.
//!
//! It sticks with a part phi of its width and wears with the rest. Where nothing wears any more the pressure is
//! that of a punch whose edge runs through the cell, with a root singularity. Whole cells stand for such a punch if
//! the outermost, of the pressure p, has given way by beta p: worn to this depth. With T the responses of a half-line of
//! cells to one another that moves the edge, as seen from the others, by `beta/(1/t + beta)` cells from where it is
//! for beta = 0, t being the corner of T^-1 (J. Sherman, W. J. Morrison, Ann. Math. Stat. 21 (1950) 124). So
//!
//! ```text
//! beta = B (1 - phi)/phi,   B = 1/t = exp[1/(2 pi) int_-pi^pi ln K(w) dw],
//! K(w) = sum_n 2 dx/(E* |w_n|) sin(w_n/2)/(w_n/2),   w_n = w + 2 pi n
//! ```
//!
//! K being the response to waves of w per cell (E* the modulus of the pair), B its geometric mean (G. Szego, Math. Ann. 76
//! (1915) 490): 1.7243 dx/E*. The edge itself lies within the outermost of whole cells, 1/4 - 1/2 sum_m m r_m cells from
//! its border, r_m the cosine coefficients of ln [2 |sin(w/2)| K(w) E*/(2 dx)] (0.1747 in all).
//!
//! Until then the part that slips, which alone wears and dissipates, has what is left of the cell's pressure,
//! p - w/beta, for a depth w.

use serde::{Deserialize, Serialize};

use super::loss::Worn;
use crate::cells::Lattice;
use crate::zones::{SHRINKS, STICK, Stencil};

/// B over the difference of the responses to pressure of a cell and of the one beside it, `3 ln 3/pi dx/E*`.
const STIFFENS: f64 = 1.643_621;
/// How far from the border of the outermost of whole cells their edge lies, in cells.
const WITHIN: f64 = 0.174_65;

/// A cell that the border runs through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Cut {
    pub(crate) cell: usize,
    /// The next one inside.
    inner: usize,
    /// Part that sticks, above 0 and below 1.
    share: f64,
    /// Way that the part that slips does in a cycle, times that part, of a cell that the march has stick \[m\].
    pub(crate) way: Option<f64>,
}

impl Cut {
    /// The cut cells of a line contact, by what the shear of each cell falls short of its bound all through a cycle
    /// \[Pa\] and the way that each cell goes against the next in it \[m\].
    pub(crate) fn cells(lattice: Lattice, stick: &[bool], short: &[f64], apart: &[f64]) -> Vec<Self> {
        let stencils = [Stencil::ROOT, Stencil::LINEAR];
        let edges = lattice.edges(stick, stencils, |_| (STICK, |n: usize| short[n]));
        let cut = edges.into_iter().filter_map(|(cell, edge)| {
            let level = edge.level.filter(|level| level.law == SHRINKS)?;
            let inside = level.middle / level.gradient[0].abs() - level.bias;
            let share = inside + 0.5 + WITHIN;
            let line = level.line;
            let slips = 1.0 - share;
            // The slip grows linearly from the border to the middle of the next cell.
            let way = || apart[cell.min(line.outside)] * slips * slips / (1.0 + 2.0 * slips);
            (share > 0.0 && share < 1.0).then(|| Self {
                cell,
                inner: line.cells()[usize::from(stick[cell])],
                share,
                way: stick[cell].then(way),
            })
        });
        cut.collect()
    }

    /// 1/beta \[Pa/m\], given the difference of the responses of a cell and of the one beside it \[m/Pa\].
    pub(crate) fn stiffness(&self, response: f64) -> f64 {
        self.share / (1.0 - self.share) / (STIFFENS * response)
    }

    /// By how much it is worn deeper than the cell inside \[m\].
    pub(crate) fn deeper(&self, worn: &Worn) -> f64 {
        let deeper = |depth: &Vec<f64>| depth[self.cell] - depth[self.inner];
        worn.depth.iter().map(deeper).sum::<f64>().max(0.0)
    }
}
