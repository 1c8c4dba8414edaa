//! The stress of a point over time, and its strain, written as a stress.
//!
//! Hooke's law of S* = S + 2 G e_p gives the total strain, since the plastic strain e_p keeps the volume:
//!
//! ((1 + nu) S* - nu tr S* 1)/E = ((1 + nu) S - nu tr S 1)/E + e_p,   2 G = E/(1 + nu).
//!
//! So the shear and the normal strain on a plane follow from S*, the normal stress from S. The plastic
//! strain is counted from its value at the first instant: a constant strain has no range, and where
//! nothing yields S* is S to the last bit.

use stress_tensor::StressTensor;

use crate::circle::Circles;
use crate::lanes::Lanes;
use crate::path::{Frame, Path, max_abs, power_of_two};

/// Stress and strain of a point over time.
pub(crate) struct Histories {
    /// The stress.
    pub(crate) stress: Path,
    /// S*, if the plastic strain changes.
    strained: Path,
    yields: bool,
    buffer: Vec<StressTensor>,
}

impl Histories {
    /// Buffers without any instant.
    pub(crate) fn new() -> Self {
        Self {
            stress: Path::new(),
            strained: Path::new(),
            yields: false,
            buffer: Vec::new(),
        }
    }

    /// Takes the stress at every instant \[Pa\], at least one, and 2 G e_p at the same instants \[Pa\],
    /// if there is any.
    pub(crate) fn load(&mut self, stress: &[StressTensor], plastic: Option<&[StressTensor]>) {
        let changes = |strains: &&[StressTensor]| strains.iter().any(|e| *e != strains[0]);
        let Some(plastic) = plastic.filter(changes) else {
            self.yields = false;
            self.stress
                .load(stress, power_of_two(max_abs(stress.as_flattened())));
            return;
        };
        self.yields = true;
        self.buffer.clear();
        let pairs = stress.iter().zip(plastic);
        self.buffer
            .extend(pairs.map(|(s, e)| std::array::from_fn(|c| s[c] + (e[c] - plastic[0][c]))));
        let largest = max_abs(stress.as_flattened()).max(max_abs(self.buffer.as_flattened()));
        let unit = power_of_two(largest);
        self.stress.load(stress, unit);
        self.strained.load(&self.buffer, unit);
    }

    /// S*: the stress plus 2 G times the plastic strain.
    pub(crate) fn strained(&self) -> &Path {
        if self.yields {
            &self.strained
        } else {
            &self.stress
        }
    }

    /// S*, if it differs from the stress.
    pub(crate) fn distinct_strain(&self) -> Option<&Path> {
        self.yields.then_some(&self.strained)
    }

    /// Largest component of any instant by absolute value, of the stress and of S*. The larger of
    /// the two is between 1 and 2, or both are 0.
    pub(crate) fn max_components(&self) -> [f64; 2] {
        let of_stress = self.stress.max_component();
        [
            of_stress,
            self.distinct_strain()
                .map_or(of_stress, Path::max_component),
        ]
    }

    /// Bounds of Tresca's equivalent stress, from von Mises': the largest of any instant, and the largest of
    /// the deviation of S* at any instant from one constant stress.
    pub(crate) fn tresca_bounds(&self) -> (f64, f64) {
        let (whole, deviation) = self.stress.tresca_bounds();
        (
            whole,
            self.distinct_strain()
                .map_or(deviation, |path| path.tresca_bounds().1),
        )
    }

    /// Radius of the smallest circle round the shear of S*, and largest normal stress, on a plane.
    pub(crate) fn shear_and_normal(
        &self,
        n: [f64; 3],
        shear: &mut Vec<[Lanes; 2]>,
        circles: &mut Circles,
    ) -> [f64; 2] {
        let s_n = self
            .stress
            .resolve_on_plane(self.strained(), &Frame::from_normal(n), shear);
        [circles.smallest_circle(shear).radius, s_n]
    }

    /// The tensor whose normal component is half of the difference of the normal strains of two instants.
    pub(crate) fn strain_amplitude_tensor(
        &self,
        ends: [usize; 2],
        [along, across]: [f64; 2],
    ) -> StressTensor {
        let [most, least] = ends.map(|k| self.strained().stress_at(k));
        let change: StressTensor = std::array::from_fn(|c| (most[c] - least[c]) / 2.0);
        let trace = change[0] + change[1] + change[2];
        std::array::from_fn(|c| along * change[c] - if c < 3 { across * trace } else { 0.0 })
    }
}
