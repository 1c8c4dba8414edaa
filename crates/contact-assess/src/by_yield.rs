//! First yield and shakedown as a judge of layers.

use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::ResidualStress;
use fatigue::{History, Yield, yielding};
use ndarray::Axis;

use super::by_criterion::of_criteria;
use super::judged::Judge;

/// Load factors for the yield stress of every layer. The stress judged is that of the loads alone.
#[derive(Clone, Debug)]
pub struct ByYield {
    /// Yield stress of every layer from the surface down, the substrate's last \[Pa\]; none where
    /// it is not judged.
    pub s_y: Vec<Option<f64>>,
    /// Residual stress of the layers, which does not grow with the load.
    pub residual: ResidualStress,
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
        z: &[f64],
        history: &History<'_>,
        stop: &AtomicBool,
    ) -> Result<Vec<Yield>, Error> {
        let Some(s_y) = self.s_y.get(layer).copied().flatten() else {
            return Ok(Vec::new());
        };
        let residual = z.iter().map(|z| self.residual.stress_at(layer, *z));
        let residual: Vec<[f64; 2]> = residual.collect();
        // Points of one residual stress together, as those of a depth are.
        let mut found = Vec::with_capacity(residual.len());
        for same in residual.chunk_by(|a, b| a == b) {
            let [xx, yy] = same[0];
            let some = found.len()..found.len() + same.len();
            let here = history.stress.slice_axis(Axis(1), some.into());
            let constant = [xx, yy, 0.0, 0.0, 0.0, 0.0];
            found.extend(yielding(&here, s_y, &constant, stop).map_err(of_criteria)?);
        }
        Ok(found)
    }

    fn score(&self, found: &Yield) -> f64 {
        1.0 / (self.of)(found)
    }
}
