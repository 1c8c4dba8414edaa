//! A criterion on the stress histories of many points.

use std::sync::atomic::{AtomicBool, Ordering};

use ndarray::ArrayView3;
use rayon::prelude::*;

use crate::acting::Acting;
use crate::at_point::AtPoint;
use crate::ball::Search as Balls;
use crate::criterion::Criterion;
use crate::critical_plane::{Buffers, Search};
use crate::definition::Acts;
use crate::error::Error;
use crate::histories::Histories;
use crate::history::{History, plastic_strains, stresses};
use crate::invariants::sphere;
use crate::on_planes::{OnPlanes, ShearBuffers};
use crate::plane_function::PlaneFunction;

/// Points whose histories are copied together: a few hundred kilobytes.
const CHUNK: usize = 64;

/// Buffers of a worker besides the path.
#[derive(Default)]
struct Worker {
    buffers: Buffers,
    shear: ShearBuffers,
    sphere: Balls<5>,
}

/// The criterion on the histories of points, in parallel. The order of the instants does not matter, a
/// cycle may be given once or several times.
///
/// Fails if a stress or strain is not finite, if there are fewer than two instants, if the last axis is
/// not 6 long, if the plastic strain has another shape or changes the volume, or if the stress is zero
/// everywhere; and with [`Error::Stopped`] once `stop` is raised.
pub fn evaluate(
    criterion: &Criterion,
    history: &History<'_>,
    search: &Search,
    stop: &AtomicBool,
) -> Result<Vec<AtPoint>, Error> {
    history.check()?;
    let plastic = history.taken_by(criterion);
    let plastic = plastic.as_ref().map(|(plastic, twice)| (plastic, *twice));
    let points = over_points(&history.stress, plastic, stop, |worker: &mut Worker, of| {
        at_point(criterion, of, search, worker)
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

/// `f` of the histories of each point; `None` where there is no stress. The plastic strain comes with 2 G
/// \[Pa\].
pub(crate) fn over_points<W: Default, T: Send>(
    stress: &ArrayView3<'_, f64>,
    plastic: Option<(&ArrayView3<'_, f64>, f64)>,
    stop: &AtomicBool,
    f: impl Fn(&mut W, &Histories) -> T + Sync,
) -> Result<Vec<Option<T>>, Error> {
    let (instants, points, _) = stress.dim();
    let chunks: Vec<_> = (0..points.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let first = chunk * CHUNK;
            let here = CHUNK.min(points - first);
            let stress = stresses(stress, first, here)?;
            let strains = plastic.map(|plastic| plastic_strains(plastic, first, here));
            let strains = strains.transpose()?;
            let (mut worker, mut of) = (W::default(), Histories::new());
            let mut found = Vec::with_capacity(here);
            for (p, history) in stress.chunks(instants).enumerate() {
                if stop.load(Ordering::Relaxed) {
                    return Err(Error::Stopped);
                }
                let own = p * instants..(p + 1) * instants;
                of.load(history, strains.as_ref().map(|strains| &strains[own]));
                let [size, strained] = of.sizes();
                found.push((size.max(strained) > 0.0).then(|| f(&mut worker, &of)));
            }
            Ok(found)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(chunks.into_iter().flatten().collect())
}

fn at_point(
    criterion: &Criterion,
    histories: &Histories,
    search: &Search,
    worker: &mut Worker,
) -> AtPoint {
    let path = &histories.stress;
    let of = match criterion.acts(path.unit()) {
        Acts::OfInvariants(value) => {
            let sphere = sphere(path, &mut worker.sphere);
            return value(path, &sphere, criterion.in_order()).at_point(path.unit());
        }
        Acts::OnPlanes(of) => of,
    };
    let mut planes = OnPlanes::new(of, histories, &mut worker.shear);
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
