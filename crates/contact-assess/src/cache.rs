//! Stress below a contact that several questions share.
//!
//! Lives, load factors and their worst points need the same histories: the stress of a section at its
//! depths, the stress at points under all moments, and the borders of the contact. A cache computes
//! each of them once. It holds the stress of the loads alone, without the residual stress of the
//! layers, which some judges take and others do not.

use std::sync::{Arc, Mutex, PoisonError};

use contact_core::Error;
use contact_subsurface::{Border, Continuation, Depth, Line, Moments};

use super::history::History;
use super::prepared_points::PreparedPoints;

/// Most memory of the histories of sections \[bytes\].
pub const MOST_HISTORIES: usize = 64 << 20;
/// Most memory of prepared points \[bytes\].
pub const MOST_POINTS: usize = 64 << 20;
/// Most memory of tractions continued within the cells \[bytes\].
pub const MOST_CONTINUATIONS: usize = 32 << 20;
/// Most memory of moments \[bytes\].
pub const MOST_MOMENTS: usize = 32 << 20;
/// Most lines whose borders are kept.
const MOST_BORDERS: usize = 64;

/// Cells of the tractions: the cells of the grid, or cells twice as large in one of two pairings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cells {
    /// The cells of the grid.
    Grid,
    /// The pairing of this number.
    Doubled(usize),
}

/// A line, numbers of moments, and the cells of their tractions.
pub(super) type StateKey = (Line, Vec<usize>, Cells);

/// Stress below one body over one cycle of a contact, kept for the next question.
///
/// A cache belongs to one body and one cycle. The memory is bounded, see `MOST_HISTORIES` and the
/// constants beside it: on large grids everything is computed again.
#[derive(Default)]
pub struct StressCache {
    /// By line, depth, and whether plastic strain is included.
    histories: Shelf<(Line, Depth, bool), History>,
    points: Shelf<StateKey, PreparedPoints>,
    moments: Shelf<(Vec<usize>, Cells), Moments>,
    continuations: Shelf<(Line, usize, Cells), Continuation>,
    borders: Shelf<StateKey, Vec<Border>>,
}

impl StressCache {
    /// The history of a section at a depth, if it is kept.
    pub(super) fn history(&self, key: &(Line, Depth, bool)) -> Option<Arc<History>> {
        self.histories.get(key)
    }

    /// Keeps a history while there is room.
    pub(super) fn keep_history(&self, key: (Line, Depth, bool), history: &Arc<History>) {
        let numbers: usize = history.fields().iter().map(|field| field.len()).sum();
        self.histories
            .insert(key, history, 8 * numbers, MOST_HISTORIES);
    }

    /// Returns prepared points from the cache; `make` prepares them if they are not there, or if their
    /// computation was interrupted.
    pub(super) fn points(
        &self,
        key: &StateKey,
        make: impl FnOnce() -> Result<PreparedPoints, Error>,
    ) -> Result<Arc<PreparedPoints>, Error> {
        if let Some(points) = self.points.get(key).filter(|points| points.is_usable()) {
            return Ok(points);
        }
        self.points.remove(key);
        let points = Arc::new(make()?);
        self.points
            .insert(key.clone(), &points, points.bytes(), MOST_POINTS);
        Ok(points)
    }

    /// Returns moments of a cycle from the cache, their tractions on `cells`; `make` reads them if they are not
    /// there.
    pub(super) fn moments(
        &self,
        (which, cells): (&[usize], Cells),
        make: impl FnOnce() -> Result<Moments, Error>,
    ) -> Result<Arc<Moments>, Error> {
        let which = (which.to_vec(), cells);
        if let Some(moments) = self.moments.get(&which) {
            return Ok(moments);
        }
        let moments = Arc::new(make()?);
        let cells: usize = moments.stick.iter().map(ndarray::Array2::len).sum();
        // Three tractions and a mark for each cell.
        self.moments
            .insert(which, &moments, 25 * cells, MOST_MOMENTS);
        Ok(moments)
    }

    /// The tractions of a moment within its cells below a line, if they are kept.
    pub(super) fn continuation(&self, key: &(Line, usize, Cells)) -> Option<Continuation> {
        self.continuations
            .get(key)
            .map(|kept| Continuation::clone(&kept))
    }

    /// Keeps the tractions of a moment within its cells while there is room.
    pub(super) fn keep_continuation(&self, key: (Line, usize, Cells), made: &Continuation) {
        let bytes = made.bytes();
        self.continuations
            .insert(key, &Arc::new(made.clone()), bytes, MOST_CONTINUATIONS);
    }

    /// Returns the borders of contact and slip below a line at some instants of the cycle, from the cache;
    /// `make` finds them if they are not there.
    pub(super) fn borders(
        &self,
        key: StateKey,
        make: impl FnOnce() -> Result<Vec<Border>, Error>,
    ) -> Result<Arc<Vec<Border>>, Error> {
        if let Some(borders) = self.borders.get(&key) {
            return Ok(borders);
        }
        let borders = Arc::new(make()?);
        self.borders.insert(key, &borders, 1, MOST_BORDERS);
        Ok(borders)
    }
}

/// Values by key, the oldest of which are given up for new ones within a bound.
struct Shelf<K, V>(Mutex<Vec<(K, Arc<V>, usize)>>);

impl<K, V> Default for Shelf<K, V> {
    /// An empty shelf.
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: PartialEq, V> Shelf<K, V> {
    /// The value of a key, if it is kept.
    fn get(&self, key: &K) -> Option<Arc<V>> {
        let values = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let entry = values.iter().find(|(k, ..)| k == key)?;
        Some(Arc::clone(&entry.1))
    }

    /// Forgets the value of a key.
    fn remove(&self, key: &K) {
        let mut values = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        values.retain(|(k, ..)| k != key);
    }

    /// Keeps a value of a `size` \[bytes\], and drops the oldest ones beyond `most` bytes in all. A value
    /// larger than `most` is not kept.
    fn insert(&self, key: K, value: &Arc<V>, size: usize, most: usize) {
        if size > most {
            return;
        }
        let mut values = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        values.retain(|(k, ..)| *k != key);
        values.push((key, Arc::clone(value), size));
        while values.iter().map(|(.., size)| size).sum::<usize>() > most {
            values.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_values_are_given_up_for_new_ones() {
        let shelf: Shelf<usize, &str> = Shelf::default();
        for (key, value) in [(1, "one"), (2, "two"), (3, "three")] {
            shelf.insert(key, &Arc::new(value), 40, 100);
        }
        assert!(shelf.get(&1).is_none());
        assert_eq!(shelf.get(&3).as_deref(), Some(&"three"));
        shelf.insert(4, &Arc::new("too large"), 101, 100);
        assert!(shelf.get(&4).is_none() && shelf.get(&2).is_some());
        shelf.insert(2, &Arc::new("new"), 100, 100);
        assert_eq!(shelf.get(&2).as_deref(), Some(&"new"));
        assert!(shelf.get(&3).is_none());
    }
}
