//! A criterion on the stress histories of many points.

use std::sync::atomic::AtomicBool;

use ndarray::ArrayView3;
use rayon::prelude::*;

use super::acting::Acting;
use super::at_point::AtPoint;
use super::ball::Search as Balls;
use super::criterion::Criterion;
use super::critical_plane::{Room, Search};
use super::invariants;
use super::on_planes::{OnPlanes, ShearRoom};
use super::path::Path;
use crate::error::Error;
use crate::fields::StressTensor;
use crate::stop::unless;

/// Points whose histories are copied together: a few hundred kilobytes.
const CHUNK: usize = 64;

/// What a worker needs beside the path.
#[derive(Default)]
struct Worker {
    room: Room,
    shear: ShearRoom,
    sphere: Balls<5>,
}

/// The criterion on stresses of shape (time, points, 6) \[Pa\], Voigt order xx, yy, zz, xy, xz, yz,
/// tension positive; points in parallel. The order of the instants does not matter, a cycle may be
/// given once or several times.
///
/// Fails if a stress is not finite, if there are fewer than two instants, if the last axis is not 6
/// long, or if the stress is zero everywhere; and with [`Error::Interrupted`] once `stop` is raised.
pub fn evaluate(
    criterion: &Criterion,
    stress: &ArrayView3<'_, f64>,
    search: &Search,
    stop: &AtomicBool,
) -> Result<Vec<AtPoint>, Error> {
    criterion.check()?;
    let points = over_points(stress, stop, |worker: &mut Worker, path| {
        at_point(criterion, path, search, worker)
    })?;
    if !points.is_empty() && points.iter().all(Option::is_none) {
        return Err(Error::invalid(
            "stress",
            0,
            "other than zero at some instant",
        ));
    }
    let known = points.into_iter().map(|p| p.unwrap_or(AtPoint::NOTHING));
    Ok(known.collect())
}

/// What `f` makes of the path of each point; `None` where there is no stress.
pub(super) fn over_points<W: Default, T: Send>(
    stress: &ArrayView3<'_, f64>,
    stop: &AtomicBool,
    f: impl Fn(&mut W, &Path) -> T + Sync,
) -> Result<Vec<Option<T>>, Error> {
    let (instants, points, components) = stress.dim();
    if components != 6 {
        let allowed = "6 long: xx, yy, zz, xy, xz, yz";
        return Err(Error::invalid("last axis of stress", components, allowed));
    }
    if instants < 2 {
        let allowed = "at least 2: a criterion needs a history";
        return Err(Error::invalid("instants of stress", instants, allowed));
    }
    let chunks: Vec<_> = (0..points.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            unless(stop)?;
            let first = chunk * CHUNK;
            let here = CHUNK.min(points - first);
            let tensors = copied(stress, first, here)?;
            let (mut worker, mut path) = (W::default(), Path::new());
            let mut found = Vec::with_capacity(here);
            for history in tensors.chunks(instants) {
                path.load(history.iter().copied());
                found.push((path.size() > 0.0).then(|| f(&mut worker, &path)));
            }
            Ok(found)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(chunks.into_iter().flatten().collect())
}

/// The histories of a few points, one after the other.
fn copied(
    stress: &ArrayView3<'_, f64>,
    first: usize,
    points: usize,
) -> Result<Vec<StressTensor>, Error> {
    let instants = stress.dim().0;
    let mut tensors = vec![[0.0; 6]; points * instants];
    for t in 0..instants {
        for p in 0..points {
            let tensor: StressTensor = std::array::from_fn(|c| stress[(t, first + p, c)]);
            if let Some(c) = tensor.iter().position(|s| !s.is_finite()) {
                let key = format!("stress[{t}, {}, {c}]", first + p);
                return Err(Error::invalid(key, tensor[c], "a finite stress in Pa"));
            }
            tensors[p * instants + t] = tensor;
        }
    }
    Ok(tensors)
}

fn at_point(criterion: &Criterion, path: &Path, search: &Search, worker: &mut Worker) -> AtPoint {
    let Some(mut planes) = OnPlanes::new(criterion, path, &mut worker.shear) else {
        return invariants::at_point(criterion, path, &mut worker.sphere);
    };
    let peak = search.peak(&mut planes, &mut worker.room);
    let n = upward(peak.n);
    let acting = Acting::on(path, n, &mut worker.shear);
    let value = match *criterion {
        Criterion::Matake { k } | Criterion::McDiarmid { k } => {
            acting.shear_amplitude + k * acting.normal_max
        }
        Criterion::BrownMiller { E, nu, S } => {
            let strain = (1.0 + nu) / E * n_range(path, n, nu);
            2.0 * (1.0 + nu) / E * acting.shear_amplitude + S * strain
        }
        _ => peak.value,
    };
    AtPoint {
        value,
        missed: peak.missed,
        planes: peak.planes,
        normal: n,
        shear_amplitude: acting.shear_amplitude,
        shear_chord: acting.shear_chord,
        normal_max: acting.normal_max,
        normal_min: acting.normal_min,
    }
}

/// Range of E/(1 + nu) times the normal strain \[Pa\].
fn n_range(path: &Path, n: [f64; 3], nu: f64) -> f64 {
    let mut weights = super::path::normal_weights(n);
    for w in &mut weights[..3] {
        *w -= nu / (1.0 + nu);
    }
    2.0 * path.range(&weights).amplitude()
}

/// Of a normal and its opposite, the one that points along z, y or x.
fn upward(n: [f64; 3]) -> [f64; 3] {
    let first = [2, 1, 0].into_iter().find(|d| n[*d].abs() > 1e-12);
    if first.is_some_and(|d| n[d] < 0.0) {
        n.map(|v| -v)
    } else {
        n
    }
}
