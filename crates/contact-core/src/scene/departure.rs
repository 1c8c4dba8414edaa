//! How far the gap of uneven surfaces departs from a smooth one where they touch.
//!
//! A map of a smooth ball is uneven by its kind, but its contact is the one of a ball. Roughness of the
//! root mean square sigma changes the contact of a smooth pair of the curvature kappa and the radius a
//! little where
//!
//! ```text
//! alpha = sigma/(kappa a^2) < 0.05
//! ```
//!
//! (J. A. Greenwood, K. L. Johnson, E. Matsubara, Wear 100 (1984) 47-57: the pressure is Hertz's within
//! some per cent). kappa a^2 is the depth by which the smooth surfaces are flattened.

use ndarray::Array2;

use super::Scene;
use super::resolution::FEW_CELLS;
use crate::linear_system::solve;

/// Largest alpha of a contact of smooth surfaces.
const SMOOTH: f64 = 0.05;

impl Scene {
    /// Whether the surfaces are smooth around their narrowest gap, where a single spot of this radius \[m\] is in
    /// contact.
    pub(crate) fn touches_smoothly(&self, radius: f64) -> bool {
        if !self.is_uneven() {
            return true;
        }
        let (sigma, curvature) = self.departure(radius);
        sigma < SMOOTH * curvature * radius * radius
    }

    /// Departure of the gap from a paraboloid, root of the mean square \[m\], and the mean curvature of that
    /// \[1/m\], of plane strain the curvature. Both belong to a window around the narrowest gap, the contact of
    /// this radius \[m\] with [`FEW_CELLS`] on each side.
    fn departure(&self, radius: f64) -> (f64, f64) {
        let (grid, h) = (&self.grid, self.h_init());
        let narrowest = h.indexed_iter().min_by(|a, b| a.1.total_cmp(b.1));
        let ((i_0, j_0), &least) = narrowest.expect("a grid has cells");
        let reach = |d: f64| (radius / d + FEW_CELLS).ceil() as usize;
        let (along_x, along_y) = (reach(grid.dx), reach(grid.dy));
        let columns = i_0.saturating_sub(along_x)..(i_0 + along_x + 1).min(grid.nx);
        let rows = j_0.saturating_sub(along_y)..(j_0 + along_y + 1).min(grid.ny);
        let length = radius + FEW_CELLS * grid.dx.max(grid.dy);
        let terms = |i: usize, j: usize| -> Vec<f64> {
            let x = (grid.x(i) - grid.x(i_0)) / length;
            let y = (grid.y(j) - grid.y(j_0)) / length;
            if grid.plane_strain {
                vec![1.0, x, x * x]
            } else {
                vec![1.0, x, x * x, y, y * y, x * y]
            }
        };
        let cells: Vec<(Vec<f64>, f64)> = columns
            .flat_map(|i| rows.clone().map(move |j| (i, j)))
            .map(|(i, j)| (terms(i, j), h[(i, j)] - least))
            .collect();
        let unknowns = cells[0].0.len();
        let normal = Array2::from_shape_fn((unknowns, unknowns), |(k, l)| {
            cells.iter().map(|(t, _)| t[k] * t[l]).sum::<f64>()
        });
        let right = Array2::from_shape_fn((unknowns, 1), |(k, _)| {
            cells.iter().map(|(t, z)| t[k] * z).sum::<f64>()
        });
        let fitted = solve(&normal, &right);
        let squares = cells.iter().map(|(t, z)| {
            let off = z - t.iter().zip(&fitted).map(|(t, c)| t * c).sum::<f64>();
            off * off
        });
        let sigma = (squares.sum::<f64>() / cells.len() as f64).sqrt();
        // z = c X^2 has the curvature 2 c/length^2; along y there is another.
        let second = if grid.plane_strain {
            2.0 * fitted[(2, 0)]
        } else {
            fitted[(2, 0)] + fitted[(4, 0)]
        };
        (sigma, second / (length * length))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Body, Friction, Grid, LoadPath, Missing, Rough, Shape, SurfaceMap};
    use super::*;
    use crate::material::Elastic;

    const R: f64 = 0.01;
    const A: f64 = 1e-4;

    /// A flat of steel under a surface, 32 cells of a fifth of A.
    fn scene(shape: Shape) -> Scene {
        let steel = Elastic::new(210e9, 0.3).expect("a solid");
        let grid = Grid::centred(32.0 * A / 5.0, 32).expect("a grid");
        let path = LoadPath::start().normal(10.0, 1);
        let [upper, lower] = [shape, Shape::Flat].map(|shape| Body::homogeneous(steel, shape));
        Scene::new(upper, lower, Friction::coulomb(0.0), grid, path)
    }

    fn rough(rms: f64) -> Shape {
        Shape::Rough(Rough {
            rms,
            hurst: 0.8,
            longest: 3.0 * A,
            shortest: 0.6 * A,
            seed: 1,
        })
    }

    #[test]
    fn a_map_of_a_ball_is_smooth_and_roughness_counts_by_the_flattening() {
        let grid = scene(Shape::Flat).grid;
        let heights = Array2::from_shape_fn((32, 32), |(i, j)| {
            (R * R - grid.x(i).powi(2) - grid.y(j).powi(2)).sqrt() - R
        });
        let map = SurfaceMap::new(heights, (grid.dx, grid.dy), Missing::Refuse).expect("a map");
        let ball = scene(Shape::HeightMap(map));
        assert!(ball.is_uneven() && ball.touches_smoothly(A));
        // The flattening A^2/R is 1 um.
        let on_ball = |rms| scene(Shape::Sum(vec![Shape::sphere(R), rough(rms)]));
        assert!(on_ball(2e-8).touches_smoothly(A));
        assert!(!on_ball(2e-7).touches_smoothly(A));
        assert!(!scene(rough(2e-8)).touches_smoothly(A));
    }
}
