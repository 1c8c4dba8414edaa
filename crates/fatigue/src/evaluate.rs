//! A criterion on the stress histories of many points.

use std::sync::atomic::{AtomicBool, Ordering};

use ndarray::ArrayView3;
use rayon::prelude::*;
use stress_tensor::StressTensor;

use crate::acting::Acting;
use crate::at_point::AtPoint;
use crate::ball::Search as Balls;
use crate::criterion::Criterion;
use crate::critical_plane::{Buffers, Search};
use crate::definition::Acts;
use crate::error::Error;
use crate::invariants::sphere;
use crate::on_planes::{OnPlanes, ShearBuffers};
use crate::path::Path;
use crate::plane_function::PlaneFunction;

/// Points whose histories are copied together: a few hundred kilobytes.
const CHUNK: usize = 64;

/// The largest stress \[Pa\]: products of two stay finite.
const LARGEST: f64 = 1e75;

/// Buffers of a worker besides the path.
#[derive(Default)]
struct Worker {
    buffers: Buffers,
    shear: ShearBuffers,
    sphere: Balls<5>,
}

/// The criterion on stresses of shape (time, points, 6) \[Pa\], Voigt order xx, yy, zz, xy, xz, yz,
/// tension positive; points in parallel. The order of the instants does not matter, a cycle may be
/// given once or several times.
///
/// Fails if a stress is not finite, if there are fewer than two instants, if the last axis is not 6
/// long, or if the stress is zero everywhere; and with [`Error::Stopped`] once `stop` is raised.
pub fn evaluate(
    criterion: &Criterion,
    stress: &ArrayView3<'_, f64>,
    search: &Search,
    stop: &AtomicBool,
) -> Result<Vec<AtPoint>, Error> {
    let points = over_points(stress, stop, |worker: &mut Worker, path| {
        at_point(criterion, path, search, worker)
    })?;
    if !points.is_empty() && points.iter().all(Option::is_none) {
        return Err(Error::argument(
            "stress",
            0,
            "other than zero at some instant",
        ));
    }
    let known = points.into_iter().map(|p| p.unwrap_or(AtPoint::NOTHING));
    Ok(known.collect())
}

/// `f` of the path of each point; `None` where there is no stress.
pub(crate) fn over_points<W: Default, T: Send>(
    stress: &ArrayView3<'_, f64>,
    stop: &AtomicBool,
    f: impl Fn(&mut W, &Path) -> T + Sync,
) -> Result<Vec<Option<T>>, Error> {
    let (instants, points, components) = stress.dim();
    if components != 6 {
        let allowed = "6 long: xx, yy, zz, xy, xz, yz";
        return Err(Error::argument("last axis of stress", components, allowed));
    }
    if instants < 2 {
        let allowed = "at least 2: a criterion needs a history";
        return Err(Error::argument("instants of stress", instants, allowed));
    }
    let chunks: Vec<_> = (0..points.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let first = chunk * CHUNK;
            let here = CHUNK.min(points - first);
            let tensors = copied(stress, first, here)?;
            let (mut worker, mut path) = (W::default(), Path::new());
            let mut found = Vec::with_capacity(here);
            for history in tensors.chunks(instants) {
                if stop.load(Ordering::Relaxed) {
                    return Err(Error::Stopped);
                }
                path.load(history);
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
            if let Some(c) = tensor.iter().position(|s| !(s.abs() <= LARGEST)) {
                let key = format!("stress[{t}, {}, {c}]", first + p);
                let allowed = "a finite stress in Pa, up to 1e75";
                return Err(Error::argument(key, tensor[c], allowed));
            }
            tensors[p * instants + t] = tensor;
        }
    }
    Ok(tensors)
}

fn at_point(criterion: &Criterion, path: &Path, search: &Search, worker: &mut Worker) -> AtPoint {
    let of = match criterion.acts(path.unit()) {
        Acts::OfInvariants(value) => {
            let sphere = sphere(path, &mut worker.sphere);
            return value(path, &sphere, criterion.in_order()).at_point(path.unit());
        }
        Acts::OnPlanes(of) => of,
    };
    let mut planes = OnPlanes::new(of, path, &mut worker.shear);
    let peak = match planes.without_search() {
        Some(peak) => peak,
        None => search.peak(&mut planes, &mut worker.buffers),
    };
    let missed = of.factor * peak.missed;
    if peak.n[0].is_nan() {
        return AtPoint {
            missed,
            ..AtPoint::NOTHING
        };
    }
    let n = upward(peak.n);
    let value = of.factor * of.combination.there(planes.parts(peak.n));
    let acting = Acting::on(path, n, &mut worker.shear);
    AtPoint {
        value,
        missed,
        planes: peak.planes,
        normal: n,
        shear_amplitude: acting.shear_amplitude,
        shear_chord: acting.shear_chord,
        normal_max: acting.normal_max,
        normal_min: acting.normal_min,
    }
}

/// Components of a normal below this are errors of its search.
const NOISE: f64 = 1e-9;

/// Of a normal and its opposite, the one that points along z, y or x, without noise.
fn upward(n: [f64; 3]) -> [f64; 3] {
    let n = n.map(|v| if v.abs() < NOISE { 0.0 } else { v });
    let first = [2, 1, 0].into_iter().find(|d| n[*d] != 0.0);
    if first.is_some_and(|d| n[d] < 0.0) {
        // Without a negative zero.
        n.map(|v| 0.0 - v)
    } else {
        n
    }
}
