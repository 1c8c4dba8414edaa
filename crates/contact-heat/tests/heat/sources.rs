//! Sources whose temperature is known; layers.

use std::f64::consts::PI;

use contact_core::kernels::Complex64;
use contact_core::scene::Grid;
use contact_heat::{Conductor, Layers, surface_response};

use super::{
    A, STEEL, TITANIUM, close, coated, disc, grid, middle, respond, source, steel, titanium,
};

/// Largest q a/K and mean 8 q a/(3 pi K): Carslaw and Jaeger 1959, section 8.2.
#[test]
fn a_disc_of_heat() {
    let grid = grid(32);
    let q = disc(&grid);
    let t = respond(&steel(), &grid, 0.0, &q);
    let unit = A / STEEL.conductivity;
    close(t[middle(&grid)].re, unit, 2e-4);
    let weight: f64 = q.iter().map(|q| q.re).sum();
    let mean = q.iter().zip(&t).map(|(q, t)| q.re * t.re).sum::<f64>() / weight;
    close(mean, 8.0 * unit / (3.0 * PI), 2e-3);
}

/// pi q_0 a/(4 K) in the middle and half of it at the rim: Hertz' displacement with 1/K for (1 -
/// nu)/G.
#[test]
fn a_source_of_the_shape_of_hertz_pressure() {
    let grid = grid(32);
    let q = source(&grid, |r| (1.0 - r * r).max(0.0).sqrt());
    let t = respond(&steel(), &grid, 0.0, &q);
    let expected = PI * A / (4.0 * STEEL.conductivity);
    close(t[middle(&grid)].re, expected, 5e-4);
    close(t[middle(&grid) + 32].re, expected / 2.0, 2e-3);
    // Of what is largest: the mean of q T over that of q.
    let weight: f64 = q.iter().map(|q| q.re).sum();
    let mean = q.iter().zip(&t).map(|(q, t)| q.re * t.re).sum::<f64>() / weight;
    // The mean of 1 - r^2/2 under sqrt(1 - r^2) is 4/5.
    close(mean, 0.8 * expected, 2e-3);
}

/// (1/(K k)) (1 + r tanh)/(r + tanh), r = K/K_s, of a layer: its two parts put together otherwise.
#[test]
fn a_layer_answers_as_its_hyperbolic_functions_say() {
    for (k, w) in [(1e-2, 0.0), (3e3, 0.0), (1e6, 0.0), (1e2, 40.0), (5e4, 3e6)] {
        let h = 2e-4;
        let body = coated(TITANIUM, h, STEEL);
        let m = |c: Conductor| {
            c.conductivity * Complex64::new(k * k, w * c.heat_capacity / c.conductivity).sqrt()
        };
        let (layer, below) = (m(TITANIUM), m(STEEL));
        let s = layer / TITANIUM.conductivity;
        // Beyond 20 the hyperbolic tangent is 1 to rounding.
        let tanh = if (s * h).re > 20.0 {
            Complex64::ONE
        } else {
            (s * h).tanh()
        };
        let expected = (layer + below * tanh) / (layer * (below + layer * tanh));
        let error = (surface_response(&body, k, w) / expected - 1.0).norm();
        assert!(error < 1e-13, "k = {k}, w = {w}: {error:.1e}");
    }
}

/// Thick, a coating is a half-space but for what the images of its lower side add; thin, it adds h
/// (1/K - K/K_s^2), its resistance less what it conducts sideways: the response to first order in k
/// h.
#[test]
fn thick_and_thin_coatings() {
    let grid = grid(16);
    let q = disc(&grid);
    let at = |body: &Layers, w: f64| respond(body, &grid, w, &q)[middle(&grid)];
    let (bare, other) = (at(&steel(), 0.0).re, at(&titanium(), 0.0).re);

    let same = respond(&coated(STEEL, 0.3 * A, STEEL), &grid, 0.0, &q);
    close(same[middle(&grid)].re, bare, 1e-13);

    // Images of strength 2 rho^n at the depths 2 n h add q a^2 rho^n/(2 n h K) each.
    let h = 100.0 * A;
    let rho =
        (TITANIUM.conductivity - STEEL.conductivity) / (TITANIUM.conductivity + STEEL.conductivity);
    let images: f64 = (1..200).map(|n| rho.powi(n) / f64::from(n)).sum();
    let far = A * A * images / (2.0 * h * TITANIUM.conductivity);
    close(at(&coated(TITANIUM, h, STEEL), 0.0).re - other, far, 1e-3);

    let h = 1e-4 * A;
    let (k, k_s) = (TITANIUM.conductivity, STEEL.conductivity);
    let added = h * (1.0 / k - k / (k_s * k_s));
    // Next to it is a part h/a of it.
    close(at(&coated(TITANIUM, h, STEEL), 0.0).re - bare, added, 1e-3);

    // Where the heat does not reach through the layer within a period there is no substrate.
    let w = 100.0 * TITANIUM.conductivity / TITANIUM.heat_capacity / (0.2 * A * 0.2 * A);
    let error = at(&coated(TITANIUM, A, STEEL), w) / at(&titanium(), w) - 1.0;
    assert!(error.norm() < 1e-12, "{error:.1e}");
}

/// All heat leaves through the substrate: far away T = Q/(2 pi K_s r), whatever the coating.
#[test]
fn energy_reaches_the_substrate() {
    for (coating, h) in [
        (TITANIUM, 0.1 * A),
        (
            Conductor {
                conductivity: 600.0,
                ..STEEL
            },
            0.02 * A,
        ),
    ] {
        let grid = Grid::from_spacing((801, 1), (A, A)).unwrap();
        let mut q = vec![Complex64::ZERO; grid.cells()];
        q[0] = Complex64::ONE;
        let t = respond(&coated(coating, h, STEEL), &grid, 0.0, &q);
        let r = 800.0 * A;
        close(
            t[800].re * 2.0 * PI * STEEL.conductivity * r,
            grid.cell_area(),
            1e-5,
        );
    }
}
