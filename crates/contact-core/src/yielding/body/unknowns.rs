//! The unknowns x of the fixed point: growth of the plastic strain, residual displacement.

use eigenstrain::COMPONENTS;
use plasticity::{Point, Returned};

use super::YieldingBody;
use crate::yielding::state::PlasticState;

/// Scale of the displacements in the fixed point, beside strains: small enough that the strains decide
/// the mixing.
const SCALE: f64 = 0.3;

impl YieldingBody {
    /// Guesses the unknowns: the state at the start of the increment, plus `factor` times its growth in the
    /// last increment.
    pub(in crate::yielding) fn guess(&mut self, state: &PlasticState, factor: f64) {
        for (u, growth) in self.displacement.iter_mut().zip(&state.growth) {
            *u += factor * growth;
        }
        for known in &state.points {
            let Some(point) = self.point(known) else {
                continue;
            };
            for (c, growth) in known.growth.iter().enumerate() {
                let at = self.index_of_component(point, c);
                self.strain[at] += factor * growth;
            }
        }
    }

    /// Number of points that have yielded or may.
    pub(in crate::yielding) fn slots(&self) -> usize {
        self.active.len()
    }

    /// Yields the growth of the plastic strain in the increment, as in the present unknowns.
    pub(in crate::yielding) fn grown(&self) -> impl Iterator<Item = f64> {
        self.active.iter().flat_map(|(point, start, _)| {
            (0..COMPONENTS)
                .map(|c| self.strain[self.index_of_component(*point, c)] - start.strain[c])
        })
    }

    /// Yields the growth of the plastic strain in the increment after the last pass.
    pub(in crate::yielding) fn next_grown(&self) -> impl Iterator<Item = f64> {
        let grown = |(_, start, end): &(usize, Point, Returned)| -> [f64; COMPONENTS] {
            std::array::from_fn(|c| end.strain[c] - start.strain[c])
        };
        self.active.iter().flat_map(grown)
    }

    /// Yields the displacement \[m\] over its unit in the unknowns.
    pub(in crate::yielding) fn scaled<'a>(
        &self,
        displacement: &'a [f64],
    ) -> impl Iterator<Item = f64> + use<'a> {
        let unit = self.unit();
        displacement.iter().map(move |u| u / unit)
    }

    /// Unit of the displacements in the unknowns \[m\]: the yield strain along the depth of the first element.
    fn unit(&self) -> f64 {
        let laws = self.laws.iter().flatten();
        let strain = laws
            .map(|(law, mu)| law.s_y / mu)
            .fold(f64::INFINITY, f64::min);
        let mesh = self.mesh();
        let planes = (0..mesh.planes()).filter(|plane| self.may_yield[*plane]);
        let height: f64 = planes.map(|plane| mesh.weight(plane)).sum();
        strain * height / SCALE
    }

    /// Takes the displacement from the unknowns x at index `from`; returns the index after it.
    pub(in crate::yielding) fn take_displacement(&mut self, x: &[f64], from: usize) -> usize {
        let (unit, n) = (self.unit(), self.displacement.len());
        for (u, x) in self.displacement.iter_mut().zip(&x[from..from + n]) {
            *u = x * unit;
        }
        from + n
    }

    /// Takes the plastic strain from the unknowns x at index `from`; returns the index after it.
    pub(in crate::yielding) fn take_strain(&mut self, x: &[f64], from: usize) -> usize {
        let n = COMPONENTS * self.active.len();
        for (slot, grown) in x[from..from + n].chunks_exact(COMPONENTS).enumerate() {
            let (point, start, _) = self.active[slot];
            for c in 0..COMPONENTS {
                let at = self.index_of_component(point, c);
                self.strain[at] = start.strain[c] + grown[c];
            }
        }
        from + n
    }
}
