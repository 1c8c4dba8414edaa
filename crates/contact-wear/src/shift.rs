//! The worn surface of a body that is shifted against the grid.
//!
//! The depth worn by cell n is distributed to the two cells between which it lies on the other
//! body, with the weights of linear interpolation: the matrix S, whose columns sum to 1, so that
//! volume is conserved. The worn depth under cell n is read with the same weights, S^T. Since both
//! are the same matrix, the wear of a jump is the gradient of a convex energy
//! ([`sliding`](super::sliding)).

/// A shift along x by a number of cells that need not be whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shift {
    whole: isize,
    part: f64,
}

impl Shift {
    pub(crate) fn new(cells: f64) -> Self {
        let whole = cells.floor();
        Self {
            whole: whole as isize,
            part: cells - whole,
        }
    }

    /// The shift in cells.
    pub(crate) fn cells(self) -> f64 {
        self.whole as f64 + self.part
    }

    /// Adds S times `field`, `factor` times, to `onto`; fields of `rows` cells per column.
    pub(crate) fn put(self, field: &[f64], factor: f64, rows: usize, onto: &mut [f64]) {
        self.for_each_entry(field.len(), rows, |n, m, part| {
            onto[m] += factor * part * field[n];
        });
    }

    /// Adds S^T times `field` to `onto`.
    pub(crate) fn read(self, field: &[f64], rows: usize, onto: &mut [f64]) {
        self.for_each_entry(field.len(), rows, |n, m, part| onto[n] += part * field[m]);
    }

    /// Calls `each(n, m, weight)` for the entries of S; entries beyond the grid are left out.
    fn for_each_entry(self, cells: usize, rows: usize, mut each: impl FnMut(usize, usize, f64)) {
        for (by, part) in [(self.whole, 1.0 - self.part), (self.whole + 1, self.part)] {
            if part == 0.0 {
                continue;
            }
            let by = by * rows as isize;
            let from = (-by).clamp(0, cells as isize) as usize;
            let to = (cells as isize - by).clamp(0, cells as isize) as usize;
            for n in from..to {
                each(n, (n as isize + by) as usize, part);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Shift;

    #[test]
    fn a_loss_is_put_on_two_cells_and_read_with_the_same_weights() {
        let rows = 2;
        let mut rng = fastrand::Rng::with_seed(5);
        let mut field = || -> Vec<f64> { (0..40).map(|_| rng.f64()).collect() };
        let (mut a, b) = (field(), field());
        a[..10].fill(0.0);
        a[30..].fill(0.0);
        for cells in [0.0, 1.0, -2.0, 0.3, -3.7] {
            let shift = Shift::new(cells);
            let (mut put, mut read) = (vec![0.0; 40], vec![0.0; 40]);
            shift.put(&a, 1.0, rows, &mut put);
            shift.read(&b, rows, &mut read);
            let sum = |f: &[f64]| f.iter().sum::<f64>();
            assert!((sum(&put) - sum(&a)).abs() < 1e-13);
            let product = |f: &[f64], g: &[f64]| f.iter().zip(g).map(|(f, g)| f * g).sum::<f64>();
            assert!((product(&put, &b) - product(&a, &read)).abs() < 1e-13);
            // The middle of what is put moves by the shift.
            let middle = |f: &[f64]| {
                let moments = f.iter().enumerate().map(|(n, f)| (n / rows) as f64 * f);
                moments.sum::<f64>() / sum(f)
            };
            assert!((middle(&put) - middle(&a) - cells).abs() < 1e-12);
        }
    }
}
