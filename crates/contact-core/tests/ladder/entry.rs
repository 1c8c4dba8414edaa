//! What cells move before they enter the contact, found without the march's own account of it.
//!
//! The increment is solved once more from where it started, with every cell outside the contact
//! lowered out of reach. A cell entered when its gap, falling at the same rate all along, was
//! closed; until then it moved freely.

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
    for (n, &before) in last.fields.gap.indexed_iter() {
        if last.fields.p[n] > 0.0 {
            continue;
        }
        let before = before.max(0.0);
        let closing = (before - gap[n]).max(f64::MIN_POSITIVE);
        let part = (before / closing).min(1.0);
        let all = [
            free.u_x[n] - last.fields.u_x[n] - shift[0],
            free.u_y[n] - last.fields.u_y[n] - shift[1],
        ];
        for c in 0..2 {
            moved[c][n] = part * all[c];
        }
        // Gaps within the tolerance at both ends, and displacements within it.
        let when = (2.0 * allowed / closing).min(1.0);
        doubt[n] = when * all[0].hypot(all[1]) + 2.0 * scene.friction.mu.min(1.0) * allowed;
    }
    Entry(Some((moved, doubt)))
}
