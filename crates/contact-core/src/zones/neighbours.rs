//! Fields on the cells of a grid and the neighbours of a cell.

use ndarray::{Array2, Axis};
use std::ops::Range;

/// The part of a field in a window of columns and rows.
pub(super) fn cut_window<T: Clone>(
    field: &Array2<T>,
    (columns, rows): &(Range<usize>, Range<usize>),
) -> Array2<T> {
    let columns = field.slice_axis(Axis(0), columns.clone().into());
    columns.slice_axis(Axis(1), rows.clone().into()).to_owned()
}

/// A field in a cell and its neighbours.
pub(super) struct Neighbourhood([[f64; 3]; 3]);

impl Neighbourhood {
    /// The values of a cell and of its eight neighbours; at the border of the field the nearest ones.
    pub(super) fn new(field: &Array2<f64>, (i, j): (usize, usize)) -> Self {
        let (nx, ny) = field.dim();
        let with_neighbours =
            |n: usize, count: usize| [n.saturating_sub(1), n, (n + 1).min(count - 1)];
        Self(with_neighbours(i, nx).map(|i| with_neighbours(j, ny).map(|j| field[(i, j)])))
    }

    /// Interpolates bilinearly between the middles, at an offset of at most half a cell.
    pub(super) fn interpolate(&self, (s, t): (f64, f64)) -> f64 {
        let Self(field) = self;
        let (next, above) = (usize::from(s > 0.0) * 2, usize::from(t > 0.0) * 2);
        let (s, t) = (s.abs(), t.abs());
        let value_in_column = |column: [f64; 3]| column[1] + t * (column[above] - column[1]);
        let (this_column, next_column) = (value_in_column(field[1]), value_in_column(field[next]));
        this_column + s * (next_column - this_column)
    }
}

/// Fills cells without a value with the mean of their neighbours that have one.
pub(super) fn fill_from_neighbours(known: &Array2<Option<f64>>) -> Array2<Option<f64>> {
    Array2::from_shape_fn(known.dim(), |cell| {
        known[cell].or_else(|| {
            let neighbours = || cell_and_neighbours(cell, known.dim()).filter_map(|at| known[at]);
            let count = neighbours().count();
            (count > 0).then(|| neighbours().sum::<f64>() / count as f64)
        })
    })
}

/// Distance of each cell from the nearest of the cells `from`, in steps along, across or diagonally, by two
/// sweeps.
pub(super) fn chessboard_distances<'a>(
    shape: (usize, usize),
    from: impl Iterator<Item = &'a (usize, usize)>,
) -> Array2<u8> {
    let mut distance = Array2::from_elem(shape, u8::MAX);
    for cell in from {
        distance[*cell] = 0;
    }
    let mut sweep = |n: usize| {
        let cell = (n / shape.1, n % shape.1);
        let nearest = cell_and_neighbours(cell, shape)
            .map(|at| distance[at])
            .min();
        distance[cell] = distance[cell].min(nearest.unwrap_or(u8::MAX).saturating_add(1));
    };
    (0..shape.0 * shape.1).for_each(&mut sweep);
    (0..shape.0 * shape.1).rev().for_each(&mut sweep);
    distance
}

/// Yields a cell and its neighbours.
pub(super) fn cell_and_neighbours(
    (i, j): (usize, usize),
    (nx, ny): (usize, usize),
) -> impl Iterator<Item = (usize, usize)> {
    let rows = j.saturating_sub(1)..(j + 2).min(ny);
    (i.saturating_sub(1)..(i + 2).min(nx)).flat_map(move |i| rows.clone().map(move |j| (i, j)))
}
