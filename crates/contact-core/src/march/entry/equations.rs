//! The equations of an increment: on all cells, on the old contact alone, or with entering cells.

use crate::march::setup::{Equations, Setup};

/// Tolerances of increments in which cells enter, over the tolerances of others: on the old contact alone
/// (KEPT) and with the new cells (ENTERED). The residual slip of new cells that stick remains to
/// the end.
const KEPT_SHARE: f64 = 0.5;
const ENTERED_SHARE: f64 = 0.25;

/// All cells, none of which enters the contact.
pub(super) fn whole<'a>(setup: &'a Setup<'_>) -> Equations<'a> {
    Equations {
        h_init: &setup.geometry.h_init,
        share: 1.0,
        turns: true,
        entry: None,
    }
}

/// The old contact alone: the gap `apart` keeps all other cells open \[m\].
pub(super) fn kept(apart: &[f64]) -> Equations<'_> {
    Equations {
        h_init: apart,
        share: KEPT_SHARE,
        turns: false,
        entry: None,
    }
}

/// All cells; those outside the last contact with their motion before entry \[m\].
pub(super) fn entered<'a>(setup: &'a Setup<'_>, motion: &'a [Vec<f64>; 2]) -> Equations<'a> {
    Equations {
        h_init: &setup.geometry.h_init,
        share: ENTERED_SHARE,
        turns: true,
        entry: Some(motion),
    }
}
