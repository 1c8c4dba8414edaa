//! Stress and displacement in a volume, written plane by plane while they are computed.

use ndarray::Array2;
use rayon::prelude::*;

use crate::error::Error;
use crate::fields::{Depth, Maximum, Probe, Slices, maximum_of_tops, top_of_plane};

/// Takes the planes of a volume, in any order and from any thread.
pub trait VolumeSink: Sync {
    /// The values of a probe at a depth, shape (nx, ny) \[Pa or m\]; both by their index.
    fn put(&self, probe: usize, depth: usize, values: &Array2<f64>) -> Result<(), Error>;
}

/// Computes the probes under the first state of `slices` at every depth, hands them to the
/// sinks and gives the largest value of each, refined between the cells. Only as many planes are
/// in memory as there are threads.
pub fn write_volume(
    slices: &Slices,
    depths: &[Depth],
    probes: &[Probe],
    sinks: &[&dyn VolumeSink],
) -> Result<Vec<Option<Maximum<2>>>, Error> {
    let grid = slices.grid();
    let x: Vec<f64> = (0..grid.nx).map(|i| grid.x(i)).collect();
    let y: Vec<f64> = (0..grid.ny).map(|j| grid.y(j)).collect();
    let tops: Vec<_> = depths
        .par_iter()
        .enumerate()
        .map(|(at, depth)| {
            let mut tops = vec![None; probes.len()];
            slices.probe(*depth, probes, |n, values| {
                for sink in sinks {
                    sink.put(n, at, &values)?;
                }
                tops[n] = top_of_plane(&values, &x, &y);
                Ok(())
            })?;
            Ok(tops)
        })
        .collect::<Result<_, Error>>()?;
    let over_depths = |n: usize| {
        let tops: Vec<_> = tops.iter().map(|of: &Vec<_>| of[n]).collect();
        maximum_of_tops(&tops, depths)
    };
    Ok((0..probes.len()).map(over_depths).collect())
}
