//! Tables of the responses at depths below a layered surface, kept for the next use.
//!
//! Sections, points and planes below one contact ask for the same depths, and the answers to several questions
//! do. A recursion over the layers takes as long as there are layers, for one depth as for many:
//! tables of many depths are made together.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use super::depth_frf::DepthPoint;
use super::depth_kernel::Quantity;
use super::layered_frf::{HalfSpace, Stack};
use super::radial_table::{HankelSet, RadialTable, first_radius};
use crate::error::Error;

/// Largest error of the tabulated part over the response of the half-space.
const TOLERANCE: f64 = 1e-9;
/// Most depths whose tables are made together.
const TOGETHER: usize = 64;
/// Most memory of the tables that are kept \[bytes\].
const MOST_MEMORY: usize = 96 << 20;

/// The tabulated part of a response.
pub(super) struct Smooth<const N: usize> {
    pub(super) table: RadialTable<N>,
    /// Its smallest scale \[m\].
    pub(super) zeta: f64,
}

/// All data that a table depends on: digests of the stack, the quantity, bits of the depth and the
/// distance, and the layer.
type Key = ([u64; 2], TypeId, [u64; 2], usize);

#[derive(Default)]
struct Tables {
    /// Time of the last use, table and its memory, by key.
    kept: HashMap<Key, (u64, Arc<dyn Any + Send + Sync>, usize)>,
    bytes: usize,
    uses: u64,
}

static TABLES: LazyLock<Mutex<Tables>> = LazyLock::new(Mutex::default);
/// Tables made in this process.
static MADE: AtomicU64 = AtomicU64::new(0);

/// Returns the number of tables of depths that this process has made.
pub fn depth_tables_made() -> u64 {
    MADE.load(Ordering::Relaxed)
}

impl Tables {
    fn get<const N: usize>(&mut self, key: &Key) -> Option<Arc<Smooth<N>>> {
        self.uses += 1;
        let (used, table, _) = self.kept.get_mut(key)?;
        *used = self.uses;
        table.clone().downcast().ok()
    }

    /// Keeps a table; the tables that were not used for the longest time make room.
    fn insert<const N: usize>(&mut self, key: Key, smooth: Arc<Smooth<N>>) {
        let bytes = smooth.table.bytes();
        self.uses += 1;
        self.bytes += bytes;
        if let Some((.., replaced)) = self.kept.insert(key, (self.uses, smooth, bytes)) {
            self.bytes -= replaced;
        }
        if self.bytes > MOST_MEMORY {
            let mut by_use: Vec<_> = self.kept.iter().map(|(key, of)| (of.0, *key)).collect();
            by_use.sort_unstable_by_key(|(used, _)| *used);
            for (_, key) in by_use {
                if self.bytes <= MOST_MEMORY / 4 * 3 {
                    break;
                }
                self.bytes -= self.kept.remove(&key).map_or(0, |(.., bytes)| bytes);
            }
        }
    }
}

/// The smallest power of two above a distance: tables up to nearly equal distances are the same.
fn reach(r_max: f64) -> f64 {
    (r_max.log2().floor() + 1.0).exp2() * (1.0 - 1e-12)
}

/// The table of a place for distances up to `r_max` \[m\].
pub(super) fn table<Q: Quantity<N, R>, const N: usize, const R: usize>(
    stack: &Stack,
    place: DepthPoint,
    r_max: f64,
) -> Result<Arc<Smooth<N>>, Error> {
    let reach = reach(r_max);
    let key = key_of::<Q, N, R>(digest(stack), &place, reach);
    let kept = TABLES
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .get(&key);
    match kept {
        Some(kept) => Ok(kept),
        None => Ok(make::<Q, N, R>(stack, &[place], reach)?.swap_remove(0)),
    }
}

/// Makes the tables of places that are not kept.
pub(super) fn prepare<Q: Quantity<N, R>, const N: usize, const R: usize>(
    stack: &Stack,
    places: &[DepthPoint],
    r_max: f64,
) -> Result<(), Error> {
    let (reach, digest) = (reach(r_max), digest(stack));
    let missing: Vec<DepthPoint> = {
        let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        let is_missing = |place: &&DepthPoint| {
            let key = key_of::<Q, N, R>(digest, place, reach);
            tables.get::<N>(&key).is_none()
        };
        places.iter().filter(is_missing).copied().collect()
    };
    // Those with one end of the first panel share their nodes.
    let group = |place: &DepthPoint| {
        let zeta = smallest_scale(stack, place);
        (place.layer == 0, first_radius(zeta, reach).to_bits())
    };
    let mut missing = missing;
    missing.sort_by_key(|place| group(place));
    for same in missing.chunk_by(|a, b| group(a) == group(b)) {
        for some in same.chunks(TOGETHER) {
            make::<Q, N, R>(stack, some, reach)?;
        }
    }
    Ok(())
}

/// The smallest scale of the tabulated part at a place \[m\].
fn smallest_scale(stack: &Stack, place: &DepthPoint) -> f64 {
    match stack.layers.first() {
        Some((_, h)) if place.layer == 0 => 2.0 * h - place.z,
        _ => place.z,
    }
}

/// Makes and keeps the tables of places, all in the outermost layer or all below it, that share the
/// end of the first panel.
fn make<Q: Quantity<N, R>, const N: usize, const R: usize>(
    stack: &Stack,
    places: &[DepthPoint],
    reach: f64,
) -> Result<Vec<Arc<Smooth<N>>>, Error> {
    let outermost = places[0].layer == 0;
    let zetas: Vec<f64> = places
        .iter()
        .map(|place| smallest_scale(stack, place))
        .collect();
    let amplitudes = |k: f64, at: &mut [[f64; N]]| {
        stack.fields_at(k, places, outermost, |n, fields| {
            at[n] = Q::amplitudes(k, &fields)
        });
    };
    let hankel = HankelSet {
        amplitudes: &amplitudes,
        orders: Q::ORDERS,
        zetas: &zetas,
        k_low: stack.lowest_scale(),
    };
    let tables = hankel.tabulate(reach);
    let deviations = hankel.max_deviations(&tables.iter().collect::<Vec<_>>(), reach);
    for ((place, zeta), deviation) in places.iter().zip(&zetas).zip(deviations) {
        let estimate = deviation / Q::error_scale(stack, *zeta);
        if estimate.is_nan() || estimate > TOLERANCE {
            return Err(Error::StressInaccurate {
                z: place.z,
                estimate,
                tolerance: TOLERANCE,
            });
        }
    }
    MADE.fetch_add(places.len() as u64, Ordering::Relaxed);
    let digest = digest(stack);
    let mut kept = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    let keep = |((table, zeta), place): ((RadialTable<N>, f64), &DepthPoint)| {
        let smooth = Arc::new(Smooth { table, zeta });
        kept.insert(key_of::<Q, N, R>(digest, place, reach), smooth.clone());
        smooth
    };
    Ok(tables
        .into_iter()
        .zip(zetas)
        .zip(places)
        .map(keep)
        .collect())
}

fn key_of<Q: Quantity<N, R>, const N: usize, const R: usize>(
    digest: [u64; 2],
    place: &DepthPoint,
    reach: f64,
) -> Key {
    let bits = [place.z.to_bits(), reach.to_bits()];
    (digest, TypeId::of::<Q>(), bits, place.layer)
}

/// Two digests of a stack: another stack with both is as likely as a fault of the memory.
fn digest(stack: &Stack) -> [u64; 2] {
    let material = |m: &HalfSpace| [m.a, m.b, m.c, m.nu];
    let layers = stack.layers.iter().zip(&stack.bonds);
    let numbers = layers.flat_map(|((m, h), bond)| {
        let [a, b, c, nu] = material(m);
        [a, b, c, nu, *h, bond.shear, bond.normal]
    });
    let bits: Vec<u64> = numbers
        .chain(material(&stack.substrate))
        .map(f64::to_bits)
        .collect();
    [0_u64, 1].map(|seed| {
        let mut hasher = DefaultHasher::new();
        (seed, &bits).hash(&mut hasher);
        hasher.finish()
    })
}
