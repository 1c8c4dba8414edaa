//! Memory that a scene takes, against the memory that there is.

use super::KernelSet;
use super::Plan;
use crate::error::Error;
use crate::memory::fits;
use crate::scene::{Grid, KernelMethod, Scene};

/// Memory of the program itself \[bytes\].
const PROGRAM: f64 = 16e6;
/// Numbers per cell of the domain of [`KernelMethod::FrequencyDomain`], lambda^2 times the grid:
/// samples of the response and buffers of the transforms.
const SAMPLES: f64 = 10.0;
/// Numbers per cell of a strip lambda times as long as the grid in [`KernelMethod::InverseFft`].
const HALF_WAY: f64 = 6.0;
/// Numbers per increment: its loads, its results, its line in the store.
const INCREMENT: f64 = 200.0;

/// Largest part of the side of a grid that a window around the contact takes, and the side of a
/// window over the diameter of the contact of Hertz.
const WIDEST: f64 = 0.9;
const AROUND: f64 = 1.2;

const BYTES: f64 = 8.0;

/// Arrays of a solution.
struct ArraysPerCell {
    /// Per cell that is solved for: fields, their previous values, buffers of the solvers.
    fields: f64,
    /// Per cell of the grid: kernels, their spectra, buffers of the transforms.
    spectra: f64,
}

impl ArraysPerCell {
    /// Numbers of arrays per cell that a solution needs, by the kernels that it computes.
    fn for_kernels(kernels: KernelSet) -> Self {
        let (fields, spectra) = match kernels {
            KernelSet::Normal => (44.0, 15.0),
            KernelSet::Uncoupled => (112.0, 30.0),
            KernelSet::All => (112.0, 42.0),
        };
        Self { fields, spectra }
    }
}

impl Plan {
    /// Peak memory of a solution of the scene \[bytes\], including nested grids, the choice of
    /// increments and the store. Measured runs from 128 to 1024 cells per side, with and without a
    /// mirror plane, take 0.8 to 1.04 times as much.
    pub fn memory(&self, scene: &Scene) -> f64 {
        let grid = &scene.grid;
        let (solved_cells, cells) = (
            grid.nx as f64 * self.mirror.rows(grid.ny) as f64,
            cells(grid),
        );
        let ArraysPerCell { fields, spectra } = ArraysPerCell::for_kernels(self.kernels());
        let conversion = match scene.settings.kernel.method {
            KernelMethod::Hankel => 0.0,
            KernelMethod::InverseFft { lambda, .. } => HALF_WAY * lambda as f64,
            KernelMethod::FrequencyDomain { lambda } => SAMPLES * (lambda * lambda) as f64,
        };
        let spectra = if self.methods.window {
            (1.0 + window_share(scene)) * spectra
        } else {
            spectra
        };
        let increments = INCREMENT * scene.path.increments() as f64;
        PROGRAM + BYTES * (fields * solved_cells + (spectra + conversion) * cells + increments)
    }

    /// Fails with both numbers if the solution needs more memory than there is.
    pub fn check_memory(&self, scene: &Scene) -> Result<(), Error> {
        fits("the solution", self.memory(scene))
    }
}

/// Part of the cells of the grid in the window around the contact: of the diameter of a round contact,
/// else the largest.
fn window_share(scene: &Scene) -> f64 {
    let (k_1, k_2) = scene.principal_curvatures();
    let is_round = scene.grid.plane_strain || k_1 - k_2 <= 1e-9 * k_1;
    let diameter = scene
        .hertz()
        .filter(|_| is_round)
        .map_or(f64::INFINITY, |hertz| AROUND * 2.0 * hertz.a);
    let part = |side: f64| (diameter / side).min(WIDEST);
    let (length, width) = scene.grid.extent();
    if scene.grid.plane_strain {
        part(length)
    } else {
        part(length) * part(width)
    }
}

/// Number of cells of a grid, as a float.
fn cells(grid: &Grid) -> f64 {
    grid.nx as f64 * grid.ny as f64
}
