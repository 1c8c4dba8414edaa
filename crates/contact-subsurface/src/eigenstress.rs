//! Plastic strain and the residual stress that it leaves, between the points of their grid.
//!
//! Both are known at the Gauss points of the elements in depth and at the middles of the cells of
//! the volume grid. Between these points each is a product of cubic polynomials through the four
//! nearest points along each axis. In depth the polynomials use the points of one layer. The
//! surface carries none of the stress: s_zz, s_xz and s_yz are zero there. Beyond the grid the
//! stress falls like the stress of a source far away, with the third power of the distance, in
//! plane strain with the second. The strain is zero there.

mod solver;

use std::sync::Arc;

use stress_tensor::StressTensor;

pub use self::solver::EigenstressSolver;

use super::plastic_strain::PlasticStrain;
use super::{Depth, DoubledCells, Growth};

/// Points of a polynomial.
const POINTS: usize = 4;
/// Components of a tensor.
const COMPONENTS: usize = 6;
/// Components that the surface carries: zz, xz, yz.
const CARRIED: [usize; 3] = [2, 4, 5];

/// Plastic strain and residual stress of a body, in the axes of the scene.
#[derive(Clone, Debug)]
pub struct Eigenstress {
    field: Arc<Field>,
    /// The origin of x, y in the scene \[m\].
    origin: (f64, f64),
}

#[derive(Debug)]
struct Field {
    /// Cells along x and y, and their lengths \[m\].
    n: [usize; 2],
    d: [f64; 2],
    plane_strain: bool,
    /// Depth \[m\] and layer of every plane.
    planes: Vec<(f64, usize)>,
    /// For each plane six components on the cells, x first \[Pa\]; a cycle holds many of them.
    stress: Vec<f32>,
    strain: PlasticStrain,
}

/// The points of the interpolation at a place, with the weights of their polynomials.
struct Stencil {
    /// Planes of the layer, and depths of the first and the last \[m\].
    rows: Vec<usize>,
    ends: [f64; 2],
    in_depth: Weights,
    along: [Weights; 2],
    /// Decay of the stress beside the grid and below it, 1 within it.
    far: f64,
    deep: f64,
}

/// The nearest points along an axis with their weights.
type Weights = [(usize, f64); POINTS];

impl Eigenstress {
    /// Shifts the origin of x and y to another point of the scene \[m\].
    #[must_use]
    pub fn with_origin(&self, (x, y): (f64, f64)) -> Self {
        Self {
            field: self.field.clone(),
            origin: (self.origin.0 + x, self.origin.1 + y),
        }
    }

    /// The stress at x, y \[m\] and a depth \[Pa\]; zero in a layer that has no element.
    pub fn stress(&self, x: f64, y: f64, depth: Depth) -> StressTensor {
        let field = &*self.field;
        let Some(beside) = field.stencil([x + self.origin.0, y + self.origin.1], depth) else {
            return [0.0; COMPONENTS];
        };
        let Stencil { along, .. } = &beside;
        let far = beside.far * beside.deep;
        let cells = field.n[0] * field.n[1];
        let mut sum = [0.0; COMPONENTS];
        beside.for_each_point(|weight, plane, cell| {
            let at = plane * COMPONENTS * cells + cell[0] * field.n[1] + cell[1];
            for (c, sum) in sum.iter_mut().enumerate() {
                *sum += far * weight * f64::from(field.stress[at + c * cells]);
            }
        });
        let [first, _] = beside.ends;
        if depth.layer == 0 && depth.z < first {
            // Linear between the surface, which carries nothing, and the first plane.
            let plane = beside.rows[0];
            for c in CARRIED {
                let block = (plane * COMPONENTS + c) * cells;
                let mut value = 0.0;
                for &(i, w_x) in &along[0] {
                    for &(j, w_y) in &along[1] {
                        let at = block + i * field.n[1] + j;
                        value += w_x * w_y * f64::from(field.stress[at]);
                    }
                }
                sum[c] = far * value * depth.z / first;
            }
        }
        sum
    }

    /// The plastic strain at x, y \[m\] and a depth; zero where nothing has yielded.
    pub fn plastic_strain(&self, x: f64, y: f64, depth: Depth) -> [f64; COMPONENTS] {
        let field = &*self.field;
        let mut sum = [0.0; COMPONENTS];
        let beside = field.stencil([x + self.origin.0, y + self.origin.1], depth);
        let Some(beside) = beside.filter(|beside| beside.far * beside.deep >= 1.0) else {
            return sum;
        };
        beside.for_each_point(|weight, plane, [i, j]| {
            let strain = field.strain.strain(plane, i, j);
            for (sum, strain) in sum.iter_mut().zip(strain.into_iter().flatten()) {
                *sum += weight * strain;
            }
        });
        sum
    }

    /// Averages over pairs of planes of a layer and pairs of cells, for an estimate of the error. Cells are
    /// paired like the cells of the contact; x, y are counted from the middle of these.
    #[must_use]
    pub fn coarsened(&self, contact: &DoubledCells) -> Self {
        let field = &*self.field;
        let cells = contact.for_cells(field.n, field.d);
        let plane_values =
            |n: usize| &field.stress[n * field.n[0] * field.n[1]..][..field.n[0] * field.n[1]];
        let (mut planes, mut stress, mut of_plane) = (Vec::new(), Vec::new(), Vec::new());
        let mut first = 0;
        while let Some(&(z, layer)) = field.planes.get(first) {
            let second = field
                .planes
                .get(first + 1)
                .filter(|second| second.1 == layer);
            let (below, last) = second.map_or((z, first), |second| (second.0, first + 1));
            for c in 0..COMPONENTS {
                let pairs = plane_values(first * COMPONENTS + c)
                    .iter()
                    .zip(plane_values(last * COMPONENTS + c));
                let mean: Vec<f64> = pairs.map(|(a, b)| 0.5 * f64::from(a + b)).collect();
                stress.extend(cells.mean(&mean).into_iter().map(|s| s as f32));
            }
            of_plane.extend((first..=last).map(|_| planes.len()));
            planes.push((f64::midpoint(z, below), layer));
            first = last + 1;
        }
        let grid = cells.grid;
        let shifted = |origin: f64, of_contact: f64, of_cells: f64| origin + of_contact - of_cells;
        Self {
            field: Arc::new(Field {
                n: [grid.nx, grid.ny],
                d: [grid.dx, grid.dy],
                plane_strain: field.plane_strain,
                strain: field.strain.coarsened(&cells, &of_plane),
                planes,
                stress,
            }),
            origin: (
                shifted(self.origin.0, contact.middle.0, cells.middle.0),
                shifted(self.origin.1, contact.middle.1, cells.middle.1),
            ),
        }
    }

    /// Growth of the plastic strain since an earlier state, at the points that have yielded.
    pub fn growth_since(&self, before: Option<&Self>) -> Growth {
        Growth::between(before.map(|of| &of.field.strain), &self.field.strain)
    }
}

impl Stencil {
    /// Calls `f` with the weight, the plane and the cell of each point.
    fn for_each_point(&self, mut f: impl FnMut(f64, usize, [usize; 2])) {
        let [along_x, along_y] = &self.along;
        for &(row, w_z) in &self.in_depth {
            for &(i, w_x) in along_x {
                for &(j, w_y) in along_y {
                    let weight = w_z * w_x * w_y;
                    if weight != 0.0 {
                        f(weight, self.rows[row], [i, j]);
                    }
                }
            }
        }
    }
}

impl Field {
    /// The points of the interpolation at a place of the scene; `None` in a layer that has no
    /// element.
    fn stencil(&self, [x, y]: [f64; 2], depth: Depth) -> Option<Stencil> {
        let rows = self.planes.iter().enumerate();
        let rows = rows.filter(|(_, (_, layer))| *layer == depth.layer);
        let (rows, z): (Vec<usize>, Vec<f64>) = rows.map(|(n, (z, _))| (n, *z)).unzip();
        let ends = [*z.first()?, *z.last()?];
        let [_, last] = ends;
        // The stress of a source decays with this power of the distance, beside the grid and below it.
        let power = if self.plane_strain { 2 } else { 3 };
        // The substrate goes on below its last plane.
        let is_last = rows.last().is_some_and(|n| n + 1 == self.planes.len());
        let deep = if is_last && depth.z > last {
            (last / depth.z).powi(power)
        } else {
            1.0
        };
        let at = if is_last { depth.z.min(last) } else { depth.z };
        let (along_x, far_x) = self.cells_along(0, x);
        let (along_y, far_y) = self.cells_along(1, y);
        Some(Stencil {
            in_depth: lagrange_weights(&z, at),
            rows,
            ends,
            along: [along_x, along_y],
            far: far_x.min(far_y).powi(power),
            deep,
        })
    }

    /// Cells and weights for the interpolation at a place along an axis (0: x, 1: y), and a factor by which the
    /// stress decays beyond the grid.
    fn cells_along(&self, axis: usize, place: f64) -> (Weights, f64) {
        let n = self.n[axis];
        if n == 1 {
            return ([(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)], 1.0);
        }
        let border = 0.5 * (n as f64 - 1.0) * self.d[axis];
        let within = place.clamp(-border, border);
        let far = if place.abs() > border {
            border / place.abs()
        } else {
            1.0
        };
        let at = (within + border) / self.d[axis];
        let middles: Vec<f64> = (0..n).map(|i| i as f64).collect();
        (lagrange_weights(&middles, at), far)
    }
}

/// Indices and weights of Lagrange's polynomial through the points nearest to `at`; beyond the last points the
/// weights at the nearest end.
fn lagrange_weights(points: &[f64], at: f64) -> Weights {
    let count = points.len().min(POINTS);
    let above = points.partition_point(|p| *p < at);
    let first = above.saturating_sub(POINTS / 2).min(points.len() - count);
    let mut weights = [(first, 0.0); POINTS];
    for (k, weights) in weights[..count].iter_mut().enumerate() {
        let others = (first..first + count).filter(|m| *m != first + k);
        let factor = |m: usize| (at - points[m]) / (points[first + k] - points[m]);
        *weights = (first + k, others.map(factor).product());
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plastic_strain::yielded;
    use contact_core::scene::Grid;

    /// A field that is cubic along each axis within each of two layers.
    fn cubic(x: f64, y: f64, depth: Depth, c: usize) -> f64 {
        let [x, y, z] = [x, y, depth.z].map(|v| v * 1e4);
        let of_layer = if depth.layer == 0 { 1.0 } else { -2.0 };
        (c as f64 + of_layer) * (1.0 + x - x * x * y) * (1.0 + z - 0.1 * z * z * z)
    }

    /// Stress and, in the substrate, strain of a function on cells and 8 planes; 1 Pa goes with a
    /// strain of 1e-3.
    fn field_of(n: [usize; 2], f: fn(f64, f64, Depth, usize) -> f64) -> Eigenstress {
        let d = [2e-5, 2.5e-5];
        let depths = [0.1, 0.3, 0.6, 0.9, 1.1, 1.4, 1.9, 2.6].map(|z| z * 1e-4);
        let planes: Vec<_> = depths
            .into_iter()
            .map(|z| (z, usize::from(z > 1e-4)))
            .collect();
        let (mut stress, mut points) = (Vec::new(), Vec::new());
        for (plane, &(z, layer)) in planes.iter().enumerate() {
            let depth = Depth { z, layer };
            let at = |cell: usize, c: usize| {
                let [x, y] = [(cell / n[1], 0), (cell % n[1], 1)]
                    .map(|(i, a)| (i as f64 - 0.5 * (n[a] as f64 - 1.0)) * d[a]);
                f(x, y, depth, c)
            };
            for c in 0..COMPONENTS {
                stress.extend((0..n[0] * n[1]).map(|cell| at(cell, c) as f32));
            }
            // The substrate alone has yielded.
            for cell in (0..n[0] * n[1]).filter(|_| layer == 1) {
                let strain = std::array::from_fn(|c| 1e-3 * at(cell, c));
                points.push((plane, cell, yielded(strain, 0.0)));
            }
        }
        Eigenstress {
            field: Arc::new(Field {
                n,
                d,
                plane_strain: false,
                planes,
                stress,
                strain: PlasticStrain::from_points(&points, n),
            }),
            origin: (0.0, 0.0),
        }
    }

    /// Means over pairs of planes and cells keep what is linear, where all of the pairs are on the grid.
    #[test]
    fn on_points_twice_as_far_apart_linear_fields_stay_what_they_are() {
        let linear = |x: f64, y: f64, depth: Depth, c: usize| {
            1.0 + c as f64 + 1e4 * (x - 0.5 * y + 0.3 * depth.z)
        };
        let fine = field_of([17, 16], linear);
        let contact = Grid::from_spacing((34, 32), (1e-5, 1.25e-5)).expect("a grid");
        for cells in DoubledCells::new_pair(&contact) {
            let coarse = fine.coarsened(&cells);
            let (u, v) = cells.middle;
            for (x, y, z, layer) in [(1.3e-5, -2e-5, 5e-5, 0), (-1e-5, 1e-5, 1.7e-4, 1)] {
                let depth = Depth { z, layer };
                let stress = coarse.stress(x - u, y - v, depth);
                let strain = coarse.plastic_strain(x - u, y - v, depth);
                for c in 0..COMPONENTS {
                    let exact = linear(x, y, depth, c);
                    assert!((stress[c] - exact).abs() < 1e-5, "{depth:?}");
                    let grown = if layer == 1 { 1e-3 * exact } else { 0.0 };
                    assert!((strain[c] - grown).abs() < 1e-8, "{depth:?}");
                }
            }
        }
    }

    #[test]
    fn cubic_stresses_are_exact_within_each_layer_and_the_surface_carries_nothing() {
        let field = field_of([9, 8], cubic);
        for (x, y, z, layer) in [
            (1.3e-5, -2e-5, 5e-5, 0),
            (-7e-5, 8e-5, 1e-4, 0),
            (-7e-5, 8e-5, 1e-4, 1),
            (0.0, 0.0, 2.5e-4, 1),
        ] {
            let depth = Depth { z, layer };
            let interpolated = field.stress(x, y, depth);
            let moved = field
                .with_origin((1e-5, 2e-5))
                .stress(x - 1e-5, y - 2e-5, depth);
            let strain = field.plastic_strain(x, y, depth);
            for c in 0..COMPONENTS {
                let exact = cubic(x, y, depth, c);
                let grown = if layer == 1 { 1e-3 * exact } else { 0.0 };
                assert!((strain[c] - grown).abs() < 1e-7, "{depth:?}");
                assert!((interpolated[c] - exact).abs() < 1e-4, "{depth:?}");
                assert!((interpolated[c] - moved[c]).abs() < 1e-9);
            }
        }
        let top = field.stress(1e-5, 1e-5, Depth { z: 0.0, layer: 0 });
        assert!(CARRIED.iter().all(|c| top[*c] == 0.0) && top[0] != 0.0);
        // Beyond the grid with the third power of the distance.
        let depth = Depth { z: 2e-4, layer: 1 };
        let (border, far) = (
            field.stress(8e-5, 0.0, depth),
            field.stress(16e-5, 0.0, depth),
        );
        assert!((far[0] / border[0] - 0.125).abs() < 1e-12);
        assert!(field.plastic_strain(8e-5, 0.0, depth)[1] != 0.0);
        assert_eq!(field.plastic_strain(8.1e-5, 0.0, depth), [0.0; COMPONENTS]);
        let below = [2.6e-4, 5.2e-4].map(|z| field.stress(0.0, 0.0, Depth { z, layer: 1 })[0]);
        assert!((below[1] / below[0] - 0.125).abs() < 1e-12);
    }
}
