//! Critical distances: judgement of the stress averaged over a length of the material.
//!
//! D. Taylor, The Theory of Critical Distances, Elsevier (2007).

use contact_core::Error;
use contact_subsurface::{Depth, Line};
use ndarray::{Array3, Axis};
use quadrature::gauss;

use super::history::History;
use super::judged::Judge;
use super::site::Site;

/// Depths of the quadrature over lines and discs. Its error is far below the error of the stress.
const NODES: usize = 16;
/// Discs of the quadrature over a ball.
const DISCS: usize = 8;

/// The region over which the stress is averaged, from the top of a layer down, for a critical
/// distance L.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Averaging {
    /// The point at the depth L/2.
    Point,
    /// The line down to 2 L.
    Line,
    /// The half disc of radius L in the plane of the section.
    Area,
    /// The half ball of radius L.
    Volume,
}

impl Averaging {
    /// All, with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("point", Self::Point),
        ("line", Self::Line),
        ("area", Self::Area),
        ("volume", Self::Volume),
    ];

    /// Depth of the region, as a multiple of L.
    fn reach(self) -> f64 {
        match self {
            Self::Point => 0.5,
            Self::Line => 2.0,
            Self::Area | Self::Volume => 1.0,
        }
    }

    /// Whether the region is a disc around the point, not a line into the depth.
    fn is_disc(self) -> bool {
        matches!(self, Self::Area | Self::Volume)
    }
}

/// A critical distance in a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// The region.
    pub method: Averaging,
    /// L \[m\].
    pub length: f64,
    /// The layer, from the surface down.
    pub layer: usize,
}

/// Judges the mean stress below every place of a line. The result is `None` at places nearer to the border of
/// the grid than the region reaches to the sides.
pub fn judge_means<J: Judge>(
    site: &Site<'_>,
    line: Line,
    distance: &Distance,
    judge: &J,
) -> Result<Vec<Option<J::Judgement>>, Error> {
    judge.accepts(site.cycle)?;
    let top = layer_top(site, distance)?;
    let Distance {
        method,
        length,
        layer,
    } = *distance;
    let discs: Vec<(f64, f64, f64)> = if method == Averaging::Volume {
        // Half discs side by side fill the half ball: offset, radius, part of the mean.
        let whole: f64 = gauss(DISCS).iter().map(|(x, w)| w * (1.0 - x * x)).sum();
        let disc = |(x, w): &(f64, f64)| {
            let square = 1.0 - x * x;
            (length * x, length * square.sqrt(), w * square / whole)
        };
        gauss(DISCS).iter().map(disc).collect()
    } else {
        vec![(0.0, length, 1.0)]
    };
    let along = line.places(site.grid);
    let strain = judge.takes_strain() && site.body.yields();
    let mut mean = History::zeros((site.cycle.count(), along.len()), strain);
    for (offset, radius, share) in discs {
        // In plane strain all sections are the same.
        let offset = if site.grid.plane_strain { 0.0 } else { offset };
        add_mean(
            site,
            line.parallel(offset),
            (method, radius, layer),
            (top, share),
            &mut mean,
        )?;
    }
    let inside: Vec<usize> = (0..along.len())
        .filter(|n| {
            mean.stress
                .index_axis(Axis(1), *n)
                .iter()
                .all(|v| v.is_finite())
        })
        .collect();
    // The depth of a mean: the middle of its region.
    let z = vec![top + 0.5 * length; inside.len()];
    let judged = judge.judge(layer, &z, &mean.select(&inside).view(), &site.stop)?;
    let mut judgements = vec![None; along.len()];
    for (n, one) in inside.into_iter().zip(judged) {
        judgements[n] = Some(one);
    }
    Ok(judgements)
}

/// Depth of the top of the layer that is averaged in \[m\]; fails if the distance does not lie in one layer.
fn layer_top(site: &Site<'_>, distance: &Distance) -> Result<f64, Error> {
    let Distance {
        method,
        length,
        layer,
    } = *distance;
    if !(length > 0.0 && length.is_finite()) {
        return Err(Error::invalid("L", length, "a positive length in m"));
    }
    let borders = site.body.interfaces();
    if layer > borders.len() {
        let allowed = format!(
            "0 to {}, a layer from the surface down; 0 is coating 1",
            borders.len()
        );
        return Err(Error::invalid("layer", layer, allowed));
    }
    let top = if layer == 0 { 0.0 } else { borders[layer - 1] };
    let reach = method.reach() * length;
    if let Some(bottom) = borders.get(layer).filter(|bottom| top + reach > **bottom) {
        let allowed = format!(
            "a distance that reaches no deeper than the {:.3e} m of {}, since it belongs to one material; it reaches \
             {reach:.3e} m (`layer` counts from 0; the substrate is {})",
            bottom - top,
            site.body.layer_name(layer),
            borders.len()
        );
        return Err(Error::invalid("L", format!("{length:.3e} m"), allowed));
    }
    Ok(top)
}

/// Adds the mean over the region (method, length L, layer) below the depth `top` to `mean`, times the weight
/// `share`.
fn add_mean(
    site: &Site<'_>,
    line: Line,
    (method, length, layer): (Averaging, f64, usize),
    (top, share): (f64, f64),
    mean: &mut History,
) -> Result<(), Error> {
    let nodes: Vec<(f64, f64)> = if method == Averaging::Point {
        vec![(1.0, 1.0)]
    } else {
        let weight = |x: f64| {
            if method.is_disc() {
                (1.0 - x * x).sqrt()
            } else {
                1.0
            }
        };
        let halves = gauss(NODES)
            .iter()
            .map(|(x, w)| (f64::midpoint(*x, 1.0), w / 2.0));
        let weighted: Vec<_> = halves.map(|(x, w)| (x, w * weight(x))).collect();
        let whole: f64 = weighted.iter().map(|(_, w)| w).sum();
        weighted.into_iter().map(|(x, w)| (x, w / whole)).collect()
    };
    let below = method.reach() * length;
    let depths: Vec<Depth> = nodes
        .iter()
        .map(|(x, _)| Depth {
            z: top + x * below,
            layer,
        })
        .collect();
    let along = line.places(site.grid);
    let strain = mean.plastic.is_some();
    site.for_each_depth((line, &depths), strain, |first, histories| {
        for (k, history) in histories.iter().enumerate() {
            let (x, weight) = nodes[first + k];
            let weight = share * weight;
            for (mean, of) in mean.fields_mut().into_iter().zip(history.fields()) {
                if method.is_disc() {
                    let half = (length * length - (x * below).powi(2)).max(0.0).sqrt();
                    mean.scaled_add(weight, &average_over_width(of, &along, half));
                } else {
                    mean.scaled_add(weight, of);
                }
            }
        }
        Ok(())
    })
}

/// Averages over x - half ... x + half a history that is linear between its places; NaN beyond
/// them.
fn average_over_width(history: &Array3<f64>, x: &[f64], half: f64) -> Array3<f64> {
    let n = x.len();
    let mut means = Array3::from_elem(history.dim(), f64::NAN);
    if n < 2 {
        return means;
    }
    let d = x[1] - x[0];
    let inside: Vec<usize> = (0..n)
        .filter(|i| x[*i] - half >= x[0] - 1e-9 * d && x[*i] + half <= x[n - 1] + 1e-9 * d)
        .collect();
    for (t, mut means) in means.outer_iter_mut().enumerate() {
        let now = history.index_axis(Axis(0), t);
        for c in 0..6 {
            // The integral from the first place to each.
            let mut whole = vec![0.0; n];
            for i in 1..n {
                whole[i] = whole[i - 1] + d * f64::midpoint(now[(i - 1, c)], now[(i, c)]);
            }
            let integral_to = |upper: f64| {
                let i = (((upper - x[0]) / d).max(0.0) as usize).min(n - 2);
                let s = (upper - x[i]) / d;
                let (low, high) = (now[(i, c)], now[(i + 1, c)]);
                whole[i] + d * s * (low + s / 2.0 * (high - low))
            };
            for &i in &inside {
                means[(i, c)] = if half > 0.0 {
                    (integral_to(x[i] + half) - integral_to(x[i] - half)) / (2.0 * half)
                } else {
                    now[(i, c)]
                };
            }
        }
    }
    means
}
