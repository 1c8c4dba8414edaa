//! Stress and displacement in a volume, written plane by plane while they are computed.

use std::sync::{Mutex, PoisonError};

use contact_core::Error;
use contact_subsurface::{Depth, Extremum, Probe, Search, Slices, top_of_plane};
use ndarray::Array2;
use rayon::prelude::*;

/// Takes the planes of a volume, in any order and from any thread.
pub trait VolumeSink: Sync {
    /// The values of a probe at a depth, shape (nx, ny) \[Pa or m\]; both by their index.
    fn put(&self, probe: usize, depth: usize, values: &Array2<f64>) -> Result<(), Error>;
}

/// Computes the probes under the first state of `slices` at every depth of `written` and hands them
/// to the sinks. With a `search`, it returns the largest value of each probe between the samples;
/// then the planes at the depths `between` are computed, too. The memory holds one plane for each
/// thread.
pub fn write_volume(
    slices: &Slices,
    written: &[Depth],
    between: &[Depth],
    probes: &[Probe],
    sinks: &[&dyn VolumeSink],
    search: Option<&Search>,
) -> Result<Vec<Option<Extremum>>, Error> {
    let (depths, place) = merge_depths(written, between);
    let grid = slices.grid();
    let x: Vec<f64> = (0..grid.nx).map(|i| grid.x(i)).collect();
    let y: Vec<f64> = (0..grid.ny).map(|j| grid.y(j)).collect();
    let first: Mutex<Vec<Array2<f64>>> = Mutex::new(vec![Array2::zeros((0, 0)); probes.len()]);
    let tops: Vec<_> = depths
        .par_iter()
        .enumerate()
        .map(|(at, depth)| {
            let mut tops = vec![None; probes.len()];
            slices.probe(*depth, probes, |n, values| {
                for sink in sinks.iter().filter(|_| place[at].is_some()) {
                    sink.put(n, place[at].unwrap_or_default(), &values)?;
                }
                tops[n] = top_of_plane(&values, &x, &y);
                if at == 0 {
                    first.lock().unwrap_or_else(PoisonError::into_inner)[n] = values;
                }
                Ok(())
            })?;
            Ok(tops)
        })
        .collect::<Result<_, Error>>()?;
    let first = first.into_inner().unwrap_or_else(PoisonError::into_inner);
    let over_depths = |n: usize| {
        let tops: Vec<_> = tops.iter().map(|of: &Vec<_>| of[n]).collect();
        let Some(search) = search else {
            return Ok(None);
        };
        search.find_in_volume(&probes[n], &tops, &first[n], &depths, None)
    };
    (0..probes.len()).map(over_depths).collect()
}

/// Merges the depths of both lists in their order, each once. Each comes with its index in the first list, if
/// it is there.
fn merge_depths(written: &[Depth], between: &[Depth]) -> (Vec<Depth>, Vec<Option<usize>>) {
    let written_depths = written
        .iter()
        .enumerate()
        .map(|(n, depth)| (*depth, Some(n)));
    let others = between.iter().filter(|depth| !written.contains(depth));
    let mut merged: Vec<_> = written_depths
        .chain(others.map(|depth| (*depth, None)))
        .collect();
    merged.sort_by(|(a, _), (b, _)| a.z.total_cmp(&b.z).then(a.layer.cmp(&b.layer)));
    merged.into_iter().unzip()
}
