//! Coefficients already computed: a sweep over friction or load computes its kernels once.

use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use super::InfluenceCoefficients;
use crate::plan::KernelSet;
use crate::scene::{Body, Grid, KernelMethod, KernelSettings};

/// Most memory of the cache, in numbers: 128 MiB, or the six coefficients of a 1024 x 1024 grid and
/// more.
const CAPACITY: usize = 1 << 24;

/// All data that the coefficients depend on; real numbers by their bits.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    /// E, nu, thickness and bond of each layer, the substrate last.
    body: Vec<u64>,
    grid: [u64; 5],
    method: KernelMethod,
    tolerance: u64,
    set: KernelSet,
}

impl Key {
    /// The key of the coefficients of a body: layers (`bare`: only the substrate), grid, method, tolerance and
    /// the set of coefficients, bit by bit.
    pub(crate) fn new(
        body: &Body,
        grid: &Grid,
        settings: &KernelSettings,
        bare: bool,
        set: KernelSet,
    ) -> Self {
        Self {
            body: body
                .layers(bare)
                .into_iter()
                .flatten()
                .map(f64::to_bits)
                .collect(),
            grid: [
                grid.nx as u64,
                grid.ny as u64,
                grid.dx.to_bits(),
                grid.dy.to_bits(),
                u64::from(grid.plane_strain),
            ],
            method: settings.method,
            tolerance: settings.tolerance.to_bits(),
            set,
        }
    }
}

type Entries = Vec<(Key, Arc<InfluenceCoefficients>)>;

/// The entries, least recently used first.
static ENTRIES: LazyLock<Mutex<Entries>> = LazyLock::new(Mutex::default);

/// The coefficients cached under a key, if there are any.
pub(crate) fn get(key: &Key) -> Option<Arc<InfluenceCoefficients>> {
    let mut entries = ENTRIES.lock().unwrap_or_else(PoisonError::into_inner);
    let index = entries.iter().position(|(k, _)| k == key)?;
    let entry = entries.remove(index);
    let coefficients = Arc::clone(&entry.1);
    entries.push(entry);
    Some(coefficients)
}

/// Inserts coefficients, and removes the longest unused ones if there are too many.
pub(crate) fn insert(key: Key, coefficients: &Arc<InfluenceCoefficients>) {
    let size = |c: &InfluenceCoefficients| {
        let quadrants = [&c.xx, &c.yy, &c.zz, &c.xy, &c.xz, &c.yz];
        quadrants.iter().map(|q| q.len()).sum::<usize>()
    };
    if size(coefficients) > CAPACITY {
        return;
    }
    let mut entries = ENTRIES.lock().unwrap_or_else(PoisonError::into_inner);
    entries.retain(|(k, _)| *k != key);
    entries.push((key, Arc::clone(coefficients)));
    while entries.iter().map(|(_, c)| size(c)).sum::<usize>() > CAPACITY {
        entries.remove(0);
    }
}

/// Empties the caches of coefficients and of tables at depths of this process.
pub fn clear_cache() {
    super::depth_tables::clear();
    ENTRIES
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .clear();
}
