//! What scenes end with, for tests of what lies below.

use contact_core::march::{Fields, March};
use contact_core::scene::Scene;

/// The fields at the end of each branch.
pub(crate) fn solved(scene: &Scene) -> Vec<Fields> {
    let mut march = March::new(scene).unwrap();
    let mut ends = Vec::new();
    while let Some(increment) = march.advance() {
        if increment.unwrap().point.ends_branch {
            ends.push(march.fields());
        }
    }
    ends
}
