//! The displacements that mean no slip in an increment.
//!
//! Eq. (7) reckons the slip from the last increment, ds = u - u_ref - d(delta), and eq. (8) holds it
//! against the shear at the end. Both are of first order in the increment. Two corrections of u_ref
//! make the path of second order, for cells that enter the contact (`entering`) and for slip whose
//! direction turns within the increment:
//!
//! ```text
//! ds = -lambda m,   m = (e_0 + e_1)/|e_0 + e_1|
//! ```
//!
//! with e_0 and e_1 the directions of the shear where the slip begins and at the end; the part of
//! that slip across e_1, |ds| ((m.e_1) e_1 - m), is added to u_ref, so that the solver, which holds
//! the slip against the final shear, finds it there. A cell that starts to slip on the way does so
//! where its shear, going on as in the last increment, meets the bound. Where no cell sticks, bodies
//! slide by as much as they are moved, and the shear has turned into their direction at the end.

use crate::solvers::{Arms, CoupledInfo, Interface, SlipDatum, set_pairs, size};

/// Least cosine between e_0 and e_1: where the shear turns further, the way there is not known.
const TURN: f64 = 0.5;

/// What the displacements that mean no slip differ by from the last ones.
#[derive(Debug)]
pub(super) struct Datum {
    /// The difference \[m\]: of cells that enter the contact their motion before, of those that
    /// slip on the turn of their shear.
    pub(super) moved: [Vec<f64>; 2],
    /// The displacements that mean no slip \[m\].
    displacements: [Vec<f64>; 2],
    /// Whether the loads go on as in the last increment.
    pub(super) goes_on: bool,
    /// What cells outside the contact move before they enter it \[m\], where it matters.
    pub(super) entering: Option<[Vec<f64>; 2]>,
}

impl Datum {
    pub(super) fn new(cells: usize) -> Self {
        let pair = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            moved: pair(),
            displacements: pair(),
            goes_on: false,
            entering: None,
        }
    }

    /// Begins with the last displacements.
    pub(super) fn reset(&mut self, last: &Interface) {
        for c in 0..2 {
            self.moved[c].fill(0.0);
            self.displacements[c].copy_from_slice(&last.u[c]);
        }
    }
}

/// The datum of an increment while that is being solved.
pub(super) struct Following<'a> {
    pub(super) datum: &'a mut Datum,
    /// The interface that the increment starts from.
    pub(super) last: &'a Interface,
    /// The shear an increment earlier, if the loads go on as in that increment.
    pub(super) q_before: Option<&'a [Vec<f64>; 2]>,
    /// Whether slip follows the turn of the shear.
    pub(super) turns: bool,
    pub(super) arms: &'a Arms,
}

impl SlipDatum for Following<'_> {
    fn follow(&mut self, now: &Interface, info: &CoupledInfo) {
        let Datum {
            moved,
            displacements,
            entering,
            ..
        } = &mut *self.datum;
        let (last, arms) = (self.last, self.arms);
        let motion = |n: usize| -> [f64; 2] {
            let shift = arms.in_plane(info.shift, n);
            std::array::from_fn(|c| now.u[c][n] - last.u[c][n] - shift[c])
        };
        let (entering, q_before) = (&*entering, self.q_before);
        let turns = self.turns && (0..now.p.len()).any(|n| now.p[n] > 0.0 && !now.slip[n]);
        let [x, y] = moved;
        set_pairs([x, y], |n, _| {
            if now.p[n] <= 0.0 {
                [0.0; 2]
            } else if last.p[n] <= 0.0 {
                entering
                    .as_ref()
                    .map_or([0.0; 2], |moved| [moved[0][n], moved[1][n]])
            } else if turns && now.slip[n] {
                turned(last, q_before, now, motion(n), n)
            } else {
                [0.0; 2]
            }
        });
        let moved = &*moved;
        let [x, y] = displacements;
        set_pairs([x, y], |n, _| {
            [last.u[0][n] + moved[0][n], last.u[1][n] + moved[1][n]]
        });
    }

    fn displacements(&self) -> [&[f64]; 2] {
        let [x, y] = &self.datum.displacements;
        [x, y]
    }
}

/// The part of the slip across the final shear \[m\].
fn turned(
    last: &Interface,
    q_before: Option<&[Vec<f64>; 2]>,
    now: &Interface,
    slip: [f64; 2],
    n: usize,
) -> [f64; 2] {
    let at = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let end = at(&now.q);
    let begin = if last.slip[n] {
        Some(at(&last.q))
    } else {
        q_before.and_then(|before| met(at(before), at(&last.q), size(end)))
    };
    let Some(begin) = begin else {
        return [0.0; 2];
    };
    let (e_0, e_1) = (unit(begin), unit(end));
    if dot(e_0, e_1) < TURN {
        return [0.0; 2];
    }
    let m = unit([e_0[0] + e_1[0], e_0[1] + e_1[1]]);
    let along = dot(m, e_1);
    std::array::from_fn(|c| size(slip) * (along * e_1[c] - m[c]))
}

/// Where a shear that goes on from `before` through `last` meets the circle of radius `bound`.
fn met(before: [f64; 2], last: [f64; 2], bound: f64) -> Option<[f64; 2]> {
    let on = [last[0] - before[0], last[1] - before[1]];
    let inside = bound * bound - dot(last, last);
    if inside <= 0.0 {
        return Some(last);
    }
    let (a, b) = (dot(on, on), dot(last, on));
    let t = ((b * b + a * inside).sqrt() - b) / a;
    t.is_finite()
        .then(|| [last[0] + t * on[0], last[1] + t * on[1]])
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn unit(a: [f64; 2]) -> [f64; 2] {
    let size = size(a).max(f64::MIN_POSITIVE);
    [a[0] / size, a[1] / size]
}
