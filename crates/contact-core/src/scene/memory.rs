//! Memory that a scene takes, against the memory that there is.

use sysinfo::{MemoryRefreshKind, System};

use super::{Grid, KernelMethod, Plan, Scene};
use crate::error::Error;
use crate::kernels::KernelSet;

/// Memory of the program itself \[bytes\].
const PROGRAM: f64 = 10e6;
/// Numbers per cell of the domain of [`KernelMethod::FrequencyDomain`], lambda^2 times the grid:
/// samples of the response and buffers of the transforms.
const SAMPLES: f64 = 10.0;
/// Numbers per cell of a strip lambda times as long as the grid in [`KernelMethod::InverseFft`].
const HALF_WAY: f64 = 6.0;
/// Numbers per increment: its loads, its results, its line in the store.
const INCREMENT: f64 = 200.0;
/// Numbers per cell that laying out the surfaces takes: each of them, their sum, their making.
const SURFACES: f64 = 6.0;

/// Most that a window around the contact, 0.9 times as long and wide as the grid, adds to the operators
/// of that.
const WINDOW: f64 = 1.8;

const BYTES: f64 = 8.0;

/// Memory that a process may still take \[bytes\]: what the system has to give, or what the control
/// group of the process leaves. Infinite where the system does not say.
pub fn available_memory() -> f64 {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    let of_group = system.cgroup_limits().map_or(u64::MAX, |l| l.free_memory);
    match system.available_memory().min(of_group) {
        // Systems that do not say report nothing.
        0 => f64::INFINITY,
        bytes => bytes as f64,
    }
}

/// Numbers that a solution keeps.
struct Numbers {
    /// Per cell that is solved for: fields, their last values, buffers of the solvers.
    fields: f64,
    /// Per cell of the grid: kernels, their spectra, buffers of the transforms.
    spectra: f64,
}

impl Numbers {
    fn of(kernels: KernelSet) -> Self {
        let (fields, spectra) = match kernels {
            KernelSet::Normal => (50.0, 34.0),
            KernelSet::Uncoupled => (116.0, 26.0),
            KernelSet::All => (176.0, 48.0),
        };
        Self { fields, spectra }
    }
}

impl Plan {
    /// Peak memory of a solution of the scene \[bytes\], what goes with it included: nested grids, the
    /// choice of increments, error bars, the store. A bound from above: runs were measured to take 0.5
    /// to 0.8 times as much from 256 cells per side on.
    pub fn memory(&self, scene: &Scene) -> f64 {
        let grid = &scene.grid;
        let (kept, cells) = (
            grid.nx as f64 * self.mirror.rows(grid.ny) as f64,
            cells(grid),
        );
        let Numbers { fields, spectra } = Numbers::of(self.kernels());
        let conversion = match scene.settings.kernel.method {
            KernelMethod::Hankel => 0.0,
            KernelMethod::InverseFft { lambda, .. } => HALF_WAY * lambda as f64,
            KernelMethod::FrequencyDomain { lambda } => SAMPLES * (lambda * lambda) as f64,
        };
        let spectra = if self.window {
            WINDOW * spectra
        } else {
            spectra
        };
        let increments = INCREMENT * scene.path.increments() as f64;
        PROGRAM + BYTES * (fields * kept + (spectra + conversion) * cells + increments)
    }

    /// Fails with both numbers if the solution needs more memory than there is.
    pub fn check_memory(&self, scene: &Scene) -> Result<(), Error> {
        fits("the solution", self.memory(scene))
    }
}

impl Scene {
    /// Fails if there is no memory even to lay out the surfaces on the grid.
    pub(super) fn check_surfaces_fit(&self) -> Result<(), Error> {
        fits("the grid", SURFACES * BYTES * cells(&self.grid))
    }
}

fn cells(grid: &Grid) -> f64 {
    grid.nx as f64 * grid.ny as f64
}

/// Fails if that many bytes are not to be had.
pub(super) fn fits(what: &'static str, needed: f64) -> Result<(), Error> {
    let available = available_memory();
    if needed <= available {
        return Ok(());
    }
    Err(Error::TooLarge {
        what,
        needed,
        available,
    })
}
