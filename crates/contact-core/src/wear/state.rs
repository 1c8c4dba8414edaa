//! What a run of wear carries from jump to jump.

use serde::{Deserialize, Serialize};

use super::events::Event;
use super::jump::Jump;
use super::loss::Worn;
use super::model::{Model, ModelState};

/// All that the next jump depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WearState {
    /// Jumps done.
    pub jumps: usize,
    /// Cycles done.
    pub cycles: f64,
    /// Cycles that the surfaces had been through when the run began.
    pub began: f64,
    /// Deepest depths \[m\] and volumes \[m^3\] that body 1 and body 2 had lost then.
    pub lost_before: [[f64; 2]; 2],
    /// Energy dissipated by friction in them \[J\].
    pub dissipated: f64,
    /// What happened to the coatings.
    pub events: Vec<Event>,
    pub(crate) worn: Worn,
    pub(crate) model: ModelState,
    /// Jumps so far, and the cycles of the last block that is kept.
    pub(crate) history: Vec<Jump>,
    pub(crate) kept_at: f64,
    /// Length of the next jump in cycles.
    pub(crate) next: f64,
    /// What extrapolation has added to the worn depth of both bodies in all jumps \[m\].
    pub(crate) moved: [Vec<f64>; 2],
    pub(crate) ended: bool,
}

impl WearState {
    /// The last jump in numbers: what came of it, of what is lost a part `kept` being debris; how it came about is zero.
    pub(super) fn seen(&self, model: &Model, kept: f64) -> Jump {
        let area = model.pressing().cell_area();
        let seen = model.seen();
        let touches = seen.p.iter().filter(|p| **p > 0.0).count() as f64;
        let largest = |field: &[f64]| field.iter().fold(0.0, |m: f64, w| m.max(*w));
        let moved = self.moved.iter().flatten();
        let moved = moved.fold(0.0, |m: f64, e| m.max(e.abs()));
        let volume = [0, 1].map(|b| self.worn.depth[b].iter().sum::<f64>() * area);
        Jump {
            index: self.jumps,
            cycles: self.cycles,
            length: 0.0,
            error: 0.0,
            pressure_error: 0.0,
            retries: 0,
            volume,
            depth: [0, 1].map(|b| largest(&self.worn.depth[b])),
            volume_halfway: [0.0; 2],
            depth_halfway: [0.0; 2],
            debris: kept * (volume[0] + volume[1]),
            dissipated: self.dissipated,
            dissipated_per_cycle: seen.dissipated_per_cycle,
            p_max: largest(seen.p),
            contact_area: touches * area,
            stick_ratio: seen.stick_ratio,
            depth_error: moved / self.worn.deepest().max(f64::MIN_POSITIVE),
        }
    }
}
