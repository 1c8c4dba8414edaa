//! The equations of one increment, as the solvers are given them.

use super::slip_datum::{Before, Following};
use super::{Carried, March};
use crate::cells::Drive;
use crate::error::Error;
use crate::plan::Mirror;
use crate::scene::{LoadPoint, Preset, RigidMotion, Scene};
use crate::solvers::inner::{NormalParams, TangentialMethod, TangentialParams};
use crate::solvers::intermediate::{CoupledInfo, CoupledParams, IncrementProblem, coupled};
use crate::solvers::{Interface, Response};

/// The cells that may touch at the end of an increment.
#[derive(Clone, Copy)]
pub(super) enum Contact<'a> {
    /// All, wherever they come from.
    Free,
    /// Those of the last contact alone.
    Kept,
    /// All; those outside the last contact enter it after a motion \[m\].
    Entered {
        moved: &'a [Vec<f64>; 2],
        /// The solution on the cells of the last contact.
        kept: Option<&'a Interface>,
    },
}

impl March {
    /// Solves the increment from a start.
    pub(super) fn solve_pressed(
        &mut self,
        mut now: Interface,
        (normal, tangential): (Drive, Drive),
        contact: Contact<'_>,
    ) -> Result<(Interface, CoupledInfo), Error> {
        self.unless_stopped()?;
        let (entering, nearby) = match contact {
            Contact::Entered { moved, kept } => (Some(moved), kept),
            Contact::Free | Contact::Kept => (None, None),
        };
        let kept = matches!(contact, Contact::Kept);
        let apart;
        let h_init = if kept {
            let far =
                1e3 * (self.approach + self.window.h_init.iter().fold(0.0, |m, h| h.abs().max(m)));
            let p = &self.before().p;
            let cells = self.window.h_init.iter().zip(p);
            apart = cells
                .map(|(h, &p)| if p > 0.0 { *h } else { h + far })
                .collect();
            &apart
        } else {
            &self.window.h_init
        };
        // As March::before, for the sake of the workspace borrowed beside it.
        let carried = self.carried.as_ref();
        let before = carried.map_or(&self.state.interface, Carried::interface);
        let last = carried.is_none().then_some(&self.state.interface);
        let problem = IncrementProblem {
            h_init,
            mu: &self.mu,
            arms: &self.window.arms,
            normal,
            tangential,
            known: nearby.or(last),
        };
        let mut response = Response {
            op: &mut *self.window.op,
            inverse: self.window.inverse.as_mut(),
            stop: Some(&self.stop),
            exact: false,
        };
        let share = match contact {
            Contact::Free => 1.0,
            Contact::Kept => KEPT_SHARE,
            Contact::Entered { .. } => ENTERED_SHARE,
        };
        let params = params(&self.scene, self.approach, share);
        let solver = &self.scene.settings.solver;
        let ws = &mut self.workspace;
        let goes_on = self.datum.goes_on;
        let missed = carried.map_or(&self.state.missed, Carried::missed);
        self.datum.reset(before, missed, entering);
        let turns = !kept && goes_on && solver.turning && solver.preset == Preset::Fast;
        let mut datum = Following {
            datum: &mut self.datum,
            last: before,
            missed,
            before: turns.then(|| match carried {
                Some(carried) => carried.before(),
                None => Before {
                    p: &self.state.p_before,
                    q: &self.state.q_before,
                },
            }),
            arms: &self.window.arms,
            reach: self.scene.friction.scale() * self.approach,
        };
        match coupled(&mut response, &problem, &mut datum, &mut now, ws, &params) {
            Ok(info) => Ok((now, info)),
            Err(e) => {
                self.unless_stopped()?;
                Err(Error::NotConverged {
                    increment: self.state.increments + 1,
                    solver: e.solver,
                    residual: e.residual,
                    tolerance: e.tolerance,
                    iterations: e.iterations,
                })
            }
        }
    }

    /// What drives the motions across the plane, from the unloaded state, and those in it, in this
    /// increment. By symmetry the half of a mirrored scene has no motion that turns it.
    pub(super) fn drives(&self, point: &LoadPoint) -> (Drive, Drive) {
        let cell_area = self.scene.grid.cell_area() * self.plan.mirror.multiplicity();
        let (forces, given) = (point.loads.forces(), point.loads.given.motions());
        let before = self.state.motion.motions();
        let mirrored = self.plan.mirror != Mirror::None;
        let drive = |of: [usize; 3], from: [f64; 6]| {
            let mut drive = Drive::default();
            for (k, &load) in of.iter().enumerate() {
                let unit = self.unit(load);
                let odd = mirrored && RigidMotion::ALL[load].is_odd_in_y();
                match given[load] {
                    _ if odd => {}
                    Some(motion) => drive.given[k] = (motion - from[load]) * unit,
                    None => {
                        drive.free[k] = true;
                        drive.sums[k] = forces[load] / (cell_area * unit);
                    }
                }
            }
            drive
        };
        (drive([0, 1, 2], [0.0; 6]), drive([3, 4, 5], before))
    }

    /// What a motion of [`RigidMotion::ALL`] is multiplied by, and its load divided by,
    /// for the solvers.
    pub(super) fn unit(&self, k: usize) -> f64 {
        match RigidMotion::ALL[k] {
            of if of.is_rotation() => self.window.arms.length,
            RigidMotion::DeltaY => self.window.arms.stretch,
            _ => 1.0,
        }
    }
}

/// Share of the tolerance with which a predicted pressure is taken as it is: the shear moves it
/// further.
const PREDICTED_SHARE: f64 = 0.8;
/// Share of the tolerance that the normal solver iterates to.
const NORMAL_SHARE: f64 = 0.4;
/// Share of the tolerance that the tangential solver iterates to; nothing moves after it.
const TANGENTIAL_SHARE: f64 = 0.9;

/// Shares of the tolerance that increments in which cells enter are solved to, on the old cells alone
/// and with the new ones: where these stick they keep what is missed.
const KEPT_SHARE: f64 = 0.5;
const ENTERED_SHARE: f64 = 0.25;

/// The settings of the loops, with lengths in metres, for a share of the tolerance.
fn params(scene: &Scene, approach: f64, share: f64) -> CoupledParams {
    let solver = &scene.settings.solver;
    let gap = share * scene.tolerance() * approach;
    let plain = solver.preset == Preset::Spinu2020;
    CoupledParams {
        tolerance: gap,
        normal: NormalParams {
            enough: PREDICTED_SHARE * gap,
            tolerance: NORMAL_SHARE * gap,
            max_iterations: solver.max_iterations,
        },
        tangential: TangentialParams {
            method: if plain {
                TangentialMethod::Gradient
            } else {
                TangentialMethod::Newton
            },
            // What the shear misses acts on the gap, however large mu is.
            tolerance: TANGENTIAL_SHARE * scene.friction.scale().min(1.0) * gap,
            max_iterations: solver.max_iterations,
            forcing: 0.2,
            max_passes: 12,
        },
        max_alternations: solver.max_alternations,
    }
}
