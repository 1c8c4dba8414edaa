//! The stress of the body without the crack along the lines of cracks.
//!
//! It is sampled at distances that grow with that from the mouth; between them it is interpolated
//! over the logarithm of the distance, part by part: a part lies in one layer, between two rows of its
//! residual stress and between two ends of pieces of the crack, so that the stress is smooth on it. No place is asked for twice.

use std::collections::HashMap;

use contact_core::Error;
use contact_core::scene::Body;
use contact_subsurface::{Depth, Points, Side};
use fracture::{Path, PlaneStress, Point};

/// Step of ln(distance from the mouth) between samples.
const STEP: f64 = 0.15;
/// Samples that an interpolation takes.
const SAMPLES: usize = 6;

/// Cells of the tractions: those of the grid, then twice as large ones, paired in two ways.
pub(super) const GRIDS: usize = 3;

/// Points under tractions on a grid, and the middle of that grid \[m\].
pub(super) type PointsOnGrid = (Points, (f64, f64));

/// The stress below a contact where cracks run.
pub(super) struct Along<'a> {
    pub(super) body: &'a Body,
    pub(super) side: Side,
    /// Under the states of the cycle, and under their tractions on cells twice as large, with the middle
    /// of the grid of each \[m\].
    pub(super) points: [PointsOnGrid; GRIDS],
    /// Angle of the plane of the cracks about the axis of depth from that of x \[rad\].
    pub(super) azimuth: f64,
    /// Distance of that plane from the axis of depth, to the left of its direction \[m\].
    pub(super) offset: f64,
    /// Depths at which the stress jumps or has a kink: interfaces and rows of residual stress \[m\].
    pub(super) breaks: Vec<f64>,
    /// Nearest sample to the mouth \[m\].
    pub(super) nearest: f64,
    /// By x, z and layer: the stresses of each state.
    pub(super) known: HashMap<(u64, u64, usize), Vec<[PlaneStress; GRIDS]>>,
}

/// Samples along a crack.
pub(super) struct Line {
    parts: Vec<Part>,
}

/// Samples in one layer on one piece of a crack.
struct Part {
    /// Distances from the mouth \[m\], evenly spaced in their logarithm.
    s: Vec<f64>,
    layer: usize,
    /// By distance: the stresses of each state.
    stress: Vec<Vec<[PlaneStress; GRIDS]>>,
}

impl Along<'_> {
    /// The stress along a path, and along its parts from the mouth on.
    pub(super) fn on(&mut self, path: &Path) -> Result<Line, Error> {
        let mut parts = self.parts(path);
        let keys: Vec<Vec<_>> = parts
            .iter()
            .map(|part| {
                part.s
                    .iter()
                    .map(|s| self.key(path, *s, part.layer))
                    .collect()
            })
            .collect();
        let mut unknown: Vec<_> = keys
            .iter()
            .flatten()
            .filter(|(key, _)| !self.known.contains_key(key))
            .collect();
        unknown.sort_unstable_by_key(|(key, _)| *key);
        unknown.dedup_by_key(|(key, _)| *key);
        let (sin, cos) = self.azimuth.sin_cos();
        let place = |((r, _, layer), z): &&((u64, u64, usize), f64)| {
            let (r, layer) = (f64::from_bits(*r), *layer);
            let (x, y) = (r * cos - self.offset * sin, r * sin + self.offset * cos);
            (x, y, Depth { z: *z, layer })
        };
        let places: Vec<_> = unknown.iter().map(place).collect();
        let mut stresses = Vec::with_capacity(GRIDS);
        for (points, (X, Y)) in &self.points {
            let shifted = |&(x, y, depth): &(f64, f64, Depth)| (x - X, y - Y, depth);
            stresses.push(points.stress(&places.iter().map(shifted).collect::<Vec<_>>())?);
        }
        let sign = if self.side == Side::Body1 { -1.0 } else { 1.0 };
        // In body 1 in the frame of x and its own depth.
        let plane = |s: &[f64; 6]| {
            let along = cos * cos * s[0] + 2.0 * cos * sin * s[3] + sin * sin * s[1];
            [along, s[2], sign * (cos * s[4] + sin * s[5])]
        };
        for (n, (key, _)) in unknown.iter().enumerate() {
            let of_state =
                |state: usize| std::array::from_fn(|grid| plane(&stresses[grid][state][n]));
            let states = (0..stresses[0].len()).map(of_state);
            self.known.insert(*key, states.collect());
        }
        for (part, keys) in parts.iter_mut().zip(keys) {
            part.stress = keys
                .iter()
                .map(|(key, _)| self.known[key].clone())
                .collect();
        }
        Ok(Line { parts })
    }

    /// What a place is known by, and its depth, which rounding does not take out of the layer.
    fn key(&self, path: &Path, s: f64, layer: usize) -> ((u64, u64, usize), f64) {
        let at = path.at(s);
        let bottoms = self.body.interfaces();
        let top = layer.checked_sub(1).map_or(0.0, |n| bottoms[n]);
        let bottom = bottoms.get(layer).copied().unwrap_or(f64::INFINITY);
        let z = at.z.clamp(top, bottom);
        ((at.x.to_bits(), z.to_bits(), layer), z)
    }

    /// The parts of a path.
    fn parts(&self, path: &Path) -> Vec<Part> {
        let bottoms = self.body.interfaces();
        let mut ends = path.ends();
        ends.extend(self.breaks.iter().flat_map(|z| path.crossings(*z)));
        ends.sort_unstable_by(f64::total_cmp);
        let mut parts = Vec::new();
        let mut start = self.nearest;
        for end in ends {
            if end <= start {
                continue;
            }
            let steps = ((end / start).ln() / STEP).ceil().max(SAMPLES as f64 - 1.0);
            let ratio = (end / start).powf(1.0 / steps);
            let middle = path.at((start * end).sqrt()).z;
            parts.push(Part {
                s: (0..=steps as i32).map(|n| start * ratio.powi(n)).collect(),
                layer: bottoms.iter().filter(|z| **z < middle).count(),
                stress: Vec::new(),
            });
            start = end;
        }
        parts
    }
}

impl Line {
    /// How many states there are.
    pub(super) fn states(&self) -> usize {
        let first = self.parts.first().and_then(|part| part.stress.first());
        first.map_or(0, Vec::len)
    }

    /// The stress of a state at points of the crack, by tractions on the cells of one of [`GRIDS`]:
    /// constant from the first sample to the mouth.
    pub(super) fn stress(&self, grid: usize, state: usize, points: &[Point]) -> Vec<PlaneStress> {
        let last = self.parts.len() - 1;
        let at = |point: &Point| {
            let holds = |part: &Part| point.s <= part.s[part.s.len() - 1];
            let part = &self.parts[self.parts.iter().position(holds).unwrap_or(last)];
            part.interpolated(grid, state, point.s)
        };
        points.iter().map(at).collect()
    }
}

impl Part {
    /// Lagrange's polynomial in ln(s) through the nearest samples.
    fn interpolated(&self, grid: usize, state: usize, at: f64) -> PlaneStress {
        let last = self.s.len() - 1;
        let ratio = (self.s[last] / self.s[0]).ln() / last as f64;
        let u = ((at / self.s[0]).ln() / ratio).clamp(0.0, last as f64);
        let first = (u as usize + 1)
            .saturating_sub(SAMPLES / 2)
            .min(self.s.len() - SAMPLES);
        let mut sum = [0.0; 3];
        for k in first..first + SAMPLES {
            let others = (first..first + SAMPLES).filter(|j| *j != k);
            let weight: f64 = others
                .map(|j| (u - j as f64) / (k as f64 - j as f64))
                .product();
            let stress = self.stress[k][state][grid];
            for (sum, value) in sum.iter_mut().zip(stress) {
                *sum += weight * value;
            }
        }
        sum
    }
}
