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
}

impl Yields {
    /// Those of a scene; none where no body yields.
    pub(super) fn of(scene: &Scene, plan: &Plan) -> Result<Option<Self>, Error> {
        let bodies = Yielding::on_cells(scene, plan.methods.volume_cells)?;
        Ok(bodies.map(|bodies| Self {
            bodies,
            bare: plan.mirror.fold(&scene.h_init()),
        }))
    }

    /// The state before anything has yielded.
    pub(super) fn unyielded(&self) -> Yielded {
        self.bodies.unyielded()
    }
}
