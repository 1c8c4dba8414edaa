//! The largest value of a number below a contact: a value at a point.
//!
//! Starting points are the local maxima of the samples (hills) and the places where rims and stick
//! borders cross the line. From the highest of these the search ascends ([`climb`]). No value is
//! extrapolated.

use contact_core::Error;
use contact_core::scene::{Body, Grid};
use ndarray::{Array2, ArrayView2, Axis};

use super::climb::{Start, climb, point};
use super::coarser::Coarser;
use super::depth::on_interfaces;
use super::maximum::{Hill, hills, top_of_line};
use super::{
    Border, Depth, Errors, Extreme, Line, Point, Points, Probe, Section, Side, States, Top, Zone,
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
const BESIDE: f64 = 1.0;
/// A layer at the surface thinner than so many cells has its rim law within a few of them: as many
/// cells around a border the error of a value falls like the root of the cell, and is 1/(2^(1/2) -
/// 1) times the change to cells twice as large.
const RESOLVED: f64 = 4.0;
const OF_ROOT: f64 = 1.0 + std::f64::consts::SQRT_2;
/// At a rim that the tractions are continued to, the first term that they leave out is the distance
/// from it to the power of 3/2: 1/(2^(3/2) - 1) times the change to cells twice as large.
const OF_CONTINUED: f64 = 0.547;

/// Looks for the largest values below a contact.
pub struct Search {
    pub(super) points: Points,
    coarser: [Coarser; 2],
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
    /// In the whole body, with the directions along `line` and across it.
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

    /// In the body `side` under the first of the states, below `line` or anywhere.
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
            ..states.clone()
        };
        let coarser = Coarser::both(body, side, grid, line, &states)?;
        let points = Points::new(body, side, grid, states)?;
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
    pub fn on_section(
        &self,
        probe: &Probe,
        samples: &ArrayView2<'_, f64>,
        (depths, along): (&[Depth], &[f64]),
        layer: Option<usize>,
    ) -> Result<Option<Extreme>, Error> {
        let Some(line) = self.line else {
            return Ok(None);
        };
        let lines = samples.rows().into_iter();
        let tops: Vec<_> = lines.map(|line| top_of_line(&line, along)).collect();
        let hills = hills_of(probe, &tops, (depths, &on_interfaces(depths)), layer);
        let starts = hills
            .iter()
            .flat_map(|hill| self.starts(line, hill, along, false));
        let surface = samples.rows().into_iter().next();
        let near = |border: &Border| {
            let s = line.along(border.x, border.y);
            let nearest = (0..along.len())
                .min_by(|&a, &b| (along[a] - s).abs().total_cmp(&(along[b] - s).abs()));
            nearest
                .zip(surface.as_ref())
                .map_or(f64::NAN, |(n, row)| row[n])
        };
        self.climbed(probe, starts.collect(), depths, layer, &near)
    }

    /// The starting points on a hill of a section: the top of the parabolas and the sample; `free`
    /// across the line or on it.
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
            let (x, y) = line.at(s);
            let [s, t] = self.in_frame(x, y);
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

    /// A starting point at x, y \[m\] and a depth, with the distance to the next depth \[m\].
    pub(super) fn start_at(&self, [x, y]: [f64; 2], depth: Depth, step: f64) -> Start {
        let [s, t] = self.in_frame(x, y);
        let cell = STEP * self.d.0.max(self.d.1);
        Start {
            place: [s, t, depth.z],
            layer: depth.layer,
            steps: [cell, cell, 0.5 * step],
            known: None,
        }
    }

    /// Place along the line of the search and to the left of it \[m\]; without one x and y.
    fn in_frame(&self, x: f64, y: f64) -> [f64; 2] {
        self.line.map_or([x, y], |line| {
            let s = line.along(x, y);
            let ((x_0, y_0), [cos, sin]) = (line.at(s), line.direction());
            [s, (y - y_0) * cos - (x - x_0) * sin]
        })
    }

    /// The reverse.
    fn in_space(&self, (s, t, depth): Point) -> Point {
        let (x, y) = self.line.map_or((s, t), |line| line.beside(s, t));
        (x, y, depth)
    }

    /// The largest value in a volume, from the tops of the planes at its depths and the samples on
    /// the first of them, shape (nx, ny); in one `layer` if given. `None` if all samples are NaN.
    pub fn in_volume(
        &self,
        probe: &Probe,
        tops: &[Option<Top<2>>],
        surface: &Array2<f64>,
        depths: &[Depth],
        layer: Option<usize>,
    ) -> Result<Option<Extreme>, Error> {
        let (nx, ny) = surface.dim();
        let across = if self.flat { 0.0 } else { STEP * self.d.1 };
        let both = |hill: &Hill<2>| {
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
        let hills = hills_of(probe, tops, (depths, &on_interfaces(depths)), layer);
        let starts = hills.iter().flat_map(both).collect();
        let cell = |v: f64, n: usize, d: f64| {
            (v / d + (n - 1) as f64 / 2.0)
                .round()
                .clamp(0.0, (n - 1) as f64) as usize
        };
        let near =
            |border: &Border| surface[(cell(border.x, nx, self.d.0), cell(border.y, ny, self.d.1))];
        self.climbed(probe, starts, depths, layer, &near)
    }

    /// The result of the ascent from the highest of the starts and, if the surface is included, of
    /// the borders; `near` gives the sample next to a border.
    pub(super) fn climbed(
        &self,
        probe: &Probe,
        mut starts: Vec<Start>,
        depths: &[Depth],
        layer: Option<usize>,
        near: &dyn Fn(&Border) -> f64,
    ) -> Result<Option<Extreme>, Error> {
        let at_surface = depths.first().is_some_and(|d| d.z <= 0.0 && d.layer == 0);
        if at_surface && layer.is_none_or(|layer| layer == 0) && !lives_on_interfaces(probe) {
            starts.extend(self.border_starts(depths, near));
        }
        let values = |points: &[Point]| -> Result<Vec<f64>, Error> {
            let points: Vec<Point> = points.iter().map(|at| self.in_space(*at)).collect();
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
        let points: Vec<Point> = unknown.map(|s| point(s.place, s.layer)).collect();
        let mut found = values(&points)?.into_iter();
        let Some((start, value)) = starts
            .iter()
            .map(|start| {
                (
                    start,
                    start.known.or_else(|| found.next()).unwrap_or(f64::NAN),
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
        let (place, value, left) = climb(&values, start, value, bounds)?;
        let there = point(place, start.layer);
        let at = self.in_space(there);
        let border = self.border_within(at, ON_BORDER);
        // Beside a border the stress follows the distance from it.
        let beside = self.border_within(at, BESIDE);
        // Under the rim of a thin layer the samples of an interface follow the cells of the border.
        let of_steps = lives_on_interfaces(probe) && self.thin && self.is_near_border(at);
        let unsure = of_steps || self.points.rim_is_unknown(at);
        let inwards = if unsure {
            self.beside(there)
        } else {
            Vec::new()
        };
        let inwards = values(&inwards)?.into_iter();
        let unsure = inwards.map(|beside| (value - beside).abs());
        let unsure = unsure.fold(0.0, f64::max);
        let mut change = 0.0_f64;
        for coarser in &self.coarser {
            let coarse = match probe {
                Probe::Stress(m) => (m.value)(&coarser.stress(at, beside.as_ref())?),
                Probe::Displacement(c) => coarser.displacement(at.0, at.1, at.2)?[c.axis()],
            };
            change = change.max((value - coarse).abs());
        }
        let rim = border.is_some_and(|border| border.zone == Zone::Contact);
        let part = if self.thin && self.is_near_border(at) {
            OF_ROOT
        } else if rim && !self.points.rim_is_unknown(at) {
            OF_CONTINUED
        } else {
            1.0
        };
        let extreme = Extreme {
            value,
            x: at.0,
            y: at.1,
            depth: at.2,
            at: border.map(|b| b.zone),
            error: Errors {
                tractions: Some(part * change),
                ..Errors::along(
                    self.line.unwrap_or(Line::AlongX(0.0)),
                    [left[0].max(unsure), left[1], left[2]],
                )
            },
        };
        let (length, width) = self.grid.extent();
        Ok(Some(extreme.placed(length.max(width))))
    }

    /// The borders beside which the samples are largest.
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
            let [s, t] = self.in_frame(border.x, border.y);
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

    /// The points half a cell to both sides: the value there bounds the effect of an uncertain rim.
    fn beside(&self, (s, t, depth): Point) -> Vec<Point> {
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
        let away = |b: &Border| ((b.x - x) / self.d.0).hypot(across(b.y - y));
        let beside = self.points.borders_beside(x, y);
        let all = self.borders.iter().copied().chain(beside);
        let by_distance = all.map(|b| (b, [away(&b), depth.z / cell]));
        by_distance.min_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]))
    }
}

fn lives_on_interfaces(probe: &Probe) -> bool {
    matches!(probe, Probe::Stress(m) if m.of_interfaces)
}

/// The hills of a layer, or of all, that are evaluated, from the tops at the depths; which of them
/// lie on an interface ([`on_interfaces`]) only all depths of the body show.
pub(super) fn hills_of<const D: usize>(
    probe: &Probe,
    tops: &[Option<Top<D>>],
    (depths, on_one): (&[Depth], &[bool]),
    layer: Option<usize>,
) -> Vec<Hill<D>> {
    let of_interfaces = lives_on_interfaces(probe);
    let asked = |k: usize| {
        layer.is_none_or(|layer| depths[k].layer == layer) && (!of_interfaces || on_one[k])
    };
    let asked_for = |(k, top): (usize, &Option<Top<D>>)| top.filter(|_| asked(k));
    let tops: Vec<_> = tops.iter().enumerate().map(asked_for).collect();
    // Interfaces are not samples of a continuous field: no interpolation between two of them.
    let mut hills = hills(&tops, depths, !of_interfaces);
    let highest = hills.first().map_or(0.0, |hill| hill.top.value);
    let spread = highest.abs() * (1.0 - LOWEST);
    hills.retain(|hill| hill.top.value >= highest - spread);
    hills.truncate(HILLS);
    hills
}

/// A probe on a section, shape (depths, places), and its largest value.
pub type Probed = (Array2<f64>, Option<Extreme>);

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
        let one = |probe: &Probe| {
            let values = match probe {
                Probe::Stress(m) => stress.as_ref().map(|stress| m.on_lines(stress)),
                Probe::Displacement(c) => u
                    .as_ref()
                    .map(|u| u.index_axis(Axis(0), c.axis()).to_owned()),
            };
            values.map(|values| {
                let largest = search.on_section(probe, &values.view(), (depths, along), None)?;
                Ok((values, largest))
            })
        };
        probes.iter().filter_map(one).collect()
    }
}
