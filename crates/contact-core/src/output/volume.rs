//! Stress in a volume, written plane by plane while it is computed.

use ndarray::Array2;

use crate::error::Error;
use crate::fields::{Depth, Maximum, Measure, Slices, maximum_of_tops, top_of_plane};

/// Takes the planes of a volume, in any order and from any thread.
pub trait VolumeSink: Sync {
    /// The values of a measure at a depth, shape (nx, ny) \[Pa\]; both by their index.
    fn put(&self, measure: usize, depth: usize, values: &Array2<f64>) -> Result<(), Error>;
}

/// Computes the measures under the first state of `slices` at every depth, hands them to the
/// sinks and gives the largest value of each, refined between the cells.
pub fn write_volume(
    slices: &Slices,
    depths: &[Depth],
    measures: &[Measure],
    sinks: &[&dyn VolumeSink],
) -> Result<Vec<Option<Maximum<2>>>, Error> {
    let grid = slices.grid();
    let x: Vec<f64> = (0..grid.nx).map(|i| grid.x(i)).collect();
    let y: Vec<f64> = (0..grid.ny).map(|j| grid.y(j)).collect();
    let tops = slices.map_stress(depths, |depth, mut states| {
        let s = states.swap_remove(0);
        let mut tops = Vec::with_capacity(measures.len());
        for (m, measure) in measures.iter().enumerate() {
            let values = Array2::from_shape_fn(s[0].dim(), |at| {
                (measure.value)(&std::array::from_fn(|c| s[c][at]))
            });
            for sink in sinks {
                sink.put(m, depth, &values)?;
            }
            tops.push(top_of_plane(&values, &x, &y));
        }
        Ok(tops)
    })?;
    let over_depths = |m: usize| {
        let tops: Vec<_> = tops.iter().map(|of| of[m]).collect();
        maximum_of_tops(&tops, depths)
    };
    Ok((0..measures.len()).map(over_depths).collect())
}
