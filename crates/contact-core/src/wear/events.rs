//! What wear does to coatings: thinned, worn through.

use serde::{Deserialize, Serialize};

use super::loss::{Loss, Worn};
use super::settings::{Wear, thicknesses};
use crate::plan::Plan;
use crate::scene::Scene;

/// What happened to a coating.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum EventKind {
    /// The worn depth is a stated part of the coatings' thickness: that their response is one of
    /// constant thickness begins to matter.
    Thinned,
    /// A coating is worn through: what is below is bare.
    WornThrough,
}

/// Something that happened to a coating, first at one place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// What.
    pub kind: EventKind,
    /// Cycles done.
    pub cycles: f64,
    /// Body, 1 or 2.
    pub body: usize,
    /// Coating, 0 the outermost; of `Thinned` the one that is bare.
    pub coating: usize,
    /// Place on that body, on the axes of the grid \[m\].
    pub x: f64,
    /// The same along y.
    pub y: f64,
}

/// Depths from the surface at which the coatings of both bodies end \[m\].
fn bottoms(scene: &Scene) -> [Vec<f64>; 2] {
    [&scene.body1, &scene.body2].map(|body| {
        let mut bottom = 0.0;
        let below = |h: f64| {
            bottom += h;
            bottom
        };
        thicknesses(body).into_iter().map(below).collect()
    })
}

/// Whether an event is known already.
fn known(events: &[Event], kind: EventKind, b: usize, coating: usize) -> bool {
    events
        .iter()
        .any(|e| e.kind == kind && e.body == b + 1 && e.coating == coating)
}

/// The part of a jump after which it first wears a coating through, if it does.
pub(crate) fn crossing(scene: &Scene, past: &[Event], worn: &Worn, loss: &Loss) -> Option<f64> {
    let mut first: Option<f64> = None;
    for (b, bottoms) in bottoms(scene).into_iter().enumerate() {
        for (coating, bottom) in bottoms.into_iter().enumerate() {
            if known(past, EventKind::WornThrough, b, coating) {
                continue;
            }
            for (worn, loss) in worn.depth[b].iter().zip(&loss.depth[b]) {
                if worn + loss >= bottom && *loss > 0.0 {
                    let part = (bottom - worn) / loss;
                    first = Some(first.map_or(part, |first| first.min(part)));
                }
            }
        }
    }
    first
}

/// What has newly happened on surfaces worn so far.
pub(crate) fn events(
    scene: &Scene,
    wear: &Wear,
    past: &[Event],
    worn: &Worn,
    cycles: f64,
) -> Vec<Event> {
    let mut new = Vec::new();
    let rows = Plan::new(scene).mirror.rows(scene.grid.ny);
    for (b, bottoms) in bottoms(scene).into_iter().enumerate() {
        let deepest = worn.depth[b]
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(b.1));
        let Some((n, &depth)) = deepest else { continue };
        let Some(&all) = bottoms.last() else { continue };
        let (i, j) = (n / rows, n % rows + scene.grid.ny - rows);
        let mut tell = |kind, coating| {
            if !known(past, kind, b, coating) {
                let (x, y) = (scene.grid.x(i), scene.grid.y(j));
                new.push(Event {
                    kind,
                    cycles,
                    body: b + 1,
                    coating,
                    x,
                    y,
                });
            }
        };
        if depth >= wear.tell_from * all {
            tell(EventKind::Thinned, 0);
        }
        for (coating, bottom) in bottoms.iter().enumerate() {
            if depth >= *bottom {
                tell(EventKind::WornThrough, coating);
            }
        }
    }
    new
}
