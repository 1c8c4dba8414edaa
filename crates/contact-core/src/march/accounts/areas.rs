//! Areas of the contact and of the stick zone, with the cells that their borders go through.
//!
//! With the distance d inwards from the rim the pressure grows like d^(1/2 + e), or like d on a layer
//! thinner than the cells; and mu p - q . t, t being the direction of the shear where cells slip, like
//! d^(1/2) from the border of a stick zone that shrinks, like d^(3/2) from that of one that grows. A power
//! of either, the level f, vanishes linearly:
//!
//! ```text
//! f = b_1 d + b_2 d^2 + ...,   f = p^(2/(1 + 2 e)) or (mu p - q . t)^2,   tan(pi e) = beta q_n/p
//! ```
//!
//! with Dundurs' beta and the shear q_n towards the inside on body 2 (a rim that slides on dissimilar
//! bodies; M. Comninou, J. Appl. Mech. 43 (1976) 631). Of the laws that may hold the one counts whose level is
//! the straightest.
//!
//! Where a stick zone grows, cells stick with the shear that they slipped with, and how they fall short of
//! their bound depends on where the border was in every increment. There the slip s of the increment shows
//! it, which goes like d^(3/2) from the border outwards, f = s^(2/3): the border in the middle of the
//! increment, to second order, since what slips in all of it are the cells outside that. By the end its
//! radius has grown by half of what it grew from the last increment.

use super::energy::slip_of;
use crate::cells::{Lattice, size};
use crate::march::setup::Setup;
use crate::material::dundurs_beta;
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::NoSlipTerms;
use crate::solvers::{Interface, friction_bound};
use crate::zones::{Edge, Level, Line, Power, SHRINKS, STICK, Stencil};

/// Cells across a slip ring on dissimilar bodies up to which its rim is continued from cells that stick
/// as well, whose pressure follows another law: fewer cannot show it. In wider ones all count but the
/// innermost, next to where that law begins, and no fewer than leave two after those that are skipped.
const RING: usize = 3;
const FEWEST: usize = 4;

/// Areas, in kept cells.
pub(super) struct Areas {
    pub(super) contact: f64,
    /// The stick zone at the end of the increment.
    pub(super) stick: f64,
    /// The cells that did not slip in the increment.
    pub(super) without_slip: f64,
}

/// Of a solved increment.
pub(super) fn areas(
    setup: &Setup<'_>,
    no_slip: &NoSlipTerms,
    now: &Interface,
    info: &AlternationInfo,
) -> Areas {
    let cells = Cells::new(setup, now);
    let partial = setup.problem.plan.methods.partial_cells;
    let rim = if partial { cells.rim() } else { Vec::new() };
    let contact = area(&cells.contact, &rim);
    if !now.slip.contains(&true) {
        return Areas {
            contact,
            stick: contact,
            without_slip: contact,
        };
    }
    // Without a limit no cell is near its bound: whole cells count.
    let border = if partial && setup.problem.scene.friction.mu.is_finite() {
        cells.stick_border(&rim, |n| {
            let rigid = setup.geometry.arms.in_plane(info.shift, n);
            size(slip_of(no_slip, now, setup.last(), rigid, n).0)
        })
    } else {
        Vec::new()
    };
    let without_slip = area(&cells.stick, &border);
    let before = setup.state.without_slip / setup.problem.cell_area();
    let grows = setup.goes_on.is_some() && before > 0.0 && without_slip > before;
    Areas {
        contact,
        stick: if grows {
            let (radius, last) = (without_slip.sqrt(), before.sqrt());
            (radius + 0.5 * (radius - last)).powi(2)
        } else {
            without_slip
        },
        without_slip,
    }
}

/// The area of a zone whose border goes through the cells `edges`.
fn area(zone: &[bool], edges: &[(usize, Edge)]) -> f64 {
    let whole = zone.iter().filter(|&&inside| inside).count() as f64;
    let partial = |(n, edge): &(usize, Edge)| edge.share() - f64::from(u8::from(zone[*n]));
    whole + edges.iter().map(partial).sum::<f64>()
}

/// The kept cells by what they do.
struct Cells<'a> {
    setup: &'a Setup<'a>,
    now: &'a Interface,
    lattice: Lattice,
    contact: Vec<bool>,
    stick: Vec<bool>,
    slips: Vec<bool>,
}

impl<'a> Cells<'a> {
    fn new(setup: &'a Setup<'_>, now: &'a Interface) -> Self {
        let contact: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
        let of = |slips: bool| -> Vec<bool> {
            let pairs = contact.iter().zip(&now.slip);
            pairs.map(|(&c, &s)| c && s == slips).collect()
        };
        Self {
            setup,
            now,
            lattice: Lattice::new(&setup.geometry.grid, setup.problem.plan.mirror),
            stick: of(false),
            slips: of(true),
            contact,
        }
    }

    /// The rim of the contact.
    fn rim(&self) -> Vec<(usize, Edge)> {
        let (now, scene) = (self.now, &self.setup.problem.scene);
        let beta = dundurs_beta(scene.body1.outermost(), scene.body2.outermost());
        (self.lattice).edges(&self.contact, [Stencil::ROOT, Stencil::LINEAR], |line| {
            let at = line.outermost();
            let ring = line.cells().iter().take_while(|&&n| now.slip[n]).count();
            if beta != 0.0 && ring > RING {
                line.shorten((ring - 1).max(FEWEST));
            }
            let q_n = now.q[0][at] * line.inwards[0] + now.q[1][at] * line.inwards[1];
            let e = (beta * q_n / now.p[at]).atan() / std::f64::consts::PI;
            let power = if e == 0.0 {
                Power::Two
            } else {
                Power::Other(2.0 / (1.0 + 2.0 * e))
            };
            ([power, Power::One], |n: usize| now.p[n])
        })
    }

    /// The border of the stick zone, within the `rim`, given the slip of a cell in the increment \[m\].
    fn stick_border(
        &self,
        rim: &[(usize, Edge)],
        slip: impl Fn(usize) -> f64,
    ) -> Vec<(usize, Edge)> {
        let now = self.now;
        let stencils = [Stencil::ROOT, Stencil::LINEAR].map(Stencil::before_the_middle);
        let mut border = self.lattice.edges(&self.stick, stencils, |line| {
            let slipping = self.slipping_beside(line);
            (STICK, move |n| self.shortfall(now, n, slipping))
        });
        for (n, edge) in &mut border {
            edge.level = edge.level.filter(|level| level.law == SHRINKS);
            let line = edge.level.map(|level| level.line);
            let shrinks = |line: Line| !self.grew(line.outermost(), self.slipping_beside(&line));
            if line.is_some_and(shrinks) {
                continue;
            }
            edge.level = None;
            let laws = |_: &mut Line| ([Power::TwoThirds], &slip);
            let by_slip = (self.lattice).edge(*n, &self.slips, [Stencil::SLIP], &laws);
            let grown = by_slip.level.is_some_and(|Level { line, .. }| {
                self.stick[line.outside] && self.grew(line.outside, line.outermost())
            });
            if grown {
                *edge = by_slip.other_side(self.stick[*n]);
            }
        }
        // Where no cell slips the zone ends at the rim, unless a level shows a ring narrower than a cell.
        for (n, edge) in &mut border {
            if let Ok(at) = rim.binary_search_by_key(n, |(n, _)| *n)
                && (edge.share() > rim[at].1.share()
                    || edge.level.is_none() && !self.lattice.is_beside(*n, &self.slips))
            {
                *edge = rim[at].1;
            }
        }
        border
    }

    /// The cell that slips at the end of a line.
    fn slipping_beside(&self, line: &Line) -> usize {
        if self.slips[line.outside] {
            line.outside
        } else {
            line.outermost()
        }
    }

    /// What the shear of cell n falls short of its bound along that of a cell that slips \[Pa\].
    fn shortfall(&self, at: &Interface, n: usize, slipping: usize) -> f64 {
        let q = [self.now.q[0][slipping], self.now.q[1][slipping]];
        let [x, y] = q.map(|q_k| q_k / size(q).max(f64::MIN_POSITIVE));
        friction_bound(self.setup.mu[n], at.p[n]) - (at.q[0][n] * x + at.q[1][n] * y)
    }

    /// Whether the stick zone has grown at a cell in it: that has come to stick, but for a reversal, or falls
    /// further behind its bound.
    fn grew(&self, stuck: usize, slipping: usize) -> bool {
        let before = self.setup.last();
        let short = |at| self.shortfall(at, stuck, slipping);
        let rests = before.slip[stuck] && self.setup.goes_on.is_some();
        before.p[stuck] > 0.0 && (rests || short(self.now) > short(before))
    }
}
