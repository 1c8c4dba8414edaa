//! Maps on other points: every second one, or points between them.
//!
//! Between its points a map is linear, which is enough for the contact itself. A grid of smaller cells would
//! show the kinks of that, and one of larger cells means of its neighbours; both are other surfaces. Only
//! the errors of the cells remain if the heights between the points follow a cosine series through all of
//! them, and if larger cells have the heights of points.

use std::f64::consts::PI;
use std::sync::Arc;

use ndarray::Array2;

use super::{Grid, Scene, Shape, SurfaceMap};

impl Scene {
    /// Whether a body has measured heights.
    pub(crate) fn has_maps(&self) -> bool {
        self.body1.shape.has_map() || self.body2.shape.has_map()
    }

    /// Gives the maps on the cells of `grid` the heights of every second of them, on the grid of the scene.
    pub(crate) fn decimate_maps(&mut self, grid: &Grid) {
        let decimated = |map: &SurfaceMap| {
            let height = |(i, j): (usize, usize)| map.interpolate(grid.x(2 * i), grid.y(2 * j));
            SurfaceMap {
                values: Arc::new(Array2::from_shape_fn((self.grid.nx, self.grid.ny), height)),
                spacing: (self.grid.dx, self.grid.dy),
                filled: map.filled,
            }
        };
        let change = |shape: &Shape| shape.with_maps(&decimated);
        let shapes = [change(&self.body1.shape), change(&self.body2.shape)];
        [self.body1.shape, self.body2.shape] = shapes;
    }

    /// Gives maps whose points lie farther apart than the cells the heights of their cosine series there.
    pub(crate) fn refine_maps(&mut self) {
        let grid = self.grid;
        let refined = |map: &SurfaceMap| {
            let farther = map.spacing.0 > grid.dx && (map.spacing.1 > grid.dy || grid.ny == 1);
            if !farther || grid.plane_strain {
                return map.clone();
            }
            let (nx, ny) = map.values.dim();
            let along_x = cosine_matrix(nx, map.spacing.0, (0..grid.nx).map(|i| grid.x(i)));
            let along_y = cosine_matrix(ny, map.spacing.1, (0..grid.ny).map(|j| grid.y(j)));
            SurfaceMap {
                values: Arc::new(along_x.dot(&*map.values).dot(&along_y.t())),
                spacing: (grid.dx, grid.dy),
                filled: map.filled,
            }
        };
        let change = |shape: &Shape| shape.with_maps(&refined);
        let shapes = [change(&self.body1.shape), change(&self.body2.shape)];
        [self.body1.shape, self.body2.shape] = shapes;
    }
}

/// Matrix from the values at n points, a `pitch` apart about 0, to the cosine series through them at other
/// points. With u = x/(n pitch) + 1/2 and theta = pi (u -+ u_i) its entries are the sums of Dirichlet's kernels
/// D(theta) = 1 + 2 sum over k < n of cos(k theta) = sin((n - 1/2) theta)/sin(theta/2), over 2 n.
fn cosine_matrix(n: usize, pitch: f64, points: impl Iterator<Item = f64>) -> Array2<f64> {
    let count = n as f64;
    let kernel = |theta: f64| {
        let half = 0.5 * theta;
        if half.sin().abs() < 1e-12 {
            return 2.0 * count - 1.0;
        }
        ((2.0 * count - 1.0) * half).sin() / half.sin()
    };
    let points: Vec<f64> = points.map(|x| x / (count * pitch) + 0.5).collect();
    Array2::from_shape_fn((points.len(), n), |(m, i)| {
        let u = (i as f64 + 0.5) / count;
        let [minus, plus] = [points[m] - u, points[m] + u].map(|u| kernel(PI * u));
        (minus + plus) / (2.0 * count)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cosine_series_is_exact_for_its_waves_and_at_its_points() {
        let (n, pitch) = (16, 2e-6);
        let side = n as f64 * pitch;
        let wave = |x: f64, k: f64| (PI * k * (x / side + 0.5)).cos();
        let x = |i: usize, n: usize| side * ((i as f64 + 0.5) / n as f64 - 0.5);
        for (points, k) in [(48, 3.0), (32, 15.0), (16, 7.0), (8, 2.0)] {
            let matrix = cosine_matrix(n, pitch, (0..points).map(|i| x(i, points)));
            let values = ndarray::Array1::from_iter((0..n).map(|i| wave(x(i, n), k)));
            let refined = matrix.dot(&values);
            for (i, value) in refined.iter().enumerate() {
                assert!(
                    (value - wave(x(i, points), k)).abs() < 1e-10,
                    "{points} {k} {i}"
                );
            }
        }
    }
}
