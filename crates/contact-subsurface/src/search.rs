//! The largest value of a number below a contact: a value at a point.
//!
//! Starting points are the local maxima of the samples (hills) and the places where rims and stick
//! borders cross the line. From the highest of these the search ascends ([`climb`]). No value is
//! extrapolated.

use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::{Body, Grid};
use ndarray::{Array2, ArrayView2, Axis};

use super::climb::{Start, climb, point_in_layer};
use super::coarser::CoarserCells;
use super::depth::interface_mask;
use super::maximum::{Hill, find_hills, top_of_line};
use super::{
    Border, Depth, Errors, Extremum, Line, Point, Points, Probe, Section, Side, States, Top, Zone,
};

/// Most hills and most places on borders that are evaluated.
const HILLS: usize = 3;
const BORDERS: usize = 6;
/// Hills below this part of the highest are not evaluated: the field between samples exceeds them
/// by little.
const LOWEST: f64 = 0.8;
/// First steps along x and y in cells, from a hill and from a border.
const STEP: f64 = 0.5;
const STEP_AT_BORDER: f64 = 0.25;
/// A point is on a border if it is at most this many cells from it.
const ON_BORDER: f64 = 0.1;
/// A point this many cells from a border and nearer is as far from it on larger cells.
const BESIDE_CELLS: f64 = 1.0;
/// A layer at the surface thinner than so many cells has its rim law within a few of them: as many
/// cells around a border the error of a value falls like the root of the cell, and is 1/(2^(1/2) -
/// 1) times the change to cells twice as large.
const RESOLVED: f64 = 4.0;
const ROOT_FACTOR: f64 = 1.0 + std::f64::consts::SQRT_2;
/// Factor at a rim to which the tractions are continued: 1/(2^(3/2) - 1) times the change to cells
/// twice as large. The first omitted term is the distance from the rim to the power of 3/2.
const CONTINUED_FACTOR: f64 = 0.547;

/// Looks for the largest values below a contact.
pub struct Search {
    pub(super) points: Arc<Points>,
    coarser: [CoarserCells; 2],
    borders: Vec<Border>,
    /// The line whose directions the ascent takes, along, across.
    line: Option<Line>,
    grid: Grid,
    d: (f64, f64),
    /// Whether the ascent leaves the line.
    free: bool,
    /// Whether there is one row of cells.
    flat: bool,
    /// Whether the layer at the surface is too thin for the cells ([`RESOLVED`]).
    thin: bool,
}

impl Search {
    /// Prepares a search in the whole body; its directions are along `line` and across it.
    pub(super) fn free(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Line,
        states: &States<'_>,
    ) -> Result<Self, Error> {
        let anywhere = Self::new(body, side, grid, None, states)?;
        let mut borders = anywhere.points.borders(0, Some(line));
        borders.extend(anywhere.borders);
        Ok(Self {
            line: Some(line),
            borders,
            free: true,
            ..anywhere
        })
    }

    /// The search on a line alone, by the same points.
    pub(super) fn on_line(&self, line: Line) -> Self {
        Self {
            borders: self.points.borders(0, Some(line)),
            coarser: self.coarser.each_ref().map(|coarser| coarser.on_line(line)),
            line: Some(line),
            free: false,
            points: self.points.clone(),
            ..*self
        }
    }

    /// Prepares a search in the body `side` under the first of the states: in the plane below `line`, or in the
    /// whole body without one.
    pub fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Option<Line>,
        states: &States<'_>,
    ) -> Result<Self, Error> {
        let first = [states.tractions.first().copied().unwrap_or_default()];
        let states = States {
            tractions: &first,
            eigenstress: states.eigenstress.get(..1).unwrap_or_default(),
            continuations: states.continuations.get(..1).unwrap_or_default(),
            ..states.clone()
        };
        let coarser = CoarserCells::new_pair(body, side, grid, line, &states)?;
        let points = Arc::new(Points::new(body, side, grid, states)?);
        let cell = if grid.ny == 1 {
            grid.dx
        } else {
            grid.dx.max(grid.dy)
        };
        let outermost = body.coatings.first();
        Ok(Self {
            thin: outermost.is_some_and(|layer| layer.thickness < RESOLVED * cell),
            borders: points.borders(0, line),
            coarser,
            points,
            line,
            grid: *grid,
            d: (grid.dx, grid.dy),
            flat: grid.ny == 1,
            free: line.is_none(),
        })
    }

    /// The largest value on a section, from its samples of shape (depths, places) at the places
    /// `along` the line \[m\]; in one `layer` if given. `None` if all samples are NaN.
    pub fn find_on_section(
        &self,
        probe: &Probe,
        samples: &ArrayView2<'_, f64>,
        (depths, along): (&[Depth], &[f64]),
        layer: Option<usize>,
    ) -> Result<Option<Extremum>, Error> {
        let Some(line) = self.line else {
            return Ok(None);
        };
        let lines = samples.rows().into_iter();
        let tops: Vec<_> = lines.map(|line| top_of_line(&line, along)).collect();
        let hills = select_hills(probe, &tops, (depths, &interface_mask(depths)), layer);
        let starts = hills
            .iter()
            .flat_map(|hill| self.starts(line, hill, along, false));
        let surface = samples.rows().into_iter().next();
        let near = |border: &Border| {
            let s = line.nearest_distance(border.x, border.y);
            let nearest = (0..along.len())
                .min_by(|&a, &b| (along[a] - s).abs().total_cmp(&(along[b] - s).abs()));
            nearest
                .zip(surface.as_ref())
                .map_or(f64::NAN, |(n, row)| row[n])
        };
        self.ascend(probe, starts.collect(), depths, layer, &near)
    }

    /// Two starting points on a hill of a section: the vertex of the parabolas and the largest sample. If
    /// `free`, the search may leave the plane of the line.
    pub(super) fn starts(
        &self,
        line: Line,
        hill: &Hill<1>,
        along: &[f64],
        free: bool,
    ) -> [Start; 2] {
        let Top {
            place,
            sample,
            sampled,
            ..
        } = hill.top;
        let across = if free && !self.flat {
            STEP * self.d.0.max(self.d.1)
        } else {
            0.0
        };
        let start = |s: f64, z: f64, known: Option<f64>| {
            let (x, y) = line.place(s);
            let [s, t] = self.to_frame(x, y);
            Start {
                place: [s, t, z],
                layer: hill.depth.layer,
                steps: [STEP * line.step(&self.grid), across, 0.5 * hill.step],
                known,
            }
        };
        [
            start(place[0], hill.depth.z, None),
            start(along[sample[0]], hill.sampled_z, Some(sampled)),
        ]
    }

    /// A starting point at x, y \[m\] and a depth; `step` is the distance to the next depth \[m\].
    pub(super) fn start_at(&self, [x, y]: [f64; 2], depth: Depth, step: f64) -> Start {
        let [s, t] = self.to_frame(x, y);
        let cell = STEP * self.d.0.max(self.d.1);
        Start {
            place: [s, t, depth.z],
            layer: depth.layer,
            steps: [cell, cell, 0.5 * step],
            known: None,
        }
    }

    /// Distances along the line of the search and to the left of it \[m\]; without a line x and y.
    fn to_frame(&self, x: f64, y: f64) -> [f64; 2] {
        self.line.map_or([x, y], |line| {
            let s = line.nearest_distance(x, y);
            let ((x_0, y_0), [cos, sin]) = (line.place(s), line.direction());
            [s, (y - y_0) * cos - (x - x_0) * sin]
        })
    }

    /// Inverse of [`Self::to_frame`].
    fn to_space(&self, (s, t, depth): Point) -> Point {
        let (x, y) = self.line.map_or((s, t), |line| line.offset_place(s, t));
        (x, y, depth)
    }

    /// The largest value in a volume, from the tops of the planes at its depths and the samples on
    /// the first of them, shape (nx, ny); in one `layer` if given. `None` if all samples are NaN.
    pub fn find_in_volume(
        &self,
        probe: &Probe,
        tops: &[Option<Top<2>>],
        surface: &Array2<f64>,
        depths: &[Depth],
        layer: Option<usize>,
    ) -> Result<Option<Extremum>, Error> {
        let (nx, ny) = surface.dim();
        let across = if self.flat { 0.0 } else { STEP * self.d.1 };
        let top_and_sample = |hill: &Hill<2>| {
            let Top {
                place: [x, y],
                sample: [i, j],
                sampled,
                ..
            } = hill.top;
            let middle = |i: usize, n: usize, d: f64| (i as f64 - (n - 1) as f64 / 2.0) * d;
            let sample = [
                middle(i, nx, self.d.0),
                middle(j, ny, self.d.1),
                hill.sampled_z,
            ];
            [([x, y, hill.depth.z], None), (sample, Some(sampled))].map(|(place, known)| Start {
                place,
                layer: hill.depth.layer,
                steps: [STEP * self.d.0, across, 0.5 * hill.step],
                known,
            })
        };
        let hills = select_hills(probe, tops, (depths, &interface_mask(depths)), layer);
        let starts = hills.iter().flat_map(top_and_sample).collect();
        let cell = |v: f64, n: usize, d: f64| {
            (v / d + (n - 1) as f64 / 2.0)
                .round()
                .clamp(0.0, (n - 1) as f64) as usize
        };
        let near =
            |border: &Border| surface[(cell(border.x, nx, self.d.0), cell(border.y, ny, self.d.1))];
        self.ascend(probe, starts, depths, layer, &near)
    }

    /// Ascends from the highest of the starts and, if the surface is included, of the borders.
    /// `near` gives the sample next to a border.
    pub(super) fn ascend(
        &self,
        probe: &Probe,
        mut starts: Vec<Start>,
        depths: &[Depth],
        layer: Option<usize>,
        near: &dyn Fn(&Border) -> f64,
    ) -> Result<Option<Extremum>, Error> {
        let at_surface = depths.first().is_some_and(|d| d.z <= 0.0 && d.layer == 0);
        if at_surface && layer.is_none_or(|layer| layer == 0) && !is_on_interfaces(probe) {
            starts.extend(self.border_starts(depths, near));
        }
        let values = |points: &[Point]| -> Result<Vec<f64>, Error> {
            let points: Vec<Point> = points.iter().map(|place| self.to_space(*place)).collect();
            match probe {
                Probe::Stress(m) => {
                    let stress = self.points.stress(&points)?.swap_remove(0);
                    Ok(stress.iter().map(m.value).collect())
                }
                Probe::Displacement(c) => {
                    let u = self.points.displacement(&points)?.swap_remove(0);
                    Ok(u.iter().map(|u| u[c.axis()]).collect())
                }
            }
        };
        let unknown = starts.iter().filter(|s| s.known.is_none());
        let points: Vec<Point> = unknown.map(|s| point_in_layer(s.place, s.layer)).collect();
        let mut start_values = values(&points)?.into_iter();
        let Some((start, value)) = starts
            .iter()
            .map(|start| {
                (
                    start,
                    start
                        .known
                        .or_else(|| start_values.next())
                        .unwrap_or(f64::NAN),
                )
            })
            .filter(|(_, value)| !value.is_nan())
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
        else {
            return Ok(None);
        };
        let of_layer = || {
            depths
                .iter()
                .filter(|d| d.layer == start.layer)
                .map(|d| d.z)
        };
        let bounds = (
            of_layer().fold(f64::INFINITY, f64::min),
            of_layer().fold(0.0, f64::max),
        );
        let (scene_point, value, remaining) = climb(&values, start, value, bounds)?;
        let framed = point_in_layer(scene_point, start.layer);
        let scene_point = self.to_space(framed);
        let border = self.border_within(scene_point, ON_BORDER);
        // Beside a border the stress follows the distance from it.
        let beside = self.border_within(scene_point, BESIDE_CELLS);
        // Under the rim of a thin layer the samples of an interface follow the cells of the border.
        let follows_steps =
            is_on_interfaces(probe) && self.thin && self.is_near_border(scene_point);
        // A border that was extrapolated is where it is, whatever the cells beside it.
        let rim_is_assumed = !border.is_some_and(|border| border.within_cell)
            && self.points.rim_is_unknown(scene_point);
        let uncertain = follows_steps || rim_is_assumed;
        let inwards = if uncertain {
            self.points_beside(framed)
        } else {
            Vec::new()
        };
        let inwards = values(&inwards)?.into_iter();
        let uncertain = inwards.map(|beside| (value - beside).abs());
        let uncertain = uncertain.fold(0.0, f64::max);
        let mut change = 0.0_f64;
        for coarser in &self.coarser {
            let coarse = match probe {
                Probe::Stress(m) => (m.value)(&coarser.stress(scene_point, beside.as_ref())?),
                Probe::Displacement(c) => {
                    coarser.displacement(scene_point.0, scene_point.1, scene_point.2)?[c.axis()]
                }
            };
            change = change.max((value - coarse).abs());
        }
        let rim = border.is_some_and(|border| border.zone == Zone::Contact);
        let part = if self.thin && self.is_near_border(scene_point) {
            ROOT_FACTOR
        } else if rim && !rim_is_assumed {
            CONTINUED_FACTOR
        } else {
            1.0
        };
        let extreme = Extremum {
            value,
            x: scene_point.0,
            y: scene_point.1,
            depth: scene_point.2,
            at: border.map(|b| b.zone),
            error: Errors {
                tractions: Some(part * change),
                ..Errors::from_search(
                    self.line.unwrap_or(Line::AlongX(0.0)),
                    [remaining[0].max(uncertain), remaining[1], remaining[2]],
                )
            },
        };
        let (length, width) = self.grid.extent();
        Ok(Some(extreme.snapped_to_zero(length.max(width))))
    }

    /// Starting points on the borders beside which the samples `near` them are largest.
    fn border_starts(&self, depths: &[Depth], near: &dyn Fn(&Border) -> f64) -> Vec<Start> {
        let mut by_sample: Vec<(f64, &Border)> = self
            .borders
            .iter()
            .map(|border| (near(border), border))
            .filter(|(sample, _)| !sample.is_nan())
            .collect();
        by_sample.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let below = depths.get(1).filter(|d| d.layer == 0).map_or(0.0, |d| d.z);
        let steps = match self.line {
            Some(line) => {
                let across = if self.free {
                    line.step(&self.grid)
                } else {
                    0.0
                };
                [line.step(&self.grid), across]
            }
            None => [self.d.0, if self.flat { 0.0 } else { self.d.1 }],
        };
        let start = |(_, border): &(f64, &Border)| {
            let [s, t] = self.to_frame(border.x, border.y);
            Start {
                place: [s, t, 0.0],
                layer: 0,
                steps: [
                    STEP_AT_BORDER * steps[0],
                    STEP_AT_BORDER * steps[1],
                    0.5 * below,
                ],
                known: None,
            }
        };
        by_sample
            .iter()
            .take(if self.free && self.line.is_some() {
                2 * BORDERS
            } else {
                BORDERS
            })
            .map(start)
            .collect()
    }

    /// The points half a cell before and behind a point along the line: the values there bound the effect of an
    /// uncertain rim.
    fn points_beside(&self, (s, t, depth): Point) -> Vec<Point> {
        let step = STEP * self.line.map_or(self.d.0, |line| line.step(&self.grid));
        [step, -step].map(|by| (s + by, t, depth)).into()
    }

    /// The nearest border, if it is within so many cells of a point along the surface and in depth.
    fn border_within(&self, at: Point, cells: f64) -> Option<Border> {
        let nearest = self.nearest_border(at);
        let within = nearest.filter(|(_, away)| away[0].max(away[1]) < cells);
        within.map(|(border, _)| border)
    }

    /// Whether a border is within [`RESOLVED`] cells.
    fn is_near_border(&self, at: Point) -> bool {
        self.border_within(at, RESOLVED).is_some()
    }

    /// The nearest border and the distances from it along the surface and in depth \[cells\].
    fn nearest_border(&self, (x, y, depth): Point) -> Option<(Border, [f64; 2])> {
        let cell = if self.flat {
            self.d.0
        } else {
            self.d.0.min(self.d.1)
        };
        let across = |v: f64| if self.flat { 0.0 } else { v / self.d.1 };
        let distance = |b: &Border| ((b.x - x) / self.d.0).hypot(across(b.y - y));
        let beside = self.points.borders_near(x, y);
        let borders = self.borders.iter().copied().chain(beside);
        let by_distance = borders.map(|b| (b, [distance(&b), depth.z / cell]));
        by_distance.min_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]))
    }
}

/// Whether the values of a probe on interfaces count.
fn is_on_interfaces(probe: &Probe) -> bool {
    matches!(probe, Probe::Stress(m) if m.on_interfaces)
}

/// The hills to ascend from, in one layer or in all, from the top of each depth. `on_interface` marks the
/// depths on an interface ([`interface_mask`]).
pub(super) fn select_hills<const D: usize>(
    probe: &Probe,
    tops: &[Option<Top<D>>],
    depths: (&[Depth], &[bool]),
    layer: Option<usize>,
) -> Vec<Hill<D>> {
    let mut hills = searched_hills(probe, tops, depths, layer);
    hills.truncate(count_selected(&hills));
    hills
}

/// The hills that [`select_hills`] leaves out though their samples exceed `value`: samples beside a rim
/// may be higher than what the ascent from them reaches.
pub(super) fn hills_left_out<const D: usize>(
    probe: &Probe,
    tops: &[Option<Top<D>>],
    depths: (&[Depth], &[bool]),
    layer: Option<usize>,
    value: f64,
) -> Vec<Hill<D>> {
    let mut hills = searched_hills(probe, tops, depths, layer);
    hills.drain(..count_selected(&hills));
    hills.retain(|hill| hill.top.value > value);
    hills.truncate(HILLS);
    hills
}

/// How many of the hills, the highest first, are ascended.
fn count_selected<const D: usize>(hills: &[Hill<D>]) -> usize {
    let highest = hills.first().map_or(0.0, |hill| hill.top.value);
    let spread = highest.abs() * (1.0 - LOWEST);
    let near_highest = hills
        .iter()
        .filter(|hill| hill.top.value >= highest - spread);
    near_highest.count().min(HILLS)
}

/// All hills in one layer or in all, the highest first.
fn searched_hills<const D: usize>(
    probe: &Probe,
    tops: &[Option<Top<D>>],
    (depths, on_interface): (&[Depth], &[bool]),
    layer: Option<usize>,
) -> Vec<Hill<D>> {
    let on_interfaces_only = is_on_interfaces(probe);
    let is_searched = |k: usize| {
        layer.is_none_or(|layer| depths[k].layer == layer)
            && (!on_interfaces_only || on_interface[k])
    };
    let searched_top = |(k, top): (usize, &Option<Top<D>>)| top.filter(|_| is_searched(k));
    let tops: Vec<_> = tops.iter().enumerate().map(searched_top).collect();
    // Interfaces are not samples of a continuous field: no interpolation between two of them.
    find_hills(&tops, depths, !on_interfaces_only)
}

/// A probe on a section, shape (depths, places), and its largest value.
pub type Probed = (Array2<f64>, Option<Extremum>);

impl Section {
    /// The probes under the first state, with the largest value of each by `search` below the same
    /// line; the samples are at the places `along` it \[m\]. Stress and displacement are computed
    /// only if a probe needs them.
    pub fn probe(
        &self,
        depths: &[Depth],
        along: &[f64],
        probes: &[Probe],
        search: &Search,
    ) -> Result<Vec<Probed>, Error> {
        let (mut stress, mut u) = (None, None);
        if probes.iter().any(|p| matches!(p, Probe::Stress(_))) {
            stress = self.stress(depths)?.into_iter().next();
        }
        if probes.iter().any(|p| matches!(p, Probe::Displacement(_))) {
            u = self.displacement(depths)?.into_iter().next();
        }
        let probe_values = |probe: &Probe| {
            let values = match probe {
                Probe::Stress(m) => stress.as_ref().map(|stress| m.on_lines(stress)),
                Probe::Displacement(c) => u
                    .as_ref()
                    .map(|u| u.index_axis(Axis(0), c.axis()).to_owned()),
            };
            values.map(|values| {
                let largest =
                    search.find_on_section(probe, &values.view(), (depths, along), None)?;
                Ok((values, largest))
            })
        };
        probes.iter().filter_map(probe_values).collect()
    }
}
