//! Cells that the rim of the contact, or the border of the stick zone, goes through.
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
//! bodies; Comninou, J. Appl. Mech. 43 (1976) 631). Of the laws that may hold the one counts whose level is
//! the straightest.
//!
//! Where a stick zone grows, cells stick with the shear that they slipped with, and how they fall short of
//! their bound tells where the border was in every increment. There the slip s of the increment tells it,
//! which goes like d^(3/2) from the border outwards, f = s^(2/3): the border in the middle of the increment,
//! to second order, since what slips in all of it are the cells outside that. What the zone has grown since
//! is in `balance`.
//!
//! How a level is continued to the border: `level`.

use crate::cells::Lattice;
use crate::cells::size;
use crate::march::March;
use crate::reference::dundurs_beta;
use crate::solvers::Interface;
use crate::solvers::intermediate::friction_bound;
use crate::zones::{Edge, Level, Line, Power, SHRINKS, STICK, Told};

/// Cells across a slip ring on dissimilar bodies up to which they tell its rim no better than with those
/// that stick, whose pressure follows another law. In wider ones all do but the innermost, next to
/// where that law begins, and no fewer than leave two after those that no root is told by.
const RING: usize = 3;
const FEWEST: usize = 4;

/// Areas, in kept cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zones {
    pub(crate) contact: f64,
    /// The stick zone.
    pub(crate) stick: f64,
}

impl March {
    /// Areas of the contact and of the stick zone, given the slip of a cell in the increment \[m\].
    pub(crate) fn zones(&self, now: &Interface, slip: impl Fn(usize) -> f64) -> Zones {
        let lattice = Lattice::new(&self.window.grid, self.plan.mirror);
        let beta = dundurs_beta(self.scene.body1.outermost(), self.scene.body2.outermost());
        let contact: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
        let stick: Vec<bool> = contact
            .iter()
            .zip(&now.slip)
            .map(|(&c, &s)| c && !s)
            .collect();
        let rim = lattice.edges(&contact, [Told::ROOT, Told::LINEAR], |line| {
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
        });
        let area = |zone: &[bool], edges: &[(usize, Edge)]| -> f64 {
            let whole = zone.iter().filter(|&&inside| inside).count() as f64;
            let partial = |(n, edge): &(usize, Edge)| edge.share() - f64::from(u8::from(zone[*n]));
            whole + edges.iter().map(partial).sum::<f64>()
        };
        let contact_area = area(&contact, &rim);
        if !now.slip.contains(&true) {
            return Zones {
                contact: contact_area,
                stick: contact_area,
            };
        }
        // What the shear of a cell falls short of its bound along that of a cell that slips.
        let shortfall = |at: &Interface, n: usize, slipping: usize| {
            let q = [now.q[0][slipping], now.q[1][slipping]];
            let [x, y] = q.map(|q_k| q_k / size(q).max(f64::MIN_POSITIVE));
            friction_bound(self.mu[n], at.p[n]) - (at.q[0][n] * x + at.q[1][n] * y)
        };
        let slips: Vec<bool> = now
            .p
            .iter()
            .zip(&now.slip)
            .map(|(&p, &s)| p > 0.0 && s)
            .collect();
        let beside = |line: &Line| {
            if slips[line.outside] {
                line.outside
            } else {
                line.outermost()
            }
        };
        let told = [Told::ROOT, Told::LINEAR].map(Told::before_the_middle);
        let mut border = lattice.edges(&stick, told, |line| {
            let slipping = beside(line);
            (STICK, move |n| shortfall(now, n, slipping))
        });
        // The zone grows where a cell has come to stick, but for a reversal, or falls further behind its
        // bound.
        let before = self.before();
        let grew = |stuck: usize, slipping: usize| {
            let short = |at| shortfall(at, stuck, slipping);
            let rests = before.slip[stuck] && self.datum.goes_on;
            before.p[stuck] > 0.0 && (rests || short(now) > short(before))
        };
        for (n, edge) in &mut border {
            edge.level = edge.level.filter(|level| level.law == SHRINKS);
            let line = edge.level.map(|level| level.line);
            if line.is_some_and(|line| !grew(line.outermost(), beside(&line))) {
                continue;
            }
            edge.level = None;
            let laws = |_: &mut Line| ([Power::TwoThirds], &slip);
            let by_slip = lattice.edge(*n, &slips, [Told::SLIP], &laws);
            let grown = by_slip.level.is_some_and(|Level { line, .. }| {
                stick[line.outside] && grew(line.outside, line.outermost())
            });
            if grown {
                *edge = by_slip.other_side(stick[*n]);
            }
        }
        for (n, edge) in &mut border {
            if let Ok(at) = rim.binary_search_by_key(n, |(n, _)| *n)
                && edge.share() > rim[at].1.share()
            {
                *edge = rim[at].1;
            }
        }
        Zones {
            contact: contact_area,
            stick: area(&stick, &border),
        }
    }
}
