//! The whole load path, and the results of each branch.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::{Increment, March, Motion, Reached, Spots, Work};
use crate::error::Error;
use crate::scene::{LoadPoint, Loads, RigidMotion, SaveFields, Scene};

/// Watches a run: progress, files, a stop from outside. The solution does not depend on it.
pub trait Observer {
    /// Called after each increment; an error ends the run and is returned by [`solve`].
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error>;

    /// Called once after the last increment, or after the failure that ended the run.
    fn on_end(&mut self, _march: &March, _failure: Option<&Error>) -> Result<(), Error> {
        Ok(())
    }

    /// A flag that ends the run as soon as it is raised, in the middle of an increment too.
    fn stop(&self) -> Option<Arc<AtomicBool>> {
        None
    }
}

/// The observer that does nothing.
impl Observer for () {
    fn on_increment(&mut self, _: &March, _: &Increment) -> Result<(), Error> {
        Ok(())
    }
}

/// Runs through the whole path and returns every increment.
pub fn solve(scene: &Scene, observer: &mut dyn Observer) -> Result<Vec<Increment>, Error> {
    March::until(scene, &observer.stop().unwrap_or_default())?.run(Vec::new(), observer)
}

impl March {
    /// Solves the rest of the path; returns the increments `before` and the new ones. Fails at the
    /// end if the contact has too few cells ([`Reached::check`]).
    pub fn run(
        mut self,
        mut before: Vec<Increment>,
        observer: &mut dyn Observer,
    ) -> Result<Vec<Increment>, Error> {
        if let Some(flag) = observer.stop() {
            self.stop_on(flag);
        }
        before.reserve(self.points().len().saturating_sub(before.len()));
        let outcome = (self.advance_to_end(&mut before, observer))
            .and_then(|()| Reached::from_increments(&before).check(self.scene()));
        let ended = observer.on_end(&self, outcome.as_ref().err());
        outcome.and(ended).map(|()| before)
    }

    /// Computes and appends the increments up to the end of the path, or to the first failure, and calls the
    /// observer after each.
    fn advance_to_end(
        &mut self,
        increments: &mut Vec<Increment>,
        observer: &mut dyn Observer,
    ) -> Result<(), Error> {
        while let Some(increment) = self.advance() {
            let increment = increment?;
            increments.push(increment);
            observer.on_increment(self, &increment)?;
        }
        Ok(())
    }
}

impl SaveFields {
    /// Whether the increment `index` (from 1), the `last` of the path or not, keeps its fields.
    pub fn keeps(&self, point: &LoadPoint, index: usize, last: bool) -> bool {
        match self {
            Self::Branches => point.ends_branch || last,
            Self::All => true,
            Self::Indices(indices) => indices.contains(&index) || last,
        }
    }
}

/// One branch of the load path in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchSummary {
    /// Branch, from 0.
    pub branch: usize,
    /// Increments done in it.
    pub increments: usize,
    /// Loads at its end.
    pub loads: Loads,
    /// Rigid-body motion at its end.
    pub motion: Motion,
    /// Spots of the contact at its end.
    pub spots: Spots,
    /// Radius of the circle of the contact's area at its end, of a line contact half its width \[m\].
    pub contact_radius: f64,
    /// Stick area over contact area at its end.
    pub stick_ratio: f64,
    /// Largest pressure at its end \[Pa\].
    pub p_max: f64,
    /// Largest shear traction |q| at its end \[Pa\].
    pub q_max: f64,
    /// Energy dissipated in it \[J\].
    pub dissipated: f64,
    /// Plastic work in it \[J\].
    pub plastic_work: f64,
    /// Volume that has yielded at its end \[m^3\].
    pub plastic_volume: f64,
    /// Largest equivalent plastic strain at its end.
    pub largest_plastic_strain: f64,
    /// Work done by the solvers in it.
    pub work: Work,
}

impl BranchSummary {
    /// Sizes of motions and of loads below which they are zero within the solver's tolerance, in the
    /// order of [`RigidMotion::ALL`].
    ///
    /// In the plane the slip of stick cells has the tolerance `tolerance` mu delta_z, and so have
    /// shifts under given loads; forces under given shifts have `tolerance` mu W. Tilts and their
    /// moments have `tolerance` delta_z and `tolerance` W over and times the arm. The arm of
    /// rotations and moments is the radius of the contact.
    pub fn insignificant_sizes(&self, scene: &Scene) -> ([f64; 6], [f64; 6]) {
        let (tolerance, a) = (scene.tolerance(), self.contact_radius);
        let parts = RigidMotion::ALL.map(|motion| match motion {
            RigidMotion::DeltaZ => 0.0,
            motion if motion.is_in_plane() => tolerance * scene.friction.mu.min(1.0),
            _ => tolerance,
        });
        let arms = RigidMotion::ALL.map(|motion| if motion.is_rotation() { a } else { 1.0 });
        let motion = |k: usize| {
            if arms[k] > 0.0 {
                parts[k] * self.motion.delta_z.abs() / arms[k]
            } else {
                f64::INFINITY
            }
        };
        let load = |k: usize| parts[k] * self.loads.W.abs() * arms[k];
        (std::array::from_fn(motion), std::array::from_fn(load))
    }

    /// For display: motions and loads in the plane that are zero within the solver's tolerance
    /// become 0 ([`Self::insignificant_sizes`]).
    #[must_use]
    pub fn without_insignificant_values(mut self, scene: &Scene) -> Self {
        let (least_motions, least_loads) = self.insignificant_sizes(scene);
        let (mut forces, given) = (self.loads.forces(), self.loads.given);
        let mut clear_insignificant = |of: RigidMotion, motion: &mut f64| {
            let k = of.index();
            let is_given = given.motions()[k].is_some();
            if !is_given && motion.abs() < least_motions[k] {
                *motion = 0.0;
            } else if is_given && forces[k].abs() < least_loads[k] {
                forces[k] = 0.0;
            }
        };
        clear_insignificant(RigidMotion::DeltaX, &mut self.motion.delta_x);
        clear_insignificant(RigidMotion::DeltaY, &mut self.motion.delta_y);
        clear_insignificant(RigidMotion::PhiZ, &mut self.motion.phi_z);
        self.loads = self.loads.with_forces(forces, given);
        self
    }
}

/// Summarises the increments: one summary per branch begun, with the numbers at its end and sums over it.
pub fn summarise(increments: &[Increment]) -> Vec<BranchSummary> {
    increments
        .chunk_by(|a, b| a.point.branch == b.point.branch)
        .filter_map(|of_branch| {
            let end = of_branch.last()?;
            Some(BranchSummary {
                branch: end.point.branch,
                increments: of_branch.len(),
                loads: end.point.loads,
                motion: end.motion,
                contact_radius: end.contact_radius,
                spots: end.spots,
                stick_ratio: end.stick_ratio(),
                p_max: end.p_max,
                q_max: end.q_max,
                dissipated: of_branch.iter().map(|i| i.energy.dissipated).sum(),
                plastic_work: of_branch.iter().map(|i| i.energy.plastic).sum(),
                plastic_volume: end.yielded.volume,
                largest_plastic_strain: end.yielded.largest,
                work: (of_branch.iter()).fold(Work::default(), |all, i| all + i.work),
            })
        })
        .collect()
}
