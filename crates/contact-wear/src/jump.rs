//! One jump in numbers.

use serde::{Deserialize, Serialize};

/// One jump in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Jump {
    /// Jump, from 1.
    pub index: usize,
    /// Cycles at its end.
    pub cycles: f64,
    /// Length of the jump in cycles.
    pub length: f64,
    /// Estimated error of the depth worn in the jump, relative to the depth so far (root mean
    /// squares); zero for explicit jumps, which have no estimate.
    pub error: f64,
    /// Estimated relative error of the pressure.
    pub pressure_error: f64,
    /// Number of repetitions of the jump.
    pub retries: usize,
    /// Volume that body 1 and body 2 have lost so far \[m^3\].
    pub volume: [f64; 2],
    /// Deepest worn depth of body 1 and body 2 \[m\].
    pub depth: [f64; 2],
    /// Volume that had been lost half of the jump earlier \[m^3\].
    pub volume_halfway: [f64; 2],
    /// Deepest depth half of the jump earlier \[m\].
    pub depth_halfway: [f64; 2],
    /// Volume that stays in the contact as debris \[m^3\].
    pub debris: f64,
    /// Volume of the debris that has left the contact \[m^3\].
    pub ejected: f64,
    /// Share of the area of the contact that oxygen reaches; 1 without a model of the air.
    pub aerated_share: f64,
    /// Energy dissipated so far \[J\].
    pub dissipated: f64,
    /// Energy dissipated in one cycle on the surfaces at the end \[J\].
    pub dissipated_per_cycle: f64,
    /// Mean coefficient of friction in the jump: the energy dissipated over the integral of the
    /// pressure over the slip.
    #[serde(default)]
    pub mu: f64,
    /// Estimated error of the mean coefficient of friction over it: by the jump, and by the borders of bare
    /// layers within their cells.
    #[serde(default)]
    pub mu_error: f64,
    /// Largest pressure at the end \[Pa\].
    pub p_max: f64,
    /// Area of the contact at the end \[m^2\].
    pub contact_area: f64,
    /// Ratio of the area that sticks all through the cycle and the area of the contact.
    pub stick_ratio: f64,
    /// Estimated error of the deepest depth so far, over it: by the jumps, by the place of the border
    /// of the stick zone, and by the cells across the slip zone or, in gross slip, across a spot.
    pub depth_error: f64,
    /// Estimated error of the volume so far, over it, with the same parts.
    #[serde(default)]
    pub volume_error: f64,
    /// Cells across the zone that slips, at the end of the jump at which it was widest so far.
    #[serde(default)]
    pub slip_cells: f64,
    /// Estimated error of the largest pressure over it; infinite in partial slip on worn surfaces, whose
    /// pressure is singular at the border of the stick zone.
    #[serde(default)]
    pub p_max_error: f64,
}
