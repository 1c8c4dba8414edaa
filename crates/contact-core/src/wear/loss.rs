//! Worn depth, and what a jump adds to it.

use serde::{Deserialize, Serialize};

/// Depth worn off body 1 and body 2, each in its own coordinates, on the kept cells \[m\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Worn {
    pub(crate) depth: [Vec<f64>; 2],
}

impl Worn {
    pub(crate) fn none(cells: usize) -> Self {
        Self {
            depth: [vec![0.0; cells], vec![0.0; cells]],
        }
    }

    pub(crate) fn add(&mut self, loss: &Loss) {
        for (worn, loss) in self.depth.iter_mut().zip(&loss.depth) {
            worn.iter_mut()
                .zip(loss)
                .for_each(|(worn, loss)| *worn += loss);
        }
    }

    pub(crate) fn deepest(&self) -> f64 {
        self.depth.iter().flatten().fold(0.0, |m, w| m.max(*w))
    }
}

/// What a jump takes from both bodies.
#[derive(Clone, Debug)]
pub(crate) struct Loss {
    /// Depth \[m\], >= 0.
    pub(crate) depth: [Vec<f64>; 2],
    /// Energy dissipated in all its cycles \[J\].
    pub(crate) dissipated: f64,
}

impl Loss {
    /// Both together.
    pub(crate) fn with(mut self, other: &Self) -> Self {
        for (a, b) in self.depth.iter_mut().zip(&other.depth) {
            a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
        }
        self.dissipated += other.dissipated;
        self
    }

    /// Extrapolates two halves by one whole jump to second order, `2 halves - whole`
    /// (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.4),
    /// and the depth that this moves, root mean square over that of the `worn` depth at the end.
    ///
    /// Nothing grows: where the extrapolation would add material it takes nothing, and all the rest in
    /// proportion less, so that the volume is that of the extrapolation.
    pub(crate) fn extrapolated(mut self, whole: &Self, worn: &Worn) -> (Self, f64) {
        let (mut moved, mut size) = (0.0, 0.0);
        for b in 0..2 {
            let (mut asked, mut taken) = (0.0, 0.0);
            for (n, depth) in self.depth[b].iter_mut().enumerate() {
                let change = *depth - whole.depth[b][n];
                moved += change * change;
                size += (worn.depth[b][n] + *depth).powi(2);
                asked += *depth + change;
                *depth = (*depth + change).max(0.0);
                taken += *depth;
            }
            let part = if taken > 0.0 {
                (asked / taken).max(0.0)
            } else {
                0.0
            };
            self.depth[b].iter_mut().for_each(|depth| *depth *= part);
        }
        self.dissipated = 2.0 * self.dissipated - whole.dissipated;
        (self, (moved / f64::max(size, f64::MIN_POSITIVE)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::{Loss, Worn};

    #[test]
    fn extrapolation_keeps_the_volume_and_nothing_grows() {
        let mut rng = fastrand::Rng::with_seed(3);
        for _ in 0..200 {
            let mut field =
                || -> Vec<f64> { (0..30).map(|_| (rng.f64() - 0.4).max(0.0)).collect() };
            let halves = Loss {
                depth: [field(), field()],
                dissipated: 3.0,
            };
            let whole = Loss {
                depth: [field(), field()],
                dissipated: 2.0,
            };
            let sum = |f: &[f64]| f.iter().sum::<f64>();
            let asked = [0, 1].map(|b| 2.0 * sum(&halves.depth[b]) - sum(&whole.depth[b]));
            let (found, error) = halves.extrapolated(&whole, &Worn::none(30));
            assert!(error > 0.0 && (found.dissipated - 4.0).abs() < 1e-15);
            for b in 0..2 {
                assert!(found.depth[b].iter().all(|w| *w >= 0.0));
                assert!((sum(&found.depth[b]) - asked[b].max(0.0)).abs() < 1e-12);
            }
        }
    }
}
