//! The equations of an increment: on all cells, on the old contact alone, or with entering cells.

use crate::march::setup::{Equations, Setup};

/// Tolerances of increments in which cells enter, over the tolerances of others: on the old contact alone
/// (KEPT) and with the new cells (ENTERED). The residual slip of new cells that stick remains to
/// the end.
const KEPT_SHARE: f64 = 0.5;
const ENTERED_SHARE: f64 = 0.25;

/// The equations of all cells, as if none entered the contact in the increment.
pub(super) fn whole<'a>(setup: &'a Setup<'_>) -> Equations<'a> {
    Equations {
        h_init: &setup.geometry.h_init,
        share: 1.0,
        turns: true,
        entry: None,
    }
}

/// The equations of the old contact alone: all other cells are kept open by the gap `apart` \[m\].
pub(super) fn kept(apart: &[f64]) -> Equations<'_> {
    Equations {
        h_init: apart,
        share: KEPT_SHARE,
        turns: false,
        entry: None,
    }
}

/// The equations of all cells, where cells outside the last contact start with their motion before entry \[m\].
pub(super) fn entered<'a>(setup: &'a Setup<'_>, motion: &'a [Vec<f64>; 2]) -> Equations<'a> {
    Equations {
        h_init: &setup.geometry.h_init,
        share: ENTERED_SHARE,
        turns: true,
        entry: Some(motion),
    }
}
