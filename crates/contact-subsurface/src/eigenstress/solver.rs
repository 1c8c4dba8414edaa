//! The plastic strain and residual stress of a body in the states of a run.

use std::sync::{Arc, Mutex, PoisonError};

use contact_core::Error;
use contact_core::scene::Scene;
use contact_core::yielding::{Yielded, Yielding};

use super::{Eigenstress, Field};
use crate::Side;
use crate::plastic_strain::PlasticStrain;

/// Computes the residual stresses of a body from the plastic states of a run.
#[derive(Debug)]
pub struct EigenstressSolver {
    scene: Scene,
    side: Side,
    /// Solvers on the volume grid before and after it has grown, each set up with the first state
    /// that needs it.
    yielding: Mutex<[Option<Yielding>; 2]>,
}

impl EigenstressSolver {
    /// Sets up a solver for a body of a scene.
    pub fn new(scene: &Scene, side: Side) -> Self {
        Self {
            scene: scene.clone(),
            side,
            yielding: Mutex::default(),
        }
    }

    /// Number of the body, 1 or 2.
    fn number(&self) -> usize {
        match self.side {
            Side::Body1 => 1,
            Side::Body2 => 2,
        }
    }

    /// Calls `work` with the bodies that yield, on the volume grid of a state; returns `None` if
    /// none may yield.
    ///
    /// # Errors
    /// The state has points beyond both grids.
    pub fn with_yielding<T>(
        &self,
        yielded: &Yielded,
        work: impl FnOnce(&mut Yielding) -> T,
    ) -> Result<Option<T>, Error> {
        let mut held = self.yielding.lock().unwrap_or_else(PoisonError::into_inner);
        for (held, grown) in held.iter_mut().zip([false, true]) {
            if held.is_none() {
                *held = Yielding::from_scene(&self.scene, grown)?;
            }
            let Some(bodies) = held else { return Ok(None) };
            if grown {
                bodies.check(yielded)?;
            } else if bodies.outgrown_by(yielded) {
                continue;
            }
            return Ok(Some(work(bodies)));
        }
        Ok(None)
    }

    /// The residual stress of a state; `None` if no point of the body has yielded.
    pub fn eigenstress(&self, yielded: Option<&Yielded>) -> Result<Option<Eigenstress>, Error> {
        let number = self.number();
        let has_yielded = |yielded: &&Yielded| {
            let mut states_of_body = yielded.bodies.iter().filter(|body| body.body == number);
            states_of_body.any(|body| !body.points.is_empty())
        };
        let Some(yielded) = yielded.filter(has_yielded) else {
            return Ok(None);
        };
        let plane_strain = self.scene.grid.plane_strain;
        let computed = self.with_yielding(yielded, |yielding| {
            let stress = yielding.stress_of_changes(yielded, None, number);
            let (Some(stress), Some(mesh)) = (stress, yielding.mesh(number)) else {
                return None;
            };
            let (cells, planes) = (mesh.cells, 0..mesh.planes());
            let (n, points) = ([cells.nx, cells.ny], yielding.points(yielded, number));
            Some(Field {
                n,
                strain: PlasticStrain::from_points(&points, n),
                d: [cells.dx, cells.dy],
                plane_strain,
                planes: planes.map(|n| (mesh.depth(n), mesh.layer(n))).collect(),
                stress: stress.into_iter().map(|s| s as f32).collect(),
            })
        })?;
        Ok(computed.flatten().map(|field| Eigenstress {
            field: Arc::new(field),
            origin: (0.0, 0.0),
        }))
    }
}
