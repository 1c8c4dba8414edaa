//! The order in which cells near the contact enter it within an increment.
//!
//! The solution on the old contact gives the rates of all cells outside over the increment: the gap
//! of cell n closes by c_n, the cell moves by m_n. These rates hold until the first cell enters.
//! From then on the pressure on that cell keeps its gap closed, and reduces the closing rate of
//! every other cell,
//!
//! ```text
//! c_m -> c_m - (S_mn/S_nn) c_n,
//! ```
//!
//! S the response of cells outside while the contact is held ([`Screened`]). The motion per closing
//! is taken as a function of the distance d to the contact ([`View`]), with e the direction towards
//! it,
//!
//! ```text
//! m/c = A + B/s + C s + D s^2 + E e/s,   s = d^(1/2),
//! ```
//!
//! fitted by least squares to the cells around (a further term, linear along the edge, is fitted
//! and left out). Each entry brings the contact nearer to the cells beyond, which changes their
//! m/c. A cell enters when its gap has closed; its motion before entry is the sum over the stages.
//! The result is close to a path with one increment per entering cell. Where gap and motion
//! are proportional, m/c = A everywhere and the motion is exact.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::kept_contact::KeptContact;
use super::least_squares::{LeastSquares, RIDGE};
use super::neighbours::{Neighbour, TASK};
use super::view::{REACH, View};
use crate::march::domain::AROUND;

/// Radius within which cells count in the fit of m/c, in cells.
pub(super) const FITTED: isize = AROUND as isize;
/// Lower bound of a closing rate, over the rate of the old contact.
const SLOWEST: f64 = 1e-3;

/// Cells whose times of entry differ by less than this part of the increment enter together, as
/// mirror images do.
const AT_ONCE: f64 = 1e-4;

/// m/c as a function of the distance and direction of the contact.
struct MotionRatio {
    /// A, B, C, D for each component.
    ratio: [[f64; 4]; 2],
    /// E
    toward: f64,
}

impl MotionRatio {
    /// m/c, motion over closing of a cell, by the fit, with the cell's view of the contact.
    fn ratio(&self, view: &View) -> [f64; 2] {
        let (s, e) = (view.root(), view.toward());
        std::array::from_fn(|n| {
            let [a, b, c, d] = self.ratio[n];
            a + (b + self.toward * e[n]) / s + (c + d * s) * s
        })
    }
}

/// A cell that enters in the increment.
struct Entering {
    cell: usize,
    view: View,
    law: MotionRatio,
    /// Closing rate and its lower bound, over a whole increment \[m\].
    closing: f64,
    slowest: f64,
    /// Rate of its motion, over a whole increment \[m\].
    motion: [f64; 2],
    /// Gap at `time` \[m\].
    gap: f64,
    moved: [f64; 2],
    /// Part of the increment up to which gap and motion are integrated.
    time: f64,
    stage: Stage,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Outside,
    Enters,
    Inside,
}

impl Entering {
    /// The time, as a part of the increment, at which the cell enters if it goes on closing at its present
    /// rate.
    fn entry_time(&self) -> f64 {
        self.time + (self.gap / self.closing).max(0.0)
    }

    /// Advances gap and motion at the present rates to a time, a part of the increment.
    fn advance_to(&mut self, time: f64) {
        let passed = time - self.time;
        self.gap -= passed * self.closing;
        for (moved, rate) in self.moved.iter_mut().zip(self.motion) {
            *moved += passed * rate;
        }
        self.time = time;
    }

    /// Adds a cell that has come into contact to the view, reduces the closing rate by `held_back` \[m\], and
    /// updates the rate of motion.
    fn add_contact_cell(&mut self, near: &Neighbour, held_back: f64) {
        self.view.add(near);
        self.closing = (self.closing - held_back).max(self.slowest);
        self.motion = self.law.ratio(&self.view).map(|ratio| ratio * self.closing);
    }
}

/// The motion before entry \[m\] of the entering `cells`, one by one in the order of their entry. `views` has
/// the contact as seen from all cells that the fits use.
pub(super) fn moved(
    contact: &KeptContact,
    views: &[Option<View>],
    cells: &[usize],
) -> Vec<[f64; 2]> {
    let start = |&cell: &usize| {
        let view = views[cell].expect("a cell that enters is seen from");
        Entering {
            cell,
            view,
            law: fit_motion_ratio(contact, views, cell, &view),
            closing: contact.closing[cell],
            slowest: SLOWEST * contact.closing[cell],
            motion: [0, 1].map(|c| contact.motion[c][cell]),
            gap: contact.gap[cell],
            moved: [0.0; 2],
            time: 0.0,
            stage: Stage::Outside,
        }
    };
    let entering = cells.par_iter().with_min_len(TASK).map(start);
    let mut entering: Vec<Entering> = entering.collect();
    let mut places = vec![None; views.len()];
    for (k, &cell) in cells.iter().enumerate() {
        places[cell] = Some(k);
    }
    let mut queue = Queue::new(&entering);
    let (mut together, mut held_back) = (Vec::new(), Vec::new());
    while let Some(next) = queue.next(&entering, f64::INFINITY) {
        let time = entering[next].entry_time();
        together.clear();
        together.push(next);
        while let Some(twin) = queue.next(&entering, time + AT_ONCE) {
            together.push(twin);
        }
        for &k in &together {
            let cell = &mut entering[k];
            cell.advance_to(cell.entry_time());
            cell.stage = Stage::Enters;
        }
        hold_back(contact, &entering, &places, &together, &mut held_back);
        for &k in &together {
            entering[k].stage = Stage::Inside;
        }
        for (k, near, by) in held_back.drain(..) {
            entering[k].advance_to(time);
            entering[k].add_contact_cell(&near, by);
            queue.put(k, entering[k].entry_time());
        }
    }
    entering.iter().map(|cell| cell.moved).collect()
}

/// The cells that are yet to enter, ordered by time of entry.
struct Queue {
    cells: BinaryHeap<Reverse<(u64, usize)>>,
    /// Earliest queued time of each cell, 0 once it has entered. Times are not negative, so that
    /// their bits have their order.
    due: Vec<u64>,
}

impl Queue {
    /// Queues all entering cells for their present times of entry.
    fn new(entering: &[Entering]) -> Self {
        let mut queue = Self {
            cells: BinaryHeap::with_capacity(entering.len()),
            due: vec![u64::MAX; entering.len()],
        };
        for (k, cell) in entering.iter().enumerate() {
            queue.put(k, cell.entry_time());
        }
        queue
    }

    /// Queues a cell, unless it is queued for an earlier time.
    fn put(&mut self, k: usize, time: f64) {
        if time.to_bits() < self.due[k] {
            self.due[k] = time.to_bits();
            self.cells.push(Reverse((time.to_bits(), k)));
        }
    }

    /// Removes the cell that enters next, if it does so before `time`.
    fn next(&mut self, entering: &[Entering], time: f64) -> Option<usize> {
        while let Some(&Reverse((due, k))) = self.cells.peek() {
            if f64::from_bits(due) > time {
                return None;
            }
            self.cells.pop();
            if due != self.due[k] {
                continue;
            }
            // Entries since it was queued may have reduced its rate.
            let entry = entering[k].entry_time();
            self.due[k] = 0;
            if entry.to_bits() <= due {
                return Some(k);
            }
            self.due[k] = u64::MAX;
            self.put(k, entry);
        }
        None
    }
}

/// Appends to `held_back` the reductions of the closing rates of cells around those that enter `together`, with
/// their numbers in `entering`. The pressures of the new cells are taken proportional to their closing rates,
/// and so large that these vanish.
fn hold_back(
    contact: &KeptContact,
    entering: &[Entering],
    places: &[Option<usize>],
    together: &[usize],
    held_back: &mut Vec<(usize, Neighbour, f64)>,
) {
    for &k in together {
        let cell = &entering[k];
        let root = cell.view.root();
        let self_response = contact.screened.self_response(root);
        let (first, mut with) = (held_back.len(), 0.0);
        for near in contact.cells.neighbours_within(cell.cell, REACH) {
            let Some(k) = places[near.cell].filter(|&k| entering[k].stage != Stage::Inside) else {
                continue;
            };
            let neighbour = &entering[k];
            let response = match near.square {
                0 => self_response,
                _ => (contact.screened).screened_response(&near, [neighbour.view.root(), root]),
            };
            if neighbour.stage == Stage::Enters {
                with += response * neighbour.closing;
            } else {
                held_back.push((k, near.back(), response));
            }
        }
        // Pressure lifts neighbours on a thin soft layer: their (negative) response counts for at
        // most half of the cell's own.
        let closing = with.max(0.5 * self_response * cell.closing);
        let pressure = cell.closing * cell.closing / closing;
        for (_, _, by) in &mut held_back[first..] {
            *by *= pressure;
        }
    }
}

/// Fits m/c at cell n to the cells around it by least squares, weighted by nearness.
fn fit_motion_ratio(
    contact: &KeptContact,
    views: &[Option<View>],
    n: usize,
    view: &View,
) -> MotionRatio {
    let unit = contact.closing[n];
    let [e_x, e_y] = view.toward();
    let along = [-e_y, e_x];
    // Of the motion and of e/s, both times the closing rate.
    let mut ratios = LeastSquares::<5, 4>::new();
    let (mut motion_e, mut e_e) = (0.0, 0.0);
    for near in contact.cells.neighbours_within(n, FITTED) {
        let (m, [x, y]) = (near.cell, near.off);
        let Some(view) = &views[m] else { continue };
        let (s, way) = (view.root(), along[0] * x + along[1] * y);
        let weight = near.nearness(FITTED);
        let closing = contact.closing[m] / unit;
        let [e_x, e_y] = view.toward().map(|e| closing * e / s);
        let [x, y] = [0, 1].map(|c| contact.motion[c][m] / unit);
        let values = [x, near.sign * y, e_x, near.sign * e_y];
        let terms = [1.0, 1.0 / s, s, s * s, s * way].map(|term| closing * term);
        ratios.add(weight, terms, values);
        motion_e += weight * (values[0] * values[2] + values[1] * values[3]);
        e_e += weight * (values[2] * values[2] + values[3] * values[3]);
    }
    let factors = ratios.factors();
    // E from the residuals of the motion and of e after the other terms (Frisch-Waugh).
    let residual = |x: usize, all: f64| {
        all - ratios.fitted(&factors[x], 2) - ratios.fitted(&factors[x + 1], 3)
    };
    let toward = residual(0, motion_e) / residual(2, e_e * (1.0 + RIDGE)).max(f64::MIN_POSITIVE);
    let ratio = |c: usize| [0, 1, 2, 3].map(|k| factors[c][k] - toward * factors[c + 2][k]);
    MotionRatio {
        ratio: [ratio(0), ratio(1)],
        toward,
    }
}

#[cfg(test)]
mod tests {
    use ndarray::{Array2, Axis};

    use crate::linear_system::solve;
    use crate::march::entry::kept_contact::KeptContact;
    use crate::march::entry::neighbours::Neighbours;
    use crate::march::entry::screened::Screened;
    use crate::march::entry::screened::tests::{half_space, of_all};
    use crate::march::entry::view::{REACH, View};
    use crate::plan::Mirror;
    use crate::scene::Grid;

    /// Strips, the first of them in contact, and those that enter.
    const STRIPS: usize = 60;
    const CONTACT: usize = 40;
    const ENTER: usize = 5;

    /// Each stage solved for itself, with as many strips in contact as have entered by then.
    #[test]
    fn cells_in_a_row_enter_one_after_another() {
        let grid = Grid::strip(1.0, STRIPS, 1.0).unwrap();
        let kernel = half_space(&grid);
        let response_matrix = of_all(&grid, &kernel);
        let cells = Neighbours::new(&grid, Mirror::None, REACH, &kernel);
        let rates = |contact: usize, cell: usize| {
            let (held, others) = response_matrix.view().split_at(Axis(0), contact);
            let (inside, _) = held.split_at(Axis(1), contact);
            let (to, _) = others.split_at(Axis(1), contact);
            let p = solve(&inside.to_owned(), &Array2::ones((contact, 1)));
            let lifted = to.dot(&p)[(cell - contact, 0)];
            let s = View::from_cell(cell, &cells, |m| m < contact)
                .map_or(f64::INFINITY, |view| view.root());
            [1.0 - lifted, (1.0 - lifted) * (0.2 + 0.05 / s - 0.01 * s)]
        };
        let gap = |k: usize| 0.02 * (k as f64 + 0.7).powf(1.5);
        let mut moved = [[0.0; 2]; ENTER];
        let mut time = 0.0;
        for entered in 0..ENTER {
            let rates: Vec<[f64; 2]> = (entered..ENTER)
                .map(|k| rates(CONTACT + entered, CONTACT + k))
                .collect();
            let passes = (gap(entered) - moved[entered][0]) / rates[0][0];
            time += passes;
            for (moved, rates) in moved[entered..].iter_mut().zip(rates) {
                (0..2).for_each(|c| moved[c] += passes * rates[c]);
            }
        }
        let first: Vec<[f64; 2]> = (CONTACT..STRIPS).map(|cell| rates(CONTACT, cell)).collect();
        let field = |inside: f64, of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let outside = |n: usize| n.checked_sub(CONTACT).map_or(inside, of);
            (0..STRIPS).map(outside).collect()
        };
        let kept = KeptContact {
            gap: field(0.0, &|k| if k < ENTER { gap(k) } else { 10.0 }),
            closing: field(-1.0, &|k| 1.01 * time * first[k][0]),
            motion: [
                field(0.0, &|k| 1.01 * time * first[k][1]),
                vec![0.0; STRIPS],
            ],
            cells,
            screened: Screened::new(&grid, &kernel),
            ordered: true,
        };
        let motions = kept.motion_before_entry(|cell| cell >= CONTACT);
        for (k, [_, way]) in moved.iter().enumerate() {
            let off = (motions[0][CONTACT + k] - way).abs() / way;
            assert!(off < 0.01, "{k}: off by {off:e} of the way");
        }
    }
}
