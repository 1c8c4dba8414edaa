//! The state of a run of wear between jumps.

use contact_core::zones::slip_cells;
use serde::{Deserialize, Serialize};

use super::events::Event;
use super::jump::Jump;
use super::loss::Worn;
use super::model::{Model, ModelState};
use super::peak::error_of_largest;
use super::settings::Wear;

/// The state on which the next jump depends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WearState {
    /// Jumps done.
    pub jumps: usize,
    /// Cycles done.
    pub cycles: f64,
    /// Cycles of the surfaces before the run.
    pub began: f64,
    /// Deepest depths \[m\] and volumes \[m^3\] of body 1 and body 2 before the run.
    pub lost_before: [[f64; 2]; 2],
    /// Energy dissipated by friction in all cycles \[J\].
    pub dissipated: f64,
    /// Events of the coatings.
    pub events: Vec<Event>,
    pub(crate) worn: Worn,
    pub(crate) model: ModelState,
    /// Jumps so far, and the cycles of the last stored block.
    pub(crate) history: Vec<Jump>,
    pub(crate) kept_at: f64,
    /// Length of the next jump in cycles.
    pub(crate) next: f64,
    /// Sum over all jumps of the corrections of the worn depth by extrapolation \[m\].
    pub(crate) corrections: [Vec<f64>; 2],
    /// Error of the deepest depth by the cells \[m\]: across a [spot](super::spots) in gross slip, and by cells
    /// of [mixed](super::mixed_cells) oxygen.
    #[serde(default)]
    pub(crate) spot_error: f64,
    pub(crate) ended: bool,
}

impl WearState {
    /// The state before the first jump, on surfaces worn so far.
    pub(super) fn new(worn: Worn, dissipated: f64, events: Vec<Event>, model: ModelState) -> Self {
        Self {
            jumps: 0,
            cycles: worn.cycles,
            began: worn.cycles,
            lost_before: [[0.0; 2]; 2],
            dissipated,
            events,
            corrections: worn.depth.each_ref().map(|d| vec![0.0; d.len()]),
            spot_error: 0.0,
            model,
            kept_at: worn.cycles,
            worn,
            history: Vec::new(),
            next: 0.0,
            ended: false,
        }
    }

    /// Cycles that remain.
    pub(super) fn remaining(&self, wear: &Wear) -> f64 {
        self.began + wear.cycles - self.cycles
    }

    /// Checks that the cycles have grown by a fifth, or by a fiftieth of all, since fields were
    /// stored.
    pub(super) fn has_grown(&self, wear: &Wear) -> bool {
        let [done, kept_at] = [self.cycles, self.kept_at].map(|cycles| cycles - self.began);
        done >= 1.2 * kept_at || done >= kept_at + wear.cycles / 50.0
    }

    /// The present values of a [`Jump`]; its errors, length and retries are zero.
    pub(super) fn to_jump(&self, model: &Model, wear: &Wear) -> Jump {
        let area = model.pressing().cell_area();
        let seen = model.output();
        let touches = seen.p.iter().filter(|p| **p > 0.0).count() as f64;
        let largest = |field: &[f64]| field.iter().fold(0.0, |m: f64, w| m.max(*w));
        let moved = self.corrections.iter().flatten();
        let moved = moved.fold(0.0, |m: f64, e| m.max(e.abs()));
        let volume = [0, 1].map(|b| self.worn.depth[b].iter().sum::<f64>() * area);
        let lost = volume[0] + volume[1];
        let [debris, ejected] = if wear.bed.is_some() {
            [
                self.worn.bed.iter().sum::<f64>() * area,
                self.worn.ejected * area,
            ]
        } else {
            [wear.debris_kept * lost, (1.0 - wear.debris_kept) * lost]
        };
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
            debris,
            ejected,
            aerated_share: mean_under_pressure(seen.aerated, seen.p),
            dissipated: self.dissipated,
            dissipated_per_cycle: seen.dissipated_per_cycle,
            mu: seen.mu,
            mu_error: seen.mu_error,
            p_max: largest(seen.p),
            contact_area: touches * area,
            stick_ratio: seen.stick_ratio,
            depth_error: self.over_deepest(moved),
            volume_error: 0.0,
            p_max_error: error_of_largest(
                seen.p,
                model.pressing().rows(),
                seen.stick_ratio > 0.0 && self.worn.deepest() > 0.0,
            ),
            // Late in life little slips; what has worn slipped when the zone was widest.
            slip_cells: self.history.iter().fold(
                slip_cells(&model.pressing().grid, touches * area, seen.stick_ratio),
                |widest, jump| widest.max(jump.slip_cells),
            ),
        }
    }

    /// An error of the depth over the deepest depth; zero where nothing has worn.
    pub(super) fn over_deepest(&self, error: f64) -> f64 {
        let deepest = self.worn.deepest();
        if deepest > 0.0 { error / deepest } else { 0.0 }
    }

    /// The part of its pressure that the slip zone has lost by wear: the part of the largest energy
    /// of a cycle that is no longer dissipated.
    pub(super) fn lost_by_slip(&self, now: &Jump) -> f64 {
        let cycles = self.history.iter().map(|jump| jump.dissipated_per_cycle);
        let largest = cycles.fold(now.dissipated_per_cycle, f64::max);
        if largest > 0.0 {
            1.0 - now.dissipated_per_cycle / largest
        } else {
            0.0
        }
    }
}

/// Mean of a share over the cells in contact; 1 without contact.
fn mean_under_pressure(share: &[f64], p: &[f64]) -> f64 {
    let touching = share.iter().zip(p).filter(|(_, p)| **p > 0.0);
    let (sum, count) = touching.fold((0.0, 0.0), |(sum, count), (s, _)| (sum + s, count + 1.0));
    if count > 0.0 { sum / count } else { 1.0 }
}
