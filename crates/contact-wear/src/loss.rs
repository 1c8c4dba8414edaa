//! Worn depth, and the loss in a jump.

use serde::{Deserialize, Serialize};

/// The history of the surfaces, on the kept cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Worn {
    /// Cycles done.
    pub(crate) cycles: f64,
    /// Depth worn off body 1 and body 2, each in its own coordinates \[m\].
    pub(crate) depth: [Vec<f64>; 2],
    /// Energy per area dissipated at body 1 and body 2, each in its own coordinates \[J/m^2\].
    pub(crate) energy: [Vec<f64>; 2],
    /// Slip distance in contact, in the cells of the grid \[m\].
    pub(crate) slid: Vec<f64>,
    /// Debris per area in the contact, in the cells of the grid \[m\]; zero without a bed.
    pub(crate) bed: Vec<f64>,
    /// Sum over the cells of the debris that has left \[m\].
    pub(crate) ejected: f64,
}

impl Worn {
    /// Surfaces without wear on so many cells.
    pub(crate) fn unworn(cells: usize) -> Self {
        let field = || vec![0.0; cells];
        Self {
            cycles: 0.0,
            depth: [field(), field()],
            energy: [field(), field()],
            slid: field(),
            bed: field(),
            ejected: 0.0,
        }
    }

    /// Adds the loss of a jump; the bed becomes the bed at its end.
    pub(crate) fn add(&mut self, loss: &Loss) {
        self.cycles += loss.cycles;
        for b in 0..2 {
            add_to(&mut self.depth[b], &loss.depth[b]);
            add_to(&mut self.energy[b], &loss.energy[b]);
        }
        add_to(&mut self.slid, &loss.slid);
        if let Some(debris) = &loss.debris {
            self.bed.clone_from(&debris.bed);
            self.ejected += debris.ejected;
        }
    }

    /// The largest worn depth of either body \[m\].
    pub(crate) fn deepest(&self) -> f64 {
        self.depth.iter().flatten().fold(0.0, |m, w| m.max(*w))
    }
}

/// The loss of both bodies in a jump.
#[derive(Clone, Debug)]
pub(crate) struct Loss {
    /// Length in cycles.
    pub(crate) cycles: f64,
    /// Depth \[m\], >= 0.
    pub(crate) depth: [Vec<f64>; 2],
    /// Energy per area in the coordinates of each body \[J/m^2\], >= 0.
    pub(crate) energy: [Vec<f64>; 2],
    /// Way slipped in contact \[m\].
    pub(crate) slid: Vec<f64>,
    /// Energy dissipated in all its cycles \[J\].
    pub(crate) dissipated: f64,
    /// Integral of the pressure over the slip in all its cycles \[N m\].
    pub(crate) loading: f64,
    /// Debris at its end, with a bed.
    pub(crate) debris: Option<Debris>,
}

/// Debris at the end of a jump.
#[derive(Clone, Debug)]
pub(crate) struct Debris {
    /// Volume per area \[m\], >= 0.
    pub(crate) bed: Vec<f64>,
    /// Sum over the cells of the debris that left in the jump \[m\].
    pub(crate) ejected: f64,
}

impl Debris {
    /// Extrapolates the bed of two half jumps by the bed of one `whole` jump. A bed that would be negative is
    /// set to zero, and the other cells hold so much less.
    fn extrapolated(mut self, whole: &Self) -> Self {
        let sum = |bed: &[f64]| bed.iter().sum::<f64>();
        let exact = 2.0 * sum(&self.bed) - sum(&whole.bed);
        extrapolate(&mut self.bed, &whole.bed);
        // Without any debris left in the sum, the rest has left.
        self.ejected = 2.0 * self.ejected - whole.ejected + exact.min(0.0);
        self
    }
}

impl Loss {
    /// Mean coefficient of friction over the slip under pressure, `nominal` where nothing slips.
    pub(crate) fn mean_mu(&self, nominal: f64) -> f64 {
        let mu = self.dissipated / self.loading;
        if self.loading > 0.0 && mu > 0.0 {
            mu
        } else {
            nominal
        }
    }

    /// Root of the sum of squares of the change of the depths to another loss \[m\].
    pub(crate) fn depth_change(&self, other: &Self) -> f64 {
        let pairs = self
            .depth
            .iter()
            .flatten()
            .zip(other.depth.iter().flatten());
        pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    }

    /// Adds the loss of a jump that follows.
    pub(crate) fn plus(mut self, other: &Self) -> Self {
        for b in 0..2 {
            add_to(&mut self.depth[b], &other.depth[b]);
            add_to(&mut self.energy[b], &other.energy[b]);
        }
        add_to(&mut self.slid, &other.slid);
        self.cycles += other.cycles;
        self.dissipated += other.dissipated;
        self.loading += other.loading;
        self.debris = match (self.debris, &other.debris) {
            (Some(first), Some(second)) => Some(Debris {
                bed: second.bed.clone(),
                ejected: first.ejected + second.ejected,
            }),
            _ => None,
        };
        self
    }

    /// Extrapolates two halves by one whole jump to second order, `2 halves - whole` (E. Hairer, S.
    /// P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.4). Also returns
    /// the correction of the depth, relative to the `worn` depth at the end (root mean squares).
    ///
    /// Depths do not decrease: a negative extrapolated loss is set to zero and the others are
    /// scaled down, so that the volume of the extrapolation is kept.
    pub(crate) fn extrapolated(mut self, whole: &Self, worn: &Worn) -> (Self, f64) {
        let (mut moved, mut size) = (0.0, 0.0);
        for b in 0..2 {
            for (n, depth) in self.depth[b].iter().enumerate() {
                let change = *depth - whole.depth[b][n];
                moved += change * change;
                size += (worn.depth[b][n] + *depth).powi(2);
            }
            extrapolate(&mut self.depth[b], &whole.depth[b]);
            extrapolate(&mut self.energy[b], &whole.energy[b]);
        }
        extrapolate(&mut self.slid, &whole.slid);
        self.dissipated = 2.0 * self.dissipated - whole.dissipated;
        self.loading = 2.0 * self.loading - whole.loading;
        if let (Some(debris), Some(whole)) = (self.debris.take(), &whole.debris) {
            self.debris = Some(debris.extrapolated(whole));
        }
        (self, (moved / f64::max(size, f64::MIN_POSITIVE)).sqrt())
    }
}

/// Computes `2 halves - whole`, not negative, with the same sum.
fn extrapolate(halves: &mut [f64], whole: &[f64]) {
    let (mut exact, mut taken) = (0.0, 0.0);
    for (value, whole) in halves.iter_mut().zip(whole) {
        let change = *value - whole;
        exact += *value + change;
        *value = (*value + change).max(0.0);
        taken += *value;
    }
    let part = if taken > 0.0 {
        (exact / taken).max(0.0)
    } else {
        0.0
    };
    for value in halves {
        *value *= part;
    }
}

/// Adds a field to another, cell by cell.
fn add_to(sum: &mut [f64], more: &[f64]) {
    sum.iter_mut()
        .zip(more)
        .for_each(|(sum, more)| *sum += more);
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
            let mut loss = |dissipated| Loss {
                cycles: 1.0,
                depth: [field(), field()],
                energy: [field(), field()],
                slid: field(),
                dissipated,
                loading: dissipated,
                debris: None,
            };
            let (halves, whole) = (loss(3.0), loss(2.0));
            let sum = |f: &[f64]| f.iter().sum::<f64>();
            let exact = [0, 1].map(|b| 2.0 * sum(&halves.depth[b]) - sum(&whole.depth[b]));
            let (found, error) = halves.extrapolated(&whole, &Worn::unworn(30));
            assert!(error > 0.0 && (found.dissipated - 4.0).abs() < 1e-15);
            for b in 0..2 {
                assert!(found.depth[b].iter().all(|w| *w >= 0.0));
                assert!((sum(&found.depth[b]) - exact[b].max(0.0)).abs() < 1e-12);
            }
        }
    }
}
