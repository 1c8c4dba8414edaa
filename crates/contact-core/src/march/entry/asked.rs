//! What the solutions of an increment are asked for: on all cells, on the old cells alone, with new ones.

use crate::march::setup::{Asked, Setup};

/// Shares of the tolerance that increments in which cells enter are solved to, on the old cells alone
/// and with the new ones: where these stick their residual slip stays.
const KEPT_SHARE: f64 = 0.5;
const ENTERED_SHARE: f64 = 0.25;

/// All cells, none of which enters the contact.
pub(super) fn whole<'a>(setup: &'a Setup<'_>) -> Asked<'a> {
    Asked {
        h_init: &setup.geometry.h_init,
        share: 1.0,
        turns: true,
        entry: None,
    }
}

/// The old cells alone: the others are `apart` \[m\].
pub(super) fn kept(apart: &[f64]) -> Asked<'_> {
    Asked {
        h_init: apart,
        share: KEPT_SHARE,
        turns: false,
        entry: None,
    }
}

/// All cells, of which those outside the last contact enter it after a motion \[m\].
pub(super) fn entered<'a>(setup: &'a Setup<'_>, motion: &'a [Vec<f64>; 2]) -> Asked<'a> {
    Asked {
        h_init: &setup.geometry.h_init,
        share: ENTERED_SHARE,
        turns: true,
        entry: Some(motion),
    }
}
