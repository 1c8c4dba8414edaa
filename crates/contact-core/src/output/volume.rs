//! Stress in a volume, written plane by plane while it is computed.

use ndarray::Array2;

use crate::error::Error;
use crate::fields::{Depth, Measure, Slices};

/// Takes the planes of a volume, in any order and from any thread.
pub trait VolumeSink: Sync {
    /// The values of a measure at a depth, shape (nx, ny) \[Pa\]; both by their index.
    fn put(&self, measure: usize, depth: usize, values: &Array2<f64>) -> Result<(), Error>;
}

/// The largest value of a measure in a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeMaximum {
    /// Value \[Pa\].
    pub value: f64,
    /// Index of the depth.
    pub depth: usize,
    /// Cell.
    pub cell: (usize, usize),
}

/// Computes the measures under the first state of `slices` at every depth, hands them to the
/// sinks and gives the largest value of each.
pub fn write_volume(
    slices: &Slices,
    depths: &[Depth],
    measures: &[Measure],
    sinks: &[&dyn VolumeSink],
) -> Result<Vec<VolumeMaximum>, Error> {
    let of_depth = slices.map_stress(depths, |depth, mut states| {
        let s = states.swap_remove(0);
        let mut largest = Vec::with_capacity(measures.len());
        for (m, measure) in measures.iter().enumerate() {
            let values = Array2::from_shape_fn(s[0].dim(), |at| {
                (measure.value)(&std::array::from_fn(|c| s[c][at]))
            });
            for sink in sinks {
                sink.put(m, depth, &values)?;
            }
            let mut maximum = VolumeMaximum {
                value: f64::NEG_INFINITY,
                depth,
                cell: (0, 0),
            };
            for (cell, &value) in values.indexed_iter() {
                if value > maximum.value {
                    maximum = VolumeMaximum { value, depth, cell };
                }
            }
            largest.push(maximum);
        }
        Ok(largest)
    })?;
    let larger = |a: VolumeMaximum, b: VolumeMaximum| if b.value > a.value { b } else { a };
    let over_depths = |m: usize| of_depth.iter().map(|of| of[m]).reduce(larger);
    Ok((0..measures.len()).filter_map(over_depths).collect())
}
