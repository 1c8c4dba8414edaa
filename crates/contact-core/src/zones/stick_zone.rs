//! The shear in and around a stick zone: bound m p and shortfall m p - q.e, e being the direction of
//! the shear of the slip cells. After a reversal q.e changes its sign within the stick zone.

use ndarray::{Array2, Zip};

use super::laws::{SHRINKING, STICK};
use super::level::Stencil;
use super::neighbours::{cell_and_neighbours, chessboard_distances};
use super::sampled_border::SampledBorder;
use crate::cells::Lattice;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Columns or rows of stick cells over which m and e are extended from the slip cells beside them.
const EXTENDED: usize = 10;
/// Distance from the border \[cells\] up to which the shear is bound less shortfall. Beyond, q/p is
/// interpolated; the two differ there by 0.4 % of the shortfall of a cell at the border.
const NEAR: usize = 2;

/// The bound of the shear and its shortfall.
pub(super) struct StickZone {
    /// |q|/p of the slip cells, extended into the zone; NaN further in.
    pub(super) m: Array2<f64>,
    /// The direction e of the shear of the slip cells, extended likewise: a unit vector in x and y,
    /// or 0 where opposite directions meet.
    pub(super) direction: [Array2<f64>; 2],
    /// (m p - q.e)^2 \[Pa^2\].
    pub(super) border: SampledBorder,
    /// Cells at most [`NEAR`] cells from the border.
    near: Array2<bool>,
}

impl StickZone {
    /// Finds the stick zone; none where all cells stick or all slip.
    pub(super) fn new(
        grid: &Grid,
        p: &Array2<f64>,
        q: &[Array2<f64>; 2],
        stick: &[bool],
    ) -> Option<Self> {
        let shape = p.dim();
        let sticks = |(i, j): (usize, usize)| stick[i * grid.ny + j];
        let size = Zip::from(&q[0]).and(&q[1]).map_collect(|x, y| x.hypot(*y));
        let at_slip_cells = |f: &dyn Fn((usize, usize)) -> f64| {
            Array2::from_shape_fn(shape, |cell| {
                (p[cell] > 0.0 && !sticks(cell)).then(|| f(cell))
            })
        };
        let slipping = at_slip_cells(&|cell| size[cell] / p[cell]);
        if !stick.contains(&true) || slipping.iter().all(Option::is_none) {
            return None;
        }
        let m = extend(&slipping);
        let direction_component = |q: &Array2<f64>| {
            extend(&at_slip_cells(&|cell| {
                q[cell] / size[cell].max(f64::MIN_POSITIVE)
            }))
        };
        let [mut x, mut y] = q.each_ref().map(direction_component);
        Zip::from(&mut x).and(&mut y).for_each(|x, y| {
            let length = x.hypot(*y).max(f64::MIN_POSITIVE);
            (*x, *y) = (*x / length, *y / length);
        });
        let direction = [x, y];
        let shortfall = |cell: (usize, usize)| {
            let along = q[0][cell] * direction[0][cell] + q[1][cell] * direction[1][cell];
            (m[cell] * p[cell] - along).max(0.0)
        };
        let level = Array2::from_shape_fn(shape, |cell| match m[cell] {
            _ if !sticks(cell) => 0.0,
            // Far inside only the sign matters.
            m if m.is_nan() => p[cell].powi(2),
            _ => shortfall(cell).powi(2),
        });
        // Where the zone grows the shortfall vanishes like d^(3/2), which constant tractions
        // represent.
        let mut edges =
            Lattice::new(grid, Mirror::None).edges(stick, [Stencil::ROOT, Stencil::LINEAR], |_| {
                (STICK, |n: usize| shortfall((n / grid.ny, n % grid.ny)))
            });
        edges.retain(|(n, _)| p[(n / grid.ny, n % grid.ny)] > 0.0);
        for (_, edge) in &mut edges {
            edge.level = edge.level.filter(|level| level.law == SHRINKING);
        }
        let border = SampledBorder::new(&level, &edges);
        let mut near =
            chessboard_distances(shape, border.known.iter()).mapv(|d| usize::from(d) <= NEAR);
        for cell in border
            .unknown
            .iter()
            .flat_map(|cell| cell_and_neighbours(*cell, shape))
        {
            near[cell] = false;
        }
        Some(Self {
            m,
            direction,
            border,
            near,
        })
    }

    /// Whether the shear in a cell is computed from bound and shortfall.
    pub(super) fn covers(&self, cell: (usize, usize)) -> bool {
        self.near[cell] && cell_and_neighbours(cell, self.m.dim()).all(|at| self.m[at].is_finite())
    }
}

/// Extends a quantity known in some cells to the next [`EXTENDED`] rings by the mean of the
/// neighbours; NaN beyond.
fn extend(known: &Array2<Option<f64>>) -> Array2<f64> {
    let mut extended = known.mapv(|v| v.unwrap_or(f64::NAN));
    let is_missing = |all: &Array2<f64>, cell| all[cell].is_nan();
    let shape = extended.dim();
    let borders_missing = |&(cell, v): &(_, &Option<f64>)| {
        v.is_some() && cell_and_neighbours(cell, shape).any(|at| is_missing(&extended, at))
    };
    let mut front: Vec<_> = known
        .indexed_iter()
        .filter(borders_missing)
        .map(|(cell, _)| cell)
        .collect();
    for _ in 0..EXTENDED {
        let mut next_front: Vec<_> = front
            .iter()
            .flat_map(|cell| cell_and_neighbours(*cell, shape))
            .filter(|cell| is_missing(&extended, *cell))
            .collect();
        next_front.sort_unstable();
        next_front.dedup();
        let mean_of_neighbours = |cell: &(usize, usize)| {
            let neighbours = || {
                cell_and_neighbours(*cell, shape)
                    .map(|at| extended[at])
                    .filter(|v| !v.is_nan())
            };
            neighbours().sum::<f64>() / neighbours().count() as f64
        };
        let means: Vec<f64> = next_front.iter().map(mean_of_neighbours).collect();
        for (cell, mean) in next_front.iter().zip(means) {
            extended[*cell] = mean;
        }
        front = next_front;
    }
    extended
}
