//! Largest values of a run, and warnings that follow from them.

use super::{Increment, shear_errors};
use crate::error::Error;
use crate::scene::{LARGE_STRAIN, PathGrid, Scene};

/// Upper bound of the hardness of metals and most ceramics over Young's modulus.
const HARD: f64 = 0.05;
/// Equivalent plastic strain beyond which strains are not small.
const LARGE_PLASTIC_STRAIN: f64 = 0.06;
/// A warning names the error of the increments if it exceeds the tolerance of the path by this
/// factor.
const NOTABLE_RATIO: f64 = 2.0;
/// Least Young's modulus of a solid that yields, other than rubber \[Pa\].
const YIELDS: f64 = 1e9;

/// Largest values over the increments of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reached {
    /// Cells across the radius of the contact.
    pub cells_per_radius: f64,
    /// Pressure \[Pa\].
    pub p_max: f64,
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// The increments that ended branches.
    pub ends: Vec<Increment>,
}

impl Reached {
    /// The largest values of these increments.
    pub fn of(increments: &[Increment]) -> Self {
        let mut reached = Self::default();
        for of in increments {
            reached.see(of);
        }
        reached
    }

    /// Takes another increment into account.
    pub fn see(&mut self, increment: &Increment) {
        self.cells_per_radius = self.cells_per_radius.max(increment.cells_per_radius);
        self.p_max = self.p_max.max(increment.p_max);
        self.plastic_strain = self.plastic_strain.max(increment.yielded.largest);
        if increment.point.ends_branch {
            self.ends.push(*increment);
        }
    }

    /// Fails if the contact has fewer than [`FEWEST_CELLS`](crate::scene::FEWEST_CELLS) across its
    /// radius where it is largest, on the grid or on the path grid.
    pub fn check(&self, scene: &Scene) -> Result<(), Error> {
        if self.cells_per_radius > 0.0 {
            return scene.check_cells(self.cells_per_radius, 1.0);
        }
        Ok(())
    }

    /// The estimated error of the shear at the end of every branch whose increments were chosen
    /// ([`shear_errors`]).
    pub fn shear_errors(&self, scene: &Scene) -> Vec<Option<f64>> {
        let branches = scene.path.branches.iter();
        let errors = branches.zip(shear_errors(scene, &self.ends));
        let estimated = errors.map(|(branch, error)| branch.path_error.map(|_| error));
        estimated.collect()
    }

    /// Warnings that need the results of a run, beyond those of [`Scene::doubts`]; one sentence
    /// each.
    pub fn doubts(&self, scene: &Scene) -> Vec<String> {
        let mut doubts = Vec::new();
        if self.cells_per_radius > 0.0 {
            doubts.extend(scene.doubts_of(self.cells_per_radius, 1.0));
        }
        let allowed = scene.settings.solver.path_tolerance;
        let errors = shear_errors(scene, &self.ends).into_iter().enumerate();
        if let Some((k, error)) = errors.max_by(|a, b| a.1.total_cmp(&b.1))
            && error > NOTABLE_RATIO * allowed
        {
            let with = match scene.settings.solver.path_grid {
                PathGrid::Cells(cells) => {
                    format!(
                        "with more increments, and with more cells than solver.path_grid = {cells}"
                    )
                }
                _ => "with more increments".into(),
            };
            let count = match scene.path.branches[k].count() {
                1 => "one increment".into(),
                count => format!("{count} increments"),
            };
            doubts.push(format!(
                "branch {} of the path, in {count}, leaves the shear {:.1} % off, the path tolerance is {:.1} %: it falls {with}",
                k + 1,
                100.0 * error,
                100.0 * allowed
            ));
        }
        if self.plastic_strain > LARGE_PLASTIC_STRAIN {
            doubts.push(format!(
                "the plastic strain comes to {:.0} %: the equations are those of small strains, below {:.0} %",
                100.0 * self.plastic_strain,
                100.0 * LARGE_PLASTIC_STRAIN
            ));
        }
        let bodies = [&scene.body1, &scene.body2];
        let softest = bodies.map(|body| body.outermost().E);
        let softest = softest[0].min(softest[1]);
        let p = self.p_max;
        if softest >= YIELDS && softest.is_finite() && p > HARD * softest {
            doubts.push(format!(
                "the pressure comes to {:.1} GPa, {:.2} of Young's modulus at the surface: more than metals and most ceramics \
                 bear (hardness over E is 0.01 to 0.05); the solution is elastic",
                1e-9 * p,
                p / softest
            ));
        } else if let Some(hertz) = scene.hertz()
            && p > LARGE_STRAIN * hertz.E_star
        {
            doubts.push(format!(
                "the pressure comes to {p:.3e} Pa, {:.2} E*: strains are not small",
                p / hertz.E_star
            ));
        }
        doubts
    }
}
