//! What cells move before they enter the contact, found without the march's own account of it.
//!
//! The increment is solved once more from where it started, with every cell outside the contact
//! lowered out of reach. That tells how fast the gap over a cell closes and how fast the cell moves,
//! for every gap around; a cell has moved as the cells of smaller gap do while its gap closed.

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
    let way = Way {
        outside,
        before,
        closing,
        motion: all,
    };
    for (n, _) in way.outside.indexed_iter().filter(|(_, outside)| **outside) {
        let furthest = way.to(n, |c, part| moved[c][n] += part);
        // Gaps within the tolerance at both ends, and displacements within it.
        let when = 2.0 * allowed * furthest;
        let most = way.motion[0][n].hypot(way.motion[1][n]);
        doubt[n] = when.min(most) + 2.0 * scene.friction.mu.min(1.0) * allowed;
    }
    Entry(Some((moved, doubt)))
}

type Cell = (usize, usize);

/// The increment with the contact kept: gap before, what it closes by, and motion.
struct Way {
    outside: Array2<bool>,
    before: Array2<f64>,
    closing: Array2<f64>,
    motion: [Array2<f64>; 2],
}

impl Way {
    /// Adds up the motion of a cell before its entry; returns the largest motion per closing about
    /// there.
    fn to(&self, n: Cell, mut add: impl FnMut(usize, f64)) -> f64 {
        let (gap, closes) = (self.before[n], self.closing[n]);
        if gap >= closes {
            (0..2).for_each(|c| add(c, self.motion[c][n]));
            return self.motion[0][n].hypot(self.motion[1][n]) / closes.abs();
        }
        // Nothing changes for a cell at the edge until the first entry next to it.
        let mut alone = 0.0;
        let touches = self.within(n, 1.1).any(|(m, _)| !self.outside[m]);
        if touches {
            let enters = |m: Cell| {
                let enters = self.outside[m] && self.closing[m] > 0.0;
                enters.then(|| self.before[m] / self.closing[m])
            };
            let times = self.within(n, 1.5).filter_map(|(m, _)| enters(m));
            alone = times.fold(gap / closes, f64::min);
        }
        // After that as the motions m of the cells around go with their closings c,
        // m = c (A + B u + C u^2 + D s), by Householder's reflections instead of normal equations.
        let tells = |m: Cell| self.outside[m] && self.before[m] < 1.5 * self.closing[m];
        let around: Vec<(Cell, [f64; 2])> =
            self.within(n, 4.5).filter(|(m, _)| tells(*m)).collect();
        let mut slope = [0.0; 2];
        for (m, off) in self.within(n, 1.5) {
            (0..2).for_each(|c| slope[c] += off[c] * self.before[m].powf(2.0 / 3.0));
        }
        let steep = slope[0].hypot(slope[1]).max(f64::MIN_POSITIVE);
        let mut rows: Vec<[f64; 6]> = Vec::new();
        let mut squares = [0.0; 4];
        let mut furthest = 0.0_f64;
        for (m, off) in around {
            let u = if gap > 0.0 {
                (self.before[m] / gap).cbrt()
            } else {
                1.0
            };
            let s = (off[1] * slope[0] - off[0] * slope[1]) / steep;
            let weight = (1.0 - (off[0] * off[0] + off[1] * off[1]) / 20.25).sqrt();
            let terms = [1.0, u, u * u, s].map(|term| weight * self.closing[m] / closes * term);
            (0..4).for_each(|k| squares[k] += terms[k] * terms[k]);
            let motion = [0, 1].map(|c| weight * self.motion[c][m] / closes);
            rows.push([terms[0], terms[1], terms[2], terms[3], motion[0], motion[1]]);
            furthest = furthest.max(self.motion[0][m].hypot(self.motion[1][m]) / self.closing[m]);
        }
        for k in 1..4 {
            let mut row = [0.0; 6];
            row[k] = (1e-6 * squares[k]).sqrt();
            rows.push(row);
        }
        let fit = least_squares(rows);
        for c in 0..2 {
            let mean = fit[c][0] + 0.75 * fit[c][1] + 0.6 * fit[c][2];
            add(c, alone * self.motion[c][n] + (gap - alone * closes) * mean);
        }
        furthest
    }

    /// The cells nearer to n than `reach`, and the way to them.
    fn within(&self, (i, j): Cell, reach: f64) -> impl Iterator<Item = (Cell, [f64; 2])> {
        let (nx, ny) = self.outside.dim();
        let steps = reach as usize;
        let columns = i.saturating_sub(steps)..(i + steps + 1).min(nx);
        let rows = j.saturating_sub(steps)..(j + steps + 1).min(ny);
        let all = columns.flat_map(move |k| rows.clone().map(move |l| (k, l)));
        all.filter_map(move |(k, l)| {
            let off = [k as f64 - i as f64, l as f64 - j as f64];
            (off[0].hypot(off[1]) < reach).then_some(((k, l), off))
        })
    }
}

/// Four unknowns for two right-hand sides, the last two columns.
fn least_squares(mut rows: Vec<[f64; 6]>) -> [[f64; 4]; 2] {
    for k in 0..4 {
        let size = rows[k..]
            .iter()
            .map(|row| row[k] * row[k])
            .sum::<f64>()
            .sqrt();
        let mut mirror: Vec<f64> = rows[k..].iter().map(|row| row[k]).collect();
        mirror[0] += size.copysign(mirror[0]);
        let square: f64 = mirror.iter().map(|v| v * v).sum();
        for c in k..6 {
            let along: f64 = mirror
                .iter()
                .zip(&rows[k..])
                .map(|(v, row)| v * row[c])
                .sum();
            for (v, row) in mirror.iter().zip(&mut rows[k..]) {
                row[c] -= 2.0 * along / square.max(f64::MIN_POSITIVE) * v;
            }
        }
    }
    [4, 5].map(|right| {
        let mut x = [0.0; 4];
        for k in (0..4).rev() {
            let known: f64 = (k + 1..4).map(|l| rows[k][l] * x[l]).sum();
            x[k] = if rows[k][k].abs() > 0.0 {
                (rows[k][right] - known) / rows[k][k]
            } else {
                0.0
            };
        }
        x
    })
}
