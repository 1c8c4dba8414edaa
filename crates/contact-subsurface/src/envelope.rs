//! Extremes of stress over a load path, and amplitude and mean over each cycle.

use ndarray::Array2;

use super::{Accumulate, Depth, Measure, Moment};

/// Keeps the extremes of measures of stress over the whole path and over each cycle.
#[derive(Clone, Debug)]
pub struct Envelope {
    /// The measures whose extremes are sought.
    pub measures: Vec<Measure>,
    /// First and last branch of each cycle, as in [`contact_core::scene::LoadPath::cycles`].
    pub cycles: Vec<(usize, usize)>,
}

/// Extremes at one depth, shape (measures, places) \[Pa\].
#[derive(Clone, Debug, PartialEq)]
pub struct Extremes {
    /// Largest values.
    pub max: Array2<f64>,
    /// Smallest values.
    pub min: Array2<f64>,
    /// Increment of the largest value, from 1; 0 before any.
    pub increment_of_max: Array2<usize>,
}

/// The accumulator of an [`Envelope`] at one depth.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthEnvelope {
    /// Over the whole path.
    pub path: Extremes,
    /// Over each cycle.
    pub cycles: Vec<Extremes>,
}

impl Extremes {
    /// Extremes before any value: -inf, inf.
    fn empty(shape: (usize, usize)) -> Self {
        Self {
            max: Array2::from_elem(shape, f64::NEG_INFINITY),
            min: Array2::from_elem(shape, f64::INFINITY),
            increment_of_max: Array2::zeros(shape),
        }
    }

    /// Updates the extremes at a place with the value of an increment.
    fn include(&mut self, at: (usize, usize), value: f64, increment: usize) {
        if value > self.max[at] {
            self.max[at] = value;
            self.increment_of_max[at] = increment;
        }
        self.min[at] = self.min[at].min(value);
    }

    /// Half the range \[Pa\].
    pub fn amplitude(&self) -> Array2<f64> {
        (&self.max - &self.min) / 2.0
    }

    /// Middle of the range \[Pa\].
    pub fn mean(&self) -> Array2<f64> {
        (&self.max + &self.min) / 2.0
    }
}

impl Accumulate for Envelope {
    type Accumulator = DepthEnvelope;

    /// Empty extremes of all measures at the places of a depth.
    fn start(&self, _: Depth, places: usize) -> DepthEnvelope {
        let empty = || Extremes::empty((self.measures.len(), places));
        DepthEnvelope {
            path: empty(),
            cycles: self.cycles.iter().map(|_| empty()).collect(),
        }
    }

    /// Updates the extremes of the path and of each cycle with the measures of a stress.
    fn add(&self, kept: &mut DepthEnvelope, moment: Moment, stress: &Array2<f64>) {
        let mut of_cycles: Vec<&mut Extremes> = self
            .cycles
            .iter()
            .zip(&mut kept.cycles)
            .filter(|((first, last), _)| (*first..=*last).contains(&moment.branch))
            .map(|(_, extremes)| extremes)
            .collect();
        for (m, measure) in self.measures.iter().enumerate() {
            for (i, &value) in measure.at_points(&stress.view()).iter().enumerate() {
                kept.path.include((m, i), value, moment.increment);
                for extremes in &mut of_cycles {
                    extremes.include((m, i), value, moment.increment);
                }
            }
        }
    }
}
