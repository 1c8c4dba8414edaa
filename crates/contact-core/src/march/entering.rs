//! Cells that come into contact within an increment, because it grows or because it rolls on.
//!
//! Such a cell has moved freely before it stuck: its slip is reckoned from its entry, not from the
//! start of the increment. Solved with the contact kept to the old cells first, the increment tells
//! how far a new cell has moved by then ([`KeptContact`]); that is added to the displacement that
//! means no slip. A cell that leaves the contact needs nothing of the kind: its shear ends with its
//! pressure, and nothing remembers it.
//!
//! Bodies that have not touched move rigidly before they do: the gap h_init closes by delta_z, a
//! cell enters at theta = h_init/delta_z of the increment, and its motion is -theta d(delta), which
//! the solution has yet to tell.

use super::equations::Contact;
use super::kept_contact::KeptContact;
use super::neighbours::Neighbours;
use super::screened::Screened;
use super::view::REACH;
use super::{Interface, March};
use crate::cells::Drive;
use crate::error::Error;
use crate::scene::{LoadPoint, Preset};
use crate::solvers::intermediate::CoupledInfo;

/// Rounds that look for the shift of bodies that touch for the first time.
const ROUNDS: usize = 6;
/// Change of that shift that ends the search, over the shift.
const SETTLED: f64 = 1e-8;

/// A solution of an increment.
pub(super) type Solution = (Interface, CoupledInfo);

impl March {
    /// Solves the increment, its new cells with the motion before their entry.
    pub(super) fn solve_entering(
        &mut self,
        point: &LoadPoint,
        start: Interface,
    ) -> Result<Solution, Error> {
        let drives = self.drives(point);
        if !self.lets_cells_enter(&drives) {
            return self.solve_pressed(start, drives, Contact::Free);
        }
        if self.state.interface.p.iter().all(|&p| p <= 0.0) {
            return self.solve_first_contact(start, drives);
        }
        let kept = self.on_old_cells(&start, &drives.0);
        let (kept, info) = self.solve_pressed(kept, drives, Contact::Kept)?;
        let p = &self.before().p;
        let moved = self.kept_contact(&kept, &info).moved(|n| p[n] <= 0.0);
        // The new cells are all that is missing, unless the old ones alone were not to be had.
        let solved = !info.exceeds_friction() && kept.p.iter().any(|&p| p > 0.0);
        let start = if solved { kept.clone() } else { start };
        let entered = Contact::Entered {
            moved: &moved,
            kept: solved.then_some(&kept),
        };
        let (now, mut found) = self.solve_pressed(start, drives, entered)?;
        found.add_work(&info);
        Ok((now, found))
    }

    /// The first guess on the old cells alone: pressure as predicted, scaled to the load, shear as it was.
    fn on_old_cells(&self, start: &Interface, normal: &Drive) -> Interface {
        let mut kept = self.before().clone();
        let old = kept.p.iter().map(|&p| p > 0.0);
        let predicted: Vec<_> = old
            .zip(&start.p)
            .map(|(old, &p)| if old { p } else { 0.0 })
            .collect();
        if predicted.iter().any(|&p| p > 0.0) {
            kept.p = predicted;
        }
        if normal.free[0] {
            let factor = normal.sums[0] / kept.p.iter().sum::<f64>();
            kept.p.iter_mut().for_each(|p| *p *= factor);
        }
        kept
    }

    /// What an increment with the contact kept to its old cells has done.
    fn kept_contact(&self, kept: &Interface, info: &CoupledInfo) -> KeptContact {
        let (last, approach) = (self.before(), self.approach_before());
        let kernel = self.whole.normal_kernel();
        let cells = 0..self.window.h_init.len();
        let gap = |u_z: &[f64], approach: [f64; 3], n: usize| {
            u_z[n] + self.window.h_init[n] - self.window.arms.across(approach, n)
        };
        let before = |n: usize| (gap(&last.u_z, approach, n) - self.gap_rolled(n)).max(0.0);
        let motion = |c: usize| {
            let shift = |n: usize| self.window.arms.in_plane(info.shift, n)[c];
            let motion = |n: usize| kept.u[c][n] - last.u[c][n] - shift(n);
            cells.clone().map(motion).collect()
        };
        KeptContact {
            motion: [motion(0), motion(1)],
            gap: cells.clone().map(before).collect(),
            closing: cells
                .map(|n| before(n) - gap(&kept.u_z, info.approach, n))
                .collect(),
            cells: Neighbours::new(&self.window.grid, self.plan.mirror, REACH, kernel),
            screened: Screened::new(&self.window.grid, kernel),
        }
    }

    /// Solves for the first contact: the shift s before the entry of the cells is that of the
    /// solution. It depends on the s assumed almost linearly, so that two solutions tell the third.
    fn solve_first_contact(
        &mut self,
        start: Interface,
        drives: (Drive, Drive),
    ) -> Result<Solution, Error> {
        let mut assumed = [0.0; 3];
        let mut last: Option<([f64; 3], [f64; 3])> = None;
        let mut work = CoupledInfo::default();
        let lowest = self
            .window
            .h_init
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let mut closed = f64::INFINITY;
        let mut start = start;
        let mut round = 0;
        loop {
            round += 1;
            let moved = |c: usize| {
                let moved = |n: usize| {
                    let theta = ((self.window.h_init[n] - lowest) / closed).clamp(0.0, 1.0);
                    -theta * self.window.arms.in_plane(assumed, n)[c]
                };
                (0..self.window.h_init.len()).map(moved).collect()
            };
            let entered = Contact::Entered {
                moved: &[moved(0), moved(1)],
                kept: None,
            };
            let (now, mut info) = self.solve_pressed(start, drives, entered)?;
            info.add_work(&work);
            work = info;
            let misfit: [f64; 3] = std::array::from_fn(|k| info.shift[k] - assumed[k]);
            let settled = size(misfit) <= SETTLED * size(info.shift);
            if settled || round == ROUNDS || info.exceeds_friction() {
                return Ok((now, info));
            }
            // Secant: the misfit falls by the part that the last change of s made of it.
            let next = match last {
                Some((before, misfit_before)) => {
                    let ds: [f64; 3] = std::array::from_fn(|k| assumed[k] - before[k]);
                    let df: [f64; 3] = std::array::from_fn(|k| misfit[k] - misfit_before[k]);
                    let slope = dot(ds, df) / dot(ds, ds).max(f64::MIN_POSITIVE);
                    let factor = if slope < 0.0 { -1.0 / slope } else { 1.0 };
                    std::array::from_fn(|k| assumed[k] + factor * misfit[k])
                }
                None => info.shift,
            };
            last = Some((assumed, misfit));
            assumed = next;
            closed = info.approach[0] - lowest;
            start = now;
        }
    }

    /// Whether contact grows or rolls on in the increment and it matters how a cell moved before.
    fn lets_cells_enter(&self, (normal, tangential): &(Drive, Drive)) -> bool {
        let solver = &self.scene.settings.solver;
        let Interface { p, q, .. } = &self.state.interface;
        let grows = if normal.free[0] {
            normal.sums[0] > p.iter().sum::<f64>() * (1.0 + f64::EPSILON * p.len() as f64)
        } else {
            normal.given[0] > self.approach_before()[0]
        };
        let sheared = self.plan.coupling
            || tangential
                .sums
                .iter()
                .chain(&tangential.given)
                .any(|&t| t != 0.0)
            || q.iter().flatten().any(|&q| q != 0.0);
        let enters = grows || self.rolls_on();
        solver.entering && solver.preset == Preset::Fast && self.plan.friction && enters && sheared
    }

    /// Approach and tilts of the last increment, as lengths \[m\].
    pub(super) fn approach_before(&self) -> [f64; 3] {
        let motions = self.state.motion.motions();
        [0, 1, 2].map(|k| motions[k] * self.unit(k))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn size(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
