//! The largest stress at every increment of a load path, and where it is.

use ndarray::Array2;

use super::maximum::{Maximum, Top, maximum_of_tops, top_of_line};
use super::{Accumulate, Depth, Measure, Moment};

/// Keeps the largest value of measures of stress below a line at every increment: a number and a
/// place per depth.
#[derive(Clone, Debug)]
pub struct Largest {
    /// What is followed.
    pub measures: Vec<Measure>,
    /// Places of the samples along the line \[m\].
    pub along: Vec<f64>,
}

/// The tops on the line at one depth, by moment and measure.
pub type DepthTops = Vec<(Moment, Vec<Option<Top<1>>>)>;

impl Largest {
    /// The largest values over all depths, by moment and measure, from what was kept at each.
    pub fn over_depths(
        depths: &[Depth],
        kept: &[DepthTops],
    ) -> Vec<(Moment, Vec<Option<Maximum<1>>>)> {
        let Some(first) = kept.first() else {
            return Vec::new();
        };
        let moments = first.iter().enumerate().map(|(n, (moment, tops))| {
            let of = |m: usize| {
                let tops: Vec<_> = kept.iter().map(|depth| depth[n].1[m]).collect();
                maximum_of_tops(&tops, depths)
            };
            (*moment, (0..tops.len()).map(of).collect())
        });
        moments.collect()
    }
}

impl Accumulate for Largest {
    type Kept = DepthTops;

    fn start(&self, _: Depth, _: usize) -> DepthTops {
        Vec::new()
    }

    fn add(&self, kept: &mut DepthTops, moment: Moment, stress: &Array2<f64>) {
        let tops = self.measures.iter().map(|measure| {
            let values = measure.on(stress.view());
            top_of_line(values.view(), &self.along)
        });
        kept.push((moment, tops.collect()));
    }
}
