//! The stress of the body without the crack along the lines of cracks.
//!
//! It is sampled at distances that grow with that from the mouth; between them it is interpolated
//! over the logarithm of the distance, part by part: a part lies in one layer, between two rows of its
//! residual stress and between two ends of pieces of the crack, so that the stress is smooth on it. No place is asked for twice.
//!
//! Changes of the stress, by larger cells or by another place of the mouth, are errors. They are
//! sampled at every third of these distances.

use std::collections::HashMap;

use contact_core::Error;
use contact_core::scene::Body;
use contact_core::stop::unless;
use contact_subsurface::{Depth, Side};
use fracture::{Path, PlaneStress, Point};

use super::prepared::{Cells, Prepared};

/// Step of ln(distance from the mouth) between samples.
pub(super) const STEP: f64 = 0.15;
/// Samples that an interpolation takes.
const SAMPLES: usize = 6;
/// Distances from a sample of a change to the next one, in samples.
const SPARSE: usize = 3;
/// Samples whose stress is computed between two looks at an interruption.
const AT_ONCE: usize = 24;

/// The stress below a contact where cracks run, in one plane.
pub(super) struct Along<'a> {
    pub(super) contact: &'a Prepared,
    /// Angle of the plane of the cracks about the axis of depth, from the x axis \[rad\].
    pub(super) azimuth: f64,
    /// Distance of that plane from the axis of depth, to the left of its direction \[m\].
    pub(super) offset: f64,
    /// Nearest sample to the mouth \[m\].
    pub(super) nearest: f64,
    /// Step of ln(distance from the mouth) between samples.
    pub(super) step: f64,
    /// By x, z, layer and cells: the stresses of each state.
    pub(super) known: HashMap<Key, Vec<PlaneStress>>,
}

/// Bits of x and z, layer, and cells of the tractions.
type Key = ((u64, u64, usize), Cells);

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
    stress: Vec<Vec<PlaneStress>>,
}

/// The samples around a point of a crack, and their weights.
pub(super) struct Stencil {
    part: usize,
    first: usize,
    weights: [f64; SAMPLES],
}

impl Prepared {
    /// Prepares the stress in the vertical plane at an azimuth and an offset from the axis, in which cracks
    /// run. Samples start at the distance `nearest` \[m\] from the mouth, and `step` is their step in ln(s).
    pub(super) fn stress_in_plane(
        &self,
        (azimuth, offset): (f64, f64),
        nearest: f64,
        step: f64,
    ) -> Result<Along<'_>, Error> {
        if self.grid.plane_strain && azimuth != 0.0 {
            let allowed = "0 in plane strain, where cracks run along y";
            return Err(Error::invalid("azimuth", azimuth, allowed));
        }
        if !azimuth.is_finite() {
            return Err(Error::invalid("azimuth", azimuth, "a finite angle in rad"));
        }
        if !offset.is_finite() {
            return Err(Error::invalid("offset", offset, "a finite distance in m"));
        }
        Ok(Along {
            contact: self,
            azimuth,
            offset,
            nearest,
            step,
            known: HashMap::new(),
        })
    }
}

impl Along<'_> {
    /// Computes the stress of all states along a path, by the tractions on `cells`.
    pub(super) fn sample_path(&mut self, path: &Path, cells: Cells) -> Result<Line, Error> {
        self.sampled(self.parts(path), path, cells)
    }

    /// The change of the stress along a path by tractions on other cells.
    pub(super) fn change_by_cells(
        &mut self,
        line: &Line,
        path: &Path,
        cells: Cells,
    ) -> Result<Line, Error> {
        let changed = self.sampled(line.sparse(), path, cells)?;
        Ok(changed.minus(line))
    }

    /// The change of the stress along a path whose mouth moves to `mouth` \[m\].
    pub(super) fn change_by_mouth(
        &mut self,
        line: &Line,
        path: &Path,
        mouth: f64,
    ) -> Result<Line, Error> {
        let moved = Path {
            mouth,
            legs: path.legs.clone(),
        };
        let changed = self.sampled(line.sparse(), &moved, Cells::Grid)?;
        Ok(changed.minus(line))
    }

    /// Fills parts of a path with the stress at their samples.
    fn sampled(&mut self, mut parts: Vec<Part>, path: &Path, cells: Cells) -> Result<Line, Error> {
        let keys: Vec<Vec<(Key, f64)>> = parts
            .iter()
            .map(|part| {
                let key = |s: &f64| self.key(path, *s, part.layer, cells);
                part.s.iter().map(key).collect()
            })
            .collect();
        let mut unknown: Vec<_> = keys
            .iter()
            .flatten()
            .filter(|(key, _)| !self.known.contains_key(key))
            .collect();
        unknown.sort_unstable_by_key(|(key, _)| *key);
        unknown.dedup_by_key(|(key, _)| *key);
        for some in unknown.chunks(AT_ONCE) {
            self.compute(some, cells)?;
        }
        for (part, keys) in parts.iter_mut().zip(keys) {
            let stress = keys.iter().map(|(key, _)| self.known[key].clone());
            part.stress = stress.collect();
        }
        Ok(Line { parts })
    }

    /// Computes and keeps the stress of each state at places (key and depth) that are not known yet.
    fn compute(&mut self, places: &[&(Key, f64)], cells: Cells) -> Result<(), Error> {
        unless(&self.contact.stop)?;
        let (sin, cos) = self.azimuth.sin_cos();
        let (points, (X, Y)) = &*self.contact.points(cells)?;
        let to_point = |(((r, _, layer), _), z): &&(Key, f64)| {
            let (r, layer) = (f64::from_bits(*r), *layer);
            let (x, y) = (r * cos - self.offset * sin, r * sin + self.offset * cos);
            (x - X, y - Y, Depth { z: *z, layer })
        };
        let stresses = points.stress(&places.iter().map(to_point).collect::<Vec<_>>())?;
        let side = self.contact.side;
        let sign = if side == Side::Body1 { -1.0 } else { 1.0 };
        // In body 1 in the frame of x and its own depth.
        let plane = |s: &[f64; 6]| {
            let along = cos * cos * s[0] + 2.0 * cos * sin * s[3] + sin * sin * s[1];
            [along, s[2], sign * (cos * s[4] + sin * s[5])]
        };
        for (n, (key, _)) in places.iter().enumerate() {
            let of_states = stresses.iter().map(|of_state| plane(&of_state[n]));
            self.known.insert(*key, of_states.collect());
        }
        Ok(())
    }

    /// The body that is cracked.
    fn body(&self) -> &Body {
        &self.contact.body
    }

    /// The key under which the stress at the distance s is kept, and the depth there \[m\], which rounding does
    /// not take out of the layer.
    fn key(&self, path: &Path, s: f64, layer: usize, cells: Cells) -> (Key, f64) {
        let at = path.at(s);
        let bottoms = self.body().interfaces();
        let top = layer.checked_sub(1).map_or(0.0, |n| bottoms[n]);
        let bottom = bottoms.get(layer).copied().unwrap_or(f64::INFINITY);
        let z = at.z.clamp(top, bottom);
        (((at.x.to_bits(), z.to_bits(), layer), cells), z)
    }

    /// Divides a path into parts, each in one leg and one layer.
    fn parts(&self, path: &Path) -> Vec<Part> {
        let bottoms = self.body().interfaces();
        let mut ends = path.ends();
        let breaks = self.contact.breaks.iter();
        ends.extend(breaks.flat_map(|z| path.crossings(*z)));
        ends.sort_unstable_by(f64::total_cmp);
        let mut parts = Vec::new();
        let mut start = self.nearest;
        for end in ends {
            if end <= start {
                continue;
            }
            let fewest = SAMPLES - 1;
            let steps = ((end / start).ln() / self.step).ceil().max(fewest as f64) as usize;
            let steps = if steps < SPARSE * fewest {
                steps
            } else {
                steps.next_multiple_of(SPARSE)
            };
            let ratio = (end / start).powf(1.0 / steps as f64);
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

    /// For points of a crack, the samples around them with their weights.
    pub(super) fn stencils(&self, points: &[Point]) -> Vec<Stencil> {
        let last = self.parts.len() - 1;
        let around = |point: &Point| {
            let holds = |part: &Part| point.s <= part.s[part.s.len() - 1];
            let part = self.parts.iter().position(holds).unwrap_or(last);
            let (first, weights) = self.parts[part].weights(point.s);
            Stencil {
                part,
                first,
                weights,
            }
        };
        points.iter().map(around).collect()
    }

    /// The stress of a state at points of the crack: constant from the first sample to the mouth.
    pub(super) fn stress(&self, state: usize, points: &[Stencil]) -> Vec<PlaneStress> {
        let at = |point: &Stencil| {
            let samples = &self.parts[point.part].stress[point.first..];
            let mut sum = [0.0; 3];
            for (weight, sample) in point.weights.iter().zip(samples) {
                for (sum, value) in sum.iter_mut().zip(sample[state]) {
                    *sum += weight * value;
                }
            }
            sum
        };
        points.iter().map(at).collect()
    }

    /// Keeps every [`Part::stride`]th sample, without stress: the samples at which a change is computed.
    fn sparse(&self) -> Vec<Part> {
        let thinned = |part: &Part| Part {
            s: part.s.iter().step_by(part.stride()).copied().collect(),
            layer: part.layer,
            stress: Vec::new(),
        };
        self.parts.iter().map(thinned).collect()
    }

    /// The difference of two lines with the same distances of samples.
    fn minus(mut self, line: &Self) -> Self {
        for (part, other) in self.parts.iter_mut().zip(&line.parts) {
            let others = other.stress.iter().step_by(other.stride());
            for (states, others) in part.stress.iter_mut().zip(others) {
                for (stress, other) in states.iter_mut().zip(others) {
                    stress.iter_mut().zip(other).for_each(|(s, o)| *s -= o);
                }
            }
        }
        self
    }
}

impl Part {
    /// The step, in samples, between the places at which the change of the stress by the crack is computed.
    fn stride(&self) -> usize {
        let steps = self.s.len() - 1;
        if steps.is_multiple_of(SPARSE) && steps >= SPARSE * (SAMPLES - 1) {
            SPARSE
        } else {
            1
        }
    }

    /// Index of the first of the samples nearest to a distance, and weights of Lagrange's polynomial in ln(s)
    /// through them.
    fn weights(&self, at: f64) -> (usize, [f64; SAMPLES]) {
        let last = self.s.len() - 1;
        let ratio = (self.s[last] / self.s[0]).ln() / last as f64;
        let u = ((at / self.s[0]).ln() / ratio).clamp(0.0, last as f64);
        let first = (u as usize + 1)
            .saturating_sub(SAMPLES / 2)
            .min(self.s.len() - SAMPLES);
        let weights = std::array::from_fn(|k| {
            let k = first + k;
            let others = (first..first + SAMPLES).filter(|j| *j != k);
            others
                .map(|j| (u - j as f64) / (k as f64 - j as f64))
                .product()
        });
        (first, weights)
    }
}
