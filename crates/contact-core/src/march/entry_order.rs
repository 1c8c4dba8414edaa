//! Cells near the contact enter it one after another.
//!
//! The contact kept to its old cells tells at what rates c and m the gaps of cells outside close and the
//! cells move, as functions of what they see of the contact ([`View`]). As a cell enters, those beyond see
//! more contact and go on at the rates that belong to that:
//!
//! ```text
//! c = k_1 s + k_2 s^2 + k_3 s^3,   m/c = A + B/s + C s + E e/s,   s = d^(1/2)
//! ```
//!
//! with coefficients from least squares over the cells around; both also change along the edge. A cell
//! enters when its gap has closed; what it has moved by then is the sum over the stages: nearly what
//! increments of one cell each would make of it. Where gap and motion are alike m/c = A everywhere, and
//! the motion exact.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::kept_contact::{KeptContact, TASK};
use super::least_squares::{LeastSquares, RIDGE};
use super::view::{REACH, View};

/// How far the cells around reach that the rates are fitted to, in cells.
pub(super) const AROUND: isize = 5;
/// Least rate at which a gap closes, over that with the contact kept.
const SLOWEST: f64 = 1e-3;

/// Rates of a cell over the increment \[m\].
#[derive(Clone, Copy)]
struct Rates {
    closing: f64,
    motion: [f64; 2],
}

/// How the rates of a cell depend on what it sees.
struct Law {
    /// k_1 to k_3
    closing: [f64; 3],
    least: f64,
    /// A, B, C for each component.
    ratio: [[f64; 3]; 2],
    /// E
    toward: f64,
}

impl Law {
    fn rates(&self, view: &View) -> Rates {
        let (s, e) = (view.root(), view.toward());
        let closing = polynomial(self.closing, s).max(self.least);
        let ratio = |n: usize| {
            let [a, b, c] = self.ratio[n];
            a + (b + self.toward * e[n]) / s + c * s
        };
        Rates {
            closing,
            motion: [closing * ratio(0), closing * ratio(1)],
        }
    }
}

/// A cell on its way into the contact.
struct Entering {
    cell: usize,
    view: View,
    law: Law,
    rates: Rates,
    /// What is left of its gap \[m\].
    gap: f64,
    moved: [f64; 2],
    /// The part of the increment that has passed.
    time: f64,
    inside: bool,
}

impl Entering {
    /// When it enters if nothing else does.
    fn entry(&self) -> f64 {
        self.time + (self.gap / self.rates.closing).max(0.0)
    }

    fn go_on_until(&mut self, time: f64) {
        let passed = time - self.time;
        self.gap -= passed * self.rates.closing;
        for (moved, rate) in self.moved.iter_mut().zip(self.rates.motion) {
            *moved += passed * rate;
        }
        self.time = time;
    }
}

/// The motion before their entry of those `cells` that enter in the increment, `views` what the cells
/// outside see whose rates are told from.
pub(super) fn moved(
    contact: &KeptContact,
    views: &[Option<View>],
    cells: &[usize],
) -> Vec<[f64; 2]> {
    let enter = |&cell: &usize| {
        let view = views[cell].expect("a cell that enters is seen from");
        Entering {
            cell,
            view,
            law: law(contact, views, cell, &view),
            rates: Rates {
                closing: contact.closing[cell],
                motion: [0, 1].map(|c| contact.motion[c][cell]),
            },
            gap: contact.gap[cell],
            moved: [0.0; 2],
            time: 0.0,
            inside: false,
        }
    };
    let enter = cells.par_iter().with_min_len(TASK).map(enter);
    let mut entering: Vec<Entering> = enter.collect();
    let mut places = vec![None; views.len()];
    for (k, &cell) in cells.iter().enumerate() {
        places[cell] = Some(k);
    }
    // Times are not negative: their bits have their order.
    let when = |cell: &Entering, k: usize| Reverse((cell.entry().to_bits(), k));
    let queue = entering.iter().enumerate();
    let mut queue: BinaryHeap<_> = queue.map(|(k, cell)| when(cell, k)).collect();
    while let Some(Reverse((time, k))) = queue.pop() {
        let next = &mut entering[k];
        // Cells that entered meanwhile have slowed it down.
        if next.entry().to_bits() > time {
            queue.push(when(next, k));
            continue;
        }
        let time = next.entry();
        next.go_on_until(time);
        next.inside = true;
        for near in contact.cells.of(next.cell, REACH) {
            let Some(beside) = places[near.cell].map(|k| &mut entering[k]) else {
                continue;
            };
            if !beside.inside {
                beside.go_on_until(time.max(beside.time));
                beside.view.add(&near.back());
                beside.rates = beside.law.rates(&beside.view);
            }
        }
    }
    entering.iter().map(|cell| cell.moved).collect()
}

/// The law of a cell, by least squares over those around that tell, nearer ones with more weight.
fn law(contact: &KeptContact, views: &[Option<View>], n: usize, view: &View) -> Law {
    let unit = contact.closing[n];
    let [e_x, e_y] = view.toward();
    let along = [-e_y, e_x];
    let mut closings = LeastSquares::<4, 1>::new();
    // Of the motion and of e/s, both times the closing.
    let mut ratios = LeastSquares::<4, 4>::new();
    let (mut motion_e, mut e_e) = (0.0, 0.0);
    for near in contact.cells.of(n, AROUND) {
        let (m, [x, y]) = (near.cell, near.off);
        let Some(view) = &views[m] else { continue };
        let (s, way) = (view.root(), along[0] * x + along[1] * y);
        let weight = near.nearness(AROUND);
        let closing = contact.closing[m] / unit;
        closings.add(weight, [s, s * s, s * s * s, s * way], [closing]);
        let [e_x, e_y] = view.toward().map(|e| closing * e / s);
        let [x, y] = [0, 1].map(|c| contact.motion[c][m] / unit);
        let values = [x, near.sign * y, e_x, near.sign * e_y];
        let terms = [1.0, 1.0 / s, s, way].map(|term| closing * term);
        ratios.add(weight, terms, values);
        motion_e += weight * (values[0] * values[2] + values[1] * values[3]);
        e_e += weight * (values[2] * values[2] + values[3] * values[3]);
    }
    let factors = ratios.factors();
    // What the other terms leave of the motion and of e tells E.
    let left =
        |x: usize, all: f64| all - ratios.told(&factors[x], 2) - ratios.told(&factors[x + 1], 3);
    let toward = left(0, motion_e) / left(2, e_e * (1.0 + RIDGE)).max(f64::MIN_POSITIVE);
    let ratio = |c: usize| [0, 1, 2].map(|k| factors[c][k] - toward * factors[c + 2][k]);
    let [[k_1, k_2, k_3, _]] = closings.factors();
    let told = polynomial([k_1, k_2, k_3], view.root());
    Law {
        // The cell's own rate is known.
        closing: if told > 0.0 {
            [k_1, k_2, k_3].map(|k| k * unit / told)
        } else {
            [unit / view.root(), 0.0, 0.0]
        },
        least: SLOWEST * unit,
        ratio: [ratio(0), ratio(1)],
        toward,
    }
}

/// k_1 s + k_2 s^2 + k_3 s^3
fn polynomial(k: [f64; 3], s: f64) -> f64 {
    s * (k[0] + s * (k[1] + s * k[2]))
}

#[cfg(test)]
mod tests {
    use crate::convolution::Mirror;
    use crate::march::kept_contact::KeptContact;
    use crate::march::neighbours::Neighbours;
    use crate::march::view::{REACH, View};
    use crate::scene::Grid;

    /// Once a cell has entered, those beyond close and move like the cells that were one nearer to the contact.
    #[test]
    fn cells_in_a_row_enter_one_after_another() {
        let (n, contact) = (40, 20);
        let grid = Grid::strip(1.0, n, 1.0).unwrap();
        let cells = Neighbours::new(&grid, Mirror::None, REACH);
        let rates = |cell: usize| {
            let view = View::of(cell, &cells, |m| m < contact);
            let s = view.map_or(f64::INFINITY, |view| view.root());
            let closing = 2.0 * s + 0.3 * s * s;
            (closing, closing * (0.2 + 0.05 / s - 0.01 * s))
        };
        let seen = |cell: &usize| View::of(*cell, &cells, |m| m < contact).is_some();
        let outside: Vec<usize> = (contact..n).filter(seen).collect();
        let rates: Vec<(f64, f64)> = outside.iter().map(|&cell| rates(cell)).collect();
        let gap = |k: usize| 0.4 * (k as f64 + 0.7).powf(1.5);
        let mut kept = KeptContact {
            gap: vec![1.0; n],
            closing: vec![-1.0; n],
            motion: [vec![0.0; n], vec![0.0; n]],
            cells,
        };
        for (k, &cell) in outside.iter().enumerate() {
            kept.gap[cell] = gap(k);
            (kept.closing[cell], kept.motion[0][cell]) = rates[k];
        }
        let moved = kept.moved(|cell| cell >= contact);
        for k in 0..3 {
            let (mut left, mut way): (Vec<f64>, f64) = ((0..=k).map(gap).collect(), 0.0);
            for entered in 0..=k {
                let time = left[entered] / rates[0].0;
                (entered..=k).for_each(|other| left[other] -= time * rates[other - entered].0);
                way += time * rates[k - entered].1;
            }
            let off = moved[0][outside[k]] - way;
            assert!(off.abs() < 1e-3 * way, "{k}: off by {off:e} of {way:e}");
        }
    }
}
