//! The displacements that mean no slip in an increment.
//!
//! Eq. (7) reckons the slip from the last increment, ds = u - u_ref - d(delta), and eq. (8) holds it
//! against the shear at the end. Both are of first order in the increment. Two corrections of u_ref
//! make the path of second order, for cells that enter the contact (`kept_contact`) and for slip whose
//! direction turns within the increment:
//!
//! ```text
//! ds = -lambda m,   m = (w e_0 + e_1)/|w e_0 + e_1|
//! ```
//!
//! with e_0 and e_1 the directions of the shear where the slip begins and at the end; the part of
//! that slip across e_1, |ds| ((m.e_1) e_1 - m), is added to u_ref, so that the solver, which holds
//! the slip against the final shear, finds it there. It follows the solution until both agree; when
//! e_1 turns by a small angle m turns by 1/(1 + w) of it, which the Newton steps reckon with. A cell that
//! starts to slip on the way does so where its shear, going on as in the last increment, meets the bound;
//! after a reversal, where slip has only begun, nothing is known of that. Its slip grows with the 3/2
//! power of the time since, so that the mean of a direction that turns evenly has w = 2/3. In cells that
//! slip all the time w would be 1 if they did so evenly. But then what is wrong in e_0 comes back in e_1
//! with the other sign, and never dies away; with a little less it does, and most of what slips does so
//! faster and faster, which asks for less too. Of a cell that entered the contact in the last increment e_0
//! is mostly what is wrong in its motion before: it has w = 0. Where no cell sticks, or cells slip by as
//! much as the shear can move a surface, mu times the approach, bodies slide by as much as they are moved,
//! and the shear has turned into their direction at the end.
//!
//! Where the solver left slip e that should not be, within its tolerance (in stick cells all of it, in
//! slip cells the part not opposite to the shear), the next increment makes it good: u_ref = u - e, with u
//! the last displacements. In a stick cell that is u_ref + d(delta) of the last increment, whatever the
//! solver missed of it, so that nothing adds up along the path.

use rayon::prelude::*;

use crate::cells::{Arms, CHUNK, set, size};
use crate::solvers::Interface;
use crate::solvers::intermediate::SlipDatum;

/// Cosines between e_0 and e_1 between which the turn comes to count: where the shear turns further, the
/// way there is not known.
const TURN: [f64; 2] = [0.5, 0.7];
/// w of a cell that slips all the time, and of one that starts to slip.
const GOES_ON: f64 = 0.8;
const STARTS: f64 = 2.0 / 3.0;

/// What the displacements that mean no slip differ by from the last ones.
#[derive(Debug)]
pub(super) struct Datum {
    /// The difference \[m\]: of cells outside the contact their motion before they enter it, of those
    /// in it the turn of their slip.
    pub(super) moved: [Vec<f64>; 2],
    /// Derivative of the part across e_1 by the angle of e_1, over the slip: one half for small turns.
    turning: Vec<f64>,
    /// Whether the loads go on as in the last increment.
    pub(super) goes_on: bool,
    /// The displacements \[m\].
    pub(super) displacements: [Vec<f64>; 2],
}

impl Datum {
    pub(super) fn new(cells: usize) -> Self {
        let pair = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            moved: pair(),
            turning: vec![0.0; cells],
            goes_on: false,
            displacements: pair(),
        }
    }

    /// Begins with the last displacements less what they `missed`, of cells outside the contact with what
    /// these move before they enter it, where that matters.
    pub(super) fn reset(
        &mut self,
        last: &Interface,
        missed: &[Vec<f64>; 2],
        entering: Option<&[Vec<f64>; 2]>,
    ) {
        let [x, y] = &mut self.moved;
        match entering {
            Some([to_x, to_y]) => set([&to_x[..], to_y], [x, y], |_, to, _| to),
            None => set([], [x, y], |_, [], _| [0.0; 2]),
        }
        let from = [&last.u[0][..], &last.u[1], &missed[0], &missed[1], x, y];
        let [x, y] = &mut self.displacements;
        set(from, [x, y], |_, [u_x, u_y, off_x, off_y, x, y], _| {
            [u_x - off_x + x, u_y - off_y + y]
        });
    }
}

/// The datum of an increment while that is being solved.
pub(super) struct Following<'a> {
    pub(super) datum: &'a mut Datum,
    /// The interface that the increment starts from.
    pub(super) last: &'a Interface,
    /// What its slip missed \[m\].
    pub(super) missed: &'a [Vec<f64>; 2],
    /// The interface an increment earlier, if slip is to follow the turn of the shear and the loads go on as
    /// in that increment.
    pub(super) before: Option<Before<'a>>,
    pub(super) arms: &'a Arms,
    /// What the shear may move a surface by before the bodies slide, about \[m\].
    pub(super) reach: f64,
}

/// Where the last increment started.
#[derive(Clone, Copy)]
pub(super) struct Before<'a> {
    /// Pressure \[Pa\].
    pub(super) p: &'a [f64],
    /// Shear \[Pa\].
    pub(super) q: &'a [Vec<f64>; 2],
}

impl SlipDatum for Following<'_> {
    fn follow(&mut self, now: &Interface, shift: [f64; 3], part: f64) -> bool {
        let (missed, last, arms) = (self.missed, self.last, self.arms);
        let Some(before) = self.before else {
            return false;
        };
        let sticks = (0..now.p.len()).any(|n| now.p[n] > 0.0 && !now.slip[n]);
        let slip = |n: usize| -> [f64; 2] {
            let shift = arms.in_plane(shift, n);
            std::array::from_fn(|c| now.u[c][n] - last.u[c][n] - shift[c])
        };
        let reach = self.reach;
        let turned = |n: usize| -> ([f64; 2], f64) {
            if !(sticks && now.p[n] > 0.0 && now.slip[n]) {
                return ([0.0; 2], 0.0);
            }
            let slip = slip(n);
            let slides = (2.0 - 2.0 * size(slip) / reach).clamp(0.0, 1.0);
            turn(last, &before, now, slip, n).map_or(([0.0; 2], 0.0), |(across, follows)| {
                (across.map(|e| slides * e), part * slides * follows)
            })
        };
        let Datum {
            moved,
            turning,
            displacements,
            ..
        } = &mut *self.datum;
        let ([x, y], [u_x, u_y]) = (moved, displacements);
        let chunks = (
            x.par_chunks_mut(CHUNK),
            y.par_chunks_mut(CHUNK),
            turning.par_chunks_mut(CHUNK),
            u_x.par_chunks_mut(CHUNK),
            u_y.par_chunks_mut(CHUNK),
        );
        let chunks = chunks.into_par_iter().enumerate();
        chunks.for_each(|(chunk, (x, y, turning, u_x, u_y))| {
            for i in 0..x.len() {
                let n = chunk * CHUNK + i;
                if last.p[n] <= 0.0 {
                    turning[i] = 0.0;
                    continue;
                }
                let (to, follows) = turned(n);
                x[i] += part * (to[0] - x[i]);
                y[i] += part * (to[1] - y[i]);
                u_x[i] = last.u[0][n] - missed[0][n] + x[i];
                u_y[i] = last.u[1][n] - missed[1][n] + y[i];
                turning[i] = follows;
            }
        });
        sticks
    }

    fn displacements(&self) -> [&[f64]; 2] {
        let [x, y] = &self.datum.displacements;
        [x, y]
    }

    fn turning(&self) -> &[f64] {
        &self.datum.turning
    }
}

/// The part of the slip across the final shear \[m\], as far as the way there is known,
///
/// ```text
/// |ds| known(cos a) w sin(a)/|w e_0 + e_1|,   a the angle from e_0 to e_1,
/// ```
///
/// and its derivative by a over |ds|.
fn turn(
    last: &Interface,
    before: &Before<'_>,
    now: &Interface,
    slip: [f64; 2],
    n: usize,
) -> Option<([f64; 2], f64)> {
    let at = |q: &[Vec<f64>; 2]| [q[0][n], q[1][n]];
    let end = at(&now.q);
    let (begin, w) = match last.slip[n] {
        true if before.p[n] <= 0.0 => return None,
        true => (at(&last.q), GOES_ON),
        false => (met(at(before.q), at(&last.q), size(end))?, STARTS),
    };
    let (e_0, e_1) = (unit(begin), unit(end));
    let cos = dot(e_0, e_1).clamp(-1.0, 1.0);
    let part = (cos - TURN[0]) / (TURN[1] - TURN[0]);
    let known = part.clamp(0.0, 1.0);
    let mean = [0, 1].map(|c| w * e_0[c] + e_1[c]);
    let (length, m) = (size(mean), unit(mean));
    let along = dot(m, e_1);
    let across = [0, 1].map(|c| known * size(slip) * (along * e_1[c] - m[c]));
    let fades = if (0.0..=1.0).contains(&part) {
        w * (1.0 - cos * cos) / (length * (TURN[1] - TURN[0]))
    } else {
        0.0
    };
    let follows = known * along * w * (w + cos) / (length * length) - fades;
    Some((across, follows))
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
