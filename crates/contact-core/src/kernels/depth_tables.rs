//! Tables of the responses at depths below a layered surface, kept for the next use.
//!
//! Sections, points and planes below one contact need the same depths, and so do several questions.
//! A recursion over the layers takes a time in proportion to their number, for one depth as for many.
//! So the tables of many depths are made together: their time grows linearly with the layers.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use super::depth_frf::DepthPoint;
use super::layered_frf::{HalfSpace, Stack};
use super::quantity::Quantity;
use super::radial_table::{HankelSet, RadialTable, first_radius};
use crate::error::Error;

/// Largest error of the tabulated part over the response of the half-space.
const TOLERANCE: f64 = 1e-9;
/// Most depths whose tables are made together.
const TOGETHER: usize = 256;
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

/// Forgets all tables.
pub(super) fn clear() {
    *TABLES.lock().unwrap_or_else(PoisonError::into_inner) = Tables::default();
}

impl Tables {
    /// The table of a key, marked as used; none if it is not kept.
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
            let mut by_use: Vec<_> = self
                .kept
                .iter()
                .map(|(key, entry)| (entry.0, *key))
                .collect();
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

/// The smallest power of two above a distance. Tables are made up to it, so that nearly equal distances share
/// one.
fn reach(r_max: f64) -> f64 {
    (r_max.log2().floor() + 1.0).exp2() * (1.0 - 1e-12)
}

/// The table of radial functions for a depth, for distances up to `r_max` \[m\], from the cache or computed.
pub(super) fn table<Q: Quantity<N, R>, const N: usize, const R: usize>(
    stack: &Stack,
    place: DepthPoint,
    r_max: f64,
) -> Result<Arc<Smooth<N>>, Error> {
    let reach = reach(r_max);
    let key = table_key::<Q, N, R>(digest(stack), &place, reach);
    let kept = TABLES
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .get(&key);
    match kept {
        Some(kept) => Ok(kept),
        None => Ok(make::<Q, N, R>(stack, &[place], reach)?.swap_remove(0)),
    }
}

/// Makes the tables of places that are not kept. Returns the number of sets of places whose tables were
/// made together.
pub(super) fn prepare<Q: Quantity<N, R>, const N: usize, const R: usize>(
    stack: &Stack,
    places: &[DepthPoint],
    r_max: f64,
) -> Result<usize, Error> {
    let (reach, digest) = (reach(r_max), digest(stack));
    let mut missing: Vec<DepthPoint> = {
        let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        let is_missing = |place: &&DepthPoint| {
            let key = table_key::<Q, N, R>(digest, place, reach);
            tables.get::<N>(&key).is_none()
        };
        places.iter().filter(is_missing).copied().collect()
    };
    // Places with one end of the first panel share their nodes.
    let group = |place: &DepthPoint| {
        let zeta = smallest_scale(stack, place);
        (place.layer == 0, first_radius(zeta, reach).to_bits())
    };
    missing.sort_by_key(|place| group(place));
    let mut sets = 0;
    for group in missing.chunk_by(|a, b| group(a) == group(b)) {
        for places in group.chunks(TOGETHER) {
            make::<Q, N, R>(stack, places, reach)?;
            sets += 1;
        }
    }
    Ok(sets)
}

/// The smallest scale of the tabulated part at a place \[m\].
fn smallest_scale(stack: &Stack, place: &DepthPoint) -> f64 {
    match stack.layers.first() {
        Some((_, h)) if place.layer == 0 => 2.0 * h - place.z,
        _ => place.z,
    }
}

/// Computes and keeps the tables of some places. All lie in the outermost layer or all below it, and their
/// first panels end at the same radius.
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
    let amplitudes = |k: f64, amplitudes: &mut [[f64; N]]| {
        stack.fields_of_places(k, places, outermost, |n, fields| {
            amplitudes[n] = Q::amplitudes(k, &fields);
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
        kept.insert(table_key::<Q, N, R>(digest, place, reach), smooth.clone());
        smooth
    };
    Ok(tables
        .into_iter()
        .zip(zetas)
        .zip(places)
        .map(keep)
        .collect())
}

/// The key of a table: stack, quantity, depth and range, and layer.
fn table_key<Q: Quantity<N, R>, const N: usize, const R: usize>(
    digest: [u64; 2],
    place: &DepthPoint,
    reach: f64,
) -> Key {
    let bits = [place.z.to_bits(), reach.to_bits()];
    (digest, TypeId::of::<Q>(), bits, place.layer)
}

/// Two independent digests of the layers of a stack. That two different stacks share both is as unlikely as a
/// fault of the memory.
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

#[cfg(test)]
mod tests {
    use super::super::radial_table::Hankel;
    use super::super::stress::Stress;
    use super::*;
    use crate::scene::{Body, Coating, Elastic, Shape};

    /// Layers of two materials in turn, and the borders and the middle of each.
    fn stack_and_places(layers: usize) -> (Stack, Vec<DepthPoint>) {
        let materials =
            [(250e9, 0.25, 1e-8), (450e9, 0.2, 2e-8)].map(|(E, nu, thickness)| Coating {
                material: Elastic { E, nu },
                thickness,
            });
        let coatings = (0..layers).map(|n| materials[n % 2]);
        let substrate = Elastic { E: 207e9, nu: 0.3 };
        let body = Body::coated(substrate, coatings, Shape::Flat);
        let stack = Stack::new(&body);
        let mut top = 0.0;
        let mut places = Vec::new();
        for n in 0..layers {
            let h = stack.layers[n].1;
            for z in [top, top + 0.5 * h, top + h] {
                places.extend(stack.locate_depth(z, Some(n)));
            }
            top += h;
        }
        places.extend([1.0, 5.0, 30.0].map(|of| {
            let below = stack.locate_depth(of * top, Some(layers));
            below.expect("a depth in the substrate")
        }));
        (stack, places)
    }

    /// The table of a depth made alone, with all radial functions over their r^m.
    fn made_alone(stack: &Stack, place: DepthPoint, r_max: f64) -> RadialTable<10> {
        let outermost = place.layer == 0;
        let hankel = Hankel {
            amplitude: &|k| Stress::amplitudes(k, &stack.fields(k, &place, outermost)),
            orders: Stress::ORDERS,
            zeta: smallest_scale(stack, &place),
            k_low: stack.lowest_scale(),
        };
        hankel.tabulate(reach(r_max))
    }

    #[test]
    fn tables_made_together_are_the_tables_of_single_depths() {
        let (stack, places) = stack_and_places(13);
        let r_max = 3e-5;
        prepare::<Stress, 10, 6>(&stack, &places, r_max).expect("tables");
        let made = depth_tables_made();
        assert!(made >= places.len() as u64);
        for place in places {
            let together = table::<Stress, 10, 6>(&stack, place, r_max).expect("a table");
            let alone = made_alone(&stack, place, r_max);
            for r in [0.0, 1e-9, 3e-8, 1e-6, 2.9e-5] {
                let (together, alone) = (together.table.evaluate(r * r), alone.evaluate(r * r));
                let scale = alone.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                for (a, b) in together.iter().zip(alone) {
                    assert!((a - b).abs() < 1e-13 * scale, "{place:?}, r = {r}: {a} {b}");
                }
            }
        }
    }

    /// A set needs one recursion over the layers for each wave number. So the time grows linearly with
    /// the layers if the number of sets does not grow with it.
    #[test]
    fn more_layers_do_not_need_more_recursions() {
        let sets = |layers| {
            let (stack, places) = stack_and_places(layers);
            prepare::<Stress, 10, 6>(&stack, &places, 1e-6).expect("tables")
        };
        let (few, many) = (sets(12), sets(48));
        assert!(many <= few + 3, "{few} sets for 12 layers, {many} for 48");
        assert_eq!(sets(48), 0, "the tables are kept");
    }
}
