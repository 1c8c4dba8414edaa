//! The stress of loads at single points: what a search asks for many times.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use contact_core::Error;
use contact_subsurface::{Moments, Point, Points};

use super::history::{History, Strains};

/// Most points whose stress is kept by prepared points.
const MOST_POINTS: usize = 2000;

/// Stress of the loads and strain at points under some moments.
pub(super) struct PreparedPoints {
    points: Points,
    moments: usize,
    strains: Strains,
    /// The middle of its grid \[m\].
    middle: (f64, f64),
    /// Ends a computation of the stress.
    stop: Arc<AtomicBool>,
    /// Memory \[bytes\].
    bytes: usize,
    /// The stress of each moment at points, by the bits of x, y, z and the layer.
    computed: Mutex<HashMap<PointKey, Vec<[f64; 6]>>>,
}

/// A point by the bits of its numbers.
type PointKey = ([u64; 3], usize);

/// The key of a point, from the bits of its coordinates.
fn key_of(&(x, y, depth): &Point) -> PointKey {
    ([x, y, depth.z].map(f64::to_bits), depth.layer)
}

impl PreparedPoints {
    /// Keeps points under moments.
    pub(super) fn new(
        points: Points,
        moments: &Moments,
        middle: (f64, f64),
        stop: Arc<AtomicBool>,
    ) -> Self {
        let count = moments.tractions.len();
        Self {
            moments: count,
            strains: Strains::from_moments(moments, true),
            middle,
            stop,
            bytes: points.bytes(),
            points,
            computed: Mutex::default(),
        }
    }

    /// Whether no interruption has ended their computation.
    pub(super) fn is_usable(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }

    /// Their memory \[bytes\].
    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Number of moments.
    pub(super) fn moments(&self) -> usize {
        self.moments
    }

    /// Checks that a point of the surface lies beside an assumed rim.
    pub(super) fn rim_is_unknown(&self, (x, y, depth): Point) -> bool {
        let moved = (x - self.middle.0, y - self.middle.1, depth);
        self.points.rim_is_unknown(moved)
    }

    /// The history of the loads at points.
    pub(super) fn history(&self, points: &[Point]) -> Result<History, Error> {
        let moved: Vec<Point> = points
            .iter()
            .map(|(x, y, depth)| (x - self.middle.0, y - self.middle.1, *depth))
            .collect();
        let stress = self.stress(&moved)?;
        let mut history = History::zeros((self.moments, points.len()), self.strains.is_present());
        history
            .stress
            .indexed_iter_mut()
            .for_each(|((t, n, c), s)| *s = stress[n][t][c]);
        let all_moments: Vec<usize> = (0..self.moments).collect();
        history.add_strains(&all_moments, &self.strains, &moved);
        Ok(history)
    }

    /// The stress of the loads at points in each moment; what was computed before is kept.
    fn stress(&self, points: &[Point]) -> Result<Vec<Vec<[f64; 6]>>, Error> {
        let lock = || self.computed.lock().unwrap_or_else(PoisonError::into_inner);
        let mut stress: Vec<Option<Vec<[f64; 6]>>> = {
            let computed = lock();
            let before = points.iter().map(|point| computed.get(&key_of(point)));
            before.map(Option::<&_>::cloned).collect()
        };
        let missing: Vec<usize> = (0..points.len()).filter(|n| stress[*n].is_none()).collect();
        if !missing.is_empty() {
            let new_points: Vec<Point> = missing.iter().map(|n| points[*n]).collect();
            let by_moment = self.points.stress(&new_points)?;
            let mut computed = lock();
            if computed.len() + missing.len() > MOST_POINTS {
                computed.clear();
            }
            for (k, n) in missing.into_iter().enumerate() {
                let of_point: Vec<_> = by_moment.iter().map(|moment| moment[k]).collect();
                computed.insert(key_of(&points[n]), of_point.clone());
                stress[n] = Some(of_point);
            }
        }
        Ok(stress.into_iter().map(Option::unwrap_or_default).collect())
    }
}
