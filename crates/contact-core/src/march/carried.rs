//! The state of a fine grid carried along the path by the change of a coarse one.
//!
//! From the last increment that was solved on it (0) to the present one the fine grid takes over the
//! change of the fields f of the coarse grid, interpolated (I):
//!
//! ```text
//! f_fine := f_fine + I (f_coarse - f_coarse,0)
//! ```
//!
//! - Displacements u: cubic interpolation (R. G. Keys, IEEE Trans. ASSP 29 (1981) 1153). It is exact
//!   for fields linear in x and y, so that cells that stuck move with the rigid body that they stick
//!   to and get no slip from it.
//! - Tractions: linear interpolation between cells in contact, in the cells of the fine contact,
//!   which does not change at constant normal force; the pressure is scaled to the change of its
//!   sum.
//! - Slip zone: that of the coarse grid, with the shear on the bound, q := mu p q_coarse/|q_coarse|.
//! - Slip, its length and dissipated energy: linear interpolation, without cells out of contact.
//!
//! The increment that follows solves for the tractions. Only the displacements of sticking cells and
//! the sums of slip and energy keep what was carried.

use rayon::prelude::*;

use super::State;
use super::domain::embedded_state;
use super::path_grid::Along;
use super::problem::Problem;
use crate::cells::size;
use crate::plan::{Half, Mirror};
use crate::scene::Grid;
use crate::solvers::Interface;

/// The state of the fine grid at the present increment of the coarse one.
pub(super) fn carried(problem: &Problem, state: &State, along: &Along, ratio: usize) -> State {
    let mirror = problem.plan.mirror;
    let kept = |(nx, ny): (usize, usize)| (nx, mirror.rows(ny));
    let (coarse, fine) = (kept(along.now.window), kept(state.window));
    let now = &along.now;
    let then = &embedded_state(&along.then, kept(along.then.window), coarse, mirror);
    let on_fine = |weights: fn(f64) -> [f64; 4]| {
        let of = |to: usize, from: usize, mirrored: bool| axis(to, from, ratio, mirrored, weights);
        Interpolation {
            columns: of(fine.0, coarse.0, false),
            rows: of(fine.1, coarse.1, mirror == Mirror::Y),
            width: coarse.1,
        }
    };
    let (cubic, linear) = (on_fine(cubic), on_fine(linear));
    let contact: Vec<f64> = now.interface.p.iter().map(|p| is(*p > 0.0)).collect();
    let within = linear.of(&contact, Half::Even);
    // Interpolates between cells in contact.
    let masked = |of: &dyn Fn(usize) -> f64, half: Half| {
        let field: Vec<f64> = (0..contact.len())
            .map(|n| if contact[n] > 0.0 { of(n) } else { 0.0 })
            .collect();
        let mut on_fine = linear.of(&field, half);
        for (value, within) in on_fine.iter_mut().zip(&within) {
            *value = if *within > 0.0 { *value / within } else { 0.0 };
        }
        on_fine
    };
    let change = |now: &[f64], then: &[f64], half| masked(&|n| now[n] - then[n], half);

    let mut carried = state.clone();
    let (halves, [i, j]) = ([Half::Even, Half::Odd], [&now.interface, &then.interface]);
    for c in 0..2 {
        let moved = cubic.of(&difference(&i.u[c], &j.u[c]), halves[c]);
        add(&mut carried.interface.u[c], &moved);
        add(
            &mut carried.slip[c],
            &change(&now.slip[c], &then.slip[c], halves[c]),
        );
    }
    add(
        &mut carried.interface.u_z,
        &cubic.of(&difference(&i.u_z, &j.u_z), Half::Even),
    );
    let sums = [
        (
            &mut carried.slip_length,
            &now.slip_length,
            &then.slip_length,
        ),
        (&mut carried.dissipated, &now.dissipated, &then.dissipated),
    ];
    for (sum, now, then) in sums {
        add(sum, &change(now, then, Half::Even));
    }

    let touches: Vec<bool> = state.interface.p.iter().map(|p| *p > 0.0).collect();
    let total = |p: &[f64]| p.iter().sum::<f64>();
    let share = total(&i.p) / total(&j.p);
    let of_p = change(&i.p, &j.p, Half::Even);
    let p = &mut carried.interface.p;
    for (p, of_p) in p.iter_mut().zip(&of_p).filter(|(p, _)| **p > 0.0) {
        *p = if *p + of_p > 0.0 { *p + of_p } else { *p };
    }
    let factor = share * total(&state.interface.p) / total(p);
    if factor.is_finite() {
        p.iter_mut().for_each(|p| *p *= factor);
    }
    let last = change(&i.p, &now.p_before, Half::Even);
    let before = carried.interface.p.iter().zip(&last);
    carried.p_before = before
        .map(|(p, last)| if *p > 0.0 { (p - last).max(0.0) } else { 0.0 })
        .collect();

    let slips = masked(&|n| is(i.slip[n]), Half::Even);
    let at_limit = masked(&|n| is(now.at_limit[n]), Half::Even);
    let direction = [0, 1].map(|c| masked(&|n| i.q[c][n], halves[c]));
    let of_q = [0, 1].map(|c| change(&i.q[c], &j.q[c], halves[c]));
    let last = [0, 1].map(|c| change(&i.q[c], &now.q_before[c], halves[c]));
    let mu = mu(problem, state.window);
    for n in (0..touches.len()).filter(|&n| touches[n]) {
        let interface = &mut carried.interface;
        if within[n] > 0.0 {
            interface.slip[n] = slips[n] > 0.5;
            carried.at_limit[n] = at_limit[n] > 0.5;
        }
        let along = [direction[0][n], direction[1][n]];
        let bound = mu(n) * interface.p[n];
        let onto_bound = interface.slip[n] && size(along) > 0.0 && bound.is_finite();
        for c in 0..2 {
            let q = &mut interface.q[c][n];
            *q = if onto_bound {
                bound * along[c] / size(along)
            } else {
                *q + of_q[c][n]
            };
            carried.q_before[c][n] = *q - last[c][n];
        }
    }
    // The sum of the shear is that of the loads: sticking cells share the difference.
    for c in 0..2 {
        let [now, then] = [i, j].map(|of| total(&of.q[c]));
        let sum = total(&state.interface.q[c]) + (ratio * ratio) as f64 * (now - then);
        let missing = sum - total(&carried.interface.q[c]);
        let Interface { p, q, slip, .. } = &mut carried.interface;
        let sticks = |n: &usize| p[*n] > 0.0 && !slip[*n];
        let count = (0..p.len()).filter(sticks).count().max(1) as f64;
        for n in (0..p.len()).filter(sticks) {
            q[c][n] += missing / count;
        }
    }
    carried.without_slip = now.without_slip;
    // The gap beyond the window is unknown.
    carried.clear = 0.0;
    carried
}

/// Friction coefficient of the kept cells of a window.
fn mu(problem: &Problem, (nx, ny): (usize, usize)) -> impl Fn(usize) -> f64 {
    let friction = &problem.scene.friction;
    let grid = Grid {
        nx,
        ny,
        ..problem.scene.grid
    };
    let map = friction.map.as_ref();
    let map = map.map(|map| problem.plan.mirror.fold(&grid.map(|x, y| map.at(x, y))));
    let mu = friction.mu;
    move |n| map.as_ref().map_or(mu, |map| mu * map[n])
}

fn is(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn add(to: &mut [f64], change: &[f64]) {
    to.iter_mut()
        .zip(change)
        .for_each(|(to, change)| *to += change);
}

/// Weights of the four cells around a point at the part t of the way between the middle two.
fn cubic(t: f64) -> [f64; 4] {
    let near = |d: f64| (1.5 * d - 2.5) * d * d + 1.0;
    let far = |d: f64| ((-0.5 * d + 2.5) * d - 4.0) * d + 2.0;
    [far(1.0 + t), near(t), near(1.0 - t), far(2.0 - t)]
}

fn linear(t: f64) -> [f64; 4] {
    [0.0, 1.0 - t, t, 0.0]
}

/// A coarse cell in the interpolation of a fine one, and whether it is the mirror image of a kept
/// cell.
#[derive(Clone, Copy)]
struct Part {
    cell: usize,
    weight: f64,
    image: bool,
}

/// Weights along an axis: of `to` fine cells from `from` cells `ratio` times as long around the same
/// middle, or of the upper halves of both (`mirrored`); beyond the last coarse cell its value.
fn axis(
    to: usize,
    from: usize,
    ratio: usize,
    mirrored: bool,
    weights: fn(f64) -> [f64; 4],
) -> Vec<[Part; 4]> {
    let middle = |n: usize| if mirrored { 0.0 } else { 0.5 * n as f64 };
    let parts = |cell: usize| {
        let at = (cell as f64 + 0.5 - middle(to)) / ratio as f64 + middle(from) - 0.5;
        let weights = weights(at - at.floor());
        [0, 1, 2, 3].map(|k| {
            let cell = at.floor() as isize + k as isize - 1;
            let image = mirrored && cell < 0;
            let cell = if image { -1 - cell } else { cell };
            Part {
                cell: cell.clamp(0, from as isize - 1) as usize,
                weight: weights[k],
                image,
            }
        })
    };
    (0..to).map(parts).collect()
}

/// Interpolation from the coarse window to the fine one.
struct Interpolation {
    columns: Vec<[Part; 4]>,
    rows: Vec<[Part; 4]>,
    /// Coarse rows.
    width: usize,
}

impl Interpolation {
    fn of(&self, field: &[f64], half: Half) -> Vec<f64> {
        let along_rows = |column: &[f64]| -> Vec<f64> {
            let value = |part: &Part| {
                let sign = if part.image { half.sign() } else { 1.0 };
                sign * part.weight * column[part.cell]
            };
            (self.rows.iter())
                .map(|parts| parts.iter().map(value).sum())
                .collect()
        };
        let coarse: Vec<Vec<f64>> = field.par_chunks(self.width).map(along_rows).collect();
        let fine = self.columns.par_iter().flat_map_iter(|parts| {
            let value = |row: usize| parts.iter().map(|p| p.weight * coarse[p.cell][row]).sum();
            (0..self.rows.len()).map(value).collect::<Vec<f64>>()
        });
        fine.collect()
    }
}
