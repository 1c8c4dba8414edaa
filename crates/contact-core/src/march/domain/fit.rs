//! Width of the window: the contact, its expected growth, and a margin.

use std::sync::PoisonError;

use super::shape::{half_lengths, pays, shape_for, shape_of};
use super::{AROUND, Domain, embed};
use crate::error::Error;
use crate::march::State;
use crate::march::growing;
use crate::march::problem::Problem;
use crate::scene::LoadPoint;
use crate::solvers::Response;

/// Least cells between the contact and the border of the window.
const MARGIN: usize = 2;
/// Cells by which spots of uneven surfaces may lie beyond the spots of cells twice as large.
const UNEVEN: usize = 6;
/// Growth of the contact for which a window is widened in advance, at most.
const WINDOW_GROWTH: f64 = 1.08;

impl Domain {
    /// Moves the state into a window wide enough for the contact expected in the increment to `point`. Returns
    /// the state in the former window if the window has changed. Fails, without a change, if the run is
    /// stopped.
    pub(in crate::march) fn fit(
        &mut self,
        problem: &Problem,
        state: &mut State,
        point: &LoadPoint,
    ) -> Result<Option<State>, Error> {
        if state.window != self.shape() {
            let shape = state.window;
            self.move_into(problem, state, shape)?;
        }
        if self.shape() == shape_of(&problem.scene.grid) {
            return Ok(None);
        }
        let mirror = problem.plan.mirror;
        let touches = state.interface.p.iter().any(|&p| p > 0.0);
        let presses = point.loads.W > 0.0 || point.loads.given.delta_z.is_some();
        let [within, _] = growth(problem, state, point);
        if touches {
            self.first_pressure.clear();
        }
        let half = if touches {
            let (nx, ny) = self.shape();
            half_lengths(&state.interface.p, mirror.rows(ny), (nx, ny))
        } else if presses {
            let (nx, ny) = shape_of(&problem.scene.grid);
            let p = self
                .first_pressure
                .get_or_compute(problem, &self.kernels.pair.zz, point);
            let half = half_lengths(&mirror.fold(&p), mirror.rows(ny), (nx, ny));
            let enters = !growing::steps(problem, state, point).is_empty();
            let beyond = match (enters, problem.scene.is_uneven()) {
                (true, _) => AROUND,
                (false, true) => UNEVEN,
                (false, false) => 0,
            };
            half.map(|half| half + beyond)
        } else {
            return Ok(None);
        };
        let expected = half.map(|half| (half as f64 * within).round() as usize);
        if self.is_narrow(problem, state, point, expected) {
            return self.widen(problem, state, point, Some(expected));
        }
        if let Some(shape) = self.without_growth(problem, state, point, half) {
            let moved = self.move_into(problem, state, shape)?;
            // The known bound holds beyond the wider window only.
            state.clear = 0.0;
            return Ok(moved);
        }
        Ok(None)
    }

    /// The shape of a narrower window, once the contact no longer grows: W grew in the last increment, will not
    /// grow on the rest of the path, and no cell outside the narrower window has been in contact. None while
    /// one of these does not hold.
    fn without_growth(
        &self,
        problem: &Problem,
        state: &State,
        point: &LoadPoint,
        half: [usize; 2],
    ) -> Option<(usize, usize)> {
        let grown = state.step.W > 0.0 && growth(problem, state, point).iter().all(|g| *g <= 1.0);
        let (now, mirror) = (self.shape(), problem.plan.mirror);
        let shape = shape_for(&problem.scene.grid, half.map(|half| 2 * (half + MARGIN)));
        let shape = (shape.0.min(now.0), shape.1.min(now.1));
        if !grown || shape == now {
            return None;
        }
        let [from, to] = [shape, now].map(|(nx, ny)| (nx, mirror.rows(ny)));
        let kept = embed::embedded(&vec![true; from.0 * from.1], from, to, mirror, false);
        let untouched = |n: usize| {
            let indented = state.indented.get(n).is_some_and(|depth| *depth > 0.0);
            let fields = [&state.p_before, &state.dissipated, &state.slip_length];
            !indented && fields.iter().all(|field| field[n] == 0.0)
        };
        (0..kept.len())
            .all(|n| kept[n] || untouched(n))
            .then_some(shape)
    }

    /// Whether the window lacks the margin around a contact of these half-lengths \[cells\] in an
    /// increment to `point`.
    pub(in crate::march) fn is_narrow(
        &self,
        problem: &Problem,
        state: &State,
        point: &LoadPoint,
        half: [usize; 2],
    ) -> bool {
        let (now, whole) = (self.shape(), shape_of(&problem.scene.grid));
        let margin = margin(problem, state, point);
        let narrow = |half: usize, n: usize, whole: usize| n < whole && 2 * (half + margin) > n;
        narrow(half[0], now.0, whole.0) || narrow(half[1], now.1, whole.1)
    }

    /// Moves the state into a window wide enough for a contact of these half-lengths \[cells\] and
    /// its expected growth on the rest of the path; into the whole grid if none are given. Returns
    /// the state in the former window if that was another.
    pub(in crate::march) fn widen(
        &mut self,
        problem: &Problem,
        state: &mut State,
        point: &LoadPoint,
        half: Option<[usize; 2]>,
    ) -> Result<Option<State>, Error> {
        let whole = &problem.scene.grid;
        let Some(half) = half else {
            return self.move_into(problem, state, shape_of(whole));
        };
        let (now, margin) = (self.shape(), margin(problem, state, point));
        let [_, rest] = growth(problem, state, point);
        let cells =
            |half: usize| 2 * ((half as f64 * rest.min(WINDOW_GROWTH)).round() as usize + margin);
        let wider = [cells(half[0]).max(now.0), cells(half[1]).max(now.1)];
        let shape = shape_for(whole, wider);
        let shape = if pays(&problem.scene, shape) {
            shape
        } else {
            shape_of(whole)
        };
        self.move_into(problem, state, shape)
    }

    /// Builds a window of another shape and moves the state into it; without a change if the run is
    /// stopped. Returns the state in the former window if that was another.
    fn move_into(
        &mut self,
        problem: &Problem,
        state: &mut State,
        shape: (usize, usize),
    ) -> Result<Option<State>, Error> {
        if shape != self.shape() {
            let whole = (self.whole.get_mut()).unwrap_or_else(PoisonError::into_inner);
            let kept_window = whole.take_if(|whole| shape_of(&whole.geometry.grid) == shape);
            let new_window = match kept_window {
                Some(window) => window,
                None => self.laid_out(problem, shape, state.increments)?,
            };
            let last = std::mem::replace(&mut self.window, new_window);
            if last.geometry.grid == problem.scene.grid {
                *(self.whole.get_mut()).unwrap_or_else(PoisonError::into_inner) = Some(last);
            } else {
                self.replaced += last.op.work();
            }
        }
        Ok(self.embed(problem, state))
    }

    /// Moves a state into the present window and computes the displacements of its new cells. Returns the state
    /// in its former window if that was another.
    fn embed(&mut self, problem: &Problem, state: &mut State) -> Option<State> {
        if state.window == self.shape() {
            return None;
        }
        let (mirror, geometry) = (problem.plan.mirror, &self.window.geometry);
        let from = (state.window.0, mirror.rows(state.window.1));
        let to = geometry.kept(mirror);
        let old = embed::embedded(&vec![true; from.0 * from.1], from, to, mirror, false);
        let wider = embed::state(state, from, to, mirror);
        let narrow = std::mem::replace(state, wider);
        state.window = shape_of(&geometry.grid);
        if !old.contains(&false) {
            return Some(narrow);
        }
        let mut computed = state.interface.clone();
        let mut response = Response::plain(&mut *self.window.op);
        computed.evaluate(&mut response, problem.plan.friction);
        let now = &mut state.interface;
        let ([x, y], [new_x, new_y]) = (&mut now.u, computed.u);
        for (now, new) in [(x, new_x), (y, new_y), (&mut now.u_z, computed.u_z)] {
            for n in (0..old.len()).filter(|&n| !old[n]) {
                now[n] = new[n];
            }
        }
        Some(narrow)
    }
}

/// Cells between the contact and the border of the window; entering cells need their neighbours.
fn margin(problem: &Problem, state: &State, point: &LoadPoint) -> usize {
    let [within, _] = growth(problem, state, point);
    if within > 1.0 { AROUND } else { MARGIN }
}

/// Expected factors by which the radius grows in an increment to `point` and on the rest of the
/// path, after Hertz: a ~ W^(1/3), a ~ delta_z^(1/2).
fn growth(problem: &Problem, state: &State, point: &LoadPoint) -> [f64; 2] {
    let largest = problem.largest;
    let touches = state.loads.W > 0.0;
    let (steps, power) = match point.loads.given.delta_z {
        Some(now) if touches => ([state.motion.delta_z, now, largest.delta_z], 1.0 / 2.0),
        Some(now) => ([0.0, now, largest.delta_z], 1.0 / 2.0),
        None => ([state.loads.W, point.loads.W, largest.W], 1.0 / 3.0),
    };
    let grows = |from: f64, to: f64| {
        if from > 0.0 && to > from {
            (to / from).powf(power)
        } else {
            1.0
        }
    };
    [grows(steps[0], steps[1]), grows(steps[1], steps[2])]
}
