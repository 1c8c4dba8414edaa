//! The worn surface of a body that is shifted against the grid.
//!
//! In an increment a body moves over an interval of shifts. The depth worn by cell n is distributed to the
//! cells of the body below it: the matrix S, the mean over the interval of linear interpolation between two
//! cells. Its columns sum to 1, so that volume is conserved. The worn depth under cell n is read with the
//! same weights, S^T. Since both are the same matrix, the wear of a jump is the gradient of a convex energy
//! ([`sliding`](super::sliding)). With the hat function hat(t) = 1 - |t| and its integral H, the weight of
//! a cell at the distance m for shifts from a to b \[cells\] is
//!
//! ```text
//! int_a^b hat(m - s) ds/(b - a) = (H(m - a) - H(m - b))/(b - a),   hat(m - a) for a = b
//! ```

/// Shifts along x over an interval of cells that need not be whole.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shift {
    /// Ends of the interval \[cells\].
    ends: [f64; 2],
    /// Distance of the first cell that has a weight, and the weights of this and the next cells.
    first: isize,
    weights: Vec<f64>,
}

impl Shift {
    /// A shift by a number of cells, whole or not.
    pub(crate) fn new(cells: f64) -> Self {
        Self::interval(cells, 0.0)
    }

    /// The mean over all shifts in an interval of this length about its middle \[cells\].
    pub(crate) fn interval(middle: f64, length: f64) -> Self {
        let (a, b) = (middle - 0.5 * length, middle + 0.5 * length);
        let first = a.floor();
        let count = (b - first).floor() as usize + 2;
        let weight = |k: usize| {
            let m = first + k as f64;
            if length > 1e-9 {
                (integral_of_hat(m - a) - integral_of_hat(m - b)) / length
            } else {
                (1.0 - (m - middle).abs()).max(0.0)
            }
        };
        Self {
            ends: [a, b],
            first: first as isize,
            weights: (0..count).map(weight).collect(),
        }
    }

    /// The ends of its interval \[cells\].
    pub(crate) fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Adds `factor` times the shifted field S f to `onto`; fields have `rows` cells per column.
    pub(crate) fn put(&self, field: &[f64], factor: f64, rows: usize, onto: &mut [f64]) {
        self.for_each_entry(field.len(), rows, |n, m, part| {
            onto[m] += factor * part * field[n];
        });
    }

    /// Adds the field shifted back, S^T f, to `onto`; fields have `rows` cells per column.
    pub(crate) fn read(&self, field: &[f64], rows: usize, onto: &mut [f64]) {
        self.for_each_entry(field.len(), rows, |n, m, part| onto[n] += part * field[m]);
    }

    /// Calls `each(n, m, weight)` for the entries of S; entries beyond the grid are left out.
    fn for_each_entry(&self, cells: usize, rows: usize, mut each: impl FnMut(usize, usize, f64)) {
        for (k, part) in self.weights.iter().enumerate() {
            if *part == 0.0 {
                continue;
            }
            let by = (self.first + k as isize) * rows as isize;
            let from = (-by).clamp(0, cells as isize) as usize;
            let to = (cells as isize - by).clamp(0, cells as isize) as usize;
            for n in from..to {
                each(n, (n as isize + by) as usize, *part);
            }
        }
    }
}

/// Integral of the hat function from minus infinity.
fn integral_of_hat(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    if t < 0.0 {
        0.5 * (1.0 + t) * (1.0 + t)
    } else {
        1.0 - 0.5 * (1.0 - t) * (1.0 - t)
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
        for (cells, length) in [
            (0.0, 0.0),
            (1.0, 0.0),
            (-2.0, 0.0),
            (0.3, 0.0),
            (-3.7, 0.0),
            (0.0, 2.0),
            (0.4, 0.3),
            (-1.3, 3.1),
        ] {
            let shift = Shift::interval(cells, length);
            let (mut put, mut read) = (vec![0.0; 40], vec![0.0; 40]);
            shift.put(&a, 1.0, rows, &mut put);
            shift.read(&b, rows, &mut read);
            let sum = |f: &[f64]| f.iter().sum::<f64>();
            assert!((sum(&put) - sum(&a)).abs() < 1e-12);
            let product = |f: &[f64], g: &[f64]| f.iter().zip(g).map(|(f, g)| f * g).sum::<f64>();
            assert!((product(&put, &b) - product(&a, &read)).abs() < 1e-12);
            // The middle of what is put moves by the shift.
            let middle = |f: &[f64]| {
                let moments = f.iter().enumerate().map(|(n, f)| (n / rows) as f64 * f);
                moments.sum::<f64>() / sum(f)
            };
            assert!((middle(&put) - middle(&a) - cells).abs() < 1e-12);
        }
    }

    #[test]
    fn an_interval_is_the_mean_of_its_parts() {
        let field: Vec<f64> = (0..32).map(|n| f64::from(n * n % 7)).collect();
        let mean = |parts: usize| {
            let mut sum = vec![0.0; 32];
            for k in 0..parts {
                let middle = 1.7 + 2.4 * ((k as f64 + 0.5) / parts as f64 - 0.5);
                Shift::interval(middle, 2.4 / parts as f64).put(
                    &field,
                    1.0 / parts as f64,
                    1,
                    &mut sum,
                );
            }
            sum
        };
        let [whole, parts] = [1, 5].map(mean);
        assert!(whole.iter().zip(&parts).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
