//! The cells beyond the window: whether the surfaces overlap there.

use std::sync::PoisonError;

use super::{Domain, embed, shape_of};
use crate::cells::sums;
use crate::convolution::{Displacements, Tractions};
use crate::error::Error;
use crate::march::State;
use crate::march::problem::Problem;
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;

impl Domain {
    /// Lower bound of the gap beyond the window in this solution \[m\]; `None` if cells overlap there. While
    /// the bound of an earlier increment, less the largest closing since ([`Self::closes_beyond`]), is
    /// positive, it is used. Otherwise the gap is computed. Fails if the run is stopped.
    pub(in crate::march) fn clear_beyond(
        &self,
        problem: &Problem,
        state: &State,
        now: &Interface,
        info: &AlternationInfo,
    ) -> Result<Option<f64>, Error> {
        let Problem { scene, plan, .. } = problem;
        if self.window.geometry.grid == scene.grid {
            return Ok(Some(0.0));
        }
        let clearance = state.clear - self.closes_beyond(problem, state, now, info);
        if clearance > 0.0 {
            return Ok(Some(clearance));
        }
        let mirror = plan.mirror;
        let mut whole_grid = (self.whole.lock()).unwrap_or_else(PoisonError::into_inner);
        let grid = match &mut *whole_grid {
            Some(grid) => grid,
            none => none.insert(self.laid_out(problem, shape_of(&scene.grid), state.increments)?),
        };
        let (from, to) = (
            self.window.geometry.kept(mirror),
            grid.geometry.kept(mirror),
        );
        let wide = |f: &[f64]| embed::embedded(f, from, to, mirror, 0.0);
        let (p, q) = (wide(&now.p), [wide(&now.q[0]), wide(&now.q[1])]);
        let shear = plan.friction && plan.coupling;
        let mut u_z = vec![0.0; p.len()];
        grid.op.respond(
            Tractions {
                q_x: shear.then_some(&q[0]),
                q_y: shear.then_some(&q[1]),
                p: Some(&p),
            },
            Displacements {
                u_z: Some(&mut u_z),
                ..Displacements::default()
            },
        );
        let inside = embed::embedded(&vec![true; now.p.len()], from, to, mirror, false);
        let allowed = scene.tolerance() * problem.approach;
        let (h_init, arms) = (&grid.geometry.h_init, &grid.geometry.arms);
        let clear = (0..p.len())
            .filter(|&n| !inside[n])
            .map(|n| h_init[n] + u_z[n] - arms.displacement_across(info.approach, n) + allowed)
            .fold(f64::INFINITY, f64::min);
        Ok((clear >= 0.0).then_some(clear))
    }

    /// Upper bound of the closing of the gap beyond the window since the last increment \[m\], by
    /// Cauchy and Schwarz: a displacement changes by at most |kernel| |change of traction|, plus
    /// the rigid motion.
    fn closes_beyond(
        &self,
        problem: &Problem,
        state: &State,
        now: &Interface,
        info: &AlternationInfo,
    ) -> f64 {
        let (last, before) = (&state.interface, state.approach(&self.window.geometry.arms));
        let squares = sums((now.tractions(), last.tractions()), |_, (now, last)| {
            std::array::from_fn::<f64, 3, _>(|k| (now[k] - last[k]).powi(2))
        });
        let of_tractions: f64 = (self.kernels.norms.iter().zip(squares))
            .map(|(norm, squares)| norm * (problem.plan.mirror.multiplicity() * squares).sqrt())
            .sum();
        // The arms are at most 1.
        let rigid: f64 = (0..3).map(|k| (info.approach[k] - before[k]).abs()).sum();
        of_tractions + rigid
    }
}
