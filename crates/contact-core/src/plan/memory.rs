//! Memory that a scene takes, against the memory that there is.

use super::KernelSet;
use super::Plan;
use crate::error::Error;
use crate::memory::fits;
use crate::scene::{Grid, KernelMethod, Scene};

/// Memory of the program itself \[bytes\].
const PROGRAM: f64 = 10e6;
/// Numbers per cell of the domain of [`KernelMethod::FrequencyDomain`], lambda^2 times the grid:
/// samples of the response and buffers of the transforms.
const SAMPLES: f64 = 10.0;
/// Numbers per cell of a strip lambda times as long as the grid in [`KernelMethod::InverseFft`].
const HALF_WAY: f64 = 6.0;
/// Numbers per increment: its loads, its results, its line in the store.
const INCREMENT: f64 = 200.0;

/// Upper bound of the memory of operators with a window around the contact, 0.9 times as long and
/// wide as the grid, over the memory of the operators without it.
const WINDOW: f64 = 1.8;

const BYTES: f64 = 8.0;

/// Arrays of a solution.
struct ArraysPerCell {
    /// Per cell that is solved for: fields, their previous values, buffers of the solvers.
    fields: f64,
    /// Per cell of the grid: kernels, their spectra, buffers of the transforms.
    spectra: f64,
}

impl ArraysPerCell {
    fn for_kernels(kernels: KernelSet) -> Self {
        let (fields, spectra) = match kernels {
            KernelSet::Normal => (50.0, 34.0),
            KernelSet::Uncoupled => (116.0, 26.0),
            KernelSet::All => (176.0, 48.0),
        };
        Self { fields, spectra }
    }
}

impl Plan {
    /// Peak memory of a solution of the scene \[bytes\], including nested grids, the choice of
    /// increments, error bars, the store. This is an upper bound: measured runs take 0.5 to 0.8
    /// times as much from 256 cells per side on.
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
            WINDOW * spectra
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

fn cells(grid: &Grid) -> f64 {
    grid.nx as f64 * grid.ny as f64
}
