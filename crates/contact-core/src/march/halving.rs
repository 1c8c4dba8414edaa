//! Increments that do not converge are retried, from the last tractions as they are, then in halves.
//!
//! A guess that goes too far may lead astray: where it is left out the answer is the same. Half of the
//! way is an easier problem: the last state is nearer to the solution. It is also a finer path, so that
//! the answer differs from that of one piece as that of twice the increments would.
//! [`Work::parts`](super::Work::parts) says in how many pieces an increment was solved.

use super::{Energy, Increment, March, Residuals, Work};
use crate::error::Error;
use crate::scene::LoadPoint;

/// Halvings of an increment before the run gives up.
const HALVINGS: u32 = 5;

impl March {
    /// The increment to `point`, whole if that can be, or in pieces; after an error the state is as before.
    pub(super) fn reach(&mut self, point: &LoadPoint) -> Result<Increment, Error> {
        let transforms = self.transforms();
        let failure = match self.increment(point) {
            Err(failure @ Error::NotConverged { .. }) => failure,
            done => return done,
        };
        let before = self.state().clone();
        let mut ended = Err(failure);
        if self.extrapolates {
            self.extrapolates = false;
            ended = self.increment(point);
            self.extrapolates = true;
        }
        if let Err(failure @ Error::NotConverged { .. }) = ended {
            ended = self.in_halves(point, HALVINGS, failure);
        }
        let mut increment = match ended {
            Ok(increment) => increment,
            Err(failure) => {
                self.unwidened = None;
                self.put(before);
                return Err(failure);
            }
        };
        // What was tried in vain was work too.
        increment.work.convolutions = (self.transforms() - transforms) as f64 / 6.0;
        Ok(increment)
    }

    /// The increment to `point`, which ended in `failure`, in two halves, halved further if needed.
    fn in_halves(
        &mut self,
        point: &LoadPoint,
        halvings: u32,
        failure: Error,
    ) -> Result<Increment, Error> {
        if halvings == 0 {
            return Err(failure);
        }
        let piece = |march: &mut Self, point: &LoadPoint| match march.increment(point) {
            Err(failure @ Error::NotConverged { .. }) => {
                march.in_halves(point, halvings - 1, failure)
            }
            done => done,
        };
        let middle = point.middle(&self.state.loads, self.state.motion.motions());
        let first = piece(self, &middle)?;
        // Both halves are one increment of the path.
        self.state.increments -= 1;
        let second = piece(self, point)?;
        let mut whole = first.followed_by(&second);
        if self.state.work != 0.0 {
            whole.residuals.energy = whole.energy.imbalance() / self.state.work;
        }
        Ok(whole)
    }
}

impl Increment {
    /// Both as one: the state at the end of the second, energies and work of both, the worse
    /// residuals.
    fn followed_by(self, second: &Self) -> Self {
        let (e, f) = (self.energy, second.energy);
        let (r, s) = (self.residuals, second.residuals);
        let (w, v) = (self.work, second.work);
        Self {
            energy: Energy {
                work: e.work + f.work,
                elastic: e.elastic + f.elastic,
                dissipated: e.dissipated + f.dissipated,
                opening: e.opening + f.opening,
                quadrature: e.quadrature + f.quadrature,
            },
            residuals: Residuals {
                gap: r.gap.max(s.gap),
                penetration: r.penetration.max(s.penetration),
                coulomb: r.coulomb.max(s.coulomb),
                stick: r.stick.max(s.stick),
                direction: r.direction.max(s.direction),
                angle: r.angle.max(s.angle),
                balance: r.balance.max(s.balance),
                energy: s.energy,
            },
            work: Work {
                convolutions: w.convolutions + v.convolutions,
                alternations: w.alternations + v.alternations,
                normal_iterations: w.normal_iterations + v.normal_iterations,
                tangential_iterations: w.tangential_iterations + v.tangential_iterations,
                parts: w.parts + v.parts,
            },
            ..*second
        }
    }
}
