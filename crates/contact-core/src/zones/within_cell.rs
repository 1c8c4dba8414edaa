//! The tractions of a contact within one of its cells.

use ndarray::Array2;

/// Middles of parts along a side of a cell, in cells: the mean of what is linear on either side of the
/// cell's middle is exact.
const MIDDLES: [f64; 4] = [-0.375, -0.125, 0.125, 0.375];

/// What of the tractions is not constant in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GoesOn {
    Nothing,
    Pressure,
    /// With the shear in its ratio to it.
    Both,
    /// The shear by what it falls short of its bound.
    Shortfall,
}

/// What the tractions in a cell are told by.
pub(super) struct WithinCell {
    /// The tractions q_x, q_y, p of the cell \[Pa\].
    pub(super) own: [f64; 3],
    pub(super) goes_on: GoesOn,
    /// p^2 \[Pa^2\].
    pub(super) level: Around,
    /// q/p.
    pub(super) ratios: [Around; 2],
    /// m and (m p - |q|)^2 \[Pa^2\], near a stick zone.
    pub(super) bound: Option<[Around; 2]>,
}

impl WithinCell {
    /// The tractions q_x, q_y, p at an offset from the middle in cells \[Pa\].
    pub(super) fn at(&self, offset: (f64, f64)) -> [f64; 3] {
        let p = self.level.at(offset).max(0.0).sqrt();
        match self.goes_on {
            GoesOn::Nothing => return self.own,
            GoesOn::Pressure => return [self.own[0], self.own[1], p],
            GoesOn::Both | GoesOn::Shortfall => {}
        }
        let [x, y] = [0, 1].map(|c| self.ratios[c].at(offset));
        let size = match &self.bound {
            Some([m, shortfall]) => {
                let q = m.at(offset) * p - shortfall.at(offset).max(0.0).sqrt();
                q.max(0.0) / x.hypot(y).max(f64::MIN_POSITIVE)
            }
            None => p,
        };
        [size * x, size * y, p]
    }

    /// Their mean over the cell \[Pa\].
    pub(super) fn mean(&self, flat: bool) -> [f64; 3] {
        let across: &[f64] = if flat { &[0.0] } else { &MIDDLES };
        let mut sum = [0.0; 3];
        for s in MIDDLES {
            for t in across {
                let here = self.at((s, *t));
                sum = [0, 1, 2].map(|c| sum[c] + here[c]);
            }
        }
        sum.map(|sum| sum / (MIDDLES.len() * across.len()) as f64)
    }
}

/// A field in a cell and its neighbours.
pub(super) struct Around([[f64; 3]; 3]);

impl Around {
    pub(super) fn new(field: &Array2<f64>, (i, j): (usize, usize)) -> Self {
        let (nx, ny) = field.dim();
        let near = |n: usize, count: usize| [n.saturating_sub(1), n, (n + 1).min(count - 1)];
        Self(near(i, nx).map(|i| near(j, ny).map(|j| field[(i, j)])))
    }

    /// Bilinear between the middles, at an offset of at most half a cell.
    fn at(&self, (s, t): (f64, f64)) -> f64 {
        let Self(field) = self;
        let (next, above) = (usize::from(s > 0.0) * 2, usize::from(t > 0.0) * 2);
        let (s, t) = (s.abs(), t.abs());
        let along = |column: [f64; 3]| column[1] + t * (column[above] - column[1]);
        let (here, there) = (along(field[1]), along(field[next]));
        here + s * (there - here)
    }
}
