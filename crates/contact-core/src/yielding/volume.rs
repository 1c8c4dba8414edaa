//! The volume grid: its cells, and the mapping between them and the cells of the contact.

use eigenstrain::{Cells, Layer, Mesh};
use ndarray::Array2;

use super::resampled::resampled;
use crate::error::Error;
use crate::scene::{Body, Bond, Grid, Profile, Scene};

/// Most cells of the volume grid along a side of a point contact, and along a line contact.
const MOST_CELLS: usize = 64;
const MOST_CELLS_OF_A_LINE: usize = 256;

/// Largest number of cells of the volume grid along a side, before it grows.
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
/// Cells that a grown grid has more beyond each side of the contact's, over the contact's.
const MARGIN: f64 = 0.25;
/// Depth of a grown grid over that before.
const DEEPER: f64 = 1.5;

/// The cells of the volume grid: the cells of the contact, or squares of them. A grid that has grown has more of
/// them beyond its sides, and planes below.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Its cells.
    pub cells: Cells,
    /// Depth down to which its elements are of that height \[m\], of bodies 1 and 2.
    pub depth: [f64; 2],
    /// Heights of elements at the surface and at interfaces, and far from them \[m\].
    pub heights: [f64; 2],
    /// Depth down to which there are elements before the grid grows \[m\].
    pub reach: f64,
    /// Whether it has grown.
    pub grown: bool,
    /// Cells along x and y that the grid has when it has grown, and those that it has less at each side.
    largest: [usize; 2],
    left_out: [usize; 2],
    /// Cells of the contact along a side of one of the volume.
    ratio: usize,
    /// Grid of the contact.
    grid: Grid,
}

impl Volume {
    /// Chooses the volume grid of a scene, with at most `max_cells` along a side. Elements are as deep as a
    /// cell at the surface and at interfaces. They grow to a twelfth of the radius of the elastic contact, one
    /// to two cells, down to the depth where a point load of the largest force leaves 0.9 of the yield stress.
    pub(super) fn choose(scene: &Scene, max_cells: usize, grown: bool) -> Self {
        let grid = scene.grid;
        let sides = if grid.plane_strain {
            [grid.nx, 0]
        } else {
            [grid.nx, grid.ny]
        };
        let divides = |ratio: usize| sides.iter().all(|n| n.is_multiple_of(ratio));
        let mut ratio = 1;
        while sides[0].max(sides[1]) / ratio > max_cells && divides(2 * ratio) {
            ratio *= 2;
        }
        let length = ratio as f64;
        let along_y = if grid.plane_strain { 1 } else { ratio };
        let contact = [grid.nx / ratio, grid.ny / along_y];
        let mut margin = contact.map(|n| (MARGIN * n as f64).ceil() as usize);
        if grid.plane_strain {
            margin[1] = 0;
        }
        let largest = [0, 1].map(|axis| contact[axis] + 2 * margin[axis]);
        let [nx, ny] = if grown { largest } else { contact };
        let cells = Cells {
            nx,
            ny,
            dx: length * grid.dx,
            dy: along_y as f64 * grid.dy,
            plane_strain: grid.plane_strain,
        };
        let side = if grid.plane_strain {
            cells.dx
        } else {
            cells.dx.min(cells.dy)
        };
        let coarser = volume_cells(grid.plane_strain) as f64 / max_cells as f64;
        let height =
            (coarser * HEIGHT * length_of(scene)).clamp(HEIGHTS[0] * side, HEIGHTS[1] * side);
        Self {
            cells,
            depth: [&scene.body1, &scene.body2].map(|body| depth(scene, body)),
            heights: [HEIGHTS[0] * side, height],
            reach: REACH * length_of(scene),
            grown,
            largest,
            left_out: if grown { [0, 0] } else { margin },
            ratio,
            grid,
        }
    }

    /// The grid of the contact.
    pub(super) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The mesh of body 1 or 2.
    pub(super) fn mesh(&self, number: usize, body: &Body) -> Result<Mesh, Error> {
        let depth = self.depth[number - 1];
        let deeper = if self.grown { DEEPER } else { 1.0 };
        let mesh = mesh_of(body, self.cells, depth, self.heights, self.reach)?;
        (mesh.deepened(deeper)).map_err(|e| Error::invalid(e.key, e.value, e.allowed))
    }

    /// The cell of this grid that a cell of the grown grid is; `None` if it lies beyond this grid.
    pub fn cell(&self, of_largest: u32) -> Option<usize> {
        let n = of_largest as usize;
        let [i, j] = [n / self.largest[1], n % self.largest[1]];
        let i = i.checked_sub(self.left_out[0])?;
        let j = j.checked_sub(self.left_out[1])?;
        (i < self.cells.nx && j < self.cells.ny).then_some(i * self.cells.ny + j)
    }

    /// The number of a cell of this grid in the grown grid, by which a state stores it.
    pub(super) fn of_largest(&self, cell: usize) -> u32 {
        let [i, j] = [cell / self.cells.ny, cell % self.cells.ny];
        ((i + self.left_out[0]) * self.largest[1] + j + self.left_out[1]) as u32
    }

    /// The numbers of volume cells below the contact along x and y, and of those beyond them at each side.
    fn below_contact(&self) -> ([usize; 2], [usize; 2]) {
        let ratio = [self.ratio, self.ratio_along_y()];
        let contact = [self.grid.nx / ratio[0], self.grid.ny / ratio[1]];
        let beyond = [
            (self.cells.nx - contact[0]) / 2,
            (self.cells.ny - contact[1]) / 2,
        ];
        (contact, beyond)
    }

    /// Number of cells below the contact.
    pub(super) fn cells_below_contact(&self) -> usize {
        let ([nx, ny], _) = self.below_contact();
        nx * ny
    }

    /// The part below the contact of three fields of the volume, one after the other.
    pub(super) fn part_below_contact(&self, fields: &[f64], part: &mut [f64]) {
        let ([nx, ny], beyond) = self.below_contact();
        let planes = fields.chunks_exact(self.cells.len());
        for (field, part) in planes.zip(part.chunks_exact_mut(nx * ny)) {
            for (i, row) in part.chunks_exact_mut(ny).enumerate() {
                let from = (i + beyond[0]) * self.cells.ny + beyond[1];
                row.copy_from_slice(&field[from..from + ny]);
            }
        }
    }

    /// Cells of the contact along y in one cell of the volume.
    fn ratio_along_y(&self) -> usize {
        if self.cells.plane_strain {
            1
        } else {
            self.ratio
        }
    }

    /// Means of a field of the contact over the cells of the volume; zero beyond the contact.
    pub(super) fn to_volume(&self, field: &Array2<f64>) -> Vec<f64> {
        let ratio = [self.ratio, self.ratio_along_y()];
        let (_, beyond) = self.below_contact();
        let part = 1.0 / (ratio[0] * ratio[1]) as f64;
        let mut means = vec![0.0; self.cells.len()];
        for ((i, j), value) in field.indexed_iter() {
            let (i, j) = (i / ratio[0] + beyond[0], j / ratio[1] + beyond[1]);
            means[i * self.cells.ny + j] += part * value;
        }
        means
    }

    /// Maps a field on the cells of the volume below the contact to the cells of the contact.
    pub(super) fn to_contact(&self, field: &[f64]) -> Array2<f64> {
        let ([nx, ny], _) = self.below_contact();
        let fine = resampled(field, (nx, ny), [self.ratio, self.ratio_along_y()]);
        let shape = (self.grid.nx, self.grid.ny);
        Array2::from_shape_vec(shape, fine).unwrap_or_else(|_| Array2::zeros(shape))
    }
}

/// The mesh of a body: [`Mesh::graded`] of its layers, lengths in \[m\].
pub fn mesh_of(
    body: &Body,
    cells: Cells,
    depth: f64,
    heights: [f64; 2],
    reach: f64,
) -> Result<Mesh, Error> {
    let bonds = (0..body.coatings.len()).map(|layer| body.bond(layer));
    if bonds.into_iter().any(|bond| bond != Bond::PERFECT) {
        let allowed = "left out: layers are bonded perfectly here";
        return Err(Error::invalid("bond", "compliant", allowed));
    }
    let layer = |E: f64, nu: f64, thickness: f64| Layer { E, nu, thickness };
    let coatings = body.coatings.iter();
    let mut layers: Vec<Layer> = coatings
        .map(|c| layer(c.material.E, c.material.nu, c.thickness))
        .collect();
    layers.push(layer(body.substrate.E, body.substrate.nu, f64::INFINITY));
    Mesh::graded(cells, layers, depth, heights, reach)
        .map_err(|e| Error::invalid(e.key, e.value, e.allowed))
}

/// Radius of the elastic contact, or a quarter of the grid where there is none \[m\].
fn length_of(scene: &Scene) -> f64 {
    let extent = scene.grid.extent();
    scene.hertz().map_or(0.25 * extent.0, |hertz| hertz.a)
}

/// Depth to which a body may yield \[m\]. Below a contact the stress of von Mises falls as under a
/// point load, 9/(4 pi) W/z^2 for incompressible bodies on the axis, or of a line load, about W/z over 2.
fn depth(scene: &Scene, body: &Body) -> f64 {
    let length = length_of(scene);
    // What the residual stress leaves of the yield stress, a hundredth at least.
    let remaining_yield_stress = |layer: usize| {
        let law = body.plastic(layer)?;
        let before = body.residual.get(layer).map_or(0.0, Profile::von_mises);
        Some((law.s_y - before).max(0.01 * law.s_y))
    };
    let weakest = (0..=body.coatings.len())
        .filter_map(remaining_yield_stress)
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
