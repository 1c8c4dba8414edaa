//! Stage 1: WHAT is in contact.
//!
//! A [`Scene`] is plain data: two bodies, a friction law, a grid, a load path and the settings of
//! the solution. [`Scene::check`] refuses what has no meaning before anything is computed.

mod body;
mod case;
mod friction;
mod grid;
mod load_path;
mod material;
mod plan;
mod settings;
mod shape;

pub use body::{Body, Coating};
pub use friction::Friction;
pub use grid::Grid;
pub use load_path::{Branch, Given, LOADS, LoadPath, LoadPoint, Loads, MOTIONS, Spacing};
pub use material::Elastic;
pub use plan::{Plan, PlanLine};
pub use settings::{
    KernelMethod, KernelSettings, Preset, SaveFields, Settings, SkipSettings, SolverSettings,
};
pub use shape::Shape;

use crate::error::Error;
use crate::reference::{Hertz, hertz};

/// A fretting contact problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// One line that names the scene in results and figures.
    pub title: String,
    /// The upper body (the indenter in the paper).
    pub body1: Body,
    /// The lower body (the coated half-space in the paper).
    pub body2: Body,
    /// Friction law of the interface.
    pub friction: Friction,
    /// Mesh of the contact plane.
    pub grid: Grid,
    /// Load history.
    pub path: LoadPath,
    /// How the problem is solved and what is kept.
    pub settings: Settings,
}

impl Scene {
    /// Fails with the key, the value and what is allowed if the scene has no meaning.
    pub fn check(&self) -> Result<(), Error> {
        self.body1.check("body1")?;
        self.body2.check("body2")?;
        let unyielding = |body: &Body| body.substrate.is_rigid() && body.coatings.is_empty();
        if unyielding(&self.body1) && unyielding(&self.body2) {
            return Err(Error::invalid(
                "body2.E",
                "inf",
                "finite, since body 1 is rigid",
            ));
        }
        let curvature = self.body1.shape.curvature() + self.body2.shape.curvature();
        if curvature <= 0.0 {
            return Err(Error::invalid(
                "body1.shape",
                format!("{:?} on {:?}", self.body1.shape, self.body2.shape),
                "two surfaces that part away from the initial point of contact",
            ));
        }
        self.friction.check()?;
        self.grid.check()?;
        self.path.check(self.friction.mu)?;
        self.settings.check()
    }

    /// The Hertz contact of the uncoated pair at the largest normal load of the path, or at the
    /// largest approach that it gives: the yardstick `a_H`, `p_H` of every dimensionless result.
    /// `None` where a substrate pair is rigid or nothing presses the bodies together.
    pub fn hertz(&self) -> Option<Hertz> {
        let curvature = self.body1.shape.curvature() + self.body2.shape.curvature();
        let both_rigid = self.body1.substrate.is_rigid() && self.body2.substrate.is_rigid();
        if curvature <= 0.0 || both_rigid {
            return None;
        }
        let at = |W| {
            hertz(
                1.0 / curvature,
                self.body1.substrate,
                self.body2.substrate,
                W,
            )
        };
        // delta_z grows with W^(2/3).
        let delta_z = self.path.delta_z_max();
        let W = self.path.W_max().max((delta_z / at(1.0).delta_z).powf(1.5));
        (W > 0.0).then(|| at(W))
    }

    /// Gap between the undeformed surfaces, h_init \[m\], shape (nx, ny).
    pub fn h_init(&self) -> ndarray::Array2<f64> {
        self.grid
            .map(|x, y| self.body1.shape.fall(x, y) + self.body2.shape.fall(x, y))
    }
}
