//! Events of wear: a coating thinned or worn through.

use contact_core::plan::Plan;
use contact_core::scene::Scene;
use serde::{Deserialize, Serialize};

use super::loss::Worn;
use super::passage::Passage;
use super::settings::{Wear, thicknesses};

/// Kind of an event of a coating.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum EventKind {
    /// The worn depth reaches a stated part of the coatings' thickness. The elastic response of the
    /// full thickness begins to be inaccurate.
    Thinned,
    /// A coating is worn through: the layer below is bare.
    WornThrough,
}

/// An event of a coating, at the place where it first occurs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// The kind.
    pub kind: EventKind,
    /// Cycles at the event.
    pub cycles: f64,
    /// Error of the cycles: the relative error of the deepest depth at the end of the jump, times
    /// the cycles.
    #[serde(default)]
    pub cycles_error: f64,
    /// Body, 1 or 2.
    pub body: usize,
    /// Coating, 0 the outermost; for `Thinned` the bare one.
    pub coating: usize,
    /// Place on that body, on the axes of the grid \[m\].
    pub x: f64,
    /// Place on that body along y \[m\].
    pub y: f64,
}

/// Depths from the surface at which the coatings of both bodies end \[m\].
fn bottoms(scene: &Scene) -> [Vec<f64>; 2] {
    [&scene.body1, &scene.body2].map(|body| {
        let mut bottom = 0.0;
        let depths_below = |h: f64| {
            bottom += h;
            bottom
        };
        thicknesses(body).into_iter().map(depths_below).collect()
    })
}

/// Whether the list has an event of this kind, body (0 or 1) and coating.
fn contains(events: &[Event], kind: EventKind, b: usize, coating: usize) -> bool {
    events
        .iter()
        .any(|e| e.kind == kind && e.body == b + 1 && e.coating == coating)
}

/// The part of a jump after which a coating is first worn through; none if none is that was not before.
pub(crate) fn crossing(scene: &Scene, past: &[Event], passage: &Passage<'_>) -> Option<f64> {
    let mut first: Option<f64> = None;
    for (b, bottoms) in bottoms(scene).into_iter().enumerate() {
        for (coating, bottom) in bottoms.into_iter().enumerate() {
            if contains(past, EventKind::WornThrough, b, coating) {
                continue;
            }
            if let Some((part, _)) = passage.first_reached(b, bottom) {
                first = Some(first.map_or(part, |first| first.min(part)));
            }
        }
    }
    first
}

/// The events of body b (kind, number of the coating, depth \[m\]) in the order of depth.
fn event_depths(scene: &Scene, wear: &Wear, b: usize) -> Vec<(EventKind, usize, f64)> {
    let bottoms = &bottoms(scene)[b];
    let thinned = bottoms
        .last()
        .map(|all| (EventKind::Thinned, 0, wear.event_depth_fraction * all));
    let through = bottoms.iter().enumerate();
    let through = through.map(|(coating, bottom)| (EventKind::WornThrough, coating, *bottom));
    thinned.into_iter().chain(through).collect()
}

/// Coordinates x, y of a cell \[m\].
fn place(scene: &Scene, cell: usize) -> (f64, f64) {
    let rows = Plan::new(scene).mirror.rows(scene.grid.ny);
    let (i, j) = (cell / rows, cell % rows + scene.grid.ny - rows);
    (scene.grid.x(i), scene.grid.y(j))
}

/// The new events within a jump of n cycles, without the errors of their cycles.
pub(crate) fn events(
    scene: &Scene,
    wear: &Wear,
    past: &[Event],
    passage: &Passage<'_>,
    n: f64,
) -> Vec<Event> {
    let mut new = Vec::new();
    for b in 0..2 {
        for (kind, coating, depth) in event_depths(scene, wear, b) {
            if contains(past, kind, b, coating) {
                continue;
            }
            if let Some((part, cell)) = passage.first_reached(b, depth) {
                let cycles = passage.worn.cycles + part * n;
                let (x, y) = place(scene, cell);
                let body = b + 1;
                new.push(Event {
                    kind,
                    cycles,
                    cycles_error: 0.0,
                    body,
                    coating,
                    x,
                    y,
                });
            }
        }
    }
    new.sort_by(|a, b| a.cycles.total_cmp(&b.cycles));
    new
}

/// Adds the error of its cycles to an event. `part` is the relative error of the deepest depth.
/// Depths grow in proportion to the cycles to first order, so both have the same relative error.
pub(crate) fn with_error(event: Event, part: f64) -> Event {
    Event {
        cycles_error: part * event.cycles,
        ..event
    }
}

/// The events of worn surfaces from which a run starts.
pub(crate) fn past_events(scene: &Scene, wear: &Wear, worn: &Worn) -> Vec<Event> {
    let none = worn.depth.each_ref().map(|d| vec![0.0; d.len()]);
    let passage = Passage {
        worn,
        half: &none,
        whole: &none,
    };
    events(scene, wear, &[], &passage, 0.0)
}
