//! Stress and plastic strain of points over the moments of a cycle: the input of every judge.

use contact_subsurface::{Eigenstress, Moments, Point};
use ndarray::{Array3, Axis};

/// Stress and plastic strain of points over the moments of a cycle, each of shape (moments, points, 6).
///
/// The total strain is the elastic strain of the stress, residual stress included, and the plastic
/// strain of the same moment.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// The total stress \[Pa\].
    pub(super) stress: Array3<f64>,
    /// Plastic strain, of a body that yields.
    pub(super) plastic: Option<Array3<f64>>,
}

/// The plastic strains of some moments; none of a body that stays elastic.
pub(super) struct Strains(Vec<Option<Eigenstress>>);

impl Strains {
    /// Takes the strains of some moments, if `wanted`.
    pub(super) fn from_moments(moments: &Moments, wanted: bool) -> Self {
        let strains = wanted.then(|| moments.eigenstress.clone());
        Self(strains.unwrap_or_default())
    }

    /// Whether there is plastic strain.
    pub(super) fn is_present(&self) -> bool {
        !self.0.is_empty()
    }
}

impl History {
    /// Zeros for moments and points, with strains if `strained`.
    pub(super) fn zeros((moments, points): (usize, usize), strained: bool) -> Self {
        let stress = Array3::zeros((moments, points, 6));
        let plastic = strained.then(|| stress.clone());
        Self { stress, plastic }
    }

    /// The history as criteria take it.
    pub(super) fn view(&self) -> fatigue::History<'_> {
        fatigue::History {
            stress: self.stress.view(),
            plastic: self.plastic.as_ref().map(|of| of.view()),
        }
    }

    /// Adds the plastic strain of the moments `which` at the points.
    pub(super) fn add_strains(&mut self, which: &[usize], strains: &Strains, points: &[Point]) {
        let Some(plastic) = &mut self.plastic else {
            return;
        };
        for (k, strain) in which.iter().zip(&strains.0) {
            let Some(strain) = strain else { continue };
            let mut now = plastic.index_axis_mut(Axis(0), *k);
            for (&(x, y, depth), mut at) in points.iter().zip(now.outer_iter_mut()) {
                let strain_at_point = strain.plastic_strain(x, y, depth);
                at.iter_mut()
                    .zip(strain_at_point)
                    .for_each(|(e, strain_at_point)| *e += strain_at_point);
            }
        }
    }

    /// Copies the moments `which` from a history that has just these.
    pub(super) fn copy_moments(&mut self, which: &[usize], source: &Self) {
        for (own, source) in self.fields_mut().into_iter().zip(source.fields()) {
            for (k, now) in which.iter().zip(source.outer_iter()) {
                own.index_axis_mut(Axis(0), *k).assign(&now);
            }
        }
    }

    /// The histories of some points.
    pub(super) fn select(&self, points: &[usize]) -> Self {
        let some = |field: &Array3<f64>| field.select(Axis(1), points);
        Self {
            stress: some(&self.stress),
            plastic: self.plastic.as_ref().map(some),
        }
    }

    /// The fields: stress and, if present, strain.
    pub(super) fn fields(&self) -> Vec<&Array3<f64>> {
        let fields = [Some(&self.stress), self.plastic.as_ref()];
        fields.into_iter().flatten().collect()
    }

    /// The fields, mutable.
    pub(super) fn fields_mut(&mut self) -> Vec<&mut Array3<f64>> {
        [Some(&mut self.stress), self.plastic.as_mut()]
            .into_iter()
            .flatten()
            .collect()
    }
}
