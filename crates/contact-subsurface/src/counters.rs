//! Counters of the stresses that a process has computed: the work of an answer, on any machine.

use std::sync::atomic::{AtomicU64, Ordering};

/// Points times states by transforms on lines and planes, and by summation at single points.
static ON_GRIDS: AtomicU64 = AtomicU64::new(0);
static AT_POINTS: AtomicU64 = AtomicU64::new(0);

/// Counts the stress of some states at some places on lines or planes.
pub(super) fn count_on_grids(places: usize, states: usize) {
    ON_GRIDS.fetch_add((places * states) as u64, Ordering::Relaxed);
}

/// Counts the stress of some states at some single points.
pub(super) fn count_at_points(points: usize, states: usize) {
    AT_POINTS.fetch_add((points * states) as u64, Ordering::Relaxed);
}

/// Returns how many stresses this process has computed on lines and planes, and at single points; each point
/// counts once for each state.
pub fn stresses_computed() -> [u64; 2] {
    [&ON_GRIDS, &AT_POINTS].map(|count| count.load(Ordering::Relaxed))
}
