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
//! - Slip zone: the one of the coarse grid, with the shear on the bound, q := mu p q_coarse/|q_coarse|.
//! - Slip, its length and dissipated energy: linear interpolation, without cells out of contact; the energy
//!   is scaled to the change of its sum.
//!
//! The increment that follows solves for the tractions. Only the displacements of sticking cells and
//! the sums of slip and energy keep what was carried.

use rayon::prelude::*;

use super::domain::embedded_state;
use super::problem::Problem;
use super::state::{Along, State};
use crate::cells::length;
use crate::plan::{Mirror, Parity};
use crate::scene::Grid;
use crate::solvers::Interface;

/// Carries the state of the fine grid from the last increment that was solved on both grids to the present
/// increment of the coarse grid, by adding the interpolated change on the coarse grid.
pub(super) fn carried(problem: &Problem, state: &State, along: &Along, ratio: usize) -> State {
    let mirror = problem.plan.mirror;
    let kept = |(nx, ny): (usize, usize)| (nx, mirror.rows(ny));
    let (coarse, fine) = (kept(along.now.window), kept(state.window));
    let then = embedded_state(&along.then, kept(along.then.window), coarse, mirror);
    let change = Change::new(&along.now, &then, (coarse, fine), (ratio, mirror));
    let mut carried = state.clone();
    change.displacements_and_sums(&mut carried);
    change.pressure(&mut carried);
    change.shear(&mut carried, mu(problem, state.window), ratio);
    carried.without_slip = along.now.without_slip;
    // The gap beyond the window is unknown.
    carried.clear = 0.0;
    carried
}

/// The state on the fine grid, in a window, of bodies that only the coarse grid has pressed together so far:
/// its state `now` interpolated. The squares of the pressure are interpolated, since they grow linearly from
/// the rim. Slip before the last increment is not carried.
pub(super) fn pressed(
    problem: &Problem,
    window: (usize, usize),
    now: &State,
    ratio: usize,
) -> State {
    let mirror = problem.plan.mirror;
    let kept = |(nx, ny): (usize, usize)| (nx, mirror.rows(ny));
    let (coarse, fine) = (kept(now.window), kept(window));
    let then = State::unloaded(now.window, coarse.0 * coarse.1, 0.0);
    let change = Change::new(now, &then, (coarse, fine), (ratio, mirror));
    let unloaded = State::unloaded(window, fine.0 * fine.1, 0.0);
    let mut pressed = State {
        increments: now.increments,
        loads: now.loads,
        motion: now.motion,
        work: now.work,
        without_slip: now.without_slip,
        step: now.step,
        ..unloaded
    };
    change.displacements_and_sums(&mut pressed);
    let pressure = |p: &[f64]| -> Vec<f64> {
        let squares: Vec<f64> = p.iter().map(|p| p * p).collect();
        let on_fine = change.linear.interpolate(&squares, Parity::Even);
        let roots: Vec<f64> = on_fine.iter().map(|p| p.sqrt()).collect();
        let factor = (ratio * ratio) as f64 * total(p) / total(&roots).max(f64::MIN_POSITIVE);
        roots.iter().map(|p| factor * p).collect()
    };
    pressed.interface.p = pressure(&now.interface.p);
    pressed.p_before = pressure(&now.p_before);
    let none = &then.interface.q;
    for (c, half) in HALVES.into_iter().enumerate() {
        pressed.interface.q[c] = change.interpolate_change(&now.interface.q[c], &none[c], half);
        pressed.q_before[c] = change.interpolate_change(&now.q_before[c], &none[c], half);
    }
    let mark = |of: &[bool]| -> Vec<bool> {
        let part = change.interpolate_in_contact(|n| indicator(of[n]), Parity::Even);
        part.iter().map(|part| *part > 0.5).collect()
    };
    pressed.interface.slips = mark(&now.interface.slips);
    pressed.at_limit = mark(&now.at_limit);
    pressed
}

const HALVES: [Parity; 2] = [Parity::Even, Parity::Odd];

/// Change of the coarse grid since the fine one was solved last.
struct Change<'a> {
    now: &'a State,
    then: &'a State,
    cubic: Interpolation,
    linear: Interpolation,
    /// 1 where the coarse cells are in contact, else 0.
    contact: Vec<f64>,
    /// The tractions interpolated to the fine cells.
    within: Vec<f64>,
    /// Fine cells in a coarse one.
    fine_cells: f64,
}

impl<'a> Change<'a> {
    /// Prepares the interpolation of the change from the state `then` to the state `now` of the coarse grid.
    /// `coarse` and `fine` are the kept cells along x and y of the two windows, `ratio` the cells of the fine
    /// grid along a coarse one.
    fn new(
        now: &'a State,
        then: &'a State,
        (coarse, fine): ((usize, usize), (usize, usize)),
        (ratio, mirror): (usize, Mirror),
    ) -> Self {
        let on_fine = |weights: fn(f64) -> [f64; 4]| Interpolation {
            columns: axis_weights((fine.0, coarse.0), ratio, false, weights),
            rows: axis_weights((fine.1, coarse.1), ratio, mirror == Mirror::Y, weights),
            width: coarse.1,
        };
        let (cubic, linear) = (on_fine(cubic), on_fine(linear));
        let contact: Vec<f64> = now
            .interface
            .p
            .iter()
            .map(|p| indicator(*p > 0.0))
            .collect();
        Self {
            now,
            then,
            within: linear.interpolate(&contact, Parity::Even),
            cubic,
            linear,
            contact,
            fine_cells: (ratio * ratio) as f64,
        }
    }

    /// A field of the coarse grid (its value in cell n is `of(n)`), interpolated between cells in contact
    /// alone. `parity` is its symmetry under the mirror.
    fn interpolate_in_contact(&self, of: impl Fn(usize) -> f64, parity: Parity) -> Vec<f64> {
        let field: Vec<f64> = (self.contact.iter().enumerate())
            .map(|(n, contact)| if *contact > 0.0 { of(n) } else { 0.0 })
            .collect();
        let mut on_fine = self.linear.interpolate(&field, parity);
        for (value, within) in on_fine.iter_mut().zip(&self.within) {
            *value = if *within > 0.0 { *value / within } else { 0.0 };
        }
        on_fine
    }

    /// The difference `to` - `from` of two fields of the coarse grid, interpolated between cells in contact;
    /// `parity` is their symmetry under the mirror.
    fn interpolate_change(&self, to: &[f64], from: &[f64], parity: Parity) -> Vec<f64> {
        self.interpolate_in_contact(|n| to[n] - from[n], parity)
    }

    /// Adds the change of displacements, of total slip and of dissipated energy.
    fn displacements_and_sums(&self, carried: &mut State) {
        let (now, then) = (self.now, self.then);
        let (i, j) = (&now.interface, &then.interface);
        for c in 0..2 {
            let u = self
                .cubic
                .interpolate(&difference(&i.u[c], &j.u[c]), HALVES[c]);
            add(&mut carried.interface.u[c], &u);
            let slip = self.interpolate_change(&now.total_slip[c], &then.total_slip[c], HALVES[c]);
            add(&mut carried.total_slip[c], &slip);
        }
        let u_z = self
            .cubic
            .interpolate(&difference(&i.u_z, &j.u_z), Parity::Even);
        add(&mut carried.interface.u_z, &u_z);
        let length = self.interpolate_change(&now.slip_length, &then.slip_length, Parity::Even);
        add(&mut carried.slip_length, &length);
        let mut dissipated =
            self.interpolate_change(&now.dissipated, &then.dissipated, Parity::Even);
        let sum = total(&now.dissipated) - total(&then.dissipated);
        let factor = self.fine_cells * sum / total(&dissipated);
        if factor.is_finite() {
            for density in &mut dissipated {
                *density *= factor;
            }
        }
        add(&mut carried.dissipated, &dissipated);
    }

    /// Adds the change of pressure in the cells in contact, and scales the pressure so that its sum changes as
    /// on the coarse grid. Cells keep their pressure where it would become negative.
    fn pressure(&self, carried: &mut State) {
        let (i, j) = (&self.now.interface, &self.then.interface);
        let change = self.interpolate_change(&i.p, &j.p, Parity::Even);
        let p = &mut carried.interface.p;
        let sum = total(p) * total(&i.p) / total(&j.p);
        for (p, change) in p.iter_mut().zip(&change).filter(|(p, _)| **p > 0.0) {
            *p = if *p + change > 0.0 { *p + change } else { *p };
        }
        let factor = sum / total(p);
        if factor.is_finite() {
            for p in p.iter_mut() {
                *p *= factor;
            }
        }
        let last = self.interpolate_change(&i.p, &self.now.p_before, Parity::Even);
        let before = p.iter().zip(&last);
        carried.p_before = before
            .map(|(p, last)| if *p > 0.0 { (p - last).max(0.0) } else { 0.0 })
            .collect();
    }

    /// Adds the change of shear. Slipping cells get the shear mu p, `mu(n)` being the coefficient of a fine
    /// cell; sticking cells share what the sum of the shear lacks.
    fn shear(&self, carried: &mut State, mu: impl Fn(usize) -> f64, ratio: usize) {
        let (now, then) = (self.now, self.then);
        let (i, j) = (&now.interface, &then.interface);
        let slipping = self.interpolate_in_contact(|n| indicator(i.slips[n]), Parity::Even);
        let at_limit = self.interpolate_in_contact(|n| indicator(now.at_limit[n]), Parity::Even);
        let direction = [0, 1].map(|c| self.interpolate_in_contact(|n| i.q[c][n], HALVES[c]));
        let change = [0, 1].map(|c| self.interpolate_change(&i.q[c], &j.q[c], HALVES[c]));
        let last = [0, 1].map(|c| self.interpolate_change(&i.q[c], &now.q_before[c], HALVES[c]));
        let Interface { p, q, slips, .. } = &mut carried.interface;
        let sums = [0, 1].map(|c| {
            let [now, then] = [i, j].map(|of| total(&of.q[c]));
            total(&q[c]) + (ratio * ratio) as f64 * (now - then)
        });
        for n in (0..p.len()).filter(|&n| p[n] > 0.0) {
            if self.within[n] > 0.0 {
                slips[n] = slipping[n] > 0.5;
                carried.at_limit[n] = at_limit[n] > 0.5;
            }
            let along = [direction[0][n], direction[1][n]];
            let bound = mu(n) * p[n];
            let onto_bound = slips[n] && length(along) > 0.0 && bound.is_finite();
            for c in 0..2 {
                let q = &mut q[c][n];
                *q = if onto_bound {
                    bound * along[c] / length(along)
                } else {
                    *q + change[c][n]
                };
                carried.q_before[c][n] = *q - last[c][n];
            }
        }
        // The sum of the shear balances the loads: sticking cells share the difference.
        let sticking: Vec<usize> = (0..p.len()).filter(|&n| p[n] > 0.0 && !slips[n]).collect();
        for (q, sum) in q.iter_mut().zip(sums) {
            let share = (sum - total(q)) / sticking.len().max(1) as f64;
            for &n in &sticking {
                q[n] += share;
            }
        }
    }
}

/// Sum over the cells.
fn total(field: &[f64]) -> f64 {
    field.iter().sum()
}

/// Returns a function for the friction coefficient of the kept cells of a window, by the map of the scene.
fn mu(problem: &Problem, (nx, ny): (usize, usize)) -> impl Fn(usize) -> f64 {
    let friction = &problem.scene.friction;
    let grid = Grid {
        nx,
        ny,
        ..problem.scene.grid
    };
    let map = friction.map.as_ref();
    let map = map.map(|map| {
        problem
            .plan
            .mirror
            .fold(&grid.map(|x, y| map.interpolate(x, y)))
    });
    let mu = friction.mu;
    move |n| map.as_ref().map_or(mu, |map| mu * map[n])
}

/// 1 for true, 0 for false.
fn indicator(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

/// a - b, cell by cell.
fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Adds a change, cell by cell.
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

/// Weights of the four cells around a point, of which only the middle two count.
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

/// Cells and weights for the interpolation along one axis: to `to` fine cells, from `from` cells `ratio` times
/// as long around the same middle. With `mirrored`, both are the upper halves of a grid. Beyond the last coarse
/// cell its value counts.
fn axis_weights(
    (to, from): (usize, usize),
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
    /// Interpolates a field of the coarse grid to the cells of the fine one, along y and then along x; `half`
    /// is its parity under the mirror.
    fn interpolate(&self, field: &[f64], half: Parity) -> Vec<f64> {
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
