//! What cells move before they enter the contact, found without the march's own account of it.
//!
//! The increment is solved once more from where it started, with every cell outside the contact
//! lowered out of reach. That tells how fast the gap over a cell closes and how fast the cell moves,
//! so many cells away from the edge. The edge comes nearer cell by cell: a cell entered when the
//! closings from one stage to the next had closed its gap.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use contact_core::convolution::Mirror;
use contact_core::march::{Increment, March};
use contact_core::scene::{LoadPath, Shape, SurfaceMap};
use ndarray::Array2;

use crate::audit::Last;

/// Motion before entry and how far the tolerance lets it be off.
#[derive(Default)]
pub(crate) struct Entry(Option<([Array2<f64>; 2], Array2<f64>)>);

impl Entry {
    /// Free motion of the cell before it entered \[m\].
    pub(crate) fn moved(&self, n: (usize, usize)) -> [f64; 2] {
        let Self(entry) = self;
        let moved = |(moved, _): &([Array2<f64>; 2], _)| [moved[0][n], moved[1][n]];
        entry.as_ref().map_or([0.0; 2], moved)
    }

    /// What it may be off \[m\].
    pub(crate) fn doubt(&self, n: (usize, usize)) -> f64 {
        let Self(entry) = self;
        entry.as_ref().map_or(0.0, |(_, doubt)| doubt[n])
    }
}

/// Of every cell; `allowed` is the misfit that the tolerance leaves in a cell \[m\].
pub(crate) fn entry(march: &March, last: &Last, increment: &Increment, allowed: f64) -> Entry {
    let scene = march.scene();
    let loads = increment.point.loads;
    let solver = &scene.settings.solver;
    if !solver.entering || loads.W <= last.loads.W * (1.0 + 1e-12) {
        return Entry::default();
    }
    let dim = last.fields.p.dim();
    let motion = |c: usize| match c {
        0 => increment.motion.delta_x - last.motion.delta_x,
        _ => increment.motion.delta_y - last.motion.delta_y,
    };
    let Some(state) = last.state.as_ref().filter(|_| last.loads.W > 0.0) else {
        // Bodies that did not touch move as they are until a cell is reached.
        let h = scene.h_init();
        let lowest = h.iter().copied().fold(f64::INFINITY, f64::min);
        let closed = increment.motion.delta_z - lowest;
        let part = h.mapv(|h| ((h - lowest) / closed).clamp(0.0, 1.0));
        let moved = [0, 1].map(|c| part.mapv(|part| -part * motion(c)));
        let shift = motion(0).hypot(motion(1));
        // The shift is looked for until it changes by a 1e-8th.
        return Entry(Some((moved, Array2::from_elem(dim, 1e-7 * shift))));
    };
    let mut kept = scene.clone();
    let far = 1e2 * (increment.motion.delta_z + last.fields.gap.fold(0.0, |m: f64, h| m.max(*h)));
    let out_of_reach = last.fields.p.mapv(|p| if p > 0.0 { 0.0 } else { -far });
    kept.body1.shape = Shape::Sum(vec![
        kept.body1.shape,
        Shape::HeightMap(SurfaceMap {
            values: Arc::new(out_of_reach),
            spacing: (scene.grid.dx, scene.grid.dy),
        }),
    ]);
    kept.settings.solver.entering = false;
    kept.settings.solver.turning = false;
    // The state is of half a grid or of a whole one.
    kept.settings.skip.mirror = march.plan().mirror != Mirror::None;
    kept.path = LoadPath::start().to(|to| *to = loads, 1);
    let mut state = state.clone();
    state.increments = 0;
    let mut alone = March::resume(&kept, state).expect("the state of this grid");
    let after = alone.advance().expect("an increment").expect("a solution");
    let free = alone.fields();
    let shift = [
        after.motion.delta_x - last.motion.delta_x,
        after.motion.delta_y - last.motion.delta_y,
    ];
    let (mut moved, mut doubt) = ([Array2::zeros(dim), Array2::zeros(dim)], Array2::zeros(dim));
    let gap = &free.u_z + &scene.h_init() - after.motion.delta_z;
    let outside = last.fields.p.mapv(|p| p <= 0.0);
    let before = last.fields.gap.mapv(|gap| gap.max(0.0));
    let closing = &before - &gap;
    let all = [
        &free.u_x - &last.fields.u_x - shift[0],
        &free.u_y - &last.fields.u_y - shift[1],
    ];
    let stages = stages(&outside, &before, &closing);
    for (n, _) in outside.indexed_iter().filter(|(_, outside)| **outside) {
        let closes = closing[n].max(f64::MIN_POSITIVE);
        let weights = stages.get(&n).cloned().unwrap_or_else(|| {
            let alone = (before[n] / closes).min(1.0);
            vec![(n, alone)]
        });
        let mut furthest = 0.0_f64;
        for (m, weight) in &weights {
            for c in 0..2 {
                moved[c][n] += weight * all[c][*m];
            }
            furthest = furthest.max(all[0][*m].hypot(all[1][*m]) / closing[*m]);
        }
        // Gaps within the tolerance at both ends, and displacements within it, at every stage.
        let stages = weights.len() as f64;
        let when = 2.0 * stages * allowed * furthest;
        let most = all[0][n].hypot(all[1][n]);
        doubt[n] = when.min(most) + 2.0 * stages * scene.friction.mu.min(1.0) * allowed;
    }
    Entry(Some((moved, doubt)))
}

type Cell = (usize, usize);

/// The parts of the increment for which a cell moves as other cells, and at last itself, do under
/// the kept contact: those whose distance from the old edge it has from the moving one.
fn stages(
    outside: &Array2<bool>,
    gap: &Array2<f64>,
    closing: &Array2<f64>,
) -> BTreeMap<Cell, Vec<(Cell, f64)>> {
    let (nx, ny) = outside.dim();
    let beside = |(i, j): Cell| {
        let all = [
            (i.wrapping_sub(1), j),
            (i + 1, j),
            (i, j.wrapping_sub(1)),
            (i, j + 1),
        ];
        all.into_iter().filter(move |&(i, j)| i < nx && j < ny)
    };
    // Per cell the durations of its stages, in order, and the chains of cells that lead to it with
    // their weights.
    let mut durations: BTreeMap<Cell, Vec<f64>> = BTreeMap::new();
    let mut chains: BTreeMap<Cell, Vec<Vec<(Cell, f64)>>> = BTreeMap::new();
    let mut ring: BTreeSet<Cell> = outside
        .indexed_iter()
        .filter(|&(n, outside_n)| *outside_n && closing[n] > 0.0 && beside(n).any(|m| !outside[m]))
        .map(|(n, _)| n)
        .collect();
    while !ring.is_empty() {
        let mut found = Vec::new();
        for &n in &ring {
            let leads = |m: &Cell| {
                durations
                    .get(m)
                    .is_some_and(|t| t.iter().sum::<f64>() <= 1.0)
            };
            let leading: Vec<Cell> = beside(n).filter(leads).collect();
            let length = leading
                .iter()
                .map(|m| durations[m].len())
                .min()
                .unwrap_or(0);
            let weight = 1.0 / leading.len().max(1) as f64;
            let mut t: Vec<f64> = (0..length)
                .map(|k| leading.iter().map(|m| weight * durations[m][k]).sum())
                .collect();
            let mut chain: Vec<Vec<(Cell, f64)>> = (0..length)
                .map(|k| {
                    let of = leading.iter().flat_map(|m| &chains[m][k]);
                    of.map(|(cell, part)| (*cell, weight * part)).collect()
                })
                .collect();
            chain.push(vec![(n, 1.0)]);
            let rate = |place: &[(Cell, f64)]| -> f64 {
                place.iter().map(|(m, part)| part * closing[*m]).sum()
            };
            let closed: f64 = (0..length).map(|k| t[k] * rate(&chain[length - k])).sum();
            t.push(((gap[n] - closed) / rate(&chain[0])).clamp(0.0, 2.0));
            found.push((n, t, chain));
        }
        ring.clear();
        for (n, t, chain) in found {
            if t.iter().sum::<f64>() <= 1.0 {
                ring.extend(beside(n).filter(|&m| outside[m] && closing[m] > 0.0));
            }
            durations.insert(n, t);
            chains.insert(n, chain);
        }
        ring.retain(|n| !durations.contains_key(n));
    }
    durations
        .into_iter()
        .map(|(n, t)| {
            let chain = &chains[&n];
            // A cell that enters does so within the increment.
            let over = t.iter().sum::<f64>().max(1.0);
            let stages = t.iter().zip(chain.iter().rev());
            let weights = stages
                .flat_map(|(t, place)| place.iter().map(move |(m, part)| (*m, t * part / over)));
            (n, weights.collect())
        })
        .collect()
}
