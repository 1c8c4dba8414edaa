//! Fields of a scene that is its own mirror image under y -> -y, kept on one half of the grid.

use ndarray::Array2;

/// Behaviour of a field under y -> -y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// f(x, -y) = f(x, y): p, q_x, u_x, u_z.
    Even,
    /// f(x, -y) = -f(x, y): q_y, u_y.
    Odd,
}

impl Parity {
    /// Sign of the field at -y over the field at y.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Odd => -1.0,
        }
    }
}

/// Whether the fields cover the grid or its half y > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mirror {
    /// The whole grid.
    None,
    /// The half y > 0 of a grid with an even number of rows.
    Y,
}

impl Mirror {
    /// Number of rows kept of `ny`.
    pub fn rows(self, ny: usize) -> usize {
        match self {
            Self::None => ny,
            Self::Y => ny / 2,
        }
    }

    /// Number of cells of the grid per kept cell.
    pub fn multiplicity(self) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Y => 2.0,
        }
    }

    /// The kept part of a field of shape (nx, ny), row-major.
    pub fn fold(self, full: &Array2<f64>) -> Vec<f64> {
        let (nx, ny) = full.dim();
        let first = ny - self.rows(ny);
        (0..nx)
            .flat_map(|i| (first..ny).map(move |j| full[(i, j)]))
            .collect()
    }

    /// The field of shape (nx, ny) whose kept part is `kept`.
    pub fn unfold(self, kept: &[f64], nx: usize, ny: usize, half: Parity) -> Array2<f64> {
        let rows = self.rows(ny);
        let sign = half.sign();
        Array2::from_shape_fn((nx, ny), |(i, j)| match (ny - rows).checked_sub(j) {
            Some(rows_below) if rows_below > 0 => sign * kept[i * rows + rows_below - 1],
            _ => kept[i * rows + j + rows - ny],
        })
    }
}
