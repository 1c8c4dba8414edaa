//! Memory of the stick zone of an indentation, and its end on a finer grid.
//!
//! A cell that sticks remembers one displacement, V: the one of the moment it came to stick. Where
//! round smooth bodies come into contact V is radial and a smooth function of the radius, of bodies
//! without coatings r^2 times a constant (self-similarity). It is fitted to the stick cells of the
//! path grid,
//!
//! ```text
//! V(r) = x^2 sum_k a_k B(m x + 1 - k),   x = r/c,  k = 0 ... m + 2,
//! ```
//!
//! c the radius of the stick zone, B the cubic B-spline of knots at the integers. Over a coating V/x^2
//! changes sign and bends on the scale of the thickness. Where few cells lie in a piece the second
//! differences of the a_k are held small (P. H. C. Eilers, B. D. Marx, Stat. Sci. 11 (1996) 89). The grid
//! of the scene is solved at the end of the branch alone, with V as the displacement that means no slip.
//!
//! **The ring of slip.** There V continued is where a particle *will* come to stick: it is ahead of
//! the particle, u = V - g (r - c)^(5/2) d with d the direction of slip. (The stick zone grows, so that
//! neither the shear rate nor the slip rate has a root at its border, and the slip rate goes with
//! (r - c)^(3/2).) The slip counted from V has the wrong sign. Behind the particle is
//!
//! ```text
//! V(c) + V'(c) (r - c) + V''(c) (r - c)^2/2 - b (r - c)^2 d
//! ```
//!
//! with b (r - c)^2 several times what V is ahead. Of the slip Coulomb's law takes the direction alone, so
//! that b does not matter, and where cells beyond c stick they remember V except for b (r - c)^2.

use std::f64::consts::PI;

use super::carried::pressed;
use super::domain::embedded_state;
use super::entry::LeastSquares;
use super::growing::is_remembered;
use super::{Increment, March, State};
use crate::cells::length;
use crate::error::Error;
use crate::plan::Mirror;
use crate::scene::{Grid, LoadPoint, Scene};

/// m. On 13 random scenes (path on 64 cells, 21 increments) the largest error of the shear, over the error of
/// all increments on 128 cells, is 6.2, 4.8, 2.6 and 33 with 3, 5, 7 and 9
/// (second differences free).
const PIECES: usize = 7;
const TERMS: usize = PIECES + 3;
/// Weight of the squared second differences of the a_k, over the weight of all stick cells: with 1e-7, 1e-5 and
/// 1e-3 that error is 3.1, 5.2 and 11.
const STIFF: f64 = 1e-7;
/// b (r - c)^2 over the largest distance of a cell of the path grid behind V.
const BEHIND: f64 = 4.0;
/// Smallest c over the contact radius.
const LEAST_STICK: f64 = 0.5;
/// Cells of the ring nearer to the border than this part of c are not used for that distance.
const BESIDE: f64 = 0.02;

/// V, and the displacement behind the particles in the ring of slip.
struct Remembered {
    /// a_k \[m\]
    law: [f64; TERMS],
    /// c \[m\]
    stick: f64,
    /// b c^2 d, outwards \[m\].
    behind: f64,
    /// d outwards, 1 or -1.
    slips: f64,
}

impl Remembered {
    /// Reads the function of the radius that the stick zone remembers from the state after an increment, by a
    /// fit of splines.
    fn from_state(scene: &Scene, mirror: Mirror, state: &State, row: &Increment) -> Self {
        let places = places(scene, mirror, state.window);
        let now = &state.interface;
        let stick = (row.stick_area / PI).sqrt().max(scene.grid.dx);
        let shift = [state.motion.delta_x, state.motion.delta_y];
        let contact = || (places.iter().enumerate()).filter(|(n, _)| now.p[*n] > 0.0);
        let out = |f: [f64; 2], at: [f64; 2]| (f[0] * at[0] + f[1] * at[1]) / length(at);
        let moved = |n: usize, at| out([0, 1].map(|c| now.u[c][n] - shift[c]), at);
        let mut fit = LeastSquares::<TERMS, 1>::new();
        let mut cells = 1.0;
        for (n, at) in contact().filter(|(n, _)| !now.slips[*n]) {
            fit.add(1.0, terms(length(*at) / stick), [moved(n, *at)]);
            cells += 1.0;
        }
        for k in 1..TERMS - 1 {
            let mut bend = [0.0; TERMS];
            bend[k - 1..=k + 1].copy_from_slice(&[1.0, -2.0, 1.0]);
            fit.add(STIFF * cells, bend, [0.0]);
        }
        let ring = || contact().filter(|(n, _)| now.slips[*n]);
        let shear = |cells: &mut dyn Iterator<Item = (usize, &[f64; 2])>| -> f64 {
            cells
                .map(|(n, at)| out([0, 1].map(|c| now.q[c][n]), *at))
                .sum()
        };
        let of_ring = shear(&mut ring());
        let total_shear = if of_ring == 0.0 {
            shear(&mut contact())
        } else {
            of_ring
        };
        let mut remembered = Self {
            law: fit.factors()[0],
            stick,
            behind: 0.0,
            slips: -total_shear.signum(),
        };
        let ahead = ring().filter_map(|(n, at)| {
            let beyond = length(*at) / stick - 1.0;
            let ahead =
                (remembered.displacement_at(1.0 + beyond) - moved(n, *at)) * remembered.slips;
            (beyond > BESIDE).then(|| BEHIND * ahead / (beyond * beyond))
        });
        remembered.behind =
            ahead.fold(remembered.displacement_at(1.0).abs(), f64::max) * remembered.slips;
        remembered
    }

    /// The radial displacement \[m\] without slip at the radius x = r/c, c being the stick radius. Beyond x = 1
    /// it goes on as a parabola.
    fn displacement_at(&self, x: f64) -> f64 {
        if x <= 1.0 {
            let terms = terms(x).into_iter().zip(self.law);
            return terms.map(|(term, a)| term * a).sum();
        }
        // S = V/x^2 and its derivatives at x = 1.
        let m = PIECES as f64;
        let [a, b, c] = [0, 1, 2].map(|k| self.law[PIECES + k]);
        let (S, slope) = ((a + 4.0 * b + c) / 6.0, 0.5 * m * (c - a));
        let bend = m * m * (a - 2.0 * b + c);
        let taylor = [S, 2.0 * S + slope, 2.0 * S + 4.0 * slope + bend];
        let beyond = x - 1.0;
        taylor[0] + beyond * (taylor[1] + beyond * (0.5 * taylor[2] - self.behind))
    }

    /// Puts the remembered displacement into a state on a finer grid. Cells beyond the stick radius c are at
    /// the limit of friction.
    fn put_into(&self, state: &mut State, scene: &Scene, mirror: Mirror) {
        let places = places(scene, mirror, state.window);
        let shift = [state.motion.delta_x, state.motion.delta_y];
        let now = &mut state.interface;
        for (n, at) in places.into_iter().enumerate() {
            let r = length(at);
            now.slips[n] = now.p[n] > 0.0 && r > self.stick;
            for c in 0..2 {
                let out = at[c] / r;
                now.u[c][n] = out * self.displacement_at(r / self.stick) + shift[c];
                if now.slips[n] {
                    now.q[c][n] = -self.slips * out * scene.friction.mu * now.p[n];
                }
            }
        }
    }
}

/// The terms of the fit at x = r/c: x^2 B(m x + 1 - k) for each k, B the cubic B-spline and m the number of
/// pieces.
fn terms(x: f64) -> [f64; TERMS] {
    std::array::from_fn(|k| {
        let s = (PIECES as f64 * x + 1.0 - k as f64).abs();
        let within = 2.0 / 3.0 - s * s * (1.0 - 0.5 * s);
        let beyond = (2.0 - s).max(0.0).powi(3) / 6.0;
        x * x * if s < 1.0 { within } else { beyond }
    })
}

/// Positions of the kept cells of a window \[m\].
fn places(scene: &Scene, mirror: Mirror, (nx, ny): (usize, usize)) -> Vec<[f64; 2]> {
    let grid = Grid {
        nx,
        ny,
        ..scene.grid
    };
    let [x, y] = [grid.map(|x, _| x), grid.map(|_, y| y)].map(|of| mirror.fold(&of));
    x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
}

/// Whether the stick zone is large enough to predict where the particles of the ring come to stick: with
/// c = 0.48 a the error is three times the error of the increments.
pub(super) fn remembers_enough(row: &Increment) -> bool {
    row.contact_area <= 0.0 || row.stick_ratio() > LEAST_STICK * LEAST_STICK
}

impl March {
    /// Whether the branch of a point is an indentation whose end is solved from what the stick zone remembers.
    pub(super) fn remembers(&self, point: &LoadPoint) -> bool {
        point.branch == 0 && is_remembered(&self.problem.scene, &self.problem.plan)
    }

    /// Solves the end of an increment `row` that was solved on the grid of the scene `of`, cells
    /// `ratio` times as long, from what the stick zone remembers in the state `after` it. The sums
    /// over the path and the energies belong to that grid.
    pub(super) fn remember(
        &mut self,
        point: &LoadPoint,
        (of, after, row): (&Scene, &State, &Increment),
        ratio: usize,
    ) -> Result<Increment, Error> {
        let mirror = self.problem.plan.mirror;
        let law = Remembered::from_state(of, mirror, after, row);
        let along = self.state.along.clone();
        self.domain.fit(&self.problem, &mut self.state, point)?;
        let sums = pressed(&self.problem, self.state.window, after, ratio);
        let mut from = State {
            along,
            increments: after.increments - 1,
            // The loads do not change any more.
            step: crate::scene::Loads::default(),
            ..sums.clone()
        };
        law.put_into(&mut from, &self.problem.scene, mirror);
        let before = std::mem::replace(&mut self.state, from);
        let mut solved = match self.advance_to(point) {
            Ok(solved) => solved,
            Err(error) => {
                self.state = before;
                return Err(error);
            }
        };
        let kept = |(nx, ny): (usize, usize)| (nx, mirror.rows(ny));
        let state = &mut self.state;
        let sums = embedded_state(&sums, kept(sums.window), kept(state.window), mirror);
        *state = State {
            interface: std::mem::take(&mut state.interface),
            window: state.window,
            loads: state.loads,
            motion: state.motion,
            without_slip: state.without_slip,
            at_limit: std::mem::take(&mut state.at_limit),
            clear: state.clear,
            residual: std::mem::take(&mut state.residual),
            along: state.along.take(),
            ..sums
        };
        solved.energy = row.energy;
        solved.residuals.energy = row.residuals.energy;
        Ok(solved)
    }
}
