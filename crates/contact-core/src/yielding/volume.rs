//! The volume grid: its cells, and the way between them and those of the contact.

use eigenstrain::Cells;
use ndarray::Array2;

use super::resampled::resampled;
use crate::scene::{Body, Grid, Profile, Scene};

/// Most cells of the volume grid along a side of a point contact, and along a line contact.
const MOST_CELLS: usize = 64;
const MOST_CELLS_OF_A_LINE: usize = 256;

/// Most cells of the volume grid along a side.
pub(crate) fn volume_cells(plane_strain: bool) -> usize {
    if plane_strain {
        MOST_CELLS_OF_A_LINE
    } else {
        MOST_CELLS
    }
}

/// Stress of von Mises, over the yield stress, down to which points may yield.
const YIELDING: f64 = 0.9;
/// Least and largest depth over the radius of the elastic contact.
const DEPTHS: [f64; 2] = [1.0, 3.0];
/// Depth of the last element, in which stresses can be read, over that radius.
const REACH: f64 = 4.0;
/// Height of an element over that radius: its two planes are then a 24th of it apart.
const HEIGHT: f64 = 1.0 / 12.0;
/// Least and largest height over the side of a cell.
const HEIGHTS: [f64; 2] = [1.0, 2.0];

/// The cells of the volume grid: those of the contact, or squares of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Its cells.
    pub cells: Cells,
    /// Depth down to which its elements are of that height \[m\], of bodies 1 and 2.
    pub depth: [f64; 2],
    /// Heights of elements at the surface and at interfaces, and far from them \[m\].
    pub heights: [f64; 2],
    /// Depth down to which there are elements \[m\].
    pub reach: f64,
    /// Cells of the contact along a side of one of the volume.
    ratio: usize,
    /// Grid of the contact.
    grid: Grid,
}

impl Volume {
    /// Chosen for a scene: at most so many cells along a side, elements of a cell at
    /// the surface and at interfaces, growing to a twelfth of the radius of the elastic contact, one to two
    /// cells, down to where a point load of the largest force leaves 0.9 of the yield stress.
    pub(super) fn of(scene: &Scene, most: usize) -> Self {
        let grid = scene.grid;
        let sides = if grid.plane_strain {
            [grid.nx, 0]
        } else {
            [grid.nx, grid.ny]
        };
        let divides = |ratio: usize| sides.iter().all(|n| n.is_multiple_of(ratio));
        let mut ratio = 1;
        while sides[0].max(sides[1]) / ratio > most && divides(2 * ratio) {
            ratio *= 2;
        }
        let length = ratio as f64;
        let along_y = if grid.plane_strain { 1 } else { ratio };
        let cells = Cells {
            nx: grid.nx / ratio,
            ny: grid.ny / along_y,
            dx: length * grid.dx,
            dy: along_y as f64 * grid.dy,
            plane_strain: grid.plane_strain,
        };
        let side = if grid.plane_strain {
            cells.dx
        } else {
            cells.dx.min(cells.dy)
        };
        let coarser = volume_cells(grid.plane_strain) as f64 / most as f64;
        let height =
            (coarser * HEIGHT * length_of(scene)).clamp(HEIGHTS[0] * side, HEIGHTS[1] * side);
        Self {
            cells,
            depth: [&scene.body1, &scene.body2].map(|body| depth(scene, body)),
            heights: [HEIGHTS[0] * side, height],
            reach: REACH * length_of(scene),
            ratio,
            grid,
        }
    }

    /// The grid of the contact.
    pub(super) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Means of a field of the contact over the cells of the volume.
    pub(super) fn to_volume(&self, field: &Array2<f64>) -> Vec<f64> {
        let ratio = [
            self.ratio,
            if self.cells.plane_strain {
                1
            } else {
                self.ratio
            },
        ];
        let part = 1.0 / (ratio[0] * ratio[1]) as f64;
        let mut means = vec![0.0; self.cells.len()];
        for ((i, j), value) in field.indexed_iter() {
            means[i / ratio[0] * self.cells.ny + j / ratio[1]] += part * value;
        }
        means
    }

    /// A field of the volume at the cells of the contact.
    pub(super) fn to_contact(&self, field: &[f64]) -> Array2<f64> {
        let along_y = if self.cells.plane_strain {
            1
        } else {
            self.ratio
        };
        let shape = (self.cells.nx, self.cells.ny);
        let fine = resampled(field, shape, [self.ratio, along_y]);
        let shape = (self.grid.nx, self.grid.ny);
        Array2::from_shape_vec(shape, fine).unwrap_or_else(|_| Array2::zeros(shape))
    }
}

/// Radius of the elastic contact, or a quarter of the grid where there is none \[m\].
fn length_of(scene: &Scene) -> f64 {
    let extent = scene.grid.extent();
    scene.hertz().map_or(0.25 * extent.0, |hertz| hertz.a)
}

/// Depth to which a body may yield \[m\]. Below a contact the stress of von Mises falls as that of a
/// point load, 9/(4 pi) W/z^2 for incompressible bodies on the axis, or of a line load, about W/z over 2.
fn depth(scene: &Scene, body: &Body) -> f64 {
    let length = length_of(scene);
    // What the residual stress leaves of the yield stress, a hundredth at least.
    let left = |layer: usize| {
        let law = body.plastic(layer)?;
        let before = body.residual.get(layer).map_or(0.0, Profile::von_mises);
        Some((law.s_y - before).max(0.01 * law.s_y))
    };
    let weakest = (0..=body.coatings.len())
        .filter_map(left)
        .fold(f64::INFINITY, f64::min);
    let p_0 = scene.hertz().map_or(weakest, |hertz| hertz.p0);
    let far = if scene.grid.plane_strain {
        length * p_0 / (YIELDING * weakest)
    } else {
        length * (1.5 * p_0 / (YIELDING * weakest)).sqrt()
    };
    let far = far.clamp(DEPTHS[0] * length, DEPTHS[1] * length);
    let deepest = (0..=body.coatings.len())
        .rev()
        .find(|layer| body.plastic(*layer).is_some());
    // Layers below the deepest that yields stay elastic.
    match deepest.and_then(|layer| body.interfaces().get(layer).copied()) {
        Some(bottom) => far.min(bottom),
        None => far,
    }
}
