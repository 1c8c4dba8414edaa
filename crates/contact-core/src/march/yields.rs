//! The bodies of a march that yield.

use crate::error::Error;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::yielding::{Yielded, Yielding};

/// Bodies that yield, and the gap without their offsets.
pub(super) struct Yields {
    pub(super) bodies: Yielding,
    /// Gap between the surfaces without offsets, on the kept cells of the whole grid \[m\].
    pub(super) bare: Vec<f64>,
    /// Most cells of the volume grid along a side before it grows.
    most: usize,
}

impl Yields {
    /// Builds the yielding bodies of a scene; none where no body yields.
    pub(super) fn from_scene(scene: &Scene, plan: &Plan) -> Result<Option<Self>, Error> {
        let volume_cells = plan.methods.volume_cells;
        let bodies = Yielding::on_cells(scene, volume_cells, false)?;
        Ok(bodies.map(|bodies| Self {
            bodies,
            most: volume_cells,
            bare: plan.mirror.fold(&scene.h_init()),
        }))
    }

    /// Rebuilds the bodies if the state is on another volume grid.
    pub(super) fn fit(&mut self, scene: &Scene, state: &Yielded) -> Result<(), Error> {
        if state.grown != self.bodies.volume().grown
            && let Some(bodies) = Yielding::on_cells(scene, self.most, state.grown)?
        {
            self.bodies = bodies;
        }
        Ok(())
    }

    /// The state before anything has yielded.
    pub(super) fn unyielded(&self) -> Yielded {
        self.bodies.unyielded()
    }
}
