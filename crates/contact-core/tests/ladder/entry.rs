//! What cells move before they enter the contact, found without the march's own account of it.
//!
//! The increment is solved once more from where it started, with every cell outside the contact
//! lowered out of reach. That tells how fast the gap over a cell closes and how fast the cell moves.
//! All cells go on together until the next one enters, which holds the gaps of the others back. What they
//! move while these close belongs to what they see of the contact.

use std::sync::Arc;

use contact_core::kernels::influence_coefficients;
use contact_core::march::{Increment, March};
use contact_core::plan::Mirror;
use contact_core::scene::{LoadPath, Scene, Shape, SurfaceMap};
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
        cell: match (scene.grid.dx, scene.grid.dy) {
            (dx, _) if scene.grid.plane_strain => [1.0, scene.grid.dy / dx],
            (dx, dy) => [(dx / dy).sqrt(), (dy / dx).sqrt()],
        },
        flat: scene.grid.plane_strain,
        response: response(scene),
    };
    let by = way.moved();
    for (n, _) in way.outside.indexed_iter().filter(|(_, outside)| **outside) {
        (0..2).for_each(|c| moved[c][n] = by[n][c]);
        // Gaps within the tolerance at both ends, and displacements within it.
        let about = way
            .within(n, 5.5)
            .filter(|(m, _)| way.closing[*m] > 0.0 && way.outside[*m]);
        let ratios = about.map(|(m, _)| way.motion[0][m].hypot(way.motion[1][m]) / way.closing[m]);
        let when = 2.0 * allowed * ratios.fold(0.0, f64::max);
        let most = way.motion[0][n].hypot(way.motion[1][n]);
        doubt[n] = when.min(most) + 2.0 * scene.friction.mu.min(1.0) * allowed;
    }
    Entry(Some((moved, doubt)))
}

type Place = (usize, usize);

/// u_z under pressure on a cell so many columns and rows away, over that under its own.
fn response(scene: &Scene) -> Array2<f64> {
    let (kernel, equal) = (&scene.settings.kernel, scene.settings.skip.equal_layers);
    let of = |body| {
        influence_coefficients(body, &scene.grid, kernel, equal, None).expect("coefficients")
    };
    let zz = of(&scene.body1).zz + of(&scene.body2).zz;
    let own = zz[(0, 0)];
    zz / own
}

/// The increment with the contact kept: gap before, what it closes by, and motion.
struct Way {
    outside: Array2<bool>,
    before: Array2<f64>,
    closing: Array2<f64>,
    motion: [Array2<f64>; 2],
    /// Its sides in lengths of a cell.
    cell: [f64; 2],
    flat: bool,
    response: Array2<f64>,
}

/// A cell that enters.
struct Cell {
    at: Place,
    gap: f64,
    rates: [f64; 3],
    /// A, B, C, D and the change along the edge of x, of y, and E.
    law: [f64; 11],
    sight: [f64; 3],
    moved: [f64; 2],
    inside: bool,
}

impl Way {
    /// How far each cell has moved when it enters.
    fn moved(&self) -> Array2<[f64; 2]> {
        let mut moved = Array2::from_elem(self.outside.dim(), [0.0; 2]);
        let mut all: Vec<Place> = Vec::new();
        for (n, _) in self.outside.indexed_iter().filter(|(_, outside)| **outside) {
            moved[n] = [self.motion[0][n], self.motion[1][n]];
            if self.before[n] < self.closing[n] {
                all.push(n);
            }
        }
        let sights = Array2::from_shape_fn(self.outside.dim(), |n| self.sight(n));
        let (near, far): (Vec<Place>, Vec<Place>) =
            all.into_iter().partition(|n| sights[*n].is_some());
        let mut known = self.outside.mapv(|_| false);
        let cell = |&at: &Place| Cell {
            at,
            gap: self.before[at],
            rates: [self.closing[at], self.motion[0][at], self.motion[1][at]],
            law: self.law(at, &sights),
            sight: sights[at].expect("a cell near the contact"),
            moved: [0.0; 2],
            inside: false,
        };
        let mut cells: Vec<Cell> = near.iter().map(cell).collect();
        while cells.iter().any(|cell| !cell.inside) {
            let time = |cell: &Cell| cell.gap.max(0.0) / cell.rates[0];
            let open: Vec<usize> = (0..cells.len()).filter(|k| !cells[*k].inside).collect();
            let step = open
                .iter()
                .map(|k| time(&cells[*k]))
                .fold(f64::INFINITY, f64::min);
            // Twins enter at once, and each holds the other back.
            let enter = |k: &&usize| time(&cells[**k]) <= step + 1e-4;
            let next: Vec<usize> = open.iter().filter(enter).copied().collect();
            for &k in &open {
                cells[k].gap -= step * cells[k].rates[0];
                (0..2).for_each(|c| cells[k].moved[c] += step * cells[k].rates[c + 1]);
            }
            let held = |k: usize, by: usize| {
                let (cell, other) = (&cells[k], &cells[by]);
                let off = [
                    other.at.0 as f64 - cell.at.0 as f64,
                    other.at.1 as f64 - cell.at.1 as f64,
                ];
                let (here, _) = self.root_and_side(cell.sight);
                let (there, _) = self.root_and_side(other.sight);
                let near = off[0] * off[0] + off[1] * off[1] < 72.5;
                near.then(|| (off, self.screened(off, here, there)))
            };
            let pressure = |k: usize| {
                let of = |by: &usize| held(*by, k).map(|(_, s)| s * cells[*by].rates[0]);
                let (here, _) = self.root_and_side(cells[k].sight);
                let alone = self.screened([0.0, 0.0], here, here) * cells[k].rates[0];
                let all: f64 = next.iter().filter_map(of).sum();
                cells[k].rates[0].powi(2) / all.max(0.5 * alone)
            };
            let pressures: Vec<f64> = next.iter().map(|k| pressure(*k)).collect();
            let mut after: Vec<(usize, f64, [f64; 3])> = Vec::new();
            for &k in open.iter().filter(|k| !next.contains(k)) {
                let (mut rate, mut sight) = (cells[k].rates[0], cells[k].sight);
                let mut sees = false;
                for (&by, pressure) in next.iter().zip(&pressures) {
                    if let Some((off, s)) = held(k, by) {
                        rate = (rate - pressure * s).max(1e-3 * self.closing[cells[k].at]);
                        let seen = self.seen(off);
                        (0..3).for_each(|k| sight[k] += seen[k]);
                        sees = true;
                    }
                }
                if sees {
                    after.push((k, rate, sight));
                }
            }
            for (k, closing, sight) in after {
                let (s, e) = self.root_and_side(sight);
                let law = &cells[k].law;
                let ratio = |c: usize| {
                    let of = &law[5 * c..];
                    of[0] + of[1] / s + of[2] * s + of[3] * s * s + law[10] * e[c] / s
                };
                cells[k].rates = [closing, closing * ratio(0), closing * ratio(1)];
                cells[k].sight = sight;
            }
            for k in next {
                let rest = cells[k].gap.max(0.0) / cells[k].rates[0];
                (0..2).for_each(|c| cells[k].moved[c] += rest * cells[k].rates[c + 1]);
                cells[k].inside = true;
            }
        }
        for cell in &cells {
            (moved[cell.at], known[cell.at]) = (cell.moved, true);
        }
        self.farther(&mut moved, &mut known, far);
        moved
    }

    /// Those that see no contact: like the cells that enter before them, and what is between.
    fn farther(&self, moved: &mut Array2<[f64; 2]>, known: &mut Array2<bool>, mut far: Vec<Place>) {
        far.sort_by(|n, m| self.before[*n].total_cmp(&self.before[*m]));
        for n in far {
            let (mut sum, mut weights) = ([0.0; 2], 0.0);
            for (m, off) in self.within(n, 1.5) {
                let rise = self.before[n] - self.before[m];
                if known[m] && rise > 0.0 {
                    let [x, y] = self.way(off);
                    let weight = rise * rise / (x * x + y * y);
                    weights += weight;
                    for c in 0..2 {
                        let ratio = |n: Place| self.motion[c][n] / self.closing[n];
                        let way = 0.5 * (ratio(n) + ratio(m)) * rise;
                        sum[c] += weight * (moved[m][c] + way);
                    }
                }
            }
            let alone = |c: usize| self.motion[c][n] / self.closing[n] * self.before[n];
            moved[n] = [0, 1].map(|c| {
                if weights > 0.0 {
                    sum[c] / weights
                } else {
                    alone(c)
                }
            });
            known[n] = true;
        }
    }

    /// Columns and rows in lengths of a cell.
    fn way(&self, off: [f64; 2]) -> [f64; 2] {
        [off[0] * self.cell[0], off[1] * self.cell[1]]
    }

    /// What a cell of contact so far off counts, and times the direction to it.
    fn seen(&self, off: [f64; 2]) -> [f64; 3] {
        let off = self.way(off);
        let r = off[0].hypot(off[1]);
        let counts = r.powf(if self.flat { -1.25 } else { -2.25 });
        [counts, counts * off[0] / r, counts * off[1] / r]
    }

    /// u_z of a cell under pressure on another one so far off, both outside a contact that is held and so
    /// near as the squares of these roots; over that of a cell to its own with nothing held.
    fn screened(&self, off: [f64; 2], one: f64, other: f64) -> f64 {
        let [one, other] = [one, other].map(|root| root.max(0.35_f64.sqrt()));
        let kernel = |i: f64, j: f64| self.response[(i.abs() as usize, j.abs() as usize)];
        let free = kernel(off[0], off[1]);
        if self.flat {
            // The image stands as far off as both together.
            let away = (one + other).powi(2);
            let last = self.response.nrows() as f64 - 1.0;
            let (from, to) = (away.floor().min(last), (away.floor() + 1.0).min(last));
            let part = if to > from {
                (away / from).ln() / (to / from).ln()
            } else {
                0.0
            };
            return free - kernel(from, 0.0) - part * (kernel(to, 0.0) - kernel(from, 0.0));
        }
        let [x, y] = self.way(off);
        let r = x.hypot(y);
        if r > 0.0 {
            return free * (2.0 * one * other).atan2(r) / std::f64::consts::FRAC_PI_2;
        }
        // The integral of 1/r over a cell, from its corners.
        let [a, b] = self.cell;
        let diagonal = a.hypot(b);
        let potential = 2.0 * (a * ((b + diagonal) / a).ln() + b * ((a + diagonal) / b).ln());
        free - 1.0 / (std::f64::consts::PI * potential * one * other)
    }

    /// What a cell sees, with half of the plane beyond eight and a half cells.
    fn sight(&self, n: Place) -> Option<[f64; 3]> {
        if !self.outside[n] {
            return None;
        }
        let side = if self.flat { 1.0 } else { std::f64::consts::PI };
        let beyond = side * 4.0 * 8.5_f64.powf(-0.25);
        let mut sight = [beyond, 0.0, 0.0];
        for (m, off) in self.within(n, 72.5_f64.sqrt()) {
            if !self.outside[m] {
                let seen = self.seen(off);
                (0..3).for_each(|k| sight[k] += seen[k]);
            }
        }
        (sight[0] > 1.03 * beyond).then_some(sight)
    }

    /// Root of the distance of a straight edge that is seen as much, and the side that the contact is on.
    fn root_and_side(&self, sight: [f64; 3]) -> (f64, [f64; 2]) {
        let edge = if self.flat {
            4.0
        } else {
            10.799_631_181_215_187
        };
        let size = sight[1].hypot(sight[2]).max(f64::MIN_POSITIVE);
        (
            (edge / sight[0]).powi(2),
            [sight[1] / size, sight[2] / size],
        )
    }

    /// Rates of the cells around as functions of what they see, by Householder's reflections instead of
    /// normal equations.
    fn law(&self, n: Place, sights: &Array2<Option<[f64; 3]>>) -> [f64; 11] {
        let closes = self.closing[n];
        let (_, side) = self.root_and_side(sights[n].expect("a cell near the contact"));
        let mut motions: Vec<Vec<f64>> = Vec::new();
        for (m, off) in self.within(n, 7.5) {
            let Some(sight) = sights[m].filter(|_| self.closing[m] > 0.0) else {
                continue;
            };
            let (s, e) = self.root_and_side(sight);
            let [x, y] = self.way(off);
            let way = y * side[0] - x * side[1];
            let weight = (1.0 - (off[0] * off[0] + off[1] * off[1]) / 56.25).sqrt();
            let closing = weight * self.closing[m] / closes;
            let terms = [1.0, 1.0 / s, s, s * s, s * way].map(|term| closing * term);
            for c in 0..2 {
                let mut row = vec![0.0; 12];
                row[5 * c..5 * c + 5].copy_from_slice(&terms);
                row[10] = closing * e[c] / s;
                row[11] = weight * self.motion[c][m] / closes;
                motions.push(row);
            }
        }
        ridge(&mut motions, &[1, 2, 3, 4, 6, 7, 8, 9, 10]);
        least_squares(motions)
    }

    /// The cells nearer to n than `reach`, and the way to them.
    fn within(&self, (i, j): Place, reach: f64) -> impl Iterator<Item = (Place, [f64; 2])> {
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

/// Rows that keep these unknowns small, a thousandth of what there is of them.
fn ridge(rows: &mut Vec<Vec<f64>>, unknowns: &[usize]) {
    for &k in unknowns {
        let square: f64 = rows.iter().map(|row| row[k] * row[k]).sum();
        let mut row = vec![0.0; rows[0].len()];
        row[k] = (1e-6 * square).sqrt();
        rows.push(row);
    }
}

/// The N unknowns of rows that end with the right-hand side.
fn least_squares<const N: usize>(mut rows: Vec<Vec<f64>>) -> [f64; N] {
    for k in 0..N {
        let size = rows[k..]
            .iter()
            .map(|row| row[k] * row[k])
            .sum::<f64>()
            .sqrt();
        let mut mirror: Vec<f64> = rows[k..].iter().map(|row| row[k]).collect();
        mirror[0] += size.copysign(mirror[0]);
        let square: f64 = mirror.iter().map(|v| v * v).sum();
        for c in k..=N {
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
    let mut x = [0.0; N];
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|l| rows[k][l] * x[l]).sum();
        if rows[k][k].abs() > 0.0 {
            x[k] = (rows[k][N] - known) / rows[k][k];
        }
    }
    x
}
