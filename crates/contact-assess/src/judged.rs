//! A judge applied to a section.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_subsurface::{CycleSource, Depth, Line};
use fatigue::History;
use rayon::prelude::*;

use super::site::Site;

/// A rule that judges the stress history of points.
pub trait Judge: Sync {
    /// The judgement of a point.
    type Judgement: Copy + Send + Sync;
    /// Whether it judges a layer, from the surface down.
    fn judges(&self, layer: usize) -> bool;
    /// The judgements of histories of shape (moments, points, 6) in a layer that it judges, at the depths `z`
    /// below the surface of the body \[m\], one for each point.
    fn judge(
        &self,
        layer: usize,
        z: &[f64],
        history: &History<'_>,
        stop: &AtomicBool,
    ) -> Result<Vec<Self::Judgement>, Error>;
    /// Whether it takes the plastic strain; without it the history has the stress alone.
    fn takes_strain(&self) -> bool {
        false
    }
    /// Fails for a cycle that it cannot judge.
    fn accepts(&self, _: &dyn CycleSource) -> Result<(), Error> {
        Ok(())
    }
    /// The severity of a judgement: the larger the worse.
    fn score(&self, found: &Self::Judgement) -> f64;
}

/// The judgements on a section.
#[derive(Clone, Debug)]
pub struct Judged<F> {
    /// The line that the section is below.
    pub line: Line,
    /// Places on it \[m\].
    pub along: Vec<f64>,
    /// Depths.
    pub depths: Vec<Depth>,
    /// The judgements at each depth along the line; `None` in layers that are not judged.
    pub judgements: Vec<Option<Vec<F>>>,
}

/// Applies several judges to the section below a line at some depths, all to the same stress.
pub fn judge<J: Judge>(
    site: &Site<'_>,
    line: Line,
    depths: &[Depth],
    judges: &[J],
) -> Result<Vec<Judged<J::Judgement>>, Error> {
    for judge in judges {
        judge.accepts(site.cycle)?;
    }
    let along = line.places(site.grid);
    let judged_depths: Vec<usize> = (0..depths.len())
        .filter(|n| judges.iter().any(|judge| judge.judges(depths[*n].layer)))
        .collect();
    let some: Vec<Depth> = judged_depths.iter().map(|n| depths[*n]).collect();
    let mut judgements: Vec<Vec<Option<Vec<J::Judgement>>>> =
        vec![vec![None; depths.len()]; judges.len()];
    let strain = judges.iter().any(Judge::takes_strain);
    site.for_each_depth((line, &some), strain, |first, histories| {
        let of_depth = |(k, history): (usize, &Arc<super::history::History>)| {
            let Depth { z, layer } = some[first + k];
            let z = vec![z; along.len()];
            let of_judge = |judge: &J| {
                judge
                    .judges(layer)
                    .then(|| judge.judge(layer, &z, &history.view(), &site.stop))
                    .transpose()
            };
            judges
                .iter()
                .map(of_judge)
                .collect::<Result<Vec<_>, Error>>()
        };
        let fatigue_histories: Vec<_> = histories
            .par_iter()
            .enumerate()
            .map(of_depth)
            .collect::<Result<_, Error>>()?;
        for (k, of_judges) in fatigue_histories.into_iter().enumerate() {
            for (judgements, of_judge) in judgements.iter_mut().zip(of_judges) {
                judgements[judged_depths[first + k]] = of_judge;
            }
        }
        Ok(())
    })?;
    let judged = |judgements| Judged {
        line,
        along: along.clone(),
        depths: depths.to_vec(),
        judgements,
    };
    Ok(judgements.into_iter().map(judged).collect())
}
