//! A criterion on the stress histories of many points.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use ndarray::ArrayView3;
use rayon::prelude::*;

use crate::ball::Search as Balls;
use crate::criterion::Criterion;
use crate::critical_plane::{Buffers, Search};
use crate::definition::Acts;
use crate::error::Error;
use crate::histories::Histories;
use crate::history::{History, plastic_strains, stresses};
use crate::invariants::deviatoric_sphere;
use crate::on_planes::{OnPlanes, ShearBuffers};
use crate::plane_function::PlaneFunction;
use crate::plane_stresses::PlaneStresses;
use crate::point_result::PointResult;

/// Points whose histories are copied together: a few hundred kilobytes.
const CHUNK: usize = 64;

/// Planes judged in this process.
static PLANES: AtomicU64 = AtomicU64::new(0);

/// Returns the number of planes that this process has judged by criteria of critical planes.
pub fn planes_judged() -> u64 {
    PLANES.load(Ordering::Relaxed)
}

/// Buffers of a worker besides the path.
#[derive(Default)]
pub(crate) struct Worker {
    buffers: Buffers,
    shear: ShearBuffers,
    sphere: Balls<5>,
}

/// Evaluates a criterion on the histories of points, in parallel. The order of the instants does
/// not matter, and a cycle may stand once or several times in the history.
///
/// Fails if a stress or strain is not finite, if there are fewer than two instants, if the last axis is
/// not 6 long, if the plastic strain has another shape or changes the volume, or if the stress is zero
/// everywhere; and with [`Error::Stopped`] once `stop` is raised.
pub fn evaluate(
    criterion: &Criterion,
    history: &History<'_>,
    search: &Search,
    stop: &AtomicBool,
) -> Result<Vec<PointResult>, Error> {
    history.check()?;
    let plastic = history.strain_for(criterion);
    let plastic = plastic
        .as_ref()
        .map(|(plastic, twice_shear)| (plastic, *twice_shear));
    let points = map_points(&history.stress, plastic, stop, |worker: &mut Worker, of| {
        evaluate_point(criterion, of, search, worker)
    })?;
    if !points.is_empty() && points.iter().all(Option::is_none) {
        return Err(Error::argument(
            "stress",
            0,
            "other than zero at some instant",
        ));
    }
    let results = points
        .into_iter()
        .map(|p| p.unwrap_or(PointResult::NOTHING));
    Ok(results.collect())
}

/// Applies `f` to the histories of each point; returns `None` where there is no stress. The plastic
/// strain comes with 2 G \[Pa\].
pub(crate) fn map_points<W: Default, T: Send>(
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
            let count = CHUNK.min(points - first);
            let stress = stresses(stress, first, count)?;
            let strains = plastic.map(|plastic| plastic_strains(plastic, first, count));
            let strains = strains.transpose()?;
            let (mut worker, mut histories) = (W::default(), Histories::new());
            let mut results = Vec::with_capacity(count);
            for (p, history) in stress.chunks(instants).enumerate() {
                if stop.load(Ordering::Relaxed) {
                    return Err(Error::Stopped);
                }
                let instants_of_point = p * instants..(p + 1) * instants;
                histories.load(
                    history,
                    strains.as_ref().map(|strains| &strains[instants_of_point]),
                );
                let [size, strained] = histories.max_components();
                results.push((size.max(strained) > 0.0).then(|| f(&mut worker, &histories)));
            }
            Ok(results)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(chunks.into_iter().flatten().collect())
}

/// Evaluates a criterion at one point.
pub(crate) fn evaluate_point(
    criterion: &Criterion,
    histories: &Histories,
    search: &Search,
    worker: &mut Worker,
) -> PointResult {
    let path = &histories.stress;
    let law = match criterion.acts(path.unit()) {
        Acts::OfInvariants(value) => {
            let sphere = deviatoric_sphere(path, &mut worker.sphere);
            return value(path, &sphere, criterion.ordered_numbers()).to_result(path.unit());
        }
        Acts::OnPlanes(law) => law,
    };
    let mut planes = OnPlanes::new(law, histories, &mut worker.shear);
    let peak = match planes.without_search() {
        Some(peak) => peak,
        None => search.peak(&mut planes, &mut worker.buffers),
    };
    PLANES.fetch_add(peak.planes as u64, Ordering::Relaxed);
    let missed = law.factor * peak.missed;
    if peak.n[0].is_nan() {
        return PointResult {
            missed,
            ..PointResult::NOTHING
        };
    }
    let n = orient_upward(peak.n);
    let value = law.factor * law.combination.criterion_value(planes.parts(peak.n));
    let acting = PlaneStresses::new(path, n, &mut worker.shear);
    PointResult {
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

/// Returns a normal or its opposite, whichever points along z, y or x, without noise.
fn orient_upward(n: [f64; 3]) -> [f64; 3] {
    let n = n.map(|v| if v.abs() < NOISE { 0.0 } else { v });
    let first = [2, 1, 0].into_iter().find(|d| n[*d] != 0.0);
    if first.is_some_and(|d| n[d] < 0.0) {
        // Without a negative zero.
        n.map(|v| 0.0 - v)
    } else {
        n
    }
}
