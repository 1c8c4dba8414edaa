//! One pass of the fixed point: stress, return, displacement.

use eigenstrain::{Answer, COMPONENTS, Sources};
use plasticity::{Point, Returned, Tensor, YIELDS, contraction, deviator, equivalent_stress};
use rayon::prelude::*;

use super::{NONE, TOLERANCE, YieldingBody};

/// Largest change of the residual displacement in a pass, over its largest.
const DISPLACEMENT: f64 = 1e-4;
/// Part of the yield stress that a plane must reach in the first pass of an increment to be computed in
/// the others.
const NEAR: f64 = 0.75;

/// Stress of a cell of a plane with the stress that all its cells have \[Pa\].
fn whole_stress(plane: &[f64], cell: usize, uniform: &Tensor) -> Tensor {
    let cells = plane.len() / COMPONENTS;
    std::array::from_fn(|c| plane[c * cells + cell] + uniform[c])
}

/// Square of the stress of von Mises \[Pa^2\].
fn square_of_von_mises(stress: &Tensor) -> f64 {
    let s = deviator(stress);
    1.5 * contraction(&s, &s)
}

impl YieldingBody {
    /// Computes stress, plastic strain (return mapping) and displacement under the tractions once. True if
    /// strain and displacement agree with those that the pass began with, within the tolerance.
    pub(in crate::yielding) fn pass(&mut self, tractions: &[Vec<f64>; 3]) -> bool {
        self.tractions = self.tractions_on_body(tractions);
        self.respond();
        let returned = self.returned();
        let reached = returned.iter().map(|(_, most)| *most);
        self.reached = reached.fold(0.0, f64::max).sqrt();
        if !std::mem::replace(&mut self.passed, true) {
            for (wanted, (points, most)) in self.wanted.iter_mut().zip(&returned) {
                *wanted = !points.is_empty() || *most > NEAR * NEAR;
            }
        }
        self.off = self.store_returned(returned);
        let largest = self
            .next_displacement
            .iter()
            .fold(0.0_f64, |m, u| m.max(u.abs()));
        let pairs = self.next_displacement.iter().zip(&self.displacement);
        let moved = pairs.fold(0.0_f64, |m, (to, from)| m.max((to - from).abs()));
        self.off <= TOLERANCE && moved <= DISPLACEMENT * largest
    }

    /// Whether a point yields on a plane that the last pass has left out. Such planes are computed from then
    /// on.
    pub(in crate::yielding) fn others_yield(&mut self) -> bool {
        if self.computed == self.may_yield {
            return false;
        }
        let others: Vec<bool> = (self.may_yield.iter().zip(&self.computed))
            .map(|(may, computed)| *may && !computed)
            .collect();
        let is_wanted = std::mem::replace(&mut self.wanted, others);
        self.respond();
        let returned = self.returned();
        self.wanted = is_wanted;
        for (wanted, (points, _)) in self.wanted.iter_mut().zip(&returned) {
            *wanted |= !points.is_empty();
        }
        self.store_returned(returned) > TOLERANCE
    }

    /// For each plane, the points that yield (index and result of the return mapping), and the square of its
    /// largest stress over the yield stress. The stress at the start of the increment is computed when the
    /// first point yields.
    fn returned(&mut self) -> Vec<(Vec<(usize, Returned)>, f64)> {
        if self.start_stress.is_empty() && self.yields() {
            self.start_stress = self.stress_at_start();
        }
        self.returned_from_start()
    }

    /// Whether a point may leave its yield surface: one has yielded, or the stress goes beyond the yield stress.
    fn yields(&self) -> bool {
        let cells = self.cells();
        let is_beyond = |plane: usize| {
            let (Some((law, _)), true) = (&self.laws[plane], self.wanted[plane]) else {
                return false;
            };
            let stress = &self.stress[plane * COMPONENTS * cells..][..COMPONENTS * cells];
            let limit = law.s_y * (1.0 + YIELDS);
            let uniform = self.uniform_stress(plane, self.bulk[1]);
            (0..cells).any(|cell| {
                square_of_von_mises(&whole_stress(stress, cell, &uniform)) > limit * limit
            })
        };
        !self.active.is_empty() || (0..self.laws.len()).into_par_iter().any(is_beyond)
    }

    /// Computes the stress at the start of the increment on the planes that may yield \[Pa\].
    fn stress_at_start(&mut self) -> Vec<f64> {
        let mut stress = vec![0.0; self.operator.len()];
        let mut strain = vec![0.0; self.operator.len()];
        for (point, start, _) in &self.active {
            for c in 0..COMPONENTS {
                strain[self.index_of_component(*point, c)] = start.strain[c];
            }
        }
        let [x, y, z] = &self.start_tractions;
        let mut displacement = vec![0.0; self.next_everywhere.len()];
        self.operator.apply(
            Sources {
                eigenstrain: (!self.active.is_empty()).then_some(&strain[..]),
                tractions: (!x.is_empty()).then_some([&x[..], y, z]),
            },
            Answer {
                stress: &mut stress,
                wanted: &self.may_yield,
                displacement: &mut displacement,
                of_tractions: false,
            },
        );
        stress
    }

    /// Computes the points and stresses of [`Self::returned`], once the stress at the start of the increment is known.
    fn returned_from_start(&self) -> Vec<(Vec<(usize, Returned)>, f64)> {
        let cells = self.cells();
        let (laws, stress, strain, slot, active) = (
            &self.laws,
            &self.stress,
            &self.strain,
            &self.slot,
            &self.active,
        );
        let block = COMPONENTS * cells;
        let is_wanted = &self.wanted;
        let of_plane = |plane: usize| -> (Vec<(usize, Returned)>, f64) {
            let (Some((law, mu)), true) = (&laws[plane], is_wanted[plane]) else {
                return (Vec::new(), 0.0);
            };
            let (stress, strain) = (
                &stress[plane * block..][..block],
                &strain[plane * block..][..block],
            );
            let start_stress = &self.start_stress.get(plane * block..).unwrap_or_default();
            let start_stress = start_stress.get(..block).unwrap_or_default();
            let slots = &slot[plane * cells..][..cells];
            let [before, now] = self.bulk.map(|bulk| self.uniform_stress(plane, bulk));
            let mut yielded = Vec::new();
            let (limit, mut most) = (law.s_y * (1.0 + YIELDS), 0.0_f64);
            for cell in 0..cells {
                let s = whole_stress(stress, cell, &now);
                let from = || whole_stress(start_stress, cell, &before);
                if slots[cell] == NONE {
                    let square = square_of_von_mises(&s);
                    most = most.max(square);
                    if square > limit * limit {
                        let returned = Point::default().advance(law, *mu, &from(), &s);
                        yielded.push((plane * cells + cell, returned));
                    }
                    continue;
                }
                let (_, start, _) = &active[slots[cell] as usize];
                let trial = std::array::from_fn(|c| {
                    s[c] + 2.0 * mu * (strain[c * cells + cell] - start.strain[c])
                });
                let returned = start.advance(law, *mu, &from(), &trial);
                if returned.flow != [0.0; COMPONENTS] {
                    most = most.max(law.s_y * law.s_y);
                }
                yielded.push((plane * cells + cell, returned));
            }
            (yielded, most / (law.s_y * law.s_y))
        };
        (0..laws.len()).into_par_iter().map(of_plane).collect()
    }

    /// Stores the results of the return mapping; returns the largest change of stress over the yield stress.
    fn store_returned(&mut self, found: Vec<(Vec<(usize, Returned)>, f64)>) -> f64 {
        let cells = self.cells();
        let mut off = 0.0_f64;
        for (point, returned) in found.into_iter().flat_map(|(points, _)| points) {
            if self.slot[point] == NONE {
                self.slot[point] = self.active.len() as u32;
                self.active.push((point, Point::default(), returned));
            }
            let slot = self.slot[point] as usize;
            self.active[slot].2 = returned;
            let change: Tensor = std::array::from_fn(|c| {
                returned.strain[c] - self.strain[self.index_of_component(point, c)]
            });
            if let Some((law, mu)) = &self.laws[point / cells] {
                off = off.max(equivalent_stress(&change) * 2.0 * mu / law.s_y);
            }
        }
        off
    }

    /// Computes the stress of tractions and present strain, and the displacement of the strain alone.
    pub(super) fn respond(&mut self) {
        self.computed.clone_from(&self.wanted);
        let [x, y, z] = &self.tractions;
        let yields = !self.active.is_empty();
        self.operator.apply(
            Sources {
                eigenstrain: yields.then_some(&self.strain[..]),
                tractions: Some([x, y, z]),
            },
            Answer {
                stress: &mut self.stress,
                wanted: &self.wanted,
                displacement: &mut self.next_everywhere,
                of_tractions: false,
            },
        );
        self.volume
            .part_below_contact(&self.next_everywhere, &mut self.next_displacement);
    }
}
