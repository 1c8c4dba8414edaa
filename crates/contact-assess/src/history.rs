//! Stress and plastic strain of points over the moments of a cycle: what every judge takes.

use contact_subsurface::{Eigenstress, Moments, Point};
use ndarray::{Array3, Axis};

/// Stress and plastic strain of points over the moments of a cycle, each of shape (moments, points, 6).
///
/// The total strain is the elastic strain of the stress, which has that of the residual stress in it, and
/// the plastic strain of the same moment.
#[derive(Clone, Debug)]
pub(super) struct History {
    /// The stress that is there \[Pa\].
    pub(super) stress: Array3<f64>,
    /// Plastic strain, of a body that yields.
    pub(super) plastic: Option<Array3<f64>>,
}

/// The plastic strains of some moments; none of a body that stays elastic.
pub(super) struct Strains(Vec<Option<Eigenstress>>);

impl Strains {
    /// Of moments, if they are wanted.
    pub(super) fn of(moments: &Moments, wanted: bool) -> Self {
        let known = wanted.then(|| moments.eigenstress.clone());
        Self(known.unwrap_or_default())
    }

    pub(super) fn are_known(&self) -> bool {
        !self.0.is_empty()
    }
}

impl History {
    /// Of moments and points, with strains or without.
    pub(super) fn zeros((moments, points): (usize, usize), strained: bool) -> Self {
        let stress = Array3::zeros((moments, points, 6));
        let plastic = strained.then(|| stress.clone());
        Self { stress, plastic }
    }

    /// As criteria take it.
    pub(super) fn view(&self) -> fatigue::History<'_> {
        fatigue::History {
            stress: self.stress.view(),
            plastic: self.plastic.as_ref().map(|of| of.view()),
        }
    }

    /// Adds the plastic strain of the moments `which` at the points.
    pub(super) fn add(&mut self, which: &[usize], strains: &Strains, points: &[Point]) {
        let Some(plastic) = &mut self.plastic else {
            return;
        };
        for (k, strain) in which.iter().zip(&strains.0) {
            let Some(strain) = strain else { continue };
            let mut now = plastic.index_axis_mut(Axis(0), *k);
            for (&(x, y, depth), mut at) in points.iter().zip(now.outer_iter_mut()) {
                let found = strain.plastic_strain(x, y, depth);
                at.iter_mut().zip(found).for_each(|(e, found)| *e += found);
            }
        }
    }

    /// Takes the moments `which` of another history, those that it has.
    pub(super) fn take(&mut self, which: &[usize], of: &Self) {
        for (own, of) in self.parts_mut().into_iter().zip(of.parts()) {
            for (k, now) in which.iter().zip(of.outer_iter()) {
                own.index_axis_mut(Axis(0), *k).assign(&now);
            }
        }
    }

    /// The histories of some points.
    pub(super) fn select(&self, points: &[usize]) -> Self {
        let some = |of: &Array3<f64>| of.select(Axis(1), points);
        Self {
            stress: some(&self.stress),
            plastic: self.plastic.as_ref().map(some),
        }
    }

    /// Stress and strain.
    pub(super) fn parts(&self) -> Vec<&Array3<f64>> {
        let both = [Some(&self.stress), self.plastic.as_ref()];
        both.into_iter().flatten().collect()
    }

    /// The same, to be changed.
    pub(super) fn parts_mut(&mut self) -> Vec<&mut Array3<f64>> {
        [Some(&mut self.stress), self.plastic.as_mut()]
            .into_iter()
            .flatten()
            .collect()
    }
}
