//! The largest stress at every increment of a load path, with its place.

use ndarray::{Array2, ArrayView2};
use stress_tensor::StressTensor;

use super::depth::{coarser_depths, interface_mask};
use super::maximum::{find_hills, top_of_line};
use super::{Accumulate, Border, Depth, Errors, Extremum, Line, Measure, Moment, Top};

/// Records the largest value of measures of stress below a line at every increment: value and place
/// per depth, by a parabola between the samples, and on the surface at the rims and stick borders.
#[derive(Clone, Debug)]
pub struct Largest {
    /// The measures of which the largest value is sought.
    pub measures: Vec<Measure>,
    /// The line.
    pub line: Line,
    /// Places of the samples along the line \[m\].
    pub along: Vec<f64>,
}

/// The tops on the line at one depth.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTops {
    /// The depth.
    pub depth: Depth,
    /// Tops of each moment.
    pub tops: Vec<MomentTops>,
}

/// The tops of a moment, for each measure.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentTops {
    /// The moment.
    pub moment: Moment,
    /// Between the samples.
    pub between: Vec<Option<Top<1>>>,
    /// Value and place on the highest border.
    pub on_border: Vec<Option<(f64, Border)>>,
}

impl Largest {
    /// The largest values over all depths, by moment and measure, from the accumulators of the
    /// depths. Their errors: the difference between parabola and sample, and the change of the
    /// value if every other depth of each layer is left out.
    pub fn over_depths(&self, kept: &[DepthTops]) -> Vec<(Moment, Vec<Option<Extremum>>)> {
        let Some(first) = kept.first() else {
            return Vec::new();
        };
        let moments = first.tops.iter().enumerate().map(|(n, of)| {
            let extremum_of = |m: usize| self.extremum(m, n, kept);
            (
                of.moment,
                (0..self.measures.len()).map(extremum_of).collect(),
            )
        });
        moments.collect()
    }

    /// The largest value of a measure at a moment.
    fn extremum(&self, m: usize, n: usize, kept: &[DepthTops]) -> Option<Extremum> {
        let depths: Vec<Depth> = kept.iter().map(|k| k.depth).collect();
        let of_interfaces = self.measures[m].on_interfaces;
        let tops: Vec<_> = kept.iter().map(|k| k.tops[n].between[m]).collect();
        let border = kept[0].tops[n].on_border[m].filter(|_| !of_interfaces);
        let on_border = border.map(|(value, Border { x, y, zone, .. })| Extremum {
            value,
            x,
            y,
            depth: depths[0],
            at: Some(zone),
            error: Errors::default(),
        });
        let between = largest_between_samples(&tops, &depths, of_interfaces, self.line);
        let largest = Extremum::largest(on_border.into_iter().chain(between));
        largest.map(|largest| largest.snapped_to_zero(span(&self.along)))
    }
}

/// The largest value of a sampled field, shape (depths, places), below the places `along` a line \[m\], by
/// parabolas between the samples. Its errors: the difference between parabola and sample, and the change of the
/// value if every other depth of each layer is left out.
pub fn largest_of_samples(
    values: &ArrayView2<'_, f64>,
    depths: &[Depth],
    line: Line,
    along: &[f64],
) -> Option<Extremum> {
    let lines = values.rows().into_iter();
    let tops: Vec<_> = lines.map(|line| top_of_line(&line, along)).collect();
    let largest = largest_between_samples(&tops, depths, false, line);
    largest.map(|largest| largest.snapped_to_zero(span(along)))
}

/// Length from the first place of a line to the last \[m\].
fn span(along: &[f64]) -> f64 {
    along
        .last()
        .zip(along.first())
        .map_or(0.0, |(last, first)| last - first)
}

/// Finds the largest value between the samples, from the top of each depth. With `of_interfaces`, depths on
/// interfaces count, too.
fn largest_between_samples(
    tops: &[Option<Top<1>>],
    depths: &[Depth],
    of_interfaces: bool,
    line: Line,
) -> Option<Extremum> {
    let highest = |present: &[bool]| {
        let kept = (0..depths.len()).filter(|k| present[*k]);
        let (tops, depths): (Vec<_>, Vec<Depth>) = kept.map(|k| (tops[k], depths[k])).unzip();
        find_hills(&tops, &depths, !of_interfaces)
            .into_iter()
            .next()
    };
    let used = if of_interfaces {
        interface_mask(depths)
    } else {
        vec![true; depths.len()]
    };
    let hill = highest(&used)?;
    let coarser = highest(&coarser_depths(depths)).filter(|_| !of_interfaces);
    let change_of_depths =
        coarser.map_or(0.0, |coarser| (hill.top.value - coarser.top.value).abs());
    let added = hill
        .top
        .error
        .max((hill.top.value - hill.top.sampled).abs());
    let [s] = hill.top.place;
    let (x, y) = line.place(s);
    Some(Extremum {
        value: hill.top.value,
        x,
        y,
        depth: hill.depth,
        at: None,
        error: Errors::from_search(line, [added, 0.0, change_of_depths]),
    })
}

impl Accumulate for Largest {
    type Accumulator = DepthTops;

    /// No tops yet at this depth.
    fn start(&self, depth: Depth, _: usize) -> DepthTops {
        let tops = Vec::new();
        DepthTops { depth, tops }
    }

    /// Keeps the top of each measure along the line at this moment.
    fn add(&self, kept: &mut DepthTops, moment: Moment, stress: &Array2<f64>) {
        let measures = self.measures.iter();
        let top = |m: &Measure| top_of_line(&m.at_points(&stress.view()).view(), &self.along);
        kept.tops.push(MomentTops {
            moment,
            between: measures.map(top).collect(),
            on_border: vec![None; self.measures.len()],
        });
    }

    /// Keeps the largest value of each measure on the borders of the moment last added.
    fn add_borders(&self, kept: &mut DepthTops, borders: &[(Border, StressTensor)]) {
        let Some(last) = kept.tops.last_mut() else {
            return;
        };
        for (measure, highest) in self.measures.iter().zip(&mut last.on_border) {
            let values = borders
                .iter()
                .map(|(at, stress)| ((measure.value)(stress), *at));
            *highest = values.max_by(|(a, _), (b, _)| a.total_cmp(b));
        }
    }
}
