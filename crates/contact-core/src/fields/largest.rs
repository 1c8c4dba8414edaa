//! The largest stress at every increment of a load path, and where it is.

use ndarray::Array2;

use super::maximum::{Maximum, Top};
use super::{Accumulate, Depth, Measure, Moment};

/// Keeps the largest value of measures of stress below a line at every increment: a number and a
/// place per depth.
#[derive(Clone, Debug)]
pub struct Largest {
    /// The measures of which the largest value is sought.
    pub measures: Vec<Measure>,
    /// Places of the samples along the line \[m\].
    pub along: Vec<f64>,
}

/// The tops on the line at one depth.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTops {
    /// The depth.
    pub depth: Depth,
    /// By moment and measure.
    pub tops: Vec<(Moment, Vec<Option<Top<1>>>)>,
}

impl Largest {
    /// The largest values over all depths, by moment and measure, from the accumulators of the depths.
    pub fn over_depths(
        measures: &[Measure],
        kept: &[DepthTops],
    ) -> Vec<(Moment, Vec<Option<Maximum<1>>>)> {
        let depths: Vec<Depth> = kept.iter().map(|k| k.depth).collect();
        let Some(first) = kept.first() else {
            return Vec::new();
        };
        let moments = first.tops.iter().enumerate().map(|(n, (moment, tops))| {
            let of = |m: usize| {
                let tops: Vec<_> = kept.iter().map(|k| k.tops[n].1[m]).collect();
                measures[m].largest(&tops, &depths)
            };
            (*moment, (0..tops.len()).map(of).collect())
        });
        moments.collect()
    }
}

impl Accumulate for Largest {
    type Kept = DepthTops;

    fn start(&self, depth: Depth, _: usize) -> DepthTops {
        let tops = Vec::new();
        DepthTops { depth, tops }
    }

    fn add(&self, kept: &mut DepthTops, moment: Moment, stress: &Array2<f64>) {
        let measures = self.measures.iter();
        let tops = measures.map(|m| m.top(&stress.view(), &self.along, kept.depth));
        kept.tops.push((moment, tops.collect()));
    }
}
