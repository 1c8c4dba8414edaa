//! Contact temperature: sources whose temperature is known, layers, sharing, cycles.

mod cycles;
mod sharing;
mod sources;

use contact_core::kernels::Complex64;
use contact_core::scene::Grid;
use contact_heat::{Conduction, Conductor, Layers};

const STEEL: Conductor = Conductor {
    conductivity: 50.0,
    heat_capacity: 3.6e6,
};
const TITANIUM: Conductor = Conductor {
    conductivity: 7.0,
    heat_capacity: 2.4e6,
};
/// Radius of the sources \[m\].
const A: f64 = 1e-3;

fn steel() -> Layers {
    Layers::homogeneous(STEEL).expect("a body")
}

fn titanium() -> Layers {
    Layers::homogeneous(TITANIUM).expect("a body")
}

fn coated(coating: Conductor, h: f64, substrate: Conductor) -> Layers {
    Layers::new(&[coating, substrate], &[h], "body").expect("a body")
}

/// A grid with a cell in the middle, `n` cells to the radius.
fn grid(n: usize) -> Grid {
    let side = 2 * n + 7;
    Grid::centred(side as f64 * A / n as f64, side).expect("a grid")
}

/// The mean over each cell of a function of r/A.
fn source(grid: &Grid, f: impl Fn(f64) -> f64) -> Vec<Complex64> {
    const PARTS: usize = 16;
    let within = |n: usize| (n as f64 + 0.5) / PARTS as f64 - 0.5;
    let mean = grid.map(|x, y| {
        let parts = (0..PARTS * PARTS).map(|n| {
            let (x, y) = (
                x + within(n / PARTS) * grid.dx,
                y + within(n % PARTS) * grid.dy,
            );
            f(x.hypot(y) / A)
        });
        parts.sum::<f64>() / (PARTS * PARTS) as f64
    });
    mean.iter().map(|q| Complex64::new(*q, 0.0)).collect()
}

fn disc(grid: &Grid) -> Vec<Complex64> {
    source(grid, |r| if r < 1.0 { 1.0 } else { 0.0 })
}

fn respond(body: &Layers, grid: &Grid, w: f64, q: &[Complex64]) -> Vec<Complex64> {
    Conduction::new(body, grid, w)
        .expect("a response")
        .temperature(q)
}

fn close(found: f64, expected: f64, tolerance: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(
        error < tolerance,
        "{found:e}, not {expected:e}: {error:.1e}"
    );
}

fn middle(grid: &Grid) -> usize {
    grid.cells() / 2
}
