//! The largest value of a number in a whole body below a contact.
//!
//! The ascent starts from samples on a section through the contact, on the section across it, on
//! the surface and on both sides of every interface, below the highest asperities, and from the rim
//! of the contact. The ascent from the highest sample is free in all three directions. If the
//! samples of a layer still rise at their end, its section is made longer. If the samples of the
//! substrate rise at the deepest of them, its section is made deeper. This is possible since the
//! tractions are known, so the field is known beyond the grid.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use ndarray::{Array1, Array2, Array3, ArrayRef, ArrayView2, Axis, Dimension};

use super::climb::Start;
use super::depth::interface_mask;
use super::maximum::{Top, top_of_line, top_of_plane};
use super::peaks::pressure_peaks;
use super::search::{Search, hills_left_out, select_hills};
use super::{Border, Depth, Extremum, Line, Measure, Point, Probe, Section, Side, Slices, States};
use contact_core::Error;
use contact_core::scene::{Body, Grid};
use contact_core::zones::Outline;

/// How far beyond the grid a section is made longer, over the length of the grid, and the ratio of
/// the distances of successive samples from its end, the first a cell from it.
const LONGER: f64 = 8.0;
const RATIO: f64 = 1.8;
/// Most depths of a layer at which its section is made longer: the ascent finds the maxima between
/// them.
const ROWS: usize = 4;
/// How much deeper the substrate is sampled than the given depths, the ratio of successive depths,
/// and the part of its highest sample that those at the deepest must reach.
const DEEPER: f64 = 8.0;
const DOWN: f64 = 1.2;
const HIGH: f64 = 0.8;
/// Samples rise at the end of a line if they do so there above this part of the highest of the
/// layer.
const MIN_RISING_PART: f64 = 0.05;

/// A largest value, and the layers whose samples still rise at the end of the longest section.
pub struct BodyMaximum {
    /// The largest value; `None` if all samples are NaN, or if all are negative and still rise at
    /// the end of the longest section: such a number has no largest value near the contact.
    pub largest: Option<Extremum>,
    /// Layers from the surface down.
    pub still_rises: Vec<usize>,
}

/// A body under the first of some states.
#[derive(Clone, Copy)]
pub struct Loads<'a> {
    /// The body.
    pub body: &'a Body,
    /// The body, upper or lower.
    pub side: Side,
    /// The grid of the tractions.
    pub grid: &'a Grid,
    /// The states.
    pub states: &'a States<'a>,
}

/// Change of the stress from a sample to the next, over the largest, below which it is even.
const FLAT: f64 = 1e-3;

/// Samples of a layer on a line.
struct LineSamples {
    line: Line,
    depths: Vec<Depth>,
    /// The depths on an interface.
    on_interface: Vec<bool>,
    along: Vec<f64>,
    values: Array2<f64>,
}

/// The search for largest values in a body below a contact, prepared for any measure of stress.
///
/// The section across, the planes and the points under the tractions are computed once.
pub struct BodySearch {
    body: Body,
    grid: Grid,
    line: Line,
    depths: Vec<Depth>,
    search: Search,
    /// Samples beside the section, if the whole body is searched.
    beside: Option<Beside>,
}

/// Samples beside the section, of the six stresses.
struct Beside {
    /// The line across the section, and the section below it.
    across: Line,
    section: Section,
    slices: Slices,
    /// The search on the line of the section.
    on_line: Search,
    /// Whether the line across passes the highest sample of the measure, for want of a contact.
    follows_samples: bool,
    /// The places of the highest asperities.
    asperities: Vec<[f64; 2]>,
    /// Stress across by layer, and planes by the number of their depth.
    sections: Mutex<HashMap<usize, Arc<Array3<f64>>>>,
    planes: Mutex<HashMap<usize, Arc<[Array2<f64>; 6]>>>,
}

impl BodySearch {
    /// Prepares the search in the whole body if `free`, else on the section below `line`.
    ///
    /// `samples` are values at the `depths` of the line, of shape (depths, places).
    pub fn new(
        loads: Loads<'_>,
        (line, free): (Line, bool),
        (depths, samples): (&[Depth], &ArrayView2<'_, f64>),
    ) -> Result<Self, Error> {
        let Loads {
            body,
            side,
            grid,
            states,
        } = loads;
        let free = free && !grid.plane_strain && grid.ny > 1;
        let (search, beside) = if free {
            let search = Search::free(body, side, grid, line, states)?;
            let first_tractions = states.tractions.first().copied().unwrap_or_default();
            let outline = Outline::new(grid, &first_tractions);
            let follows_samples = outline.is_none();
            // Without tractions, as of a residual stress, the section across passes the highest sample.
            let middle = outline.map_or_else(
                || line.place(highest_place(line, grid, samples)),
                |outline| line.place(line.nearest_distance(outline.centre.0, outline.centre.1)),
            );
            let across = Line::through(middle, line.azimuth() + RIGHT_ANGLE);
            let beside = Beside {
                across,
                section: Section::new(body, side, grid, across, states.clone())?,
                slices: Slices::new(body, side, grid, states.clone())?,
                on_line: search.on_line(line),
                follows_samples,
                asperities: first_tractions
                    .p
                    .map_or_else(Vec::new, |p| pressure_peaks(grid, p)),
                sections: Mutex::default(),
                planes: Mutex::default(),
            };
            (search, Some(beside))
        } else {
            (Search::new(body, side, grid, Some(line), states)?, None)
        };
        Ok(Self {
            body: body.clone(),
            grid: *grid,
            line,
            depths: depths.to_vec(),
            search,
            beside,
        })
    }

    /// Whether the search serves any measure, not the measure of its samples alone.
    pub fn serves_all_measures(&self) -> bool {
        self.beside
            .as_ref()
            .is_none_or(|beside| !beside.follows_samples)
    }

    /// Finds the largest value of a measure, in one `layer` if given, from its `samples` on the section.
    #[expect(clippy::too_many_lines, reason = "the search, step by step")]
    pub fn find(
        &self,
        measure: &Measure,
        samples: &ArrayView2<'_, f64>,
        layer: Option<usize>,
    ) -> Result<BodyMaximum, Error> {
        let (grid, line, depths) = (&self.grid, self.line, &self.depths[..]);
        let probe = Probe::Stress(*measure);
        let mut layers: Vec<usize> = depths.iter().map(|d| d.layer).collect();
        layers.dedup();
        layers.retain(|n| layer.is_none_or(|layer| layer == *n));
        let mut sampled = Vec::new();
        let interface_mask = interface_mask(depths);
        for n in &layers {
            let rows: Vec<usize> = (0..depths.len())
                .filter(|k| depths[*k].layer == *n)
                .collect();
            sampled.push(LineSamples {
                line,
                depths: rows.iter().map(|k| depths[*k]).collect(),
                on_interface: rows.iter().map(|k| interface_mask[*k]).collect(),
                along: line.places(grid),
                values: samples.select(Axis(0), &rows),
            });
        }
        if let Some(beside) = &self.beside {
            for n in 0..layers.len() {
                let layer_depths = sampled[n].depths.clone();
                let stress = beside.stress_across(layers[n], &layer_depths)?;
                sampled.push(LineSamples {
                    line: beside.across,
                    depths: layer_depths,
                    on_interface: sampled[n].on_interface.clone(),
                    along: beside.across.places(grid),
                    values: measure.on_lines(&stress),
                });
            }
        }
        let search = &self.search;
        let mut still_rises = Vec::new();
        let mut reached = depths.to_vec();
        for sampled_line in &mut sampled {
            let longer = sampled_line.extend_along(search, grid, measure)?;
            let substrate = sampled_line.depths[0].layer == self.body.coatings.len();
            let deeper = substrate && sampled_line.extend_down(search, measure)?;
            if longer || deeper {
                let layer = sampled_line.depths[0].layer;
                still_rises.push((layer, largest_sample(&sampled_line.values)));
            }
            let deepest = reached.last().map_or(0.0, |depth| depth.z);
            reached.extend(sampled_line.depths.iter().filter(|depth| depth.z > deepest));
        }
        let mut starts: Vec<Start> = Vec::new();
        for sampled_line in &sampled {
            starts.extend(sampled_line.starts(search, &probe, layer, self.beside.is_some()));
        }
        let mut surface = None;
        if let Some(beside) = &self.beside {
            let (x, y) = (
                Line::AlongX(0.0).places(grid),
                Line::AlongY(0.0).places(grid),
            );
            for (n, (depth, on_one)) in depths.iter().zip(interface_mask).enumerate() {
                let is_searched = layer.is_none_or(|layer| layer == depth.layer);
                // The stresses that act on an interface are the same on both sides.
                let is_repeated = measure.on_interfaces
                    && layer.is_none()
                    && n > 0
                    && depths[n - 1].z.total_cmp(&depth.z).is_eq();
                if is_repeated
                    || !is_searched
                    || !(on_one || depth.z <= 0.0)
                    || (measure.on_interfaces && !on_one)
                {
                    continue;
                }
                let planes = beside.stress_on_plane(n, *depth)?;
                let plane = Array2::from_shape_fn((grid.nx, grid.ny), |cell| {
                    (measure.value)(&planes.each_ref().map(|component| component[cell]))
                });
                starts.extend(top_of_plane(&plane, &x, &y).map(|top| {
                    // Off its interface a measure of interfaces has no meaning.
                    let step = if measure.on_interfaces {
                        0.0
                    } else {
                        depth_step(depths, *depth)
                    };
                    search.start_at(top.place, *depth, step)
                }));
                if depth.z <= 0.0 {
                    surface = Some(plane);
                }
            }
        }
        if let Some(beside) = &self.beside
            && !measure.on_interfaces
        {
            for depth in depths.iter().filter(|depth| layers.contains(&depth.layer)) {
                let step = depth_step(depths, *depth);
                let start = |place: &[f64; 2]| search.start_at(*place, *depth, step);
                starts.extend(beside.asperities.iter().map(start));
            }
        }
        let near = |border: &Border| {
            if let Some(plane) = &surface {
                let cell = |v: f64, n: usize, d: f64| {
                    let index = (v / d + (n - 1) as f64 / 2.0).round();
                    index.clamp(0.0, (n - 1) as f64) as usize
                };
                return plane[(
                    cell(border.x, grid.nx, grid.dx),
                    cell(border.y, grid.ny, grid.dy),
                )];
            }
            let along = line.places(grid);
            let s = line.nearest_distance(border.x, border.y);
            let nearest = (0..along.len())
                .min_by(|&a, &b| (along[a] - s).abs().total_cmp(&(along[b] - s).abs()));
            nearest.map_or(f64::NAN, |n| samples[(0, n)])
        };
        let mut largest = search.ascend(&probe, starts, &reached, layer, &near)?;
        if let Some(value) = largest.map(|top| top.value) {
            let free = self.beside.is_some();
            let left_out =
                |line: &LineSamples| line.starts_left_out(search, &probe, (layer, free), value);
            let others: Vec<Start> = sampled.iter().flat_map(left_out).collect();
            if !others.is_empty() {
                let other = search.ascend(&probe, others, &reached, layer, &near)?;
                let tops = largest.into_iter().chain(other);
                largest = tops.max_by(|a, b| a.value.total_cmp(&b.value));
            }
        }
        if let Some(Beside { on_line, .. }) = &self.beside {
            // A narrow ridge along the section is followed on it to its top.
            let mut starts: Vec<Start> = Vec::new();
            for sampled_line in sampled
                .iter()
                .filter(|sampled_line| sampled_line.line == line)
            {
                starts.extend(sampled_line.starts(on_line, &probe, layer, false));
            }
            let on_line = on_line.ascend(&probe, starts, &reached, layer, &near)?;
            largest = match (largest, on_line) {
                (Some(free), Some(on_line)) if on_line.value > free.value => Some(on_line),
                (free, on_line) => free.or(on_line),
            };
        }
        // A layer with negative samples alone rises to 0, far below a positive value elsewhere.
        let is_positive = largest.is_some_and(|top| top.value >= 0.0);
        still_rises.retain(|(_, top)| *top >= 0.0 || !is_positive);
        let mut still_rises: Vec<usize> = still_rises.into_iter().map(|(layer, _)| layer).collect();
        still_rises.sort_unstable();
        still_rises.dedup();
        largest = largest.filter(|top| top.value >= 0.0 || !still_rises.contains(&top.depth.layer));
        Ok(BodyMaximum {
            largest,
            still_rises,
        })
    }
}

impl Beside {
    /// The stress on the section across, at the depths of a layer.
    fn stress_across(&self, layer: usize, depths: &[Depth]) -> Result<Arc<Array3<f64>>, Error> {
        keep(&self.sections, layer, || {
            Ok(self.section.stress(depths)?.swap_remove(0))
        })
    }

    /// The stress on the plane at a depth.
    fn stress_on_plane(&self, number: usize, depth: Depth) -> Result<Arc<[Array2<f64>; 6]>, Error> {
        keep(&self.planes, number, || {
            Ok(self.slices.stress(depth)?.swap_remove(0))
        })
    }
}

/// The value with a key, computed where it is not kept.
fn keep<T>(
    kept: &Mutex<HashMap<usize, Arc<T>>>,
    key: usize,
    compute: impl FnOnce() -> Result<T, Error>,
) -> Result<Arc<T>, Error> {
    let lock = || kept.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(value) = lock().get(&key) {
        return Ok(value.clone());
    }
    let value = Arc::new(compute()?);
    lock().insert(key, value.clone());
    Ok(value)
}

/// The place of the largest sample of a section \[m\].
fn highest_place(line: Line, grid: &Grid, samples: &ArrayView2<'_, f64>) -> f64 {
    let numbers = samples.indexed_iter().filter(|(_, value)| !value.is_nan());
    let highest = numbers.max_by(|a, b| a.1.total_cmp(b.1));
    highest.map_or(0.0, |((_, n), _)| line.places(grid)[n])
}

const RIGHT_ANGLE: f64 = std::f64::consts::FRAC_PI_2;

/// Distance to the next depth of the layer \[m\]; 0 without one.
fn depth_step(depths: &[Depth], at: Depth) -> f64 {
    let others = depths
        .iter()
        .filter(|d| d.layer == at.layer && d.z != at.z)
        .map(|d| (d.z - at.z).abs());
    let nearest = others.fold(f64::INFINITY, f64::min);
    if nearest.is_finite() { nearest } else { 0.0 }
}

/// The largest of some samples that is a number; minus infinity without one.
fn largest_sample<D: Dimension>(samples: &ArrayRef<f64, D>) -> f64 {
    let numbers = samples.iter().filter(|v| !v.is_nan());
    numbers.copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The value that lies below the largest by all but a part of its size: below 0 a largest value is
/// small where the samples are everywhere negative.
fn level(part: f64, largest: f64) -> f64 {
    largest - (1.0 - part) * largest.abs()
}

impl LineSamples {
    /// Starting points of the ascent, on the hills of the samples in a layer, or in all; `free` to leave the
    /// plane of the line.
    fn starts(
        &self,
        search: &Search,
        probe: &Probe,
        layer: Option<usize>,
        free: bool,
    ) -> Vec<Start> {
        let depths = (&self.depths[..], &self.on_interface[..]);
        let hills = select_hills(probe, &self.tops(), depths, layer);
        let starts_on_hill = |hill| search.starts(self.line, hill, &self.along, free);
        hills.iter().flat_map(starts_on_hill).collect()
    }

    /// Starting points on the other hills whose samples exceed a `value`.
    fn starts_left_out(
        &self,
        search: &Search,
        probe: &Probe,
        (layer, free): (Option<usize>, bool),
        value: f64,
    ) -> Vec<Start> {
        let depths = (&self.depths[..], &self.on_interface[..]);
        let hills = hills_left_out(probe, &self.tops(), depths, layer, value);
        let starts_on_hill = |hill| search.starts(self.line, hill, &self.along, free);
        hills.iter().flat_map(starts_on_hill).collect()
    }

    /// The highest sample of each depth.
    fn tops(&self) -> Vec<Option<Top<1>>> {
        let rows = self.values.rows().into_iter();
        rows.map(|row| top_of_line(&row, &self.along)).collect()
    }

    /// Adds deeper and deeper samples, while the largest values lie at the deepest depth and rise by more than
    /// [`FLAT`] from the depth above. Returns true if they still rise at the limit.
    fn extend_down(&mut self, search: &Search, measure: &Measure) -> Result<bool, Error> {
        let (Some(last), false) = (self.depths.last().copied(), measure.on_interfaces) else {
            return Ok(false);
        };
        let limit = DEEPER * last.z;
        let mut depth = last;
        loop {
            let tops: Vec<f64> = self
                .values
                .rows()
                .into_iter()
                .map(|row| largest_sample(&row))
                .collect();
            let [.., before, deepest] = tops[..] else {
                return Ok(false);
            };
            let top = largest_sample(&self.values);
            if top == f64::NEG_INFINITY
                || deepest < level(HIGH, top)
                || deepest - before <= FLAT * top.abs()
            {
                return Ok(false);
            }
            depth.z *= DOWN;
            if depth.z > limit {
                return Ok(true);
            }
            let points: Vec<Point> = self
                .along
                .iter()
                .map(|s| self.line.point(*s, depth))
                .collect();
            let stress = search.points.stress(&points)?.swap_remove(0);
            let row: Array1<f64> = stress.iter().map(measure.value).collect();
            self.values
                .push_row(row.view())
                .expect("a value for each place");
            self.depths.push(depth);
            self.on_interface.push(false);
        }
    }

    /// The depths at which the samples rise towards an end of the line, [`ROWS`] of them at most.
    fn rising_depths(&self) -> Vec<usize> {
        let top = largest_sample(&self.values);
        let rises = |row: &usize| {
            let row = self.values.row(*row);
            let n = row.len();
            let ends = [(0, 1), (n - 1, n.saturating_sub(2))];
            n > 2
                && ends.into_iter().any(|(end, next)| {
                    row[end] > level(MIN_RISING_PART, top) && row[end] > row[next]
                })
        };
        let rows: Vec<usize> = (0..self.depths.len()).filter(rises).collect();
        let count = ROWS.min(rows.len());
        let evenly_spaced = |n: usize| rows[n * (rows.len() - 1) / (count - 1).max(1)];
        (0..count).map(evenly_spaced).collect()
    }

    /// Extends the line beyond its ends at the depths at which the samples rise, with growing
    /// steps. Returns true if some still rise at the new ends.
    fn extend_along(
        &mut self,
        search: &Search,
        grid: &Grid,
        measure: &Measure,
    ) -> Result<bool, Error> {
        let rising = self.rising_depths();
        let (Some(first), Some(last)) = (self.along.first(), self.along.last()) else {
            return Ok(false);
        };
        if rising.is_empty() {
            return Ok(false);
        }
        let step = self.line.step(grid);
        let count = ((LONGER * (last - first) / step).ln() / RATIO.ln()).ceil() as i32;
        let distances: Vec<f64> = (0..=count).map(|k| step * RATIO.powi(k)).collect();
        let before: Vec<f64> = distances.iter().rev().map(|by| first - by).collect();
        let after: Vec<f64> = distances.iter().map(|by| last + by).collect();
        let along = [before, std::mem::take(&mut self.along), after].concat();
        let original = distances.len()..along.len() - distances.len();
        let mut values = Array2::from_elem((self.depths.len(), along.len()), f64::NAN);
        for ((row, n), value) in self.values.indexed_iter() {
            values[(row, n + original.start)] = *value;
        }
        let places: Vec<usize> = (0..along.len()).filter(|n| !original.contains(n)).collect();
        let cells: Vec<(usize, usize)> = rising
            .iter()
            .flat_map(|row| places.iter().map(|n| (*row, *n)))
            .collect();
        let points: Vec<Point> = cells
            .iter()
            .map(|(row, n)| self.line.point(along[*n], self.depths[*row]))
            .collect();
        let stress = search.points.stress(&points)?.swap_remove(0);
        for (cell, stress) in cells.into_iter().zip(&stress) {
            values[cell] = (measure.value)(stress);
        }
        (self.along, self.values) = (along, values);
        Ok(self.is_largest_at_an_end())
    }

    /// Checks that the largest sample is at an end of the line and its neighbour is smaller by more
    /// than [`FLAT`] of it. The stress far from a contact under bulk stress is even.
    fn is_largest_at_an_end(&self) -> bool {
        let top = largest_sample(&self.values);
        self.values.rows().into_iter().any(|row| {
            let n = row.len();
            n > 2
                && [(0, 1), (n - 1, n - 2)]
                    .into_iter()
                    .any(|(end, next)| row[end] >= top && row[end] - row[next] > FLAT * top.abs())
        })
    }
}
