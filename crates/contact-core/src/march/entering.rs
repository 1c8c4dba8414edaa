//! Cells that come into contact within an increment.
//!
//! Such a cell has moved freely before it stuck: its slip is reckoned from its entry, not from the
//! start of the increment. With the contact kept to the old cells, in p and in q, a new cell closes
//! its gap beyond zero and shows its free motion relative to the rigid shift. It entered at
//!
//! ```text
//! theta = gap_0/(gap_0 - gap_kept)
//! ```
//!
//! of the increment, and theta times that motion is added to the displacement that means no slip.
//! With gap and tangential motion alike (proportional loads on similar bodies of nu = 0) this is
//! exact: q = k p without slip in increments of any size.
//!
//! Bodies that have not touched move rigidly before they do: gap_0 is h_init, gap_kept is
//! h_init - delta_z, and the motion is -d(delta), which the solution has yet to tell.

use super::{Interface, March};
use crate::error::Error;
use crate::scene::{LoadPoint, Preset};
use crate::solvers::{CoupledInfo, Drive, set_pairs};

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
            return self.solve_pressed(start, drives, false);
        }
        if self.state.interface.p.iter().all(|&p| p <= 0.0) {
            return self.solve_first_contact(start, drives);
        }
        let mut kept = self.before().clone();
        if drives.0.free[0] {
            let factor = drives.0.sums[0] / kept.p.iter().sum::<f64>();
            kept.p.iter_mut().for_each(|p| *p *= factor);
        }
        let (kept, info) = self.solve_pressed(kept, drives, true)?;
        self.move_before_entry(|march, n| {
            let last = march.before();
            let h = march.h_init[n];
            let gap_0 = (last.u_z[n] + h - march.arms.across(march.approach_before(), n)).max(0.0);
            let gap_kept = kept.u_z[n] + h - march.arms.across(info.approach, n);
            let theta = (gap_0 / (gap_0 - gap_kept).max(f64::MIN_POSITIVE)).min(1.0);
            let shift = march.arms.in_plane(info.shift, n);
            [0, 1].map(|c| theta * (kept.u[c][n] - last.u[c][n] - shift[c]))
        });
        let (now, mut found) = self.solve_pressed(start, drives, false)?;
        found.add_work(&info);
        Ok((now, found))
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
        let lowest = self.h_init.iter().copied().fold(f64::INFINITY, f64::min);
        let mut start = start;
        let mut round = 0;
        loop {
            round += 1;
            let (now, mut info) = self.solve_pressed(start, drives, false)?;
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
            let closed = info.approach[0] - lowest;
            self.move_before_entry(|march, n| {
                let theta = ((march.h_init[n] - lowest) / closed).clamp(0.0, 1.0);
                march.arms.in_plane(assumed, n).map(|s| -theta * s)
            });
            start = now;
        }
    }

    /// Whether contact grows in the increment and it matters how a cell moved before.
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
        solver.entering && solver.preset == Preset::Fast && self.plan.friction && grows && sheared
    }

    /// Adds what a cell outside the contact moves before its entry to the displacement that means
    /// no slip.
    fn move_before_entry(&mut self, moved: impl Fn(&Self, usize) -> [f64; 2] + Sync) {
        let outside = |n: usize| self.state.interface.p[n] <= 0.0;
        let mut entered = [vec![0.0; self.h_init.len()], vec![0.0; self.h_init.len()]];
        let [x, y] = &mut entered;
        set_pairs(
            [x, y],
            |n, _| {
                if outside(n) { moved(self, n) } else { [0.0; 2] }
            },
        );
        self.set_entered(entered);
    }

    /// Approach and tilts of the last increment, as lengths \[m\].
    fn approach_before(&self) -> [f64; 3] {
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
