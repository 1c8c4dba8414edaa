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

impl YieldingBody {
    /// One pass: stress, return, displacement. True where neither strain nor displacement would change
    /// beyond the tolerance.
    pub(in crate::yielding) fn pass(&mut self, tractions: &[Vec<f64>; 3]) -> bool {
        self.tractions = self.facing(tractions);
        self.respond();
        let returned = self.returned();
        let reached = returned.iter().map(|(_, most)| *most);
        self.reached = reached.fold(0.0, f64::max).sqrt();
        if !std::mem::replace(&mut self.passed, true) {
            for (wanted, (points, most)) in self.wanted.iter_mut().zip(&returned) {
                *wanted = !points.is_empty() || *most > NEAR * NEAR;
            }
        }
        self.off = self.take(returned);
        let largest = self
            .next_displacement
            .iter()
            .fold(0.0_f64, |m, u| m.max(u.abs()));
        let pairs = self.next_displacement.iter().zip(&self.displacement);
        let moved = pairs.fold(0.0_f64, |m, (to, from)| m.max((to - from).abs()));
        self.off <= TOLERANCE && moved <= DISPLACEMENT * largest
    }

    /// Whether a point yields on the planes that the last pass has left out, under its tractions and strain.
    /// Those planes are computed from then on.
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
        self.take(returned) > TOLERANCE
    }

    /// Points that yield on each plane that is computed, and its largest stress over the yield stress, squared.
    fn returned(&self) -> Vec<(Vec<(usize, Returned)>, f64)> {
        let cells = self.cells();
        let (laws, stress, strain, slot, active) = (
            &self.laws,
            &self.stress,
            &self.strain,
            &self.slot,
            &self.active,
        );
        let block = COMPONENTS * cells;
        let (wanted, initial) = (&self.wanted, &self.initial);
        let of_plane = |plane: usize| -> (Vec<(usize, Returned)>, f64) {
            let (Some((law, mu)), true) = (&laws[plane], wanted[plane]) else {
                return (Vec::new(), 0.0);
            };
            let (stress, strain) = (
                &stress[plane * block..][..block],
                &strain[plane * block..][..block],
            );
            let slots = &slot[plane * cells..][..cells];
            let mut yielded = Vec::new();
            let (limit, mut most) = (law.s_y * (1.0 + YIELDS), 0.0_f64);
            for cell in 0..cells {
                let mut s: Tensor = std::array::from_fn(|c| stress[c * cells + cell]);
                s[0] += initial[plane][0];
                s[1] += initial[plane][1];
                if slots[cell] == NONE {
                    let s_dev = deviator(&s);
                    let square = 1.5 * contraction(&s_dev, &s_dev);
                    most = most.max(square);
                    if square > limit * limit {
                        yielded.push((plane * cells + cell, Point::default().at(law, *mu, &s)));
                    }
                    continue;
                }
                let (_, start, _) = &active[slots[cell] as usize];
                let trial = std::array::from_fn(|c| {
                    s[c] + 2.0 * mu * (strain[c * cells + cell] - start.strain[c])
                });
                let returned = start.at(law, *mu, &trial);
                if returned.flow != [0.0; COMPONENTS] {
                    most = most.max(law.s_y * law.s_y);
                }
                yielded.push((plane * cells + cell, returned));
            }
            (yielded, most / (law.s_y * law.s_y))
        };
        (0..laws.len()).into_par_iter().map(of_plane).collect()
    }

    /// Takes the returned points; gives the largest change of the stress over the yield stress.
    fn take(&mut self, found: Vec<(Vec<(usize, Returned)>, f64)>) -> f64 {
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

    /// Stress of the tractions and the present strain, displacement of the strain alone.
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
