//! First yield and shakedown as a judge of layers.

use std::sync::atomic::AtomicBool;

use contact_core::Error;
use fatigue::{Yield, yielding};
use ndarray::ArrayView3;

use super::by_criterion::of_criteria;
use super::judged::Judge;

/// Load factors for the yield stress of every layer. The stress judged is that of the loads alone.
#[derive(Clone, Debug)]
pub struct ByYield {
    /// Yield stress of every layer from the surface down, the substrate's last \[Pa\]; none where
    /// it is not judged.
    pub s_y: Vec<Option<f64>>,
    /// Residual stress of every layer \[Pa\], which does not grow with the load.
    pub residual: Vec<f64>,
    /// The factor by which points are ranked.
    pub of: fn(&Yield) -> f64,
}

impl Judge for ByYield {
    type Found = Yield;

    fn judges(&self, layer: usize) -> bool {
        self.s_y.get(layer).is_some_and(Option::is_some)
    }

    fn judge(
        &self,
        layer: usize,
        stress: &ArrayView3<'_, f64>,
        stop: &AtomicBool,
    ) -> Result<Vec<Yield>, Error> {
        let Some(s_y) = self.s_y.get(layer).copied().flatten() else {
            return Ok(Vec::new());
        };
        let residual = self.residual.get(layer).copied().unwrap_or(0.0);
        let constant = [residual, residual, 0.0, 0.0, 0.0, 0.0];
        yielding(stress, s_y, &constant, stop).map_err(of_criteria)
    }

    fn score(&self, found: &Yield) -> f64 {
        1.0 / (self.of)(found)
    }
}
