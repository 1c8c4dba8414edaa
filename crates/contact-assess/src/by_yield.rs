//! First yield and shakedown applied to layers.

use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::ResidualStress;
use fatigue::{History, Yield, yielding};
use ndarray::Axis;

use super::by_criterion::from_fatigue;
use super::judged::Judge;

/// Load factors for the yield stress of every layer. The stress is caused by the loads alone.
#[derive(Clone, Debug)]
pub struct YieldJudge {
    /// Yield stress of every layer from the surface down, the substrate last \[Pa\]; `None` for a
    /// layer that is not judged.
    pub s_y: Vec<Option<f64>>,
    /// Residual stress of the layers, which does not grow with the load.
    pub residual: ResidualStress,
    /// The factor by which points are ranked.
    pub safety_factor: fn(&Yield) -> f64,
}

impl Judge for YieldJudge {
    type Judgement = Yield;

    /// Whether the layer has a yield stress.
    fn judges(&self, layer: usize) -> bool {
        self.s_y.get(layer).is_some_and(Option::is_some)
    }

    /// Load factors of yield and shakedown at points of a layer at the depths `z` \[m\], with the residual
    /// stress there.
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
        // Points with one residual stress together, for example the points at one depth.
        let mut factors = Vec::with_capacity(residual.len());
        for same in residual.chunk_by(|a, b| a == b) {
            let [xx, yy] = same[0];
            let some = factors.len()..factors.len() + same.len();
            let history_of_points = history.stress.slice_axis(Axis(1), some.into());
            let constant = [xx, yy, 0.0, 0.0, 0.0, 0.0];
            factors
                .extend(yielding(&history_of_points, s_y, &constant, stop).map_err(from_fatigue)?);
        }
        Ok(factors)
    }

    /// Utilisation: the inverse of the safety factor.
    fn score(&self, found: &Yield) -> f64 {
        1.0 / (self.safety_factor)(found)
    }
}
